//! What the program's draw reads: its vertices, and its indices.

use super::real::Ptr;

/// The vertices of the program's draw that follow each other. Where its arrays lie in its own memory, it has as many there.
#[derive(Clone, Copy, Debug)]
pub struct Vertices {
    pub(super) first: i32,
    pub(super) count: i32,
}

impl Vertices {
    /// # Safety
    /// The program draws these vertices, and the value is used only while that draw has not returned.
    pub unsafe fn new(first: i32, count: i32) -> Self {
        Vertices { first, count }
    }

    /// Of a draw of a test, which enables no arrays: the fake driver reads none.
    #[cfg(test)]
    pub fn without_arrays(first: i32, count: i32) -> Self {
        Vertices { first, count }
    }

    /// The first one.
    pub fn first(self) -> i32 {
        self.first
    }

    /// Their number.
    pub fn count(self) -> i32 {
        self.count
    }
}

/// The indices of the program's draw: an address, or an offset into the element buffer.
#[derive(Clone, Copy, Debug)]
pub struct Indices {
    pub(super) count: i32,
    pub(super) kind: u32,
    pub(super) at: Ptr,
}

impl Indices {
    /// `kind`: GL_UNSIGNED_BYTE, _SHORT or _INT.
    ///
    /// # Safety
    /// The program draws by this pointer with this count and type, and the value is used only while that draw has not returned.
    pub unsafe fn new(count: i32, kind: u32, at: Ptr) -> Self {
        Indices { count, kind, at }
    }

    /// Their number.
    pub fn count(self) -> i32 {
        self.count
    }
}
