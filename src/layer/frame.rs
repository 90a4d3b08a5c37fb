//! The end of a frame: interleave, capture, report.

use super::Layer;
use crate::atlas::ViewSet;
use crate::config::Output;
use crate::display::Placement;
use crate::gl::{FramebufferName, Gl, ListName, consts as c};
use crate::interleave::{Depth, Interleaver, PanelPlacement, Source};
use crate::present::capture;
use crate::state::{BACK, FRONT, Neutral};
use crate::view::ViewIndex;
use image::RgbImage;

/// What has happened in the frame so far.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Frame {
    /// The display list that is being called.
    list: Option<ListName>,
    /// Something was drawn that is to be shown.
    drawn: bool,
    /// The true framebuffer 0 has a picture of all that was drawn.
    pictured: bool,
    /// A draw since the last timed frame was made by another strategy than replay.
    amplifies: bool,
    /// A draw is being sent for other views than the program's own, which is last.
    owes_own_view: bool,
}

impl Frame {
    /// A draw is sent for each view from now on, or has reached the program's own view (false).
    pub(super) fn owe_own_view(&mut self, owes: bool) {
        self.owes_own_view = owes;
    }

    /// Whether a draw is being sent for other views than the program's own.
    pub(super) fn owes_own_view(&self) -> bool {
        self.owes_own_view
    }

    /// The program calls a display list; none where its call has ended, or the list's name is not known.
    pub(super) fn calls(&mut self, list: Option<ListName>) {
        self.list = list;
    }

    /// The display list that is being called.
    pub(super) fn list(&self) -> Option<ListName> {
        self.list
    }

    /// Something is drawn that is to be shown.
    pub(super) fn draws(&mut self) {
        self.drawn = true;
        self.pictured = false;
    }

    /// The true framebuffer 0 has a picture of all that was drawn.
    pub(super) fn pictured(&mut self) {
        self.pictured = true;
    }

    /// Whether something was drawn of which the true framebuffer 0 has no picture.
    pub(super) fn is_stale(&self) -> bool {
        self.drawn && !self.pictured
    }

    /// Whether something was drawn that is to be shown.
    pub(super) fn drawn(&self) -> bool {
        self.drawn
    }

    /// A draw is made by another strategy than replay.
    pub(super) fn amplifies(&mut self) {
        self.amplifies = true;
    }

    /// Takes whether any draw since the last call was made by another strategy than replay.
    pub(super) fn take_amplified(&mut self) -> bool {
        std::mem::take(&mut self.amplifies)
    }

    /// The frame is shown, and the next one begins. A flush shows a frame without a time, so what amplifies is kept.
    pub(super) fn end(&mut self) {
        self.drawn = false;
        self.list = None;
    }
}

impl Layer {
    /// Shows the frame in the true framebuffer 0. The caller swaps (`swap`) or flushes after it. The program's state is as before.
    pub fn show(&mut self, gl: &Gl, swap: bool) {
        if !self.may_show() {
            return;
        }
        self.flush_points(gl);
        self.finish_explanation(gl);
        self.refit(gl);
        if self.is_plain() {
            return self.end_plain_frame();
        }
        if self.is_mono() {
            self.enter_mono(gl);
        }
        let eyes = self.state.framebuffers.has_eyes();
        if eyes {
            self.spread_eyes(gl);
            self.known.mono.active = false;
            self.targets.atlas.tiles.shown = ViewSet::ALL;
        }
        super::orphans::delete_orphans(gl, &self.session.group);
        self.in_neutral(gl, |layer, neutral| layer.show_picture(gl, swap, neutral));
        self.known.mono.active |= eyes;
        if swap {
            self.state.framebuffers.swapped();
        }
        if swap {
            if self.is_mono() {
                self.diagnostics.report.mono_frame();
            }
            self.time_frame(gl);
            self.count_for_osd();
            self.enter_mono(gl);
        }
        self.realign_tiles();
        self.frame.end();
        self.known.frame = self.known.frame.next();
    }

    /// The program has drawn the picture itself, into the true framebuffer 0.
    fn end_plain_frame(&mut self) {
        self.leave_scene();
        self.frame.end();
        self.known.frame = self.known.frame.next();
    }

    /// Whether the layer can draw a picture: it would be compiled into the program's list, be a hit of its selection, or be fed back to it.
    pub(super) fn may_show(&self) -> bool {
        self.state.list.is_none()
            && self.state.begin == crate::state::Begin::Outside
            && self.state.primitives.render_mode == c::RENDER
    }

    /// Makes the picture of what was drawn to the back buffer, or to the front one, and readies the atlas for the next frame.
    fn show_picture(&mut self, gl: &Gl, swap: bool, neutral: &Neutral) {
        // A flush shows what is drawn to the front buffer; where that is the only image, so does a swap.
        let front =
            !swap && self.targets.atlas.has_front() && self.state.framebuffers.draws_front();
        let image = if front { FRONT } else { BACK };
        self.reading(gl, image, |layer| layer.present(gl, image, neutral));
        self.leave_scene();
        if !swap || !self.state.window.buffers.double_buffered {
            // At a flush Mesa shows the front buffer of the framebuffer that is bound.
            gl.bind_framebuffer(c::FRAMEBUFFER, FramebufferName::ZERO);
            gl.flush();
        }
        if image == FRONT {
            gl.draw_buffer(self.state.window.buffers.default_draw);
            gl.read_buffer(self.state.window.buffers.default_read);
        }
        let used = self.state.framebuffers.uses_front();
        // That is the right eye's picture otherwise.
        let front = !self.state.framebuffers.has_eyes();
        if swap && front && self.targets.atlas.swapped(gl, used) {
            self.apply_buffers(gl);
        }
        self.next_proof(gl);
    }

    /// Draws the picture into the true framebuffer 0 and captures what is wanted.
    fn present(&mut self, gl: &Gl, image: u32, neutral: &Neutral) {
        self.end_scene(gl, neutral);
        let depth = self.resolve_pictures(gl, neutral);
        gl.bind_framebuffer(c::FRAMEBUFFER, FramebufferName::ZERO);
        if image == FRONT {
            gl.draw_buffer(c::FRONT);
            gl.read_buffer(c::FRONT);
        }
        let exact = self.exact_picture(gl, image, neutral);
        self.draw_panel(gl, image, depth.as_ref(), neutral);
        self.draw_picture(gl, image, depth.as_ref(), neutral);
        self.judge_proof(gl, neutral, exact);
        let source = self.source(image, depth.as_ref());
        self.capture(gl, neutral, image, &source);
        if self.session.panel.size.is_none() {
            gl.bind_framebuffer(c::FRAMEBUFFER, FramebufferName::ZERO);
            let (width, height) = self.size();
            self.draw_osd(gl, neutral, image, (self.output(), [width, height]));
        }
        self.track_depths(gl, neutral);
    }

    /// Draws the picture of the back buffer as it is now into the true framebuffer 0; the frame goes on. Changes the framebuffers that are
    /// bound.
    pub(super) fn present_unfinished(&mut self, gl: &Gl, neutral: &Neutral) {
        self.reading(gl, BACK, |layer| {
            let depth = layer.resolve_pictures(gl, neutral);
            gl.bind_framebuffer(c::FRAMEBUFFER, FramebufferName::ZERO);
            layer.draw_picture(gl, BACK, depth.as_ref(), neutral);
        });
    }

    /// Resolves the views that are shown, and reads the depth of the own one where the output has it. Changes the framebuffers that are bound.
    fn resolve_pictures(&mut self, gl: &Gl, neutral: &Neutral) -> Option<Depth> {
        if self.synthesis.straight().is_none() {
            let views = match self.is_mono() {
                true => self.targets.atlas.tiles.own_alone(),
                false => ViewSet::ALL,
            };
            self.targets.atlas.resolve(gl, &views, c::COLOR_BUFFER_BIT);
        }
        (self.output() == Output::Rgbd).then(|| self.own_depth(gl, neutral))
    }

    /// The source of pictures: the atlas, with one of its images.
    fn source<'a>(&self, image: u32, depth: Option<&'a Depth>) -> Source<'a> {
        Source {
            tiles: self.targets.atlas.tiles,
            texture: self.targets.atlas.sampled(image),
            depth: depth.map(|depth| (self.targets.atlas.depth, depth)),
            pyramid: self.synthesis.straight(),
            top_down: self.targets.atlas.flipped,
            srgb: self.state.window.srgb,
        }
    }

    /// Draws the picture of the atlas for the program's window into the framebuffer that is bound, the true 0.
    pub(super) fn draw_picture(
        &mut self,
        gl: &Gl,
        image: u32,
        depth: Option<&Depth>,
        neutral: &Neutral,
    ) {
        let output = match self.session.panel.size {
            Some(_) => self
                .window_output()
                .unwrap_or(Output::View(self.targets.atlas.tiles.own().0)),
            None => self.output(),
        };
        let placement = self.session.window_placement(self.size());
        self.draw_output(gl, image, depth, neutral, (output, placement));
    }

    /// Draws a picture of the atlas over a rectangle of the framebuffer that is bound, from its lower left corner on, of the size that the placement
    /// has.
    pub(super) fn draw_output(
        &mut self,
        gl: &Gl,
        image: u32,
        depth: Option<&Depth>,
        neutral: &Neutral,
        (output, placement): (Output, Placement),
    ) {
        let source = self.source(image, depth);
        let pictures = match self.is_mono() {
            true => vec![(None, Output::View(self.targets.atlas.tiles.own().0))],
            false => self.pictures(output, image),
        };
        let panel = PanelPlacement {
            display: self.session.display(),
            placement,
        };
        for (buffer, output) in pictures {
            if let Some(buffer) = buffer {
                gl.draw_buffer(buffer);
            }
            let interleaver = &mut self.targets.interleaver;
            let draw = |interleaver: &mut Interleaver, output| {
                let tile = &mut |view| tile(gl, neutral, &self.targets.atlas, view);
                let config = self.session.config;
                interleaver.draw(gl, neutral, config, &source, tile, output, &panel)
            };
            let mut drawn = draw(interleaver, output);
            self.state.keep(interleaver.take_errors());
            if interleaver.is_mask_refused() {
                // That of the program, which needs no mask.
                drawn = draw(interleaver, Output::View(source.tiles.own().0));
                let why = "the driver takes no mask of the panel, perhaps for lack of memory: the program's own view is shown meanwhile";
                self.diagnostics.announce(why.into());
            }
            if let Err(e) = drawn {
                self.diagnostics.report.note(e);
            }
            if buffer.is_some() {
                gl.draw_buffer(self.state.window.buffers.default_draw);
            }
        }
    }

    /// The depth of the program's own view. Changes the framebuffers that are bound.
    pub(super) fn own_depth(&self, gl: &Gl, neutral: &Neutral) -> Depth {
        let tiles = &self.targets.atlas.tiles;
        let (width, height) = (tiles.width, tiles.height);
        let reversed = self.known.frame.nearer_is_larger.unwrap_or(false);
        let mut values = Vec::with_capacity(width as usize * height as usize);
        if !self.targets.atlas.depth.is_zero() {
            self.targets.atlas.resolve(
                gl,
                &self.targets.atlas.tiles.own_alone(),
                c::DEPTH_BUFFER_BIT,
            );
            let (from, x) = self.targets.atlas.readable(tiles.own());
            gl.bind_framebuffer(c::READ_FRAMEBUFFER, from);
            let read = gl.read_depth32(neutral.pixels(), x, 0, width, height);
            values.extend(read.rchunks_exact(width as usize).flatten());
        }
        Depth::new((width, height), values, reversed)
    }

    /// Binds the framebuffers that the program has bound, after others were.
    pub(super) fn rebind(&mut self, gl: &Gl) {
        let f = &self.state.framebuffers;
        let (draw, read) = (f.draw, f.read);
        if !draw.is_zero() {
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, draw);
        }
        if !read.is_zero() {
            gl.bind_framebuffer(c::READ_FRAMEBUFFER, read);
        }
        self.bind_draw(gl, true, true);
    }

    /// The program's own view as it is now, row 0 on top. The program's state is as before.
    pub(super) fn own_view(&mut self, gl: &Gl) -> RgbImage {
        self.in_neutral(gl, |layer, neutral| {
            layer.reading(gl, BACK, |layer| {
                let atlas = &layer.targets.atlas;
                let own = atlas.tiles.own_alone();
                atlas.resolve(gl, &own, c::COLOR_BUFFER_BIT);
                tile(gl, neutral, atlas, atlas.tiles.own())
            })
        })
    }

    /// Place of the picture on the panel, in pixels. Where the window system does not report the window's, the picture is taken to be the whole
    /// screen.
    pub(super) fn placement(&self) -> Placement {
        self.session.placement(self.size())
    }

    /// Counts the frame and writes the report where one is asked for.
    pub fn count_frame(&mut self) {
        let views = self.session.config.views;
        if let Some(ms) = self.diagnostics.report.frame()
            && let Some(drawn) = self.synthesis.timed(ms, views)
        {
            self.diagnostics.report.drew(ms, drawn);
        }
        let parked: u64 = self.canvases.atlases().map(|atlas| atlas.bytes).sum();
        let current = self.targets.atlas.bytes;
        self.diagnostics.report.memory(current + parked);
        self.diagnostics.report_fallbacks();
        let mut unshown = self.session.group.unshown();
        self.diagnostics.report.absorb(&mut unshown);
        drop(unshown);
        self.count_names();
        self.diagnostics.report.write_if_due(self.session.config);
    }

    /// Whether a flush shows what was drawn: it went to the front buffer, or there is no other, and somebody can see it.
    pub fn shows_on_flush(&self) -> bool {
        self.frame.drawn()
            && !self.is_hidden()
            && (!self.state.window.buffers.double_buffered || self.state.framebuffers.draws_front())
    }

    /// Whether what was drawn is shown by a swap, after which the drawable may hold anything.
    pub fn has_back_buffer(&self) -> bool {
        self.state.window.buffers.double_buffered
    }

    /// Whether something was drawn since the last frame was shown.
    pub fn drawn(&self) -> bool {
        self.frame.drawn()
    }
}

/// One view's picture, row 0 on top. Changes the read framebuffer.
pub(super) fn tile(
    gl: &Gl,
    neutral: &Neutral,
    atlas: &crate::atlas::Atlas,
    view: ViewIndex,
) -> RgbImage {
    let (from, x) = atlas.readable(view);
    gl.bind_framebuffer(c::READ_FRAMEBUFFER, from);
    capture::read_rgb(gl, neutral, x, 0, atlas.tiles.width, atlas.tiles.height)
}
