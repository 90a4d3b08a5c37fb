//! `--strategy splats`: points of a program, drawn once for all views, against the pictures that the program itself draws for each view; straight to a panel, behind the same
//! mask, and to the layers of the views.
//!
//! The oracle's pictures come from `cloud --view i/N` without the layer. They are put together here, subpixel by subpixel. At most 0.02 % of the subpixels differ:
//! a point whose edge lies on the border of a rounded place to within the last bit of a float may be a pixel aside. Measured on llvmpipe 22.3: at most 0.004 %
//! differ by more than 8 steps.

use crate::support;
use crate::support::share;
use crate::support::{bare, demo, layered, rgb, run, screen, succeed};
use image::{RgbImage, imageops};
use manyview::display::{Display, Placement};
use manyview::interleave::reference;
use manyview::metric::{Comparison, Gate, pixels_over};
use std::path::Path;
use std::process::Command;

const WIDTH: u32 = 400;
const HEIGHT: u32 = 300;
const VIEWS: u32 = 5;
const EYES: [&str; 4] = ["--eye-spacing", "0.3", "--focal-depth", "8"];
/// Wrong subpixels of a panel's picture, in percent.
const WRONG: f64 = 0.02;

fn cloud(mut command: Command, options: &[&str]) -> Command {
    let size = format!("{WIDTH}x{HEIGHT}");
    command.args(["--check", "--frames", "3", "--size", &size]);
    command.args(options);
    command
}

/// A view as the program itself draws it, without the layer.
fn program_view(folder: &Path, (view, views): (u32, u32), options: &[&str]) -> RgbImage {
    let mut command = cloud(bare(demo("cloud")), options);
    command
        .args(["--view", &format!("{view}/{views}")])
        .args(EYES);
    command.arg("--dump").arg(folder.join("view-%d.png"));
    succeed(screen().give(&mut command));
    // The demos count from 0.
    rgb(&folder.join("view-2.png"))
}

/// The picture that each subpixel's own view would show, from views that the program draws itself.
fn expected(folder: &Path, display: &str, views: u32, options: &[&str]) -> RgbImage {
    let view = |view| program_view(folder, (view, views), options);
    let tiles: Vec<RgbImage> = (0..views).map(view).collect();
    let display = Display::load(display).expect("a display");
    let mask = display.mask(&Placement::full_screen(WIDTH, HEIGHT), views);
    let mask = mask.expect("a mask");
    reference::interleave(&tiles, &mask).expect("a picture")
}

struct Shown {
    picture: RgbImage,
    report: serde_json::Value,
}

impl Shown {
    fn drawn(&self, method: &str) -> u64 {
        self.report["draws"][method].as_u64().unwrap_or(0)
    }

    fn reasons(&self) -> String {
        self.report["fallbacks"].to_string()
    }
}

fn shown(folder: &Path, variables: &[(&str, &str)], options: &[&str]) -> Shown {
    let at = |name: &str| folder.join(name).to_string_lossy().into_owned();
    let (out, report) = (at("picture.png"), at("report.json"));
    let given = [
        ("STRATEGY", "splats"),
        ("VIEW_SCALE", "1"),
        ("EYE_SPACING", EYES[1]),
        ("FOCAL_DEPTH", EYES[3]),
        ("REPORT", &report),
        ("CAPTURE_OUT", &out),
        ("CAPTURE_FRAMES", "3"),
    ];
    let all: Vec<_> = given.iter().chain(variables).copied().collect();
    let mut command = cloud(layered(demo("cloud"), &all), options);
    succeed(screen().give(&mut command));
    let text = std::fs::read_to_string(folder.join("report.json")).expect("a report");
    let shown = Shown {
        picture: rgb(&folder.join("picture.png")),
        report: serde_json::from_str(&text).expect("JSON"),
    };
    assert_eq!(shown.report["gl_errors"], 0, "{options:?}");
    shown
}

fn wrong_percent(expected: &RgbImage, actual: &RgbImage) -> f64 {
    assert_eq!(expected.dimensions(), actual.dimensions());
    let pairs = expected.as_raw().iter().zip(actual.as_raw());
    let wrong = pairs.filter(|(a, b)| a.abs_diff(**b) > 1).count();
    100.0 * wrong as f64 / expected.as_raw().len() as f64
}

#[track_caller]
fn check(display: &str, views: u32, options: &[&str]) {
    let folder = tempfile::tempdir().expect("a folder");
    let expected = expected(folder.path(), display, views, options);
    let number = views.to_string();
    let shown = shown(
        folder.path(),
        &[("DISPLAY", display), ("VIEWS", &number)],
        options,
    );
    let wrong = wrong_percent(&expected, &shown.picture);
    let what = format!("{display}, {views} views, {options:?}");
    println!("{what}: {wrong:.4} %");
    assert!(
        shown.drawn("splats") >= 6,
        "{what}: {}",
        shown.report["draws"]
    );
    assert_eq!(shown.reasons(), "{}", "{what}");
    assert!(
        wrong <= WRONG,
        "{what}: {wrong:.4} % of the subpixels are wrong"
    );
    // The points are there, and their views differ.
    let own = rgb(&folder.path().join("view-2.png"));
    assert!(pixels_over(&own, &shown.picture, 8) > 2000, "{what}");
}

#[test]
fn points_of_fixed_function_are_those_of_each_view() {
    for options in [
        &[][..],
        &["--point-size", "1"],
        &["--point-size", "8", "--attenuate"],
        &["--sprites", "--point-size", "4"],
        &["--lit"],
        &["--blend"],
        &["--inset"],
        &["--clip"],
        &["--texture"],
        &["--texture", "--sprites", "--point-size", "9"],
    ]
    .into_iter()
    .step_by(share::every(3))
    {
        check("huebner8", 8, options);
    }
}

#[test]
fn points_of_shaders_are_those_of_each_view() {
    for options in [
        &["--glsl", "120"][..],
        &["--glsl", "120", "--sprites", "--attenuate"],
        &["--glsl", "120", "--blend"],
        &["--glsl", "330", "--profile", "core"],
        &[
            "--glsl",
            "330",
            "--profile",
            "core",
            "--sprites",
            "--attenuate",
        ],
    ]
    .into_iter()
    .step_by(share::every(2))
    {
        check("huebner8", 8, options);
    }
}

/// State of which the samples of a panel know nothing: such points go to layers, or are replayed.
#[test]
fn odd_state_is_that_of_each_view() {
    for options in [
        &["--smooth", "--blend", "--point-size", "6"][..],
        &["--smooth", "--blend", "--point-size", "6", "--glsl", "120"],
        &["--upper-left"],
        &[
            "--upper-left",
            "--glsl",
            "120",
            "--sprites",
            "--point-size",
            "8",
        ],
        &["--clip", "--glsl", "120"],
    ]
    .into_iter()
    .step_by(share::every(2))
    {
        let folder = tempfile::tempdir().expect("a folder");
        let expected = expected(folder.path(), "huebner8", 8, options);
        let variables = [("DISPLAY", "huebner8"), ("VIEWS", "8")];
        let shown = shown(folder.path(), &variables, options);
        let wrong = wrong_percent(&expected, &shown.picture);
        assert!(
            wrong <= WRONG,
            "{options:?}: {wrong:.4} % of the subpixels are wrong"
        );
    }
}

/// Masks by subpixels and by pixels, slanted and upright, few views and many.
#[test]
fn every_mask_shows_its_views() {
    for (display, views) in [
        ("slanted8", 8),
        ("lenticular-5", 5),
        ("rows", 2),
        ("checkerboard", 2),
        ("lenticular-48", 48),
    ]
    .into_iter()
    .step_by(share::every(2))
    {
        check(display, views, &["--attenuate", "--point-size", "5"]);
    }
}

/// Every view of a picture that does not go straight to a panel: points are drawn to the layers of the views, and equal what the program draws.
#[test]
fn whole_views_are_those_of_the_program() {
    for options in [
        &[][..],
        &["--lit", "--clip", "--attenuate", "--point-size", "6"],
        &["--sprites", "--texture", "--point-size", "9"],
        &["--glsl", "120", "--sprites", "--blend"],
        &["--glsl", "330", "--profile", "core", "--attenuate"],
        // A colour texture without sizes.
        &["--framebuffer", "1"],
        &["--framebuffer", "4"],
        &["--framebuffer", "4", "--glsl", "120", "--blend"],
        &["--framebuffer", "1", "--glsl", "330", "--profile", "core"],
    ]
    .into_iter()
    .step_by(share::every(3))
    {
        let folder = tempfile::tempdir().expect("a folder");
        let (views, count) = (VIEWS, VIEWS.to_string());
        let variables = [("VIEWS", &*count), ("CAPTURE_WHAT", "atlas")];
        let shown = shown(folder.path(), &variables, options);
        assert!(
            shown.drawn("splats") >= 6,
            "{options:?}: {}",
            shown.report["draws"]
        );
        assert_eq!(shown.reasons(), "{}", "{options:?}");
        for view in 0..views {
            let own = program_view(folder.path(), (view, views), options);
            let tile = imageops::crop_imm(&shown.picture, view * WIDTH, 0, WIDTH, HEIGHT);
            let compared = Comparison::new(&own, &tile.to_image(), None).expect("one size");
            assert!(
                Gate::DESIGN.check(&compared).is_ok(),
                "view {view} of {options:?}: {compared:?}"
            );
        }
    }
}

/// Points as surfaces are the disks that the program itself draws when it gives each point the distance of its sixth neighbour.
#[test]
fn surfaces_are_the_disks_of_each_view() {
    for options in [
        &["--glsl", "120", "--count", "6000"][..],
        &["--glsl", "120", "--count", "6000", "--framebuffer", "4"],
        &["--glsl", "330", "--profile", "core", "--count", "3000"],
    ]
    .into_iter()
    .step_by(share::every(2))
    {
        let folder = tempfile::tempdir().expect("a folder");
        let (views, count) = (VIEWS, VIEWS.to_string());
        let variables = [
            ("VIEWS", &*count),
            ("CAPTURE_WHAT", "atlas"),
            ("SPLATS", "surface"),
        ];
        let shown = shown(folder.path(), &variables, options);
        assert!(shown.drawn("splats") >= 6, "{}", shown.report["draws"]);
        assert_eq!(shown.reasons(), "{}", "{options:?}");
        let disks = [options, &["--disks"]].concat();
        for view in 0..views {
            let own = program_view(folder.path(), (view, views), &disks);
            let tile = imageops::crop_imm(&shown.picture, view * WIDTH, 0, WIDTH, HEIGHT);
            let compared = Comparison::new(&own, &tile.to_image(), None).expect("one size");
            println!("view {view} of {options:?}: {compared:?}");
            assert!(
                Gate::DESIGN.check(&compared).is_ok(),
                "view {view} of {options:?}: {compared:?}"
            );
        }
    }
}

/// Fixed function has no program that draws disks; they cover the gaps through which the background is seen, and points that are sprites stay.
#[test]
fn surfaces_of_fixed_function_have_no_gaps() {
    let covered = |splats: &str, options: &[&str]| {
        let folder = tempfile::tempdir().expect("a folder");
        let variables = [
            ("VIEWS", "3"),
            ("CAPTURE_WHAT", "view:2"),
            ("SPLATS", splats),
        ];
        let shown = shown(folder.path(), &variables, options).picture;
        let ground = *shown.get_pixel(0, 0);
        // The middle of the cloud.
        let part = imageops::crop_imm(&shown, 150, 100, 100, 100).to_image();
        part.pixels().filter(|pixel| **pixel != ground).count()
    };
    let lit = ["--lit", "--count", "3000", "--point-size", "2"];
    let [exact, surface] = ["exact", "surface"].map(|splats| covered(splats, &lit));
    assert!(
        exact < 7000 && surface > 9900,
        "{exact} and {surface} of 10000 pixels"
    );
    let sprites = ["--sprites", "--count", "3000"];
    let [exact, surface] = ["exact", "surface"].map(|splats| covered(splats, &sprites));
    assert_eq!(exact, surface);
}

/// More views than a geometry shader makes at once: the last batch is not full, and nothing of it may be seen.
#[test]
fn many_views_take_several_draws() {
    for (strategy, options) in [
        ("splats", &["--glsl", "120"][..]),
        ("splats", &[]),
        ("geometry", &["--point-size", "1"]),
    ] {
        let options = [&["--count", "3000"], options].concat();
        let folder = tempfile::tempdir().expect("a folder");
        let variables = [
            ("VIEWS", "37"),
            ("CAPTURE_WHAT", "atlas"),
            ("STRATEGY", strategy),
        ];
        let shown = shown(folder.path(), &variables, &options);
        assert!(shown.drawn(strategy) >= 6, "{}", shown.report["draws"]);
        for view in [0, 15, 16, 18, 35, 36] {
            let own = program_view(folder.path(), (view, 37), &options);
            let tile = imageops::crop_imm(&shown.picture, view * WIDTH, 0, WIDTH, HEIGHT);
            let compared = Comparison::new(&own, &tile.to_image(), None).expect("one size");
            let what = format!("view {view} by {strategy}, {options:?}: {compared:?}");
            // A shift after the program's own product rounds otherwise.
            assert!(compared.over_eight <= 16, "{what}");
        }
    }
}

/// What cannot be drawn so is replayed, and the report says why.
#[test]
fn what_is_replayed_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let report = folder.path().join("report.json");
    let variables = [
        ("VIEWS", "8"),
        ("STRATEGY", "splats"),
        ("REPORT", &report.to_string_lossy()),
    ];
    let mut command = layered(demo("points"), &variables);
    succeed(screen().give(command.args(["--frames", "2"])));
    let text = std::fs::read_to_string(&report).expect("a report");
    let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let reasons = &report["fallbacks"];
    assert_eq!(
        reasons["smooth points under `splats` are replayed"], 2,
        "{reasons}"
    );
    // Plain ones, and textured sprites.
    assert_eq!(report["draws"]["splats"], 4, "{report}");
}

/// The option takes the word, and its help names it.
#[test]
fn the_strategy_has_a_word() {
    let (code, stdout, _) = run(support::manyview().args(["run", "--help"]));
    assert_eq!(code, 0);
    assert!(stdout.contains("splats"), "{stdout}");
}
