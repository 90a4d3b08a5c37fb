//! The checks of one program.

use crate::programs::repeat::{Repeat, Repeated, errors, frames, live, record, repeat, trim};
use crate::programs::row::{Cell, Row};
use crate::programs::table::Program;
use crate::programs::tally::cell;
use crate::programs::variable;
use crate::support::Screen;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Pictures are compared in the first frames of a trace only, because this is slow; in all of it where input leads out of a menu.
const COMPARED: u64 = 120;
/// Least duration of a live run; otherwise as long as the recording.
const LIVE_SECONDS: u64 = 5;

/// Runs all checks. Every failure is in the row.
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
    // The picture columns come between those of the runs and of GL errors.
    row.cells.splice(1..1, bench.pictures());
    row.cells.push(bench.gain());
    row.cells.push(bench.live());
    for trace in ["short.trace", "fewer.trace"] {
        let _ = fs::remove_file(folder.join(trace));
    }
    row
}

/// Limits the frames, for a quick look at many programs.
fn most_frames() -> Option<u64> {
    variable("MANYVIEW_PROGRAMS_FRAMES").map(|n| n.parse().expect("a number of frames"))
}

pub(crate) struct Bench<'a> {
    pub(crate) program: &'a Program,
    screen: &'a Screen,
    pub(crate) folder: &'a Path,
    count: u64,
    pub(crate) compared: u64,
    trace: PathBuf,
    pub(crate) short: PathBuf,
}

impl Bench<'_> {
    pub(crate) fn repeat(&self, trace: &Path, how: &Repeat<'_>, name: &str) -> Repeated {
        repeat(
            self.program,
            trace,
            how,
            self.screen,
            &self.folder.join(name),
        )
    }

    /// A path below this program's folder, as the value of a variable.
    pub(crate) fn path(&self, name: &str) -> String {
        self.folder.join(name).display().to_string()
    }

    pub(crate) fn report(&self, name: &str) -> Option<Value> {
        let text = fs::read_to_string(self.folder.join(name).join("report.json")).ok()?;
        serde_json::from_str(&text).ok()
    }

    /// Strategies, in the order of the columns.
    pub(crate) fn strategies(&self) -> impl Iterator<Item = &'static str> {
        let instanced = self.program.own_shaders().then_some("instanced");
        let splats = self.program.points.then_some("splats");
        let always = ["replay", "auto", "geometry"].into_iter();
        always.chain(instanced).chain(splats)
    }

    /// Repeats all frames in 8 views; adds the cell of the runs, then the one of GL errors.
    fn all_frames(&self, row: &mut Row) {
        let bare = self.repeat(&self.trace, &Repeat::default(), "bare");
        let expected = errors(&bare.ended.said);
        let mut wrong = Vec::new();
        if let Some(status) = &bare.ended.wrong {
            wrong.push(format!("bare: {status}"));
        }
        let (mut raised, mut draws) = (Vec::new(), BTreeMap::new());
        for strategy in self.strategies() {
            let name = format!("8-{strategy}");
            let layer = vec![
                ("VIEWS", "8".to_owned()),
                ("STRATEGY", strategy.to_owned()),
                ("REPORT", self.path(&format!("{name}/report.json"))),
                // A picture for a person to look at; with it the report is written when the last frame is shown.
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
            // The last report of a program with several contexts may lag some frames behind.
            if report["frames"]
                .as_u64()
                .is_some_and(|n| n + 1 >= self.count)
            {
                draws.insert(strategy, sum);
            } else if sum == 0 {
                wrong.push(format!("{strategy}: nothing drawn"));
            }
            if strategy == self.program.fast() {
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

    /// Compares the times of frames under `splats` with those under `replay`, on a panel.
    fn gain(&self) -> Cell {
        if !self.program.points {
            return Cell::unasked();
        }
        let median = |strategy: &str| {
            let name = format!("panel-{strategy}");
            let layer = vec![
                ("VIEWS", "8".to_owned()),
                ("DISPLAY", "huebner8".to_owned()),
                ("VIEW_SCALE", "1".to_owned()),
                ("STRATEGY", strategy.to_owned()),
                ("REPORT", self.path(&format!("{name}/report.json"))),
            ];
            let how = Repeat {
                layer: Some(layer),
                interval: 0,
            };
            self.repeat(&self.trace, &how, &name);
            let median = self.report(&name)?["frame_ms"]["median"].as_f64();
            median.filter(|&median| median > 0.0)
        };
        match (median("replay"), median("splats")) {
            (Some(replay), Some(splats)) => Cell::good(format!(
                "{:.2} ({splats:.0} for {replay:.0} ms)",
                replay / splats
            )),
            _ => Cell::bad("no times of frames"),
        }
    }

    fn live(&self) -> Cell {
        let report = self.folder.join("live.json");
        let _ = fs::remove_file(&report);
        let variables = [
            ("VIEWS", "8"),
            ("STRATEGY", self.program.fast()),
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
