//! Orthographic scenes: which draws of a program without perspective belong to one.
//!
//! By the matrices alone, text on the screen and a box that is seen from the front look the same. So a draw belongs to a scene if it is seen
//! from an oblique direction, or is projected by the very matrix of one that is. Where a program has a perspective, its orthographic draws are
//! a display.

use super::{Facts, is_perspective, is_whole};
use crate::plan::class::Why;

/// What is known of one drawable.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OrthographicWatch {
    /// This frame, or the one before, has something in perspective.
    perspective: [bool; 2],
    /// GL_PROJECTION_MATRIX of the last oblique draw of this frame, and of the one before.
    scene: [Option<[f32; 16]>; 2],
}

impl OrthographicWatch {
    /// Whether a scene may be orthographic.
    pub fn is_possible(&self) -> bool {
        self.perspective == [false; 2]
    }

    /// Whether this frame, or the one before, has an orthographic scene.
    pub fn has_scene(&self) -> bool {
        self.scene != [None; 2]
    }

    /// Whether a scene was drawn with this projection matrix.
    pub fn is_of_scene(&self, p: &[f32; 16]) -> bool {
        self.scene.iter().flatten().any(|scene| scene == p)
    }

    /// The knowledge that the next frame begins with.
    #[must_use]
    pub(super) fn next(self) -> Self {
        OrthographicWatch {
            perspective: [false, self.perspective[0]],
            scene: [None, self.scene[0]],
        }
    }

    /// Updates the knowledge from a command.
    pub(super) fn observe(&mut self, facts: &Facts) {
        if !facts.traits.target.is_shown() || is_whole(facts.traits.kind) {
            return;
        }
        self.perspective[0] |= is_perspective(facts);
        if facts.classed.why == Why::Slanted {
            self.scene[0] = Some(facts.projections.fixed);
        }
    }
}
