//! The occlusion camera: projection by distorted rays, and its reference image.
//!
//! Popescu et al., sections V (Equation 2) and VI: each sample keeps its distortion vector, which its place in the reference image does not tell.

use super::Distortions;
use super::raster::raster;
use super::warp::{Seen, View, finish};
use std::cell::LazyCell;

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

/// Three vertices, in either winding.
pub type Triangle = [Vertex; 3];

/// A sample of the reference image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sample {
    /// 1/w.
    pub(super) inverse: f64,
    /// Red, green and blue, 0 to 255.
    pub(super) colour: [f64; 3],
    /// The distortion vector, in pixels.
    pub(super) moved: [f64; 2],
    /// Of the triangle that drew the sample: changes of 1/w and of the two parts of the vector, to the next column and to the next row. None where it
    /// was not drawn.
    pub(super) slopes: Option<[[f64; 3]; 2]>,
}

/// A vertex as the occlusion camera projects it.
#[derive(Clone, Copy, Debug)]
struct Projected {
    at: [f64; 2],
    sample: Sample,
}

/// The reference image: a single layer of samples that are seen, and of hidden ones that neighbouring viewpoints are about to see.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    pub(super) size: [u32; 2],
    pub(super) samples: Vec<Option<Sample>>,
}

impl Reference {
    /// An empty image.
    pub fn new(size: [u32; 2]) -> Reference {
        Reference {
            size,
            samples: vec![None; size[0] as usize * size[1] as usize],
        }
    }

    /// Draws triangles through the distorted rays, whose map may belong to a picture of another size. Triangles are subdivided until no edge is
    /// longer than `longest` pixels, which has to be above 0.
    pub fn draw(
        &mut self,
        triangles: impl IntoIterator<Item = Triangle>,
        distortions: &Distortions,
        longest: f64,
    ) {
        let mut parts = Vec::new();
        for triangle in triangles {
            parts.push(triangle);
            while let Some(part) = parts.pop() {
                match halves(&part, longest) {
                    Some(halves) => parts.extend(halves),
                    None => self.rasterise(part.map(|v| project(self.size, &v, distortions))),
                }
            }
        }
    }

    fn rasterise(&mut self, triangle: [Projected; 3]) {
        let size = self.size;
        let slopes = LazyCell::new(|| slopes(&triangle));
        raster(size, triangle.map(|v| v.at), |index, weights| {
            let mix = |f: &dyn Fn(&Sample) -> f64| {
                let parts = triangle.iter().zip(weights);
                parts.map(|(v, weight)| f(&v.sample) * weight).sum::<f64>()
            };
            let inverse = mix(&|s| s.inverse);
            if let Some(old) = self.samples.get_mut(index)
                && old.is_none_or(|old| inverse > old.inverse)
            {
                *old = Some(Sample {
                    inverse,
                    colour: [0, 1, 2].map(|i| mix(&|s| s.colour[i])),
                    moved: [0, 1].map(|i| mix(&|s| s.moved[i])),
                    slopes: *slopes,
                });
            }
        });
    }

    /// The picture as it is: empty pixels are black, and holes.
    pub fn picture(&self) -> View {
        finish(self.size, self.all_seen(), false)
    }

    pub(super) fn all_seen(&self) -> Vec<Seen> {
        self.samples.iter().map(seen).collect()
    }

    /// 1/w by pixel, rows from the top; 0 where nothing was drawn.
    pub fn inverses(&self) -> Vec<f32> {
        let all = self.samples.iter();
        all.map(|s| s.map_or(0.0, |s| s.inverse as f32)).collect()
    }
}

/// Slopes of 1/w and of the distortion vector over a triangle, as in [`Sample::slopes`]. None if it has no area.
fn slopes([a, b, c]: &[Projected; 3]) -> Option<[[f64; 3]; 2]> {
    let values = |v: &Projected| [v.sample.inverse, v.sample.moved[0], v.sample.moved[1]];
    let side = |v: &Projected| [0, 1].map(|i| v.at[i] - a.at[i]);
    let rise = |v: &Projected| [0, 1, 2].map(|i| values(v)[i] - values(a)[i]);
    let ([p, q], [f, g]) = ([side(b), side(c)], [rise(b), rise(c)]);
    let area = p[0] * q[1] - p[1] * q[0];
    area.is_normal().then(|| {
        [
            [0, 1, 2].map(|i| (f[i] * q[1] - g[i] * p[1]) / area),
            [0, 1, 2].map(|i| (g[i] * p[0] - f[i] * q[0]) / area),
        ]
    })
}

/// Equation 2, with another d(z): see [`super::Distortion::at`].
fn project(size: [u32; 2], vertex: &Vertex, distortions: &Distortions) -> Projected {
    let [u, v] = vertex.at;
    let moved = distortions.vector(size, vertex.at, vertex.inverse);
    Projected {
        at: [u + moved[0], v + moved[1]],
        sample: Sample {
            inverse: vertex.inverse,
            colour: vertex.colour,
            moved,
            slopes: None,
        },
    }
}

/// Cuts a triangle in two across its longest edge. None if no edge is longer than `longest`.
fn halves(triangle: &Triangle, longest: f64) -> Option<[Triangle; 2]> {
    let square = |a: &Vertex, b: &Vertex| {
        let [u, v] = [0, 1].map(|i| a.at[i] - b.at[i]);
        u * u + v * v
    };
    let [a, b, c] = triangle;
    let squares = [square(a, b), square(b, c), square(c, a)];
    let most = squares[0].max(squares[1]).max(squares[2]);
    if most <= longest * longest || !most.is_finite() {
        return None;
    }
    let [a, b, c] = match squares {
        [first, _, _] if first == most => [*a, *b, *c],
        [_, second, _] if second == most => [*b, *c, *a],
        _ => [*c, *a, *b],
    };
    // 1/w is linear over the picture, colours are linear over the surface.
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
