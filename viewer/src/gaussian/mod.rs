//! Gaussians: a surface as a cloud of soft ellipsoids, learned from pictures (B. Kerbl, G. Kopanas, T. Leimkühler, G. Drettakis, "3D Gaussian
//! splatting for real-time radiance field rendering", ACM Transactions on Graphics 42, 2023).

pub mod harmonics;
pub mod reference;
pub mod sort;

use crate::extent::extent;
use glam::{Mat3, Quat, Vec3};

/// Most coefficients of a colour: those of degree 3.
pub const MOST_COEFFICIENTS: usize = 16;

/// An ellipsoid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gaussian {
    /// Its middle, in units of the file.
    pub place: Vec3,
    /// Standard deviations along its axes.
    pub scale: Vec3,
    /// Of its axes.
    pub rotation: Quat,
    /// In its middle, 0 to 1.
    pub opacity: f32,
}

impl Gaussian {
    /// Σ = R S Sᵀ Rᵀ (equation 6).
    #[must_use]
    pub fn covariance(&self) -> Mat3 {
        let axes = Mat3::from_quat(self.rotation) * Mat3::from_diagonal(self.scale);
        axes * axes.transpose()
    }

    /// Whether all of its numbers are finite, and it is somewhere.
    #[must_use]
    pub fn is_seen(&self) -> bool {
        let finite = self.place.is_finite() && self.scale.is_finite() && self.rotation.is_finite();
        finite && self.opacity.is_finite() && self.opacity >= LEAST_ALPHA
    }
}

/// What is fainter is not drawn.
pub const LEAST_ALPHA: f32 = 1.0 / 255.0;
/// Nothing is more opaque.
pub const MOST_ALPHA: f32 = 0.99;
/// What is added to the variance of the picture, in pixels squared, so that nothing is smaller than a pixel.
pub const BLUR: f32 = 0.3;

/// All Gaussians of a file.
#[derive(Clone, Debug, Default)]
pub struct Gaussians {
    /// Without those that are not seen.
    pub all: Vec<Gaussian>,
    /// Coefficients of spherical harmonics of each: red, green and blue.
    pub colours: Vec<Vec3>,
    /// How many a colour has: 1, 4, 9 or 16.
    pub coefficients: usize,
    /// Gaussians of the file that are not here.
    pub skipped: u64,
}

impl Gaussians {
    /// The coefficients of one.
    #[must_use]
    pub fn colour(&self, number: usize) -> &[Vec3] {
        let start = number * self.coefficients;
        self.colours
            .get(start..start + self.coefficients)
            .unwrap_or_default()
    }

    /// The middle and the radius of a ball that holds most of them.
    #[must_use]
    pub fn extent(&self) -> (Vec3, f32) {
        extent(self.all.iter().map(|one| one.place), FAR)
    }
}

/// The share of Gaussians at each end of an axis that may be far away: what stands for the sky is.
const FAR: f32 = 0.05;
