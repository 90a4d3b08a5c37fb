//! A photo in linear light.
#![forbid(unsafe_code)]

use super::CalibrateError;
use exif::{In, Reader, Tag};
use glam::DVec2;
use image::{DynamicImage, ImageDecoder, ImageReader, RgbImage};
use std::io::Cursor;
use std::path::Path;

/// Larger photos are averaged down: the fringes are coarse, and averaging in linear light takes noise away.
const LARGEST_SIDE: u32 = 2600;
/// The beats of gratings are finer. A photo of 24 Mpx, as phones take them, is not averaged.
const LARGEST_FINE_SIDE: u32 = 6200;
/// Larger ones than any camera takes are not decoded: they would only take memory.
const MOST_PIXELS: u64 = 1 << 28;
/// A channel at or above this value is taken as clipped.
const CLIPPED: u8 = 253;
/// Diagonal of the film that EXIF's equivalent focal length is for, mm.
const FILM_DIAGONAL: f64 = 43.267;

/// A photo in linear light.
#[derive(Clone)]
pub struct Photo {
    pub(super) name: String,
    pub(super) width: u32,
    pub(super) height: u32,
    /// Focal length in pixels, where the photo says it.
    pub(super) focal: Option<f64>,
    /// R, G, B from 0 to 1, rows from the top.
    light: Vec<[f32; 3]>,
    /// Part of the pixels under this one that is clipped, rows from the top.
    clipped: Vec<f32>,
}

impl std::fmt::Debug for Photo {
    // The values would be megabytes of text.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Photo({}, {}x{})", self.name, self.width, self.height)
    }
}

impl Photo {
    /// Reads a JPEG, PNG or HEIC file, turned upright as it says.
    pub fn load(path: &Path) -> Result<Self, CalibrateError> {
        Self::read(path, LARGEST_SIDE)
    }

    /// The same with more detail, for [`super::Beats`].
    pub fn load_fine(path: &Path) -> Result<Self, CalibrateError> {
        Self::read(path, LARGEST_FINE_SIDE)
    }

    fn read(path: &Path, largest: u32) -> Result<Self, CalibrateError> {
        let photo = path.display().to_string();
        match std::fs::read(path) {
            Ok(bytes) => Self::decoded(&photo, &bytes, largest),
            Err(source) => Err(CalibrateError::Read { photo, source }),
        }
    }

    /// A JPEG, PNG or HEIC file in memory; `name` is for messages.
    pub fn decode(name: &str, bytes: &[u8]) -> Result<Self, CalibrateError> {
        Self::decoded(name, bytes, LARGEST_SIDE)
    }

    /// The same with more detail, for [`super::Beats`].
    pub fn decode_fine(name: &str, bytes: &[u8]) -> Result<Self, CalibrateError> {
        Self::decoded(name, bytes, LARGEST_FINE_SIDE)
    }

    fn decoded(name: &str, bytes: &[u8], largest: u32) -> Result<Self, CalibrateError> {
        let failed = |reason: String| CalibrateError::Decode {
            photo: name.into(),
            reason,
        };
        let picture = upright(bytes).map_err(failed)?.into_rgb8();
        Ok(Self::averaged(name, &picture, largest).with_equivalent(equivalent(bytes)))
    }

    /// A picture in sRGB; `equivalent` is the focal length in mm for film of 36x24 mm, as phones and EXIF give it.
    #[must_use]
    pub fn from_picture(name: &str, picture: &RgbImage, equivalent: Option<f64>) -> Self {
        Self::averaged(name, picture, LARGEST_SIDE).with_equivalent(equivalent)
    }

    /// Averaged down until no side is longer than `largest` pixels.
    fn averaged(name: &str, picture: &RgbImage, largest: u32) -> Self {
        let linear: Vec<f32> = (0..=255u16).map(|v| linear(f32::from(v) / 255.0)).collect();
        let pool = picture
            .width()
            .max(picture.height())
            .div_ceil(largest)
            .max(1);
        let (width, height) = (picture.width() / pool, picture.height() / pool);
        let (mut light, mut clipped) = (Vec::new(), Vec::new());
        let share = 1.0 / (pool * pool) as f32;
        for y in 0..height {
            for x in 0..width {
                let (mut sum, mut over) = ([0.0f32; 3], 0.0);
                for (dx, dy) in (0..pool).flat_map(|dy| (0..pool).map(move |dx| (dx, dy))) {
                    let pixel = picture.get_pixel(x * pool + dx, y * pool + dy).0;
                    for (sum, value) in sum.iter_mut().zip(pixel) {
                        *sum += share * linear.get(usize::from(value)).copied().unwrap_or(1.0);
                    }
                    over += share * f32::from(u8::from(pixel.iter().all(|&v| v >= CLIPPED)));
                }
                light.push(sum);
                clipped.push(over);
            }
        }
        Self {
            name: name.into(),
            width,
            height,
            focal: None,
            light,
            clipped,
        }
    }

    /// The same photo with a focal length in mm for film of 36x24 mm; None leaves what it says itself.
    #[must_use]
    pub fn with_equivalent(mut self, equivalent: Option<f64>) -> Self {
        if let Some(mm) = equivalent.filter(|mm| (5.0..2000.0).contains(mm)) {
            self.focal = Some(2.0 * self.half() * mm / FILM_DIAGONAL);
        }
        self
    }

    /// Half of the diagonal, pixels.
    pub(super) fn half(&self) -> f64 {
        f64::from(self.width).hypot(f64::from(self.height)) / 2.0
    }

    /// The middle, pixels.
    pub(super) fn centre(&self) -> DVec2 {
        DVec2::new(f64::from(self.width), f64::from(self.height)) / 2.0
    }

    /// R, G, B between the four nearest pixels; None outside.
    pub(super) fn at(&self, p: DVec2) -> Option<[f32; 3]> {
        let (base, part) = ((p - 0.5).floor(), (p - 0.5).fract_gl().as_vec2());
        if base.x < 0.0 || base.y < 0.0 {
            return None;
        }
        let (x, y, width) = (base.x as usize, base.y as usize, self.width as usize);
        if x + 1 >= width {
            return None;
        }
        let pair = |y: usize| {
            Some((
                self.light.get(y * width + x)?,
                self.light.get(y * width + x + 1)?,
            ))
        };
        let ((a, b), (c, d)) = (pair(y)?, pair(y + 1)?);
        let mut mixed = [0.0; 3];
        for ((((mixed, a), b), c), d) in mixed.iter_mut().zip(a).zip(b).zip(c).zip(d) {
            let (top, bottom) = (a + (b - a) * part.x, c + (d - c) * part.x);
            *mixed = top + (bottom - top) * part.y;
        }
        Some(mixed)
    }

    /// The mean of R, G and B between the four nearest pixels; None outside.
    pub(super) fn grey(&self, p: DVec2) -> Option<f64> {
        self.at(p)
            .map(|rgb| f64::from(rgb.iter().sum::<f32>() / 3.0))
    }

    /// How much of the nearest pixel is clipped in all channels; 0 outside.
    pub(super) fn clipped(&self, p: DVec2) -> f64 {
        if p.x < 0.0 || p.y < 0.0 || p.x >= f64::from(self.width) {
            return 0.0;
        }
        let at = p.y as usize * self.width as usize + p.x as usize;
        f64::from(self.clipped.get(at).copied().unwrap_or(0.0))
    }

    /// The mean grey of blocks of `pool` pixels, with width and height.
    pub(super) fn small(&self, pool: u32) -> (Vec<f32>, usize, usize) {
        let (width, height) = (self.width / pool, self.height / pool);
        let (pool, across) = (pool as usize, self.width as usize);
        let mut grey = Vec::with_capacity(width as usize * height as usize);
        for y in 0..height as usize {
            for x in 0..width as usize {
                let rows = (y * pool..).take(pool);
                let sum: f32 = rows
                    .flat_map(|row| self.light.iter().skip(row * across + x * pool).take(pool))
                    .flatten()
                    .sum();
                grey.push(sum / (3 * pool * pool) as f32);
            }
        }
        (grey, width as usize, height as usize)
    }
}

/// The picture of a JPEG, PNG or HEIC file, turned upright as it says; the error says why there is none.
pub(crate) fn upright(bytes: &[u8]) -> Result<DynamicImage, String> {
    if is_heif(bytes) {
        return heif(bytes);
    }
    let reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format();
    let reader = reader.map_err(|e| e.to_string())?;
    let mut decoder = reader.into_decoder().map_err(|e| e.to_string())?;
    let (width, height) = decoder.dimensions();
    if u64::from(width) * u64::from(height) > MOST_PIXELS {
        return Err(format!(
            "{width}x{height} pixels are more than 2^28; make it smaller"
        ));
    }
    let orientation = decoder.orientation().map_err(|e| e.to_string())?;
    let mut picture = DynamicImage::from_decoder(decoder).map_err(|e| e.to_string())?;
    picture.apply_orientation(orientation);
    Ok(picture)
}

/// Whether a file begins as those of HEIF do (ISO/IEC 23008-12), of which HEIC is the kind that phones write.
fn is_heif(bytes: &[u8]) -> bool {
    const BRANDS: [&[u8]; 7] = [
        b"heic", b"heix", b"heim", b"heis", b"hevc", b"mif1", b"msf1",
    ];
    bytes.get(4..8) == Some(b"ftyp")
        && bytes
            .get(8..12)
            .is_some_and(|brand| BRANDS.contains(&brand))
}

/// The picture of a HEIC file in sRGB. Its turns are those of the file itself; EXIF repeats them.
#[cfg(feature = "heic")]
fn heif(bytes: &[u8]) -> Result<DynamicImage, String> {
    let options = heifer::Options {
        max_threads: 0,
        max_pixels: MOST_PIXELS,
    };
    let picture = heifer::decode_srgb_rgba8(bytes, &options).map_err(|e| e.to_string())?;
    let (width, height) = (picture.width, picture.height);
    let picture = RgbImage::from_raw(width, height, picture.into_rgb8());
    let picture = picture.ok_or("its pixels are not as many as it says")?;
    Ok(picture.into())
}

#[cfg(not(feature = "heic"))]
fn heif(_: &[u8]) -> Result<DynamicImage, String> {
    Err("this build of manyview does not read HEIC; let the phone write JPEG (iPhone: Settings, Camera, Formats, Most Compatible), or use heif-convert".into())
}

/// The transfer function of sRGB (IEC 61966-2-1).
pub(crate) fn linear(value: f32) -> f32 {
    if value <= 0.04045 {
        value / 12.92
    } else {
        ((value + 0.055) / 1.055).powf(2.4)
    }
}

/// The focal length for film of 36x24 mm, mm, where EXIF has it.
fn equivalent(bytes: &[u8]) -> Option<f64> {
    let exif = Reader::new()
        .read_from_container(&mut Cursor::new(bytes))
        .ok()?;
    let field = exif.get_field(Tag::FocalLengthIn35mmFilm, In::PRIMARY)?;
    field
        .value
        .get_uint(0)
        .map(f64::from)
        .filter(|&mm| mm > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file by x265 and libheif 1.15: red, green, blue and white quarters of 64x48 pixels.
    #[test]
    fn photos_of_phones_are_read() {
        let bytes = include_bytes!("../../fuzz/seeds/photo/quarters.heic");
        let read = upright(bytes);
        if !cfg!(feature = "heic") {
            assert!(read.expect_err("no decoder").contains("Most Compatible"));
            return;
        }
        let picture = read.expect("a picture").into_rgb8();
        assert_eq!(picture.dimensions(), (64, 48));
        let quarters = [
            ([16, 12], [255, 0, 0]),
            ([48, 12], [0, 255, 0]),
            ([16, 36], [0, 0, 255]),
            ([48, 36], [255; 3]),
        ];
        for ([x, y], expected) in quarters {
            let found = picture.get_pixel(x, y).0;
            let near = found.iter().zip(expected).all(|(a, b)| a.abs_diff(b) < 8);
            assert!(near, "{found:?} at {x}, {y}, not {expected:?}");
        }
        for length in [0, 4, 12, 40, bytes.len() / 2, bytes.len() - 1] {
            assert!(upright(&bytes[..length]).is_err(), "{length} bytes");
        }
    }

    #[test]
    fn a_photo_has_as_many_pixels_as_memory_is_asked_for() {
        let mut bytes = include_bytes!("../../fuzz/seeds/photo/turned.jpg").to_vec();
        Photo::decode("small.jpg", &bytes).expect("a photo");
        // The head of the frame (SOF0): its length, the depth of a sample, height and width.
        let head = bytes.windows(2).position(|two| two == [0xff, 0xc0]);
        let height = head.expect("a head") + 5;
        bytes[height..height + 4].fill(0xff);
        let error = Photo::decode("large.jpg", &bytes).expect_err("too large");
        let expected = "65535x65535 pixels are more than 2^28; make it smaller";
        assert!(error.to_string().contains(expected), "{error}");
    }
}
