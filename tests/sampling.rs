//! Views with fewer pixels: the picture of a panel against that of views at the size of the window, and programs that a smaller tile cannot
//! hold.

use crate::support::share;
use crate::support::{demo, manyview, rgb, screen, succeed};
use image::RgbImage;
use manyview::metric::Comparison;
use serde_json::Value;

/// A frame through a panel, and the notes of the report.
fn picture(name: &str, scale: &str, options: &[&str]) -> (RgbImage, Vec<String>) {
    let folder = tempfile::tempdir().expect("a folder");
    let (out, report) = (
        folder.path().join("out.png"),
        folder.path().join("report.json"),
    );
    let mut command = manyview();
    command.args(["capture", "--frame", "10", "--view-scale", scale]);
    command.arg("--out").arg(&out).arg("--report").arg(&report);
    command.args(options).arg("--").arg(demo(name));
    succeed(screen().give(command.args(["--size", "480x360"])));
    let report: Value =
        serde_json::from_str(&std::fs::read_to_string(&report).expect("a report")).expect("JSON");
    let notes = report["notes"].as_array().expect("notes").iter();
    let notes = notes.map(|note| note.as_str().expect("text").to_owned());
    (rgb(&out), notes.collect())
}

/// PSNR in dB against views at the size of the window.
#[track_caller]
fn decibels(name: &str, scale: &str, options: &[&str]) -> f64 {
    let (exact, of_driver) = picture(name, "1", options);
    let (coarse, notes) = picture(name, scale, options);
    assert_eq!(notes, of_driver, "{name}: nothing is given up");
    let compared = Comparison::new(&exact, &coarse, None).expect("one size");
    println!(
        "{name} {scale} {options:?}: {:.1} dB, SSIM {:.4}, {:.2} % of the subpixels",
        compared.psnr,
        compared.ssim,
        compared.wrong_subpixels_percent()
    );
    compared.psnr
}

const LENTICULAR: [&str; 4] = ["--display", "lenticular-8", "--views", "8"];
const SLANTED: [&str; 4] = ["--display", "slanted8", "--views", "8"];

/// Every column of the window is a column of some tile: only edges differ, whose corners round to parts of larger pixels.
#[test]
fn whole_pixels_are_drawn_where_the_panel_shows_them() {
    for name in ["gears", "mesh"] {
        let least = decibels(name, "auto", &LENTICULAR);
        assert!(least >= 45.0, "{name}: {least} dB");
    }
    for output in ["columns", "rows"] {
        let options = ["--views", "2", "--output", output];
        let least = decibels("gears", "auto", &options);
        assert!(least >= 45.0, "{output}: {least} dB");
    }
}

#[test]
fn textures_keep_their_level_of_detail() {
    for name in ["teapot", "mirror", "fogtexgen"] {
        let least = decibels(name, "auto", &LENTICULAR);
        assert!(least >= 36.0, "{name}: {least} dB");
    }
}

/// Instances shift all views by one viewport, and take the level of detail from the window's own gradients.
#[test]
fn instances_reach_the_same_columns() {
    for display in [LENTICULAR, SLANTED] {
        let options = [&display[..], &["--strategy", "instanced"]].concat();
        let demos = [("teapot", 36.0), ("mesh", 45.0)];
        for (name, least) in demos.into_iter().step_by(share::every(2)) {
            let least = if display == SLANTED { 32.0 } else { least };
            let got = decibels(name, "auto", &options);
            assert!(got >= least, "{name}: {got} dB");
        }
    }
    let options = [&SLANTED[..], &["--strategy", "instanced"]].concat();
    let fewer = decibels("teapot", "0.612", &options);
    assert!(fewer >= 30.0, "{fewer} dB");
}

/// Both have nine fortieths of the pixels; columns that follow the lens sheet keep more of the picture than pixels that are simply fewer.
#[test]
fn a_lens_sheet_is_better_served_by_its_lenses() {
    for name in ["teapot", "gears", "clip"]
        .into_iter()
        .step_by(share::every(2))
    {
        let lenses = decibels(name, "auto", &SLANTED);
        let fewer = decibels(name, "0.474", &SLANTED);
        assert!(lenses >= 32.0, "{name}: {lenses} dB");
        assert!(lenses > fewer, "{name}: {lenses} dB, {fewer} dB");
    }
}

/// Sizes in pixels are drawn in fewer pixels, or at the window's own resolution where that is impossible.
#[test]
fn what_a_tile_cannot_hold_is_given_up_in_time() {
    for (name, scale, part) in [
        ("sky", "auto", "draws lines or points"),
        ("blur", "0.5", "uses the accumulation buffer"),
        ("lists", "auto", "draws pixels or bitmaps"),
        ("points", "0.5", "draws stippled polygons"),
        ("readback", "0.5", "copies pictures into the window"),
    ]
    .into_iter()
    .step_by(share::every(2))
    {
        let (exact, _) = picture(name, "1", &SLANTED);
        let (coarse, notes) = picture(name, scale, &SLANTED);
        assert!(
            notes.iter().any(|note| note.contains(part)),
            "{name}: {notes:?}"
        );
        let full = notes
            .iter()
            .any(|note| note.contains("at the size of the window"));
        if full {
            assert!(exact == coarse, "{name} differs");
        } else {
            let psnr = Comparison::new(&exact, &coarse, None)
                .expect("one size")
                .psnr;
            assert!(psnr > 28.0, "{name}: {psnr} dB");
        }
    }
}

/// The program reads its own state between its calls: viewport, widths, level of detail and matrices. Only pixels that it reads back
/// differ.
#[test]
fn the_state_of_the_program_is_its_own() {
    let answers = |scale: &str| {
        let mut command = manyview();
        command.args(["run", "--views", "8", "--display", "lenticular-8"]);
        command
            .args(["--view-scale", scale, "--"])
            .arg(demo("readback"));
        let output = succeed(screen().give(command.args(["--frames", "1"])));
        String::from_utf8(output.stdout).expect("text")
    };
    let (exact, coarse) = (answers("1"), answers("auto"));
    // Pixels are printed as hashes.
    let hash = |line: &str| {
        let value = line.rsplit(" = ").next().unwrap_or_default();
        value.len() == 16 && value.bytes().all(|b| b.is_ascii_hexdigit())
    };
    let state = exact.lines().filter(|line| !hash(line));
    assert!(state.count() > 20);
    let other: Vec<_> = exact
        .lines()
        .zip(coarse.lines())
        .filter(|(a, b)| a != b && !(hash(a) && hash(b)))
        .collect();
    assert_eq!(exact.lines().count(), coarse.lines().count());
    assert!(other.is_empty(), "{other:#?}");
}
