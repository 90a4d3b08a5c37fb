//! Programs with framebuffers of their own: their state reads back the same under the layer, passes that are the same in all views are
//! drawn once, and the others have the parallax of each view. (Pictures of whole scenes: tests/oracle.rs.)

use crate::support::views::{REPLAYED, VIEWS, Views, extents};
use crate::support::{Compiled, bare, compiled, demo, layered, lines, screen, succeed};

#[test]
fn a_program_knows_of_its_framebuffers_what_it_knows_without_the_layer() {
    let program = compiled("offscreen", Compiled::Program, &["-lEGL", "-lGL"]);
    // Before OpenGL 4.3 a layer of an array cannot be a texture of its own.
    let old = Some(("MESA_GL_VERSION_OVERRIDE", "4.2COMPAT"));
    for (atlas, driver) in [("side-by-side", None), ("layers", None), ("layers", old)] {
        let expected = lines(bare(&program).envs(driver));
        assert!(expected.contains("shown: bound 0 0"), "{expected}");
        let views = Views { atlas, ..REPLAYED };
        let (told, all) = views.shown(layered(&program, &[]).envs(driver));
        for (told, expected) in told.lines().zip(expected.lines()) {
            assert_eq!(told, expected, "{atlas}");
        }
        assert_eq!(told.lines().count(), expected.lines().count());
        let [left, own, right] = extents(&all, [255, 0, 255]);
        // At depth 3, moved by ±0.4 · (3 − 4) / 3 in 32 columns, blitted to 64: to the right for the left camera.
        for (moved, shift) in [(left[0] - own[0], 4.3), (right[1] - own[1], -4.3)] {
            assert!(
                (moved - shift).abs() <= 2.0,
                "{atlas}: {left:?} {own:?} {right:?}"
            );
        }
    }
}

/// Counts of draws in some frames: those that went to the driver once, unchanged, and those that were replayed.
fn draws(frames: &str, arguments: &[&str]) -> [u64; 2] {
    let folder = tempfile::tempdir().expect("a folder");
    let report = folder.path().join("report.json");
    let options = [
        ("VIEWS", "3"),
        ("STRATEGY", "replay"),
        ("REPORT", report.to_str().expect("UTF-8")),
    ];
    let mut program = layered(demo("passes"), &options);
    let screen = screen();
    succeed(
        screen.give(
            program
                .args(["--frames", frames, "--check"])
                .args(arguments),
        ),
    );
    let text = std::fs::read_to_string(&report).expect("a report");
    let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    ["once", "replay"].map(|way| report["draws"][way].as_u64().expect("a number"))
}

#[test]
fn what_is_computed_of_a_scene_is_computed_for_each_view() {
    let program = compiled("compute", Compiled::Program, &["-lEGL", "-lGL"]);
    let expected = lines(&mut bare(&program));
    assert_eq!(expected.matches("shown 0 0 255, error 0x0").count(), 2);
    for atlas in ["side-by-side", "layers"] {
        for frame in [1, 2] {
            let views = Views {
                atlas,
                frame,
                ..REPLAYED
            };
            let (told, all) = views.shown(&mut layered(&program, &[]));
            assert_eq!(told, expected, "{atlas}");
            let [left, own, right] = extents(&all, [0, 0, 255]);
            // At depth 2, moved by ±0.4 · (2 − 4) / 2 in 32 columns.
            for (at, shift) in [(left, 12.8), (right, -12.8)] {
                let by = at[0] - own[0];
                assert!(
                    (by - shift).abs() <= 1.5,
                    "{atlas}, frame {frame}: {by} for {shift}"
                );
            }
        }
    }
}

#[test]
fn what_a_toolkit_draws_in_a_widget_has_its_views_in_the_window() {
    let program = compiled("widget", Compiled::Program, &["-lEGL", "-lGL"]);
    let expected = lines(&mut bare(&program));
    assert_eq!(expected.matches("pixel 0 255 0, error 0x0").count(), 5);
    for (atlas, strategy) in [("side-by-side", "replay"), ("layers", "instanced")] {
        for frame in [1, 2, 3] {
            let views = Views {
                atlas,
                strategy,
                separation: 0.2,
                convergence: 2.0,
                frame,
            };
            let (told, all) = views.shown(&mut layered(&program, &[]));
            assert_eq!(told, expected);
            let [left, own, right] = extents(&all, [0, 255, 0]);
            // At depth 1, moved by ±0.2 · (1 − 2) / 1 in 32 columns.
            for (at, moved, shift) in [(left, "left", 6.4), (right, "right", -6.4)] {
                let by = [at[0] - own[0], at[1] - own[1]];
                assert!(
                    by.iter().all(|by: &f64| (by - shift).abs() <= 1.5),
                    "{atlas}, frame {frame}, {moved}: {by:?} for {shift}"
                );
            }
        }
    }
}

#[test]
fn the_report_counts_what_a_toolkit_draws_in_a_widget() {
    let program = compiled("widget", Compiled::Program, &["-lEGL", "-lGL"]);
    let folder = tempfile::tempdir().expect("a folder");
    let report = folder.path().join("report.json");
    let options = [
        ("VIEWS", "3"),
        ("STRATEGY", "instanced"),
        ("REPORT", report.to_str().expect("UTF-8")),
    ];
    succeed(&mut layered(&program, &options));
    let text = std::fs::read_to_string(&report).expect("a report");
    let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    // The context that shows the frames draws one quad at most in each, and no scene.
    let scene = report["classes"]["scene"].as_u64();
    assert!(scene.is_some_and(|draws| draws >= 2), "{text}");
}

#[test]
fn a_lamp_s_map_is_drawn_once_also_in_a_square_window() {
    for size in ["300x220", "256x256"] {
        let arguments = ["--size", size];
        let [few, more] = ["3", "4"].map(|frames| draws(frames, &arguments));
        let [once, replayed] = [0, 1].map(|way| more[way] - few[way]);
        // One clear and eleven things that cast shadows.
        assert_eq!(once, 12, "{size}");
        assert!(replayed > 20, "{size}: {replayed}");
    }
}

#[test]
fn an_explanation_names_passes_and_keeps_shaders_and_rules_change_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().to_str().expect("UTF-8");
    let run = |more: &[(&str, &str)]| {
        let options = [
            ("VIEWS", "3"),
            ("STRATEGY", "replay"),
            ("EXPLAIN", out),
            ("EXPLAIN_FRAME", "2"),
        ];
        let mut program = layered(demo("passes"), &[&options, more].concat());
        succeed(screen().give(program.args(["--frames", "3", "--size", "300x220"])));
        std::fs::read_to_string(folder.path().join("explain.txt")).expect("a list")
    };
    let list = run(&[]);
    let count = |list: &str, word: &str| list.lines().filter(|l| l.contains(word)).count();
    assert_eq!(count(&list, " framebuffer 1 "), 11, "{list}");
    assert!(count(&list, " pass 2 ") > 10, "{list}");
    // All things of the scene share one program, which has both its shaders.
    let thing = list
        .lines()
        .find(|l| l.contains(" pass 2 ") && l.contains("shader ="));
    let thing = thing.expect("a rule for a shader");
    let sum = thing.split("shader = \"").nth(1).expect("a sum");
    let sum = sum.get(..16).expect("16 digits");
    let text = |stage: &str| {
        let path = folder.path().join(format!("explain.shaders/{sum}.{stage}"));
        std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
    };
    assert!(text("vert").contains("camera.projection"));
    assert!(text("view.vert").contains("mv_shift") && text("frag").contains("main"));
    let profile = folder.path().join("p.toml");
    let rule = format!("rule = [{{ pass = 2, shader = \"{sum}\", class = \"flat\" }}]");
    std::fs::write(&profile, rule).expect("written");
    let ruled = run(&[("PROFILE", profile.to_str().expect("UTF-8"))]);
    let flat = |l: &&str| l.contains(" pass 2 ") && l.contains("rule 1 of the profile");
    assert_eq!(
        ruled.lines().filter(flat).count(),
        count(&list, &format!("{sum}\"")),
        "{ruled}"
    );
}

#[test]
fn every_way_to_draw_reaches_the_framebuffers_of_all_views() {
    let program = compiled("aside", Compiled::Program, &["-lEGL", "-lGL"]);
    let views = Views {
        separation: 0.3,
        convergence: 6.0,
        frame: 2,
        ..REPLAYED
    };
    let all = |way: &str| views.shown(layered(&program, &[]).arg(way)).1;
    let first = all("");
    // The first red column: at depth 3, moved by 0.3 · (3 − 6) / 3 in 32 columns.
    let width = first.width() / VIEWS;
    let left = |view: u32| {
        let red = |&x: &u32| {
            let mut column = (0..first.height()).map(|y| first.get_pixel(view * width + x, y).0);
            column.any(|[r, g, _]| r > 200 && g < 50)
        };
        f64::from((0..width).find(red).expect("it is drawn"))
    };
    for (view, shift) in [(0, 9.6), (2, -9.6)] {
        let moved = left(view) - left(1);
        assert!((moved - shift).abs() <= 1.5, "view {view}: {moved}");
    }
    for way in ["list", "executed", "mixed"] {
        assert!(all(way) == first, "{way}");
    }
}
