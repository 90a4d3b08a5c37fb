//! Programs get OpenGL in many ways, on several threads and windows: each of their frames reads back as without the layer, and each is
//! drawn in several views.

use crate::support::{Compiled, bare, built, layered, own_screen, succeed};
use std::path::{Path, PathBuf};
use std::process::Command;

fn sources(names: &[&str]) -> Vec<PathBuf> {
    let path = |name| Path::new("tests/hosts").join(name).with_extension("c");
    names.iter().map(path).collect()
}

fn build(name: &str, parts: &[&str], kind: Compiled, libraries: &[&str]) -> PathBuf {
    let sources = sources(parts);
    let sources: Vec<&Path> = sources.iter().map(PathBuf::as_path).collect();
    built(name, &sources, kind, libraries)
}

/// Runs the host bare and under the layer. `plugin`: how the host opens its plugin, if it does. The report is that of the last context to
/// swap, and has `frames` frames.
fn same(what: &str, plugin: Option<&str>, frames: u64) {
    let screen = own_screen();
    let host = build(
        "host",
        &["host", "scene", "window"],
        Compiled::Program,
        &["-lGL", "-lEGL", "-lX11", "-lpthread", "-ldl"],
    );
    // A library that is bound when it is opened has a read-only table afterwards.
    let (name, binding) = match plugin {
        Some("deep") => ("plugin-now", "-Wl,-z,relro,-z,now"),
        _ => ("plugin", "-Wl,-z,lazy"),
    };
    let library = build(
        name,
        &["plugin", "scene", "window"],
        Compiled::Library,
        &["-lGL", "-lX11", binding],
    );
    let lines = |mut command: Command| {
        command.arg(what);
        if let Some(mode) = plugin {
            command.arg(&library).arg(mode);
        }
        let output = succeed(screen.give(&mut command));
        String::from_utf8(output.stdout).expect("text")
    };
    let expected = lines(bare(&host));
    assert!(expected.lines().count() >= 4, "{expected}");
    let folder = tempfile::tempdir().expect("a folder");
    let report = folder.path().join("report.json");
    let options = [
        ("VIEWS", "3"),
        ("STRATEGY", "replay"),
        ("REPORT", report.to_str().expect("UTF-8")),
    ];
    let actual = lines(layered(&host, &options));
    assert_eq!(expected, actual);
    let text = std::fs::read_to_string(&report).expect("the layer was there");
    let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(report["frames"], frames, "{report}");
    // A clear and a primitive for each line. With two windows or APIs, draws of the other context in the last frame do not count.
    let draws = report["draws"]["replay"].as_u64().unwrap_or(0);
    assert!(draws >= 8, "{report}");
    assert_eq!(report["gl_errors"], 0, "{report}");
}

#[test]
fn a_plugin_draws_in_the_context_of_its_host() {
    same("draws", Some("local"), 4);
}

#[test]
fn a_plugin_does_everything() {
    same("all", Some("local"), 4);
}

#[test]
fn a_plugin_bound_to_its_own_libraries_draws_in_the_context_of_its_host() {
    same("draws", Some("deep"), 4);
}

#[test]
fn a_plugin_bound_to_its_own_libraries_does_everything() {
    same("all", Some("deep"), 4);
}

#[test]
fn a_plugin_bound_to_its_own_libraries_call_by_call_does_everything() {
    same("all", Some("lazy"), 4);
}

#[test]
fn a_context_moves_between_threads() {
    same("threads", None, 4);
}

#[test]
fn two_windows_in_turn() {
    same("windows", None, 4);
}

#[test]
fn glx_and_egl_in_one_process() {
    same("both", None, 4);
}

#[test]
fn another_thread_moves_and_resizes_the_window() {
    same("moved", None, 8);
}
