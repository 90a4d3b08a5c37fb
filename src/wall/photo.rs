//! The tags in a photo, and the light around them.
#![forbid(unsafe_code)]

use super::WallError;
use super::homography::from_pairs;
use super::pattern::Tag;
use crate::calibrate::{linear, upright};
use crate::display::apply;
use apriltag::{DetectorBuilder, Family, Image};
use image::Luma;
use std::path::Path;

/// A value at or above this one is taken as clipped.
const CLIPPED: u8 = 253;
/// Where the light around a tag is taken, in halves of its black side from its middle: in the middle of its white edge.
const AROUND: f64 = 4.5 / 4.0;

/// What a photo shows of a wall.
#[derive(Clone, Debug)]
pub(super) struct Sighting {
    /// For messages.
    pub(super) name: String,
    /// Width and height in pixels.
    pub(super) size: [f64; 2],
    pub(super) seen: Vec<Seen>,
}

/// A tag in a photo.
#[derive(Clone, Debug)]
pub(super) struct Seen {
    pub(super) tag: Tag,
    /// In pixels of the photo, in the order of [`Tag::corners`].
    pub(super) corners: [[f64; 2]; 4],
    /// Linear light beside it, 0 to 1; none where it is clipped.
    pub(super) light: Vec<([f64; 2], f64)>,
    pub(super) clipped: usize,
}

impl Sighting {
    /// Looks for tags in a JPEG, PNG or HEIC file, which is turned upright as it says.
    ///
    /// # Errors
    /// It cannot be read, or shows no tag of the wall.
    pub(super) fn load(path: &Path, tags: &[Tag]) -> Result<Self, WallError> {
        let name = path.display().to_string();
        let failed = |reason: String| WallError::Photo {
            photo: name.clone(),
            reason,
        };
        let bytes = std::fs::read(path).map_err(|e| failed(e.to_string()))?;
        let picture = upright(&bytes).map_err(failed)?;
        Self::of(&name, &picture.into_luma8(), tags)
    }

    fn of(
        name: &str,
        grey: &image::ImageBuffer<Luma<u8>, Vec<u8>>,
        tags: &[Tag],
    ) -> Result<Self, WallError> {
        let (width, height) = grey.dimensions();
        let wrong = |error: apriltag::Error| WallError::Detector(error.to_string());
        let mut picture = Image::zeros_with_stride(width as usize, height as usize, width as usize)
            .map_err(wrong)?;
        let stride = picture.stride();
        let rows = picture.as_slice_mut().chunks_exact_mut(stride);
        for (to, from) in rows.zip(grey.as_raw().chunks_exact(width as usize)) {
            for (to, from) in to.iter_mut().zip(from) {
                // The edge of a black square is where half of the light is, and not half of its sRGB value: corners would be 0.8 pixels off.
                *to = (linear(f32::from(*from) / 255.0) * 255.0).round() as u8;
            }
        }
        let builder = DetectorBuilder::new().add_family_bits(Family::tag_36h11(), 1);
        let mut detector = builder.build().map_err(wrong)?;
        detector.set_refine_edges(true);
        detector.set_decimation(1.0);
        let threads = std::thread::available_parallelism().map_or(1, |count| count.get().min(16));
        detector.set_thread_number(threads as u8);
        let found = detector.detect(&picture);
        let seen: Vec<Seen> = found
            .iter()
            .filter(|found| found.hamming() == 0)
            .filter_map(|found| {
                let tag = *tags.iter().find(|tag| tag.id == found.id())?;
                Some(Seen::new(tag, found.corners(), grey))
            })
            .collect();
        if seen.is_empty() {
            return Err(WallError::NoTags { photo: name.into() });
        }
        Ok(Self {
            name: name.to_owned(),
            size: [f64::from(width), f64::from(height)],
            seen,
        })
    }
}

impl Seen {
    fn new(tag: Tag, corners: [[f64; 2]; 4], grey: &image::ImageBuffer<Luma<u8>, Vec<u8>>) -> Self {
        let square = [[-1.0, 1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]];
        let pairs: Vec<_> = square.into_iter().zip(corners).collect();
        let mut seen = Self {
            tag,
            corners,
            light: Vec::new(),
            clipped: 0,
        };
        let Some(to_photo) = from_pairs(&pairs) else {
            return seen;
        };
        for (across, down) in [
            (-1.0, -1.0),
            (0.0, -1.0),
            (1.0, 0.0),
            (1.0, 1.0),
            (0.0, 1.0),
            (-1.0, 0.0),
        ] {
            let place = apply(&to_photo, [across * AROUND, down * AROUND]);
            let (mut sum, mut count) = (0.0, 0);
            for (dx, dy) in [
                (-1, -1),
                (0, -1),
                (1, -1),
                (-1, 0),
                (0, 0),
                (1, 0),
                (-1, 1),
                (0, 1),
                (1, 1),
            ] {
                let [x, y] = [place[0] + f64::from(dx), place[1] + f64::from(dy)];
                if x < 0.0 || y < 0.0 {
                    continue;
                }
                match grey.get_pixel_checked(x as u32, y as u32) {
                    Some(pixel) if pixel.0[0] < CLIPPED => {
                        sum += f64::from(linear(f32::from(pixel.0[0]) / 255.0));
                        count += 1;
                    }
                    Some(_) => seen.clipped += 1,
                    None => {}
                }
            }
            if count == 9 {
                seen.light.push((place, sum / 9.0));
            }
        }
        seen
    }
}
