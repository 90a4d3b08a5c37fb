//! The voxels of a volumetric display that a scene lights.

use super::RotatingScreen;

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
    pub(super) screen: RotatingScreen,
    /// Half plane 0 goes from the axis to the right, the next ones turn towards the viewer. Voxels in order.
    pub(super) half_planes: Vec<Vec<Voxel>>,
}

impl Volume {
    /// The display of the voxels.
    pub fn screen(&self) -> &RotatingScreen {
        &self.screen
    }

    /// Each half plane's voxels, in order.
    pub fn half_planes(&self) -> &[Vec<Voxel>] {
        &self.half_planes
    }

    /// Number of voxels.
    pub fn len(&self) -> usize {
        self.half_planes.iter().map(Vec::len).sum()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.half_planes.iter().all(Vec::is_empty)
    }
}
