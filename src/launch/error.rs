//! Why a program was not started, or its pictures not taken.
#![forbid(unsafe_code)]

use crate::bench::BenchError;
use crate::calibrate::CalibrateError;
use crate::config::ConfigError;
use crate::control::ControlError;
use crate::display::{DisplayError, MaskError, QuiltError};
use crate::interleave::reference::ReferenceError;
use crate::simulate::SimulateError;
use crate::volume::VolumeError;
use crate::window::WindowError;
use std::path::PathBuf;

/// What went wrong; each kind has its exit status.
#[derive(Debug, thiserror::Error)]
pub enum LaunchError {
    /// An option.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// A capture without a file to write to.
    #[error("no picture is asked for; set --out to the file to write")]
    NoPicture,
    /// The size of a mask.
    #[error(
        "--size is '{0}'; give width and height in pixels such as 1920x1080, each from 1 to 16384"
    )]
    Size(String),
    /// A mask that could not be made or written.
    #[error(transparent)]
    Mask(#[from] MaskError),
    /// A panel.
    #[error(transparent)]
    Display(#[from] DisplayError),
    /// A quilt.
    #[error(transparent)]
    Quilt(#[from] QuiltError),
    /// Columns and rows that are none.
    #[error("--quilt is '{0}'; give columns and rows such as 8x6, each from 1 to 256")]
    QuiltShape(String),
    /// A picture of which nobody says what it holds.
    #[error(
        "{}: neither its name nor the panel says how many columns and rows of views it has; give them as --quilt 8x6", _0.display()
    )]
    QuiltUnknown(PathBuf),
    /// More views are asked for than there are.
    #[error("the quilt has {has} views; give --views 1 to {has} instead of {wanted}")]
    QuiltViews {
        /// Of the quilt.
        has: usize,
        /// As asked for.
        wanted: u32,
    },
    /// Views that make no picture.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    /// A picture that is not read or not written.
    #[error("{}: {reason}", file.display())]
    Picture {
        /// Its file.
        file: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// What an eye would see, but for this.
    #[error(transparent)]
    Simulate(#[from] SimulateError),
    /// What a volumetric display cannot show, or what is no stack of its slices.
    #[error(transparent)]
    Volume(#[from] VolumeError),
    /// A panel that could not be measured.
    #[error(transparent)]
    Calibrate(#[from] CalibrateError),
    /// Nothing was measured.
    #[error(transparent)]
    Bench(#[from] BenchError),
    /// A window of our own that cannot be had.
    #[error(transparent)]
    Window(#[from] WindowError),
    /// A running program that was not asked, or has refused.
    #[error(transparent)]
    Control(#[from] ControlError),
    /// The program is neither a path nor in PATH.
    #[error("{0}: not found; give a path, or a name that is in PATH")]
    AppNotFound(String),
    /// The program cannot be executed at all.
    #[error("{}: {reason}", path.display())]
    AppNotExecutable {
        /// The program.
        path: PathBuf,
        /// What stands in the way.
        reason: String,
    },
    /// The program runs, but never with the layer in it.
    #[error("{}: {reason}, so the layer cannot enter it", path.display())]
    AppClosed {
        /// The program.
        path: PathBuf,
        /// What keeps the layer out.
        reason: &'static str,
    },
    /// A folder for results that is not there or not writable.
    #[error("{purpose} cannot be written to {}: {reason}", path.display())]
    NotWritable {
        /// What would be written.
        purpose: &'static str,
        /// The file.
        path: PathBuf,
        /// What is wrong with its folder.
        reason: String,
    },
    /// The layer is not installed.
    #[error(
        "libmanyview.so is not in {}; build it with `make build`, or set MANYVIEW_LIBRARY to its path",
        searched.iter().map(|p| p.display().to_string()).collect::<Vec<_>>().join(" nor in ")
    )]
    NoLibrary {
        /// Where it was looked for.
        searched: Vec<PathBuf>,
    },
    /// The library that was named cannot be preloaded.
    #[error("the library {} cannot be preloaded: {reason}", path.display())]
    BadLibrary {
        /// The library.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// No DISPLAY and no X server of our own.
    #[error("DISPLAY is not set and Xvfb {reason}; install the package xvfb, or set DISPLAY")]
    NoDisplay {
        /// What happened to Xvfb.
        reason: String,
    },
    /// No context of any kind.
    #[error(
        "no OpenGL context can be made here; install a driver such as the package libgl1-mesa-dri"
    )]
    NoOpenGl,
    /// Something the system refused.
    #[error("{doing}: {source}")]
    System {
        /// What was tried.
        doing: &'static str,
        /// The refusal.
        source: std::io::Error,
    },
    /// The program ended before the last picture was taken.
    #[error("the program ended {how} after {seen}; frame {wanted} was never shown")]
    EndedEarly {
        /// With which status.
        how: String,
        /// How many frames it got.
        seen: String,
        /// The first frame that is missing.
        wanted: u64,
    },
    /// The time for the capture is over.
    #[error(
        "frame {wanted} was not shown within {seconds} s, the program got to {seen}; give it more with --timeout"
    )]
    TimedOut {
        /// The first frame that is missing.
        wanted: u64,
        /// The limit.
        seconds: u64,
        /// How many frames it got.
        seen: String,
    },
    /// A signal asked the launcher to stop.
    #[error("stopped by signal {0}")]
    Interrupted(i32),
}

impl LaunchError {
    /// The exit status of the command.
    #[must_use]
    pub fn exit_status(&self) -> u8 {
        match self {
            Self::Config(_)
            | Self::NotWritable { .. }
            | Self::NoPicture
            | Self::Size(_)
            | Self::Mask(_)
            | Self::Display(_)
            | Self::Quilt(_)
            | Self::QuiltShape(_)
            | Self::QuiltUnknown(_)
            | Self::QuiltViews { .. }
            | Self::Reference(_)
            | Self::Picture { .. }
            | Self::Simulate(_)
            | Self::Volume(_)
            | Self::Calibrate(_) => 2,
            Self::Bench(error) => error.exit_status(),
            Self::Control(error) => error.exit_status(),
            Self::Window(error) => error.exit_status(),
            Self::NoLibrary { .. }
            | Self::BadLibrary { .. }
            | Self::NoDisplay { .. }
            | Self::NoOpenGl
            | Self::System { .. } => 3,
            Self::EndedEarly { .. } | Self::TimedOut { .. } => 4,
            Self::AppNotExecutable { .. } | Self::AppClosed { .. } => 126,
            Self::AppNotFound(_) => 127,
            Self::Interrupted(signal) => {
                128_u8.saturating_add(u8::try_from(*signal).unwrap_or(127))
            }
        }
    }
}
