//! `manyview calibrate fit` for a panel whose pitch is not known: photos of gratings tell it well enough for the pattern of the fit.
#![forbid(unsafe_code)]

use super::sheet::SheetArguments;
use super::{Outcome, print, tell};
use indicatif::{ProgressBar, ProgressStyle};
use manyview::calibrate::{Beats, CalibrateError, Guess, Photo, Rough, Setup, rough, units};
use manyview::display::{MM_PER_INCH, SubpixelOrder};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Says what the gratings are for, where they are made or shown.
pub(super) fn gratings(sheet: &SheetArguments, (width, height): (u32, u32)) {
    let idle = [
        ("--views", sheet.views.is_some()),
        ("--screen-mm", sheet.screen_mm.is_some()),
        ("--dpi", sheet.dpi.is_some()),
    ];
    for (option, _) in idle.iter().filter(|(_, given)| *given) {
        tell(&format_args!(
            "{option} has no effect on the picture of gratings; give it to `manyview calibrate fit`"
        ));
    }
    tell(&format_args!(
        "without --pitch and --display this is the picture of gratings: one photo of it, straight from the front, tells pitch and slant to `manyview calibrate fit --size {width}x{height} --out rough.toml PHOTO`"
    ));
}

/// A panel of which only the size is known.
pub(super) struct Unknown<'a> {
    /// Pixels.
    pub size: (u32, u32),
    /// Side of a pixel in mm, where it is known.
    pub pixel: Option<f64>,
    /// As asked for; else as many as a lens has subpixels.
    pub views: Option<u32>,
    /// Angle over which the views are seen once, degrees.
    pub cone: Guess,
    /// Focal length of the camera in mm for film of 36x24 mm.
    pub focal: Option<f64>,
    pub photos: &'a [PathBuf],
    /// Display file to write.
    pub out: &'a Path,
}

/// Measures pitch and slant, writes them as a display, and says what comes next. Of several photos the one that tells most is used.
pub(super) fn fit(unknown: &Unknown) -> Outcome {
    let (width, height) = unknown.size;
    // What is given is wrong before anything is measured, or not at all.
    let mut given = Setup::new(width, height, unknown.views.unwrap_or(2), 3.0, 0.0);
    given.cone = unknown.cone;
    given.check()?;
    let bar = bar(unknown.photos.len() as u64);
    let measured = unknown.photos.iter().map(|path| {
        bar.set_message(path.display().to_string());
        let photo = Photo::load_fine(path)?.with_equivalent(unknown.focal);
        let found = rough(&Beats::new(&photo, unknown.size)?, unknown.cone);
        bar.inc(1);
        found
    });
    let measured: Vec<Result<Rough, CalibrateError>> = measured.collect();
    bar.finish_and_clear();
    let (found, failed): (Vec<_>, Vec<_>) = measured.into_iter().partition(Result::is_ok);
    let failed = failed.into_iter().filter_map(Result::err);
    let found = found.into_iter().filter_map(Result::ok);
    let best = found.min_by(|a, b| a.pitch_spread.total_cmp(&b.pitch_spread));
    let Some(found) = best else {
        return Err(failed
            .into_iter()
            .next()
            .unwrap_or(CalibrateError::NoPhoto)
            .into());
    };
    failed.for_each(|error| tell(&format_args!("left out: {error}")));
    print(&report(&found, unknown.pixel))?;
    let views = unknown.views.unwrap_or_else(|| found.views());
    if unknown.views.is_none() {
        tell(&format_args!(
            "{views} views, as many as a lens has subpixels; give --views for another number"
        ));
    }
    let name = unknown.out.file_stem().unwrap_or_default();
    found.write(views, &name.to_string_lossy(), unknown.out)?;
    let file = unknown.out.display();
    tell(&format_args!(
        "wrote {file}; its offset is not measured yet: show the pattern by `manyview calibrate show --display {file} --photos --size {width}x{height}`, take three photos, and fit them with `--display {file}`"
    ));
    Ok(ExitCode::SUCCESS)
}

/// The measurement as text.
fn report(found: &Rough, pixel: Option<f64>) -> String {
    let order = match found.order {
        SubpixelOrder::Rgb => "rgb, as measured",
        SubpixelOrder::Bgr => "bgr, as measured",
    };
    let lens = pixel.map_or_else(String::new, |pixel| {
        let mm = units::across(found.pitch, found.slant, pixel);
        format!(
            ", lenses {mm:.4} mm wide, {:.2} in an inch",
            MM_PER_INCH / mm
        )
    });
    format!(
        "pitch      {:.3} ± {:.3} subpixels{lens}\nslant      {:.4} ± {:.4} subpixels per row\ncolours    {order}\n",
        found.pitch,
        found.pitch * found.pitch_spread,
        found.slant,
        found.slant_spread
    )
}

/// A progress bar on stderr, hidden when that is no terminal.
pub(super) fn bar(photos: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{spinner} {wide_bar} {pos}/{len} photos  {msg}");
    ProgressBar::new(photos).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
