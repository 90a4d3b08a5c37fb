//! The number of a view, which is neither the slot of its tile nor a layer of a texture.
#![forbid(unsafe_code)]

/// A view, counted from the leftmost camera: 0 to N − 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ViewIndex(pub u32);

impl ViewIndex {
    /// The views of N, from the leftmost.
    pub fn all(views: u32) -> impl DoubleEndedIterator<Item = ViewIndex> + Clone {
        (0..views).map(ViewIndex)
    }
}

impl std::fmt::Display for ViewIndex {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.fmt(f)
    }
}
