//! `--auto-depth` on games: the disparities of every frame, from the report (tests/comfort.rs tests the report).

use crate::programs::repeat::{Repeat, record, repeat};
use crate::programs::table::Program;
use crate::support::{Screen, scratch};
use serde_json::Value;
use std::fs;

/// Games that write depths: trails in an arena, a ball on a track, towers.
pub(crate) const GAMES: [&str; 3] = ["gltron", "antigrav", "criticalmass"];

/// Repeats a game in 8 views and returns its failures; a game that is not installed has none.
pub(crate) fn judge(program: &Program, screen: &Screen) -> Option<String> {
    let name = &program.name;
    let folder = scratch("programs").join(name);
    fs::create_dir_all(&folder).expect("a folder");
    let trace = match record(program, screen, &folder) {
        Ok(trace) => trace,
        Err(why) => {
            eprintln!("skipped: {name}: {why}");
            return None;
        }
    };
    let report = folder.join("depth.json");
    let how = Repeat {
        layer: Some(vec![
            ("VIEWS", "8".to_owned()),
            ("AUTO_DEPTH", "1".to_owned()),
            ("REPORT", report.display().to_string()),
        ]),
        interval: 0,
    };
    let ended = repeat(program, &trace, &how, screen, &folder.join("8-depth")).ended;
    if let Some(wrong) = ended.wrong {
        return Some(format!("{name}: {wrong}"));
    }
    let text = fs::read_to_string(&report).expect("a report");
    let json: Value = serde_json::from_str(&text).expect("JSON");
    let about = &json["disparity"];
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let (frames, over) = (
        number(&about["frames"]),
        number(&about["frames_over_budget"]),
    );
    let told = format!(
        "{name}: {frames} frames, {over} over the budget of {:.2} px; disparities {}, change from frame to frame {}",
        number(&about["budget_px"]),
        about["px"],
        about["change_px"]
    );
    eprintln!("{told}");
    // A run without frames or figures fails as well.
    let good = frames >= 300.0 && over == 0.0 && number(&about["change_px"]["p95"]) <= 0.1;
    (!good).then_some(told)
}
