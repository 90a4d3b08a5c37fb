//! Errors of a simulation, in one sentence each.
#![forbid(unsafe_code)]

use super::MAX_EYES;

/// Why there is nothing to see.
#[derive(Debug, thiserror::Error)]
pub enum SimulateError {
    /// A mask says which view, but not why.
    #[error(
        "display `{name}` is a picture of a mask, which says nothing of lenses; \
         describe the panel as kind = \"slanted\" to simulate it"
    )]
    NoOptics {
        /// Of the display.
        name: String,
    },
    /// Lenses that could not tell two subpixels apart.
    #[error(
        "display `{name}` has lenses {period} subpixels wide; give a pitch of at least 1 to simulate it"
    )]
    Narrow {
        /// Of the display.
        name: String,
        /// Subpixels.
        period: f64,
    },
    /// Behind the panel, or inside its optics.
    #[error(
        "{what} is {z} mm before the panel, but its optics need at least {least:.1} mm; \
         give a larger Z, which is counted from the panel towards the viewer"
    )]
    TooNear {
        /// The eye or the distance of design.
        what: &'static str,
        /// Millimetres.
        z: f64,
        /// Millimetres.
        least: f64,
    },
    /// No pixels.
    #[error("the panel's picture has no pixels; give one of the panel's size")]
    Empty,
    /// More eyes than a picture has room for, or none.
    #[error("a strip of {eyes} eyes cannot be made; give 1 to {MAX_EYES}")]
    Eyes {
        /// As asked for.
        eyes: u32,
    },
    /// An option that is no number, or one out of its range.
    #[error("--{flag} is '{found}'; give {expected}")]
    Option {
        /// The option without its dashes.
        flag: &'static str,
        /// As written.
        found: String,
        /// What it should be.
        expected: &'static str,
    },
    /// The panel's picture.
    #[error("--in {file} cannot be used: {reason}")]
    Picture {
        /// As written.
        file: String,
        /// With the remedy.
        reason: String,
    },
    /// The result.
    #[error("--out {file} cannot be written: {reason}; check that its folder has room")]
    Write {
        /// As written.
        file: String,
        /// From the system or the encoder.
        reason: String,
    },
}
