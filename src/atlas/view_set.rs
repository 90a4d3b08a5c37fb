//! A set of views.

use crate::view::ViewIndex;

/// A set of views as bits; 256 is the most views that there may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ViewSet([u64; 4]);

impl ViewSet {
    /// All views, whatever their number.
    pub const ALL: ViewSet = ViewSet([u64::MAX; 4]);

    /// Whether a view is in the set.
    pub fn has(&self, view: ViewIndex) -> bool {
        let word = self.0.get(view.0 as usize / 64).copied().unwrap_or(0);
        word >> (view.0 % 64) & 1 != 0
    }

    /// The views of both sets.
    #[must_use]
    pub fn union(mut self, other: ViewSet) -> ViewSet {
        let words = self.0.iter_mut().zip(other.0);
        words.for_each(|(word, other)| *word |= other);
        self
    }
}

impl FromIterator<ViewIndex> for ViewSet {
    fn from_iter<I: IntoIterator<Item = ViewIndex>>(views: I) -> Self {
        let mut words = [0u64; 4];
        for ViewIndex(view) in views {
            if let Some(word) = words.get_mut(view as usize / 64) {
                *word |= 1 << (view % 64);
            }
        }
        ViewSet(words)
    }
}
