//! The layer's calls that read and draw pixels.

use super::consts as c;
use super::{DepthKind, Gl, PixelStore, Ptr};

impl Gl {
    /// glReadPixels of RGB bytes, rows bottom up.
    pub fn read_rgb(&self, _: &PixelStore, x: i32, y: i32, w: u32, h: u32) -> Vec<u8> {
        // OpenGL ES reads four or none.
        let (format, size) = if self.is_es() {
            (c::RGBA, 4)
        } else {
            (c::RGB, 3)
        };
        let mut out = vec![0u8; w as usize * h as usize * size];
        let kind = c::UNSIGNED_BYTE;
        let p = out.as_mut_ptr().cast();
        // SAFETY: w·h texels of so many bytes; without gaps, in no buffer (`PixelStore`).
        unsafe {
            self.real
                .glReadPixels(x, y, w as i32, h as i32, format, kind, p)
        };
        if size == 4 {
            let texels = out.chunks_exact(4);
            out = texels.flat_map(|t| t.iter().take(3).copied()).collect();
        }
        out
    }

    /// glReadPixels of four bytes a pixel into `out`, rows bottom up: blue, green, red and anything, or on OpenGL ES red first. `out` has w·h times
    /// four bytes, or nothing is read.
    pub fn read_bgra(&self, _: &PixelStore, [x, y]: [i32; 2], [w, h]: [u32; 2], out: &mut [u8]) {
        if out.len() != w as usize * h as usize * 4 {
            return;
        }
        let format = self.bgra();
        let p = out.as_mut_ptr().cast();
        // SAFETY: w·h texels of four bytes, as many as `out` has; without gaps, in no buffer (`PixelStore`).
        unsafe {
            self.real
                .glReadPixels(x, y, w as i32, h as i32, format, c::UNSIGNED_BYTE, p)
        };
        self.swap_to_bgra(out);
    }

    /// The format that is read for blue, green, red and alpha: OpenGL ES reads red first.
    pub(super) fn bgra(&self) -> u32 {
        if self.is_es() { c::RGBA } else { c::BGRA }
    }

    /// Puts what was read as [`Gl::bgra`] in that order.
    pub(super) fn swap_to_bgra(&self, texels: &mut [u8]) {
        if self.is_es() {
            texels
                .chunks_exact_mut(4)
                .for_each(|texel| texel.swap(0, 2));
        }
    }

    /// glReadPixels of the red channel of floats, rows bottom up.
    pub fn read_red(&self, _: &PixelStore, x: i32, y: i32, w: u32, h: u32) -> Vec<f32> {
        // OpenGL ES reads four or none.
        let (format, size) = if self.is_es() {
            (c::RGBA, 4)
        } else {
            (c::RED, 1)
        };
        let mut out = vec![0f32; w as usize * h as usize * size];
        let p = out.as_mut_ptr().cast();
        // SAFETY: w·h texels of so many floats; without gaps, in no buffer (`PixelStore`).
        unsafe {
            self.real
                .glReadPixels(x, y, w as i32, h as i32, format, c::FLOAT, p)
        };
        out.into_iter().step_by(size).collect()
    }

    /// glGetTexImage of level 0 of the 2D texture that is bound, as RGBA bytes, rows bottom up. `size` is that of the level. The bytes are 0
    /// where the driver refuses, as for integers and depths. OpenGL ES has no such command.
    pub fn read_texture(&self, _: &PixelStore, size: [i32; 2]) -> Vec<u8> {
        let [w, h] = size.map(|side| side.max(0) as usize);
        let mut out = vec![0u8; w * h * 4];
        let p = out.as_mut_ptr().cast();
        // SAFETY: w·h texels of four bytes; without gaps, in no buffer (`PixelStore`).
        unsafe {
            self.real
                .glGetTexImage(c::TEXTURE_2D, 0, c::RGBA, c::UNSIGNED_BYTE, p)
        };
        out
    }

    /// Whether glReadPixels reads depths; OpenGL ES has that by an extension.
    pub fn reads_depths(&self) -> bool {
        !self.is_es() || self.has_extension("GL_NV_read_depth")
    }

    /// As what depths of the framebuffer that is bound for reading can be read: desktop OpenGL converts them to what is wanted, OpenGL ES reads
    /// floats of a buffer of floats, integers of others, and nothing else (GL_NV_read_depth).
    pub(super) fn depth_kind(&self, wanted: DepthKind) -> DepthKind {
        if !self.is_es() {
            return wanted;
        }
        if self.version() < (3, 0) {
            return DepthKind::Integers;
        }
        let attachment = match self.get_integer(c::READ_FRAMEBUFFER_BINDING) {
            0 => c::DEPTH,
            _ => c::DEPTH_ATTACHMENT,
        };
        let name = c::FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE;
        match self.attachment_parameter_of(c::READ_FRAMEBUFFER, attachment, name) as u32 {
            c::FLOAT => DepthKind::Floats,
            _ => DepthKind::Integers,
        }
    }

    /// glReadPixels of depth as 16 bits, rows bottom up, 0 where [`Gl::reads_depths`] says no.
    pub fn read_depth16(&self, neutral: &PixelStore, x: i32, y: i32, w: u32, h: u32) -> Vec<u16> {
        let depths = self.read_depth32(neutral, x, y, w, h);
        let rounded = depths.into_iter().map(|depth| {
            let part = f64::from(depth) / f64::from(u32::MAX);
            (part * f64::from(u16::MAX)).round() as u16
        });
        rounded.collect()
    }

    /// glReadPixels of depth, 0 to `u32::MAX`, rows bottom up, 0 where [`Gl::reads_depths`] says no.
    pub fn read_depth32(&self, _: &PixelStore, x: i32, y: i32, w: u32, h: u32) -> Vec<u32> {
        let mut out = vec![0u32; w as usize * h as usize];
        if !self.reads_depths() {
            return out;
        }
        let kind = self.depth_kind(DepthKind::Integers);
        let ([w, h], format) = ([w, h].map(|side| side as i32), c::DEPTH_COMPONENT);
        let at = out.as_mut_ptr().cast();
        // SAFETY: w·h texels of 4 bytes, without gaps, in no buffer (`PixelStore`).
        unsafe { self.real.glReadPixels(x, y, w, h, format, kind.name(), at) };
        if kind == DepthKind::Floats {
            for depth in &mut out {
                let part = f64::from(f32::from_bits(*depth)).clamp(0.0, 1.0);
                *depth = (part * f64::from(u32::MAX)).round() as u32;
            }
        }
        out
    }

    /// glDrawPixels of RGB bytes, rows bottom up.
    pub fn draw_pixels_rgb(&self, _: &PixelStore, w: i32, h: i32, data: &[u8]) {
        if data.len() < w as usize * h as usize * 3 {
            return;
        }
        // SAFETY: w·h·3 bytes (checked), without gaps, in no buffer (`PixelStore`).
        unsafe {
            self.real
                .glDrawPixels(w, h, c::RGB, c::UNSIGNED_BYTE, data.as_ptr() as Ptr)
        }
    }
}
