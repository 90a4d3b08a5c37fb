//! Errors of starting programs and of taking pictures.
#![forbid(unsafe_code)]

use crate::config::ConfigError;
use std::path::PathBuf;

/// Why a program was not started, or its pictures were not taken. Each kind has an exit status.
#[derive(Debug, thiserror::Error)]
pub enum LaunchError {
    /// An option is wrong.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// The program is neither a path nor in PATH.
    #[error("{0}: not found; give a path, or a name that is in PATH")]
    AppNotFound(String),
    /// The program cannot be executed.
    #[error("{}: {reason}", path.display())]
    AppNotExecutable {
        /// The program.
        path: PathBuf,
        /// The obstacle.
        reason: String,
    },
    /// The program can run, but the loader would not preload the layer.
    #[error("{}: {reason}, so the layer cannot enter it{remedy}", path.display())]
    AppClosed {
        /// The program.
        path: PathBuf,
        /// What keeps the layer out.
        reason: &'static str,
        /// What to do about it, after a semicolon; empty where nothing helps.
        remedy: &'static str,
    },
    /// The folder of a result does not exist or is not writable.
    #[error("{purpose} cannot be written to {}: {reason}", path.display())]
    NotWritable {
        /// The kind of result.
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
        /// The folders that were searched.
        searched: Vec<PathBuf>,
    },
    /// A program of ours is not found.
    #[error(
        "{name} is not in {}; build it with `make build`",
        searched.iter().map(|p| p.display().to_string()).collect::<Vec<_>>().join(" nor in ")
    )]
    NoHelper {
        /// Its name.
        name: &'static str,
        /// The folders that were searched.
        searched: Vec<PathBuf>,
    },
    /// The library cannot be preloaded.
    #[error("the library {} cannot be preloaded: {reason}", path.display())]
    BadLibrary {
        /// The library.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// DISPLAY is not set, and no X server of our own starts.
    #[error("DISPLAY is not set and Xvfb {reason}; install the package xvfb, or set DISPLAY")]
    NoDisplay {
        /// Why there is no Xvfb.
        reason: String,
    },
    /// No API gives an OpenGL context.
    #[error(
        "no OpenGL context can be made here; install a driver such as the package libgl1-mesa-dri"
    )]
    NoOpenGl,
    /// The system refused a request.
    #[error("{doing}: {source}")]
    System {
        /// The request.
        doing: &'static str,
        /// The system's error.
        source: std::io::Error,
    },
    /// The program ended before the last picture was taken.
    #[error("the program ended {how} after {seen}; frame {wanted} was never shown")]
    EndedEarly {
        /// Its exit status or signal, in words.
        how: String,
        /// How many frames the program has shown, in words.
        seen: String,
        /// The first frame that is missing.
        wanted: u64,
    },
    /// The time limit of a capture has passed.
    #[error(
        "frame {wanted} was not shown within {seconds} s, the program got to {seen}; give it more with --timeout"
    )]
    TimedOut {
        /// The first frame that is missing.
        wanted: u64,
        /// The limit.
        seconds: u64,
        /// How many frames the program has shown, in words.
        seen: String,
    },
    /// A scene ended without giving times.
    #[error(
        "the scene {what} ended {how} before its frames were drawn; `manyview doctor` says what OpenGL there is"
    )]
    SceneEnded {
        /// Scene and configuration.
        what: String,
        /// Its exit status or signal, in words.
        how: String,
    },
    /// A scene takes too long.
    #[error(
        "the scene {what} did not draw {frames} frames within {seconds} s; ask for fewer views or a smaller --size"
    )]
    SceneSilent {
        /// Scene and configuration.
        what: String,
        /// The requested number of frames.
        frames: u32,
        /// The limit.
        seconds: u64,
    },
    /// A scene printed something other than times.
    #[error(
        "the scene {what} printed '{line}' instead of its frame times; build it again with `make demos`"
    )]
    SceneAnswer {
        /// Scene and configuration.
        what: String,
        /// The printed line.
        line: String,
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
            Self::Config(_) | Self::NotWritable { .. } => 2,
            Self::NoLibrary { .. }
            | Self::NoHelper { .. }
            | Self::BadLibrary { .. }
            | Self::NoDisplay { .. }
            | Self::NoOpenGl
            | Self::System { .. } => 3,
            Self::EndedEarly { .. }
            | Self::TimedOut { .. }
            | Self::SceneEnded { .. }
            | Self::SceneSilent { .. }
            | Self::SceneAnswer { .. } => 4,
            Self::AppNotExecutable { .. } | Self::AppClosed { .. } => 126,
            Self::AppNotFound(_) => 127,
            Self::Interrupted(signal) => {
                128_u8.saturating_add(u8::try_from(*signal).unwrap_or(127))
            }
        }
    }
}
