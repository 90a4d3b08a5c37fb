//! Mono frames: they are the same in all views, such as menus and programs without depth. Only the program's own view is drawn, and the panel
//! shows it. The other views get a copy of it as soon as something is drawn that depends on the view.

use super::{Layer, with_raw_copies};
use crate::config::{CaptureWhat, Filter, Optimisation, Output};
use crate::gl::{Gl, consts as c};
use crate::plan::decide::ALL_BUFFERS;
use crate::state::BACK;

impl Layer {
    /// Whether the frame is drawn in the program's own view only.
    pub(super) fn is_mono(&self) -> bool {
        self.known.mono.active
    }

    /// The next command copies something that depends on the view to the window.
    pub(super) fn differ(&mut self, gl: &Gl) {
        self.leave_mono(gl);
        let stencil = self.known.mono.same & c::STENCIL_BUFFER_BIT != 0;
        self.known
            .mono
            .differ(stencil && gl.is_enabled(c::STENCIL_TEST));
    }

    /// Gives the other views their contents, where only some views were drawn so far, and draws all views from now on.
    pub(super) fn leave_mono(&mut self, gl: &Gl) {
        self.synthesise_views(gl);
        self.draw_all_views(gl);
    }

    /// Ends a mono frame: copies the program's own view to the others, and draws all views from now on.
    pub(super) fn draw_all_views(&mut self, gl: &Gl) {
        if self.state.framebuffers.has_eyes() || !std::mem::take(&mut self.known.mono.active) {
            return;
        }
        self.targets.atlas.tiles.shown = self.shown();
        self.queries.pause(gl);
        self.queries.lift_condition(gl);
        with_raw_copies(gl, || {
            self.reading(gl, BACK, |layer| layer.targets.atlas.share_own(gl));
        });
        self.rebind(gl);
        self.queries.put_condition(gl);
        self.queries.resume(gl);
    }

    /// After a frame: draws the next one in the program's own view only, where that is possible, for as long as nothing depends on the view.
    pub(super) fn enter_mono(&mut self, gl: &Gl) {
        let mono = self.state.framebuffers.has_eyes() || self.may_enter_mono();
        if mono {
            self.known.mono.active = true;
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
        self.known.mono.same == ALL_BUFFERS
            && self.session.config.views > 1
            && self.session.config.strategy.disocclusion_source().is_none()
            && !self.session.config.disabled.has(Optimisation::MonoFrames)
            && self.session.support.shares
            && !self.is_plain()
            && self.targets.atlas.tiles.grid.is_full()
            && self.targets.back_alone()
            && !self.has_copies()
            && !self.targets.undrawn
            && self.session.config.prove.is_none()
            && captured.is_none_or(|what| what == CaptureWhat::Output)
            && self.shows_one_view()
            && self.window_output().is_none()
    }

    /// Whether the picture of views that are all the same is the same as any of them: each subpixel shows one view, without a filter.
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
