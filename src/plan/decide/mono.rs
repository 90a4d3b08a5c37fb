//! Frames that are the same in all views, such as menus: only the program's own view is drawn, until something depends on the view.

use super::{Effect, Facts, Known, Method, Plan};
use crate::gl::consts as c;
use crate::plan::Kind;

const COLOURS_AND_DEPTHS: u32 = c::COLOR_BUFFER_BIT | c::DEPTH_BUFFER_BIT;
/// All buffers of a framebuffer, as bits of glClear.
pub const ALL_BUFFERS: u32 = COLOURS_AND_DEPTHS | c::STENCIL_BUFFER_BIT;

/// The contents that all views have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mono {
    /// The buffers, as bits of glClear, that are the same in all views.
    pub same: u32,
    /// This is a mono frame: only the program's own view is drawn.
    pub active: bool,
}

impl Default for Mono {
    /// The contents of a new window are undefined, so they may count as the same.
    fn default() -> Self {
        Mono {
            same: ALL_BUFFERS,
            active: false,
        }
    }
}

impl Mono {
    /// Takes note of a draw that went to the program's own view only.
    pub fn lose(&mut self) {
        if !self.active {
            self.same = 0;
        }
    }

    /// Takes note of a draw that depends on the view; `stencil`: the stencil test is on, or may be.
    pub fn differ(&mut self, stencil: bool) {
        self.same &= !COLOURS_AND_DEPTHS;
        if stencil {
            self.same = 0;
        }
    }

    /// The buffers of a clear that differ between the views, and may become the same by it.
    pub fn may_share(&self, cleared: u32) -> u32 {
        cleared & ALL_BUFFERS & !self.same
    }
}

/// Whether the stencil test matters: the views have the same stencils so far.
pub(super) fn asks_stencil(known: &Known) -> bool {
    known.mono.same & c::STENCIL_BUFFER_BIT != 0
}

/// Updates the common contents for a planned command, and leaves a mono frame if the command depends on the view.
pub(super) fn watch(facts: &Facts, known: &mut Known, plan: &Plan, effects: &mut Vec<Effect>) {
    if plan.method == Method::Once || known.scene.is_some() || !facts.destination.is_window() {
        return;
    }
    let kind = facts.traits.kind;
    if let Kind::Clear { whole, .. } = kind {
        let shared = known.mono.may_share(whole);
        if facts.rects.scissor.is_none() && !facts.destination.front {
            known.mono.same |= shared & facts.clear.writable;
        }
        return;
    }
    let list = kind == Kind::List;
    // The raster position moves with a point of the scene.
    let placed = kind == Kind::Pixels && facts.raster_moves();
    if plan.shear.is_some()
        || placed
        || kind == Kind::Accum
        || facts.reads_views
        || (list && facts.destination.copies)
    {
        if known.mono.active {
            known.mono.active = false;
            effects.push(Effect::LeaveMono);
        }
        known.mono.differ(list || facts.state.stencil);
    }
}
