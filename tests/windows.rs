//! Programs for Windows under Wine, of both classes: each view is what the program itself draws with that view's projection. `make test-wine`, which installs Wine and a
//! cross compiler.

use crate::support::{
    Screen, manyview, own_screen, rgb, scratch, sized_screen, succeed, target_folder,
};
use image::{RgbImage, imageops};
use manyview::metric::{Comparison, Gate};
use std::path::Path;
use std::process::Command;
use tempfile::tempdir;

const VIEWS: u32 = 3;
const CAMERAS: [&str; 4] = ["--separation", "0.2", "--convergence", "4"];
/// Each program with its options.
const SCENES: [(&str, &[&str]); 20] = [
    ("wgl", &[]),
    ("d3d3", &[]),
    ("d3d3", &["--software"]),
    ("d3d3", &["--execute"]),
    ("d3d3", &["--full"]),
    ("d3d7", &[]),
    ("d3d7", &["--software"]),
    ("d3d7", &["--full"]),
    ("d3d7", &["--software", "--full"]),
    ("d3d8", &[]),
    ("d3d8", &["--shader", "rows"]),
    ("d3d8", &["--shader", "columns", "--offset", "7"]),
    ("d3d9", &[]),
    ("d3d9", &["--shader", "rows", "--offset", "3"]),
    ("d3d9", &["--shader", "columns"]),
    ("d3d9", &["--shader", "indexed", "--offset", "50"]),
    ("d3d10", &["--shader", "rows"]),
    ("d3d10", &["--shader", "columns", "--offset", "7"]),
    ("d3d11", &["--shader", "rows", "--offset", "3"]),
    ("d3d11", &["--shader", "columns"]),
];

/// Wine with its files in a folder of their own, so that nothing is changed of the user's.
fn in_wine<'a>(command: &'a mut Command, screen: &Screen) -> &'a mut Command {
    let prefix = std::path::absolute(scratch("wine")).expect("a path");
    let variables = [
        ("WINEDEBUG", "-all"),
        // Wine asks whether it is to download these.
        ("WINEDLLOVERRIDES", "mscoree=;mshtml="),
    ];
    screen
        .give(command)
        .env("WINEPREFIX", prefix)
        .envs(variables)
}

/// Frame 5 of a program, by `manyview capture`.
fn captured(screen: &Screen, out: &Path, layer: &[&str], program: &[&str]) -> RgbImage {
    let mut command = manyview();
    command.args(["capture", "--frame", "5", "--out"]).arg(out);
    command.args(layer).arg("--").arg("wine").args(program);
    command.args(["--frames", "6"]);
    succeed(in_wine(&mut command, screen));
    rgb(out)
}

#[test]
#[ignore = "Wine: make test-wine"]
fn wine_programs_have_the_views_that_they_draw_themselves() {
    // Xvfb has one mode, which the programs that have the screen for themselves ask for.
    let screen = sized_screen((320, 240));
    let folder = tempdir().expect("a folder");
    let out = folder.path().join("picture.png");
    for class in ["64", "32"] {
        for (name, options) in SCENES {
            let path = target_folder().with_file_name("windows").join(class);
            let path = path.join(name).with_extension("exe");
            assert!(path.is_file(), "{}: run `make test-wine`", path.display());
            let path = path.to_string_lossy();
            let program = [&[&*path], options].concat();
            let told = folder
                .path()
                .join("report.json")
                .to_string_lossy()
                .into_owned();
            let views = VIEWS.to_string();
            let layer = ["--views", &views, "--what", "atlas", "--strategy", "replay"];
            let layer = [&layer[..], &CAMERAS, &["--report", &*told]].concat();
            let all = captured(&screen, &out, &layer, &program);
            let width = all.width() / VIEWS;
            let text = std::fs::read_to_string(&told).expect("a report");
            let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
            assert_eq!(report["gl_errors"], 0, "{class} {program:?}");
            let mut shown = Vec::new();
            for view in 0..VIEWS {
                let place = format!("{view}/{VIEWS}");
                let itself = [&program, &["--view", &place][..], &CAMERAS].concat();
                let own = captured(&screen, &out, &["--views", "1"], &itself);
                let tile =
                    imageops::crop_imm(&all, view * width, 0, width, all.height()).to_image();
                let compared = Comparison::new(&own, &tile, None).expect("one size");
                assert!(
                    Gate::DESIGN.check(&compared).is_ok(),
                    "view {view} of {class} {program:?}: {compared:?}"
                );
                shown.push(tile);
            }
            assert!(shown[0] != shown[1], "{class} {program:?} is flat");
        }
    }
}

/// The cameras that follow the depths, without any option.
#[test]
#[ignore = "Wine: make test-wine"]
fn wine_shaders_have_the_depth_of_fixed_function() {
    let screen = own_screen();
    let folder = tempdir().expect("a folder");
    let path = folder.path().join("report.json");
    let extent = |class: &str, options: &[&str]| {
        let program = target_folder().with_file_name("windows").join(class);
        let mut command = manyview();
        command.args(["run", "--views", "8", "--report"]).arg(&path);
        command.args(["--", "wine"]).arg(program.join("d3d9.exe"));
        command.args(["--frames", "60"]).args(options);
        // Tests place cameras once, unless this is what they test.
        command.env_remove("MANYVIEW_AUTO_DEPTH");
        // Wine itself sometimes ends with a signal after the last frame.
        let _ = in_wine(&mut command, &screen).output().expect("it starts");
        let text = std::fs::read_to_string(&path).expect("a report");
        let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        let budget = report["disparity"]["budget_px"].as_f64().expect("a budget");
        let end = |name: &str| report["disparity"]["px"][name].as_f64().expect("a number");
        let ends = [end("min"), end("max")];
        assert!(
            ends[0] < 0.0 && ends[1] > 0.0 && ends[1] <= budget,
            "{ends:?}"
        );
        ends
    };
    for class in ["64", "32"] {
        let fixed = extent(class, &[]);
        for options in [&["--shader", "rows"][..], &["--shader", "columns"]] {
            let shader = extent(class, options);
            let off = [0, 1].map(|at| (shader[at] - fixed[at]).abs());
            assert!(off[0].max(off[1]) < 0.05, "{fixed:?} and {shader:?}");
        }
    }
}
