//! Why a request is not followed, or not even sent; each message says what to do instead.
#![forbid(unsafe_code)]

use crate::config::ConfigError;
use std::path::PathBuf;

/// What went wrong.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ControlError {
    /// Not a request at all.
    #[error(
        "a line is no request ({0}); send one JSON object with set, get, capture or toggle, such as {{\"get\": \"all\"}}"
    )]
    Request(String),
    /// Longer than any request.
    #[error("a line has more than {max} bytes; send one request per line", max = super::Lines::MAX)]
    TooLong,
    /// A name that nothing has.
    #[error("there is no value '{name}'; ask for all, or one of {known}")]
    UnknownName {
        /// The name.
        name: String,
        /// The names there are.
        known: String,
    },
    /// A name whose value stays.
    #[error("'{name}' cannot be set while the program runs; these can: {known}")]
    NotSettable {
        /// The name.
        name: String,
        /// The names that can be set.
        known: String,
    },
    /// Neither number nor text.
    #[error("{name} is neither a number nor a text; give one of them")]
    Type {
        /// The name.
        name: String,
    },
    /// A value that means nothing for the cameras in force.
    #[error("{name} is not in force: {reason}")]
    NotInForce {
        /// The name.
        name: String,
        /// What is.
        reason: &'static str,
    },
    /// A value that its option does not take.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// The window has one buffer for both eyes.
    #[error(
        "output is 'quad', but the window has no left and right buffer (GL_STEREO); choose another output, such as anaglyph or half-sbs"
    )]
    NoStereo,
    /// A picture at a place that depends on who looks.
    #[error("'{}' is not an absolute path; begin it with /", .0.display())]
    RelativePath(PathBuf),
    /// A picture that could not be written.
    #[error("the picture is not written: {0}; give a path in a folder where the program may write")]
    Picture(String),
    /// Another asker waits for a picture.
    #[error("another picture is being taken; ask again when it is written")]
    Busy,
    /// More askers than one program listens to.
    #[error("the program listens to {0} others already; ask again when one of them is done")]
    Crowded(usize),
    /// Something that cannot be switched.
    #[error("'{0}' cannot be switched; layer can")]
    Toggle(String),
    /// A folder for the socket that others could have made or could enter.
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
    /// A socket that could not be made.
    #[error("the socket {} cannot be made ({reason}), so the program runs without control", path.display())]
    Socket {
        /// Its path.
        path: PathBuf,
        /// What the system says.
        reason: String,
    },
    /// Nobody listens.
    #[error("no program listens; start one with `manyview run --control -- APP`")]
    NoProgram,
    /// The program asked for does not listen.
    #[error(
        "no program with the id {0} listens; `manyview ctl get` says which do if there are several, and --control makes one listen"
    )]
    NoSuchProgram(u32),
    /// More than one listens.
    #[error("{0} listen; say which one with --pid")]
    SeveralPrograms(String),
    /// No frame was shown, so nobody looked at the socket.
    #[error(
        "program {pid} has shown no frame for {seconds} s and so has not answered; ask again when it draws"
    )]
    Silent {
        /// The program.
        pid: u32,
        /// How long it was waited for.
        seconds: u64,
    },
    /// The program went away instead of answering.
    #[error("program {0} has closed the connection without an answer; see whether it still runs")]
    Closed(u32),
    /// Names and values that do not go in pairs.
    #[error("'{0}' has no value; give names and values in pairs, such as separation 0.03")]
    NoValue(String),
    /// A path that JSON cannot carry.
    #[error("'{}' is not UTF-8, which requests are written in; choose another name", .0.display())]
    NotUtf8(PathBuf),
    /// The program's own refusal.
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
