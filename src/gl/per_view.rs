//! What each view of a draw has of its own: viewport, scissor rectangle and projection.
//!
//! The shadow is not told of these calls, which are eight times as many as the program's with eight views, and keeps the program's values. So
//! the driver gets those back after the views, and nothing is asked in between.

use super::api::Gl;
use super::real::Ptr;
use super::slot;

impl Gl {
    /// glViewport: x, y, width, height.
    #[inline]
    pub fn viewport_of_view(&self, [x, y, width, height]: [i32; 4]) {
        // SAFETY: a context is current; the signature is that of the command.
        unsafe {
            unnoted!(self.real, slot::glViewport, x: i32, y: i32, width: i32, height: i32);
        }
    }

    /// glScissor: x, y, width, height.
    #[inline]
    pub fn scissor_of_view(&self, [x, y, width, height]: [i32; 4]) {
        // SAFETY: a context is current; the signature is that of the command.
        unsafe {
            unnoted!(self.real, slot::glScissor, x: i32, y: i32, width: i32, height: i32);
        }
    }

    /// glLoadMatrixf; column-major.
    #[inline]
    pub fn load_matrix_of_view(&self, m: &[f32; 16]) {
        let m = m.as_ptr() as Ptr;
        // SAFETY: 16 floats; the signature is that of the command.
        unsafe { unnoted!(self.real, slot::glLoadMatrixf, m: Ptr) };
    }
}
