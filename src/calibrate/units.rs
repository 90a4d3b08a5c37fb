//! Pitch and slant in the units of data sheets.
#![forbid(unsafe_code)]

use super::CalibrateError;
use crate::display::{MM_PER_INCH, Number};

/// The slant in subpixels per row: a number or fraction of them, or the angle between the lenses and the columns of pixels, such as `9.46deg`.
pub fn slant(text: &str) -> Result<f64, CalibrateError> {
    let text = text.trim();
    let angle = ["deg", "°"].iter().find_map(|unit| text.strip_suffix(unit));
    let found = match angle {
        // A row is as high as three subpixels are wide.
        Some(angle) => number(angle)
            .filter(|degrees| degrees.abs() < 80.0)
            .map(|degrees| 3.0 * degrees.to_radians().tan()),
        None => number(text),
    };
    found.ok_or_else(|| CalibrateError::Slant {
        text: text.to_owned(),
    })
}

/// The pitch in subpixels along a row: a number or fraction of them, or as data sheets have it at a right angle to the lenses: `0.286mm` or
/// `60lpi`, lenses per inch. For these, `pixel` is the side of a pixel in mm.
pub fn pitch(text: &str, slant: f64, pixel: Option<f64>) -> Result<f64, CalibrateError> {
    let text = text.trim();
    let across = match (text.strip_suffix("mm"), text.strip_suffix("lpi")) {
        (Some(mm), _) => number(mm),
        (_, Some(lpi)) => number(lpi).map(|lpi| MM_PER_INCH / lpi),
        _ => {
            return number(text).ok_or_else(|| CalibrateError::Pitch {
                text: text.to_owned(),
            });
        }
    };
    let across = across
        .filter(|mm| mm.is_finite() && *mm > 0.0)
        .ok_or_else(|| CalibrateError::Pitch {
            text: text.to_owned(),
        })?;
    let pixel = pixel.ok_or(CalibrateError::NoScreenSize { option: "--pitch" })?;
    let along = across * (1.0f64).hypot(slant / 3.0);
    Ok(along / (pixel / 3.0))
}

/// The width of a lens at a right angle to it, mm, of a pitch in subpixels along a row; the reverse of [`pitch`].
#[must_use]
pub fn across(pitch: f64, slant: f64, pixel: f64) -> f64 {
    pitch * pixel / 3.0 / (1.0f64).hypot(slant / 3.0)
}

fn number(text: &str) -> Option<f64> {
    Number::parse(text).map(Number::to_f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_of_data_sheets_are_understood() {
        assert_eq!(slant("2/3").unwrap(), 2.0 / 3.0);
        assert_eq!(slant("-0.5").unwrap(), -0.5);
        let third = (1.0f64 / 3.0).atan().to_degrees();
        assert!((slant(&format!("{third}deg")).unwrap() - 1.0).abs() < 1e-12);
        assert!((slant("-45°").unwrap() + 3.0).abs() < 1e-12);
        assert_eq!(pitch("16/3", 1.0, None).unwrap(), 16.0 / 3.0);
        // Upright lenses: 0.3 mm on pixels of 0.1 mm are nine subpixels; slanted ones are wider along a row.
        assert!((pitch("0.3 mm", 0.0, Some(0.1)).unwrap() - 9.0).abs() < 1e-12);
        assert!((pitch("0.3mm", 3.0, Some(0.1)).unwrap() - 9.0 * 2.0f64.sqrt()).abs() < 1e-12);
        assert!((pitch("84.667lpi", 0.0, Some(0.1)).unwrap() - 9.0).abs() < 1e-4);
        assert!((across(9.0 * 2.0f64.sqrt(), 3.0, 0.1) - 0.3).abs() < 1e-12);
    }

    #[test]
    fn what_is_no_number_is_named() {
        for text in ["", "wide", "90deg", "1e3deg"] {
            let error = slant(text).unwrap_err().to_string();
            assert!(error.contains("--slant"), "{error}");
        }
        for text in ["", "0mm", "-3lpi", "0lpi", "x mm"] {
            let error = pitch(text, 0.0, Some(0.1)).unwrap_err().to_string();
            assert!(error.contains("--pitch"), "{error}");
        }
        let error = pitch("0.3mm", 0.0, None).unwrap_err().to_string();
        assert!(error.contains("--dpi"), "{error}");
    }
}
