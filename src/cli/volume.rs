//! `manyview volume`
#![forbid(unsafe_code)]

mod slice;

use super::{Outcome, save};
use clap::{Args, Subcommand};
use manyview::launch::writable;
use manyview::simulate::SimulateError;
use manyview::volume::{Sight, Slices};
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    action: Action,
}

#[derive(Subcommand)]
enum Action {
    /// Run a program until a frame of it is made into slices, then end it.
    Slice(Box<slice::Arguments>),
    /// Show what an eye sees of a stack of slices.
    Simulate(Simulate),
}

#[derive(Args)]
struct Simulate {
    /// Folder with the slices
    #[arg(value_name = "STACK")]
    stack: PathBuf,
    /// Where the eye is, in inches from the middle of the display: to the right, upwards, towards the viewer [default: that of the display's viewer]
    #[arg(long, value_name = "X,Y,Z[in]", allow_hyphen_values = true)]
    eye: Option<String>,
    /// File to write: what the eye sees, PNG
    #[arg(long, value_name = "PATH")]
    out: PathBuf,
    /// Of the picture, in pixels [default: 720x480]
    #[arg(long, value_name = "WxH")]
    size: Option<String>,
    /// Draw lines on the sphere that the screen sweeps
    #[arg(long)]
    sphere: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Outcome {
    match &arguments.action {
        Action::Slice(slice) => slice::run(slice),
        Action::Simulate(simulate) => run_simulate(simulate),
    }
}

fn run_simulate(arguments: &Simulate) -> Outcome {
    let eye = arguments.eye.as_deref().map(eye).transpose()?;
    let size = arguments.size.as_deref().map(size).transpose()?;
    writable("what the eye sees", &arguments.out)?;
    let slices = Slices::read(&arguments.stack)?;
    let viewer = Sight::of_viewer(slices.screen());
    let sight = Sight {
        eye: eye.unwrap_or(viewer.eye),
        size: size.unwrap_or(viewer.size),
        sphere: arguments.sphere,
    };
    save(&sight.see(&slices)?, &arguments.out)
}

fn eye(text: &str) -> Result<[f64; 3], SimulateError> {
    let lengths = text.trim().trim_end_matches("in").split(',').map(|length| {
        let length = length.trim().parse().ok();
        length.filter(|length: &f64| length.is_finite())
    });
    match lengths.collect::<Option<Vec<_>>>().as_deref() {
        Some(&[x, y, z]) => Ok([x, y, z]),
        _ => Err(SimulateError::Option {
            flag: "eye",
            found: text.to_owned(),
            expected: "X,Y,Z in inches from the middle of the display, such as -4,0,50",
        }),
    }
}

fn size(text: &str) -> Result<[u32; 2], SimulateError> {
    let side = |text: &str| text.parse().ok().filter(|side| (1..=8192).contains(side));
    text.split_once('x')
        .and_then(|(width, height)| Some([side(width)?, side(height)?]))
        .ok_or_else(|| SimulateError::Option {
            flag: "size",
            found: text.to_owned(),
            expected: "width and height in pixels such as 720x480, each from 1 to 8192",
        })
}

#[cfg(test)]
mod tests {
    use super::{eye, size};

    #[test]
    fn eyes_are_three_lengths_in_inches() {
        for text in ["-4,0.5,50", "-4,0.5,50in", " -4, 0.5, 50 in "] {
            assert_eq!(eye(text).ok(), Some([-4.0, 0.5, 50.0]), "{text}");
        }
        for wrong in ["", "1,2", "1,2,3,4", "1,2,nan", "1,2,inf", "1,2,3mm"] {
            assert!(eye(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn sizes_are_two_numbers_of_pixels() {
        assert_eq!(size("720x480").ok(), Some([720, 480]));
        for wrong in ["", "720", "0x480", "720x9000", "720x480x3", "-1x5"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
    }
}
