//! Draws from arrays, and how they are sent to the driver.

use super::super::Support;
use super::Send;
use super::corners::corners;
use crate::draw::Drawing;
use crate::gl::{Gl, Indices, consts as c};

/// A draw from arrays that may be instanced. Counts, types and modes are GL's.
#[derive(Clone, Copy, Debug)]
pub enum Primitives {
    /// glDrawArrays.
    Arrays {
        /// Primitive mode.
        mode: u32,
        /// First vertex.
        first: i32,
        /// Number of vertices.
        count: i32,
    },
    /// glDrawElements and glDrawRangeElements.
    Elements {
        /// Primitive mode.
        mode: u32,
        /// Number of indices.
        count: i32,
        /// GL_UNSIGNED_BYTE, _SHORT or _INT.
        kind: u32,
        /// The program's pointer.
        indices: Indices,
    },
}

impl Primitives {
    /// Its primitive mode.
    pub(super) fn mode(&self) -> u32 {
        match *self {
            Primitives::Arrays { mode, .. } | Primitives::Elements { mode, .. } => mode,
        }
    }

    /// What it is made of.
    pub(super) fn drawing(&self, gl: &Gl, support: &Support) -> Drawing {
        let (Primitives::Arrays { count, .. } | Primitives::Elements { count, .. }) = *self;
        let (mode, count) = (self.mode(), count.max(0).unsigned_abs());
        let lists = || match *self {
            Primitives::Arrays { first, .. } => first >= 0,
            Primitives::Elements { indices, .. } => gl.has_own_indices(indices),
        };
        Drawing {
            mode: Some(mode),
            vertices: u64::from(count),
            cuts: [c::TRIANGLES, c::QUADS].contains(&mode) || !support.restarts(gl) && lists(),
            material: false,
        }
    }

    /// Sends it; `call` is the program's own.
    pub(super) fn send(&self, gl: &Gl, how: Send, call: &mut dyn FnMut()) {
        match (how, *self) {
            (Send::AsItIs, _) => call(),
            (Send::InMode(mode), _) => self.in_mode(gl, mode),
            (
                Send::Instances { mode, count },
                Primitives::Arrays {
                    first, count: n, ..
                },
            ) => {
                gl.draw_arrays_instanced(mode, first, n, count as i32);
            }
            (
                Send::Instances { mode, count },
                Primitives::Elements {
                    count: n,
                    kind,
                    indices,
                    ..
                },
            ) => gl.draw_elements_instanced(mode, n, kind, indices, count as i32),
        }
    }

    /// The draw in another mode; as patches also if it is not of triangles or quads by themselves.
    fn in_mode(&self, gl: &Gl, mode: u32) {
        let (Primitives::Arrays { count, .. } | Primitives::Elements { count, .. }) = *self;
        let count_up = count.max(0).unsigned_abs();
        let list = match mode {
            c::PATCHES => corners(self.mode(), count_up),
            _ => None,
        };
        match (*self, list) {
            (Primitives::Arrays { first, count, .. }, None) => gl.draw_arrays(mode, first, count),
            (Primitives::Arrays { first, .. }, Some(mut list)) => {
                let first = first.max(0).unsigned_abs();
                list.iter_mut()
                    .for_each(|at| *at = at.saturating_add(first));
                gl.draw_listed(mode, &list);
            }
            (
                Primitives::Elements {
                    count,
                    kind,
                    indices,
                    ..
                },
                None,
            ) => gl.draw_elements(mode, count, kind, indices),
            (Primitives::Elements { kind, indices, .. }, Some(mut list)) => {
                if let Some(own) = gl.own_indices(count_up, kind, indices) {
                    let own: Vec<u32> = own.collect();
                    list.iter_mut()
                        .for_each(|at| *at = own.get(*at as usize).copied().unwrap_or(0));
                    gl.draw_listed(mode, &list);
                }
            }
        }
    }
}
