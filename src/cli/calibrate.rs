//! `manyview calibrate`
#![forbid(unsafe_code)]

use super::error::CommandError;
use super::sheet::SheetArguments;
use super::{Outcome, mask, print, rough, show, tell};
use clap::{Args, Subcommand};
use manyview::calibrate::{self, CalibrateError, Fit, Guess, Photo, Setup, Sighting};
use manyview::display::SubpixelOrder;
use manyview::launch::writable;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[derive(Args)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    step: Step,
}

#[derive(Subcommand)]
enum Step {
    /// Write the picture to show on the panel: full screen, unscaled, in a dark room.
    Pattern(PatternArguments),
    /// Show the pattern on the panel itself, or fit a panel by eye: a picture through its mask, and keys that nudge its numbers.
    Show(show::Arguments),
    /// Measure the panel from photos of the pattern and write its display file.
    ///
    /// Without --pitch and --display the pattern is of gratings, and one photo of it tells these.
    ///
    /// Take the first photo straight from the front, and one or two more from about 10 degrees to the sides and from other
    /// distances, with one camera, without zoom, with the whole panel in the photo.
    Fit(FitArguments),
}

#[derive(Args)]
struct PanelArguments {
    #[command(flatten)]
    sheet: SheetArguments,
    /// Size of the panel in pixels
    #[arg(long, value_name = "WxH")]
    size: String,
}

#[derive(Args)]
struct PatternArguments {
    #[command(flatten)]
    panel: PanelArguments,
    /// PNG to write
    #[arg(long, value_name = "PATH")]
    out: PathBuf,
}

#[derive(Args)]
struct FitArguments {
    #[command(flatten)]
    panel: PanelArguments,
    #[command(flatten)]
    setup: SetupArguments,
    /// Measure where red, green and blue lie under the lenses as well
    #[arg(long)]
    colours: bool,
    /// Measure a map of the sheet's low-order errors as well
    #[arg(long)]
    bias: bool,
    /// Write the display file even if the fit is doubtful
    #[arg(long)]
    doubtful: bool,
    /// Display file to write
    #[arg(long, value_name = "FILE.toml")]
    out: PathBuf,
    /// Picture of the fit to write, PNG
    #[arg(long, value_name = "PATH")]
    picture: Option<PathBuf>,
    /// Photos, JPEG, PNG or HEIC, that from where the viewers sit first; of more than six the most different are used, and of the gratings the one
    /// that tells most
    #[arg(required = true, value_name = "PHOTO")]
    photos: Vec<PathBuf>,
}

// Measurements beside the photos.
#[derive(Args)]
struct SetupArguments {
    /// Distance of the camera from the panel in the first photo, in mm, if it was measured
    #[arg(long, value_name = "MM")]
    distance: Option<f64>,
    /// Write the mask for viewers at this distance in mm [default: where the first photo was taken]
    #[arg(long, value_name = "MM")]
    viewer: Option<f64>,
    /// Angle over which the views are seen once, in degrees, from the data sheet [default: about 40]
    #[arg(long, value_name = "DEGREES")]
    cone: Option<f64>,
    /// Focal length of the camera in mm for film of 36x24 mm [default: what the photos say]
    #[arg(long, value_name = "MM")]
    focal: Option<f64>,
}

pub(crate) fn run(arguments: &Arguments) -> Outcome {
    match &arguments.step {
        Step::Pattern(arguments) => pattern(arguments),
        Step::Show(arguments) => show::run(arguments),
        Step::Fit(arguments) => fit(arguments),
    }
}

fn pattern(arguments: &PatternArguments) -> Outcome {
    let size = arguments.panel.size()?;
    let setup = arguments.panel.sheet.setup(size)?;
    writable("the pattern", &arguments.out)?;
    let picture = match &setup {
        Some(setup) => calibrate::pattern(setup)?,
        None => {
            rough::gratings(&arguments.panel.sheet, size);
            calibrate::rough_pattern(size)?
        }
    };
    write_png("the pattern", &picture, &arguments.out)?;
    tell(&format_args!("wrote {}", arguments.out.display()));
    Ok(ExitCode::SUCCESS)
}

fn fit(arguments: &FitArguments) -> Outcome {
    let size = arguments.panel.size()?;
    let Some(mut setup) = arguments.panel.sheet.setup(size)? else {
        return unknown(arguments, size);
    };
    let pixel = arguments.panel.sheet.pixel_mm(size)?;
    let pixels = |option: &'static str, mm: Option<f64>| {
        let Some(mm) = mm else { return Ok(None) };
        let pixel = pixel.ok_or(CalibrateError::NoScreenSize { option })?;
        Ok::<_, CalibrateError>(Some(mm / pixel))
    };
    setup.distance = pixels("--distance", arguments.setup.distance)?.map(|value| Guess {
        value,
        spread: Setup::TAPE,
    });
    setup.viewer = pixels("--viewer", arguments.setup.viewer)?;
    setup.cone = cone(&arguments.setup);
    (setup.colours, setup.bias) = (arguments.colours, arguments.bias);
    writable("the display file", &arguments.out)?;
    if let Some(picture) = &arguments.picture {
        writable("the picture of the fit", picture)?;
    }
    let (paths, sightings) = sightings(arguments, &setup)?;
    let fit = calibrate::fit(&setup, &sightings)?;
    if let Some(path) = &arguments.picture {
        let photos = paths.iter().map(|path| photo(arguments, path));
        let photos: Vec<Photo> = photos.collect::<Result<_, _>>()?;
        let picture = fit.picture(&photos, &sightings, (setup.width, setup.height));
        write_png("the picture of the fit", &picture, path)?;
        tell(&format_args!("wrote {}", path.display()));
    }
    print(&report(&fit, &setup, pixel))?;
    if !fit.doubts.is_empty() {
        let doubtful = CalibrateError::Doubtful {
            reasons: fit.doubts.join("; "),
        };
        if !arguments.doubtful {
            return Err(doubtful.into());
        }
        tell(&doubtful);
    }
    let name = arguments.out.file_stem().unwrap_or_default();
    fit.write(&setup, &name.to_string_lossy(), &arguments.out)?;
    tell(&format_args!("wrote {}", arguments.out.display()));
    Ok(ExitCode::SUCCESS)
}

/// The angle over which the views are seen once.
fn cone(setup: &SetupArguments) -> Guess {
    setup.cone.map_or(Setup::CONE, |value| Guess {
        value,
        spread: Setup::DATA_SHEET,
    })
}

/// Finds out pitch and slant; options that are for the fit of the whole sheet are told.
fn unknown(arguments: &FitArguments, size: (u32, u32)) -> Outcome {
    let setup = &arguments.setup;
    let idle = [
        ("--distance", setup.distance.is_some()),
        ("--viewer", setup.viewer.is_some()),
        ("--colours", arguments.colours),
        ("--bias", arguments.bias),
        ("--doubtful", arguments.doubtful),
        ("--picture", arguments.picture.is_some()),
    ];
    for (option, _) in idle.iter().filter(|(_, given)| *given) {
        tell(&format_args!(
            "{option} has no effect without --pitch or --display, where pitch, slant and colours are measured"
        ));
    }
    writable("the display file", &arguments.out)?;
    rough::fit(&rough::Unknown {
        size,
        pixel: arguments.panel.sheet.pixel_mm(size)?,
        views: arguments.panel.sheet.views,
        cone: cone(setup),
        focal: setup.focal,
        photos: &arguments.photos,
        out: &arguments.out,
    })
}

/// A photo from a file, with the focal length that is given.
fn photo(arguments: &FitArguments, path: &Path) -> Result<Photo, CalibrateError> {
    Photo::load(path).map(|photo| photo.with_equivalent(arguments.setup.focal))
}

/// The photos that are used, and what is measured in each. Of many photos some may be spoilt: those are told and left out. A photo takes 50 MB, so
/// none stays in memory.
fn sightings(
    arguments: &FitArguments,
    setup: &Setup,
) -> Result<(Vec<PathBuf>, Vec<Sighting>), CommandError> {
    let many = arguments.photos.len() > calibrate::MOST;
    let bar = rough::bar(arguments.photos.len() as u64);
    let (mut paths, mut sightings) = (Vec::new(), Vec::new());
    for (number, path) in arguments.photos.iter().enumerate() {
        bar.set_message(path.display().to_string());
        match photo(arguments, path).and_then(|photo| Sighting::new(&photo, setup)) {
            Ok(sighting) => {
                sightings.push(sighting);
                paths.push(path.clone());
            }
            Err(error) if many && number > 0 => {
                bar.suspend(|| tell(&format_args!("left out: {error}")));
            }
            Err(error) => return Err(error.into()),
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    let (all, chosen) = (sightings.len(), calibrate::choose(&sightings));
    let seen = paths.into_iter().zip(sightings).enumerate();
    let used = seen.filter(|(index, _)| chosen.contains(index));
    let (paths, sightings): (Vec<_>, Vec<_>) = used.map(|(_, both)| both).unzip();
    if sightings.len() < all {
        let names: Vec<String> = paths.iter().map(|p| p.display().to_string()).collect();
        let (count, names) = (paths.len(), names.join(", "));
        tell(&format_args!("of {all} photos, {count} are used: {names}"));
    }
    Ok((paths, sightings))
}

impl PanelArguments {
    fn size(&self) -> Result<(u32, u32), CommandError> {
        mask::size(&self.size).ok_or_else(|| CommandError::Size(self.size.clone()))
    }
}

/// The measurement as text.
fn report(fit: &Fit, setup: &Setup, pixel: Option<f64>) -> String {
    let (scale, unit) = pixel.map_or((1.0, "px"), |pixel| (pixel, "mm"));
    let mut text = format!(
        "pitch      {:.6} subpixels\nslant      {:.6} subpixels per row\noffset     {:.4} subpixels\n\
         gap        {:.3} {unit}\n",
        fit.mask.pitch,
        fit.mask.slant,
        fit.mask.offset,
        fit.gap * scale
    );
    // Writing to a String cannot fail.
    if let Some((colours, deviations)) = &fit.colours {
        for ((name, value), deviation) in
            ["red", "green", "blue"].iter().zip(colours).zip(deviations)
        {
            let _ = writeln!(text, "{name:<10} {value:+.3} ± {deviation:.3} subpixels");
        }
    }
    if let Some(bias) = &fit.bias {
        for (i, row) in bias.chunks(3).enumerate() {
            let title = if i == 0 { "bias" } else { "" };
            let row: Vec<String> = row.iter().map(|value| format!("{value:+.3}")).collect();
            let _ = writeln!(text, "{title:<10} {} subpixels", row.join(" "));
        }
    }
    let order = match fit.order {
        SubpixelOrder::Rgb => "rgb",
        SubpixelOrder::Bgr => "bgr",
    };
    let told = match (fit.order_measured, fit.order == setup.order) {
        (true, true) => "as measured",
        (true, false) => "as measured, and not as given",
        (false, true) => "as given; the photos do not tell for certain",
        (false, false) => "not as given; the photos do not tell for certain",
    };
    let _ = writeln!(text, "colours    {order}, {told}");
    let _ = writeln!(
        text,
        "viewers    {:.0} {unit} before the panel, {:.2} of its width",
        fit.mask.viewer * scale,
        fit.mask.viewer / f64::from(setup.width)
    );
    for camera in &fit.cameras {
        let [x, y, z] = camera.eye.map(|way| way * scale);
        let contrast = 100.0 * camera.contrast;
        let _ = writeln!(
            text,
            "photo      {}: from {x:+.0} {y:+.0} {z:.0} {unit} (right, down, before the middle), contrast {contrast:.0} %",
            camera.name
        );
    }
    let residuals = fit.residuals;
    let _ = writeln!(
        text,
        "residuals  mean {:.4}, RMS {:.4}, largest {:.4} of {} views",
        residuals.mean, residuals.rms, residuals.max, setup.views
    );
    let _ = writeln!(
        text,
        "confidence ± {:.3} views over the panel, ± {:.3} at its worst place; {:.0} % of it may be off by half a view or more",
        fit.phase.mean,
        fit.phase.worst,
        100.0 * fit.phase.unsure
    );
    text
}

fn write_png(
    what: &'static str,
    picture: &image::RgbImage,
    path: &Path,
) -> Result<(), CalibrateError> {
    let written = picture.save_with_format(path, image::ImageFormat::Png);
    written.map_err(|error| CalibrateError::Write {
        what,
        file: path.display().to_string(),
        reason: error.to_string(),
    })
}
