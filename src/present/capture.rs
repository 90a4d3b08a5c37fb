//! Captured pictures, as PNG with row 0 on top.

use crate::config::Capture;
use crate::gl::Gl;
use crate::state::Neutral;
use image::{ImageBuffer, Luma, RgbImage};
use std::path::Path;

/// Reads the colours of a rectangle of the bound read framebuffer; x and y are in pixels from the lower left.
pub fn read_rgb(gl: &Gl, neutral: &Neutral, x: i32, y: i32, width: u32, height: u32) -> RgbImage {
    let mut image = RgbImage::from_raw(
        width,
        height,
        gl.read_rgb(neutral.pixels(), x, y, width, height),
    )
    .unwrap_or_default();
    image::imageops::flip_vertical_in_place(&mut image);
    image
}

/// Reads the depths of a rectangle of the bound read framebuffer, 0 (near) to 65535; x and y are in pixels from the lower left.
pub fn read_depth(
    gl: &Gl,
    neutral: &Neutral,
    x: i32,
    y: i32,
    width: u32,
    height: u32,
) -> ImageBuffer<Luma<u16>, Vec<u16>> {
    let mut image = ImageBuffer::from_raw(
        width,
        height,
        gl.read_depth16(neutral.pixels(), x, y, width, height),
    )
    .unwrap_or_default();
    image::imageops::flip_vertical_in_place(&mut image);
    image
}

/// Writes a file that is no picture in the way of [`write()`].
///
/// # Errors
/// The file and the error of the system, in one line.
pub fn write_bytes(bytes: &[u8], path: &Path) -> Result<(), String> {
    let partial = Capture::partial(path);
    let written = std::fs::write(&partial, bytes).and_then(|()| std::fs::rename(&partial, path));
    written.map_err(|e| format!("{}: {e}", path.display()))
}

/// Writes a picture to a file beside `path` and renames that, so that whoever waits for the file never sees half of it.
///
/// # Errors
/// The file and the error of the system, in one line.
pub fn write<P, C>(image: &ImageBuffer<P, C>, path: &Path) -> Result<(), String>
where
    P: image::Pixel + image::PixelWithColorType,
    [P::Subpixel]: image::EncodableLayout,
    C: std::ops::Deref<Target = [P::Subpixel]>,
{
    let partial = Capture::partial(path);
    image
        .save_with_format(&partial, image::ImageFormat::Png)
        .map_err(|e| format!("{}: {e}", path.display()))?;
    std::fs::rename(&partial, path).map_err(|e| format!("{}: {e}", path.display()))
}
