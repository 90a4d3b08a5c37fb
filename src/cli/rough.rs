//! `manyview calibrate fit` for a panel whose pitch is not known: photos of gratings tell it well enough for the pattern of the fit.
#![forbid(unsafe_code)]

use super::sheet::SheetArguments;
use super::{Outcome, print, tell};
use manyview::calibrate::{Beats, CalibrateError, Photo, Rough, rough, units};
use manyview::display::{MM_PER_INCH, SubpixelOrder};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Says what the gratings are for, where they are made or shown.
pub(super) fn gratings(sheet: &SheetArguments) {
    if sheet.views.is_some() {
        tell(
            &"--views has no effect on the picture of gratings; give it to `manyview calibrate fit`",
        );
    }
    tell(
        &"without --pitch and --display this is the picture of gratings: one photo of it, from straight before the panel, tells pitch and slant to `manyview calibrate fit --size WxH --out rough.toml PHOTO`",
    );
}

/// A panel of which only the size is known.
pub(super) struct Unknown<'a> {
    /// Pixels.
    pub size: (u32, u32),
    /// Side of a pixel in mm, where it is known.
    pub pixel: Option<f64>,
    /// As asked for; else as many as a lens has subpixels.
    pub views: Option<u32>,
    /// Focal length of the camera in mm for film of 36x24 mm.
    pub focal: Option<f64>,
    pub photos: &'a [PathBuf],
    /// Display file to write.
    pub out: &'a Path,
}

/// Measures pitch and slant, writes them as a display, and says what comes next.
pub(super) fn fit(unknown: &Unknown) -> Outcome {
    let beats = unknown.photos.iter().map(|path| {
        let photo = Photo::load_fine(path)?.with_equivalent(unknown.focal);
        Beats::new(&photo, unknown.size)
    });
    let beats: Vec<Beats> = beats.collect::<Result<_, CalibrateError>>()?;
    let found = rough(&beats)?;
    print(&report(&found, unknown.pixel))?;
    let views = unknown.views.unwrap_or_else(|| found.views());
    if unknown.views.is_none() {
        tell(&format_args!(
            "{views} views, as many as a lens has subpixels; give --views for another number"
        ));
    }
    let name = unknown.out.file_stem().unwrap_or_default();
    found.write(views, &name.to_string_lossy(), unknown.out)?;
    let (file, (width, height)) = (unknown.out.display(), unknown.size);
    tell(&format_args!(
        "wrote {file}; it shows no views yet: show the pattern by `manyview calibrate show --display {file} --photos --size {width}x{height}`, take three photos, and fit them with `--display {file}`"
    ));
    Ok(ExitCode::SUCCESS)
}

/// The measurement as text.
fn report(found: &Rough, pixel: Option<f64>) -> String {
    let order = match found.order {
        SubpixelOrder::Rgb => "rgb",
        SubpixelOrder::Bgr => "bgr",
    };
    let lens = pixel.map_or_else(String::new, |pixel| {
        let mm = units::across(found.pitch, found.slant, pixel);
        format!(
            ", lenses {mm:.4} mm wide, {:.2} in an inch",
            MM_PER_INCH / mm
        )
    });
    format!(
        "pitch      {:.3} ± {:.3} subpixels{lens}\nslant      {:.4} ± {:.4} subpixels per row\ncolours    {order}, as measured\n",
        found.pitch,
        found.pitch * found.pitch_spread,
        found.slant,
        found.slant_spread
    )
}
