//! Amplitude and phase as a complex number: x is real, y imaginary.
#![forbid(unsafe_code)]

use glam::DVec2;
use std::f64::consts::TAU;

/// Amplitude and phase. [`DVec2::rotate`] multiplies.
pub(super) type Complex = DVec2;

/// Of amplitude 1 and this phase in turns.
pub(super) fn turn(turns: f64) -> Complex {
    let (sin, cos) = (TAU * turns).sin_cos();
    DVec2::new(cos, sin)
}

/// The phase in turns, -1/2 to 1/2.
pub(super) fn argument(z: Complex) -> f64 {
    z.y.atan2(z.x) / TAU
}

pub(super) fn conjugate(z: Complex) -> Complex {
    DVec2::new(z.x, -z.y)
}
