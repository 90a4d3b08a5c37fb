//! What is drawn to: the atlas of framebuffer 0, the program's own framebuffers in as many views, and the pass that shows them.

use super::{accumulate, framebuffer};
use crate::atlas::{Atlas, Names};
use crate::interleave::Interleaver;
use crate::offscreen::Offscreen;
use crate::plan::decide::Detail;

/// The images of a context that differ between the views.
#[derive(Debug)]
pub(super) struct Targets {
    pub(super) atlas: Atlas,
    pub(super) names: Names,
    pub(super) offscreen: Offscreen,
    pub(super) accumulated: accumulate::Accumulated,
    pub(super) interleaver: Interleaver,
    pub(super) detail: Detail,
    /// No other atlas can be had.
    pub(super) stuck: bool,
    /// A picture waits for views that are not shown.
    pub(super) undrawn: bool,
    /// What glPushAttrib saved of framebuffer 0.
    pub(super) pushed: Vec<framebuffer::Pushed>,
}
