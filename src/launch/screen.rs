//! The X screen that programs draw on.
#![forbid(unsafe_code)]

use super::error::LaunchError;
use super::xvfb::Xvfb;
use std::process::Command;

/// A screen for programs that we start.
#[derive(Debug)]
pub enum Screen {
    /// The screen that `DISPLAY` names.
    Callers,
    /// An Xvfb of our own, which ends when it is dropped.
    Own(Xvfb),
    /// No screen: the program draws off screen.
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

    /// Sets the environment of a program so that it draws on this screen.
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
