//! Another pass over what was drawn before: a light map or a glow that is blended with a surface has the surface's depths, though it writes
//! none.
//!
//! It is known by its vertices: the same positions in the same order, placed by the same matrix, are the same surface. Quake's engines draw each of
//! theirs so. Positions in buffers are not looked at, and there is no such pass then.

use super::super::{Layer, Primitives};
use crate::gl::{Gl, consts as c};
use crate::state::Touch;

/// Vertices that are compared at most: more take longer than they save.
const MOST: u32 = 1 << 14;

/// The surface that was drawn last, and wholly: nothing of it was left out by the alpha test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::layer) struct Surface {
    mode: u32,
    count: u32,
    /// Of the positions.
    sum: u64,
    modelview: [f32; 16],
    depths: [f32; 2],
    /// Which sides of it are drawn, and how.
    sides: (bool, [i32; 2], [i32; 2]),
}

/// The last surface that was drawn.
#[derive(Debug, Default)]
pub(in crate::layer) struct Surfaces {
    last: Option<Surface>,
}

impl Surfaces {
    /// What was drawn is no more.
    pub(in crate::layer) fn forget(&mut self) {
        self.last = None;
    }
}

impl Layer {
    /// The surface of a draw, where that can be told.
    fn surface(&mut self, gl: &Gl, next: Option<Primitives>) -> Option<Surface> {
        let next = next?;
        let (mode, count) = (next.mode(), next.count());
        let fixed = self.state.has.compatibility
            && self.state.in_use.program == 0
            && self.state.in_use.pipeline == 0;
        if !fixed || mode > c::POLYGON || !(1..=MOST).contains(&count) {
            return None;
        }
        let sum = match next {
            Primitives::Arrays { vertices, .. } => gl.positions_sum(vertices)?,
            // An index that ends a primitive is that of no vertex.
            Primitives::Elements { .. } if self.session.support.restarts(gl) => return None,
            Primitives::Elements { indices, .. } => gl.positions_sum_of_elements(indices)?,
        };
        self.state
            .read_classification(gl, Touch::MODELVIEW | Touch::RANGE);
        let look = &self.state.classification;
        let sides = [c::CULL_FACE_MODE, c::FRONT_FACE].map(|name| gl.get_integer(name));
        Some(Surface {
            mode,
            count,
            sum,
            modelview: look.modelview,
            depths: look.depths,
            sides: (
                gl.is_enabled(c::CULL_FACE),
                sides,
                gl.get_integers(c::POLYGON_MODE),
            ),
        })
    }

    /// Whether a draw is another pass over the last surface: it shows only where that is seen.
    pub(in crate::layer) fn is_over_last(&mut self, gl: &Gl, next: Option<Primitives>) -> bool {
        let tests = [c::LEQUAL, c::EQUAL, c::GEQUAL];
        self.synthesis.surfaces.last.is_some()
            && tests.contains(&(gl.get_integer(c::DEPTH_FUNC) as u32))
            && self.surface(gl, next) == self.synthesis.surfaces.last
    }

    /// A draw with depths of its own goes to the scene.
    pub(in crate::layer) fn capture_surface(&mut self, gl: &Gl, next: Option<Primitives>) {
        let whole = self.state.has.compatibility && !gl.is_enabled(c::ALPHA_TEST);
        self.synthesis.surfaces.last = if whole { self.surface(gl, next) } else { None };
    }
}
