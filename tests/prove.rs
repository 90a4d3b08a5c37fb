//! `--prove`: equal frames are reported as equal, a difference is reported with the draw that caused it, and the program notices nothing.

use crate::support::{Compiled, compiled, demo, layered, library, manyview, run, screen, succeed};
use manyview::report::{Culprit, Summary};
use serde_json::Value;
use std::path::{Path, PathBuf};

fn json(path: &Path) -> Value {
    let text = std::fs::read_to_string(path).expect("a report");
    serde_json::from_str(&text).expect("JSON")
}

fn summary(report: &Path) -> Summary {
    serde_json::from_value(json(report)["proof"].clone()).expect("a proof")
}

/// A demo under `manyview run --prove 5`: the summary of the report, and stderr.
fn proved(name: &str, options: &[&str], arguments: &[&str]) -> (Summary, String) {
    library();
    let folder = tempfile::tempdir().expect("a folder");
    let report = folder.path().join("report.json");
    let screen = screen();
    let mut command = manyview();
    command
        .args(["run", "--views", "3", "--prove", "5", "--report"])
        .arg(&report)
        .args(options)
        .arg("--")
        .arg(demo(name))
        .args(["--size", "200x150", "--frames", "22"])
        .args(arguments);
    let output = succeed(screen.give(&mut command));
    let proof = summary(&report);
    let picture = proof.picture.as_ref().map(PathBuf::from);
    assert_eq!(picture.is_some(), proof.differing > 0, "{proof:?}");
    if let Some(picture) = picture {
        let triptych = image::open(picture).expect("a picture");
        assert_eq!(triptych.height(), 150);
    }
    (proof, String::from_utf8(output.stderr).expect("UTF-8"))
}

#[test]
fn replay_is_equal_to_itself() {
    for options in [&["--atlas", "layers"][..], &["--atlas", "side-by-side"]] {
        let strategy = [options, &["--strategy", "replay"]].concat();
        let (proof, said) = proved("mesh", &strategy, &["--triangles", "5000"]);
        assert_eq!((proof.frames, proof.verdict()), (4, "equal"), "{said}");
        assert_eq!(proof.views.len(), 3);
        assert!(proof.found().all(|found| found.differing == 0));
        assert_eq!(proof.panel.as_ref().map(|panel| panel.differing), Some(0));
        assert!(said.contains("4 frames compared"), "{said}");
        let speed_up = proof.speed_up.expect("frames between were timed");
        assert!(
            speed_up.times > 0.0 && speed_up.frames.iter().all(|&n| n > 4),
            "{speed_up:?}"
        );
        assert!(said.contains("speed-up over replay: "), "{said}");
    }
}

#[test]
fn instances_and_geometry_pass_the_gate() {
    for strategy in ["instanced", "geometry"] {
        let (proof, said) = proved("mesh", &["--strategy", strategy], &["--triangles", "5000"]);
        assert_eq!(proof.frames, 4);
        assert!(
            ["equal", "within the gate"].contains(&proof.verdict()),
            "{said}"
        );
    }
}

#[test]
fn smaller_views_are_told_to_differ() {
    let options = ["--view-scale", "0.5"];
    let (proof, said) = proved("mesh", &options, &["--triangles", "5000"]);
    assert_eq!(proof.verdict(), "beyond the gate", "{said}");
    let psnr = proof.psnr().expect("it differs");
    assert!((15.0..45.0).contains(&psnr), "{psnr} dB");
    assert!(proof.panel.is_some_and(|panel| panel.differing > 0));
    assert!(said.contains("came with draw 1: "), "{said}");
}

/// The report of the small program under some options.
fn small(options: &[(&str, &str)], arguments: &[&str]) -> Summary {
    let program = compiled("proof", Compiled::Program, &["-lEGL", "-lGL"]);
    let folder = tempfile::tempdir().expect("a folder");
    let report = folder.path().join("report.json");
    let path = report.to_string_lossy();
    let common = [("VIEWS", "3"), ("PROVE", "2"), ("REPORT", &*path)];
    let mut command = layered(&program, &[&common[..], options].concat());
    succeed(command.env_remove("DISPLAY").args(arguments));
    summary(&report)
}

#[test]
fn the_draw_that_brought_the_worst_pixel_is_named() {
    let proof = small(&[("VIEW_SCALE", "0.5")], &[]);
    assert_eq!((proof.frames, proof.differing), (8, 8), "{proof:?}");
    let Culprit {
        draw,
        kind,
        class,
        method,
        worst,
        ..
    } = proof.draw.expect("it was looked for");
    assert_eq!(
        (draw, &*kind, &*class, &*method),
        (2, "glBegin triangles", "scene", "replay")
    );
    assert!(worst.difference > 100 && worst.frame > 2, "{worst:?}");
}

#[test]
fn a_program_that_clears_nothing_is_compared_frame_by_frame() {
    let proof = small(&[], &["keeps"]);
    assert_eq!((proof.frames, proof.carried), (8, 8), "{proof:?}");
    assert_eq!(proof.verdict(), "equal");
    // Frames by replay start from the same content of the window, so the speed-up is measured.
    assert!(proof.speed_up.is_some(), "{proof:?}");
    let proof = small(&[("VIEW_SCALE", "0.5")], &["keeps"]);
    assert_eq!((proof.frames, proof.carried), (8, 8), "{proof:?}");
    // Tiles with fewer pixels than the window cannot take it over, so nothing is timed.
    assert!(proof.speed_up.is_none(), "{proof:?}");
}

#[test]
fn what_cannot_be_compared_is_told() {
    for (name, why) in [
        ("blur", "the accumulation buffer"),
        ("echo", "a texture copied from the frame"),
        ("lists", "while it compiles a display list"),
    ] {
        let (proof, said) = proved(name, &[], &[]);
        assert_eq!((proof.frames, proof.verdict()), (0, "not proved"));
        let told = proof.skipped.keys().any(|reason| reason.contains(why));
        assert!(told && said.contains(why), "{said}");
    }
}

#[test]
fn a_program_reads_the_same_in_frames_that_are_proved() {
    let answers = |options: &[(&str, &str)]| {
        let screen = screen();
        let common = [("VIEWS", "3"), ("STRATEGY", "geometry")];
        let mut command = layered(demo("readback"), &[&common[..], options].concat());
        let output = succeed(screen.give(command.args(["--frames", "3"])));
        let text = String::from_utf8(output.stdout).expect("text");
        // The second atlas takes names of its own, so the program is given others.
        let names = [
            "name = ",
            "BINDING_2D[0] = ",
            "_FRAMEBUFFER_BINDING[0] = ",
            "0x8cd1 = ",
        ];
        let lines = text.lines();
        let lines = lines.filter(|line| !names.iter().any(|part| line.contains(part)));
        lines.map(str::to_owned).collect::<Vec<_>>()
    };
    let (without, with) = (answers(&[]), answers(&[("PROVE", "1")]));
    assert!(without.len() > 1200, "{} lines", without.len());
    let differing = without.iter().zip(&with).find(|(a, b)| a != b);
    assert_eq!((without.len(), differing), (with.len(), None));
}

#[test]
fn bench_proves_a_program_under_each_configuration() {
    library();
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str| folder.path().join(name);
    let screen = screen();
    let mut command = manyview();
    command
        .args(["bench", "--views", "8", "--frames", "2", "--json"])
        .arg(file("b.json"))
        .arg("--csv")
        .arg(file("b.csv"))
        .arg("--")
        .arg(demo("mesh"))
        .args(["--size", "96x64", "--triangles", "1000"]);
    let output = succeed(screen.give(&mut command));
    let table = String::from_utf8(output.stdout).expect("UTF-8");
    let proofs = json(&file("b.json"));
    let rows = proofs["rows"].as_array().expect("rows");
    let names: Vec<_> = rows.iter().map(|row| &row["configuration"]).collect();
    let configurations = ["replay", "instanced", "geometry", "replay at auto"];
    assert_eq!(names, configurations);
    for row in rows {
        assert!(row["proof"]["frames"].as_u64() >= Some(2), "{row}");
        assert!(row["proof"]["speed_up"]["times"].is_number(), "{row}");
        let name = row["configuration"].as_str().expect("a name");
        assert!(table.contains(name), "{table}");
    }
    assert_eq!(rows[0]["verdict"], "equal", "{table}");
    assert_eq!(rows[3]["verdict"], "beyond the gate", "{table}");
    let csv = std::fs::read_to_string(file("b.csv")).expect("written");
    assert_eq!(csv.lines().count(), 5, "{csv}");
    let head = csv.lines().next().expect("a head");
    assert!(
        head.contains("speed_up") && head.contains("verdict"),
        "{head}"
    );
}

#[test]
fn bench_says_when_nothing_was_proved() {
    library();
    let screen = screen();
    let mut command = manyview();
    command.args(["bench", "--strategy", "replay", "--", "true"]);
    let (status, stdout, stderr) = run(screen.give(&mut command));
    assert_eq!((status, &*stdout), (4, ""), "{stderr}");
    assert!(stderr.contains("it ended with status 0 before a frame was proved"));
}
