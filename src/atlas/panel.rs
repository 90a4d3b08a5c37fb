//! The picture for the panel's own window, which has another size than the program's.

use super::Names;
use super::layers::Layers;
use crate::gl::{FramebufferName, Gl, TextureName, consts as c};

/// What is asked of a [`PanelImage`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PanelFormat {
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// Colours are stored as sRGB, as in the program's window.
    pub srgb: bool,
}

/// An image of 8-bit colours with a framebuffer.
#[derive(Debug)]
pub struct PanelImage {
    layers: Layers,
    format: PanelFormat,
}

impl PanelImage {
    /// Changes the bindings that [`super::Atlas::new`] does, and leaves the driver's errors where it cannot draw to such an image.
    pub fn new(gl: &Gl, names: &mut Names, format: PanelFormat) -> Self {
        let (width, height) = format.size;
        let internal = if format.srgb {
            c::SRGB8_ALPHA8
        } else {
            c::RGBA8
        };
        let texels = (internal, c::RGBA, c::UNSIGNED_BYTE);
        let layers = Layers::new(gl, names, false, texels, [width as i32, height as i32, 1]);
        Self { layers, format }
    }

    /// Whether the driver can draw to it.
    pub fn is_complete(&self) -> bool {
        self.layers.complete
    }

    /// Deletes image and framebuffer.
    pub fn delete(self, gl: &Gl) {
        gl.delete_framebuffer(self.framebuffer());
        gl.delete_texture(self.layers.texture);
    }

    /// What it was made for.
    pub fn format(&self) -> PanelFormat {
        self.format
    }

    /// The framebuffer.
    pub fn framebuffer(&self) -> FramebufferName {
        self.layers.framebuffer(0)
    }

    /// The texture.
    pub fn texture(&self) -> TextureName {
        self.layers.texture
    }
}
