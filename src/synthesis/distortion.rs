//! The distortion map of the depth-discontinuity occlusion camera: how rays are distorted at each pixel.
//!
//! Popescu et al., section IV.C: steps 3 to 5 and asymmetrical splats (Equation 1). In a scene with edges everywhere, splats compete for the same
//! places. The map therefore differs from the paper:
//!
//! - Equation 2 moves a surface halfway in depth by half as much as the background. Part of it then stays hidden, although viewpoints see it: of the
//!   r/2 that they see, only r/3 comes out, and with α = 4 only r/6. Here Equation 1 holds for each depth, with r scaled to the pixels by which
//!   viewpoints separate that depth from the edge. Rays are then parallel to those of the farthest viewpoint while there is room, and converge only
//!   beyond.
//! - The distance to an edge is measured from each place, not from the centre of its pixel, so that samples keep their order within a splat.
//! - D is a maximum. A splat reaches only as far as the viewpoints that matter can separate the two sides of its edge. That matters where small
//!   discontinuities count as edges, and little where only large ones do (docs/measured.md).
//! - Of two splats, the larger one gets more of the places between them.
//! - A conflict counts only on the normal of the edge, where the splat's own samples go, not anywhere in its disc. Directions conflict from 60° on.
//! - α is a maximum, too. A splat has the room before the background up to the first conflict, and is asymmetrical only where that is less than its
//!   reach.
//! - Places that a reduced splat gives up go to the next splat that reaches them.
//! - A place also keeps the closest splat that distorts in a conflicting direction. That one applies to samples that it brings out and that the
//!   closest one leaves hidden. Samples keep their vectors, so later steps need not know which splat applied.

use super::{Edge, Edges};

/// Pixels from the centre of the last pixel of an occluder to its edge.
const END: f64 = 0.25;
/// Share of the room before the background that a splat takes.
const TAKEN: f64 = 0.8;
/// Directions conflict if the cosine between them is less: above 60°.
const ALIKE: f64 = 0.5;
/// Share of the threshold of a discontinuity by which a sample may lie behind the drawn surface and still belong to it.
const SAME: f64 = 0.5;

/// How the rays near a depth discontinuity are distorted. Depths are 1/w.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distortion {
    /// (d_u, d_v), of length 1, away from the occluder.
    pub direction: [f64; 2],
    /// Place of the occluder's edge, in pixels.
    pub edge: [f64; 2],
    /// 1/z_n: nothing nearer than this moves.
    pub near: f64,
    /// 1/z_f.
    pub far: f64,
    /// Pixels behind the occluder that viewpoints see of a surface at z_f.
    pub seen: f64,
    /// r: pixels behind the occluder that are reached at most, at any depth.
    pub radius: f64,
    /// Pixels that the splat may take on the side of the background. Where they are fewer than the reach, α is the ratio of the two.
    pub room: f64,
}

impl Distortion {
    /// Pixels along [`Distortion::direction`] by which a point at a place and 1/w moves.
    pub fn at(&self, place: [f64; 2], inverse: f64) -> f64 {
        let to = [0, 1].map(|i| place[i] - self.edge[i]);
        let x = to[0].hypot(to[1]).copysign(dot(to, self.direction));
        let depth = ((self.near - inverse) / (self.near - self.far)).clamp(0.0, 1.0);
        let reach = (depth * self.seen).min(self.radius);
        match x {
            // No viewpoint sees this: it stays behind the occluder, joined to the part that is seen.
            _ if x < -self.radius => 0.0,
            _ if x < -reach => (2.0 * reach + x).max(0.0),
            _ => magnitude(x, reach, (reach / self.room).max(1.0)),
        }
    }
}

/// The parameters that the user chooses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Splats {
    /// D: the most pixels that the camera reaches behind an occluder; 30 in the paper.
    pub radius: f64,
    /// Disparity of the farthest viewpoint that matters, in pixels per unit of 1/w: no splat reaches farther than its own depth discontinuity needs.
    /// With infinity all splats reach D, as in the paper.
    pub parallax: f64,
    /// The greatest α: reach behind the occluder, over the extent on the side of the background. 1 keeps both sides equal.
    pub asymmetry: f64,
}

/// The distortion map: the distortion at each pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Distortions {
    size: [u32; 2],
    map: Vec<Option<Distortion>>,
    /// The closest splats that distort in a direction in conflict with that of `map`.
    others: Vec<Option<Distortion>>,
    /// 1/w by pixel that undistorted rays see.
    depths: Vec<f32>,
    /// 1/w by which a sample may lie behind that and still belong to the same surface.
    same: f64,
}

impl Distortions {
    /// From the discontinuities of a picture of this size.
    pub fn of(size: [u32; 2], edges: &Edges, splats: &Splats) -> Distortions {
        let (depths, same) = (edges.depths.clone(), edges.threshold * SAME);
        let edges = &edges.all;
        let most = |edge: &Edge| (splats.parallax * (edge.near - edge.far)).min(splats.radius);
        let most: Vec<f64> = edges.iter().map(most).collect();
        let first = owners(size, edges, &most, |_, _| true);
        let room = |(edge, &most)| TAKEN * first.room(edges, edge, most);
        let room: Vec<f64> = edges.iter().zip(&most).map(room).collect();
        let radius = |(room, most): (&f64, &f64)| (room * splats.asymmetry).min(*most);
        let radii: Vec<f64> = room.iter().zip(&most).map(radius).collect();
        let closest = owners(size, edges, &radii, |_, _| true);
        let others = owners(size, edges, &radii, |at, edge| {
            let own = closest.all[at].and_then(|owner| edges.get(owner.number));
            own.is_some_and(|own| dot(own.normal, edge.normal) < ALIKE)
        });
        let reaches = closest.reaches(edges, &radii);
        // Step 5.
        let sample = |owner: &Option<Owner>| {
            let Owner { number, x } = (*owner)?;
            let (edge, r) = (edges.get(number)?, *reaches.get(number)?);
            if x.abs() > r || r <= 0.0 {
                return None;
            }
            Some(Distortion {
                direction: edge.normal,
                edge: [0, 1].map(|i| edge.at[i] as f64 + 0.5 + END * edge.normal[i]),
                near: edge.near,
                far: edge.far,
                seen: *most.get(number)?,
                radius: r,
                room: *room.get(number)?,
            })
        };
        Distortions {
            size,
            map: closest.all.iter().map(sample).collect(),
            others: others.all.iter().map(sample).collect(),
            depths,
            same,
        }
    }

    /// No distortion: straight rays.
    pub fn none(size: [u32; 2]) -> Distortions {
        Distortions {
            size,
            map: Vec::new(),
            others: Vec::new(),
            depths: Vec::new(),
            same: 0.0,
        }
    }

    /// The distortion vector of a point at a place and 1/w, all in pixels of a picture of this size. The map's own picture may have another size:
    /// Figure 15 has the same rays with more samples.
    pub fn vector(&self, size: [u32; 2], place: [f64; 2], inverse: f64) -> [f64; 2] {
        let scale = [0, 1].map(|i| f64::from(size[i]) / f64::from(self.size[i]));
        let own = [0, 1].map(|i| place[i] / scale[i]);
        self.at(own, inverse).map_or([0.0; 2], |distortion| {
            let by = distortion.at(own, inverse);
            [0, 1].map(|i| scale[i] * (distortion.direction[i] * by))
        })
    }

    /// The distortion of a point at a place in the map's own picture and 1/w. None where its ray is straight.
    pub fn at(&self, place: [f64; 2], inverse: f64) -> Option<&Distortion> {
        let index = self.index(place)?;
        let closest = self.map.get(index)?.as_ref()?;
        let Some(other) = self.others.get(index).and_then(Option::as_ref) else {
            return Some(closest);
        };
        let out = |place| {
            let drawn = self.index(place).and_then(|index| self.depths.get(index));
            drawn.is_some_and(|drawn| f64::from(*drawn) <= inverse + self.same)
        };
        let moved = |distortion: &Distortion| {
            let by = distortion.at(place, inverse);
            [0, 1].map(|i| place[i] + distortion.direction[i] * by)
        };
        let stays = out(place) || out(moved(closest)) || !out(moved(other));
        Some(if stays { closest } else { other })
    }

    fn index(&self, [u, v]: [f64; 2]) -> Option<usize> {
        let [w, h] = self.size.map(f64::from);
        let inside = (0.0..w).contains(&u) && (0.0..h).contains(&v);
        inside.then(|| v as usize * self.size[0] as usize + u as usize)
    }
}

/// The splat that owns a place, by the number of its edge, and the distance x of the edge in pixels: positive on the side of the background.
#[derive(Clone, Copy)]
struct Owner {
    number: usize,
    x: f64,
}

/// Step 3: a place belongs to the splat whose centre is closest, but one with four times the radius may be twice as far away. Only edges for which
/// `may` is true compete for the place with this index.
fn owners(
    size: [u32; 2],
    edges: &[Edge],
    radii: &[f64],
    may: impl Fn(usize, &Edge) -> bool,
) -> Owners {
    let [w, h] = size.map(i64::from);
    let mut all: Vec<Option<Owner>> = vec![None; (w * h) as usize];
    let relative = |owner: Owner| {
        let radius = radii.get(owner.number).map_or(1.0, |r| r.max(1.0));
        owner.x.abs() / radius.sqrt()
    };
    for (number, (edge, &radius)) in edges.iter().zip(radii).enumerate() {
        let reach = radius.ceil() as i64;
        let [columns, rows] = [(0, w), (1, h)].map(|(i, end): (usize, i64)| {
            edge.at[i].saturating_sub(reach).max(0)
                ..edge.at[i].saturating_add(reach).saturating_add(1).min(end)
        });
        for y in rows {
            for x in columns.clone() {
                let to = [x - edge.at[0], y - edge.at[1]].map(|v| v as f64);
                let distance = to[0].hypot(to[1]);
                if distance > radius {
                    continue;
                }
                let x_e = distance.copysign(dot(to, edge.normal));
                let own = Owner { number, x: x_e };
                let at = (y * w + x) as usize;
                if let Some(owner) = all.get_mut(at)
                    && owner.is_none_or(|other| relative(own) < relative(other))
                    && may(at, edge)
                {
                    *owner = Some(own);
                }
            }
        }
    }
    Owners { size: [w, h], all }
}

/// The owner of each place.
struct Owners {
    size: [i64; 2],
    all: Vec<Option<Owner>>,
}

impl Owners {
    fn at(&self, [x, y]: [i64; 2]) -> Option<Owner> {
        let [w, h] = self.size;
        let inside = (0..w).contains(&x) && (0..h).contains(&y);
        inside
            .then(|| self.all.get((y * w + x) as usize).copied())
            .flatten()?
    }

    /// Step 4: pixels on the side of the background up to the first place that belongs to a splat in a conflicting direction; at most `most`.
    fn room(&self, edges: &[Edge], edge: &Edge, most: f64) -> f64 {
        let place =
            |t: f64| [0, 1].map(|i| (edge.at[i] as f64 + t * edge.normal[i]).round() as i64);
        let conflict = |t: &f64| {
            let other = self.at(place(*t)).and_then(|owner| edges.get(owner.number));
            other.is_some_and(|other| dot(edge.normal, other.normal) < ALIKE)
        };
        let steps = (1..).map(f64::from).take_while(|t| *t < most);
        steps.into_iter().find(conflict).unwrap_or(most)
    }

    /// The reach of each edge behind its occluder: as far as edges of the same line own places. More would only press the samples together.
    fn reaches(&self, edges: &[Edge], radii: &[f64]) -> Vec<f64> {
        let [w, h] = self.size;
        let mut own = vec![0.0_f64; edges.len()];
        for owner in self.all.iter().flatten() {
            own[owner.number] = own[owner.number].max(-owner.x);
        }
        let mut numbers = vec![None; (w * h) as usize];
        for (number, edge) in edges.iter().enumerate() {
            numbers[(edge.at[1] * w + edge.at[0]) as usize] = Some(number);
        }
        let line = |(edge, radius): (&Edge, &f64)| {
            let [columns, rows] = [(0, w), (1, h)].map(|(i, end): (usize, i64)| {
                (edge.at[i] - LINE).max(0)..(edge.at[i] + LINE + 1).min(end)
            });
            let around = rows.flat_map(|y| columns.clone().map(move |x| (y * w + x) as usize));
            let along = around.filter_map(|at| numbers[at]);
            let same = along.filter(|&number: &usize| dot(edges[number].normal, edge.normal) > 0.5);
            let farthest = same.map(|number| own[number]).fold(0.0, f64::max);
            (farthest + 1.0).min(*radius)
        };
        edges.iter().zip(radii).map(line).collect()
    }
}

/// Pixels to either side within which edges whose normals differ by less than 60° belong to one line.
const LINE: i64 = 8;

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Equation 1: d_f at a signed distance x from the discontinuity, positive on the side of the background; 0 from r/α on.
pub(super) fn magnitude(x: f64, r: f64, asymmetry: f64) -> f64 {
    (r - (x + r) / (1.0 + 1.0 / asymmetry)).max(0.0)
}
