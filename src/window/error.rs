//! Errors of the window; every message is one sentence with the remedy.
#![forbid(unsafe_code)]

use x11rb::errors::{ConnectError, ConnectionError, ReplyError, ReplyOrIdError};

/// Why a picture cannot be shown.
#[derive(Debug, thiserror::Error)]
pub enum WindowError {
    /// There is no X server.
    #[error("no window can be opened: {0}; set DISPLAY to the X server that drives the panel")]
    Connect(#[from] ConnectError),
    /// The X server or the connection to it failed.
    #[error("the X server has closed the window: {0}; start again")]
    Server(String),
    /// The Wayland compositor failed, or lacks what the window needs.
    #[error(
        "the Wayland compositor shows no window of the panel: {0}; unset WAYLAND_DISPLAY to use an X server"
    )]
    Compositor(String),
    /// The screen has no 24-bit true colour in pixels of four bytes.
    #[error(
        "the X screen has no 24-bit true colour; use one that has, as the panel shows nothing right without"
    )]
    Colours,
    /// The layer cannot reach the window.
    #[error("the panel's window has no socket: {0}; free its place in XDG_RUNTIME_DIR or /tmp")]
    Socket(String),
    /// There is no such monitor.
    #[error("{option} '{wanted}': there is no such monitor; give one of {known}")]
    Monitor {
        /// The option that names it.
        option: &'static str,
        /// As the user wrote it.
        wanted: String,
        /// Numbers, names and sizes of the monitors that exist.
        known: String,
    },
    /// The picture is larger than the monitor.
    #[error(
        "the picture is {}x{} pixels and monitor {monitor} has {}x{}; give the --monitor that is the panel, or its --size",
        picture.0, picture.1, size.0, size.1
    )]
    TooLarge {
        /// Pixels.
        picture: (u32, u32),
        /// Its name.
        monitor: String,
        /// Pixels.
        size: (u32, u32),
    },
}

impl WindowError {
    /// The exit status of the command.
    #[must_use]
    pub fn exit_status(&self) -> u8 {
        match self {
            Self::Connect(_)
            | Self::Server(_)
            | Self::Compositor(_)
            | Self::Socket(_)
            | Self::Colours => 3,
            Self::Monitor { .. } | Self::TooLarge { .. } => 2,
        }
    }
}

impl From<ConnectionError> for WindowError {
    fn from(error: ConnectionError) -> Self {
        Self::Server(error.to_string())
    }
}

impl From<ReplyError> for WindowError {
    fn from(error: ReplyError) -> Self {
        Self::Server(error.to_string())
    }
}

impl From<ReplyOrIdError> for WindowError {
    fn from(error: ReplyOrIdError) -> Self {
        Self::Server(error.to_string())
    }
}
