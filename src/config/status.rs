//! The small file in which the layer tells the launcher how far it is.
#![forbid(unsafe_code)]

use serde::{Deserialize, Serialize};
use std::path::Path;

/// Written at the first frames, then ten times a second, and at each captured or proved frame.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Status {
    /// Swaps seen so far.
    pub frames: u64,
    /// What the user should know, one sentence each.
    pub notes: Vec<String>,
    /// What `--prove` has found: a summary of `report`, which this module stands before.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proof: Option<serde_json::Value>,
}

impl Status {
    /// Reads the file; a missing or broken one counts as not written yet.
    #[must_use]
    pub fn read(path: &Path) -> Option<Self> {
        serde_json::from_slice(&std::fs::read(path).ok()?).ok()
    }

    /// Replaces the file in one step, so that a reader never sees half of it.
    pub fn write(&self, path: &Path) -> std::io::Result<()> {
        let mut growing = path.as_os_str().to_owned();
        growing.push(".tmp");
        std::fs::write(&growing, serde_json::to_vec(self)?)?;
        std::fs::rename(&growing, path)
    }
}
