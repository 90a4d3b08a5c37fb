//! glBlitFramebuffer between the window and framebuffers of the program's: from each view to the same view.

use super::Layer;
use super::reading::Reading;
use crate::atlas::Tiles;
use crate::gl::{FramebufferName, Gl, consts as c};
use crate::plan::Unrepresentable;
use crate::state::{Command, Run, Touch};
use crate::view::ViewIndex;

impl Layer {
    /// glBlitFramebuffer: writes to every view's tile where framebuffer 0 is bound for drawing, or else to each view's framebuffer. It reads
    /// from the same view's image where the source has one. `blit` takes the x offsets of source and destination in pixels; `scaled`: their
    /// sizes differ.
    pub fn blit(&mut self, gl: &Gl, scaled: bool, blit: &mut dyn FnMut(i32, i32)) {
        if self.compiles() {
            self.compile(gl, Command::Of(Run::Blit), Touch::NONE);
            return blit(0, 0);
        }
        let f = &self.state.framebuffers;
        let (draw, read) = (f.draw, f.read);
        let parked = matches!(self.canvases.reading(), Reading::Parked(_));
        if read.is_zero() && !draw.is_zero() && !parked {
            self.synthesise_views(gl);
        }
        let split = self.targets.offscreen.is_split(gl, read);
        if !draw.is_zero() {
            let differs =
                split || (read.is_zero() && self.reads_views() && (parked || !self.is_mono()));
            return match differs && self.split(gl, draw)
                || self.targets.offscreen.is_split(gl, draw)
            {
                true => self.blit_split(gl, blit),
                false if read.is_zero() => self.read(gl, 0, 0, &mut || blit(0, 0)),
                false => blit(0, 0),
            };
        }
        if split {
            self.split(gl, read);
            self.differ(gl);
        }
        // A blit alone is a picture, too.
        self.frame.draws();
        self.state.refresh(gl);
        self.hold_everything(gl, Unrepresentable::Copies);
        if read.is_zero() && parked {
            self.in_read_canvas(gl, |layer| {
                layer.hold_everything(gl, Unrepresentable::Copies)
            });
        }
        self.diagnostics.proving.stop_search();
        if scaled && self.are_beside() {
            self.make_singles(gl, true);
            self.make_read_singles(gl);
        }
        self.in_proof(gl, |layer| layer.blit_views(gl, scaled, blit));
        self.blit_views(gl, scaled, blit);
    }

    /// Blits into a framebuffer of the program's of which each view has its own.
    fn blit_split(&mut self, gl: &Gl, blit: &mut dyn FnMut(i32, i32)) {
        self.state.refresh(gl);
        let (draw, read) = (self.state.framebuffers.draw, self.state.framebuffers.read);
        if !read.is_zero() {
            self.split(gl, read);
        } else {
            self.make_read_singles(gl);
        }
        let tiles = Tiles {
            shown: self.wanted_views(),
            ..self.targets.atlas.tiles
        };
        for view in tiles.order() {
            if read.is_zero() {
                self.take_read_single(gl, view);
            }
            for (target, name) in [(c::DRAW_FRAMEBUFFER, draw), (c::READ_FRAMEBUFFER, read)] {
                if !name.is_zero() {
                    let name = self.targets.offscreen.view(gl, name, view);
                    gl.bind_framebuffer(target, name);
                }
            }
            blit(0, 0);
        }
        if let Some(target) = self.targets.offscreen.take(draw, tiles.shown) {
            self.targets.offscreen.drawn_to(&target);
            self.targets.offscreen.put(target);
        }
        self.rebind(gl);
    }

    fn blit_views(&mut self, gl: &Gl, scaled: bool, blit: &mut dyn FnMut(i32, i32)) {
        let read = self.reads_from_zero();
        let images = self.state.framebuffers.draw_images();
        let single = match images[..] {
            [image] if image != c::NONE => Some(image),
            _ => None,
        };
        let single = single.filter(|_| scaled && self.are_beside());
        for view in self.targets.atlas.tiles.order() {
            if let Some(image) = single {
                self.scaled_blit(gl, view, (image, read), blit);
                continue;
            }
            let x = self.targets.atlas.enter(gl, view);
            let (from, from_x) = match self.state.framebuffers.read {
                FramebufferName::ZERO => self.read_target(view),
                read => (self.targets.offscreen.view(gl, read, view), 0),
            };
            gl.bind_framebuffer(c::READ_FRAMEBUFFER, from);
            self.scissored(gl, view, x, &mut || blit(from_x, x));
        }
        self.rebind(gl);
    }

    /// The framebuffer that a view of framebuffer 0 is read from, and the x offset of its tile in pixels.
    fn read_target(&self, view: ViewIndex) -> (FramebufferName, i32) {
        match self.canvases.reading() {
            Reading::Drawn => self.targets.atlas.target(view),
            Reading::Parked(_) | Reading::True => self
                .canvases
                .read()
                .filter(|read| !read.is_plain())
                .map_or((FramebufferName::ZERO, 0), |read| read.target(view)),
        }
    }

    /// Whether tiles lie beside each other in a framebuffer that can be copied from.
    fn are_beside(&self) -> bool {
        self.targets.atlas.tiles.columns > 1 && !self.targets.atlas.multisampled()
    }

    /// Blits one view through a framebuffer of the window's size. Where a scaled blit takes the nearest pixel, the choice is a matter of
    /// rounding, which is as in the window only in a framebuffer of that size.
    fn scaled_blit(
        &mut self,
        gl: &Gl,
        view: ViewIndex,
        (image, read): (u32, bool),
        blit: &mut dyn FnMut(i32, i32),
    ) {
        let from = self.state.framebuffers.read_image();
        let staged = self.unscissored(gl, |layer| layer.targets.atlas.stage(gl, view, image, from));
        if read {
            self.take_read_single(gl, view);
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, staged);
        } else {
            let from = self.state.framebuffers.read;
            let from = self.targets.offscreen.view(gl, from, view);
            gl.bind_framebuffer(c::READ_FRAMEBUFFER, from);
        }
        blit(0, 0);
        self.unscissored(gl, |layer| layer.targets.atlas.unstage(gl, view));
    }
}
