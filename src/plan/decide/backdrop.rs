//! The backdrop: what a program draws around the eye before it clears the depths once more for the scene.
//!
//! It writes depths, which the clear throws away, so it stands behind everything: a sky. What follows it before the clear without depths, such as a
//! sun, belongs to it wherever it stands. Only the end of a frame tells, so a frame is drawn by what the frame before it was.

use super::{Facts, is_perspective, is_whole};
use crate::config::{DepthState, Viewport};
use crate::gl::consts as c;
use crate::plan::Kind;
use crate::plan::class::{BackdropStage, Target};

/// A backdrop has so many draws at most. A program that moves its vertices to the eye itself draws its whole scene around the eye.
const MOST: u32 = 32;

/// The backdrop of one drawable.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Backdrop {
    /// The last frame began with one.
    expected: bool,
    progress: Progress,
}

/// The frame so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Progress {
    /// Nothing has been drawn in perspective.
    #[default]
    Nothing,
    /// So many draws, the first around the eye, the others too or without depths.
    Around(u32),
    /// So many such draws; then the depths were cleared, and so many draws followed.
    Cleared(u32, u32),
    /// Something else came first.
    Scene,
}

impl Backdrop {
    /// Whether the next draw may stand behind everything, by the last frame.
    pub fn stage(&self) -> BackdropStage {
        match self.progress {
            Progress::Nothing if self.expected => BackdropStage::Expected,
            Progress::Around(_) if self.expected => BackdropStage::Begun,
            _ => BackdropStage::None,
        }
    }

    /// Whether nothing but a backdrop has been drawn in perspective, so that the next draw may belong to it.
    pub fn may_go_on(&self) -> bool {
        matches!(self.progress, Progress::Nothing | Progress::Around(_))
    }

    /// The knowledge that the next frame begins with. The scene is what has more draws: a weapon in the hand, for which some programs clear the
    /// depths as well, makes no backdrop of the scene before it.
    pub(super) fn next(self) -> Backdrop {
        let expected = matches!(self.progress, Progress::Cleared(before, after) if before <= MOST && after > before);
        Backdrop {
            expected,
            progress: Progress::Nothing,
        }
    }

    /// Updates the knowledge from a command.
    pub(super) fn observe(&mut self, facts: &Facts) {
        let traits = &facts.traits;
        if traits.target != Target::Window || traits.viewport != Viewport::Main {
            return;
        }
        if let Kind::Clear { depths, whole } = traits.kind {
            if !facts.clear.unscissored {
                return;
            }
            if whole & c::COLOR_BUFFER_BIT != 0 {
                self.progress = Progress::Nothing;
            } else if let (true, Progress::Around(draws)) = (depths, self.progress) {
                self.progress = Progress::Cleared(draws, 0);
            }
            return;
        }
        if is_whole(traits.kind) || !is_perspective(facts) {
            return;
        }
        self.progress = match self.progress {
            Progress::Nothing if traits.is_around_eye() => Progress::Around(1),
            Progress::Around(draws)
                if traits.is_around_eye() || traits.depth_state == DepthState::Off =>
            {
                Progress::Around(draws.saturating_add(1))
            }
            Progress::Nothing | Progress::Around(_) | Progress::Scene => Progress::Scene,
            Progress::Cleared(before, after) => Progress::Cleared(before, after.saturating_add(1)),
        };
    }
}
