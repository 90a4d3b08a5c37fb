//! Frames that are the same in all views, such as menus and programs without depth: only the program's own view is drawn, and it is
//! what the panel shows. The others get what it has as soon as something is drawn that depends on the view.

use super::{Layer, as_they_are};
use crate::config::{CaptureWhat, Filter, Optimisation, Output};
use crate::gl::{Gl, consts as c};
use crate::plan::{Kind, Method, Plan};
use crate::state::BACK;

const COLOURS_AND_DEPTHS: u32 = c::COLOR_BUFFER_BIT | c::DEPTH_BUFFER_BIT;
const EVERYTHING: u32 = COLOURS_AND_DEPTHS | c::STENCIL_BUFFER_BIT;

/// What the views have in common.
#[derive(Clone, Copy, Debug)]
pub(super) struct MonoFrames {
    /// The buffers, as bits of glClear, that are the same in all views.
    same: u32,
    /// Only the program's own view is drawn.
    active: bool,
}

impl Default for MonoFrames {
    /// A new window's contents are undefined, so they may well be the same.
    fn default() -> Self {
        MonoFrames {
            same: EVERYTHING,
            active: false,
        }
    }
}

impl MonoFrames {
    /// A draw went to the program's own view only.
    pub(super) fn lose(&mut self) {
        if !self.active {
            self.same = 0;
        }
    }
}

impl Layer {
    /// Whether the frame is drawn in the program's own view only.
    pub(super) fn is_mono(&self) -> bool {
        self.targets.mono.active
    }

    /// Before a draw that is planned.
    pub(super) fn watch_mono(&mut self, gl: &Gl, kind: Kind, plan: &Plan) {
        if plan.method == Method::Once || self.synthesis.is_on() || !self.state.draws_to_window() {
            return;
        }
        if let Kind::Clear { whole, .. } = kind {
            return self.cleared(gl, whole);
        }
        // The raster position stands for a point of the scene.
        let placed = kind == Kind::Pixels && self.cameras.raster.is_some();
        if plan.shear.is_some()
            || placed
            || matches!(kind, Kind::Accum)
            || !self.variants.sampled.is_empty()
            || (kind == Kind::List && self.has_copies())
        {
            self.differ(gl, kind == Kind::List);
        }
    }

    /// What is drawn next depends on the view. `list`: it may change the state of the stencil test itself.
    pub(super) fn differ(&mut self, gl: &Gl, list: bool) {
        self.leave_mono(gl);
        let same = &mut self.targets.mono.same;
        *same &= !COLOURS_AND_DEPTHS;
        if *same != 0 && (list || gl.is_enabled(c::STENCIL_TEST)) {
            *same = 0;
        }
    }

    /// A clear, of these buffers for certain.
    fn cleared(&mut self, gl: &Gl, buffers: u32) {
        let new = buffers & EVERYTHING & !self.targets.mono.same;
        if new == 0 || self.state.scissor_test || self.targets.atlas.has_front() {
            return;
        }
        let written = [
            (
                c::COLOR_BUFFER_BIT,
                gl.get_integers::<4>(c::COLOR_WRITEMASK) == [1; 4],
            ),
            (c::DEPTH_BUFFER_BIT, gl.get_integer(c::DEPTH_WRITEMASK) != 0),
            (
                c::STENCIL_BUFFER_BIT,
                gl.get_integer(c::STENCIL_WRITEMASK) & 0xFF == 0xFF,
            ),
        ];
        for (bit, _) in written.iter().filter(|(bit, all)| new & bit != 0 && *all) {
            self.targets.mono.same |= bit;
        }
    }

    /// The other views get what the program's own one has, and are drawn again.
    pub(super) fn leave_mono(&mut self, gl: &Gl) {
        self.make_views(gl);
        self.draw_all_views(gl);
    }

    fn draw_all_views(&mut self, gl: &Gl) {
        if !std::mem::take(&mut self.targets.mono.active) {
            return;
        }
        self.targets.atlas.tiles.shown = self.shown();
        self.queries.pause(gl);
        self.queries.lift_condition(gl);
        as_they_are(gl, || {
            self.reading(gl, BACK, |layer| layer.targets.atlas.share_own(gl));
        });
        self.rebind(gl);
        self.queries.put_condition(gl);
        self.queries.resume(gl);
    }

    /// After a frame: whether the next one is drawn in the program's own view only, for as long as nothing depends on the view.
    pub(super) fn enter_mono(&mut self, gl: &Gl) {
        let mono = self.may_enter_mono();
        if mono {
            self.targets.mono.active = true;
        } else {
            self.draw_all_views(gl);
        }
    }

    fn may_enter_mono(&self) -> bool {
        let captured = self
            .session
            .config
            .capture
            .as_ref()
            .map(|capture| capture.what);
        self.targets.mono.same == EVERYTHING
            && self.session.config.views > 1
            && self.session.config.strategy.disocclusion_source().is_none()
            && !self.session.config.disabled.has(Optimisation::MonoFrames)
            && self.session.support.shares
            && self.targets.atlas.tiles.grid.is_full()
            && !self.targets.atlas.has_front()
            && self.targets.accumulated.buffer.is_none()
            && !self.has_copies()
            && !self.targets.undrawn
            && self.session.config.prove.is_none()
            && captured.is_none_or(|what| what == CaptureWhat::Output)
            && self.shows_one_view()
    }

    /// Whether the picture of views that are all the same is any of them: each subpixel shows some view, as it is.
    fn shows_one_view(&self) -> bool {
        match self.output() {
            Output::Panel if self.session.config.filter != Filter::Nearest => false,
            output @ (Output::Panel | Output::Interlaced(_)) => {
                self.targets.interleaver.lit(output)
            }
            _ => false,
        }
    }
}
