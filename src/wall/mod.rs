//! Measures a wall of panels from photos of coded tags that they show: where each panel is, and how bright.
//!
//! `pattern` lays out the tags (AprilTag, found by its own library), `photo` finds them, `fit` and `light` solve for places and brightness, `written` puts the
//! result into the description of the wall.
#![forbid(unsafe_code)]

mod codes;
mod error;
mod fit;
mod homography;
mod light;
mod pattern;
mod photo;
mod written;

pub use error::WallError;
pub use fit::{Fit, fit};
pub use pattern::pattern;
pub use written::written;
