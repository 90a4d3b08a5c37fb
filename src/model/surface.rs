//! Surfaces as grids of corners, of which triangles are made on the fly.

use std::f32::consts::TAU;

/// A corner of triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// In inches.
    pub at: [f32; 3],
    /// Red, green and blue, lit.
    pub colour: [u8; 3],
}

/// A triangle, its corners in either direction.
pub type Solid = [Corner; 3];

/// A place and what the surface reflects there, 0 to 1.
pub(super) type Paint = ([f32; 3], [f32; 3]);

/// Towards the light, of length 1.
const LIGHT: [f32; 3] = [0.36, 0.48, 0.8];
/// Share of ambient light that is reflected.
const AMBIENT: f32 = 0.25;

/// A grid of corners, each cell two triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Corners of a row.
    columns: usize,
    /// Row by row.
    corners: Vec<Corner>,
}

impl Surface {
    /// Of so many cells in both directions; `paint` takes 0 to 1 in both.
    pub fn new(columns: usize, rows: usize, paint: impl Fn(f32, f32) -> Paint) -> Surface {
        let (across, down) = (columns + 1, rows + 1);
        let mut painted = Vec::with_capacity(across * down);
        for row in 0..down {
            let v = row as f32 / rows as f32;
            painted.extend((0..across).map(|column| paint(column as f32 / columns as f32, v)));
        }
        let place = |column: usize, row: usize| painted[row * across + column].0;
        let corner = |index: usize| {
            let (column, row) = (index % across, index / across);
            let (at, albedo) = painted[index];
            let along = minus(
                place((column + 1).min(columns), row),
                place(column.saturating_sub(1), row),
            );
            let under = minus(
                place(column, (row + 1).min(rows)),
                place(column, row.saturating_sub(1)),
            );
            let light = AMBIENT + (1.0 - AMBIENT) * lit(along, under);
            Corner {
                at,
                colour: albedo.map(|part| (part * light * 255.0).round().clamp(0.0, 255.0) as u8),
            }
        };
        Surface {
            columns: across,
            corners: (0..painted.len()).map(corner).collect(),
        }
    }

    /// How many triangles.
    pub fn count(&self) -> usize {
        2 * (self.columns - 1) * (self.corners.len() / self.columns - 1)
    }

    /// All of them, row by row.
    pub fn triangles(&self) -> impl Iterator<Item = Solid> + '_ {
        let rows = self.corners.windows(2 * self.columns).step_by(self.columns);
        rows.flat_map(|pair| {
            let (above, below) = pair.split_at(pair.len() / 2);
            above
                .windows(2)
                .zip(below.windows(2))
                .flat_map(|(a, b)| [[a[0], a[1], b[1]], [a[0], b[1], b[0]]])
        })
    }

    /// The same elsewhere.
    pub(super) fn moved(mut self, place: impl Fn([f32; 3]) -> [f32; 3]) -> Surface {
        for corner in &mut self.corners {
            corner.at = place(corner.at);
        }
        self
    }

    /// From the origin to the farthest corner.
    pub(super) fn reach(&self) -> f32 {
        let lengths = self.corners.iter().map(|corner| length(corner.at));
        lengths.fold(0.0, f32::max)
    }
}

/// Makes surfaces as large as the display allows.
pub(super) fn fitted(surfaces: Vec<Surface>) -> Vec<Surface> {
    let reach = surfaces.iter().map(Surface::reach).fold(0.0, f32::max);
    let scale = 0.98 * super::RADIUS / reach;
    let surfaces = surfaces.into_iter();
    surfaces
        .map(|surface| surface.moved(|at| at.map(|v| v * scale)))
        .collect()
}

/// A closed surface around the origin: six faces of `side`² cells; `paint` takes directions of length 1.
pub(super) fn ball(side: usize, paint: impl Fn([f32; 3]) -> Paint) -> Vec<Surface> {
    let face = |axis: usize, sign: f32| {
        Surface::new(side, side, |u, v| {
            // Equal angles, so that cells are of about one size.
            let flat = [u, v].map(|t| ((t - 0.5) * TAU / 4.0).tan());
            let mut at = [0.0; 3];
            at[axis] = sign;
            at[(axis + 1) % 3] = flat[0];
            at[(axis + 2) % 3] = flat[1];
            paint(unit(at))
        })
    };
    let axes = [0, 1, 2].into_iter();
    axes.flat_map(|axis| [face(axis, 1.0), face(axis, -1.0)])
        .collect()
}

/// A tube along a path, its ends round and closed: so many cells around and along; `aside` is a direction that the path never takes; `path`
/// takes 0 to 1; `paint` takes the angle, the way along the path and the place, to return the radius and the colour.
pub(super) fn tube(
    cells: [usize; 2],
    aside: [f32; 3],
    path: impl Fn(f32) -> [f32; 3],
    paint: impl Fn(f32, f32, [f32; 3]) -> (f32, [f32; 3]),
) -> Surface {
    ring(cells, aside, path, |angle, t, middle| {
        let (radius, colour) = paint(angle, t, middle);
        (radius * (4.0 * t * (1.0 - t)).max(0.0).powf(0.25), colour)
    })
}

/// The same along a path that ends where it began.
pub(super) fn ring(
    [around, along]: [usize; 2],
    aside: [f32; 3],
    path: impl Fn(f32) -> [f32; 3],
    paint: impl Fn(f32, f32, [f32; 3]) -> (f32, [f32; 3]),
) -> Surface {
    Surface::new(around, along, |u, t| {
        let (angle, middle) = (u * TAU, path(t));
        let ahead = unit(minus(path(t + 1e-3), path(t - 1e-3)));
        let side = unit(cross(ahead, aside));
        let up = cross(side, ahead);
        let (radius, colour) = paint(angle, t, middle);
        let (sin, cos) = angle.sin_cos();
        let at = [0, 1, 2].map(|i| middle[i] + radius * (cos * side[i] + sin * up[i]));
        (at, colour)
    })
}

/// A box of six plain faces, from its lowest to its highest corner.
pub(super) fn cuboid(low: [f32; 3], high: [f32; 3], colour: [f32; 3]) -> Vec<Surface> {
    let face = |axis: usize, side: f32| {
        Surface::new(1, 1, |u, v| {
            let mut at = [0.0; 3];
            for (i, t) in [side, u, v].into_iter().enumerate() {
                let i = (axis + i) % 3;
                at[i] = low[i] + (high[i] - low[i]) * t;
            }
            (at, colour)
        })
    };
    let axes = [0, 1, 2].into_iter();
    axes.flat_map(|axis| [face(axis, 0.0), face(axis, 1.0)])
        .collect()
}

/// Cosine between the light and the normal of two directions, from whichever side.
fn lit(along: [f32; 3], under: [f32; 3]) -> f32 {
    let normal = unit(cross(along, under));
    dot(normal, LIGHT).abs()
}

pub(super) fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub(super) fn minus(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [0, 1, 2].map(|i| a[i] - b[i])
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [0, 1, 2].map(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
}

fn length(v: [f32; 3]) -> f32 {
    dot(v, v).sqrt()
}

/// Of length 1, if it has a length.
pub(super) fn unit(v: [f32; 3]) -> [f32; 3] {
    let length = length(v).max(1e-12);
    v.map(|part| part / length)
}
