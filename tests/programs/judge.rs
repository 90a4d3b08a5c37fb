//! What is asked of one program.

use crate::repeat::{Repeat, Repeated, errors, frames, live, record, repeat, trim};
use crate::row::{Cell, Row};
use crate::support::{Screen, rgb, scratch};
use crate::table::Program;
use crate::wish;
use image::RgbImage;
use manyview::metric::{Comparison, Gate, triptych};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Views where the middle one is the program's own.
const ODD: u32 = 7;
/// Pictures are compared in the first frames of a trace only, they take long; but in all of it where input leads out of a menu.
const COMPARED: u64 = 120;
/// Pictures of them, spread evenly.
const PICTURES: u64 = 10;
/// Frames of which the outer views are compared: the last of [`COMPARED`].
const OUTER: u64 = 5;
/// At least; else as long as it is recorded.
const LIVE_SECONDS: u64 = 5;

const STRATEGIES: [&str; 3] = ["replay", "auto", "geometry"];

/// Runs all checks. Whatever goes wrong is in the row.
pub(crate) fn judge(program: &Program, screen: &Screen, folder: &Path) -> Row {
    let mut row = Row::default();
    let trace = match record(program, screen, folder) {
        Ok(trace) => trace,
        Err(error) => {
            row.cells.push(Cell::bad(format!("not recorded: {error}")));
            return row;
        }
    };
    let mut trace = trace;
    let mut count = frames(&trace).unwrap_or(0);
    if let Some(fewer) = most_frames().filter(|&fewer| fewer < count) {
        count = fewer;
        let all = std::mem::replace(&mut trace, folder.join("fewer.trace"));
        trim(&all, &trace, count).expect("a shorter trace");
    }
    row.frames = count;
    if count < 2 {
        row.cells.push(Cell::bad("no frames recorded"));
        return row;
    }
    let bench = Bench {
        program,
        screen,
        folder,
        count,
        compared: match program.input.is_empty() {
            true => count.min(COMPARED),
            false => count,
        },
        trace,
        short: folder.join("short.trace"),
    };
    trim(&bench.trace, &bench.short, bench.compared).expect("a shorter trace");
    bench.all_frames(&mut row);
    let (cells, outer) = bench.pictures();
    // The columns: 8 views, pictures by strategy, outer views, GL errors, live.
    row.cells.splice(1..1, cells.into_iter().chain([outer]));
    row.cells.push(bench.live());
    for trace in ["short.trace", "fewer.trace"] {
        let _ = fs::remove_file(folder.join(trace));
    }
    row
}

/// A quick look at many programs: fewer frames than are recorded.
fn most_frames() -> Option<u64> {
    wish("MANYVIEW_PROGRAMS_FRAMES").map(|n| n.parse().expect("a number of frames"))
}

struct Bench<'a> {
    program: &'a Program,
    screen: &'a Screen,
    folder: &'a Path,
    count: u64,
    compared: u64,
    trace: PathBuf,
    short: PathBuf,
}

impl Bench<'_> {
    fn repeat(&self, trace: &Path, how: &Repeat<'_>, name: &str) -> Repeated {
        repeat(
            self.program,
            trace,
            how,
            self.screen,
            &self.folder.join(name),
        )
    }

    /// A path below this program's folder, for a variable.
    fn path(&self, name: &str) -> String {
        self.folder.join(name).display().to_string()
    }

    fn report(&self, name: &str) -> Option<Value> {
        let text = fs::read_to_string(self.folder.join(name).join("report.json")).ok()?;
        serde_json::from_str(&text).ok()
    }

    /// All frames in 8 views: first the cell of the runs, then the one of GL errors.
    fn all_frames(&self, row: &mut Row) {
        let bare = self.repeat(&self.trace, &Repeat::default(), "bare");
        let expected = errors(&bare.ended.said);
        let mut wrong = Vec::new();
        if let Some(status) = &bare.ended.wrong {
            wrong.push(format!("bare: {status}"));
        }
        let (mut raised, mut draws) = (Vec::new(), BTreeMap::new());
        for strategy in STRATEGIES {
            let name = format!("8-{strategy}");
            let layer = vec![
                ("VIEWS", "8".to_owned()),
                ("STRATEGY", strategy.to_owned()),
                ("REPORT", self.path(&format!("{name}/report.json"))),
                // For a person to look at; with it the report is written when the last frame is shown.
                ("OUTPUT", "quilt".to_owned()),
                ("CAPTURE_OUT", self.path(&format!("{name}/quilt.png"))),
                ("CAPTURE_FRAMES", self.count.to_string()),
            ];
            let how = Repeat {
                layer: Some(layer),
                interval: 0,
            };
            let run = self.repeat(&self.trace, &how, &name);
            if let Some(status) = run.ended.wrong {
                wrong.push(format!("{strategy}: {status}"));
            }
            for (text, times) in errors(&run.ended.said) {
                let before = expected.get(&text).copied().unwrap_or(0);
                if times != before {
                    raised.push(format!("{strategy}: {text}, {times} for {before}"));
                }
            }
            let Some(report) = self.report(&name) else {
                wrong.push(format!("{strategy}: no report"));
                continue;
            };
            let own = report["gl_errors"].as_u64().unwrap_or(0);
            if own > 0 {
                raised.push(format!("{strategy}: {own} of the layer's own"));
            }
            let sum: u64 = numbers(&report["draws"]).map(|(_, n)| n).sum();
            // The last report of a program with several contexts may be some frames old.
            if report["frames"]
                .as_u64()
                .is_some_and(|n| n + 1 >= self.count)
            {
                draws.insert(strategy, sum);
            } else if sum == 0 {
                wrong.push(format!("{strategy}: nothing drawn"));
            }
            if strategy == "geometry" {
                row.draws = draws_in_words(&report);
            }
        }
        let first = draws.values().next();
        if draws.values().any(|other| Some(other) != first) {
            wrong.push(format!("draws differ: {draws:?}"));
        } else if first == Some(&0) {
            wrong.push("nothing drawn".into());
        }
        row.cells.push(cell(wrong, "yes"));
        row.cells.push(cell(raised, "none"));
    }

    /// Middle views by strategy, and the outer ones.
    fn pictures(&self) -> (Vec<Cell>, Cell) {
        let interval = (self.compared / PICTURES).max(1);
        let bare = Repeat {
            layer: None,
            interval,
        };
        let mut expected = self.repeat(&self.short, &bare, "pictures").pictures;
        // What varies without the layer, such as an undefined first frame, says nothing.
        let again = self.repeat(&self.short, &bare, "pictures-again").pictures;
        expected.retain(|name, path| again.get(name).is_some_and(|other| same_bytes(path, other)));
        if let Some(first) = again.keys().next() {
            expected.remove(first);
        }
        let mut cells = Vec::new();
        for strategy in STRATEGIES {
            let run = self.seven(strategy, &[], interval, &format!("7-{strategy}"));
            cells.push(self.middle(strategy, &expected, &run));
        }
        // Geometry draws to layers. Every view is then at the origin, and float rounding moves with the place.
        self.seven("replay", &[("ATLAS", "layers".to_owned())], 0, "7-layers");
        (cells, self.outer())
    }

    /// The first frames in 7 views: the middle one as the program reads it back, all of the last frames as captured.
    fn seven(
        &self,
        strategy: &str,
        more: &[(&'static str, String)],
        interval: u64,
        name: &str,
    ) -> Repeated {
        let first = (self.compared + 1).saturating_sub(OUTER).max(1);
        let mut layer = vec![
            ("VIEWS", ODD.to_string()),
            ("STRATEGY", strategy.to_owned()),
            ("CAPTURE_OUT", self.path(&format!("{name}/all-%d.png"))),
            ("CAPTURE_FRAMES", format!("{first}..{}", self.compared)),
            ("CAPTURE_WHAT", "atlas".to_owned()),
        ];
        layer.extend_from_slice(more);
        let how = Repeat {
            layer: Some(layer),
            interval,
        };
        self.repeat(&self.short, &how, name)
    }

    fn middle(&self, strategy: &str, expected: &BTreeMap<String, PathBuf>, run: &Repeated) -> Cell {
        if let Some(status) = &run.ended.wrong {
            return Cell::bad(status.clone());
        }
        if expected.is_empty() {
            return Cell::bad("no frame is the same twice without the layer");
        }
        let gate = match strategy {
            "replay" => Gate::EQUAL,
            _ => Gate::DESIGN,
        };
        let mut tally = Tally::default();
        for (name, path) in expected {
            let Some(other) = run.pictures.get(name) else {
                tally.missing(name);
                continue;
            };
            let label = format!("{}-{strategy}", self.program.name);
            tally.compare(&rgb(path), &rgb(other), gate, &label);
        }
        let seen = |path: &PathBuf| {
            let picture = rgb(path);
            let first = *picture.get_pixel(0, 0);
            picture.pixels().any(|pixel| *pixel != first)
        };
        if !expected.values().any(seen) {
            return Cell::bad("nothing to be seen in these frames");
        }
        tally.cell()
    }

    fn outer(&self) -> Cell {
        let pictures = |name: &str| -> BTreeMap<_, _> {
            let entries = fs::read_dir(self.folder.join(name));
            let entries = entries.expect("a folder").flatten();
            entries
                .filter(|entry| entry.path().extension().is_some_and(|e| e == "png"))
                .map(|entry| {
                    (
                        entry.file_name().to_string_lossy().into_owned(),
                        entry.path(),
                    )
                })
                .collect()
        };
        let (expected, actual) = (pictures("7-layers"), pictures("7-geometry"));
        if expected.is_empty() {
            return Cell::bad("no pictures captured");
        }
        let mut tally = Tally::default();
        for (name, path) in &expected {
            let Some(other) = actual.get(name) else {
                tally.missing(name);
                continue;
            };
            let (expected, actual) = (rgb(path), rgb(other));
            for view in [0, ODD - 1] {
                let label = format!("{}-view{view}", self.program.name);
                tally.compare(
                    &tile(&expected, view),
                    &tile(&actual, view),
                    Gate::DESIGN,
                    &label,
                );
            }
        }
        tally.cell()
    }

    fn live(&self) -> Cell {
        let report = self.folder.join("live.json");
        let _ = fs::remove_file(&report);
        let variables = [
            ("VIEWS", "8"),
            ("STRATEGY", "geometry"),
            ("REPORT", report.to_str().expect("UTF-8")),
        ];
        let ended = live(
            self.program,
            &variables,
            self.program.seconds.max(LIVE_SECONDS),
            self.screen,
            self.folder,
        );
        let text = fs::read_to_string(&report).unwrap_or_default();
        let report: Value = serde_json::from_str(&text).unwrap_or_default();
        let frames = report["frames"].as_u64().unwrap_or(0);
        match ended.wrong {
            Some(status) => Cell::bad(format!("{status} after {frames} frames")),
            None if frames == 0 => Cell::bad("no frame"),
            None => Cell::good(format!("{frames} frames")),
        }
    }
}

/// Comparisons of one column.
#[derive(Default)]
struct Tally {
    pictures: u64,
    failed: u64,
    /// Of all pictures, the largest fraction of pixels that differ.
    most: f64,
    first: Option<String>,
}

impl Tally {
    fn fail(&mut self, text: String) {
        self.failed += 1;
        self.first.get_or_insert(text);
    }

    fn missing(&mut self, name: &str) {
        self.pictures += 1;
        self.fail(format!("no picture {name}"));
    }

    /// The first that fails is kept as a triptych in target/programs.
    fn compare(&mut self, expected: &RgbImage, actual: &RgbImage, gate: Gate, label: &str) {
        self.pictures += 1;
        let failure = match Comparison::new(expected, actual, None) {
            Err(error) => error.to_string(),
            Ok(comparison) => {
                self.most = self.most.max(comparison.differing_fraction());
                match gate.check(&comparison) {
                    Ok(()) => return,
                    Err(error) => error.to_string(),
                }
            }
        };
        if self.first.is_none() {
            let path = scratch("programs").join(format!("{label}.png"));
            triptych(expected, actual).save(path).expect("written");
        }
        self.fail(failure);
    }

    fn cell(self) -> Cell {
        let Self {
            pictures, failed, ..
        } = self;
        match self.first {
            Some(first) => Cell::bad(format!("{failed} of {pictures}: {first}")),
            None if self.most == 0.0 => Cell::good(format!("{pictures} equal")),
            None => Cell::good(format!("{pictures} within {:.4} %", 100.0 * self.most)),
        }
    }
}

fn cell(wrong: Vec<String>, good: &str) -> Cell {
    match wrong.is_empty() {
        true => Cell::good(good),
        false => Cell::bad(wrong.join("; ")),
    }
}

fn same_bytes(a: &Path, b: &Path) -> bool {
    fs::read(a).expect("a picture") == fs::read(b).expect("a picture")
}

/// One view of a picture of all, which stand in one row.
fn tile(all: &RgbImage, view: u32) -> RgbImage {
    let width = all.width() / ODD;
    image::imageops::crop_imm(all, view * width, 0, width, all.height()).to_image()
}

/// Names and numbers of a JSON object.
fn numbers(object: &Value) -> impl Iterator<Item = (&str, u64)> {
    let entries = object.as_object().into_iter().flatten();
    entries.filter_map(|(name, value)| Some((name.as_str(), value.as_u64()?)))
}

fn draws_in_words(report: &Value) -> String {
    let mut draws: Vec<_> = numbers(&report["draws"]).collect();
    draws.sort_by_key(|&(_, n)| std::cmp::Reverse(n));
    let mut text: Vec<_> = draws
        .iter()
        .map(|(name, n)| format!("{name} {n}"))
        .collect();
    let mut reasons: Vec<_> = numbers(&report["fallbacks"]).collect();
    reasons.sort_by_key(|&(_, n)| std::cmp::Reverse(n));
    if !reasons.is_empty() {
        let reasons: Vec<_> = reasons
            .iter()
            .take(3)
            .map(|(name, n)| format!("{name} {n}"))
            .collect();
        text.push(format!("({})", reasons.join(", ")));
    }
    text.join(", ").replace(", (", " (").replace('|', "/")
}
