//! Reads of framebuffer 0 and copies within it: from copies of single tiles where a read must see nothing beside its tile.

use super::draw::Request;
use super::reading::Reading;
use super::{Layer, keep_bindings};
use crate::gl::{FramebufferName, Gl, consts as c};
use crate::plan::Kind;
use crate::state::{BACK, Command, Run, Touch};
use crate::view::ViewIndex;

impl Layer {
    /// A read (glReadPixels, glCopyTex*): from the program's own view, resolved if multisampled. `x` and `width` are its columns in pixels.
    pub fn read(&mut self, gl: &Gl, x: i32, width: i32, call: &mut dyn FnMut()) {
        if self.compiles() {
            self.compile(gl, Command::Of(Run::Read), Touch::NONE);
            return call();
        }
        let read = self.state.framebuffers.read;
        if !read.is_zero() && self.targets.offscreen.is_split(gl, read) {
            self.split(gl, read);
            let own = self
                .targets
                .offscreen
                .view(gl, read, self.targets.atlas.tiles.own());
            gl.bind_framebuffer(c::READ_FRAMEBUFFER, own);
            call();
            gl.bind_framebuffer(c::READ_FRAMEBUFFER, read);
            return;
        }
        if let (FramebufferName::ZERO, Reading::Parked(_)) = (read, self.canvases.reading()) {
            return self.in_read_canvas(gl, |layer| {
                // The canvas was bound for drawing, too, if at all.
                layer.read(gl, x, width, call);
            });
        }
        // A read beyond the right edge of the window must not reach another view.
        let beside =
            self.targets.atlas.tiles.columns > 1 && x.saturating_add(width) > self.tile_size()[0];
        let other = self.targets.atlas.multisampled() || !self.targets.atlas.tiles.grid.is_full();
        let unread = !read.is_zero() || self.canvases.reading() == Reading::True;
        if unread || !(other || beside) {
            return call();
        }
        self.state.refresh(gl);
        if !self.make_singles(gl, false) {
            return call();
        }
        self.take_single(gl, self.targets.atlas.tiles.own());
        let draw = match self.state.framebuffers.draw {
            FramebufferName::ZERO => self.targets.atlas.framebuffer(),
            other => other,
        };
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, draw);
        self.targets.atlas.forget_row();
        call();
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, self.targets.atlas.framebuffer());
    }

    /// A read that is never compiled into a list (glReadPixels).
    pub fn read_now(&mut self, gl: &Gl, x: i32, width: i32, call: &mut dyn FnMut()) {
        self.catch_up(gl);
        let mut done = false;
        self.outside_list(gl, |layer| {
            layer.read(gl, x, width, call);
            done = true;
        });
        if !done {
            call();
        }
    }

    /// Binds a copy of a view's tile for reading. Changes the draw framebuffer. The state must have been refreshed, and the target made by
    /// [`Layer::make_singles`].
    pub(super) fn take_single(&mut self, gl: &Gl, view: ViewIndex) {
        let read = match self.state.framebuffers.read_image() {
            c::NONE => c::NONE,
            _ => BACK,
        };
        self.unscissored(gl, |layer| layer.targets.atlas.take_single(gl, view, read));
    }

    /// Makes the targets of copies of single tiles. False where the driver makes none; the program then draws to the true framebuffer 0.
    pub(super) fn make_singles(&mut self, gl: &Gl, staged: bool) -> bool {
        if self.is_plain() {
            return false;
        }
        if self.targets.atlas.has_singles(staged) {
            return true;
        }
        self.state.keep_errors(gl);
        let made = keep_bindings(gl, || {
            let (names, window) = (&mut self.targets.names, &self.state.window);
            self.targets.atlas.make_singles(gl, names, window, staged)
        });
        if !made {
            self.become_plain(gl);
        }
        made
    }

    /// [`Layer::make_singles`] for the drawable that is read from. False where that is the one that is drawn to, and plain.
    pub(super) fn make_read_singles(&mut self, gl: &Gl) -> bool {
        let made = self.canvases.reading() != Reading::True
            && self.in_read_canvas(gl, |layer| layer.make_singles(gl, false));
        made || self.canvases.reading() != Reading::Drawn
    }

    /// [`Layer::take_single`] of the drawable that is read from; a plain one, or one of which there is no canvas, is the true framebuffer 0.
    pub(super) fn take_read_single(&mut self, gl: &Gl, view: ViewIndex) {
        match self.canvases.reading() {
            Reading::Drawn if !self.is_plain() => self.take_single(gl, view),
            Reading::Parked(_) if self.reads_views() => {
                self.in_read_canvas(gl, |layer| layer.take_single(gl, view));
                self.canvases.bind_single(gl);
            }
            _ => gl.bind_framebuffer(c::READ_FRAMEBUFFER, FramebufferName::ZERO),
        }
    }

    pub(super) fn unscissored<T>(&mut self, gl: &Gl, work: impl FnOnce(&mut Self) -> T) -> T {
        if self.state.rectangles.scissor_test {
            gl.switch_scissor_test(false);
        }
        let answer = work(self);
        if self.state.rectangles.scissor_test {
            gl.switch_scissor_test(true);
        }
        answer
    }

    /// glCopyPixels: copies each view from its own tile. `x` and `width` are its columns in pixels; `call` is the program's own.
    pub fn copy_pixels(&mut self, gl: &Gl, x: i32, width: i32, call: &mut dyn FnMut()) {
        if self.compiles() {
            self.compile(gl, Command::Of(Run::Copy), Touch::NONE);
            return call();
        }
        self.state.refresh(gl);
        if !self.state.draws_to_window() {
            return self.read(gl, x, width, call);
        }
        if !self.reads_from_zero()
            || !self.make_read_singles(gl)
            || gl.get_integer(c::ATTRIB_STACK_DEPTH) >= gl.get_integer(c::MAX_ATTRIB_STACK_DEPTH)
        {
            return self.draw(gl, Kind::Pixels, call);
        }
        self.decide(gl, &Request::of(Kind::Pixels));
        self.in_proof(gl, |layer| layer.copy_views(gl, call));
        self.copy_views(gl, call);
    }

    fn copy_views(&mut self, gl: &Gl, call: &mut dyn FnMut()) {
        let own = self.targets.atlas.tiles.own();
        gl.flush_current();
        self.queries.pause(gl);
        for view in self.targets.atlas.tiles.order() {
            self.take_read_single(gl, view);
            let x = self.targets.atlas.enter(gl, view);
            if view == own {
                self.queries.resume(gl);
            }
            self.scissored(gl, view, x, &mut || {
                if view == own {
                    return call();
                }
                gl.push_attrib(c::CURRENT_BIT);
                gl.move_raster(x as f32, 0.0);
                call();
                gl.pop_attrib();
            });
        }
        self.bind_draw(gl, true, true);
    }
}
