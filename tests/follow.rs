//! Flat draws that follow the scene: a crosshair stands where the demo itself draws it when it is told how far away the scene is there.

use crate::support::x::User;
use crate::support::{Screen, demo, dump, extent, manyview, own_screen, rgb, succeed};
use image::RgbImage;

const SIZE: [u32; 2] = [320, 240];
const VIEWS: u32 = 5;
const FOCAL: f64 = 8.0;
const WALL: f64 = 20.0;
const CROSSHAIR: [u8; 3] = [232, 51, 51];
const CURSOR: [u8; 3] = [51, 232, 76];
/// By then a step in depth is over but for a thousandth of a pixel.
const FRAME: &str = "24";

/// All views of a later frame, side by side, on a screen whose pointer is in the middle of the demo's cursor.
fn views(screen: &Screen, pillar: u32, layer: &[&str]) -> RgbImage {
    User::at(screen.display()).point([243, 124]);
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("views.png");
    let mut command = manyview();
    command.args(["capture", "--out"]).arg(&out);
    command.args(["--frame", FRAME, "--views", &VIEWS.to_string()]);
    command.args(["--what", "atlas", "--atlas", "layers"]);
    command.args(["--eye-spacing", "0.3", "--focal-depth", "8"]);
    command.args(layer).arg("--").arg(demo("aim"));
    command.args(["--size", "320x240", "--pillar", &pillar.to_string()]);
    succeed(screen.give(&mut command));
    rgb(&out)
}

/// View i as the demo draws it, with what is flat at this depth.
fn own(view: u32, pillar: u32, depth: f64) -> RgbImage {
    let picture = dump(
        "aim",
        &[
            "--size",
            "320x240",
            "--frames",
            "1",
            "--view",
            &format!("{view}/{VIEWS}"),
            "--pillar",
            &pillar.to_string(),
            "--hud-depth",
            &depth.to_string(),
        ],
    );
    image::DynamicImage::from(picture).into_rgb8()
}

/// Columns of a colour in the middle row, in a view.
fn place(all: &RgbImage, views: u32, view: u32, colour: [u8; 3]) -> [f64; 2] {
    assert_eq!(all.width(), views * SIZE[0]);
    extent(all, views, view, colour)
}

#[test]
fn a_crosshair_stands_where_the_scene_is_behind_it() {
    let screen = own_screen();
    for (strategy, pillar) in [("replay", 3), ("geometry", 12)] {
        let options = ["--hud-depth", "crosshair", "--strategy", strategy];
        let all = views(&screen, pillar, &options);
        let depth = 1.0 - FOCAL / f64::from(pillar);
        for view in [0, 2, 3] {
            let want = own(view, pillar, depth);
            for colour in [CROSSHAIR, CURSOR] {
                assert_eq!(
                    place(&all, VIEWS, view, colour),
                    place(&want, 1, 0, colour),
                    "{strategy}, pillar at {pillar}, view {view}"
                );
            }
        }
    }
}

#[test]
fn a_rule_sends_one_draw_with_the_pointer_and_another_with_the_middle() {
    let screen = own_screen();
    let folder = tempfile::tempdir().expect("a folder");
    let profile = folder.path().join("aim.toml");
    let text = "rule = [
        { draw = 3, class = \"flat\", depth = \"crosshair\" },
        { draw = 4, class = \"flat\", depth = \"cursor\" },
    ]";
    std::fs::write(&profile, text).expect("written");
    let pillar = 3;
    let all = views(
        &screen,
        pillar,
        &["--profile", profile.to_str().expect("UTF-8")],
    );
    for view in 0..VIEWS {
        for (colour, distance) in [(CROSSHAIR, f64::from(pillar)), (CURSOR, WALL)] {
            let want = own(view, pillar, 1.0 - FOCAL / distance);
            let (found, want) = (place(&all, VIEWS, view, colour), place(&want, 1, 0, colour));
            assert_eq!(found, want, "view {view}, {colour:?}");
        }
    }
}
