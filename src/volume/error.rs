//! Errors of volumes, in one sentence each.

use std::path::PathBuf;

/// Why there are no slices, or no picture of them.
#[derive(Debug, thiserror::Error)]
pub enum VolumeError {
    /// A display that cannot be.
    #[error("the display's {field} is {found}; give {expected}")]
    Display {
        /// Of [`super::RotatingScreen`].
        field: &'static str,
        /// As given.
        found: String,
        /// What it should be.
        expected: &'static str,
    },
    /// More samples, or fewer, than a size says.
    #[error("the reference image has {samples} samples; give {width} x {height} of them")]
    Samples {
        /// As given.
        samples: usize,
        /// As said.
        width: u32,
        /// As said.
        height: u32,
    },
    /// A program that has shown nothing that can stand in a volume.
    #[error("the program has shown nothing to make slices of: {reason}")]
    Shown {
        /// With the remedy.
        reason: String,
    },
    /// A folder that takes no stack.
    #[error(
        "slices cannot be written to {}: {reason}; name a folder that is empty, that holds a stack, or that is not there yet", folder.display()
    )]
    Write {
        /// As named.
        folder: PathBuf,
        /// What stands in the way.
        reason: String,
    },
    /// A folder that holds no stack.
    #[error(
        "{} is no stack of slices: {reason}; name a folder that slices were written to", folder.display()
    )]
    Read {
        /// As named.
        folder: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// An eye in the middle of it, or nowhere.
    #[error(
        "the eye is at {x},{y},{z}, in or too near to the sphere; give a place at least {least} in from the middle of the display"
    )]
    Eye {
        /// Inches.
        x: f64,
        /// Inches.
        y: f64,
        /// Inches.
        z: f64,
        /// Inches.
        least: f64,
    },
    /// A picture that cannot be made.
    #[error("the picture's size is {width}x{height}; give 1 to 8192 pixels each way")]
    Size {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
    },
}
