//! Draws from arrays, and how they are sent to the driver.

use super::super::Support;
use super::Send;
use super::corners::corners;
use crate::draw::Drawing;
use crate::gl::{Gl, Indices, Vertices, consts as c};

/// A draw from arrays that may be instanced. Counts, types and modes are GL's.
#[derive(Clone, Copy, Debug)]
pub enum Primitives {
    /// glDrawArrays.
    Arrays {
        /// Primitive mode.
        mode: u32,
        /// Its vertices.
        vertices: Vertices,
    },
    /// glDrawElements and glDrawRangeElements.
    Elements {
        /// Primitive mode.
        mode: u32,
        /// Its indices.
        indices: Indices,
    },
}

impl Primitives {
    /// Its primitive mode.
    pub(in crate::layer) fn mode(&self) -> u32 {
        match *self {
            Primitives::Arrays { mode, .. } | Primitives::Elements { mode, .. } => mode,
        }
    }

    /// The number of its vertices; one that is used several times counts each time.
    pub(in crate::layer) fn count(&self) -> u32 {
        let count = match self {
            Primitives::Arrays { vertices, .. } => vertices.count(),
            Primitives::Elements { indices, .. } => indices.count(),
        };
        count.max(0).unsigned_abs()
    }

    /// Its primitives, as a draw for the reference image needs them.
    pub(super) fn drawing(&self, gl: &Gl, support: &Support) -> Drawing {
        let mode = self.mode();
        let lists = || match *self {
            Primitives::Arrays { vertices, .. } => vertices.first() >= 0,
            Primitives::Elements { indices, .. } => gl.has_own_indices(indices),
        };
        Drawing {
            mode: Some(mode),
            vertices: u64::from(self.count()),
            counted: true,
            cuts: [c::TRIANGLES, c::QUADS].contains(&mode) || !support.restarts(gl) && lists(),
            material: false,
        }
    }

    /// Sends it to the driver; `call` is the program's own call.
    pub(super) fn send(&self, gl: &Gl, how: Send, call: &mut dyn FnMut()) {
        match (how, *self) {
            (Send::AsItIs, _) => call(),
            (Send::InMode(mode), _) => self.in_mode(gl, mode),
            (Send::Instances { mode, count }, Primitives::Arrays { vertices, .. }) => {
                gl.draw_arrays_instanced(mode, vertices, count as i32);
            }
            (Send::Instances { mode, count }, Primitives::Elements { indices, .. }) => {
                gl.draw_elements_instanced(mode, indices, count as i32);
            }
        }
    }

    /// Sends the draw in another mode. For patches, strips and fans are split into triangles and quads first.
    fn in_mode(&self, gl: &Gl, mode: u32) {
        let places = match mode {
            c::PATCHES => corners(self.mode(), self.count()),
            _ => None,
        };
        match (*self, places) {
            (Primitives::Arrays { vertices, .. }, None) => gl.draw_arrays(mode, vertices),
            (Primitives::Arrays { vertices, .. }, Some(places)) => {
                gl.draw_places(mode, vertices, &places);
            }
            (Primitives::Elements { indices, .. }, None) => gl.draw_elements(mode, indices),
            (Primitives::Elements { indices, .. }, Some(places)) => {
                gl.draw_places_of_elements(mode, indices, &places);
            }
        }
    }
}
