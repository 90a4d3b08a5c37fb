//! The command line: its subcommands, and the function that runs each of them.
//!
//! Results go to stdout, everything else to stderr.
#![forbid(unsafe_code)]

mod bench;
mod calibrate;
mod capture;
mod completions;
mod ctl;
mod displays;
mod doctor;
mod error;
mod layer;
mod man;
mod mask;
mod panel;
mod points;
mod rough;
mod run;
mod sheet;
mod show;
mod simulate;
mod volume;
mod wall;
mod weave;

use clap::{Parser, Subcommand};
use error::CommandError;
use image::{ImageFormat, RgbImage};
use manyview::simulate::SimulateError;
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;

const EXIT_STATUS: &str = "\
Exit status: that of APP for `run` (128 + the signal that killed it); else 0, or
  2    an option or file that cannot be used, or a request that the program has refused
  3    something missing here: the layer's library, an X server, OpenGL, a program for `ctl`
  4    the pictures of `capture`, or the frames of `bench`, were not reached, or no frame was proved
  126  APP cannot be executed, or the layer cannot enter it (setuid, static)
  127  APP is not found";

#[derive(Parser)]
#[command(
    name = "manyview",
    version,
    about = "Shows unmodified OpenGL programs on glasses-free 3D panels"
)]
#[command(after_help = EXIT_STATUS)]
struct Arguments {
    #[command(subcommand)]
    command: Action,
}

#[derive(Subcommand)]
enum Action {
    /// Run a program in N views.
    Run(run::Arguments),
    /// Show a point cloud.
    Points(points::Arguments),
    /// Run a program until the frames asked for are written as PNG, then end it.
    Capture(capture::Arguments),
    /// Read and change the views of a program that runs with --control.
    Ctl(ctl::Arguments),
    /// Read the profile of a program that runs with --control again, or write it.
    Profile(ctl::ProfileArguments),
    /// Write the mask of a panel: 16-bit RGB PNG, each value the view that the subpixel shows, 65535 for black.
    Mask(mask::Arguments),
    /// Interleave a quilt, a picture of all views, for a panel.
    Weave(weave::Arguments),
    /// Show what an eye in front of a panel sees of a picture, or a strip of eyes from left to right.
    Simulate(simulate::Arguments),
    /// Slices for a volumetric display, a screen that turns about an axis.
    Volume(volume::Arguments),
    /// Measure a panel's lens sheet from photos of a pattern that it shows.
    Calibrate(calibrate::Arguments),
    /// Panels that show one picture together: measure where they are and how bright.
    Wall(wall::Arguments),
    /// Measure the layer: frame times of scenes over those without it, and how far the picture is from the exact one.
    Bench(bench::Arguments),
    /// Say which OpenGL a program would get here and which strategies the layer has with it.
    Doctor(doctor::Arguments),
    /// List the panels that are plugged in, set up and built in; set one up.
    Displays(displays::Arguments),
    /// Write the manual pages.
    #[command(hide = true)]
    Man(man::Arguments),
    /// Write what shells complete.
    #[command(hide = true)]
    Completions(completions::Arguments),
}

/// The result of a subcommand: an exit status, or the reason for its failure.
type Outcome = Result<ExitCode, CommandError>;

pub(crate) fn main() -> ExitCode {
    let outcome = match Arguments::parse().command {
        Action::Run(arguments) => run::run(&arguments),
        Action::Points(arguments) => points::run(&arguments),
        Action::Capture(arguments) => capture::run(&arguments),
        Action::Ctl(arguments) => ctl::run(&arguments),
        Action::Profile(arguments) => ctl::profile(&arguments),
        Action::Mask(arguments) => mask::run(&arguments),
        Action::Weave(arguments) => weave::run(&arguments),
        Action::Simulate(arguments) => simulate::run(&arguments),
        Action::Volume(arguments) => volume::run(&arguments),
        Action::Calibrate(arguments) => calibrate::run(&arguments),
        Action::Wall(arguments) => wall::run(&arguments),
        Action::Bench(arguments) => bench::run(&arguments),
        Action::Doctor(arguments) => doctor::run(&arguments),
        Action::Displays(arguments) => displays::run(&arguments),
        Action::Man(arguments) => man::run(&arguments),
        Action::Completions(arguments) => completions::run(&arguments),
    };
    outcome.unwrap_or_else(|error| {
        tell(&error);
        ExitCode::from(error.exit_status())
    })
}

/// Prints one line on stderr.
fn tell(message: &dyn std::fmt::Display) {
    // A closed stderr is no reason to fail.
    let _ = writeln!(std::io::stderr(), "manyview: {message}");
}

/// Writes the picture that an eye sees.
fn save(seen: &RgbImage, out: &Path) -> Outcome {
    let written = seen.save_with_format(out, ImageFormat::Png);
    written.map_err(|error| SimulateError::Write {
        file: out.display().to_string(),
        reason: error.to_string(),
    })?;
    tell(&format_args!("wrote {}", out.display()));
    Ok(ExitCode::SUCCESS)
}

/// Prints the requested result on stdout.
fn print(text: &str) -> Outcome {
    match std::io::stdout().write_all(text.as_bytes()) {
        // A closed pipe means that the reader has enough.
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(CommandError::system("writing the result", error))
        }
        _ => Ok(ExitCode::SUCCESS),
    }
}

/// Pretty JSON with a newline at the end.
fn json(value: &impl serde::Serialize) -> Result<String, CommandError> {
    let text = serde_json::to_string_pretty(value)
        .map_err(|error| CommandError::system("writing JSON", error.into()))?;
    Ok(text + "\n")
}

/// Prints a result as JSON on stdout.
fn print_json(value: &impl serde::Serialize) -> Outcome {
    print(&json(value)?)
}

/// A folder for temporary files.
fn scratch() -> Result<tempfile::TempDir, CommandError> {
    tempfile::tempdir().map_err(|source| CommandError::system("making a temporary folder", source))
}

#[cfg(test)]
mod tests {
    use super::Arguments;
    use clap::CommandFactory;
    use manyview::config::{OPTIONS, Scope};

    #[test]
    fn clap_finds_no_contradiction() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn every_option_of_the_table_is_an_option_of_capture() {
        let command = Arguments::command();
        let capture = command.find_subcommand("capture").unwrap();
        for spec in OPTIONS {
            let Some(flag) = spec.flag else { continue };
            let known = capture
                .get_arguments()
                .find(|argument| argument.get_long() == Some(flag));
            let known = known.unwrap_or_else(|| panic!("--{flag} is missing"));
            let help = known.get_help().map(ToString::to_string);
            assert_eq!(help, Some(spec.command_help()), "--{flag}");
        }
    }

    #[test]
    fn what_only_capture_has_is_no_option_of_run() {
        let command = Arguments::command();
        let run = command.find_subcommand("run").unwrap();
        for spec in OPTIONS.iter().filter(|spec| spec.flag.is_some()) {
            let known = run
                .get_arguments()
                .any(|known| known.get_long() == spec.flag);
            assert_eq!(known, spec.scope == Scope::Layer, "{:?}", spec.flag);
        }
    }
}
