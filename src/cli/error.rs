//! Why a subcommand could not do its work.
#![forbid(unsafe_code)]

use manyview::bench::BenchError;
use manyview::calibrate::CalibrateError;
use manyview::config::ConfigError;
use manyview::control::ControlError;
use manyview::display::{DisplayError, MaskError, QuiltError};
use manyview::interleave::reference::ReferenceError;
use manyview::launch::LaunchError;
use manyview::plugged::ChosenError;
use manyview::simulate::SimulateError;
use manyview::volume::VolumeError;
use manyview::wall::WallError;
use manyview::window::WindowError;
use std::path::PathBuf;

/// What went wrong; each kind has its exit status.
#[derive(Debug, thiserror::Error)]
pub(super) enum CommandError {
    /// The program was not started, or its pictures not taken.
    #[error(transparent)]
    Launch(#[from] LaunchError),
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
    /// The panel that is set up.
    #[error(transparent)]
    Chosen(#[from] ChosenError),
    /// A panel that shows no picture of its own.
    #[error("{0} is a model, whose devices differ; give the calibration of yours, its visual.json")]
    Model(String),
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
    /// A wall that could not be measured.
    #[error(transparent)]
    Wall(#[from] WallError),
    /// Nothing was measured.
    #[error(transparent)]
    Bench(#[from] BenchError),
    /// A window of our own that cannot be had.
    #[error(transparent)]
    Window(#[from] WindowError),
    /// A running program that was not asked, or has refused.
    #[error(transparent)]
    Control(#[from] ControlError),
}

impl From<ConfigError> for CommandError {
    fn from(error: ConfigError) -> Self {
        LaunchError::from(error).into()
    }
}

impl CommandError {
    /// Something the system refused.
    pub(super) fn system(doing: &'static str, source: std::io::Error) -> Self {
        LaunchError::System { doing, source }.into()
    }

    /// The exit status of the command.
    pub(super) fn exit_status(&self) -> u8 {
        match self {
            Self::NoPicture
            | Self::Size(_)
            | Self::Mask(_)
            | Self::Display(_)
            | Self::Chosen(_)
            | Self::Model(_)
            | Self::Quilt(_)
            | Self::QuiltShape(_)
            | Self::QuiltUnknown(_)
            | Self::QuiltViews { .. }
            | Self::Reference(_)
            | Self::Picture { .. }
            | Self::Simulate(_)
            | Self::Volume(_)
            | Self::Calibrate(_)
            | Self::Wall(_) => 2,
            Self::Launch(error) => error.exit_status(),
            Self::Bench(error) => error.exit_status(),
            Self::Control(error) => error.exit_status(),
            Self::Window(error) => error.exit_status(),
        }
    }
}
