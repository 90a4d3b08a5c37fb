//! Another pass over what was drawn before: a light map or a glow that is blended with a surface has the surface's depths, though it writes
//! none.
//!
//! It is known by the arrays. What they hold is promised not to change while they are locked (GL_EXT_compiled_vertex_array), so the same
//! elements of them, placed by the same matrix, are the same surface. Quake's engines draw each of theirs so.

use super::super::{Layer, Primitives};
use crate::gl::{Gl, consts as c};
use crate::state::Touch;

/// The surface that was drawn last, and wholly: nothing of it was left out by the alpha test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::layer) struct Surface {
    /// Which lock its arrays are under.
    lock: u64,
    /// Mode, first vertex or type of the indices, count, and a sum of the indices.
    elements: (u32, i64, i32, u64),
    modelview: [f32; 16],
    depths: [f32; 2],
}

/// The draw that is planned, and the last surface.
#[derive(Debug, Default)]
pub(in crate::layer) struct Surfaces {
    /// What is drawn next, if it is known.
    pub(in crate::layer) next: Option<Primitives>,
    last: Option<Surface>,
}

impl Surfaces {
    /// What was drawn is no more.
    pub(super) fn forget(&mut self) {
        self.last = None;
    }
}

impl Layer {
    /// The surface that is drawn next, where that is promised.
    fn surface(&mut self, gl: &Gl) -> Option<Surface> {
        let lock = self.state.arrays.locked()?;
        let elements = match self.synthesis.surfaces.next? {
            Primitives::Arrays { mode, first, count } => (mode, i64::from(first), count, 0),
            Primitives::Elements {
                mode,
                count,
                kind,
                indices,
            } => (mode, i64::from(kind), count, indices.sum(gl, count, kind)),
        };
        self.state.look(gl, Touch::MODELVIEW | Touch::RANGE);
        let look = &self.state.look;
        Some(Surface {
            lock,
            elements,
            modelview: look.modelview,
            depths: look.depths,
        })
    }

    /// Whether a draw is another pass over the last surface: it shows only where that is seen.
    pub(super) fn is_over_last(&mut self, gl: &Gl) -> bool {
        let tests = [c::LEQUAL, c::EQUAL, c::GEQUAL];
        self.synthesis.surfaces.last.is_some()
            && self.state.program == 0
            && self.surface(gl) == self.synthesis.surfaces.last
            && tests.contains(&(gl.get_integer(c::DEPTH_FUNC) as u32))
    }

    /// A draw with depths of its own goes to the scene.
    pub(super) fn keep_surface(&mut self, gl: &Gl) {
        let whole = self.state.program == 0
            && self.state.compatibility
            && self.state.arrays.locked().is_some()
            && !gl.is_enabled(c::ALPHA_TEST);
        self.synthesis.surfaces.last = match whole {
            true => self.surface(gl),
            false => None,
        };
    }
}
