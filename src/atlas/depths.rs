//! Small copies of the depths of the program's own view. They are read back once the driver has finished them, so that nothing waits.

use super::{Atlas, Names, single::Single};
use crate::gl::{BufferName, DepthKind, Fence, FramebufferName, Gl, consts as c};
use crate::state::{Neutral, Window};

/// The most pictures of one frame.
const PICTURES: usize = 3;

/// The longer side of a copy, in samples. Of a frame of 1920 x 1080, one pixel in 15 of a row is sampled.
const SAMPLES: u32 = 128;

/// Bytes from picture to picture in the buffer.
const SLOT: usize = (SAMPLES * SAMPLES) as usize * size_of::<f32>();

/// A small copy of depths.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthPicture {
    /// Width and height in samples.
    pub size: [usize; 2],
    /// Window depths, row by row from the lowest.
    pub depths: Vec<f32>,
}

impl DepthPicture {
    /// The samples around a place, given as parts of width and height, up to `reach` samples away.
    pub fn around(&self, place: [f64; 2], reach: usize) -> Vec<f32> {
        let span = |axis: usize| {
            let (size, part) = (self.size[axis], place[axis]);
            let middle = (part * size as f64) as usize;
            middle.saturating_sub(reach)..(middle + reach + 1).min(size)
        };
        let (rows, columns) = (span(1), span(0));
        let rows = rows.filter_map(|row| self.depths.get(row * self.size[0]..));
        rows.filter_map(|row| row.get(columns.clone()))
            .flatten()
            .copied()
            .collect()
    }
}

/// The framebuffer and the buffer object of the copies.
#[derive(Debug)]
pub(super) struct Depths {
    /// Of the window's depths; none where it has none.
    small: Option<Single>,
    buffer: BufferName,
    /// Widths and heights of the pictures in the buffer, in samples, and how their depths lie there.
    taken: Vec<([i32; 2], DepthKind)>,
    /// Signalled once the last of them is in the buffer.
    fence: Option<Fence>,
    /// The driver has refused the framebuffer or the buffer object.
    refused: bool,
}

impl Depths {
    pub(super) fn framebuffer(&self) -> Option<FramebufferName> {
        self.small.as_ref().map(Single::framebuffer)
    }

    fn has_room(&self) -> bool {
        self.taken.len() < PICTURES && !self.refused
    }
}

impl Atlas {
    /// Makes the objects for [`Atlas::take_depths`]. The caller saves and restores bindings as for [`Atlas::new`], and the pack
    /// buffer.
    pub fn make_depths(&mut self, gl: &Gl, names: &mut Names, window: &Window) {
        let size = small_size([window.width, window.height]);
        let (flipped, textures) = (self.flipped, &mut self.textures);
        let small =
            (window.bits[4] > 0).then(|| Single::new(gl, names, window, size, flipped, textures));
        let buffer = gl.gen_buffer();
        gl.bind_buffer(c::PIXEL_PACK_BUFFER, buffer);
        gl.buffer_data_empty(c::PIXEL_PACK_BUFFER, PICTURES * SLOT);
        gl.bind_buffer(c::PIXEL_PACK_BUFFER, BufferName::ZERO);
        self.depths = Some(Depths {
            small,
            buffer,
            taken: Vec::new(),
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

    /// Copies the current depths of the program's own view in a part of the window: left, bottom, right, top in its pixels. False where there
    /// is no more room, or depths cannot be read. Changes the framebuffer bindings.
    pub fn take_depths(&mut self, gl: &Gl, neutral: &Neutral, area: [i32; 4]) -> bool {
        if !self.depths.as_ref().is_some_and(Depths::has_room) || !gl.reads_depths() {
            return false;
        }
        self.resolve(gl, &self.tiles.own_alone(), c::DEPTH_BUFFER_BIT);
        let (from, x) = self.readable(self.tiles.own());
        let [width, height] = [self.tiles.width, self.tiles.height].map(|n| n as i32);
        let [left, bottom, right, top] = inside(area, self.tiles.window.map(|n| n as i32));
        // The tile may have fewer pixels than the window, and in a slanted grid they are not those of its columns.
        let of = |at: i32, pixels: i32, window: u32| at * pixels / window.max(1) as i32;
        let [columns, rows] = self.tiles.window;
        let across = match self.tiles.grid.shear == 0.0 {
            true => [of(left, width, columns), of(right, width, columns)],
            false => [0, width],
        };
        let up = [of(bottom, height, rows), of(top, height, rows)];
        let area = inside([across[0], up[0], across[1], up[1]], [width, height]);
        self.bound_row = u32::MAX;
        let small = self.depths.as_ref().and_then(|d| d.small.as_ref());
        let Some((framebuffer, size)) = small.map(|small| {
            small.shrink(gl, from, x, area);
            (small.framebuffer(), small.size())
        }) else {
            return false;
        };
        self.take_depths_of(gl, neutral, framebuffer, size)
    }

    /// Takes all depths of a framebuffer as they are; `size` is its width and height, as [`small_size`] gives it. As [`Atlas::take_depths`].
    pub fn take_depths_of(
        &mut self,
        gl: &Gl,
        neutral: &Neutral,
        framebuffer: FramebufferName,
        size: [i32; 2],
    ) -> bool {
        let depths = self.depths.as_mut().filter(|d| d.has_room());
        let Some(depths) = depths.filter(|_| bytes(size) <= SLOT && gl.reads_depths()) else {
            return false;
        };
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, framebuffer);
        gl.bind_buffer(c::PIXEL_PACK_BUFFER, depths.buffer);
        let at = depths.taken.len() * SLOT;
        let kind = gl.read_depth_to_buffer(neutral.pixels(), size[0], size[1], at);
        gl.bind_buffer(c::PIXEL_PACK_BUFFER, BufferName::ZERO);
        depths.taken.push((size, kind));
        self.bound_row = u32::MAX;
        true
    }

    /// Ends the pictures of this frame with a fence.
    pub fn send_depths(&mut self, gl: &Gl) {
        if let Some(depths) = self.depths.as_mut().filter(|d| !d.taken.is_empty()) {
            depths.fence = gl.fence();
        }
    }

    /// Whether [`Atlas::read_depths`] would not wait; false where the driver has no fences.
    pub fn depths_are_there(&self, gl: &Gl) -> bool {
        let fence = self.depths.as_ref().and_then(|d| d.fence.as_ref());
        fence.is_some_and(|fence| gl.passed(fence))
    }

    /// The pictures since the last read, in the order in which they were taken. No pack buffer may be bound.
    pub fn read_depths(&mut self, gl: &Gl) -> Vec<DepthPicture> {
        let Some(depths) = &mut self.depths else {
            return Vec::new();
        };
        depths
            .fence
            .take()
            .into_iter()
            .for_each(|f| gl.delete_fence(f));
        gl.bind_buffer(c::PIXEL_PACK_BUFFER, depths.buffer);
        let taken = std::mem::take(&mut depths.taken);
        let pictures = taken
            .into_iter()
            .enumerate()
            .map(|(picture, (size, kind))| {
                let mut samples = vec![0.0; bytes(size) / size_of::<f32>()];
                gl.get_buffer_depths(c::PIXEL_PACK_BUFFER, picture * SLOT, kind, &mut samples);
                DepthPicture {
                    size: size.map(|n| n as usize),
                    depths: samples,
                }
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

/// Width and height in samples of the copy of depths of this size in pixels.
pub fn small_size([width, height]: [u32; 2]) -> [i32; 2] {
    let longer = width.max(height).max(1);
    [width, height].map(|pixels| (pixels * SAMPLES.min(longer) / longer).max(1) as i32)
}

/// The part of a rectangle (left, bottom, right, top) that lies within a picture of this size; all of that where no pixel does.
pub fn inside([left, bottom, right, top]: [i32; 4], [width, height]: [i32; 2]) -> [i32; 4] {
    let part = [
        left.max(0),
        bottom.max(0),
        right.min(width),
        top.min(height),
    ];
    match part[0] < part[2] && part[1] < part[3] {
        true => part,
        false => [0, 0, width, height],
    }
}

/// Bytes of one picture.
fn bytes([width, height]: [i32; 2]) -> usize {
    width as usize * height as usize * size_of::<f32>()
}
