//! Small copies of the depths of the program's own view. They are read back once the driver has finished them, so that nothing waits.

use super::{Atlas, Names, single::Single};
use crate::gl::{BufferName, Fence, FramebufferName, Gl, consts as c};
use crate::state::{Neutral, Window};

/// The most pictures of one frame.
const PICTURES: usize = 3;

/// The longer side of a copy, in samples. Of a frame of 1920 x 1080, one pixel in 15 of a row is sampled.
const SAMPLES: u32 = 128;

/// The framebuffer and the buffer object of the copies.
#[derive(Debug)]
pub(super) struct Depths {
    small: Single,
    buffer: BufferName,
    /// Pictures in the buffer.
    taken: usize,
    /// Signalled once the last of them is in the buffer.
    fence: Option<Fence>,
    /// The driver has refused the framebuffer or the buffer object.
    refused: bool,
}

impl Depths {
    pub(super) fn framebuffer(&self) -> FramebufferName {
        self.small.framebuffer()
    }
}

impl Atlas {
    /// Makes the objects for [`Atlas::take_depths`]. The caller saves and restores bindings as for [`Atlas::new`], and the pack
    /// buffer.
    pub fn make_depths(&mut self, gl: &Gl, names: &mut Names, window: &Window) {
        let longer = window.width.max(window.height).max(1);
        let side = |pixels: u32| (pixels * SAMPLES.min(longer) / longer).max(1) as i32;
        let size = [side(window.width), side(window.height)];
        let small = Single::new(gl, names, window, size, self.flipped, &mut self.textures);
        let buffer = gl.gen_buffer();
        gl.bind_buffer(c::PIXEL_PACK_BUFFER, buffer);
        gl.buffer_data_empty(c::PIXEL_PACK_BUFFER, PICTURES * bytes(size));
        gl.bind_buffer(c::PIXEL_PACK_BUFFER, BufferName::ZERO);
        self.depths = Some(Depths {
            small,
            buffer,
            taken: 0,
            fence: None,
            refused: false,
        });
    }

    /// The driver has refused something of what [`Atlas::make_depths`] makes: no depths are taken.
    pub fn refuse_depths(&mut self) {
        self.depths.iter_mut().for_each(|d| d.refused = true);
    }

    /// Whether [`Atlas::make_depths`] has nothing to do.
    pub fn has_depths(&self) -> bool {
        self.depths.is_some()
    }

    /// Copies the current depths of the program's own view; false where there is no more room, or depths cannot be read. Changes the
    /// framebuffer bindings.
    pub fn take_depths(&mut self, gl: &Gl, neutral: &Neutral) -> bool {
        let takes = |d: &Depths| d.taken < PICTURES && !d.refused;
        if !self.depths.as_ref().is_some_and(takes) || !gl.reads_depths() {
            return false;
        }
        self.resolve(gl, &self.tiles.own_alone(), c::DEPTH_BUFFER_BIT);
        let (from, x) = self.readable(self.tiles.own());
        let window = [self.tiles.width, self.tiles.height].map(|n| n as i32);
        let Some(depths) = &mut self.depths else {
            return false;
        };
        depths.small.shrink(gl, from, x, window);
        let size = depths.small.size();
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, depths.small.framebuffer());
        gl.bind_buffer(c::PIXEL_PACK_BUFFER, depths.buffer);
        gl.read_depth_to_buffer(
            neutral.pixels(),
            size[0],
            size[1],
            depths.taken * bytes(size),
        );
        gl.bind_buffer(c::PIXEL_PACK_BUFFER, BufferName::ZERO);
        depths.taken += 1;
        self.bound_row = u32::MAX;
        true
    }

    /// Ends the pictures of this frame with a fence.
    pub fn send_depths(&mut self, gl: &Gl) {
        if let Some(depths) = self.depths.as_mut().filter(|d| d.taken > 0) {
            depths.fence = gl.fence();
        }
    }

    /// Whether [`Atlas::read_depths`] would not wait; false where the driver has no fences.
    pub fn depths_are_there(&self, gl: &Gl) -> bool {
        let fence = self.depths.as_ref().and_then(|d| d.fence.as_ref());
        fence.is_some_and(|fence| gl.passed(fence))
    }

    /// The pictures since the last read, in the order in which they were taken: each is the window depths of all samples. No pack buffer may be
    /// bound.
    pub fn read_depths(&mut self, gl: &Gl) -> Vec<Vec<f32>> {
        let Some(depths) = &mut self.depths else {
            return Vec::new();
        };
        let size = depths.small.size();
        depths
            .fence
            .take()
            .into_iter()
            .for_each(|f| gl.delete_fence(f));
        gl.bind_buffer(c::PIXEL_PACK_BUFFER, depths.buffer);
        let pictures = (0..std::mem::take(&mut depths.taken)).map(|picture| {
            let mut samples = vec![0.0; bytes(size) / size_of::<f32>()];
            gl.get_buffer_depths(c::PIXEL_PACK_BUFFER, picture * bytes(size), &mut samples);
            samples
        });
        let pictures = pictures.collect();
        gl.bind_buffer(c::PIXEL_PACK_BUFFER, BufferName::ZERO);
        pictures
    }

    /// Hands over the buffer object and the fence of the depths, for deletion; none where there are none.
    pub fn give_buffer(&mut self) -> (Option<BufferName>, Option<Fence>) {
        let fence = self.depths.as_mut().and_then(|d| d.fence.take());
        (self.depths.as_ref().map(|d| d.buffer), fence)
    }
}

/// Bytes of one picture.
fn bytes([width, height]: [i32; 2]) -> usize {
    width as usize * height as usize * size_of::<f32>()
}
