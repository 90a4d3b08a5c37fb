//! `manyview capture`
#![forbid(unsafe_code)]

use super::error::CommandError;
use super::layer::{CaptureArguments, LayerArguments};
use super::{Outcome, panel, print, scratch, tell};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use manyview::config::{Capture, Config, OptionId, Origin, Output, Settings};
use manyview::launch::{CaptureJob, Captured, Launch};
use std::ffi::OsString;
use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

#[derive(Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    capture: CaptureArguments,
    /// Give up after this many seconds
    #[arg(long, value_name = "S", default_value_t = 120)]
    timeout: u64,
    #[command(flatten)]
    layer: LayerArguments,
    /// The program and its arguments
    #[arg(required = true, trailing_var_arg = true, value_name = "APP")]
    command: Vec<OsString>,
}

pub(crate) fn run(arguments: &Arguments) -> Outcome {
    let mut settings = arguments.layer.settings()?;
    arguments.capture.give(&mut settings);
    let config = Config::from_settings(&settings)?;
    if let Some((width, height)) = panel::size(&config)? {
        let size = format!("{width}x{height}");
        settings.set(OptionId::PanelSize, size, Origin::Default);
    }
    let quilt = config.output == Output::Quilt
        && matches!(
            arguments.capture.get(OptionId::CaptureWhat),
            None | Some("output")
        );
    if let Some(out) = settings.get(OptionId::CaptureOut).filter(|_| quilt) {
        let completed = Capture::completed(Path::new(&out.value));
        let value = completed.to_string_lossy().into_owned();
        settings.set(OptionId::CaptureOut, value, out.origin.clone());
    }
    let shot = Shot {
        command: &arguments.command,
        timeout: arguments.timeout,
    };
    let (capture, captured) = shoot(shot, settings)?;
    match captured.files.as_slice() {
        [file] => tell(&format_args!("wrote {}", file.display())),
        [first, .., last] => tell(&format_args!(
            "wrote {} pictures, {} to {}",
            captured.files.len(),
            first.display(),
            last.display()
        )),
        [] => {}
    }
    if !capture.names_quilts() {
        return Ok(ExitCode::SUCCESS);
    }
    // The layer alone knows the names of quilts.
    let names = captured
        .files
        .iter()
        .map(|file| format!("{}\n", file.display()));
    print(&names.collect::<String>())
}

/// A program that runs until something of it is written.
pub(super) struct Shot<'a> {
    /// The program and its arguments.
    pub(super) command: &'a [OsString],
    /// Seconds that it may take.
    pub(super) timeout: u64,
}

/// Runs it, prints the notes of the layer, and returns the request and the files that were written.
pub(super) fn shoot(
    shot: Shot,
    mut settings: Settings,
) -> Result<(Capture, Captured), CommandError> {
    let scratch = scratch()?;
    let status = scratch.path().join("status.json");
    let written = status.to_string_lossy().into_owned();
    settings.set(OptionId::Status, written, Origin::CommandLine);
    let launch = Launch::prepare(shot.command, &settings)?;
    let Some(capture) = &launch.config.capture else {
        return Err(CommandError::NoPicture);
    };
    let job = CaptureJob {
        launch: &launch,
        capture,
        status: &status,
        timeout: Duration::from_secs(shot.timeout),
    };
    let bar = bar(capture.last - capture.first + 1);
    let outcome = job.run(|pictures, seen| {
        bar.set_position(pictures);
        if let Some(seen) = seen {
            bar.set_message(format!("frame {seen} of {}", capture.last));
        }
        bar.tick();
    });
    bar.finish_and_clear();
    for note in job.notes() {
        tell(&format_args!("note: {note}"));
    }
    Ok((capture.clone(), outcome?))
}

/// A progress bar on stderr, hidden when that is no terminal.
fn bar(pictures: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{spinner} {wide_bar} {pos}/{len} pictures  {msg}");
    ProgressBar::new(pictures).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
