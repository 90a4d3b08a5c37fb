//! Occlusion cameras (`--strategy occlusion`): the reference image equals that of the CPU reference, disoccluded surfaces are filled from
//! it, and the program's own view is untouched.

use crate::support::near::beyond;
use crate::support::share;
use crate::support::views::{REPLAYED, Views};
use crate::support::{
    Compiled, bare, built, compiled, demo, layered, lines, manyview, rgb, screen, succeed,
};
use image::{GenericImageView, Rgb, RgbImage};
use manyview::metric::pixels_over;
use manyview::synthesis::{RowDistortion, RowDistortionMap};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

const VIEWS: usize = 5;
const OWN: usize = 2;
const SIZE: [u32; 2] = [400, 300];
/// The constant of the same name in `src/layer/occlusion.rs`, pixels.
const REACH: f64 = 30.0;
/// Separation of cameras that see far behind the occluders of `gaps`, and of those that see half of the wall behind its bars.
const WIDE: f64 = 0.03;
const NARROW: f64 = 0.012;
const CONVERGENCE: f64 = 6.0;

/// The third frame of a demo by a strategy: the first one has no distortion map yet.
fn shown(
    demonstration: &[&str],
    what: &str,
    [strategy, holes]: [&str; 2],
    separation: f64,
) -> (RgbImage, Value) {
    let folder = tempfile::tempdir().expect("a folder");
    let (out, report) = (folder.path().join("a.png"), folder.path().join("a.json"));
    let (name, arguments) = demonstration.split_first().expect("a demo");
    let (separation, convergence) = (separation.to_string(), CONVERGENCE.to_string());
    let mut command = manyview();
    command.args(["capture", "--frame", "3", "--views", "5", "--what", what]);
    command.args(["--strategy", strategy, "--holes", holes]);
    command.args(["--separation", &separation, "--convergence", &convergence]);
    command.arg("--out").arg(&out).arg("--report").arg(&report);
    command.arg("--").arg(demo(name)).args(arguments);
    let size = SIZE.map(|side| side.to_string()).join("x");
    succeed(screen().give(command.args(["--frames", "4", "--size", &size])));
    (rgb(&out), read(&report))
}

fn read(report: &Path) -> Value {
    let text = std::fs::read_to_string(report).expect("a report");
    serde_json::from_str(&text).expect("JSON")
}

fn views(demonstration: &[&str], strategy: &str, holes: &str) -> (Vec<RgbImage>, Value) {
    let (all, report) = shown(demonstration, "atlas", [strategy, holes], NARROW);
    let [width, height] = SIZE;
    let view = |at: usize| all.view(at as u32 * width, 0, width, height).to_image();
    ((0..VIEWS).map(view).collect(), report)
}

/// The rectangles of `hard --case gaps` in front of its wall: left, right, low, high and distance.
const BOXES: [[f64; 5]; 4] = [
    [-0.9, 0.6, -2.0, 2.5, 6.0],
    [1.4, 1.5, -4.0, 4.0, 6.5],
    [4.6, 9.0, -1.0, 4.0, 7.5],
    [-9.0, -5.4, -4.0, -3.2, 7.0],
];

fn boxes() -> impl Iterator<Item = [f64; 5]> {
    let bars = (0..9).map(|k| {
        let left = -5.2 + 0.35 * f64::from(k);
        [left, left + 0.2, -3.0, 3.0, 7.0]
    });
    bars.chain(BOXES)
}

/// The ray through a point of the picture, in pixels from the top left: x and y at depth 1.
fn ray(x: f64, y: f64) -> [f64; 2] {
    let [width, height] = SIZE.map(f64::from);
    [
        (2.0 * x / width - 1.0) * 0.8,
        (1.0 - 2.0 * y / height) * 0.6,
    ]
}

/// The wall where a ray meets it: 1/w, the colour of its pattern, and the distance from the edge of the square, in squares.
fn wall([x, y]: [f64; 2]) -> (f64, [u8; 3], f64) {
    // Its corners lie at depth 26 on the left and 20 on the right, x from -30 to 30: w = 23 - x/10 at (x·w, y·w, -w).
    let w = 23.0 / (1.0 + x / 10.0);
    let place = [(x * w + 30.0) / 60.0 * 24.0, (y * w + 20.0) / 40.0 * 12.0];
    let [column, row] = place.map(|v| v.floor() as i64);
    let colour = match (row + column) & 1 {
        0 => [0x70, 0x80, 0xa0],
        _ => [0x50, 0x60, 0x80],
    };
    let inside = place.map(|v| (v - v.floor()).min(v.ceil() - v));
    (1.0 / w, colour, inside[0].min(inside[1]))
}

/// The nearest surface at a point of the picture, as 1/w.
fn nearest(x: f64, y: f64) -> f64 {
    let [u, v] = ray(x, y);
    let hit = |[left, right, low, high, w]: &[f64; 5]| {
        (left / w..right / w).contains(&u) && (low / w..high / w).contains(&v)
    };
    let boxes = boxes().filter(hit).map(|part| 1.0 / part[4]);
    boxes.fold(wall([u, v]).0, f64::max)
}

/// Counts in a reference image of that scene: samples of the wall that the own view hides behind the broad rectangle, pixels of that
/// rectangle, and how many of both differ from the CPU reference.
fn measured(picture: &RgbImage) -> [usize; 3] {
    let [width, height] = SIZE;
    let places = VIEWS as f64 / 2.0 - 0.5;
    let map = RowDistortionMap {
        reach: REACH,
        longest: places * WIDE * CONVERGENCE * f64::from(width) / 2.0,
    };
    let (mut seen, mut hidden, mut wrong) = (0, 0, 0);
    for y in 0..height {
        let middle = |x: u32| (f64::from(x) + 0.5, f64::from(y) + 0.5);
        let inverses: Vec<f32> = (0..width)
            .map(|x| nearest(middle(x).0, middle(x).1) as f32)
            .collect();
        let row = map.row(&inverses);
        // The x at which the reference image shows the wall that lies at x in the undistorted picture.
        let moved = |x: f64| {
            let distortion: Option<&RowDistortion> = row.get(x as usize / 2)?.as_ref();
            let (inverse, ..) = wall(ray(x, middle(0).1));
            distortion.map(|distortion| x + distortion.at(x, inverse))
        };
        // The strip of the wall that the broad rectangle hides at its right edge, in quarters of pixels.
        let edge = (0.6 / 6.0 / 0.8 + 1.0) * f64::from(width) / 2.0;
        let inside = (-2.0 / 6.0..2.5 / 6.0).contains(&ray(0.0, middle(0).1)[1]);
        let quarters = (0..120).map(|at| edge - 30.0 + f64::from(at) / 4.0);
        for x in quarters.filter(|_| inside) {
            let Some(at) = moved(x).filter(|at| *at >= edge + 1.0) else {
                continue;
            };
            let (_, expected, within) = wall(ray(x, middle(0).1));
            // At the edges of the pattern a pixel may belong to the next square.
            if within < 0.15 {
                continue;
            }
            hidden += 1;
            let is = picture.get_pixel(at as u32, y).0;
            wrong += usize::from(is.iter().zip(expected).any(|(a, b)| a.abs_diff(b) > 2));
        }
        // The front surface keeps its place.
        for x in (0..width).filter(|&x| (inverses[x as usize] - 1.0 / 6.0).abs() < 1e-6) {
            seen += 1;
            let is = picture.get_pixel(x, y).0;
            wrong += usize::from(is[1] < is[0] || is[1] < is[2]);
        }
    }
    [hidden, seen, wrong]
}

/// `part`: the fraction of hidden samples that may be wrong, at edges.
fn assert_distorted(picture: &RgbImage, what: &str, part: f64) {
    let [hidden, seen, wrong] = measured(picture);
    println!("{what}: {hidden} hidden, {seen} in front, {wrong} wrong");
    assert!(hidden > 3_000 && seen > 10_000, "{what}: {hidden}, {seen}");
    assert!(
        wrong as f64 <= part * hidden as f64,
        "{what}: {wrong} of {hidden}"
    );
}

#[test]
fn the_reference_image_is_that_of_distorted_rays() {
    let (picture, report) = shown(
        &["hard", "--case", "gaps"],
        "reference",
        ["occlusion", "fill"],
        WIDE,
    );
    assert!(report["draws"]["reference"].as_u64() > Some(0), "{report}");
    assert_distorted(&picture, "fixed function", 0.02);
}

/// Arguments of `bars.c`: first with shaders, then in fixed function, whose large surfaces have to be subdivided except in the list.
const SHADED: [&str; 6] = ["matrix", "begin", "old", "coord", "new", "instanced"];

const FIXED: [&str; 6] = ["strips", "fans", "polygons", "quads", "indexed", "list"];

/// Arguments that draw nothing into the reference image, and why.
const REFUSED: [(&str, &str); 2] = [
    ("several", "the shader writes to more than one image"),
    ("geometry", "its vertices are placed after the vertex stage"),
];

fn bars() -> PathBuf {
    compiled("bars", Compiled::Program, &["-lEGL", "-lGL"])
}

/// The third frame of `bars.c`.
fn bars_shown(way: &str, what: &str, strategy: &str) -> (RgbImage, Value) {
    bars_of(&bars(), way, what, strategy)
}

fn bars_of(bars: &Path, way: &str, what: &str, strategy: &str) -> (RgbImage, Value) {
    shown_of(bars, &[way], what, strategy)
}

/// The third frame of a program with these arguments, in five views, and the report.
fn shown_of(program: &Path, arguments: &[&str], what: &str, strategy: &str) -> (RgbImage, Value) {
    let folder = tempfile::tempdir().expect("a folder");
    let (out, report) = (folder.path().join("a.png"), folder.path().join("a.json"));
    let mut command = manyview();
    command.args(["capture", "--frame", "3", "--views", "5", "--what", what]);
    command.args(["--strategy", strategy, "--out"]).arg(&out);
    let (separation, convergence) = (WIDE.to_string(), CONVERGENCE.to_string());
    command.args(["--separation", &separation, "--convergence", &convergence]);
    command.arg("--report").arg(&report).arg("--").arg(program);
    succeed(screen().give(command.args(arguments)));
    (rgb(&out), read(&report))
}

#[test]
fn programs_with_shaders_have_one_too() {
    for way in SHADED {
        let (picture, report) = bars_shown(way, "reference", "occlusion");
        assert!(report["draws"]["reference"].as_u64() > Some(0), "{report}");
        assert_eq!(report["fallbacks"], json!({}), "{way}");
        assert_eq!(report["gl_errors"], 0, "{way}");
        assert_distorted(&picture, way, 0.02);
    }
}

#[test]
fn strips_and_fans_are_cut_and_lists_are_drawn() {
    for way in FIXED {
        let (picture, report) = bars_shown(way, "reference", "occlusion");
        assert!(report["draws"]["reference"].as_u64() > Some(0), "{report}");
        assert_eq!(report["gl_errors"], 0, "{way}");
        assert_distorted(&picture, way, 0.005);
    }
}

/// A program that writes no red (for an anaglyph, say) still has its samples moved.
#[test]
fn colours_that_are_not_written_have_depths() {
    let wrong = |way: &str| {
        let picture = |strategy| bars_shown(way, "atlas", strategy).0;
        let (exact, all) = (picture("replay"), picture("occlusion"));
        let pairs = exact.pixels().zip(all.pixels());
        let differs = |a: &Rgb<u8>, b: &Rgb<u8>| (1..3).any(|i| a[i].abs_diff(b[i]) > 8);
        pairs.filter(|(a, b)| differs(a, b)).count()
    };
    let (all, cyan) = (wrong("strips"), wrong("cyan"));
    println!("{all} and {cyan} pixels");
    assert!(all > 500 && cyan <= all, "{all} and {cyan} pixels");
}

#[test]
fn depths_of_16_bits_tell_as_much() {
    let libraries = ["-DDEPTH_BITS=16", "-lEGL", "-lGL"];
    let source = Path::new("tests/support/c/bars.c");
    let coarse = built("bars-16", &[source], Compiled::Program, &libraries);
    for strategy in ["depth-image", "occlusion", "hybrid"] {
        let (fine, usual) = bars_shown("strips", "atlas", strategy);
        let (picture, report) = bars_of(&coarse, "strips", "atlas", strategy);
        let made = &report["frames_synthesised"]["into_tiles"];
        assert!(made.as_u64() > Some(0), "{report}");
        // Four bytes of colour and two of depth in place of four and four.
        let [usual, less] = [&usual, &report].map(|told| told["view_bytes"].as_u64());
        assert_eq!(usual.map(|bytes| bytes * 3), less.map(|bytes| bytes * 4));
        let off = pixels_over(&fine, &picture, 8);
        println!("{strategy}: {off} pixels");
        // Silhouettes whose place rounds differently.
        assert!(
            off * 500 <= u64::from(fine.width() * fine.height()),
            "{strategy}: {off}"
        );
    }
}

/// A line one pixel wide is in every synthesised view, as long as it is in the drawn ones.
#[test]
fn lines_stay_in_every_view() {
    let thin = compiled("thin", Compiled::Program, &["-lEGL", "-lGL"]);
    let yellow = |pixel: &&Rgb<u8>| pixel[0] > 128;
    for ground in [&[][..], &["nothing"]] {
        let count = |strategy| {
            let (all, report) = shown_of(&thin, ground, "atlas", strategy);
            let made = report["frames_synthesised"]["into_tiles"].as_u64();
            assert_eq!(made > Some(0), strategy != "replay", "{report}");
            let width = all.width() / 5;
            let view = |i| all.view(i * width, 0, width, all.height()).to_image();
            let lit = |i| view(i).pixels().filter(yellow).count();
            (0..5).map(lit).collect::<Vec<_>>()
        };
        let drawn = count("replay");
        assert!(drawn.iter().all(|lit| *lit > 2000), "{drawn:?}");
        for strategy in ["depth-image", "occlusion", "hybrid"] {
            assert_eq!(count(strategy), drawn, "{ground:?}, {strategy}");
        }
    }
}

/// Views of OpenGL ES are synthesised as those of desktop OpenGL are, but for the hidden surfaces of `occlusion`.
#[test]
fn scenes_of_es_are_synthesised() {
    for strategy in ["replay", "depth-image", "occlusion", "hybrid"] {
        let same = if strategy == "occlusion" {
            "depth-image"
        } else {
            strategy
        };
        let (desktop, _) = bars_shown("new", "atlas", same);
        let (picture, report) = bars_shown("es", "atlas", strategy);
        let made = &report["frames_synthesised"]["into_tiles"];
        assert_eq!(made.as_u64() > Some(0), strategy != "replay", "{report}");
        assert_eq!(pixels_over(&desktop, &picture, 0), 0, "{strategy}");
    }
}

#[test]
fn programs_with_other_stages_and_outputs_are_left_out() {
    for (way, why) in REFUSED {
        let (picture, report) = bars_shown(way, "view:2", "occlusion");
        let reason = format!("a program draws nothing to the reference image: {why}");
        let counted = &report["fallbacks"][&reason];
        assert!(counted.as_u64() > Some(0), "{way}: {report}");
        assert_eq!(report["draws"]["reference"], Value::Null, "{way}");
        assert!(picture == bars_shown(way, "view:2", "replay").0, "{way}");
    }
}

#[test]
fn programs_know_nothing_of_it() {
    let ways = SHADED.into_iter().chain(FIXED).chain(["cyan"]);
    for way in ways.step_by(share::every(3)) {
        let expected = lines(bare(bars()).arg(way));
        assert_eq!(expected.matches("error 0x0").count(), 4, "{expected}");
        let replay = Views {
            frame: 3,
            ..REPLAYED
        };
        let (_, exact) = replay.shown(layered(bars(), &[]).arg(way));
        for atlas in ["side-by-side", "layers"] {
            let views = Views {
                atlas,
                strategy: "occlusion",
                frame: 3,
                ..REPLAYED
            };
            let (told, all) = views.shown(layered(bars(), &[]).arg(way));
            assert_eq!(told, expected, "{way}, {atlas}");
            let own = |all: &RgbImage| all.view(SIZE[0], 0, SIZE[0], SIZE[1]).to_image();
            assert!(
                own(&all) == own(&exact),
                "{way}, {atlas}: the own view is another"
            );
        }
    }
}

/// Scenes, the largest fraction of the depth image's holes that stay, and of the filled pixels that may be wrong: single pixels at edges.
/// Behind some holes nothing is drawn.
const SCENES: [(&[&str], f64, f64); 4] = [
    (&["hard", "--case", "gaps"], 0.35, 0.05),
    (&["teapot"], 0.75, 0.02),
    (&["room"], 0.55, 0.02),
    (&["crowd", "--profile", "core"], 0.93, 0.05),
];

/// Columns at the sides of the picture that no view of it sees beyond.
const SIDE: u32 = 24;

#[test]
fn holes_get_what_is_there() {
    for (scene, left, spoilt) in SCENES {
        let (exact, _) = views(scene, "replay", "fill");
        let (depths, _) = views(scene, "depth-image", "mark");
        let (all, report) = views(scene, "occlusion", "fill");
        let (marked, _) = views(scene, "occlusion", "mark");
        assert_eq!(report["gl_errors"], 0, "{scene:?}");
        assert!(exact[OWN] == all[OWN], "{scene:?}: the own view is another");
        let (mut before, mut after, mut filled, mut wrong) = (0, 0, 0, 0);
        for view in 0..VIEWS {
            let inner = |x: u32| (SIDE..SIZE[0] - SIDE).contains(&x);
            let pixels = exact[view].enumerate_pixels();
            for (x, y, _) in pixels.filter(|pixel| inner(pixel.0)) {
                let hole = |of: &[RgbImage]| of[view].get_pixel(x, y).0 == [255, 0, 255];
                before += usize::from(hole(&depths));
                after += usize::from(hole(&marked));
                if hole(&depths) && !hole(&marked) {
                    filled += 1;
                    wrong += usize::from(beyond(&exact[view], &all[view], x, y));
                }
            }
        }
        println!("{scene:?}: {before} holes, {after} left, {wrong} of {filled} wrong");
        assert!(
            after as f64 <= left * before as f64,
            "{scene:?}: {after} of {before}"
        );
        assert!(
            wrong as f64 <= spoilt * filled as f64,
            "{scene:?}: {wrong} of {filled}"
        );
    }
}

#[test]
fn what_has_no_reference_image_is_said_in_one_sentence() {
    let strategies: [(&str, &str); 2] = [("occlusion", "1"), ("depth-image", "3")];
    for (strategy, frame) in strategies {
        let mut command = manyview();
        command.args(["capture", "--frame", frame, "--what", "reference"]);
        command.args(["--strategy", strategy, "--out", "a.png", "--", "true"]);
        let output = command.output().expect("a start");
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(told.contains("--what is 'reference'"), "{told}");
        assert!(told.contains("give the strategy occlusion"), "{told}");
    }
}
