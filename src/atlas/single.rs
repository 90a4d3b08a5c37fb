//! A copy of one tile with nothing beside it, for reads that the tiles themselves cannot answer.

use super::{Names, color_format, depth_format, fetched};
use crate::gl::{Gl, consts as c};
use crate::state::Window;

/// A framebuffer of the window's size and format, single-sampled. As in the window, what is outside of it cannot be read.
#[derive(Debug)]
pub(super) struct Single {
    framebuffer: u32,
    /// Colours and depths; 0 where there is none.
    textures: [u32; 2],
    size: [i32; 2],
}

impl Single {
    /// In a window's formats and any size; the textures behind it are added to `textures`. Changes the bindings that
    /// [`super::Atlas::new`] does.
    pub(super) fn new(
        gl: &Gl,
        names: &mut Names,
        window: &Window,
        size: [i32; 2],
        flip: bool,
        textures: &mut Vec<u32>,
    ) -> Single {
        let framebuffer = gl.gen_framebuffer();
        gl.bind_framebuffer(c::FRAMEBUFFER, framebuffer);
        let mut own = [0; 2];
        let mut attach = |at: usize, point, (internal, format, kind)| {
            let name = names.texture(gl);
            gl.bind_texture(c::TEXTURE_2D_ARRAY, name);
            gl.tex_storage_3d(internal, size[0], size[1], 1, format, kind);
            fetched(gl);
            gl.bind_texture(c::TEXTURE_2D_ARRAY, 0);
            gl.framebuffer_texture_layer(c::FRAMEBUFFER, point, name, 0, 0);
            textures.push(name);
            own[at] = name;
        };
        attach(0, c::COLOR_ATTACHMENT0, color_format(window));
        if let Some((internal, format, kind, point)) = depth_format(window) {
            attach(1, point, (internal, format, kind));
        }
        if flip {
            gl.flip_framebuffer(c::FRAMEBUFFER);
        }
        Single {
            framebuffer,
            textures: own,
            size,
        }
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

    /// Takes the depths of such a tile, `window` pixels wide and high, each of its own pixels the nearest one's. Binds as
    /// [`Single::take`].
    pub(super) fn shrink(&self, gl: &Gl, from: u32, x: i32, window: [i32; 2]) {
        let ([w, h], [width, height]) = (self.size, window);
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, from);
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, self.framebuffer);
        let depth = c::DEPTH_BUFFER_BIT;
        gl.blit_framebuffer(x, 0, x + width, height, 0, 0, w, h, depth, c::NEAREST);
    }

    /// Width and height in pixels.
    pub(super) fn size(&self) -> [i32; 2] {
        self.size
    }

    /// Of its colours and depths; 0 where the window has none.
    pub(super) fn textures(&self) -> [u32; 2] {
        self.textures
    }

    /// Its name.
    pub(super) fn framebuffer(&self) -> u32 {
        self.framebuffer
    }
}
