//! Copies of single tiles, for reads and blits that must see nothing beside the tile.

use super::{Names, color_format, depth_format, store};
use crate::gl::{FramebufferName, Gl, TextureName, consts as c};
use crate::state::Window;

/// A single-sampled framebuffer in the window's format. As in the window, nothing can be read outside of it.
#[derive(Debug)]
pub(super) struct Single {
    /// One for each layer.
    framebuffers: Vec<FramebufferName>,
    /// The textures of colours and depths; 0 where there is none.
    textures: [TextureName; 2],
    size: [i32; 2],
}

impl Single {
    /// In a window's formats and any size; its textures are added to `textures`. Changes the bindings that
    /// [`super::Atlas::new`] does.
    pub(super) fn new(
        gl: &Gl,
        names: &mut Names,
        window: &Window,
        size: [i32; 2],
        flip: bool,
        textures: &mut Vec<TextureName>,
    ) -> Single {
        Single::layers(gl, names, window, (size, 1), flip, textures)
    }

    /// The same with several layers, each for one tile.
    pub(super) fn layers(
        gl: &Gl,
        names: &mut Names,
        window: &Window,
        (size, layers): ([i32; 2], u32),
        flip: bool,
        textures: &mut Vec<TextureName>,
    ) -> Single {
        let mut texture = |format: (u32, u32, u32)| {
            let name = names.texture(gl);
            store(gl, name, format, [size[0], size[1], layers as i32]);
            textures.push(name);
            name
        };
        let colour = texture(color_format(window));
        let depth = depth_format(window)
            .map(|(internal, format, kind, point)| (texture((internal, format, kind)), point));
        let framebuffer = |layer: u32| {
            let name = gl.gen_framebuffer();
            gl.bind_framebuffer(c::FRAMEBUFFER, name);
            let colour = Some((colour, c::COLOR_ATTACHMENT0));
            for (texture, point) in colour.into_iter().chain(depth) {
                let layer = layer as i32;
                gl.framebuffer_texture_layer(c::FRAMEBUFFER, point, texture, 0, layer);
            }
            if flip {
                gl.flip_framebuffer(c::FRAMEBUFFER);
            }
            name
        };
        // In reverse order, so that the framebuffer of the first layer stays bound.
        let mut framebuffers: Vec<FramebufferName> = (0..layers).rev().map(framebuffer).collect();
        framebuffers.reverse();
        Single {
            framebuffers,
            textures: [colour, depth.map_or(TextureName::ZERO, |(name, _)| name)],
            size,
        }
    }

    /// Copies the tile at an x offset, in pixels, of the framebuffer `from`. Binds that for reading and itself for drawing; the
    /// scissor test must be off.
    pub(super) fn take(&self, gl: &Gl, from: FramebufferName, x: i32) {
        self.copy(gl, (from, x), (self.framebuffer(), 0));
    }

    /// The same, into one of its layers.
    pub(super) fn take_to(&self, gl: &Gl, layer: u32, from: FramebufferName, x: i32) {
        if let Some(&to) = self.framebuffers.get(layer as usize) {
            self.copy(gl, (from, x), (to, 0));
        }
    }

    /// Copies itself to the tile at an x offset of the framebuffer `to`. Binds itself for reading and that for drawing; the scissor test must
    /// be off.
    pub(super) fn give(&self, gl: &Gl, to: FramebufferName, x: i32) {
        self.copy(gl, (self.framebuffer(), 0), (to, x));
    }

    fn copy(&self, gl: &Gl, (from, x): (FramebufferName, i32), (to, to_x): (FramebufferName, i32)) {
        let [w, h] = self.size;
        let all = c::COLOR_BUFFER_BIT | c::DEPTH_BUFFER_BIT | c::STENCIL_BUFFER_BIT;
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, from);
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, to);
        gl.blit_framebuffer(x, 0, x + w, h, to_x, 0, to_x + w, h, all, c::NEAREST);
    }

    /// Copies the depths of such a tile between these corners (left, bottom, right, top), scaled to its own size by the nearest pixel. Binds as
    /// [`Single::take`].
    pub(super) fn shrink(&self, gl: &Gl, from: FramebufferName, x: i32, area: [i32; 4]) {
        let ([w, h], [left, bottom, right, top]) = (self.size, area);
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, from);
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, self.framebuffer());
        let depth = c::DEPTH_BUFFER_BIT;
        let (left, right) = (x + left, x + right);
        gl.blit_framebuffer(left, bottom, right, top, 0, 0, w, h, depth, c::NEAREST);
    }

    /// Width and height in pixels.
    pub(super) fn size(&self) -> [i32; 2] {
        self.size
    }

    /// The textures of colours and depths; 0 where the window has none.
    pub(super) fn textures(&self) -> [TextureName; 2] {
        self.textures
    }

    /// The framebuffer of the first layer.
    pub(super) fn framebuffer(&self) -> FramebufferName {
        self.framebuffers.first().copied().unwrap_or_default()
    }

    /// The framebuffers of all layers.
    pub(super) fn framebuffers(&self) -> impl Iterator<Item = FramebufferName> + '_ {
        self.framebuffers.iter().copied()
    }
}
