//! The foreground: what a program draws before everything else, such as the weapon in a player's hand. It goes to the near part of the depth
//! range, or the depths are cleared for it after the scene.
//!
//! Only the end of a frame tells which of the two parts is the scene, so a frame is drawn by what the last frame with two parts was.

use super::{Facts, is_perspective, is_whole};
use crate::config::{Class, DepthRange, Viewport};
use crate::gl::consts as c;
use crate::plan::Kind;
use crate::plan::class::Target;

/// A foreground has so many draws at most. What has more is a scene of its own, as in programs that draw the distance first.
const MOST: u32 = 32;

/// The foreground of one drawable.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Foreground {
    /// The last frame with a clear of the depths in it had a foreground after that.
    after_clear: bool,
    /// The last frame with draws to the near part of the depth range had a foreground there.
    in_near_part: bool,
    /// Draws of the scene in this frame, and those of them since the last clear of the depths alone.
    draws: u32,
    since_clear: Option<u32>,
    /// Of the draws, those in the near part of the depth range.
    near: u32,
}

impl Foreground {
    /// Whether a draw to this part of the depth range is in the foreground, by the frames before.
    pub fn has(&self, range: DepthRange) -> bool {
        let cleared = self.after_clear && self.since_clear.is_some_and(|draws| draws < MOST);
        cleared || self.in_near_part && range == DepthRange::Near
    }

    /// The knowledge that the next frame begins with.
    pub(super) fn next(self) -> Foreground {
        // A hand that is empty for a while says nothing.
        let found = |part: u32, before: bool| match part {
            0 => before,
            part => part <= MOST && part < self.draws - part,
        };
        Foreground {
            after_clear: found(self.since_clear.unwrap_or(0), self.after_clear),
            in_near_part: found(self.near, self.in_near_part),
            ..Foreground::default()
        }
    }

    /// Updates the knowledge from a command.
    pub(super) fn observe(&mut self, facts: &Facts) {
        let traits = &facts.traits;
        let shown = matches!(traits.target, Target::Window | Target::Pass(_));
        if !shown || traits.viewport != Viewport::Main {
            return;
        }
        if let Kind::Clear { depths, whole } = traits.kind {
            if whole & c::COLOR_BUFFER_BIT != 0 {
                *self = Foreground {
                    draws: 0,
                    since_clear: None,
                    near: 0,
                    ..*self
                };
            } else if depths && self.draws > 0 {
                self.since_clear = Some(0);
            }
            return;
        }
        if is_whole(traits.kind) || !is_perspective(facts) || facts.classed.class != Class::Scene {
            return;
        }
        self.draws = self.draws.saturating_add(1);
        self.since_clear = self.since_clear.map(|draws| draws.saturating_add(1));
        self.near += u32::from(traits.range == DepthRange::Near);
    }
}
