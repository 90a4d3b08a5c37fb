//! Further passes over a surface that was drawn before: a light map or a glow that is blended with a surface has the surface's depths, though
//! it writes none.
//!
//! Such a pass is recognised by its vertices: the same positions in the same order, placed by the same matrix, are the same surface. Quake's
//! engines draw all their passes so. Positions in buffer objects are not read, so a pass with those is not recognised.

use super::super::{Layer, Primitives};
use crate::gl::{Gl, consts as c};
use crate::state::Touch;

/// Vertices that are compared at most: comparing more takes longer than it saves.
const MOST: u32 = 1 << 14;

/// A surface that was drawn as a whole: the alpha test has left nothing of it out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::layer) struct Surface {
    mode: u32,
    count: u32,
    /// Hash of the positions.
    hash: u64,
    modelview: [f32; 16],
    depths: [f32; 2],
    /// GL_CULL_FACE; GL_CULL_FACE_MODE and GL_FRONT_FACE; GL_POLYGON_MODE.
    sides: (bool, [i32; 2], [i32; 2]),
}

/// The last surface that was drawn.
#[derive(Debug, Default)]
pub(in crate::layer) struct Surfaces {
    last: Option<Surface>,
}

impl Surfaces {
    /// The surface was cleared.
    pub(in crate::layer) fn forget(&mut self) {
        self.last = None;
    }
}

impl Layer {
    /// The surface of a draw, where it can be determined.
    fn surface(&mut self, gl: &Gl, next: Option<Primitives>) -> Option<Surface> {
        let next = next?;
        let (mode, count) = (next.mode(), next.count());
        let fixed = self.state.has.compatibility
            && self.state.in_use.program.is_zero()
            && self.state.in_use.pipeline == 0;
        if !fixed || mode > c::POLYGON || !(1..=MOST).contains(&count) {
            return None;
        }
        let hash = match next {
            Primitives::Arrays { vertices, .. } => gl.positions_sum(vertices)?,
            // An index that ends a primitive is the index of no vertex.
            Primitives::Elements { .. } if self.session.support.restarts(gl) => return None,
            Primitives::Elements { indices, .. } => gl.positions_sum_of_elements(indices)?,
        };
        self.state
            .read_classification(gl, Touch::MODELVIEW | Touch::RANGE);
        let classification = &self.state.classification;
        let sides = [c::CULL_FACE_MODE, c::FRONT_FACE].map(|name| gl.get_integer(name));
        Some(Surface {
            mode,
            count,
            hash,
            modelview: classification.modelview,
            depths: classification.depths,
            sides: (
                gl.is_enabled(c::CULL_FACE),
                sides,
                gl.get_integers(c::POLYGON_MODE),
            ),
        })
    }

    /// Whether a draw is another pass over the last surface, so that it shows only where that is visible.
    pub(in crate::layer) fn is_over_last(&mut self, gl: &Gl, next: Option<Primitives>) -> bool {
        let tests = [c::LEQUAL, c::EQUAL, c::GEQUAL];
        self.synthesis.surfaces.last.is_some()
            && tests.contains(&(gl.get_integer(c::DEPTH_FUNC) as u32))
            && self.surface(gl, next) == self.synthesis.surfaces.last
    }

    /// Notes the surface of a draw of the scene that has depths of its own.
    pub(in crate::layer) fn capture_surface(&mut self, gl: &Gl, next: Option<Primitives>) {
        let whole = self.state.has.compatibility && !gl.is_enabled(c::ALPHA_TEST);
        self.synthesis.surfaces.last = if whole { self.surface(gl, next) } else { None };
    }
}
