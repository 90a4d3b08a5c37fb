//! Pictures for a volumetric display: a screen that turns about an axis, and onto which slices of the scene are projected as it turns.
//!
//! Popescu et al., "3D Display Rendering Acceleration Using Occlusion Camera Reference Images", sections VI and VII. A scene comes as
//! triangles ([`Volume::of_triangles`]) or, in a fraction of the time, as a reference image from the place of one viewer
//! ([`Volume::of_reference`]). `program` makes that image from the samples of a program, whose triangles are not known. `exposure` scales
//! the light, `dither` gives it one bit for each channel, and `stack` keeps it as a folder of pictures. `eye` shows the slices as an eye
//! sees them, and `compare` measures the difference of two volumes.
//!
//! A slice stands for the sector that the screen sweeps while it is shown, half a sector to either side of its plane. Its pixels are
//! voxels: parts of rings, one sector long, a pixel high and a pixel deep. A surface lights each voxel that has a piece of it, anywhere in the sector. Drawing
//! only the line in which it meets the plane, as in a slice of a solid, would lose everything between two planes, such as a surface parallel to them.
//! No point of a surface is farther than a voxel from one of its pieces, in sectors, pixels outwards or pixels down: a slice has no gaps.
#![forbid(unsafe_code)]

// The file that the layer writes; the other modules belong to the command.
mod samples;

#[cfg(feature = "cli")]
mod compare;
#[cfg(feature = "cli")]
mod display;
#[cfg(feature = "cli")]
mod dither;
#[cfg(feature = "cli")]
mod error;
#[cfg(feature = "cli")]
mod exposure;
#[cfg(feature = "cli")]
mod eye;
#[cfg(feature = "cli")]
mod fragments;
#[cfg(feature = "cli")]
mod patch;
#[cfg(feature = "cli")]
mod place;
#[cfg(feature = "cli")]
mod program;
#[cfg(feature = "cli")]
mod reference;
#[cfg(feature = "cli")]
mod sampled;
#[cfg(feature = "cli")]
mod stack;
#[cfg(all(test, feature = "cli"))]
mod tests;
#[cfg(feature = "cli")]
mod triangles;
#[cfg(feature = "cli")]
mod voxels;

pub use samples::{Before, Head, Picture, Samples};
#[cfg(feature = "cli")]
pub use {
    compare::{Difference, VISIBLE},
    display::{RotatingScreen, Turn},
    dither::{Lit, Slices},
    error::VolumeError,
    eye::Sight,
    program::Source,
    reference::{Joined, ReferenceImage, Sample},
    triangles::{Triangle, Vertex},
    voxels::{Volume, Voxel},
};
