//! The front buffer of a double-buffered window: another image of every tile, made when the program first uses it.

use super::{Atlas, Names, color_format, store};
use crate::gl::{Gl, TextureName, consts as c};
use crate::state::{BACK, FRONT, Window};

/// Swaps after which an unused front buffer is deleted.
const IDLE: u32 = 30;

/// The front image of all tiles.
#[derive(Debug)]
pub(super) struct Front {
    texture: TextureName,
    /// Swaps since it was drawn to or read from.
    idle: u32,
}

impl Atlas {
    /// Makes the front buffer: after the first swap (`swapped`) with the contents of the back buffer, before it undefined. The caller saves
    /// and restores bindings as for [`Atlas::new`] and the draw and read buffers of all framebuffers; the scissor test must be off. False
    /// where the driver makes none.
    pub fn make_front(
        &mut self,
        gl: &Gl,
        names: &mut Names,
        window: &Window,
        swapped: bool,
    ) -> bool {
        let t = self.tiles;
        let size = [t.texture_width(), t.height, t.rows].map(|n| n as i32);
        let texture = names.texture(gl);
        store(gl, texture, color_format(window), size);
        self.textures.push(texture);
        self.attach_front(gl, texture);
        if gl.check_framebuffer_status(c::DRAW_FRAMEBUFFER) != c::FRAMEBUFFER_COMPLETE {
            self.drop_front(gl, texture);
            return false;
        }
        self.front = Some(Front { texture, idle: 0 });
        if swapped {
            self.copy_to_front(gl);
        }
        true
    }

    fn attach_front(&self, gl: &Gl, texture: TextureName) {
        for (layer, &row) in (0..).zip(&self.rows) {
            gl.bind_framebuffer(c::FRAMEBUFFER, row);
            gl.framebuffer_texture_layer(c::FRAMEBUFFER, FRONT, texture, 0, layer);
        }
        if let Some(layered) = self.layered {
            gl.bind_framebuffer(c::FRAMEBUFFER, layered);
            gl.framebuffer_texture(c::FRAMEBUFFER, FRONT, texture, 0);
        }
    }

    fn drop_front(&mut self, gl: &Gl, texture: TextureName) {
        self.attach_front(gl, TextureName::ZERO);
        gl.delete_texture(texture);
        self.textures.retain(|&t| t != texture);
    }

    /// Whether [`Atlas::make_front`] has nothing to do.
    pub fn has_front(&self) -> bool {
        self.front.is_some()
    }

    /// The single-sampled texture of the front (`image` is `FRONT`) or back buffer, to be sampled.
    pub fn sampled(&self, image: u32) -> TextureName {
        let front = self.front.as_ref().filter(|_| image == FRONT);
        front.map_or(self.color, |f| f.texture)
    }

    /// The texture of the front (`image` is `FRONT`) or back buffer that the program draws to.
    pub fn drawn(&self, image: u32) -> TextureName {
        let front = self.front.as_ref().filter(|_| image == FRONT);
        front.map_or_else(
            || self.textures.first().copied().unwrap_or_default(),
            |f| f.texture,
        )
    }

    /// Copies the back buffer to the front buffer at a swap. `used`: the program draws to the front buffer or reads from it. Returns whether
    /// there was a front buffer; the draw and read buffers of all framebuffers and their bindings have then changed. The scissor test must be
    /// off.
    pub fn swapped(&mut self, gl: &Gl, used: bool) -> bool {
        let Some(front) = &mut self.front else {
            return false;
        };
        front.idle = if used { 0 } else { front.idle + 1 };
        let texture = front.texture;
        if front.idle > IDLE {
            self.drop_front(gl, texture);
            self.front = None;
        } else {
            self.copy_to_front(gl);
        }
        true
    }

    fn copy_to_front(&self, gl: &Gl) {
        let (w, h) = (self.tiles.texture_width() as i32, self.tiles.height as i32);
        for &row in &self.rows {
            gl.bind_framebuffer(c::FRAMEBUFFER, row);
            gl.read_buffer(BACK);
            gl.draw_buffers(&[FRONT]);
            gl.blit_framebuffer(0, 0, w, h, 0, 0, w, h, c::COLOR_BUFFER_BIT, c::NEAREST);
        }
    }

    /// Copies the front buffer of another atlas of the same size and format, where both have one. The caller restores as for
    /// [`Atlas::make_front`].
    pub fn copy_front(&self, gl: &Gl, other: &Atlas) {
        if !(self.has_front() && other.has_front()) {
            return;
        }
        let (w, h) = (self.tiles.texture_width() as i32, self.tiles.height as i32);
        for (&from, &to) in other.rows.iter().zip(&self.rows) {
            gl.bind_framebuffer(c::READ_FRAMEBUFFER, from);
            gl.read_buffer(FRONT);
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, to);
            gl.draw_buffers(&[FRONT]);
            gl.blit_framebuffer(0, 0, w, h, 0, 0, w, h, c::COLOR_BUFFER_BIT, c::NEAREST);
        }
    }
}
