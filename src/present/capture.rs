//! Captured pictures, as PNG with row 0 on top.

use crate::config::{replace, replace_by};
use crate::gl::Gl;
use crate::state::Neutral;
use image::{ImageBuffer, Luma, RgbImage};
use std::fs::File;
use std::io::BufWriter;
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
    replace(path, bytes).map_err(|e| format!("{}: {e}", path.display()))
}

/// Writes a picture as PNG in one step, so that whoever waits for the file never sees half of it.
///
/// # Errors
/// The file and the error of the system, in one line.
pub fn write<P, C>(image: &ImageBuffer<P, C>, path: &Path) -> Result<(), String>
where
    P: image::Pixel + image::PixelWithColorType,
    [P::Subpixel]: image::EncodableLayout,
    C: std::ops::Deref<Target = [P::Subpixel]>,
{
    let png = |file: &mut BufWriter<File>| {
        let written = image.write_to(file, image::ImageFormat::Png);
        written.map_err(std::io::Error::other)
    };
    replace_by(path, png).map_err(|e| format!("{}: {e}", path.display()))
}
