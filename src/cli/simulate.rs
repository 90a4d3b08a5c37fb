//! `manyview simulate`
#![forbid(unsafe_code)]

use super::{Outcome, save};
use clap::Args;
use image::{DynamicImage, ImageFormat, RgbImage};
use indicatif::{ProgressBar, ProgressStyle};
use manyview::config::{Config, OptionId, Settings};
use manyview::display::{Facts, MM_PER_INCH};
use manyview::launch::writable;
use manyview::simulate::{Eye, Optics, Setup, SimulateError, see, strip};
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

/// Pixels per inch of a panel without a description; it matters only where the eye is not at the design distance.
const DPI: f64 = 96.0;

/// Cone of a panel without a description, degrees.
const CONE: f64 = 40.0;

/// Crosstalk of a good lens sheet.
const CROSSTALK: f64 = 0.05;

/// Largest distance of an eye, mm: larger than any room.
const FARTHEST: f64 = 1e6;

#[derive(Args)]
pub(crate) struct Arguments {
    /// Panel: a built-in name (see `manyview displays`) or a panel file [default: huebner8]
    #[arg(long, value_name = "NAME|FILE")]
    display: Option<String>,
    /// Number of views in the picture, 1 to 256 [default: the panel's own]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    views: Option<String>,
    /// Where the eye is, in mm from the middle of the panel: to the right, upwards, towards the viewer
    #[arg(long, value_name = "X,Y,Z[mm]", allow_hyphen_values = true)]
    eye: String,
    /// What the panel shows: PNG of the panel's size, as `manyview capture` writes it
    #[arg(long = "in", value_name = "PATH")]
    panel: PathBuf,
    /// File to write: what the eye sees, PNG of the panel's size
    #[arg(long, value_name = "PATH")]
    out: PathBuf,
    /// N eyes side by side across the viewing zone around the eye, the left one first; made smaller to at most 8192 pixels
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    strip: Option<String>,
    /// Share of the light that comes from the views beside the right one, 0 to 1 [default: 0.05]
    #[arg(long, value_name = "F", allow_hyphen_values = true)]
    crosstalk: Option<String>,
    /// Angle of the viewing zone in degrees [default: that of the panel, else 40]
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    cone: Option<String>,
    /// Pixels per inch [default: those of the panel, else 96]
    #[arg(long, value_name = "F", allow_hyphen_values = true)]
    dpi: Option<String>,
    /// Width of the panel, in place of --dpi
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    width: Option<String>,
    /// Distance of the eye that the panel is made for [default: that of the eye]
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    design: Option<String>,
}

pub(crate) fn run(arguments: &Arguments) -> Outcome {
    let mut settings = Settings::default();
    settings.give([
        (OptionId::Display, &arguments.display),
        (OptionId::Views, &arguments.views),
    ]);
    let config = Config::from_settings(&settings)?;
    let eye = eye(&arguments.eye)?;
    let eyes = arguments.strip.as_deref().map(eyes).transpose()?;
    writable("what the eye sees", &arguments.out)?;
    let panel = picture(&arguments.panel)?;
    let setup = setup(arguments, &config.display.facts, panel.width())?;
    let optics = Optics::of(&config.display, config.views)?;
    let bar = bar(u64::from(panel.height()) * u64::from(eyes.unwrap_or(1)));
    let row_done = || bar.inc(1);
    let seen = match eyes {
        Some(eyes) => strip(&panel, &optics, &setup, eye, eyes, &row_done),
        None => see(&panel, &optics, &setup, eye, &row_done),
    };
    bar.finish_and_clear();
    save(&seen?, &arguments.out)
}

fn setup(arguments: &Arguments, facts: &Facts, pixels: u32) -> Result<Setup, SimulateError> {
    let lengths = f64::MIN_POSITIVE..=FARTHEST;
    let dpi = option(
        "dpi",
        &arguments.dpi,
        1.0..=1e4,
        "1 to 10000 pixels per inch",
    )?;
    let width = option(
        "width",
        &arguments.width,
        1.0..=FARTHEST,
        "the width in mm, 1 to 1000000",
    )?;
    if let (Some(_), Some(found)) = (dpi, &arguments.width) {
        return Err(SimulateError::Option {
            flag: "width",
            found: found.clone(),
            expected: "either --width or --dpi, as each follows from the other",
        });
    }
    let pixel = match width {
        Some(width) => width / f64::from(pixels),
        None => MM_PER_INCH / dpi.or(facts.dpi).unwrap_or(DPI),
    };
    let cone = option(
        "cone",
        &arguments.cone,
        1.0..=170.0,
        "an angle of 1 to 170 degrees",
    )?;
    let crosstalk = option(
        "crosstalk",
        &arguments.crosstalk,
        0.0..=1.0,
        "a share from 0 to 1",
    )?;
    let design = option(
        "design",
        &arguments.design,
        lengths,
        "a distance above 0 in mm",
    )?;
    Ok(Setup {
        pixel,
        cone: cone.or(facts.cone).unwrap_or(CONE),
        crosstalk: crosstalk.unwrap_or(CROSSTALK),
        design,
    })
}

fn option(
    flag: &'static str,
    text: &Option<String>,
    range: RangeInclusive<f64>,
    expected: &'static str,
) -> Result<Option<f64>, SimulateError> {
    let Some(found) = text else { return Ok(None) };
    match found.trim().parse() {
        Ok(value) if range.contains(&value) => Ok(Some(value)),
        _ => Err(SimulateError::Option {
            flag,
            found: found.clone(),
            expected,
        }),
    }
}

fn eyes(text: &str) -> Result<u32, SimulateError> {
    text.parse().map_err(|_| SimulateError::Option {
        flag: "strip",
        found: text.to_owned(),
        expected: "a whole number of eyes, 1 to 256",
    })
}

fn eye(text: &str) -> Result<Eye, SimulateError> {
    let lengths = text.trim().trim_end_matches("mm").split(',').map(|length| {
        let length = length.trim().parse().ok();
        length.filter(|length: &f64| length.abs() <= FARTHEST)
    });
    match lengths.collect::<Option<Vec<_>>>().as_deref() {
        Some(&[x, y, z]) => Ok(Eye { x, y, z }),
        _ => Err(SimulateError::Option {
            flag: "eye",
            found: text.to_owned(),
            expected: "X,Y,Z in mm from the middle of the panel, such as -32,0,600",
        }),
    }
}

fn picture(path: &Path) -> Result<RgbImage, SimulateError> {
    let refused = |reason: String| SimulateError::Picture {
        file: path.display().to_string(),
        reason,
    };
    let bytes = std::fs::read(path)
        .map_err(|error| refused(format!("{error}; give the PNG that the panel shows")))?;
    let picture = image::load_from_memory_with_format(&bytes, ImageFormat::Png)
        .map_err(|error| refused(format!("{error}; give an 8-bit PNG of the panel's size")))?;
    match picture {
        DynamicImage::ImageRgb8(_)
        | DynamicImage::ImageRgba8(_)
        | DynamicImage::ImageLuma8(_)
        | DynamicImage::ImageLumaA8(_) => Ok(picture.into_rgb8()),
        _ => Err(refused(
            "it has 16 bits per channel as a mask has; give the 8-bit picture that the panel shows"
                .to_owned(),
        )),
    }
}

/// A progress bar on stderr, hidden when that is no terminal.
fn bar(rows: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{spinner} {wide_bar} {pos}/{len} rows  {eta}");
    ProgressBar::new(rows).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

#[cfg(test)]
mod tests {
    use super::{Eye, eye};

    #[test]
    fn eyes_are_three_lengths() {
        let there = Eye {
            x: -32.5,
            y: 0.0,
            z: 600.0,
        };
        for text in ["-32.5,0,600", "-32.5,0,600mm", " -32.5, 0, 600 mm "] {
            assert_eq!(eye(text).ok(), Some(there), "{text}");
        }
        for wrong in [
            "",
            "1,2",
            "1,2,3,4",
            "1,2,x",
            "1,2,nan",
            "1,2,inf",
            "1 2 3",
            "1mm,2mm,3m",
        ] {
            assert!(eye(wrong).is_err(), "{wrong}");
        }
    }
}
