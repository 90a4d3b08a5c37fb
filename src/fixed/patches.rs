//! State whose meaning changes while a program replaces the fixed-function vertex stage.

use super::key::{FixedKey, PointSize, Primitive};

/// State that the caller sets for the draw and restores after it. Each enable is the state itself, not a change: `false`
/// means disabled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Patches {
    /// `GL_COLOR_SUM`. Without a program lighting always adds its secondary colour (16.3); with one the enable decides.
    pub color_sum: bool,
    /// `GL_VERTEX_PROGRAM_TWO_SIDE`. Chooses between front and back colour (12.2.1) in place of
    /// `GL_LIGHT_MODEL_TWO_SIDE`.
    pub two_side: bool,
    /// `GL_PROGRAM_POINT_SIZE`. Off where the size is constant: it is then the state's (14.4). The shader must not write that
    /// same size instead, because llvmpipe clips points at the edge of the viewport differently if their size is written.
    pub point_size: bool,
    /// `glProvokingVertex(GL_LAST_VERTEX_CONVENTION)` for this draw; `false` keeps the program's setting. A flat polygon is
    /// drawn as a fan and takes its colour from `gl_in[0]`; with the other convention Mesa rotates that vertex to `gl_in[2]`.
    pub last_vertex_convention: bool,
    /// Bit i: `GL_CLIP_DISTANCEi`, the same enables as `GL_CLIP_PLANEi`. All other planes have to be disabled: their
    /// distances are not written (13.7).
    pub clip_distances: u8,
}

impl Patches {
    /// Those of a canonical key.
    pub(super) fn of(key: &FixedKey) -> Self {
        Self {
            color_sum: key.secondary(),
            two_side: key.two_side(),
            point_size: key.point == PointSize::Attenuated || key.target.surface,
            last_vertex_convention: key.geometry()
                && key.flat
                && key.target.primitive == Primitive::Polygon,
            // At most 10 distances: the generator has refused more than the driver's 8 by now.
            clip_distances: ((1u32 << key.clip_distances().min(8)) - 1) as u8,
        }
    }
}
