//! Time and number of true views of each of the last frames.

use std::collections::VecDeque;

/// Number of frames that the report lists.
const KEPT: usize = 1000;

/// Frames whose views are partly synthesised, the oldest first.
#[derive(Debug, Default)]
pub(super) struct TrueViews(VecDeque<(f32, u32)>);

impl TrueViews {
    pub(super) fn frame(&mut self, ms: f32, drawn: u32) {
        if self.0.len() == KEPT {
            self.0.pop_front();
        }
        self.0.push_back((ms, drawn));
    }

    /// Milliseconds and views drawn of each, where there are any.
    pub(super) fn json(&self) -> Option<Vec<(f32, u32)>> {
        (!self.0.is_empty()).then(|| self.0.iter().copied().collect())
    }
}
