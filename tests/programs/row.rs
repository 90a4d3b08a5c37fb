//! One row of docs/compatibility.md, and the document.

use crate::table::Program;
use serde::{Deserialize, Serialize};
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// What one check came to.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub(crate) struct Cell {
    pub(crate) failed: bool,
    pub(crate) text: String,
}

impl Cell {
    pub(crate) fn good(text: impl Into<String>) -> Self {
        Self {
            failed: false,
            text: text.into(),
        }
    }

    pub(crate) fn bad(text: impl Into<String>) -> Self {
        Self {
            failed: true,
            text: text.into(),
        }
    }
}

/// A program's results.
#[derive(Debug, Default, Deserialize, Serialize)]
pub(crate) struct Row {
    pub(crate) frames: u64,
    /// Draws by strategy with `geometry` asked for, and why others were replayed.
    pub(crate) draws: String,
    /// One for each of [`CHECKS`]; fewer if it did not come so far.
    pub(crate) cells: Vec<Cell>,
}

/// The checks, in order, as the table's head has them.
pub(crate) const CHECKS: [&str; 7] = [
    "8 views",
    "replay",
    "auto",
    "geometry",
    "outer views",
    "GL errors",
    "live",
];

impl Row {
    pub(crate) fn fails(&self) -> bool {
        self.cells.len() < CHECKS.len() || self.cells.iter().any(|cell| cell.failed)
    }

    /// One line for the log.
    pub(crate) fn summary(&self) -> String {
        let mut text = format!("{} frames", self.frames);
        for (cell, check) in self.cells.iter().zip(CHECKS) {
            if cell.failed {
                let _ = write!(text, ", {check}: {}", cell.text);
            }
        }
        if !self.fails() {
            text.push_str(", passes");
        }
        text
    }

    pub(crate) fn save(&self, folder: &Path) {
        let json = serde_json::to_string_pretty(self).expect("JSON");
        fs::write(folder.join("row.json"), json).expect("written");
    }

    pub(crate) fn load(folder: &Path) -> Option<Self> {
        let text = fs::read_to_string(folder.join("row.json")).ok()?;
        serde_json::from_str(&text).ok()
    }
}

const HEAD: &str = "# Compatibility

Real programs of Debian 12 under the layer, on Mesa's software renderer. `make programs` makes this file; it is not edited by hand.
[tests/programs/programs.toml](../tests/programs/programs.toml) has their commands, and the causes that stand below the table.

Each program is recorded once by apitrace and repeated by glretrace or eglretrace. The columns:

- frames: at most 500 (`frames` of the file of commands may say otherwise); fewer where the program gave no more while it was
  recorded, with apitrace and software rendering.
- 8 views: all frames in 8 views under `replay`, `auto` and `geometry`; no crash, and the three make the same number of draws.
- replay, auto, geometry: 10 frames of the first 120, the middle view of 7 against the frame without the layer. Under `replay` every
  byte is equal, under the others the gate holds (ARCHITECTURE, What is right).
- outer views: views 0 and 6 of 7 under `geometry` against those under `replay` with `--atlas layers`, 5 frames, by the gate.
- GL errors: those that glretrace finds after each call under the layer and not without it.
- live: the program itself, 8 views under `geometry`, some seconds; frames shown.
- draws: with `geometry` asked for, 8 views, all frames, by what made them; the most frequent reasons of those that were replayed.
";

/// The text of docs/compatibility.md.
pub(crate) fn document(rows: &[(&Program, Row)]) -> String {
    let mut text = HEAD.to_owned();
    let passing = rows.iter().filter(|(_, row)| !row.fails()).count();
    let _ = writeln!(
        text,
        "\n{} programs, {passing} pass. Failures are **bold**.\n",
        rows.len()
    );
    let _ = writeln!(
        text,
        "| program | package | API | frames | {} | draws | verdict |",
        CHECKS.join(" | ")
    );
    text.push_str(&"|---".repeat(6 + CHECKS.len()));
    text.push_str("|\n");
    for (program, row) in rows {
        let cells: Vec<_> = (0..CHECKS.len())
            .map(|at| match row.cells.get(at) {
                None => "**not reached**".to_owned(),
                Some(cell) if cell.failed => format!("**{}**", cell.text),
                Some(cell) => cell.text.clone(),
            })
            .collect();
        let verdict = if row.fails() { "**fails**" } else { "passes" };
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {verdict} |",
            program.name,
            program.package.split(' ').next().unwrap_or_default(),
            program.api.name(),
            row.frames,
            cells.join(" | "),
            row.draws
        );
    }
    let failing: Vec<_> = rows.iter().filter(|(_, row)| row.fails()).collect();
    if !failing.is_empty() {
        text.push_str("\n## Causes\n\n");
        for (program, _) in failing {
            let cause = program.known.as_deref().unwrap_or("not yet known");
            let _ = writeln!(text, "- **{}**: {cause}", program.name);
        }
    }
    text
}
