//! Frames that are the same in all views are drawn once: the panel shows the same picture as if all views had been drawn.

use crate::support::share;
use crate::support::{demo, manyview, rgb, screen, succeed};
use image::RgbImage;
use serde_json::Value;
use std::path::Path;

/// The first frames of a demo, and how many of all its frames were drawn once.
fn frames(demonstration: &[&str], options: &[&str], count: u32) -> (Vec<RgbImage>, u64) {
    let folder = tempfile::tempdir().expect("a folder");
    let report = folder.path().join("report.json");
    let range = format!("1..{count}");
    let (name, arguments) = demonstration.split_first().expect("a demo");
    let mut command = manyview();
    command.args(["capture", "--frames", &range, "--views", "8"]);
    command.arg("--out").arg(folder.path().join("%d.png"));
    command.arg("--report").arg(&report).args(options);
    command.arg("--").arg(demo(name)).args(arguments);
    succeed(screen().give(command.args(["--size", "160x120"])));
    let picture = |frame| rgb(&folder.path().join(format!("{frame}.png")));
    ((1..=count).map(picture).collect(), drawn_once(&report))
}

fn drawn_once(report: &Path) -> u64 {
    let text = std::fs::read_to_string(report).expect("a report");
    let report: Value = serde_json::from_str(&text).expect("JSON");
    report["frames_drawn_once"].as_u64().expect("a number")
}

/// Compares with and without the optimisation. Views in layers all lie at the origin, so mono frames are equal there bit by bit.
#[track_caller]
fn same(demonstration: &[&str], options: &[&str], count: u32) -> (u64, Vec<RgbImage>) {
    let options = [options, &["--atlas", "layers"]].concat();
    let (saved, once) = frames(demonstration, &options, count);
    let (all, none) = frames(
        demonstration,
        &[&options[..], &["--disable", "mono"]].concat(),
        count,
    );
    assert_eq!(none, 0);
    for (at, (saved, all)) in saved.iter().zip(&all).enumerate() {
        assert!(
            saved == all,
            "{demonstration:?}: frame {} is another",
            at + 1
        );
    }
    (once, saved)
}

/// A menu, a menu over a menu, a scene, and a menu after the scene's stencil.
#[test]
fn a_menu_is_drawn_once_and_a_scene_in_all_views() {
    let strategies = ["replay", "instanced", "geometry"];
    for strategy in strategies.into_iter().step_by(share::every(2)) {
        let (once, pictures) = same(&["menu"], &["--strategy", strategy], 48);
        // The frame after a scene is still drawn in all views, as are those in which the stencils of the views may differ.
        assert!((22..=24).contains(&once), "{strategy}: {once}");
        assert!(pictures[13] != pictures[1]);
    }
}

/// Outputs that show more than the own view: two eyes, other grids, other filters, single views.
#[test]
fn outputs_that_show_more_than_one_view_get_them() {
    let (once, _) = same(&["menu"], &["--output", "rows"], 20);
    assert!(once > 8, "{once}");
    for options in [
        &["--output", "tb"][..],
        &["--output", "sbs"],
        &["--filter", "blend"],
        &["--view-scale", "auto"],
        &["--what", "view:0"],
        &["--what", "atlas"],
    ]
    .into_iter()
    .step_by(share::every(2))
    {
        let (once, _) = same(&["menu"], options, 16);
        assert_eq!(once, 0, "{options:?}");
    }
}

/// Commands that read earlier pictures: copies of the frame, the accumulation buffer, readback, display lists, depths without a scene.
#[test]
fn what_looks_at_other_views_finds_them() {
    let demos = ["echo", "blur", "readback", "lists", "sky", "room"];
    for name in demos.into_iter().step_by(share::every(2)) {
        same(&[name], &[], 12);
    }
}
