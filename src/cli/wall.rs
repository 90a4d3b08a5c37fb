//! `manyview wall`
#![forbid(unsafe_code)]

use super::error::CommandError;
use super::{Outcome, print, tell};
use clap::{Args, Subcommand};
use indicatif::ProgressBar;
use manyview::config::replace;
use manyview::display::{Display, Kind, Wall};
use manyview::launch::writable;
use manyview::wall::{WallError, fit, pattern, written};
use manyview::window::{Event, Window};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

const TITLE: &str = "manyview wall";
/// Keysyms that end `show`: Escape and q.
const ENDS: [u32; 2] = [0xff1b, 0x71];

#[derive(Args)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    action: Action,
}

#[derive(Subcommand)]
enum Action {
    /// Show the pattern that photos are taken of, on all panels of a wall.
    Show {
        /// The description of the wall
        #[arg(long, value_name = "FILE.toml")]
        display: String,
    },
    /// Write the pattern of each panel as PNG: pattern-1.png and so on.
    Pattern {
        /// The description of the wall
        #[arg(long, value_name = "FILE.toml")]
        display: String,
        /// The folder to write to
        #[arg(long, value_name = "FOLDER")]
        out: PathBuf,
    },
    /// Measure places and brightness of the panels from photos of the pattern, and write the description with them.
    Fit {
        /// The description of the wall; its first panel stays where it is
        #[arg(long, value_name = "FILE.toml")]
        display: String,
        /// Photos from one place, each with the first panel and others in it
        #[arg(required = true, value_name = "PHOTO")]
        photos: Vec<PathBuf>,
        /// The description to write
        #[arg(long, value_name = "FILE.toml")]
        out: PathBuf,
    },
}

pub(crate) fn run(arguments: &Arguments) -> Outcome {
    match &arguments.action {
        Action::Show { display } => show(load(display)?.as_ref()),
        Action::Pattern { display, out } => patterns(load(display)?.as_ref(), out),
        Action::Fit {
            display,
            photos,
            out,
        } => measure(display, photos, out),
    }
}

fn load(name: &str) -> Result<Arc<Wall>, CommandError> {
    match Display::load(name)?.kind {
        Kind::Wall(wall) => Ok(wall),
        _ => Err(WallError::NoWall(name.to_owned()).into()),
    }
}

fn show(wall: &Wall) -> Outcome {
    let mut windows = Vec::new();
    for (number, panel) in wall.panels().iter().enumerate() {
        let mut window = Window::open(TITLE, Some(&panel.monitor), Some(panel.pixels))?;
        window.monitor().check(panel.pixels)?;
        window.show(&pattern(wall, number))?;
        windows.push(window);
    }
    tell(
        &"the pattern is shown; take photos from where the viewers will be, with all panels in them, and then press Escape or q here",
    );
    // The last one has the keyboard.
    if let Some(window) = windows.last_mut() {
        while let Event::Key(key, _) = window.wait()? {
            if ENDS.contains(&key) {
                break;
            }
        }
    }
    Ok(ExitCode::SUCCESS)
}

fn patterns(wall: &Wall, out: &Path) -> Outcome {
    for number in 0..wall.panels().len() {
        let file = out.join(format!("pattern-{}.png", number + 1));
        writable("the pattern", &file)?;
        let saved = pattern(wall, number).save_with_format(&file, image::ImageFormat::Png);
        saved.map_err(|error| WallError::Write {
            file: file.display().to_string(),
            reason: error.to_string(),
        })?;
        tell(&format_args!("wrote {}", file.display()));
    }
    Ok(ExitCode::SUCCESS)
}

fn measure(display: &str, photos: &[PathBuf], out: &Path) -> Outcome {
    let wall = load(display)?;
    writable("the description", out)?;
    let failed = |reason: String| WallError::Write {
        file: out.display().to_string(),
        reason,
    };
    let bar = ProgressBar::new(photos.len() as u64);
    let found = fit(&wall, photos, || bar.inc(1));
    bar.finish_and_clear();
    let found = found?;
    let text = std::fs::read_to_string(display).map_err(|error| failed(error.to_string()))?;
    let text = written(&text, &found);
    let text = text.ok_or_else(|| failed(format!("{display} has changed meanwhile")))?;
    replace(out, text.as_bytes()).map_err(|error| failed(error.to_string()))?;
    let mut said = String::new();
    for ((panel, tags), light) in wall.panels().iter().zip(&found.tags).zip(&found.light) {
        // Writing to a String cannot fail.
        let _ = writeln!(said, "{}  {tags} tags  light {:.3}", panel.monitor, light);
    }
    let _ = writeln!(
        said,
        "corners are {:.2} pixels of the photos off",
        found.rms
    );
    tell(&format_args!("wrote {}", out.display()));
    print(&said)
}
