//! Where the vertices of a draw stand, by which it is known again.

use super::indices::{Indices, Vertices};
use super::{Gl, consts as c};
use core::hash::Hasher;
use rustc_hash::FxHasher;

impl Gl {
    /// A sum of the positions of the vertices of the program's draw; none where that does not read them in the program's own memory by
    /// fixed function.
    pub fn positions_sum(&self, vertices: Vertices) -> Option<u64> {
        let first = u32::try_from(vertices.first).ok()?;
        let count = u32::try_from(vertices.count).ok()?;
        // SAFETY: the program draws them (contract of `Vertices::new`).
        unsafe { self.sum_of(first..first.checked_add(count)?) }
    }

    /// As [`Gl::positions_sum`], of a draw by indices; none where those are in a buffer.
    pub fn positions_sum_of_elements(&self, indices: Indices) -> Option<u64> {
        let vertices = self.own_indices(indices)?;
        // SAFETY: the program draws them (contract of `Indices::new`).
        unsafe { self.sum_of(vertices) }
    }

    /// # Safety
    /// The program is about to draw these vertices.
    unsafe fn sum_of(&self, vertices: impl Iterator<Item = u32>) -> Option<u64> {
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
            // no attribute of shaders takes its place. The program draws this vertex (contract).
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
