//! The indices of a draw.

use super::real::Ptr;

/// The index pointer of the program's draw: an address, or an offset into the element buffer.
#[derive(Clone, Copy, Debug)]
pub struct Indices(pub(super) Ptr);

impl Indices {
    /// # Safety
    /// The value is used only while the draw it came from has not returned, for the same count and type.
    pub unsafe fn new(p: Ptr) -> Self {
        Indices(p)
    }
}
