//! The screen that programs draw on.
#![forbid(unsafe_code)]

use super::error::LaunchError;
use super::xvfb::Xvfb;
use std::process::Command;

/// A screen for programs that we start.
#[derive(Debug)]
pub enum Screen {
    /// The one that `DISPLAY` names.
    Callers,
    /// One of our own; ends when it is dropped.
    Own(Xvfb),
    /// None: the program draws off screen.
    None,
}

impl Screen {
    /// The caller's screen, or one of our own where there is none.
    pub fn find() -> Result<Self, LaunchError> {
        if std::env::var_os("DISPLAY").is_none_or(|display| display.is_empty()) {
            Xvfb::start().map(Self::Own)
        } else {
            Ok(Self::Callers)
        }
    }

    /// Lets a program draw on it.
    pub fn give(&self, command: &mut Command) {
        match self {
            Self::Callers => {}
            Self::Own(server) => {
                command
                    .env("DISPLAY", server.display())
                    .env_remove("WAYLAND_DISPLAY");
            }
            Self::None => {
                command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
            }
        }
    }
}
