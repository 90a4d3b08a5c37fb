//! The image of the on-screen display, from which it is copied into pictures.

use super::Names;
use super::layers::Layers;
use crate::gl::{FramebufferName, Gl, TextureName, consts as c};
use crate::state::Neutral;

/// The texels of the swatch: light and dark.
const SWATCH: [u8; 8] = [255, 255, 255, 255, 16, 16, 16, 255];

/// Room for a text, and above it two texels of one colour each.
#[derive(Debug)]
pub struct OsdImage {
    layers: Layers,
    room: [u32; 2],
}

impl OsdImage {
    /// `room`: width and height of the largest text, in pixels. Changes the bindings that [`super::Atlas::new`] does, and leaves the driver's errors where it
    /// cannot draw to such an image.
    pub fn new(gl: &Gl, neutral: &Neutral, names: &mut Names, room: [u32; 2]) -> Self {
        let texels = (c::RGBA8, c::RGBA, c::UNSIGNED_BYTE);
        let size = [room[0].max(2) as i32, room[1] as i32 + 1, 1];
        let layers = Layers::new(gl, names, false, texels, size);
        let image = Self { layers, room };
        image.write(gl, neutral, room[1], [2, 1], &SWATCH);
        image
    }

    /// Writes a text into the image: width and height, and four bytes for each pixel, rows bottom up. Changes the texture that is bound.
    pub fn set(&self, gl: &Gl, neutral: &Neutral, size: [u32; 2], texels: &[u8]) {
        self.write(gl, neutral, 0, size, texels);
    }

    fn write(&self, gl: &Gl, neutral: &Neutral, row: u32, size: [u32; 2], texels: &[u8]) {
        gl.bind_texture(c::TEXTURE_2D_ARRAY, self.layers.texture);
        gl.tex_sub_layer_rgba8(neutral.pixels(), row as i32, size.map(|n| n as i32), texels);
    }

    /// The texel of one colour, light or dark: left, bottom, right and top.
    pub fn swatch(&self, light: bool) -> [i32; 4] {
        let (x, y) = (i32::from(!light), self.room[1] as i32);
        [x, y, x + 1, y + 1]
    }

    /// Width and height of the largest text, in pixels.
    pub fn room(&self) -> [u32; 2] {
        self.room
    }

    /// Whether the driver can copy from it.
    pub fn is_complete(&self) -> bool {
        self.layers.complete
    }

    /// The framebuffer.
    pub fn framebuffer(&self) -> FramebufferName {
        self.layers.framebuffer(0)
    }

    /// The texture.
    pub fn texture(&self) -> TextureName {
        self.layers.texture
    }

    /// Deletes image and framebuffer.
    pub fn delete(self, gl: &Gl) {
        gl.delete_framebuffer(self.framebuffer());
        gl.delete_texture(self.layers.texture);
    }
}
