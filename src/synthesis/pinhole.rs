//! Planar pinhole cameras: projection of points and unprojection of samples.
//!
//! Popescu et al., sections V and VI: PPHC_0, and the unprojection of its images.

use super::{Shift, Vertex};

/// A camera that looks along −z. Points and the eye are in inches, x to the right, y upwards; the picture is in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pinhole {
    /// The point where all rays meet.
    pub eye: [f64; 3],
    /// Distance from the eye to the picture, in pixels.
    pub focal: f64,
    /// The principal point: where the ray along −z meets the picture.
    pub centre: [f64; 2],
}

impl Pinhole {
    /// Looks from `eye` through a window in the plane z = 0, whose size is in pixels and whose centre is the origin; `scale` is in pixels per inch.
    /// A point in that plane has the same place for every eye, as on a display.
    pub fn through(window: [u32; 2], scale: f64, eye: [f64; 3]) -> Pinhole {
        let [w, h] = window.map(|side| f64::from(side) / 2.0);
        Pinhole {
            eye,
            focal: scale * eye[2],
            centre: [w + scale * eye[0], h - scale * eye[1]],
        }
    }

    /// The place of a point in the picture, and its 1/w; w is the distance along −z. None behind the eye.
    pub fn project(&self, point: [f64; 3]) -> Option<([f64; 2], f64)> {
        let [x, y, z] = [0, 1, 2].map(|i| point[i] - self.eye[i]);
        let inverse = -1.0 / z;
        let far = self.focal * inverse;
        (inverse > 0.0).then_some((
            [self.centre[0] + far * x, self.centre[1] - far * y],
            inverse,
        ))
    }

    /// The point that is seen at a place with this 1/w, which must not be 0.
    pub fn unproject(&self, at: [f64; 2], inverse: f64) -> [f64; 3] {
        let near = 1.0 / (self.focal * inverse);
        [
            self.eye[0] + (at[0] - self.centre[0]) * near,
            self.eye[1] - (at[1] - self.centre[1]) * near,
            self.eye[2] - 1.0 / inverse,
        ]
    }

    /// How samples move from the picture of this camera to that of another one.
    pub fn to(&self, other: &Pinhole) -> Motion {
        let scale = other.focal / self.focal;
        let [x, y, z] = [0, 1, 2].map(|i| self.eye[i] - other.eye[i]);
        let by = [x, -y];
        Motion {
            scale,
            offset: [0, 1].map(|i| -self.centre[i] * scale),
            by_inverse: by.map(|part| part * other.focal),
            centre: other.centre,
            nearer: -z,
        }
    }
}

/// Takes places and 1/w in the picture of one camera to those in the picture of another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    scale: f64,
    offset: [f64; 2],
    by_inverse: [f64; 2],
    centre: [f64; 2],
    /// Growth of w.
    nearer: f64,
}

impl Motion {
    /// To a camera beside that of the picture, which is `width` pixels wide.
    pub fn beside(shift: &Shift, width: u32) -> Motion {
        let still = shift.pixels(0.0, width);
        Motion {
            scale: 1.0,
            offset: [still, 0.0],
            by_inverse: [shift.pixels(1.0, width) - still, 0.0],
            centre: [0.0; 2],
            nearer: 0.0,
        }
    }

    /// The vertex in the other picture. None behind that camera.
    pub fn apply(&self, vertex: &Vertex) -> Option<Vertex> {
        let share = 1.0 / (1.0 + self.nearer * vertex.inverse);
        let at = [0, 1].map(|i| {
            let straight = self.scale * vertex.at[i] + self.offset[i];
            self.centre[i] + (straight + self.by_inverse[i] * vertex.inverse) * share
        });
        (share > 0.0).then_some(Vertex {
            at,
            inverse: vertex.inverse * share,
            ..*vertex
        })
    }
}
