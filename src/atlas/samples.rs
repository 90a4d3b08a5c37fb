//! The samples of the views that a panel shows, one texel for each subpixel, or for each pixel where those show one view each.
//!
//! What is drawn to them is drawn once for all views. They are gathered from the tiles with their depths, and scattered back (`shaders/samples.wgsl`);
//! other pixels of the tiles, which the panel does not show, stay as they are. So any draw may come before and after.

use super::{Names, color_format, depth_format, store};
use crate::gl::{FramebufferName, Gl, TextureName, consts as c};
use crate::state::Window;

/// Colours, depths and the views of the samples.
#[derive(Debug)]
pub struct Samples {
    /// One layer, in the format of the tiles.
    pub color: TextureName,
    /// The same of depths; 0 where the window has none.
    pub depth: TextureName,
    /// The view of each sample, as a fraction of 255, and 1 where none is shown; a 2D texture.
    pub seen: TextureName,
    /// Draws to colours and depths.
    pub framebuffer: FramebufferName,
    /// Draws to the views.
    pub seen_framebuffer: FramebufferName,
    /// Width and height of the window in pixels.
    pub size: [u32; 2],
    /// Samples of a pixel: 3 or 1.
    pub parts: u32,
}

impl Samples {
    /// Changes the bindings that [`super::Atlas::new`] does, and that of 2D textures. None where the driver does not draw to such images.
    pub fn new(
        gl: &Gl,
        names: &mut Names,
        window: &Window,
        flip: bool,
        parts: u32,
    ) -> Option<Self> {
        let size = [window.width, window.height];
        let [width, height] = [size[0] * parts, size[1]].map(|n| n as i32);
        let color = names.texture(gl);
        store(gl, color, color_format(window), [width, height, 1]);
        let format = depth_format(window);
        let depth = format.map(|format| {
            let name = names.texture(gl);
            store(gl, name, (format.0, format.1, format.2), [width, height, 1]);
            name
        });
        let seen = names.texture(gl);
        gl.bind_texture(c::TEXTURE_2D, seen);
        gl.tex_image_rgba8_empty(c::TEXTURE_2D, width, height);
        for (p, v) in [
            (c::TEXTURE_MIN_FILTER, c::NEAREST),
            (c::TEXTURE_MAG_FILTER, c::NEAREST),
            (c::TEXTURE_MAX_LEVEL, 0),
        ] {
            gl.tex_parameteri(c::TEXTURE_2D, p, v as i32);
        }
        let framebuffer = gl.gen_framebuffer();
        gl.bind_framebuffer(c::FRAMEBUFFER, framebuffer);
        gl.framebuffer_texture_layer(c::FRAMEBUFFER, c::COLOR_ATTACHMENT0, color, 0, 0);
        if let (Some(depth), Some(format)) = (depth, format) {
            gl.framebuffer_texture_layer(c::FRAMEBUFFER, format.3, depth, 0, 0);
        }
        let complete = |gl: &Gl| {
            if flip {
                gl.flip_framebuffer(c::FRAMEBUFFER);
            }
            gl.check_framebuffer_status(c::FRAMEBUFFER) == c::FRAMEBUFFER_COMPLETE
        };
        let drawn = complete(gl);
        let seen_framebuffer = gl.gen_framebuffer();
        gl.bind_framebuffer(c::FRAMEBUFFER, seen_framebuffer);
        gl.framebuffer_texture(c::FRAMEBUFFER, c::COLOR_ATTACHMENT0, seen, 0);
        let samples = Self {
            color,
            depth: depth.unwrap_or_default(),
            seen,
            framebuffer,
            seen_framebuffer,
            size,
            parts,
        };
        if complete(gl) && drawn {
            return Some(samples);
        }
        samples.delete(gl);
        None
    }

    /// The textures.
    pub fn textures(&self) -> [TextureName; 3] {
        [self.color, self.depth, self.seen]
    }

    /// The framebuffers.
    pub fn framebuffers(&self) -> [FramebufferName; 2] {
        [self.framebuffer, self.seen_framebuffer]
    }

    /// Gives the memory back.
    pub fn delete(self, gl: &Gl) {
        self.framebuffers()
            .into_iter()
            .for_each(|name| gl.delete_framebuffer(name));
        let textures = self.textures().into_iter();
        textures
            .filter(|name| !name.is_zero())
            .for_each(|name| gl.delete_texture(name));
    }
}
