//! The panel that the user has set up: `panel.toml` in the user's folder of manyview.
#![forbid(unsafe_code)]

use crate::bounded;
use crate::config::{replace, user_folder};
use serde::{Deserialize, Serialize};
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};

const FILE: &str = "panel.toml";
const REMEDY: &str = "set the panel up again with `manyview displays use NAME|FILE`";
/// Bytes that the file may have.
const MOST: u64 = 1 << 16;

/// What `manyview run` shows on unless it is told.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Chosen {
    /// As `--display` takes it; a file by its whole path.
    pub display: String,
    /// As `--panel` takes it; none: the picture is in the program's own window.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub panel: Option<String>,
}

/// Why a panel is not set up.
#[derive(Debug, thiserror::Error)]
pub enum ChosenError {
    /// Neither variable names a folder.
    #[error("there is no place for the panel's set-up; set HOME or XDG_CONFIG_HOME to your folder")]
    NoPlace,
    /// The file cannot be read.
    #[error("{}: {reason}; {REMEDY}", file.display())]
    Read {
        /// Its path.
        file: PathBuf,
        /// Why.
        reason: String,
    },
    /// The file cannot be written.
    #[error("{} is not written: {reason}; free its place", file.display())]
    Write {
        /// Its path.
        file: PathBuf,
        /// Why.
        reason: String,
    },
}

impl Chosen {
    /// The file in which it is kept.
    pub fn place() -> Result<PathBuf, ChosenError> {
        Ok(user_folder().ok_or(ChosenError::NoPlace)?.join(FILE))
    }

    /// The panel that is set up, if one is.
    pub fn read() -> Result<Option<Self>, ChosenError> {
        match Self::place() {
            Ok(file) => Self::read_from(&file),
            Err(_) => Ok(None),
        }
    }

    fn read_from(file: &Path) -> Result<Option<Self>, ChosenError> {
        let wrong = |reason: String| ChosenError::Read {
            file: file.to_owned(),
            reason,
        };
        match bounded::text(file, MOST) {
            Ok(text) => {
                let read = toml::from_str(&text);
                Ok(Some(read.map_err(|error: toml::de::Error| {
                    wrong(error.message().to_owned())
                })?))
            }
            Err(error) if is_missing(&error) => Ok(None),
            Err(error) => Err(wrong(error.to_string())),
        }
    }

    /// Sets the panel up. Returns the file.
    pub fn write(&self) -> Result<PathBuf, ChosenError> {
        let file = Self::place()?;
        let text = toml::to_string(self).map_err(|error| error.to_string());
        let written = text.and_then(|text| {
            let folder = file.parent().map_or(Ok(()), std::fs::create_dir_all);
            let written = folder.and_then(|()| replace(&file, text.as_bytes()));
            written.map_err(|error| error.to_string())
        });
        match written {
            Ok(()) => Ok(file),
            Err(reason) => Err(ChosenError::Write { file, reason }),
        }
    }

    /// No panel is set up any more. Returns whether one was.
    pub fn forget() -> Result<bool, ChosenError> {
        let file = Self::place()?;
        match std::fs::remove_file(&file) {
            Ok(()) => Ok(true),
            Err(error) if is_missing(&error) => Ok(false),
            Err(error) => Err(ChosenError::Write {
                file,
                reason: error.to_string(),
            }),
        }
    }
}

/// There is no such file, or no folder that could have it.
fn is_missing(error: &Error) -> bool {
    [ErrorKind::NotFound, ErrorKind::NotADirectory].contains(&error.kind())
}
