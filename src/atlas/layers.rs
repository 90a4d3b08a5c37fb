//! An array texture with a framebuffer for each of its layers, for numbers that the layer's own passes write.

use super::{Names, store};
use crate::gl::{FramebufferName, Gl, TextureName, consts as c};

/// The texture, and the framebuffers of its layers.
#[derive(Debug)]
pub(super) struct Layers {
    pub(super) texture: TextureName,
    framebuffers: Vec<FramebufferName>,
    /// The driver can draw to all of them.
    pub(super) complete: bool,
}

impl Layers {
    /// `format`: internal format, format and type; `size`: width, height and number of layers. Changes the bindings that
    /// [`super::Atlas::new`] does.
    pub(super) fn new(
        gl: &Gl,
        names: &mut Names,
        flip: bool,
        format: (u32, u32, u32),
        size: [i32; 3],
    ) -> Layers {
        let texture = names.texture(gl);
        store(gl, texture, format, size);
        let mut complete = true;
        let framebuffer = |layer: i32| {
            let name = gl.gen_framebuffer();
            gl.bind_framebuffer(c::FRAMEBUFFER, name);
            let point = c::COLOR_ATTACHMENT0;
            gl.framebuffer_texture_layer(c::FRAMEBUFFER, point, texture, 0, layer);
            // Flipped as the tiles are: Mesa 22.3 flips a polygon stipple for the framebuffer that is drawn to first, and keeps it.
            if flip {
                gl.flip_framebuffer(c::FRAMEBUFFER);
            }
            complete &= gl.check_framebuffer_status(c::FRAMEBUFFER) == c::FRAMEBUFFER_COMPLETE;
            name
        };
        let framebuffers = (0..size[2]).map(framebuffer).collect();
        Layers {
            texture,
            framebuffers,
            complete,
        }
    }

    pub(super) fn framebuffers(&self) -> impl Iterator<Item = FramebufferName> {
        self.framebuffers.iter().copied()
    }

    /// The framebuffer of a layer; 0 where there is none.
    pub(super) fn framebuffer(&self, layer: u32) -> FramebufferName {
        let framebuffer = self.framebuffers.get(layer as usize);
        framebuffer.copied().unwrap_or_default()
    }
}
