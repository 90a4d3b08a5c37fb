//! State that means something else while a program replaces the fixed-function vertex stage.

use super::key::{FixedKey, PointSize, Primitive};

/// What the caller sets around the draw, and puts back after it. Each enable is the state itself, not a change: `false`
/// means disabled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Patches {
    /// `GL_COLOR_SUM`. Without a program lighting always adds its secondary colour (16.3); with one the enable decides.
    pub color_sum: bool,
    /// `GL_VERTEX_PROGRAM_TWO_SIDE`. Chooses between front and back colour (12.2.1) in place of
    /// `GL_LIGHT_MODEL_TWO_SIDE`.
    pub two_side: bool,
    /// `GL_PROGRAM_POINT_SIZE`. Off where the size is constant: it is then the state's (14.4). Writing that same size
    /// would not do: llvmpipe cuts points at the edge of the viewport by which of the two it is.
    pub point_size: bool,
    /// `glProvokingVertex(GL_LAST_VERTEX_CONVENTION)` for this draw; `false`: as the program has it. A fan that stands
    /// for a flat polygon finds its first vertex in `gl_in[0]`; Mesa rotates it to `gl_in[2]` with the other convention.
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
            point_size: key.point == PointSize::Attenuated,
            last_vertex_convention: key.geometry()
                && key.flat
                && key.target.primitive == Primitive::Polygon,
            // At most 10 distances: the generator has refused more than the driver's 8 by now.
            clip_distances: ((1u32 << key.clip_distances().min(8)) - 1) as u8,
        }
    }
}
