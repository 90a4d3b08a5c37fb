//! The picture for the panel's own window, which has another size than the program's.

use super::Names;
use super::layers::Layers;
use crate::gl::{BufferName, Fence, FramebufferName, Gl, TextureName, consts as c};
use crate::state::Neutral;
use std::collections::VecDeque;

/// Pictures on their way to memory at the same time. With one more the layer would be ahead of the driver by more frames than drivers let programs be.
const ON_THEIR_WAY: usize = 2;

/// What is asked of a [`PanelImage`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PanelFormat {
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// Colours are stored as sRGB, as in the program's window.
    pub srgb: bool,
}

/// An image of 8-bit colours with a framebuffer, and the buffers through which it is read without waiting.
#[derive(Debug)]
pub struct PanelImage {
    layers: Layers,
    format: PanelFormat,
    buffers: Vec<BufferName>,
    /// The oldest first.
    sent: VecDeque<Sent>,
}

/// A picture that the driver copies into a buffer.
#[derive(Debug)]
struct Sent {
    buffer: BufferName,
    fence: Fence,
    place: PanelPlace,
}

/// Where a picture is on the panel, in pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PanelPlace {
    /// Left and top, from the panel's upper left corner.
    pub at: [u32; 2],
    /// Width and height.
    pub size: [u32; 2],
}

impl PanelPlace {
    /// Bytes of the picture, four for each pixel.
    pub fn bytes(&self) -> usize {
        self.size[0] as usize * self.size[1] as usize * 4
    }
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
        Self {
            layers,
            format,
            buffers: Vec::new(),
            sent: VecDeque::new(),
        }
    }

    /// Makes the buffers through which pictures are read without waiting. Leaves the driver's errors where it has no room for them, and no pack buffer
    /// bound.
    pub fn make_buffers(&mut self, gl: &Gl) {
        let bytes = self.format.size.0 as usize * self.format.size.1 as usize * 4;
        while self.buffers.len() < ON_THEIR_WAY {
            let buffer = gl.gen_buffer();
            gl.bind_buffer(c::PIXEL_PACK_BUFFER, buffer);
            gl.buffer_data_empty(c::PIXEL_PACK_BUFFER, bytes);
            self.buffers.push(buffer);
        }
        gl.bind_buffer(c::PIXEL_PACK_BUFFER, BufferName::ZERO);
    }

    /// Whether [`PanelImage::make_buffers`] has nothing to do.
    pub fn has_buffers(&self) -> bool {
        !self.buffers.is_empty()
    }

    /// Whether a picture is on its way.
    pub fn is_sending(&self) -> bool {
        !self.sent.is_empty()
    }

    /// Starts to copy a part of the image, from x, y on, rows bottom up. False where all buffers are in use, or the driver cannot say when it is done.
    /// Changes the read framebuffer.
    pub fn send(&mut self, gl: &Gl, neutral: &Neutral, from: [i32; 2], place: PanelPlace) -> bool {
        let used = |buffer: &&BufferName| self.sent.iter().any(|sent| sent.buffer == **buffer);
        let Some(&buffer) = self.buffers.iter().find(|buffer| !used(buffer)) else {
            return false;
        };
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, self.framebuffer());
        gl.bind_buffer(c::PIXEL_PACK_BUFFER, buffer);
        gl.read_bgra_to_buffer(neutral.pixels(), from, place.size);
        gl.bind_buffer(c::PIXEL_PACK_BUFFER, BufferName::ZERO);
        let Some(fence) = gl.fence() else {
            return false;
        };
        self.sent.push_back(Sent {
            buffer,
            fence,
            place,
        });
        true
    }

    /// The newest picture that has arrived since the last call, which forgets the older ones; into `pixels`: blue, green, red and a byte without meaning,
    /// rows bottom up. Does not wait. No pack buffer may be bound.
    pub fn receive(&mut self, gl: &Gl, pixels: &mut Vec<u8>) -> Option<PanelPlace> {
        let mut arrived: Option<Sent> = None;
        while self.sent.front().is_some_and(|sent| gl.passed(&sent.fence)) {
            let next = self.sent.pop_front();
            let older = std::mem::replace(&mut arrived, next);
            older
                .into_iter()
                .for_each(|sent| gl.delete_fence(sent.fence));
        }
        let Sent {
            buffer,
            fence,
            place,
        } = arrived?;
        gl.delete_fence(fence);
        pixels.resize(place.bytes(), 0);
        gl.bind_buffer(c::PIXEL_PACK_BUFFER, buffer);
        gl.get_buffer_bgra(c::PIXEL_PACK_BUFFER, pixels);
        gl.bind_buffer(c::PIXEL_PACK_BUFFER, BufferName::ZERO);
        Some(place)
    }

    /// Forgets pictures that are on their way: a newer one is read at once.
    pub fn forget(&mut self, gl: &Gl) {
        self.sent
            .drain(..)
            .for_each(|sent| gl.delete_fence(sent.fence));
    }

    /// Hands over the buffers and fences, for deletion by another context.
    pub fn give_buffers(&mut self) -> (Vec<BufferName>, Vec<Fence>) {
        let fences = self.sent.drain(..).map(|sent| sent.fence);
        let fences = fences.collect();
        (std::mem::take(&mut self.buffers), fences)
    }

    /// Whether the driver can draw to it.
    pub fn is_complete(&self) -> bool {
        self.layers.complete
    }

    /// Deletes image, framebuffer and buffers.
    pub fn delete(mut self, gl: &Gl) {
        self.forget(gl);
        self.buffers
            .drain(..)
            .for_each(|buffer| gl.delete_buffer(buffer));
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
