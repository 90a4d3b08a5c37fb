//! `manyview calibrate show`
#![forbid(unsafe_code)]

use super::error::CommandError;
use super::sheet::SheetArguments;
use super::{Outcome, mask, print, rough, tell};
use clap::Args;
use image::RgbImage;
use manyview::calibrate::{self, Action, ByEye, CalibrateError, KEYS, action};
use manyview::display::LensPart;
use manyview::launch::writable;
use manyview::window::{Event, Window};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const TITLE: &str = "manyview calibrate";

#[derive(Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    sheet: SheetArguments,
    /// Size of the panel in pixels [default: that of its file, else the monitor's]
    #[arg(long, value_name = "WxH")]
    size: Option<String>,
    /// The monitor that is the panel, by name or number [default: the one of the panel's size, else the primary one]
    #[arg(long, value_name = "NAME|INDEX", allow_hyphen_values = true)]
    monitor: Option<String>,
    /// With --display: show the pattern that photos are taken of
    #[arg(long, requires = "display", conflicts_with = "out")]
    photos: bool,
    /// With --display: fit pitch, slant and offset by eye, and write the display file here
    #[arg(long, value_name = "FILE.toml", requires = "display")]
    out: Option<PathBuf>,
}

pub(crate) fn run(arguments: &Arguments) -> Outcome {
    let asked = arguments.size.as_ref();
    let asked = asked.map(|text| mask::size(text).ok_or_else(|| CommandError::Size(text.clone())));
    let asked = asked.transpose()?;
    let sheet = arguments.sheet.display()?;
    if sheet.is_some() && arguments.out.is_none() && !arguments.photos {
        return Err(CalibrateError::NoOut.into());
    }
    if let Some(out) = &arguments.out {
        writable("the display file", out)?;
    }
    let panel = asked.or(sheet.as_ref().and_then(|sheet| sheet.facts.screen));
    let mut window = Window::open(TITLE, arguments.monitor.as_deref(), panel)?;
    let size = panel.unwrap_or(window.monitor().size);
    window.monitor().check(size)?;
    match &arguments.out {
        Some(out) if let Some(mut fit) = sheet.and_then(|sheet| ByEye::new(sheet, size)) => {
            by_eye(&mut window, &mut fit, size, out)
        }
        _ => {
            let picture = match arguments.sheet.setup(size)? {
                Some(setup) => calibrate::pattern(&setup)?,
                None => {
                    rough::gratings(&arguments.sheet, size);
                    calibrate::rough_pattern(size)?
                }
            };
            photos(&mut window, &picture)
        }
    }
}

/// Shows the pattern that photos are taken of.
fn photos(window: &mut Window, picture: &RgbImage) -> Outcome {
    window.show(picture)?;
    told(window, picture.dimensions());
    tell(&"Escape or q ends");
    loop {
        match window.wait()? {
            Event::Key(key, _) if action(key) != Some(Action::Leave) => {}
            _ => return Ok(ExitCode::SUCCESS),
        }
    }
}

fn by_eye(window: &mut Window, fit: &mut ByEye, size: (u32, u32), out: &Path) -> Outcome {
    show(window, fit)?;
    told(window, size);
    tell(&keys(fit));
    loop {
        print(&format!("{fit}\n"))?;
        let (action, large) = loop {
            match window.wait()? {
                Event::Key(key, shift) => {
                    if let Some(action) = action(key) {
                        break (action, shift);
                    }
                }
                Event::Close => break (Action::Leave, false),
            }
        };
        match action {
            Action::Leave => return Ok(ExitCode::SUCCESS),
            Action::Save => {
                fit.write(out)?;
                tell(&format_args!("wrote {}", out.display()));
            }
            action => match fit.act(action, large) {
                Ok(()) => show(window, fit)?,
                Err(error) => tell(&error),
            },
        }
    }
}

fn show(window: &mut Window, fit: &ByEye) -> Result<(), CommandError> {
    Ok(window.show(&fit.picture()?)?)
}

/// Prints the place of the picture.
fn told(window: &Window, (width, height): (u32, u32)) {
    let monitor = window.monitor();
    let (across, down) = monitor.size;
    let place = if monitor.size == (width, height) {
        "the whole monitor".to_owned()
    } else {
        format!("the left top corner of {across}x{down}")
    };
    tell(&format_args!(
        "{width}x{height} pixels on monitor {}, {place}",
        monitor.name
    ));
}

/// The keys, a line for each pair.
fn keys(fit: &ByEye) -> String {
    let named = |wanted: Action| {
        let names = KEYS.iter().filter(|(.., action)| *action == wanted);
        names
            .map(|(_, name, _)| *name)
            .collect::<Vec<_>>()
            .join(", ")
    };
    let mut text = String::from("keys, with Shift ten steps at once:");
    // Writing to a String cannot fail.
    for part in LensPart::ALL {
        let (up, down) = (
            named(Action::Nudge(part, true)),
            named(Action::Nudge(part, false)),
        );
        let (name, step) = (part.name(), fit.step(part));
        let _ = write!(text, "\n  {up}, {down}: {name} by {step}");
    }
    for (action, what) in [
        (Action::White, "one view white, all others black"),
        (Action::NextView, "the next view is the white one"),
        (Action::Halves, "left views red, right views blue"),
        (Action::Invert, "views run the other way"),
        (Action::Save, "write the display file"),
        (Action::Leave, "end"),
    ] {
        let _ = write!(text, "\n  {}: {what}", named(action));
    }
    text
}
