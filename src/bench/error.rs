//! Why `manyview bench` cannot answer; each message names the option and the remedy.

use std::path::PathBuf;

/// The cause.
#[derive(Debug, thiserror::Error)]
pub enum BenchError {
    /// A name that is in no table.
    #[error(
        "{option} is '{value}'; this version knows {known} (`manyview bench --list` describes them)"
    )]
    Unknown {
        /// The option.
        option: &'static str,
        /// Its value.
        value: String,
        /// What it could be.
        known: String,
    },
    /// A number of frames that is none.
    #[error("--frames is '{0}'; give a whole number from 1 to 10000")]
    Frames(String),
    /// Frames of a walk that are none.
    #[error(
        "--frames is '{0}'; a walk of --fps takes the last frame or both ends, such as 100..400, from 2 on and 900 frames at most"
    )]
    WalkFrames(String),
    /// A walk without frames to measure.
    #[error("the program drew no frames by hybrid; {0}")]
    NoWalk(String),
    /// An option of programs where none is started.
    #[error("{option} does not go with --preset {preset}, which starts no program; leave it out")]
    NoProgram {
        /// The option.
        option: &'static str,
        /// Name of the preset.
        preset: &'static str,
    },
    /// Several sizes where one is measured.
    #[error("--size has several sizes; --preset popescu-table1 measures one")]
    OneSize,
    /// Pictures of another kind.
    #[error("--chart is '{}'; --preset popescu-table1 draws pictures, give a name that ends in .png", _0.display())]
    SheetName(PathBuf),
    /// A chart where there is none.
    #[error(
        "--chart is drawn of scenes and of walks; leave it out, or give --fps for a walk of the program"
    )]
    NoChart,
    /// A chart of another kind.
    #[error("--chart is '{}'; give a name that ends in .png or .svg", _0.display())]
    ChartName(PathBuf),
    /// A scene whose program is not there.
    #[error(
        "the program {program} of the scene {scene} is not in {}; build it with `make demos`",
        searched.iter().map(|p| p.display().to_string()).collect::<Vec<_>>().join(" nor in ")
    )]
    NoScene {
        /// The scene.
        scene: &'static str,
        /// Its program.
        program: &'static str,
        /// Where it was looked for.
        searched: Vec<PathBuf>,
    },
    /// The layer wrote no picture.
    #[error("the layer wrote no picture of the scene {what}: {reason}")]
    NoPicture {
        /// Scene and configuration.
        what: String,
        /// Why, as far as it is known.
        reason: String,
    },
    /// A program of which no frame was proved, nor a reason told.
    #[error(
        "no frame of the program was proved under any configuration: {0}; `manyview run --prove 2` shows what it does"
    )]
    Unproved(String),
    /// A chart that cannot be drawn.
    #[error("the chart cannot be drawn: {0}")]
    Chart(String),
    /// A file that cannot be written.
    #[error("{} cannot be written: {reason}", file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// Why.
        reason: String,
    },
}

impl BenchError {
    /// The exit status of the command.
    #[must_use]
    pub fn exit_status(&self) -> u8 {
        match self {
            Self::Unknown { .. }
            | Self::Frames(_)
            | Self::WalkFrames(_)
            | Self::NoChart
            | Self::NoProgram { .. }
            | Self::OneSize
            | Self::SheetName(_)
            | Self::ChartName(_) => 2,
            Self::NoScene { .. } | Self::Chart(_) | Self::Write { .. } => 3,
            Self::Unproved(_) | Self::NoWalk(_) | Self::NoPicture { .. } => 4,
        }
    }
}
