//! The values that are known before the first photo.
#![forbid(unsafe_code)]

use super::CalibrateError;
use crate::display::SubpixelOrder;
use std::ops::RangeInclusive;

/// A length or angle that is known to a factor: its value and the standard deviation of its logarithm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guess {
    /// The most likely value.
    pub value: f64,
    /// Standard deviation of the logarithm; 0.05 is "to about 5 %".
    pub spread: f64,
}

/// The panel as it is described, and the request.
#[derive(Clone, Debug, PartialEq)]
pub struct Setup {
    /// Width of the panel, pixels.
    pub width: u32,
    /// Height of the panel, pixels.
    pub height: u32,
    /// Number of views.
    pub views: u32,
    /// Nominal pitch, subpixels from lens to lens along a row; right to about 1 %.
    pub pitch: f64,
    /// Nominal slant, subpixels per row; right to about 0.02.
    pub slant: f64,
    /// Which colour is leftmost in a pixel.
    pub order: SubpixelOrder,
    /// Views descend with the phase, as behind a sheet of lenses; a photo cannot tell, so it is only written.
    pub inverted: bool,
    /// The angle over which all views are seen once, in degrees. With the pitch it gives the gap between lenses and
    /// pixels.
    pub cone: Guess,
    /// Distance of the camera from the panel in the first photo, panel pixels.
    pub distance: Option<Guess>,
    /// Distance of the viewers from the face of the panel, panel pixels, for which the mask is written; None for that of the first photo, infinite for the sheet itself.
    pub viewer: Option<f64>,
    /// Measure where red, green and blue lie under the lenses.
    pub colours: bool,
    /// Measure a low-order error of the sheet.
    pub bias: bool,
}

impl Setup {
    /// Relative error of a distance that was measured with a tape.
    pub const TAPE: f64 = 0.01;
    /// Relative error of a cone from a data sheet.
    pub const DATA_SHEET: f64 = 0.05;

    /// Fewest and most views of a display.
    pub(super) const VIEWS: RangeInclusive<u32> = 2..=256;

    /// The assumed angle over which the views are seen: 40 degrees to a factor of about 1.4.
    pub const CONE: Guess = Guess {
        value: 40.0,
        spread: 0.35,
    };

    /// A setup from a size and a lens, with the rest unknown.
    #[must_use]
    pub fn new(width: u32, height: u32, views: u32, pitch: f64, slant: f64) -> Self {
        Self {
            width,
            height,
            views,
            pitch,
            slant,
            order: SubpixelOrder::Rgb,
            inverted: true,
            cone: Self::CONE,
            distance: None,
            viewer: None,
            colours: false,
            bias: false,
        }
    }

    /// Refuses panels for which no pattern can be made.
    pub fn check(&self) -> Result<(), CalibrateError> {
        check_size((self.width, self.height))?;
        check(&[
            (
                "the pitch",
                self.pitch,
                pitches(self.width),
                "at least 2 subpixels, and 60 lenses or more over the panel",
            ),
            (
                "the slant",
                self.slant,
                -3.0..=3.0,
                "-3 to 3 subpixels per row",
            ),
            (
                "the number of views",
                f64::from(self.views),
                f64::from(*Self::VIEWS.start())..=f64::from(*Self::VIEWS.end()),
                "2 to 256",
            ),
            ("the cone", self.cone.value, 5.0..=120.0, "5 to 120 degrees"),
        ])
    }

    /// The gap between pixels and lenses in panel pixels: a pitch fills the cone.
    pub(super) fn gap(&self) -> Guess {
        Guess {
            value: self.pitch / 3.0 / (2.0 * (self.cone.value.to_radians() / 2.0).tan()),
            spread: self.cone.spread,
        }
    }
}

/// What is wrong, its value, the bounds, and what to give.
type Rule = (&'static str, f64, RangeInclusive<f64>, &'static str);

fn check(rules: &[Rule]) -> Result<(), CalibrateError> {
    match rules
        .iter()
        .find(|(_, value, bounds, _)| !bounds.contains(value))
    {
        Some(&(field, value, _, expected)) => Err(CalibrateError::Setup {
            field,
            value,
            expected,
        }),
        None => Ok(()),
    }
}

/// Pitches that can be measured on a panel of this width in pixels, subpixels.
pub(super) fn pitches(width: u32) -> RangeInclusive<f64> {
    2.0..=f64::from(width) / 20.0
}

/// Refuses sizes of panels for which no pattern can be made.
pub(super) fn check_size((width, height): (u32, u32)) -> Result<(), CalibrateError> {
    let bounds = || 200.0..=32768.0;
    let expected = "200 to 32768 pixels";
    check(&[
        (
            "the width of the panel",
            f64::from(width),
            bounds(),
            expected,
        ),
        (
            "the height of the panel",
            f64::from(height),
            bounds(),
            expected,
        ),
    ])
}
