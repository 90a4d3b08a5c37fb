//! Splats: points of surfaces as small disks, which the ray of any subpixel can be intersected with, so that points are drawn once for all views.
//!
//! The steps of T. Hübner, Y. Zhang, R. Pajarola, "Multi-view point splatting" (GRAPHITE 2006), in double precision and without GL: the disk and its
//! parameters ([`disk`], Equations 3 to 5), the part of the screen that holds it in all views ([`cover`], Equation 6), groups of splats that do
//! not overlap ([`groups`]), and pictures by deferred blending and by the passes that are usual ([`reference`](mod@reference)). The GPU is compared with these. Equations 7 to
//! 9 are the mask of a panel ([`crate::display`]).
//!
//! Camera space: x to the right, y upwards, z away from the viewer, all in one unit of length; the middle of all eyes is the origin. A place on the
//! screen is a point (x, y) of the focal plane z = ξ, which is in the same place for all eyes.
#![forbid(unsafe_code)]

pub mod cover;
pub mod disk;
pub mod groups;
pub(crate) mod random;
pub mod reference;
#[cfg(test)]
mod tests;

use glam::{DVec2, DVec3};

/// A disk about a point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Splat {
    /// Its middle, in camera space.
    pub centre: DVec3,
    /// Of length 1, to either side.
    pub normal: DVec3,
    /// In units of camera space.
    pub radius: f64,
    /// Red, green and blue, 0 to 1.
    pub colour: [f32; 3],
}

/// Why a splat is left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum Fault {
    /// A number is infinite or none.
    #[error("a number is infinite or none")]
    NotFinite,
    /// The radius is zero or less.
    #[error("the radius is not above zero")]
    NoRadius,
    /// The normal has no direction.
    #[error("the normal has no direction")]
    NoNormal,
}

impl Splat {
    /// A splat with its normal made as long as 1.
    ///
    /// # Errors
    /// It has no place, no size or no direction.
    pub fn new(centre: DVec3, normal: DVec3, radius: f64, colour: [f32; 3]) -> Result<Self, Fault> {
        let finite = centre.is_finite() && normal.is_finite() && radius.is_finite();
        if !finite || colour.iter().any(|value| !value.is_finite()) {
            return Err(Fault::NotFinite);
        }
        if radius <= 0.0 {
            return Err(Fault::NoRadius);
        }
        // Long normals would overflow when they are squared.
        let largest = normal.abs().max_element();
        let direction = (normal / largest).try_normalize();
        let normal = direction.ok_or(Fault::NoNormal)?;
        Ok(Self {
            centre,
            normal,
            radius,
            colour,
        })
    }
}

/// The cameras of all views, in a row along x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eyes {
    /// N.
    pub views: u32,
    /// κ: from one to the next, in units of camera space.
    pub spacing: f64,
    /// ξ: depth of the plane that is in the same place in all views, in units of camera space.
    pub focal: f64,
    /// Nearer than this nothing is seen: a depth above zero.
    pub near: f64,
}

impl Eyes {
    /// The x of a camera: `e_i = (i − (N−1)/2)·κ`.
    #[must_use]
    pub fn offset(&self, view: u32) -> f64 {
        (f64::from(view) - (f64::from(self.views) - 1.0) / 2.0) * self.spacing
    }

    /// The x of the outermost camera (vd in the paper).
    #[must_use]
    pub fn eccentricity(&self) -> f64 {
        self.offset(0).abs()
    }
}

/// A picture on the focal plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screen {
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// Half of its width, in units of camera space.
    pub half: f64,
}

impl Screen {
    /// Side of a pixel, in units of camera space.
    #[must_use]
    pub fn pixel(&self) -> f64 {
        2.0 * self.half / f64::from(self.size.0)
    }

    /// The place of a point of the picture, which is counted in pixels from its upper left corner.
    #[must_use]
    pub fn place(&self, [x, y]: [f64; 2]) -> DVec2 {
        let (width, height) = (f64::from(self.size.0), f64::from(self.size.1));
        DVec2::new(x - width / 2.0, height / 2.0 - y) * self.pixel()
    }
}
