//! A picture of ours that passes draw into, in a context of our own.
#![forbid(unsafe_code)]

use crate::gl::{FramebufferName, Gl, TextureName, consts as c};

/// A 2D texture of 8-bit colours with its framebuffer.
#[derive(Debug)]
pub struct Picture {
    /// The texture.
    pub texture: TextureName,
    /// Draws to it.
    pub framebuffer: FramebufferName,
}

impl Picture {
    /// In a texture that has no contents. Leaves both bound.
    pub fn new(gl: &Gl, texture: TextureName, (width, height): (u32, u32)) -> Self {
        let framebuffer = gl.gen_framebuffer();
        gl.bind_framebuffer(c::FRAMEBUFFER, framebuffer);
        gl.bind_texture(c::TEXTURE_2D, texture);
        gl.tex_image_rgba8_empty(c::TEXTURE_2D, width as i32, height as i32);
        for (p, v) in [
            (c::TEXTURE_MIN_FILTER, c::NEAREST),
            (c::TEXTURE_MAG_FILTER, c::NEAREST),
            (c::TEXTURE_MAX_LEVEL, 0),
        ] {
            gl.tex_parameteri(c::TEXTURE_2D, p, v as i32);
        }
        gl.framebuffer_texture(c::FRAMEBUFFER, c::COLOR_ATTACHMENT0, texture, 0);
        Self {
            texture,
            framebuffer,
        }
    }

    /// Gives the memory back.
    pub fn delete(self, gl: &Gl) {
        gl.delete_framebuffer(self.framebuffer);
        gl.delete_texture(self.texture);
    }
}
