//! The eyes of a program that draws both itself become views: the left half of the views, and the right half.

use super::{Layer, with_raw_copies};
use crate::gl::{Gl, consts as c};
use crate::state::{BACK, FRONT};
use crate::view::ViewIndex;

impl Layer {
    /// Copies the pictures of both eyes, which lie in the two images of the own view's tile, to the tiles of all views. Changes nothing of the program's state.
    pub(super) fn spread_eyes(&mut self, gl: &Gl) {
        // A frame without a picture for the right eye shows the left one to both, as where the program has left its stereo mode.
        let drew_right = self.state.framebuffers.drew_right();
        self.queries.pause(gl);
        self.queries.lift_condition(gl);
        with_raw_copies(gl, || {
            let atlas = &self.targets.atlas;
            let tiles = atlas.tiles;
            let (own, right) = (tiles.own(), drew_right && atlas.has_front());
            let (from, from_x) = atlas.target(own);
            let [w, h] = [tiles.width, tiles.height].map(|n| n as i32);
            for view in (0..tiles.views).map(ViewIndex).filter(|&view| view != own) {
                let (to, x) = atlas.target(view);
                gl.bind_framebuffer(c::READ_FRAMEBUFFER, from);
                gl.read_buffer(match right && 2 * view.0 >= tiles.views {
                    true => FRONT,
                    false => BACK,
                });
                gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, to);
                gl.draw_buffers(&[BACK]);
                let colours = c::COLOR_BUFFER_BIT;
                gl.blit_framebuffer(
                    from_x,
                    0,
                    from_x + w,
                    h,
                    x,
                    0,
                    x + w,
                    h,
                    colours,
                    c::NEAREST,
                );
            }
        });
        self.rebind(gl);
        self.apply_buffers(gl);
        self.queries.put_condition(gl);
        self.queries.resume(gl);
    }
}
