//! Triangles in inches as a camera sees them, and its samples back in inches.

use super::{Corner, Solid};
use crate::synthesis::{Pinhole, Triangle, Vertex};

/// As a camera sees it; none if a corner is behind.
#[must_use]
pub fn project(camera: &Pinhole, solid: &Solid) -> Option<Triangle> {
    let vertex = |corner: &Corner| {
        let (at, inverse) = camera.project(corner.at.map(f64::from))?;
        Some(Vertex {
            at,
            inverse,
            colour: corner.colour.map(f64::from),
        })
    };
    let [a, b, c] = solid;
    Some([vertex(a)?, vertex(b)?, vertex(c)?])
}

/// Where it is; `triangle` is one of [`crate::synthesis::Reference::mesh`], of a picture of this camera. None if a corner is infinitely far.
#[must_use]
pub fn unproject(camera: &Pinhole, triangle: &Triangle) -> Option<Solid> {
    let corner = |vertex: &Vertex| {
        (vertex.inverse > 0.0).then(|| Corner {
            at: camera
                .unproject(vertex.at, vertex.inverse)
                .map(|part| part as f32),
            colour: vertex
                .colour
                .map(|part| part.round().clamp(0.0, 255.0) as u8),
        })
    };
    let [a, b, c] = triangle;
    Some([corner(a)?, corner(b)?, corner(c)?])
}
