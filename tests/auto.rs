//! `--strategy auto`: the report names the outcome, the next run takes it from the cache, and the search changes no picture.

use crate::support::{demo, layered, manyview, rgb, screen, succeed};
use serde_json::Value;
use std::path::Path;

/// Enough frames to find an outcome (12 before the search, then four turns of four frames by each of three strategies), and for the report,
/// which is written ten times a second, to contain it.
const FRAMES: &str = "600";

/// The report of a demo whose outcomes are kept in a folder.
fn report(cache: &Path, demo_name: &str, arguments: &[&str]) -> Value {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("report.json");
    let options = [
        ("VIEWS", "5"),
        ("STRATEGY", "auto"),
        ("REPORT", path.to_str().expect("UTF-8")),
    ];
    let mut command = layered(demo(demo_name), &options);
    command.env("XDG_CACHE_HOME", cache).args(arguments);
    succeed(screen().give(command.args(["--frames", FRAMES, "--size", "64x48"])));
    let text = std::fs::read_to_string(&path).expect("a report");
    serde_json::from_str(&text).expect("JSON")
}

fn found(report: &Value) -> Option<String> {
    let notes = report["notes"].as_array().expect("notes").iter();
    let notes = notes.map(|note| note.as_str().expect("text"));
    let mut found = notes.filter_map(|note| note.strip_prefix("auto: "));
    found
        .next()
        .map(|note| note.split(' ').next().expect("a word").to_owned())
}

#[test]
fn what_is_found_is_taken_the_next_time() {
    let cache = tempfile::tempdir().expect("a folder");
    let first = report(cache.path(), "arrays", &["--many", "100"]);
    let strategy = found(&first).expect("an outcome");
    let tried = first["draws"].as_object().expect("draws");
    assert!(
        tried.contains_key("instanced") && tried.contains_key("replay"),
        "{tried:?}"
    );
    let file = cache.path().join("manyview/strategies.json");
    let kept = std::fs::read_to_string(&file).expect("outcomes");
    let kept: Value = serde_json::from_str(&kept).expect("JSON");
    let kept = kept.as_object().expect("outcomes by key");
    assert_eq!(
        kept.values().collect::<Vec<_>>(),
        [&Value::from(strategy.as_str())]
    );
    let key = kept.keys().next().expect("a key");
    assert!(key.contains("arrays") && key.contains("5 views"), "{key}");

    // A cached outcome is taken as it is, even another one: nothing is tried.
    let other = if strategy == "instanced" {
        "replay"
    } else {
        "instanced"
    };
    let text = Value::from_iter([(key.clone(), other)]).to_string();
    std::fs::write(&file, text).expect("a file");
    let second = report(cache.path(), "arrays", &["--many", "100"]);
    assert_eq!(found(&second), None);
    let drawn = second["draws"].as_object().expect("draws");
    assert_eq!(
        drawn.contains_key("instanced"),
        other == "instanced",
        "{drawn:?}"
    );
    assert!(!drawn.contains_key("geometry"), "{drawn:?}");
}

#[test]
fn outcomes_that_cannot_be_read_are_found_anew() {
    let cache = tempfile::tempdir().expect("a folder");
    let folder = cache.path().join("manyview");
    std::fs::create_dir(&folder).expect("a folder");
    for spoilt in ["", "{", "[1]", "{\"a\": 1}"] {
        std::fs::write(folder.join("strategies.json"), spoilt).expect("a file");
        assert!(
            found(&report(cache.path(), "gears", &[])).is_some(),
            "{spoilt}"
        );
    }
    // Where outcomes cannot be written, nothing else happens.
    let nowhere = Path::new("/proc/no-such-folder");
    assert!(found(&report(nowhere, "gears", &[])).is_some());
}

/// Captures have to be the same in each run, so they are replayed, whatever outcome is cached.
#[test]
fn captures_are_replayed() {
    let cache = tempfile::tempdir().expect("a folder");
    let picture = |strategy: &str| {
        let out = cache.path().join(format!("{strategy}.png"));
        let mut command = manyview();
        command.env("XDG_CACHE_HOME", cache.path());
        command.args([
            "capture",
            "--frame",
            "40",
            "--views",
            "5",
            "--strategy",
            strategy,
        ]);
        command.arg("--out").arg(&out).arg("--").arg(demo("mesh"));
        succeed(screen().give(command.args(["--size", "96x64"])));
        rgb(&out)
    };
    assert!(picture("auto") == picture("replay"));
}

/// A program that draws over its last picture does not see that the views lie elsewhere in the atlas.
#[test]
fn what_is_drawn_before_is_there_after_a_change() {
    let cache = tempfile::tempdir().expect("a folder");
    let folder = tempfile::tempdir().expect("a folder");
    let picture = |name: &str, options: &[(&str, &str)]| {
        let path = folder.path().join(name);
        let all = [&[("VIEWS", "5"), ("OUTPUT", "sbs")], options].concat();
        let mut command = layered(demo("echo"), &all);
        command
            .env("XDG_CACHE_HOME", cache.path())
            .args(["--frames", FRAMES, "--size", "160x120", "--dump"]);
        succeed(screen().give(command.arg(&path)));
        rgb(&path)
    };
    let (tried, replayed) = (
        picture("auto.png", &[("STRATEGY", "auto")]),
        picture("replay.png", &[("STRATEGY", "replay")]),
    );
    let compared = manyview::metric::Comparison::new(&replayed, &tried, None).expect("one size");
    // Instances and geometry shaders may differ by one step, and the echo keeps the difference.
    assert!(
        compared.over_eight == 0 && compared.psnr > 50.0,
        "{compared:?}"
    );
}
