//! The mesh of a picture's samples, and the pictures that other cameras see of it.
//!
//! Popescu et al., section VI: samples are joined to their neighbours; each lies where an undistorted ray would see it. A depth image is a
//! reference image whose rays are straight.

use super::occlusion::Sample;
use super::warp::{View, excess, finish};
use super::{DepthImage, Distortions, Motion, Reference, Shift, Triangle, Vertex};

/// Greatest length in pixels of a margin that reaches half of the way to the next pixel. One that reaches all of the way may be twice as long.
const WIDEST: f64 = 6.0;

impl From<&DepthImage> for Reference {
    fn from(image: &DepthImage) -> Reference {
        let rows = 0..image.size()[1];
        let pixels = rows.flat_map(|y| image.colours(y).iter().zip(image.inverses(y)));
        let sample = |(colour, inverse): (&[u8; 3], &f32)| {
            (*inverse >= 0.0).then(|| Sample {
                inverse: f64::from(*inverse),
                colour: colour.map(f64::from),
                moved: [0.0; 2],
                slopes: None,
            })
        };
        Reference {
            size: image.size(),
            samples: pixels.map(sample).collect(),
        }
    }
}

impl Reference {
    /// From samples by pixel, rows from the top. Each lies where the undistorted camera projects it.
    pub fn of(size: [u32; 2], samples: impl IntoIterator<Item = Option<Vertex>>) -> Reference {
        let mut image = Reference::new(size);
        let width = size[0].max(1) as usize;
        for (at, (own, sample)) in image.samples.iter_mut().zip(samples).enumerate() {
            let centre = [at % width, at / width].map(|i| i as f64 + 0.5);
            *own = sample.map(|vertex| Sample {
                inverse: vertex.inverse,
                colour: vertex.colour,
                moved: [0, 1].map(|i| centre[i] - vertex.at[i]),
                slopes: None,
            });
        }
        image
    }

    /// Columns and rows.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The samples by pixel, rows from the top. Each lies where the undistorted camera projects it. The flags say whether it belongs to the same
    /// surface as the next sample of its row, and of its column; `threshold` is that of [`super::Edges::of`].
    pub fn joined(&self, threshold: f64) -> impl Iterator<Item = Option<(Vertex, [bool; 2])>> {
        let [width, height] = self.size.map(|side| side as usize);
        let joints = Joints::of(self, threshold);
        (0..width * height).map(move |at| {
            let vertex = self.undistorted(at % width, at / width)?;
            Some((vertex, [joints.across[at], joints.down[at]]))
        })
    }

    /// Colours and depths by pixel, without the distortion vectors.
    pub fn depth_image(&self) -> DepthImage {
        let colours = self.all_seen().into_iter();
        let colours = colours.map(|seen| seen.map_or([0; 3], |(_, colour)| colour));
        let depths = self.samples.iter();
        let depths = depths.map(|s| s.map_or(f32::NAN, |s| s.inverse as f32));
        DepthImage::of(self.size, colours.collect(), depths)
    }

    /// The view of a camera beside that of the picture, holes filled; `threshold` is that of [`super::Edges::of`].
    pub fn view(&self, shift: &Shift, threshold: f64) -> View {
        let seen = self.seen(self.size, &Motion::beside(shift, self.size[0]), threshold);
        finish(self.size, seen.all_seen(), true)
    }

    /// Draws the mesh of the samples for another camera, in a picture of the same size.
    pub fn seen(&self, size: [u32; 2], motion: &Motion, threshold: f64) -> Reference {
        let mut seen = Reference::new(size);
        let moved = self.mesh(threshold).filter_map(|[a, b, c]| {
            Some([motion.apply(&a)?, motion.apply(&b)?, motion.apply(&c)?])
        });
        seen.draw(moved, &Distortions::none(size), f64::INFINITY);
        seen
    }

    /// The triangles between the samples, each of which lies where the undistorted camera projects it. Samples of different surfaces are not joined.
    /// Around a sample its surface always extends by half a pixel of this picture, or by a whole one where it continues behind its neighbour.
    pub fn mesh(&self, threshold: f64) -> impl Iterator<Item = Triangle> {
        let [w, h] = self.size.map(|side| side as usize);
        let joints = Joints::of(self, threshold);
        (0..h).flat_map(move |y| {
            let mut triangles = Vec::new();
            for x in 0..w {
                let Some(own) = self.undistorted(x, y) else {
                    continue;
                };
                let cell = joints.cell(x, y);
                let inner = x > 0
                    && y > 0
                    && joints.cell(x - 1, y - 1)
                    && joints.cell(x, y - 1)
                    && joints.cell(x - 1, y);
                if !(cell && inner) {
                    let [left, right] =
                        [-1, 1].map(|side| self.margin(&own, [x, y], [side, 0], &joints.across));
                    let [up, down] =
                        [-1, 1].map(|side| self.margin(&own, [x, y], [0, side], &joints.down));
                    let around = [(left, up), (right, up), (right, down), (left, down)];
                    let [a, b, c, d] = around.map(|(across, along)| Vertex {
                        at: [0, 1].map(|i| own.at[i] + across.at[i] + along.at[i]),
                        inverse: own.inverse + across.inverse + along.inverse,
                        ..own
                    });
                    triangles.extend([[own, a, b], [own, b, c], [own, c, d], [own, d, a]]);
                }
                self.cell(&joints, [x, y], &mut triangles);
            }
            triangles
        })
    }

    /// The triangles between a sample and those to its right, below it and diagonally opposite: two where all four belong to one surface, else one
    /// for each corner whose two sides do.
    fn cell(&self, joints: &Joints, [x, y]: [usize; 2], out: &mut Vec<Triangle>) {
        let [w, h] = self.size.map(|side| side as usize);
        if x + 1 >= w || y + 1 >= h {
            return;
        }
        let sample = |dx: usize, dy: usize| self.undistorted(x + dx, y + dy);
        let [own, right, across, under] = [sample(0, 0), sample(1, 0), sample(1, 1), sample(0, 1)];
        let at = y * w + x;
        let [top, left] = [joints.across[at], joints.down[at]];
        let [bottom, far] = [joints.across[at + w], joints.down[at + 1]];
        let whole = top && left && bottom && far;
        let corners = [
            (top && far, [own, right, across]),
            (bottom && left, [own, across, under]),
            (top && left && !whole, [own, right, under]),
            (bottom && far && !whole, [right, across, under]),
        ];
        for (joined, corners) in corners {
            if let (true, [Some(a), Some(b), Some(c)]) = (joined, corners) {
                out.push([a, b, c]);
            }
        }
    }

    /// How far the surface of a sample extends to one side, which is a step to a neighbouring pixel. It extends half of the way to a neighbour that
    /// is joined to it. Else it extends half a step along its own slope, taken from the neighbour on the other side or from the triangle of the
    /// sample. A surface that lies behind that of the next pixel does not end between the two, so it extends all of the way.
    fn margin(&self, own: &Vertex, at: [usize; 2], side: [isize; 2], joined: &[bool]) -> Margin {
        let neighbour = |sign: isize| {
            let x = at[0].checked_add_signed(sign * side[0])?;
            let y = at[1].checked_add_signed(sign * side[1])?;
            let first = at[1].min(y) * self.size[0] as usize + at[0].min(x);
            let inside = x < self.size[0] as usize;
            let vertex = inside.then(|| self.undistorted(x, y)).flatten()?;
            Some((vertex, joined.get(first) == Some(&true)))
        };
        let towards = |other: &Vertex, share: f64| Margin {
            at: [0, 1].map(|i| (other.at[i] - own.at[i]) * share),
            inverse: (other.inverse - own.inverse) * share,
        };
        let next = neighbour(1);
        if let Some((next, true)) = &next {
            return towards(next, 0.5);
        }
        let behind = next.is_some_and(|(next, _)| next.inverse > own.inverse);
        let share = if behind { 1.0 } else { 0.5 };
        let margin = neighbour(-1)
            .filter(|(_, joined)| *joined)
            .map(|(before, _)| towards(&before, -share));
        // A neighbour whose ray goes somewhere else entirely says nothing of the slope.
        let near = |margin: &Margin| margin.at[0].hypot(margin.at[1]) <= 2.0 * share * WIDEST;
        let margin = margin.filter(near);
        let own = || self.slope(at, side, share).filter(near);
        margin.or_else(own).unwrap_or(Margin {
            at: side.map(|step| step as f64 * share),
            inverse: 0.0,
        })
    }

    /// A share of the way to the next pixel on a side, along the triangle that the sample belongs to.
    fn slope(&self, at: [usize; 2], side: [isize; 2], share: f64) -> Option<Margin> {
        let index = at[1] * self.size[0] as usize + at[0];
        let slopes = self.samples.get(index).copied().flatten()?.slopes?;
        let [x, y] = side.map(|step| step as f64 * share);
        let [inverse, u, v] = [0, 1, 2].map(|i| x * slopes[0][i] + y * slopes[1][i]);
        let at = [x - u, y - v];
        Some(Margin { at, inverse })
    }

    /// A sample where the undistorted camera projects it: (u_d − δ_u, v_d − δ_v).
    fn undistorted(&self, x: usize, y: usize) -> Option<Vertex> {
        let sample = (*self.samples.get(y * self.size[0] as usize + x)?)?;
        Some(Vertex {
            at: [
                x as f64 + 0.5 - sample.moved[0],
                y as f64 + 0.5 - sample.moved[1],
            ],
            inverse: sample.inverse,
            colour: sample.colour,
        })
    }
}

/// The way from a sample to the end of its surface.
#[derive(Clone, Copy)]
struct Margin {
    at: [f64; 2],
    /// Growth of 1/w on the way.
    inverse: f64,
}

/// Which neighbours belong to one surface.
struct Joints {
    width: usize,
    /// A pixel and the next of its row.
    across: Vec<bool>,
    /// A pixel and the next of its column.
    down: Vec<bool>,
}

impl Joints {
    fn of(image: &Reference, threshold: f64) -> Joints {
        let [w, h] = image.size.map(|side| side as usize);
        let inverses = image.inverses();
        let drawn = |at: usize| image.samples.get(at).is_some_and(Option::is_some);
        let mut joints = Joints {
            width: w,
            across: vec![false; w * h],
            down: vec![false; w * h],
        };
        // Two samples that the undistorted camera sees in another order have something else between them.
        let order = |first: usize, next: usize, side: usize| {
            let moved = |at: usize| image.samples[at].map_or(0.0, |s| s.moved[side]);
            drawn(first) && drawn(next) && moved(next) - moved(first) < 1.0
        };
        // By how much the sample of each misses the plane of the other's triangle: 0 for one surface, even where its step changes.
        let parted = |first: usize, next: usize, side: usize| {
            let [a, b] = [image.samples[first]?, image.samples[next]?];
            let off = |slopes: [[f64; 3]; 2]| (b.inverse - a.inverse - slopes[side][0]).abs();
            Some(off(a.slopes?).max(off(b.slopes?)))
        };
        let alike = |first: usize, next: usize, side: usize, excess: f64| {
            excess <= threshold || parted(first, next, side).is_some_and(|by| by <= threshold)
        };
        for (y, row) in inverses.chunks(w.max(1)).enumerate() {
            for x in 1..w {
                let at = y * w + x - 1;
                joints.across[at] =
                    order(at, at + 1, 0) && alike(at, at + 1, 0, excess(row, x - 1));
            }
        }
        for x in 0..w {
            let column: Vec<f32> = (0..h).map(|y| inverses[y * w + x]).collect();
            for y in 1..h {
                let at = (y - 1) * w + x;
                joints.down[at] =
                    order(at, at + w, 1) && alike(at, at + w, 1, excess(&column, y - 1));
            }
        }
        joints
    }

    /// Whether a pixel and those to its right, below it and diagonally opposite belong to one surface.
    fn cell(&self, x: usize, y: usize) -> bool {
        let at = y * self.width + x;
        let next = |all: &[bool], at: usize| all.get(at) == Some(&true);
        x + 1 < self.width
            && next(&self.across, at)
            && next(&self.down, at)
            && next(&self.across, at + self.width)
            && next(&self.down, at + 1)
    }
}
