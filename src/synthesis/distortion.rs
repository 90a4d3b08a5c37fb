//! The distortion map of the depth-discontinuity occlusion camera: how rays are bent at each pixel.
//!
//! Popescu et al., section IV.C: steps 3 to 5 and asymmetrical splats (Equation 1); the magnitude over depth is a part of Equation 2.

use super::Edges;

/// How the rays near a depth discontinuity are bent: the five-tuple of the paper, depths as 1/w.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distortion {
    /// (d_u, d_v), of length 1, away from what is in front.
    pub direction: [f64; 2],
    /// 1/z_n: up to there nothing moves.
    pub near: f64,
    /// 1/z_f: from there on everything moves by the whole.
    pub far: f64,
    /// d_f, in pixels.
    pub magnitude: f64,
}

impl Distortion {
    /// Pixels by which something at 1/w moves: d(z) of Equation 2.
    pub fn at(&self, inverse: f64) -> f64 {
        let depth = (self.near - inverse) / (self.near - self.far);
        depth.clamp(0.0, 1.0) * self.magnitude
    }
}

/// What the user chooses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Splats {
    /// D: pixels behind what is in front that the camera reaches, 30 in the paper.
    pub radius: f64,
    /// α: on the side of the background a splat reaches so much less far. 1: as far as on the other.
    pub asymmetry: f64,
}

/// The distortion at each pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Distortions {
    size: [u32; 2],
    map: Vec<Option<Distortion>>,
}

impl Distortions {
    /// Of the discontinuities of a picture of this size.
    pub fn of(size: [u32; 2], edges: &Edges, splats: &Splats) -> Distortions {
        let [w, h] = size.map(i64::from);
        let index = |[x, y]: [i64; 2]| (y * w + x) as usize;
        let apart = |a: [i64; 2], b: [i64; 2]| ((a[0] - b[0]) as f64).hypot((a[1] - b[1]) as f64);
        let disc = |centre: [i64; 2]| {
            let reach = splats.radius.ceil() as i64;
            let rows = (centre[1] - reach).max(0)..(centre[1] + reach + 1).min(h);
            rows.flat_map(move |y| {
                let columns = (centre[0] - reach).max(0)..(centre[0] + reach + 1).min(w);
                columns.map(move |x| [x, y])
            })
            .map(move |p| (p, apart(p, centre)))
            .filter(|(_, distance)| *distance <= splats.radius)
        };
        // Step 3: the splat whose centre is closest has the place.
        let mut owners: Vec<Option<(usize, f64)>> = vec![None; (w * h) as usize];
        for (number, edge) in edges.all.iter().enumerate() {
            for (p, distance) in disc(edge.at) {
                if let Some(owner) = owners.get_mut(index(p))
                    && owner.is_none_or(|(_, closest)| distance < closest)
                {
                    *owner = Some((number, distance));
                }
            }
        }
        // Step 4: none reaches to where one has the place that bends the other way.
        let radius = |edge: &super::Edge| {
            let conflicts = disc(edge.at).filter(|(p, _)| {
                let owner = owners.get(index(*p)).copied().flatten();
                let other = owner.and_then(|(number, _)| edges.all.get(number));
                other.is_some_and(|other| dot(edge.normal, other.normal) < 0.0)
            });
            let nearest = conflicts.map(|(_, distance)| distance);
            nearest.fold(splats.radius, f64::min)
        };
        let radii: Vec<f64> = edges.all.iter().map(radius).collect();
        // Step 5.
        let sample = |(at, owner): (usize, &Option<(usize, f64)>)| {
            let (number, distance) = (*owner)?;
            let (edge, r) = (edges.all.get(number)?, *radii.get(number)?);
            if distance > r || r <= 0.0 {
                return None;
            }
            let p = [at as i64 % w, at as i64 / w];
            let to = [(p[0] - edge.at[0]) as f64, (p[1] - edge.at[1]) as f64];
            let x = distance.copysign(dot(to, edge.normal));
            let magnitude = magnitude(x, r, splats.asymmetry);
            (magnitude > 0.0).then_some(Distortion {
                direction: edge.normal,
                near: edge.near,
                far: edge.far,
                magnitude,
            })
        };
        Distortions {
            size,
            map: owners.iter().enumerate().map(sample).collect(),
        }
    }

    /// At a place in the picture.
    pub fn at(&self, u: f64, v: f64) -> Option<&Distortion> {
        let [w, h] = self.size.map(f64::from);
        let inside = (0.0..w).contains(&u) && (0.0..h).contains(&v);
        let index = || v as usize * self.size[0] as usize + u as usize;
        inside.then(|| self.map.get(index())?.as_ref()).flatten()
    }
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Equation 1: d_f at a signed distance x from the discontinuity, positive on the side of the background; 0 from r/α on.
pub(super) fn magnitude(x: f64, r: f64, asymmetry: f64) -> f64 {
    (r - (x + r) / (1.0 + 1.0 / asymmetry)).max(0.0)
}
