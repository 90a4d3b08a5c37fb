//! The occlusion camera: projection by bent rays, its reference image, and views of that.
//!
//! Popescu et al., section V (Equation 2) and VI: the distortion of each sample is kept beside it, since it cannot be told from where the sample
//! has come to lie.

use super::warp::{Seen, View, excess, finish};
use super::{Distortions, Shift};

/// A vertex as the undistorted camera projects it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// (u_u, v_u), in pixels.
    pub at: [f64; 2],
    /// 1/w.
    pub inverse: f64,
    /// Red, green and blue, 0 to 255.
    pub colour: [f64; 3],
}

/// Three of them, in either direction.
pub type Triangle = [Vertex; 3];

/// A sample of the reference image.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sample {
    inverse: f64,
    colour: [f64; 3],
    /// The distortion vector, in pixels.
    moved: [f64; 2],
}

/// A projected vertex.
#[derive(Clone, Copy, Debug)]
struct Projected {
    at: [f64; 2],
    sample: Sample,
}

/// A single-layer picture of what is seen, and of what is about to be seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    size: [u32; 2],
    samples: Vec<Option<Sample>>,
}

impl Reference {
    /// Nothing yet.
    pub fn new(size: [u32; 2]) -> Reference {
        Reference {
            size,
            samples: vec![None; size[0] as usize * size[1] as usize],
        }
    }

    /// Draws triangles through the bent rays. They are cut until no edge is longer than `longest` pixels, which has to be above 0.
    pub fn draw(
        &mut self,
        triangles: impl IntoIterator<Item = Triangle>,
        distortions: &Distortions,
        longest: f64,
    ) {
        let mut all: Vec<Triangle> = triangles.into_iter().collect();
        while let Some(triangle) = all.pop() {
            match halves(&triangle, longest) {
                Some(halves) => all.extend(halves),
                None => self.rasterise(triangle.map(|v| project(&v, distortions))),
            }
        }
    }

    fn rasterise(&mut self, triangle: [Projected; 3]) {
        let size = self.size;
        raster(size, triangle.map(|v| v.at), |index, weights| {
            let mix = |f: &dyn Fn(&Sample) -> f64| {
                let parts = triangle.iter().zip(weights);
                parts.map(|(v, weight)| f(&v.sample) * weight).sum::<f64>()
            };
            let sample = Sample {
                inverse: mix(&|s| s.inverse),
                colour: [0, 1, 2].map(|i| mix(&|s| s.colour[i])),
                moved: [0, 1].map(|i| mix(&|s| s.moved[i])),
            };
            if let Some(old) = self.samples.get_mut(index)
                && old.is_none_or(|old| sample.inverse > old.inverse)
            {
                *old = Some(sample);
            }
        });
    }

    /// The picture as it is, with the depths; what is empty is black and infinitely far.
    pub fn picture(&self) -> View {
        finish(self.size, self.samples.iter().map(seen).collect(), false)
    }

    /// 1/w by pixel, rows from the top.
    pub fn inverses(&self) -> Vec<f32> {
        let all = self.samples.iter();
        all.map(|s| s.map_or(0.0, |s| s.inverse as f32)).collect()
    }

    /// What a camera beside that of the picture sees of it: the mesh of its samples. Samples of different surfaces are not joined;
    /// `threshold` is that of [`super::Edges::of`].
    pub fn view(&self, shift: &Shift, threshold: f64) -> View {
        let [w, h] = self.size.map(|side| side as usize);
        let place = |x: usize, y: usize| {
            let sample = (*self.samples.get(y * w + x)?)?;
            let across = shift.pixels(sample.inverse, self.size[0]);
            let at = [
                x as f64 + 0.5 - sample.moved[0] + across,
                y as f64 + 0.5 - sample.moved[1],
            ];
            Some(Projected { at, sample })
        };
        let inverses = self.inverses();
        let torn = |values: &[f32], at: usize| excess(values, at) > threshold;
        let rows: Vec<bool> = inverses
            .chunks(w.max(1))
            .flat_map(|row| (0..w).map(|x| torn(row, x)))
            .collect();
        let columns: Vec<Vec<bool>> = (0..w)
            .map(|x| {
                let column: Vec<f32> = (0..h).map(|y| inverses[y * w + x]).collect();
                (0..h).map(|y| torn(&column, y)).collect()
            })
            .collect();
        let mut view = Reference::new(self.size);
        for y in 0..h {
            for x in 0..w {
                let Some(own) = place(x, y) else {
                    continue;
                };
                // As far as half a pixel around a sample there is always what it is of.
                let corner = |dx: f64, dy: f64| Projected {
                    at: [own.at[0] + dx, own.at[1] + dy],
                    ..own
                };
                let square = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
                let [a, b, c, d] = square.map(|(dx, dy)| corner(dx, dy));
                view.rasterise([a, b, c]);
                view.rasterise([a, c, d]);
                if x + 1 >= w || y + 1 >= h {
                    continue;
                }
                let cut =
                    rows[y * w + x] || rows[(y + 1) * w + x] || columns[x][y] || columns[x + 1][y];
                if let (false, Some(right), Some(below), Some(across)) =
                    (cut, place(x + 1, y), place(x, y + 1), place(x + 1, y + 1))
                {
                    view.rasterise([own, right, across]);
                    view.rasterise([own, across, below]);
                }
            }
        }
        finish(view.size, view.samples.iter().map(seen).collect(), true)
    }
}

/// Equation 2.
fn project(vertex: &Vertex, distortions: &Distortions) -> Projected {
    let [u, v] = vertex.at;
    let moved = distortions.at(u, v).map_or([0.0; 2], |distortion| {
        let by = distortion.at(vertex.inverse);
        distortion.direction.map(|part| part * by)
    });
    Projected {
        at: [u + moved[0], v + moved[1]],
        sample: Sample {
            inverse: vertex.inverse,
            colour: vertex.colour,
            moved,
        },
    }
}

/// Cut across the longest edge, if that is longer than asked for.
fn halves(triangle: &Triangle, longest: f64) -> Option<[Triangle; 2]> {
    let length = |a: &Vertex, b: &Vertex| (a.at[0] - b.at[0]).hypot(a.at[1] - b.at[1]);
    let [a, b, c] = triangle;
    let turned = [[*a, *b, *c], [*b, *c, *a], [*c, *a, *b]];
    let by_length =
        |t: &&Triangle, o: &&Triangle| length(&t[0], &t[1]).total_cmp(&length(&o[0], &o[1]));
    let [a, b, c] = *turned.iter().max_by(by_length)?;
    if length(&a, &b) <= longest || !length(&a, &b).is_finite() {
        return None;
    }
    // 1/w is a straight line over the picture, colours are one over the surface.
    let inverse = (a.inverse + b.inverse) / 2.0;
    let share = match inverse > 0.0 {
        true => a.inverse / (2.0 * inverse),
        false => 0.5,
    };
    let middle = Vertex {
        at: [0, 1].map(|i| (a.at[i] + b.at[i]) / 2.0),
        inverse,
        colour: [0, 1, 2].map(|i| a.colour[i] * share + b.colour[i] * (1.0 - share)),
    };
    Some([[a, middle, c], [middle, b, c]])
}

fn seen(sample: &Option<Sample>) -> Seen {
    let sample = (*sample)?;
    let colour = sample.colour.map(|v| v.round().clamp(0.0, 255.0) as u8);
    Some((sample.inverse, colour))
}

/// Calls for each pixel whose centre a triangle covers, with the weights of its corners.
fn raster([w, h]: [u32; 2], corners: [[f64; 2]; 3], mut pixel: impl FnMut(usize, [f64; 3])) {
    let side = |a: [f64; 2], b: [f64; 2], p: [f64; 2]| {
        (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
    };
    let [a, b, c] = corners;
    let area = side(a, b, c);
    if !area.is_normal() {
        return;
    }
    let range = |i: usize, end: u32| {
        let (low, high) = (a[i].min(b[i]).min(c[i]), a[i].max(b[i]).max(c[i]));
        (low - 0.5).ceil().max(0.0) as u32..((high + 0.5).floor().max(0.0) as u32).min(end)
    };
    for y in range(1, h) {
        for x in range(0, w) {
            let p = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            let weights = [side(b, c, p), side(c, a, p), side(a, b, p)].map(|v| v / area);
            if weights.iter().all(|&weight| weight >= -1e-9) {
                pixel(y as usize * w as usize + x as usize, weights);
            }
        }
    }
}
