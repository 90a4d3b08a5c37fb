//! A row of docs/compatibility.md, and the page.

use crate::programs::table::Program;
use std::collections::BTreeMap;
use std::fmt::Write;

/// The result of one check.
#[derive(Clone, Debug, PartialEq, Eq)]
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

    /// The result of a check that does not apply to this program.
    pub(crate) fn unasked() -> Self {
        Self::good("–")
    }

    /// The cell as it is written on the page, where bars part the columns.
    fn written(&self) -> String {
        let text = self.text.replace('|', "/");
        match self.failed {
            true => format!("**{text}**"),
            false => text,
        }
    }

    fn read(text: &str) -> Self {
        let failed = text
            .strip_prefix("**")
            .and_then(|text| text.strip_suffix("**"));
        failed.map_or_else(|| Self::good(text), Self::bad)
    }
}

/// A program's results.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Row {
    pub(crate) frames: u64,
    /// Draws by strategy with [`Program::fast`], and why others were replayed.
    pub(crate) draws: String,
    /// One for each of [`CHECKS`]; fewer if a check could not be reached.
    pub(crate) cells: Vec<Cell>,
}

/// The checks, in the order of the table's head.
pub(crate) const CHECKS: [&str; 11] = [
    "8 views",
    "replay",
    "auto",
    "geometry",
    "instanced",
    "splats",
    "outer views",
    "parallax",
    "GL errors",
    "splats over replay",
    "live",
];

impl Row {
    /// Applies the table of today to results of an earlier run, whose checks may have been others.
    pub(crate) fn adapt(&mut self, program: &Program) {
        for (cell, check) in self.cells.iter_mut().zip(CHECKS) {
            match program.asks(check) {
                false => *cell = Cell::unasked(),
                true if *cell == Cell::unasked() => *cell = Cell::good("not run"),
                true => {}
            }
        }
    }

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
}

/// The rows of a page by program, so that those that are not run again stay.
pub(crate) fn rows(document: &str) -> BTreeMap<String, Row> {
    let mut lines = document.lines().filter_map(|line| {
        let line = line.strip_prefix("| ")?.strip_suffix('|')?;
        Some(line.split('|').map(str::trim).collect::<Vec<_>>())
    });
    let head = lines.next().unwrap_or_default();
    let rows = lines.map(|line| {
        let cells: BTreeMap<_, _> = head.iter().copied().zip(line).collect();
        let text = |name: &str| cells.get(name).copied();
        let row = Row {
            frames: text("frames").and_then(|n| n.parse().ok()).unwrap_or(0),
            draws: text("draws").unwrap_or_default().to_owned(),
            cells: CHECKS
                .map(|check| text(check).map_or_else(Cell::unasked, Cell::read))
                .into(),
        };
        (text("program").unwrap_or_default().to_owned(), row)
    });
    rows.collect()
}

const HEAD: &str = "# Compatibility

Real programs of Debian 12 under the layer, on Mesa's software renderer. `make programs` makes this file; it is not edited by hand.
[tests/programs/programs.toml](../tests/programs/programs.toml) has their commands, and the causes that stand below the table.

Each program is recorded once by apitrace and repeated by glretrace or eglretrace. The columns:

- frames: at most 500 (`frames` of the file of commands may say otherwise); fewer where the program gave no more while it was
  recorded, with apitrace and software rendering, or where a quick look was asked for (`MANYVIEW_PROGRAMS_FRAMES`).
- 8 views: all frames in 8 views under `replay`, `auto`, `geometry`, `instanced` where the program brings shaders of its own, and
  `splats` where it shows points; no crash, and all make the same number of draws.
- replay, auto, geometry, instanced, splats: 10 frames of the first 120, the middle view of 7 against the frame without the layer. Under
  `replay` every byte is equal, under the others the gate holds
  ([Exact views and the gate](decisions/0001-exact-views-and-the-gate.md)). `none by instances`: nothing was drawn so, and `instanced` says no more than `replay` does.
- outer views: views 0 and 6 of 7 under `geometry`, `instanced` and `splats`, against those under `replay` with `--atlas layers`, 5 frames, by
  the gate.
- parallax: where these frames show a scene with depth, how many pixels of views 0 and 6 differ from the middle one's by more than 8
  steps of 255; in each view of each frame at least 0.05 %.
- GL errors: those that glretrace finds after each call under the layer and not without it.
- splats over replay: how many times as fast the frames are, by the medians of both, on a panel of 8 views that has the size of the
  window (`huebner8`).
- live: the program itself, 8 views under `geometry`, with shaders of its own `instanced`, with points `splats`, some seconds; frames shown.
- draws: with the strategy of the column before, 8 views, all frames, by what made them; the most frequent reasons of those that were
  replayed.

`–` is a check that a program is not asked for, `not run` one that it was not asked for when it was last run.
";

/// The text of docs/compatibility.md.
pub(crate) fn document(rows: &[(&Program, &Row)]) -> String {
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
                None => Cell::bad("not reached").written(),
                Some(cell) => cell.written(),
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

#[test]
fn rows_are_kept_by_the_document() {
    let table = crate::programs::table::read();
    const PARALLAX: usize = 7;
    let program = table.iter().find(|program| program.parallax).expect("one");
    let mut cells: Vec<_> = CHECKS.map(|check| Cell::good(format!("{check} 1"))).into();
    cells[1] = Cell::bad("2 of 9");
    let draws = "replay 3 (lists 2)".to_owned();
    let row = Row {
        frames: 7,
        draws,
        cells,
    };
    let kept = |text: &str| rows(text).remove(&program.name).expect("a row");
    let text = document(&[(program, &row)]);
    assert_eq!(kept(&text), row);
    // A column that the page does not have.
    let mut before = kept(&text.replace("| parallax ", "| another "));
    assert_eq!(before.cells[PARALLAX], Cell::unasked());
    before.adapt(program);
    assert_eq!(before.cells[PARALLAX], Cell::good("not run"));
    let flat = table.iter().find(|program| !program.parallax).expect("one");
    before.cells[PARALLAX] = Cell::bad("the same");
    before.adapt(flat);
    assert_eq!(before.cells[PARALLAX], Cell::unasked());
    assert!(rows("# Compatibility").is_empty());
}
