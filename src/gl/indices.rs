//! The indices of a draw.

use super::real::Ptr;
use super::{Gl, consts as c};
use core::hash::Hasher;
use rustc_hash::FxHasher;

/// The index pointer of the program's draw: an address, or an offset into the element buffer.
#[derive(Clone, Copy, Debug)]
pub struct Indices(pub(super) Ptr);

impl Indices {
    /// # Safety
    /// The value is used only while the draw it came from has not returned, for the same count and type.
    pub unsafe fn new(p: Ptr) -> Self {
        Indices(p)
    }

    /// A sum of so many indices of a type, by which equal ones are known; of the offset alone, where they lie in a buffer.
    pub fn sum(&self, gl: &Gl, count: i32, kind: u32) -> u64 {
        let mut sum = FxHasher::default();
        let size = match kind {
            c::UNSIGNED_BYTE => 1,
            c::UNSIGNED_SHORT => 2,
            _ => 4,
        };
        let bytes = count.max(0).unsigned_abs() as usize * size;
        if gl.get_integer(c::ELEMENT_ARRAY_BUFFER_BINDING) == 0 && !self.0.is_null() {
            // SAFETY: without such a buffer the program's draw, which has not returned, reads as many indices of this type there.
            sum.write(unsafe { std::slice::from_raw_parts(self.0.cast(), bytes) });
        } else {
            sum.write_usize(self.0 as usize);
        }
        sum.finish()
    }
}
