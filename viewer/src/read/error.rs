//! Faults of files.

use std::fmt;
use std::path::{Path, PathBuf};

/// Why a file cannot be read, or not further.
#[derive(Debug, thiserror::Error)]
#[error("{}, {at}: {what}", file.display())]
pub struct ReadError {
    /// The file.
    pub file: PathBuf,
    /// Where in it.
    pub at: Place,
    /// What is wrong.
    pub what: String,
}

/// A place in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The file itself, before anything of it is read.
    Start,
    /// What describes its points.
    Header,
    /// A line, counted from 1.
    Line(u64),
    /// A point, counted from 1.
    Point(u64),
}

impl fmt::Display for Place {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Start => write!(to, "start"),
            Place::Header => write!(to, "header"),
            Place::Line(line) => write!(to, "line {line}"),
            Place::Point(point) => write!(to, "point {point}"),
        }
    }
}

impl ReadError {
    pub(super) fn new(file: &Path, at: Place, what: impl fmt::Display) -> Self {
        Self {
            file: file.to_owned(),
            at,
            what: one_line(&what.to_string()),
        }
    }
}

/// The beginning of what a library says, which may have many lines.
fn one_line(text: &str) -> String {
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let line = lines.take(2).collect::<Vec<_>>().join(" ");
    let short: String = line.chars().take(LONGEST).collect();
    if short.len() < line.len() {
        short + "…"
    } else {
        short
    }
}

/// Characters of a sentence.
const LONGEST: usize = 200;
