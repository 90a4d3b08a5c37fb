//! The foreground: what a program draws before everything else, such as the weapon in a player's hand. It goes to the near part of the depth
//! range, or the depths are cleared for it after the scene.
//!
//! Only the end of a picture tells which of its two parts is the scene, so one is drawn by what the last with two parts was.

use super::{Facts, is_perspective, is_whole};
use crate::config::{Class, DepthRange, Viewport};
use crate::gl::{FramebufferName, consts as c};
use crate::plan::Kind;

/// A foreground has so many draws at most. What has more is a scene of its own, as in programs that draw the distance first.
const MOST: u32 = 32;

/// The foreground of one drawable. A picture begins with a clear of the colours; it may be the window's, or that of a framebuffer that ends up
/// in the window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Foreground {
    /// The last picture with draws after a clear of the depths alone had its foreground there.
    after_clear: bool,
    /// The last picture with draws to the near part of the depth range had its foreground there.
    in_near_part: bool,
    /// The framebuffer of the picture so far.
    framebuffer: FramebufferName,
    /// Draws of the scene in it, and those of them since the last clear of the depths alone.
    draws: u32,
    since_clear: Option<u32>,
    /// Of the draws, those to the near part of the depth range.
    near: u32,
}

impl Foreground {
    /// Whether a draw to this framebuffer and part of the depth range is in the foreground, by the pictures before.
    pub fn has(&self, framebuffer: FramebufferName, range: DepthRange) -> bool {
        let cleared = self.after_clear && self.since_clear.is_some_and(|draws| draws < MOST);
        cleared && framebuffer == self.framebuffer || self.in_near_part && range == DepthRange::Near
    }

    /// The knowledge that the next picture begins with.
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
        if !traits.target.is_shown() {
            return;
        }
        let framebuffer = facts.destination.framebuffer;
        if let Kind::Clear { depths, whole } = traits.kind {
            // A clear of a part is that of a picture in the picture.
            if facts.rects.scissor.is_some() && !facts.clear.unscissored {
                return;
            }
            if whole & c::COLOR_BUFFER_BIT != 0 {
                *self = self.next();
                self.framebuffer = framebuffer;
            } else if depths && self.draws > 0 && framebuffer == self.framebuffer {
                self.since_clear = Some(0);
            }
            return;
        }
        let of_scene = is_perspective(facts) && facts.classed.class == Class::Scene;
        if is_whole(traits.kind) || !of_scene || traits.viewport != Viewport::Main {
            return;
        }
        if framebuffer != self.framebuffer {
            // The scene goes on elsewhere without a clear of the colours there.
            *self = self.next();
            self.framebuffer = framebuffer;
        }
        self.draws = self.draws.saturating_add(1);
        self.since_clear = self.since_clear.map(|draws| draws.saturating_add(1));
        self.near += u32::from(traits.range == DepthRange::Near);
    }
}
