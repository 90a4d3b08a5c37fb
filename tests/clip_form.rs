//! Programs that have no matrix for their camera: their views are shifted by the w of their vertices.

use crate::support::{bare, demo, manyview, rgb, screen, succeed};
use image::imageops;
use manyview::metric::{Comparison, Gate};
use tempfile::tempdir;

const VIEWS: u32 = 5;
const SIZE: [u32; 2] = [300, 220];
const SPACING: f64 = 0.3;
const FOCAL: f64 = 8.0;
/// The first frame is the one in which w is measured.
const FRAME: u32 = 3;

/// A program, in numbers and vectors.
const APART: [&str; 5] = ["--apart", "--size", "300x220", "--frames", "4"];

#[test]
fn views_are_those_that_the_program_draws_itself() {
    let folder = tempdir().expect("a folder");
    let [all, report] = ["all.png", "report.json"].map(|name| folder.path().join(name));
    // A of the demo's camera, whose angle is 40 degrees: the program has no matrix that tells it.
    let [width, height] = SIZE.map(f64::from);
    let a = height / width / 20.0_f64.to_radians().tan();
    let separation = (a * SPACING / FOCAL).to_string();
    for strategy in ["replay", "instanced"] {
        let mut command = manyview();
        command.args(["capture", "--frame", &FRAME.to_string(), "--out"]);
        command.arg(&all).args(["--views", &VIEWS.to_string()]);
        command.args(["--what", "atlas", "--strategy", strategy]);
        command.args(["--separation", &separation]);
        command.args(["--convergence", &FOCAL.to_string()]);
        command.arg("--report").arg(&report);
        command.arg("--").arg(demo("shade")).args(APART);
        succeed(screen().give(&mut command));
        let told: serde_json::Value =
            serde_json::from_slice(&std::fs::read(&report).expect("a report")).expect("JSON");
        assert_eq!(told["gl_errors"], 0, "{strategy}");
        let notes = told["notes"].to_string();
        assert!(notes.contains("by the w of its vertices"), "{notes}");
        let all = rgb(&all);
        let mut shown = Vec::new();
        for view in 0..VIEWS {
            let out = folder.path().join("own-%d.png");
            let mut itself = bare(demo("shade"));
            itself.args(APART).arg("--dump").arg(&out);
            itself.args(["--view", &format!("{view}/{VIEWS}")]);
            itself.args(["--eye-spacing", &SPACING.to_string()]);
            itself.args(["--focal-depth", &FOCAL.to_string()]);
            succeed(screen().give(&mut itself));
            let own = rgb(&folder.path().join(format!("own-{}.png", FRAME - 1)));
            let tile = imageops::crop_imm(&all, view * SIZE[0], 0, SIZE[0], SIZE[1]).to_image();
            let compared = Comparison::new(&own, &tile, None).expect("one size");
            assert!(
                Gate::DESIGN.check(&compared).is_ok(),
                "view {view} by {strategy}: {compared:?}"
            );
            shown.push(tile);
        }
        assert!(shown[0] != shown[1], "{strategy} is flat");
    }
}

/// Where w does not vary, there is nothing to shift by, which is told after some measurements.
#[test]
fn a_program_without_a_perspective_stays_flat() {
    let folder = tempdir().expect("a folder");
    let [out, report] = ["view.png", "report.json"].map(|name| folder.path().join(name));
    let pictures = [0, 2].map(|view| {
        let mut command = manyview();
        command
            .args(["capture", "--frame", "10", "--out"])
            .arg(&out);
        command.args(["--views", "3", "--what", &format!("view:{view}")]);
        command.args([
            "--atlas",
            "layers",
            "--separation",
            "0.1",
            "--convergence",
            "4",
        ]);
        command.arg("--report").arg(&report);
        command.arg("--").arg(demo("shade")).args(&APART[..3]);
        succeed(screen().give(command.args(["--frames", "11", "--orthographic"])));
        let told = std::fs::read_to_string(&report).expect("a report");
        assert!(
            told.contains("what they draw is the same in all views"),
            "{told}"
        );
        rgb(&out)
    });
    assert!(pictures[0] == pictures[1]);
}
