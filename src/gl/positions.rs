//! Where the vertices of a draw stand, by which it is known again.

use super::{Gl, consts as c};
use core::hash::Hasher;
use rustc_hash::FxHasher;

impl Gl {
    /// A sum of the positions of some vertices, in the program's own memory; `first` and the number of those that follow each other, or all of a list. None where
    /// the draw that the program is about to make does not read them there. Only during that draw, with fixed function.
    pub fn positions_sum(&self, vertices: impl Iterator<Item = u32>) -> Option<u64> {
        let ours = self.is_enabled(c::VERTEX_ARRAY)
            && self.get_integer(c::VERTEX_ARRAY_BUFFER_BINDING) == 0
            && !self.reads_attribute_0();
        let pointer = self.vertex_pointer();
        if !ours || pointer.is_null() {
            return None;
        }
        let [size, kind, stride] = [
            c::VERTEX_ARRAY_SIZE,
            c::VERTEX_ARRAY_TYPE,
            c::VERTEX_ARRAY_STRIDE,
        ]
        .map(|name| self.get_integer(name).max(0).unsigned_abs() as usize);
        let bytes = size
            * match kind as u32 {
                c::FLOAT | c::INT => 4,
                c::SHORT => 2,
                c::DOUBLE => 8,
                _ => return None,
            };
        let step = if stride == 0 { bytes } else { stride };
        let mut sum = FxHasher::default();
        for vertex in vertices {
            sum.write_u32(vertex);
            // SAFETY: fixed function reads as many bytes of each of its vertices there: the array is enabled, in no buffer, and
            // no attribute of shaders takes its place.
            let place = unsafe {
                let at = pointer.cast::<u8>().add(step * vertex as usize);
                core::slice::from_raw_parts(at, bytes)
            };
            sum.write(place);
        }
        Some(sum.finish())
    }

    /// Whether the first attribute of shaders stands for the positions.
    fn reads_attribute_0(&self) -> bool {
        let mut enabled = 0i32;
        // SAFETY: a context is current; one value is written.
        unsafe {
            self.real.glGetVertexAttribiv(
                0,
                c::VERTEX_ATTRIB_ARRAY_ENABLED,
                (&raw mut enabled).cast(),
            );
        }
        enabled != 0
    }

    fn vertex_pointer(&self) -> *mut core::ffi::c_void {
        let mut pointer: *mut core::ffi::c_void = core::ptr::null_mut();
        // SAFETY: a context is current; one pointer is written.
        unsafe {
            self.real
                .glGetPointerv(c::VERTEX_ARRAY_POINTER, (&raw mut pointer).cast());
        }
        pointer
    }
}
