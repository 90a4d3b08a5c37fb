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

mod compare;
mod display;
mod dither;
mod error;
mod exposure;
mod eye;
mod fragments;
mod patch;
mod place;
mod program;
mod reference;
mod sampled;
mod stack;
#[cfg(test)]
mod tests;
mod triangles;

pub use compare::{Difference, VISIBLE};
pub use display::{RotatingScreen, Turn};
pub use dither::{Lit, Slices};
pub use error::VolumeError;
pub use eye::Sight;
pub use program::{Before, Head, Picture, Samples, Source};
pub use reference::{Joined, ReferenceImage, Sample};
pub use triangles::{Triangle, Vertex};

/// A voxel that a surface goes through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Voxel {
    /// Row · columns of a half plane + column; rows from the top, columns from the axis.
    pub at: u32,
    /// Red, green and blue, sRGB: the mean of the surface's pieces in it.
    pub colour: [u8; 3],
}

/// The voxels of a scene in its colours.
#[derive(Clone, Debug, PartialEq)]
pub struct Volume {
    screen: RotatingScreen,
    /// Half plane 0 goes from the axis to the right, the next ones turn towards the viewer. Voxels in order.
    half_planes: Vec<Vec<Voxel>>,
}

impl Volume {
    /// Of which display.
    pub fn screen(&self) -> &RotatingScreen {
        &self.screen
    }

    /// Each half plane's voxels, in order.
    pub fn half_planes(&self) -> &[Vec<Voxel>] {
        &self.half_planes
    }

    /// Voxels that are set.
    pub fn len(&self) -> usize {
        self.half_planes.iter().map(Vec::len).sum()
    }

    /// Whether none is.
    pub fn is_empty(&self) -> bool {
        self.half_planes.iter().all(Vec::is_empty)
    }
}
