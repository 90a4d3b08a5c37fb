//! Errors of requests, sent or not; each message says what to do instead.
#![forbid(unsafe_code)]

use crate::config::ConfigError;
use std::path::PathBuf;

/// Why a request failed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ControlError {
    /// The line is not a request.
    #[error(
        "a line is no request ({0}); send one JSON object with set, get, capture, explain, toggle, preset or profile, such as {{\"get\": \"all\"}}"
    )]
    Request(String),
    /// The line is longer than any request.
    #[error("a line has more than {max} bytes; send one request per line", max = super::Lines::MAX)]
    TooLong,
    /// No value has this name.
    #[error("there is no value '{name}'; ask for all, or one of {known}")]
    UnknownName {
        /// The name.
        name: String,
        /// The names that exist.
        known: String,
    },
    /// The value cannot change while the program runs.
    #[error("'{name}' cannot be set while the program runs; these can: {known}")]
    NotSettable {
        /// The name.
        name: String,
        /// The names that can be set.
        known: String,
    },
    /// The value is neither a number nor a text.
    #[error("{name} is neither a number nor a text; give one of them")]
    Type {
        /// The name.
        name: String,
    },
    /// The value has no effect for the current cameras.
    #[error("{name} is not in force: {reason}")]
    NotInForce {
        /// The name.
        name: String,
        /// What the cameras use instead.
        reason: &'static str,
    },
    /// The option does not accept the value.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// There are not so many cameras to choose from.
    #[error("there is no preset {0}; start the program with --presets, which are counted from 1")]
    Preset(usize),
    /// The window has no stereo buffers.
    #[error(
        "output is 'quad', but the window has no left and right buffer (GL_STEREO); choose another output, such as anaglyph or half-sbs"
    )]
    NoStereo,
    /// The path of a picture is relative, but the program may have another working directory.
    #[error("'{}' is not an absolute path; begin it with /", .0.display())]
    RelativePath(PathBuf),
    /// The picture could not be written.
    #[error("the picture is not written: {0}; give a path in a folder where the program may write")]
    Picture(String),
    /// There is no profile to be read.
    #[error(
        "the program has no profile; give one with --profile, or write one with `manyview profile save`"
    )]
    NoProfile,
    /// The profile has a mistake, and the one before stays in force; the sentence names the file and the remedy.
    #[error("{0}; the rules before stay in force")]
    Profile(String),
    /// The profile could not be written.
    #[error("{} cannot be written ({reason}); give a file in a folder where the program may write", path.display())]
    Unsaved {
        /// Its path.
        path: PathBuf,
        /// The error of the system.
        reason: String,
    },
    /// Another client waits for a picture.
    #[error("another picture is being taken; ask again when it is written")]
    Busy,
    /// The program has as many clients as it accepts.
    #[error("the program listens to {0} others already; ask again when one of them is done")]
    Crowded(usize),
    /// The name cannot be toggled.
    #[error("'{0}' cannot be switched; layer can")]
    Toggle(String),
    /// The folder of the socket is not the user's alone.
    #[error(
        "the folder {} {reason}; remove it, or set XDG_RUNTIME_DIR to a folder of your own",
        path.display()
    )]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// The socket could not be made.
    #[error("the socket {} cannot be made ({reason}), so the program runs without control", path.display())]
    Socket {
        /// Its path.
        path: PathBuf,
        /// The error of the system.
        reason: String,
    },
    /// No program listens.
    #[error("no program listens; start one with `manyview run --control -- APP`")]
    NoProgram,
    /// The requested program does not listen.
    #[error(
        "no program with the id {0} listens; `manyview ctl get` says which do if there are several, and --control makes one listen"
    )]
    NoSuchProgram(u32),
    /// More than one program listens.
    #[error("{0} listen; say which one with --pid")]
    SeveralPrograms(String),
    /// The program has shown no frame, so it has not read from the socket.
    #[error(
        "program {pid} has shown no frame for {seconds} s and so has not answered; ask again when it draws"
    )]
    Silent {
        /// The program.
        pid: u32,
        /// How long the client waited.
        seconds: u64,
    },
    /// The program closed the connection without an answer.
    #[error("program {0} has closed the connection without an answer; see whether it still runs")]
    Closed(u32),
    /// A name has no value.
    #[error("'{0}' has no value; give names and values in pairs, such as separation 0.03")]
    NoValue(String),
    /// The path is not UTF-8, so JSON cannot carry it.
    #[error("'{}' is not UTF-8, which requests are written in; choose another name", .0.display())]
    NotUtf8(PathBuf),
    /// The program refused the request, with this message.
    #[error("{0}")]
    Refused(String),
}

impl ControlError {
    /// The exit status of the command.
    #[must_use]
    pub fn exit_status(&self) -> u8 {
        match self {
            Self::NoProgram | Self::NoSuchProgram(_) | Self::Silent { .. } | Self::Closed(_) => 3,
            _ => 2,
        }
    }
}
