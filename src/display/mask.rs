//! The mask: for each subpixel the view it shows. On disk a 16-bit RGB PNG whose values are the indices themselves.
#![forbid(unsafe_code)]

use super::{MaskError, Placement};
use crate::bounded;
use image::codecs::png::{CompressionType, FilterType, PngDecoder, PngEncoder};
use image::{ExtendedColorType, ImageDecoder, ImageEncoder, Limits};
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{BufReader, BufWriter, Read, Seek, Write};
use std::path::Path;

/// The value of a subpixel that stays black.
pub const GUARD: u16 = u16::MAX;

const MAX_SIDE: u32 = 32_768;
/// 400 MB of views.
const MAX_PIXELS: u64 = 1 << 26;
/// Bytes of the head of a PNG, up to its depth and kind of colour.
const HEAD: usize = 26;
/// What a PNG may ask for beside its pixels, in bytes.
const MAX_BESIDE: u64 = 1 << 24;
const CHANNELS: [&str; 3] = ["red", "green", "blue"];

/// View indices of all subpixels of a picture.
#[derive(Clone, PartialEq, Eq)]
pub struct Mask {
    width: u32,
    height: u32,
    data: Vec<[u16; 3]>,
}

impl std::fmt::Debug for Mask {
    // The values would be megabytes of text.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Mask({}x{})", self.width, self.height)
    }
}

impl Mask {
    /// A mask from its values, rows from the top, each from the left, as R, G, B. None when the count is wrong or a
    /// side is 0 or above 32768.
    pub fn new(width: u32, height: u32, data: Vec<[u16; 3]>) -> Option<Self> {
        let pixels = pixel_count(width, height).ok()?;
        (data.len() == pixels).then_some(Self {
            width,
            height,
            data,
        })
    }

    /// Pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// R, G, B of each pixel; row 0 on top, without padding. `as_flattened()` is what `GL_RGB_INTEGER`,
    /// `GL_UNSIGNED_SHORT` uploads.
    pub fn data(&self) -> &[[u16; 3]] {
        &self.data
    }

    /// R, G, B at a pixel, `row` from the top; None outside.
    pub fn at(&self, x: u32, row: u32) -> Option<[u16; 3]> {
        if x >= self.width {
            return None;
        }
        self.data
            .get(row as usize * self.width as usize + x as usize)
            .copied()
    }

    /// The rows, from the top.
    pub fn rows(&self) -> impl Iterator<Item = &[[u16; 3]]> {
        self.data.chunks_exact(self.width as usize)
    }

    /// The views that at least one subpixel shows; the guard is none. The others need not be drawn.
    pub fn views_shown(&self) -> BTreeSet<u16> {
        let mut seen = vec![false; usize::from(u16::MAX) + 1];
        for &view in self.data.as_flattened() {
            if let Some(seen) = seen.get_mut(usize::from(view)) {
                *seen = true;
            }
        }
        (0..GUARD)
            .zip(seen)
            .filter_map(|(view, seen)| seen.then_some(view))
            .collect()
    }

    /// Changes every view; the guard stays.
    pub(super) fn map(&mut self, change: impl Fn(u16) -> u16) {
        for view in self.data.as_flattened_mut() {
            if *view != GUARD {
                *view = change(*view);
            }
        }
    }

    /// Writes a 16-bit RGB PNG.
    pub fn to_png(&self, path: impl AsRef<Path>) -> Result<(), MaskError> {
        let path = path.as_ref();
        let failed = |reason: String| MaskError::Write {
            file: path.display().to_string(),
            reason,
        };
        let mut out = BufWriter::new(File::create(path).map_err(|e| failed(e.to_string()))?);
        // `image` takes 16-bit samples in the byte order of the machine.
        let bytes: Vec<u8> = self
            .data
            .as_flattened()
            .iter()
            .flat_map(|view| view.to_ne_bytes())
            .collect();
        PngEncoder::new_with_quality(&mut out, CompressionType::Fast, FilterType::Up)
            .write_image(&bytes, self.width, self.height, ExtendedColorType::Rgb16)
            .map_err(|e| failed(e.to_string()))?;
        out.flush().map_err(|e| failed(e.to_string()))
    }

    /// Reads a 16-bit RGB PNG.
    pub fn from_png(path: impl AsRef<Path>) -> Result<Self, MaskError> {
        let path = path.as_ref();
        let file = path.display().to_string();
        let mut head = [0; HEAD];
        let mut bytes = match bounded::open(path) {
            Ok(file) => BufReader::new(file),
            Err(source) => return Err(MaskError::Read { file, source }),
        };
        let read = bytes
            .read_exact(&mut head)
            .and_then(|()| bytes.rewind())
            .map(|()| head);
        // The decoder would turn palettes and small depths into RGB, so the header is asked itself.
        match read {
            Ok([137, 80, 78, 71, 13, 10, 26, 10, .., 16, 2]) => {}
            Ok([137, 80, 78, 71, 13, 10, 26, 10, .., depth, colour]) => {
                return Err(MaskError::Format {
                    file,
                    found: describe(depth, colour),
                });
            }
            _ => {
                return Err(MaskError::NotPng {
                    file,
                    reason: "it has no PNG header".into(),
                });
            }
        }
        let broken = |e: image::ImageError| MaskError::NotPng {
            file: file.clone(),
            reason: e.to_string(),
        };
        let mut limits = Limits::no_limits();
        limits.max_alloc = Some(MAX_PIXELS * 6 + MAX_BESIDE);
        let decoder = PngDecoder::with_limits(bytes, limits).map_err(broken)?;
        let (width, height) = decoder.dimensions();
        let mut data = vec![[0; 3]; pixel_count(width, height)?];
        let samples: &mut [u8] = bytemuck::cast_slice_mut(&mut data);
        if decoder.total_bytes() != samples.len() as u64 {
            // A tRNS chunk makes the decoder add alpha.
            return Err(MaskError::Format {
                file,
                found: "RGB with a transparent colour".into(),
            });
        }
        decoder.read_image(samples).map_err(broken)?;
        Ok(Self {
            width,
            height,
            data,
        })
    }

    /// Refuses indices that are no view of N.
    pub(super) fn check_indices(&self, path: &Path, views: u32) -> Result<(), MaskError> {
        for (row, pixels) in (0..).zip(self.rows()) {
            for (x, pixel) in (0..).zip(pixels) {
                for (channel, &view) in CHANNELS.iter().zip(pixel) {
                    if view != GUARD && u32::from(view) >= views {
                        let (file, view) = (path.display().to_string(), u32::from(view));
                        return Err(MaskError::Index {
                            file,
                            channel,
                            x,
                            row,
                            view,
                            views,
                        });
                    }
                }
            }
        }
        Ok(())
    }

    /// The part of a mask of the whole screen that lies under a picture, black beyond the screen, where nothing is seen. A mask of the
    /// picture's own size is that of the picture, wherever it lies.
    pub(super) fn crop(&self, path: &Path, placement: &Placement) -> Result<Self, MaskError> {
        let &Placement {
            screen_width,
            screen_height,
            x,
            y,
            width,
            height,
        } = placement;
        let size = (self.width, self.height);
        if size != (screen_width, screen_height) {
            if size == (width, height) {
                return Ok(self.clone());
            }
            return Err(MaskError::WindowSize {
                file: path.display().to_string(),
                mask_width: self.width,
                mask_height: self.height,
                width,
                height,
                x,
                y,
                screen_width,
                screen_height,
            });
        }
        Self::by_rows(placement, |first, row, out| {
            for (x, out) in (first..).zip(out) {
                if let (Ok(x), Ok(row)) = (u32::try_from(x), u32::try_from(row))
                    && let Some(pixel) = self.at(x, row)
                {
                    *out = pixel;
                }
            }
        })
    }

    /// Makes a mask row by row: `fill(x, row, pixels)` with the screen position of the first pixel, row from the top.
    pub(super) fn by_rows(
        placement: &Placement,
        fill: impl Fn(i64, i64, &mut [[u16; 3]]),
    ) -> Result<Self, MaskError> {
        let &Placement {
            x,
            y,
            width,
            height,
            ..
        } = placement;
        let mut data = vec![[GUARD; 3]; pixel_count(width, height)?];
        for (row, pixels) in (i64::from(y)..).zip(data.chunks_exact_mut(width as usize)) {
            fill(i64::from(x), row, pixels);
        }
        Ok(Self {
            width,
            height,
            data,
        })
    }
}

/// Checked before memory is asked for.
fn pixel_count(width: u32, height: u32) -> Result<usize, MaskError> {
    let side = 1..=MAX_SIDE;
    let pixels = u64::from(width) * u64::from(height);
    match usize::try_from(pixels) {
        Ok(count) if side.contains(&width) && side.contains(&height) && pixels <= MAX_PIXELS => {
            Ok(count)
        }
        _ => Err(MaskError::Size { width, height }),
    }
}

/// Bit depth and colour type of a PNG header in words (PNG specification, 11.2.2).
fn describe(depth: u8, colour: u8) -> String {
    let colour = match colour {
        0 => "grey",
        2 => "RGB",
        3 => "palette",
        4 => "grey with alpha",
        6 => "RGB with alpha",
        _ => "unknown colours",
    };
    format!("{depth}-bit {colour}")
}
