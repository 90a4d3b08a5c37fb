//! The small file in which the layer tells the launcher how far it is.
#![forbid(unsafe_code)]

use super::replace;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Written at each captured or proved frame; for a capture at the first frames and then ten times a second as well.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Status {
    /// Swaps seen so far.
    pub frames: u64,
    /// Messages for the user, one sentence each.
    pub notes: Vec<String>,
    /// The result of `--prove`: a summary of `report`, which comes after this module in the order of imports.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proof: Option<serde_json::Value>,
}

impl Status {
    /// Reads the file; a missing or broken one counts as not written yet.
    #[must_use]
    pub fn read(path: &Path) -> Option<Self> {
        serde_json::from_slice(&std::fs::read(path).ok()?).ok()
    }

    /// Replaces the file, see [`replace`].
    pub fn write(&self, path: &Path) -> std::io::Result<()> {
        replace(path, &serde_json::to_vec(self)?)
    }
}
