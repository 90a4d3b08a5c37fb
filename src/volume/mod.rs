//! Pictures for a volumetric display: a screen that turns about an axis, and onto which slices of the scene are projected as it turns.
//!
//! Popescu et al., "3D Display Rendering Acceleration Using Occlusion Camera Reference Images", sections VI and VII. A scene comes as
//! triangles ([`Volume::of_triangles`]) or, in a fraction of the time, as the reference image of what one viewer can see of it
//! ([`Volume::of_reference`]); `program` makes that of what a program has shown, whose triangles nobody has. `exposure` makes it as bright as can be, `dither` makes light of its colours, with one bit for each channel, `stack` keeps that as a folder of pictures,
//! `eye` shows what is seen of it, and `compare` says how far two volumes are apart.
//!
//! Voxels. A slice stands for the sector that the screen goes through while it is shown, half a sector to either side of its plane; its pixels are
//! voxels: rings cut by sectors, a pixel high and a pixel deep. A surface lights each voxel that a piece of it is found in, wherever in the sector that is. To draw the
//! line in which it meets the plane itself, as a slice of a solid would, loses what lies between two planes: all of a surface that is parallel to one.
//! No point of a surface is farther than a voxel from one of its pieces, in sectors, pixels outwards or pixels down: a slice has no gaps.
#![forbid(unsafe_code)]

// What the layer writes; all else is the command's.
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
