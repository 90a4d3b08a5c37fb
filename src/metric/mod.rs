//! How much two pictures differ: measures for tests, the gate, and a picture of the differences for people.
//!
//! Differences are in LSB, steps of 1 of an 8-bit channel, unless said otherwise.
#![forbid(unsafe_code)]

use image::{Rgb, RgbImage};

mod gate;
mod ssim;
#[cfg(test)]
mod tests;

pub use gate::{Gate, GateError};

/// The threshold of the gate, in LSB.
pub const OUTLIER_LSB: u8 = 8;

/// Why two pictures cannot be compared.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum MetricError {
    /// Not the same size.
    #[error(
        "pictures of {expected_width}x{expected_height} and {actual_width}x{actual_height} pixels \
         cannot be compared; make both of one size"
    )]
    Sizes {
        /// Pixels.
        expected_width: u32,
        /// Pixels.
        expected_height: u32,
        /// Pixels.
        actual_width: u32,
        /// Pixels.
        actual_height: u32,
    },
    /// Nothing to compare.
    #[error("pictures without pixels cannot be compared; give at least one pixel")]
    Empty,
}

/// Two pictures of one size, measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Pixels of each picture.
    pub pixels: u64,
    /// Pixels where any channel differs.
    pub differing: u64,
    /// Subpixels (channels of pixels) that differ, of 3 per pixel.
    pub wrong_subpixels: u64,
    /// Largest difference of a channel, LSB.
    pub worst: u8,
    /// Pixels whose largest difference is above 1 LSB.
    pub over_one: u64,
    /// Pixels whose largest difference is above [`OUTLIER_LSB`].
    pub over_eight: u64,
    /// Pixels that are the background in one picture and not in the other; 0 where no background was given.
    pub coverage: u64,
    /// Pixels that are counted in `over_eight`, `coverage` or both.
    pub outliers: u64,
    /// Peak signal-to-noise ratio over all channels, dB, with 255 as the peak; infinite for equal pictures.
    pub psnr: f64,
    /// Mean structural similarity of luma; at most 1, and 1 for equal pictures.
    pub ssim: f64,
}

impl Comparison {
    /// Measures two pictures. `background` is the colour of pixels that nothing covered.
    ///
    /// # Errors
    /// If the pictures differ in size or have no pixels.
    pub fn new(
        expected: &RgbImage,
        actual: &RgbImage,
        background: Option<Rgb<u8>>,
    ) -> Result<Self, MetricError> {
        let (expected_width, expected_height) = expected.dimensions();
        let (actual_width, actual_height) = actual.dimensions();
        if expected.dimensions() != actual.dimensions() {
            return Err(MetricError::Sizes {
                expected_width,
                expected_height,
                actual_width,
                actual_height,
            });
        }
        let mut out = Self {
            pixels: u64::from(expected_width) * u64::from(expected_height),
            differing: 0,
            wrong_subpixels: 0,
            worst: 0,
            over_one: 0,
            over_eight: 0,
            coverage: 0,
            outliers: 0,
            psnr: f64::INFINITY,
            ssim: ssim::mean(expected, actual),
        };
        if out.pixels == 0 {
            return Err(MetricError::Empty);
        }
        let mut squares = 0u64;
        for (a, b) in expected.pixels().zip(actual.pixels()) {
            let mut worst = 0;
            for (&a, &b) in a.0.iter().zip(&b.0) {
                let difference = a.abs_diff(b);
                squares += u64::from(difference) * u64::from(difference);
                out.wrong_subpixels += u64::from(difference > 0);
                worst = worst.max(difference);
            }
            let far = worst > OUTLIER_LSB;
            let uncovered = background.is_some_and(|colour| (*a == colour) != (*b == colour));
            out.worst = out.worst.max(worst);
            out.differing += u64::from(worst > 0);
            out.over_one += u64::from(worst > 1);
            out.over_eight += u64::from(far);
            out.coverage += u64::from(uncovered);
            out.outliers += u64::from(far || uncovered);
        }
        if squares > 0 {
            let mean = squares as f64 / (3 * out.pixels) as f64;
            out.psnr = 10.0 * (255.0 * 255.0 / mean).log10();
        }
        Ok(out)
    }

    /// Fraction of pixels that differ, 0 to 1.
    pub fn differing_fraction(&self) -> f64 {
        self.differing as f64 / self.pixels as f64
    }

    /// Subpixels that differ, in per cent.
    pub fn wrong_subpixels_percent(&self) -> f64 {
        100.0 * self.wrong_subpixels as f64 / (3 * self.pixels) as f64
    }

    /// True when the pictures are the same, bit by bit.
    pub fn is_equal(&self) -> bool {
        self.differing == 0
    }
}

/// Pixels where any channel differs by more than `threshold` LSB. Pixels outside one of the pictures count.
pub fn pixels_over(expected: &RgbImage, actual: &RgbImage, threshold: u8) -> u64 {
    let (width, height) = union(expected, actual);
    let mut over = 0;
    for y in 0..height {
        for x in 0..width {
            over += match (
                expected.get_pixel_checked(x, y),
                actual.get_pixel_checked(x, y),
            ) {
                (Some(a), Some(b)) => u64::from(
                    a.0.iter()
                        .zip(&b.0)
                        .any(|(a, b)| a.abs_diff(*b) > threshold),
                ),
                _ => 1,
            };
        }
    }
    over
}

/// The picture for a failed test: expected, difference and actual from left to right, with 4 grey columns between.
///
/// Differences are amplified so that 1 LSB can be seen: 64 + 16 · |difference|, at most 255, and 0 where there is none.
/// Pictures of different sizes are aligned at the top left; pixels that one of them lacks are magenta in the difference.
pub fn triptych(expected: &RgbImage, actual: &RgbImage) -> RgbImage {
    const GAP: u32 = 4;
    const GREY: Rgb<u8> = Rgb([128; 3]);
    let (width, height) = union(expected, actual);
    let amplify = |a: u8, b: u8| match a.abs_diff(b) {
        0 => 0,
        difference => difference.saturating_mul(16).saturating_add(64),
    };
    let pitch = width.saturating_add(GAP);
    RgbImage::from_fn(
        pitch.saturating_mul(3).saturating_sub(GAP),
        height,
        |x, y| {
            let (panel, x) = (x / pitch, x % pitch);
            if x >= width {
                return GREY;
            }
            let (a, b) = (
                expected.get_pixel_checked(x, y),
                actual.get_pixel_checked(x, y),
            );
            match (panel, a, b) {
                (0, Some(&a), _) => a,
                (1, Some(&Rgb([ar, ag, ab])), Some(&Rgb([br, bg, bb]))) => {
                    Rgb([amplify(ar, br), amplify(ag, bg), amplify(ab, bb)])
                }
                (1, _, _) => Rgb([255, 0, 255]),
                (2, _, Some(&b)) => b,
                _ => GREY,
            }
        },
    )
}

fn union(a: &RgbImage, b: &RgbImage) -> (u32, u32) {
    (a.width().max(b.width()), a.height().max(b.height()))
}
