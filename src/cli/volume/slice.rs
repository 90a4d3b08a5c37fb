//! `manyview volume slice`
#![forbid(unsafe_code)]

use super::super::capture::{Shot, shoot};
use super::super::error::CommandError;
use super::super::layer::LayerArguments;
use super::super::{Outcome, scratch, tell};
use clap::{Args, ValueEnum};
use manyview::config::{OptionId, Origin, Settings};
use manyview::simulate::SimulateError;
use manyview::volume::{RotatingScreen, Samples, Slices, Source, Volume, VolumeError};
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

/// Number of views unless given: the own view is the middle one, and hidden samples are for the outer ones.
const VIEWS: &str = "3";

/// Separation unless cameras are given. In most scenes hidden samples then suffice for an eye 4 inches beside the viewer.
const SEPARATION: &str = "0.1";

#[derive(Args)]
pub(crate) struct Arguments {
    /// Folder to write the slices to: empty, not there yet, or with another stack
    #[arg(long, value_name = "FOLDER")]
    out: PathBuf,
    /// Frame to take, counted from 1 [default: 30]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    frame: Option<String>,
    /// Source of the slices: the reference image of an occlusion camera, or the program's own picture with its depths
    #[arg(long, value_name = "reference|own", default_value = "reference")]
    of: Of,
    /// Give up after this many seconds
    #[arg(long, value_name = "S", default_value_t = 120)]
    timeout: u64,
    #[command(flatten)]
    layer: LayerArguments,
    /// The program and its arguments
    #[arg(required = true, trailing_var_arg = true, value_name = "APP")]
    command: Vec<OsString>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Of {
    Reference,
    Own,
}

pub(crate) fn run(arguments: &Arguments) -> Outcome {
    let mut settings = arguments.layer.settings()?;
    let focal = complete(&mut settings)?;
    settings.give([(OptionId::CaptureFrames, &arguments.frame)]);
    let scratch = scratch()?;
    let file = scratch.path().join("samples");
    let own = [
        (OptionId::CaptureOut, file.to_string_lossy()),
        (OptionId::CaptureWhat, "samples".into()),
    ];
    for (id, value) in own {
        settings.set(id, value, Origin::CommandLine);
    }
    if let Some((_, value)) = settings.field(OptionId::CaptureFrames)
        && value.contains("..")
    {
        return Err(refused(
            "frame",
            value,
            "one frame such as 30, as slices are of one",
        ));
    }
    Slices::check_folder(&arguments.out)?;
    let screen = RotatingScreen::POPESCU;
    let shot = Shot {
        command: &arguments.command,
        timeout: arguments.timeout,
    };
    shoot(shot, settings)?;
    let bytes = std::fs::read(&file)
        .map_err(|source| CommandError::system("reading what the program has shown", source))?;
    let source = match arguments.of {
        Of::Reference => Source::Reference,
        Of::Own => Source::Own,
    };
    let image = Samples::read(&bytes)?.image(&screen, source, focal)?;
    let volume = Volume::of_reference(&screen, &image)?;
    if volume.is_empty() {
        return Err(VolumeError::Shown {
            reason: "all of its picture lies outside of the display; give another --focal-depth or --convergence".to_owned(),
        }
        .into());
    }
    let (volume, gain) = volume.exposed();
    volume.dithered().write(&arguments.out)?;
    tell(&format_args!(
        "wrote {} slices to {}, {gain:.1} times as bright as the program's picture",
        screen.slices,
        arguments.out.display()
    ));
    Ok(ExitCode::SUCCESS)
}

/// Sets the options that slices need, and returns whether the user has placed the zero parallax.
fn complete(settings: &mut Settings) -> Result<bool, CommandError> {
    if let Some((field, value)) = settings.field(OptionId::Strategy)
        && field.origin == Origin::CommandLine
        && value != "occlusion"
    {
        let expected = "occlusion or leave it out, as slices have what an occlusion camera sees";
        return Err(refused("strategy", value, expected));
    }
    settings.set(OptionId::Strategy, "occlusion", Origin::CommandLine);
    if settings.get(OptionId::Views).is_none() {
        settings.set(OptionId::Views, VIEWS, Origin::Default);
    }
    let cameras = [
        OptionId::EyeSpacing,
        OptionId::FocalDepth,
        OptionId::Separation,
        OptionId::Convergence,
    ];
    if cameras.iter().all(|id| settings.get(*id).is_none()) {
        settings.set(OptionId::AutoDepth, "1", Origin::Default);
        settings.set(OptionId::Separation, SEPARATION, Origin::Default);
    }
    let places = [OptionId::FocalDepth, OptionId::Convergence];
    Ok(places.iter().any(|id| settings.get(*id).is_some()))
}

fn refused(flag: &'static str, found: &str, expected: &'static str) -> CommandError {
    SimulateError::Option {
        flag,
        found: found.to_owned(),
        expected,
    }
    .into()
}
