//! A canvas for each drawable that a context draws to: its atlas, and what is known of its frame. That of the drawable which is current lies
//! in the layer's own fields; the others are parked.
//!
//! Whoever leaves a drawable draws the picture into the true framebuffer 0 first. So whatever shows the drawable next, from any thread and
//! with any context, shows what was drawn.

use super::accumulate::Accumulated;
use super::fit::{Fitted, fit_first};
use super::frame::Frame;
use super::reading::{DrawableId, Reading};
use super::{Layer, OnScreen, with_raw_copies};
use crate::atlas::Atlas;
use crate::config::Strategy;
use crate::gl::{FramebufferName, Gl, TextureName, consts as c};
use crate::plan::Unrepresentable;
use crate::plan::decide::{self, DepthWatch, Detail, Mono};
use crate::state::{BACK, Begin, Touch, Window};
use std::mem::swap;

/// Parked canvases of windows that are kept, though nothing in them waits to be shown.
const KEPT: usize = 4;

/// A drawable that is current.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CurrentDrawable {
    /// Which one.
    pub id: DrawableId,
    /// Width and height in pixels.
    pub size: (u32, u32),
}

impl CurrentDrawable {
    /// The context is current without a drawable.
    pub const NONE: CurrentDrawable = CurrentDrawable {
        id: DrawableId(u64::MAX),
        size: (1, 1),
    };
}

/// What a context has drawn to a drawable that is not current. More than 12 fields: all that the owners of the layer know of one drawable.
#[derive(Debug)]
struct Canvas {
    id: DrawableId,
    window: Window,
    /// That of the atlas.
    strategy: Strategy,
    atlas: Atlas,
    accumulated: Accumulated,
    detail: Detail,
    stuck: bool,
    undrawn: bool,
    frame: Frame,
    known: decide::Frame,
    depths: DepthWatch,
    synthesised: bool,
    mono: Mono,
    on_screen: Option<OnScreen>,
}

/// The canvases of a context.
#[derive(Debug)]
pub(super) struct Canvases {
    /// The drawable whose canvas the layer's fields are.
    current: DrawableId,
    reading: Reading,
    /// The canvas that is read from lies in the layer's fields, while the true framebuffer 0 that is drawn to is that of another drawable.
    aside: bool,
    /// Those of others, the one that was left last at the end.
    parked: Vec<Canvas>,
}

impl Canvases {
    /// For a context whose first drawable this is.
    pub(super) fn new(current: DrawableId) -> Self {
        Canvases {
            current,
            reading: Reading::Drawn,
            aside: false,
            parked: Vec::new(),
        }
    }

    /// What framebuffer 0 is read from.
    pub(super) fn reading(&self) -> Reading {
        self.reading
    }

    /// Whether the canvas that is read from lies in the layer's fields in the place of the one that is drawn to. What is drawn to the true
    /// framebuffer 0 reaches another drawable then.
    pub(super) fn is_aside(&self) -> bool {
        self.aside
    }

    /// The atlas of the drawable that is read from, where it is a parked one.
    pub(super) fn read(&self) -> Option<&Atlas> {
        let Reading::Parked(id) = self.reading else {
            return None;
        };
        self.parked.iter().find(|c| c.id == id).map(|c| &c.atlas)
    }

    /// Binds the copy of a tile of [`Canvases::read`] for reading.
    pub(super) fn bind_single(&self, gl: &Gl) {
        if let Some(single) = self.read().and_then(Atlas::single) {
            gl.bind_framebuffer(c::READ_FRAMEBUFFER, single);
        }
    }

    /// The atlases of the drawables that are not current.
    pub(super) fn atlases(&self) -> impl Iterator<Item = &Atlas> {
        self.parked.iter().map(|canvas| &canvas.atlas)
    }

    /// The same, to be changed.
    pub(super) fn atlases_mut(&mut self) -> impl Iterator<Item = &mut Atlas> {
        self.parked.iter_mut().map(|canvas| &mut canvas.atlas)
    }

    /// The accumulation buffers of the drawables that are not current.
    pub(super) fn accumulated(&self) -> impl Iterator<Item = &Accumulated> {
        self.parked.iter().map(|canvas| &canvas.accumulated)
    }

    /// Whether a texture is one of these canvases'.
    pub(super) fn owns_texture(&self, name: TextureName) -> bool {
        let mut accumulations = self.accumulated().flat_map(|a| &a.buffer);
        self.atlases().any(|atlas| atlas.owns(name))
            || accumulations.any(|buffer| buffer.owns(name))
    }

    /// Whether a framebuffer object is one of these canvases'.
    pub(super) fn owns_framebuffer(&self, name: FramebufferName) -> bool {
        let mut accumulations = self.accumulated().flat_map(|a| &a.buffer);
        self.atlases()
            .any(|atlas| atlas.framebuffers().any(|own| own == name))
            || accumulations.any(|buffer| buffer.framebuffer() == name)
    }
}

impl Canvas {
    fn delete(self, gl: &Gl) {
        self.atlas.delete(gl);
        if let Some(buffer) = self.accumulated.buffer {
            buffer.delete(gl);
        }
    }
}

impl Layer {
    /// The program has made drawables current, with this context: one to draw to, and one to read from. `elsewhere` tells whether another
    /// context has drawn to a drawable last, so that the true framebuffer 0 has its contents, and `lives` whether the program still has it.
    pub fn switch(
        &mut self,
        gl: &Gl,
        [drawable, read]: [CurrentDrawable; 2],
        elsewhere: &dyn Fn(DrawableId) -> bool,
        lives: &dyn Fn(DrawableId) -> bool,
    ) {
        if self.state.list.is_some() {
            // What is set now would be compiled into the program's list.
            return self.outside_list(gl, |layer| {
                layer.switch(gl, [drawable, read], elsewhere, lives)
            });
        }
        self.flush_points(gl);
        self.yield_taken_names(gl);
        let as_before = [drawable.id, read.id] == [self.canvases.current; 2]
            && self.canvases.reading == Reading::Drawn
            && drawable.size == self.size();
        let imported = elsewhere(drawable.id);
        if as_before && !imported {
            return;
        }
        self.canvases.reading = Reading::Drawn;
        self.state.keep_errors(gl);
        if drawable.id != self.canvases.current {
            self.drop_proof(gl);
            self.forget_scene();
            let parked = &mut self.canvases.parked;
            let found = parked.iter().position(|c| c.id == drawable.id);
            let mut canvas = match found.map(|at| parked.remove(at)) {
                Some(canvas) => canvas,
                None => self.new_canvas(gl, drawable),
            };
            let remade = canvas.strategy != self.session.strategy;
            self.exchange(&mut canvas);
            canvas.strategy = self.session.strategy;
            if remade {
                self.remake(gl);
            }
            self.canvases.parked.push(canvas);
            self.drop_canvases(gl, lives);
        }
        let (width, height) = drawable.size;
        self.resize(gl, width, height);
        if read.id != drawable.id {
            self.read_from_canvas(gl, read, elsewhere(read.id));
        }
        self.enter_canvas(gl);
        if imported {
            self.import(gl);
        }
        // Where there is no drawable, it has no buffers to choose.
        gl.drop_errors();
    }

    /// Reads from another drawable than is drawn to, from now on.
    fn read_from_canvas(&mut self, gl: &Gl, read: CurrentDrawable, elsewhere: bool) {
        let parked = self.canvases.parked.iter().any(|c| c.id == read.id);
        if !parked || elsewhere {
            self.canvases.reading = Reading::True;
            return;
        }
        self.canvases.reading = Reading::Parked(read.id);
        self.in_read_canvas(gl, |layer| {
            let (width, height) = read.size;
            layer.resize(gl, width, height);
            layer.draw_all_views(gl);
        });
    }

    /// Runs `work` with the canvas that is read from in the layer's fields. Binds framebuffers where that is another one than is drawn to.
    pub(super) fn in_read_canvas<R>(&mut self, gl: &Gl, work: impl FnOnce(&mut Self) -> R) -> R {
        let Reading::Parked(id) = self.canvases.reading else {
            return work(self);
        };
        let found = self.canvases.parked.iter().position(|c| c.id == id);
        let Some(mut canvas) = found.map(|at| self.canvases.parked.remove(at)) else {
            return work(self);
        };
        self.canvases.reading = Reading::Drawn;
        self.canvases.aside = true;
        self.exchange(&mut canvas);
        let done = work(self);
        self.exchange(&mut canvas);
        self.canvases.aside = false;
        self.canvases.reading = Reading::Parked(id);
        self.canvases.parked.push(canvas);
        self.rebind(gl);
        done
    }

    /// Makes a canvas for a drawable that the context draws to for the first time.
    fn new_canvas(&mut self, gl: &Gl, drawable: CurrentDrawable) -> Canvas {
        gl.bind_framebuffer(c::FRAMEBUFFER, FramebufferName::ZERO);
        let (width, height) = drawable.size;
        let before = self.state.window.buffers;
        let mut window = Window::ask(gl, width, height, self.session.support.compatibility);
        window.choose_buffers(window.buffers.double_buffered != before.double_buffered);
        let (detail, fitted) = match drawable {
            CurrentDrawable::NONE => {
                let atlas = Atlas::plain(&window, self.session.config.views);
                (Detail::Full, Fitted { atlas, told: None })
            }
            _ => {
                let (names, on_gpu) = (&mut self.targets.names, self.targets.interleaver.on_gpu());
                fit_first(gl, names, &self.session, &window, on_gpu)
            }
        };
        let stuck = fitted.told.is_some();
        fitted.told.into_iter().for_each(|told| self.announce(told));
        Canvas {
            id: drawable.id,
            window,
            strategy: self.session.strategy,
            stuck,
            atlas: fitted.atlas,
            accumulated: Accumulated::default(),
            detail,
            undrawn: false,
            frame: Frame::default(),
            known: decide::Frame::default(),
            depths: DepthWatch::default(),
            synthesised: false,
            mono: Mono::default(),
            on_screen: None,
        }
    }

    /// Exchanges the canvas in the layer's fields for another one. The caller binds framebuffers.
    fn exchange(&mut self, canvas: &mut Canvas) {
        swap(&mut self.canvases.current, &mut canvas.id);
        swap(&mut self.state.window, &mut canvas.window);
        swap(&mut self.targets.atlas, &mut canvas.atlas);
        swap(&mut self.targets.accumulated, &mut canvas.accumulated);
        swap(&mut self.targets.detail, &mut canvas.detail);
        swap(&mut self.targets.stuck, &mut canvas.stuck);
        swap(&mut self.targets.undrawn, &mut canvas.undrawn);
        swap(&mut self.frame, &mut canvas.frame);
        swap(&mut self.known.frame, &mut canvas.known);
        swap(&mut self.known.depths, &mut canvas.depths);
        swap(&mut self.known.synthesised, &mut canvas.synthesised);
        swap(&mut self.known.mono, &mut canvas.mono);
        swap(&mut self.session.on_screen, &mut canvas.on_screen);
        self.state.framebuffers.belong_to(&self.state.window);
    }

    /// Runs `work` with each canvas in the layer's fields, the current one last.
    pub(super) fn in_each_canvas(&mut self, mut work: impl FnMut(&mut Self)) {
        let mut parked = std::mem::take(&mut self.canvases.parked);
        for canvas in &mut parked {
            self.exchange(canvas);
            work(self);
            self.exchange(canvas);
        }
        self.canvases.parked = parked;
        work(self);
    }

    /// Deletes the canvases of drawables that are gone, and the oldest ones of windows that have nothing to show.
    fn drop_canvases(&mut self, gl: &Gl, lives: &dyn Fn(DrawableId) -> bool) {
        let parked = std::mem::take(&mut self.canvases.parked);
        let mut spare = parked.len().saturating_sub(KEPT);
        for canvas in parked {
            let shown = canvas.window.buffers.double_buffered && !canvas.frame.drawn();
            let dropped = shown && spare > 0 && !canvas.atlas.is_plain();
            spare -= usize::from(dropped);
            let lives = canvas.id == CurrentDrawable::NONE.id || lives(canvas.id);
            if dropped || !lives {
                canvas.delete(gl);
            } else {
                self.canvases.parked.push(canvas);
            }
        }
    }

    /// Draws to another canvas from now on.
    fn enter_canvas(&mut self, gl: &Gl) {
        let buffers = self.state.window.buffers;
        if !buffers.es {
            gl.bind_framebuffer(c::FRAMEBUFFER, FramebufferName::ZERO);
            // Some drivers have one for each context, others for each drawable.
            self.state.framebuffers.read_buffer = gl.get_integer(c::READ_BUFFER) as u32;
            gl.draw_buffer(buffers.default_draw);
            gl.read_buffer(buffers.default_read);
        }
        self.apply_buffers(gl);
        self.rebind(gl);
        self.state
            .touch(Touch::BUFFERS | Touch::OBJECTS | Touch::DEPTH);
        if gl.is_srgb_enabled() {
            self.enable_srgb(gl);
        }
    }

    /// Takes what the true framebuffer 0 has into each view.
    pub(super) fn import(&mut self, gl: &Gl) {
        if self.is_plain() {
            return;
        }
        self.state.keep_errors(gl);
        self.hold_everything(gl, Unrepresentable::Contexts);
        if self.is_plain() {
            return;
        }
        self.draw_all_views(gl);
        self.queries.pause(gl);
        self.queries.lift_condition(gl);
        for target in self.targets.atlas.targets() {
            gl.bind_framebuffer(c::FRAMEBUFFER, target);
            gl.draw_buffers(&[BACK]);
            gl.read_buffer(BACK);
        }
        let size = [self.state.window.width, self.state.window.height];
        with_raw_copies(gl, || {
            self.targets.atlas.import(gl, size);
            self.targets.atlas.share_own(gl);
        });
        // Depths of other formats than the driver's are refused.
        gl.drop_errors();
        self.apply_buffers(gl);
        self.rebind(gl);
        self.queries.put_condition(gl);
        self.queries.resume(gl);
    }

    /// The program leaves the drawable. `handed_over`: another context draws to it next.
    pub fn leave_drawable(&mut self, gl: &Gl, handed_over: bool) {
        self.flush_points(gl);
        self.give_read_buffer(gl);
        self.picture_unfinished(gl, handed_over);
        if self.diagnostics.report.frames() == 0 && self.session.group.has_others() {
            // Another context may show what this one draws.
            self.diagnostics.report_fallbacks();
            let mut unshown = self.session.group.unshown();
            unshown.absorb(&mut self.diagnostics.report);
        }
    }

    /// Draws the picture of what was drawn so far into the true framebuffer 0, where that does not have it. `handed_over`: another context
    /// draws to it next, and gets what the own view shows.
    pub fn picture_unfinished(&mut self, gl: &Gl, handed_over: bool) {
        let wanted = self.frame.is_stale() || handed_over;
        if !wanted || self.is_plain() || self.is_hidden() || !self.may_show() {
            return;
        }
        self.synthesise_views(gl);
        if handed_over {
            self.state.keep_errors(gl);
        }
        self.in_neutral(gl, |layer, neutral| match handed_over {
            true => layer.show_own_view(gl),
            false => layer.present_unfinished(gl, neutral),
        });
        if handed_over {
            // Depths of other formats than the driver's are refused.
            gl.drop_errors();
        }
        self.frame.pictured();
    }

    /// Sets the program's read buffer in the true framebuffer 0, from which the next context or drawable may have it.
    fn give_read_buffer(&mut self, gl: &Gl) {
        let (name, buffers) = (
            self.state.framebuffers.read_buffer,
            self.state.window.buffers,
        );
        let kept = name == buffers.default_read || buffers.es || self.is_plain();
        if kept || self.state.begin != Begin::Outside {
            return;
        }
        self.outside_list(gl, |layer| {
            gl.bind_framebuffer(c::READ_FRAMEBUFFER, FramebufferName::ZERO);
            gl.read_buffer(name);
            layer.rebind(gl);
        });
    }

    /// Whether something was drawn to the current drawable that the true framebuffer 0 does not have.
    pub fn is_ahead(&self) -> bool {
        self.frame.is_stale()
    }

    /// A drawable was shown that is not current: its frame has ended. Returns whether this context has drawn it.
    pub fn shown_aside(&mut self, id: DrawableId) -> bool {
        let canvas = self.canvases.parked.iter_mut().find(|c| c.id == id);
        let Some(canvas) = canvas.filter(|c| c.frame.drawn()) else {
            return false;
        };
        canvas.frame.end();
        canvas.known = canvas.known.next();
        canvas.synthesised = false;
        true
    }
}
