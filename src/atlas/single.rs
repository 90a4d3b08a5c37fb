//! A copy of one tile with nothing beside it, for reads that the tiles themselves cannot answer.

use super::{Names, color_format, depth_format};
use crate::gl::{Gl, consts as c};
use crate::state::Window;

/// A framebuffer of the window's size and format, single-sampled. As in the window, what is outside of it cannot be read.
#[derive(Debug)]
pub(super) struct Single {
    framebuffer: u32,
    size: [i32; 2],
}

impl Single {
    /// For a window, with tiles of its size; the textures behind it are added to `textures`. Changes the bindings that
    /// [`super::Atlas::new`] does.
    pub(super) fn new(
        gl: &Gl,
        names: &mut Names,
        window: &Window,
        flip: bool,
        textures: &mut Vec<u32>,
    ) -> Single {
        let size = [window.width as i32, window.height as i32];
        let framebuffer = gl.gen_framebuffer();
        gl.bind_framebuffer(c::FRAMEBUFFER, framebuffer);
        let mut attach = |point, (internal, format, kind)| {
            let name = names.texture(gl);
            gl.bind_texture(c::TEXTURE_2D_ARRAY, name);
            gl.tex_storage_3d(internal, size[0], size[1], 1, format, kind);
            gl.bind_texture(c::TEXTURE_2D_ARRAY, 0);
            gl.framebuffer_texture_layer(c::FRAMEBUFFER, point, name, 0, 0);
            textures.push(name);
        };
        attach(c::COLOR_ATTACHMENT0, color_format(window));
        if let Some((internal, format, kind, point)) = depth_format(window) {
            attach(point, (internal, format, kind));
        }
        if flip {
            gl.framebuffer_parameteri(c::FRAMEBUFFER, c::FRAMEBUFFER_FLIP_Y_MESA, 1);
        }
        Single { framebuffer, size }
    }

    /// Takes a copy of the tile at an x offset in pixels of a framebuffer. Binds that one for reading and itself for drawing; the
    /// scissor test must be off.
    pub(super) fn take(&self, gl: &Gl, from: u32, x: i32) {
        self.copy(gl, (from, x), (self.framebuffer, 0));
    }

    /// Copies itself to such a tile. Binds itself for reading and that one for drawing; the scissor test must be off.
    pub(super) fn give(&self, gl: &Gl, to: u32, x: i32) {
        self.copy(gl, (self.framebuffer, 0), (to, x));
    }

    fn copy(&self, gl: &Gl, (from, x): (u32, i32), (to, to_x): (u32, i32)) {
        let [w, h] = self.size;
        let all = c::COLOR_BUFFER_BIT | c::DEPTH_BUFFER_BIT | c::STENCIL_BUFFER_BIT;
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, from);
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, to);
        gl.blit_framebuffer(x, 0, x + w, h, to_x, 0, to_x + w, h, all, c::NEAREST);
    }

    /// Its name.
    pub(super) fn framebuffer(&self) -> u32 {
        self.framebuffer
    }
}
