//! Synthesised views (`--strategy depth-image`): they equal those of the CPU reference, the panel's picture is interleaved from them, the
//! program's own view is untouched, and whatever depths cannot describe is drawn in each view.

use crate::support;
use crate::support::near::beyond;
use crate::support::share;
use crate::support::{demo, manyview, rgb, screen, succeed};
use image::{GenericImageView, Rgb, RgbImage};
use manyview::metric::{Comparison, pixels_over};
use manyview::synthesis::{DepthImage, Shift, warp};
use serde_json::Value;
use std::path::Path;

const VIEWS: u32 = 5;
const OWN: u32 = 2;
const MAGENTA: [u8; 3] = [255, 0, 255];

/// Writes one frame of a demo under the layer to `out` and returns the report.
fn shown(demonstration: &[&str], what: &str, options: &[&str], out: &Path) -> Value {
    let report = out.with_extension("json");
    let (name, arguments) = demonstration.split_first().expect("a demo");
    let mut command = manyview();
    command.args(["capture", "--frame", "2", "--what", what]);
    command.arg("--out").arg(out).arg("--report").arg(&report);
    command
        .args(options)
        .arg("--")
        .arg(demo(name))
        .args(arguments);
    succeed(screen().give(command.args(["--frames", "3", "--size", "300x220"])));
    let text = std::fs::read_to_string(&report).expect("a report");
    serde_json::from_str(&text).expect("JSON")
}

/// The views, the leftmost camera's first.
fn views(demonstration: &[&str], options: &[&str]) -> (Vec<RgbImage>, Value) {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("atlas.png");
    let options = [&["--views", "5"], options].concat();
    let report = shown(demonstration, "atlas", &options, &out);
    let all = rgb(&out);
    let width = all.width() / VIEWS;
    let view = |i| all.view(i * width, 0, width, all.height()).to_image();
    ((0..VIEWS).map(view).collect(), report)
}

fn made(report: &Value) -> [u64; 2] {
    ["into_panel", "into_tiles"].map(|way| {
        let made = &report["frames_synthesised"][way];
        made.as_u64().unwrap_or(0)
    })
}

/// The sky of a box that shaders draw, before the scene or after it, lies where drawn views have it; so does one that something transparent
/// follows, where views are synthesised of the sky alone.
#[test]
fn skies_are_infinitely_far() {
    let shaded = ["120", "330"].map(|version| vec!["shade", "--box", "--glsl", version]);
    for scene in shaded.into_iter().chain([vec!["sky", "--mist"]]) {
        let cameras = ["--separation", "0.02", "--convergence", "7"];
        let with = |strategy| views(&scene, &[&cameras[..], &["--strategy", strategy]].concat());
        let (drawn, _) = with("replay");
        for strategy in ["depth-image", "hybrid", "occlusion"] {
            let (all, report) = with(strategy);
            assert!(made(&report)[1] > 0, "{scene:?}, {strategy}: {report}");
            for (view, (drawn, all)) in drawn.iter().zip(&all).enumerate() {
                let off = pixels_over(drawn, all, 8);
                // Holes beside the things before it. On the panel's plane, more than half of the sky would differ.
                let most = u64::from(drawn.width() * drawn.height()) / 40;
                assert!(
                    off <= most,
                    "{scene:?}, {strategy}, view {view}: {off} pixels"
                );
            }
        }
    }
}

/// Why views were synthesised within the frames.
fn reasons(report: &Value) -> Vec<String> {
    let all = report["fallbacks"].as_object().expect("an object");
    all.keys().cloned().collect()
}

#[test]
fn frames_of_which_no_view_is_synthesised_say_why() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("view.png");
    let cases = [
        ("passes", "1", "the scene is drawn to a framebuffer"),
        (
            "blur",
            "1",
            "the depths of the window are not cleared as a whole",
        ),
        ("teapot", "0.5", "views have fewer pixels than the window"),
    ];
    for (demonstration, scale, reason) in cases {
        let options = ["--strategy", "depth-image", "--view-scale", scale];
        let report = shown(&[demonstration], "view:0", &options, &out);
        assert_eq!(report["gl_errors"], 0, "{demonstration}");
        assert_eq!(made(&report), [0, 0], "{demonstration}");
        let expected = format!("no view is synthesised: {reason}");
        let told = reasons(&report).iter().any(|r| r.starts_with(&expected));
        assert!(told, "{demonstration}: {report}");
    }
}

fn psnr(expected: &RgbImage, actual: &RgbImage) -> f64 {
    let compared = Comparison::new(expected, actual, None);
    compared.expect("pictures of one size").psnr
}

/// The own view with its depths; `near` and `far` are the demo's planes.
fn depth_image(demonstration: &[&str], own: &RgbImage, [near, far]: [f64; 2]) -> DepthImage {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("depth.png");
    shown(demonstration, "depth", &["--views", "5"], &out);
    let depths = image::open(&out).expect("a picture").into_luma16();
    let inverse = |depth: u16| match depth {
        // The background.
        u16::MAX => -1.0,
        depth => {
            let depth = f64::from(depth) / f64::from(u16::MAX);
            (1.0 / near + depth * (1.0 / far - 1.0 / near)) as f32
        }
    };
    let (width, height) = own.dimensions();
    let colours = own.pixels().map(|pixel| pixel.0).collect();
    let inverses = depths.pixels().map(|pixel| inverse(pixel.0[0])).collect();
    DepthImage::new([width, height], colours, inverses).expect("sizes that fit")
}

#[test]
fn views_are_those_of_the_reference() {
    let scenes: [(&[&str], _, _); 2] = [
        (&["gears"], [2.0, 40.0], ["0.02", "9"]),
        (&["field"], [0.5, 60.0], ["0.03", "4"]),
    ];
    for (scene, planes, [separation, convergence]) in scenes {
        for atlas in ["side-by-side", "layers"] {
            let options = |holes| {
                let cameras = ["--separation", separation, "--convergence", convergence];
                let way = [
                    "--strategy",
                    "depth-image",
                    "--atlas",
                    atlas,
                    "--holes",
                    holes,
                ];
                [&cameras[..], &way[..]].concat()
            };
            let (all, report) = views(scene, &options("fill"));
            assert!(made(&report)[1] > 0, "{report}");
            let (marked, _) = views(scene, &options("mark"));
            let cameras = ["--separation", separation, "--convergence", convergence];
            let exact = [&cameras[..], &["--strategy", "replay"]].concat();
            let (exact, _) = views(scene, &exact);
            let image = depth_image(scene, &all[OWN as usize], planes);
            for view in (0..VIEWS).filter(|&view| view != OWN) {
                let shift = Shift {
                    separation: (f64::from(view) - 2.0) * separation.parse::<f64>().expect("one"),
                    convergence: convergence.parse().expect("a number"),
                };
                let expected = warp(&image, &shift);
                let at = view as usize;
                let pixels = f64::from(all[at].width() * all[at].height());
                let differs = |(a, b): (&Rgb<u8>, &Rgb<u8>)| {
                    a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > 8)
                };
                let both = expected.picture.pixels().zip(all[at].pixels());
                let differs: Vec<bool> = both.map(differs).collect();
                let wrong = differs.iter().zip(&expected.holes);
                let wrong = wrong.filter(|(differs, hole)| **differs && !**hole).count() as f64;
                // Sum of the errors of a picture against the drawn one, in holes.
                let error = |picture: &RgbImage| {
                    let pairs = exact[at]
                        .pixels()
                        .zip(picture.pixels())
                        .zip(&expected.holes);
                    let of = |((a, b), hole): ((&Rgb<u8>, &Rgb<u8>), &bool)| match hole {
                        true => {
                            a.0.iter()
                                .zip(b.0)
                                .map(|(a, b)| u64::from(a.abs_diff(b)))
                                .sum()
                        }
                        false => 0u64,
                    };
                    pairs.map(of).sum::<u64>()
                };
                let [filled, reference] = [&all[at], &expected.picture].map(error);
                let hole = |x: usize| expected.holes[x];
                let told = marked[at].pixels().enumerate();
                let odd = told
                    .filter(|(x, pixel)| hole(*x) != (pixel.0 == MAGENTA))
                    .count();
                let holes = expected.hole_share() * pixels;
                println!(
                    "{scene:?} {atlas} view {view}: {wrong} pixels wrong, holes {filled} and {reference} from what is drawn, {odd} of {holes} holes"
                );
                // Single pixels where a ray passes an edge within the precision of 16-bit depths.
                assert!(
                    wrong <= 0.0005 * pixels,
                    "{scene:?} {atlas} view {view}: {wrong}"
                );
                assert!(10 * filled <= 11 * reference, "{filled}, {reference}");
                assert!(
                    holes > 50.0 && odd as f64 <= 0.02 * holes + 10.0,
                    "{odd} of {holes}"
                );
            }
        }
    }
}

#[test]
fn a_panel_s_picture_is_that_of_its_views() {
    let hybrid = ["--strategy", "hybrid", "--true-views"];
    let [two, three, six] = ["2", "3", "6"].map(|count| [&hybrid[..], &[count]].concat());
    for (display, count, way) in [
        ("slanted8", "8", WAYS[0]),
        ("slanted8", "8", WAYS[1]),
        ("lenticular-5", "5", WAYS[0]),
        ("slanted8", "8", &two),
        ("slanted8", "8", &six),
        ("lenticular-5", "5", &three),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let picture = |what: &str, name: &str, more: &[&str]| {
            let out = folder.path().join(name);
            let common = ["--display", display];
            let cameras = ["--separation", "0.02", "--convergence", "4"];
            let options = [&common[..], way, &cameras[..], more].concat();
            let report = shown(&["field"], what, &options, &out);
            (out, report)
        };
        let (straight, report) = picture("output", "straight.png", &[]);
        assert_eq!(made(&report)[1], 0, "{report}");
        assert!(made(&report)[0] > 0, "{report}");
        let quilt = ["--output", "quilt"];
        picture("output", "quilt_%q.png", &quilt);
        let quilt = std::fs::read_dir(folder.path())
            .expect("a folder")
            .flatten();
        let quilt = quilt.map(|entry| entry.path());
        let mut quilts = quilt.filter(|path| path.display().to_string().contains("_qs"));
        let quilt = quilts.next().expect("a quilt");
        let woven = folder.path().join("woven.png");
        let mut weave = manyview();
        weave.args(["weave", "--display", display, "--views", count]);
        weave.args(["--size", "300x220"]).arg("--in").arg(&quilt);
        succeed(weave.arg("--out").arg(&woven));
        let (straight, woven) = (rgb(&straight), rgb(&woven));
        let wrong = pixels_over(&woven, &straight, 0);
        assert!(wrong <= 66, "{display}: {wrong} pixels differ");
    }
}

/// Options that synthesise views, all with the same bounds.
const WAYS: [&[&str]; 4] = [
    &["--strategy", "depth-image"],
    &["--strategy", "occlusion"],
    &["--strategy", "hybrid", "--true-views", "2"],
    &["--strategy", "hybrid", "--true-views", "3"],
];

/// Scenes with draws that depths cannot describe, the kind of draw that ends synthesis, and the least PSNR of the worst view, in dB.
const HARD: [(&[&str], &str, f64); 15] = [
    (&["gears"], "", 31.0),
    (&["gears", "--samples", "4"], "", 35.0),
    (&["teapot"], "", 35.0),
    (&["room"], "what is transparent", 34.0),
    (&["points"], "draws with a stipple of the screen's", 25.0),
    (&["clip"], "draws with a stencil test", 36.0),
    (&["mirror"], "draws with a stencil test", 50.0),
    (&["sky"], "a sky with depths", 34.0),
    (&["sky", "--cleared"], "a sky with depths", 34.0),
    (&["crowd"], "what is transparent", 24.0),
    (&["echo"], "pictures and pixels", 34.0),
    (
        &["shade", "--api", "egl", "--profile", "es2"],
        "what has no depths",
        37.0,
    ),
    (&["shade"], "what has no depths", 37.0),
    (&["shade", "--sky"], "what has no depths", 35.0),
    (
        &["shade", "--sky", "--glsl", "330"],
        "what shaders compute for places on the screen",
        35.0,
    ),
];

#[test]
fn what_depths_do_not_tell_of_is_drawn_in_each_view() {
    for (scene, reason, least) in HARD.into_iter().step_by(share::every(3)) {
        let (exact, _) = views(scene, &["--strategy", "replay"]);
        for way in WAYS {
            let (all, report) = views(scene, way);
            assert!(
                all[OWN as usize] == exact[OWN as usize],
                "{scene:?}: the own view is another"
            );
            let found = reasons(&report);
            let told = format!("views are synthesised before {reason}");
            match reason {
                "" => assert!(found.is_empty(), "{scene:?}: {found:?}"),
                _ => assert!(found.contains(&told), "{scene:?}: {found:?}"),
            }
            assert_eq!(report["gl_errors"], 0, "{scene:?}");
            let worst = exact.iter().zip(&all).map(|(e, a)| psnr(e, a));
            let worst = worst.fold(f64::INFINITY, f64::min);
            println!("{scene:?} by {way:?}: {worst:.1} dB");
            assert!(worst >= least, "{scene:?}: {worst} dB");
        }
    }
}

#[test]
fn programs_with_pictures_of_their_own_are_drawn_in_each_view() {
    for scene in [&["passes", "--depth-blit"][..], &["blur"], &["menu"]] {
        let (exact, _) = views(scene, &["--strategy", "replay"]);
        let (all, _) = views(scene, &["--strategy", "depth-image"]);
        for (view, (exact, all)) in exact.iter().zip(&all).enumerate() {
            assert!(exact == all, "{scene:?}: view {view}");
        }
    }
}

/// Scenes of `hard` that exceed the bound, and why.
const BOUND_EXCEEDED: [(&str, &str); 5] = [
    (
        "answers",
        "two surfaces in one plane, which fight for it in each view in another way",
    ),
    (
        "gaps",
        "in a gap a pixel wide the wall has the colour of half a pixel beside it, which a bar hides: 142 pixels",
    ),
    ("layered", "the same"),
    (
        "normals",
        "a rim that is a pixel wide is of another colour in the next pixel: 46 of 66,000 pixels, 33 allowed",
    ),
    (
        "far-from-origin",
        "vertices at 1,000,000 are rounded otherwise in each view",
    ),
];
/// Largest fraction of a view's pixels outside holes that may be wrong: single pixels at silhouettes.
const OUTSIDE: f64 = 0.0005;

/// Outside holes no wrong surface is seen; where depths do not suffice, everything is drawn in each view.
#[test]
fn hard_scenes_are_right_outside_of_holes() {
    right_outside_of_holes(8);
}

#[test]
#[ignore = "two minutes: make test-long"]
fn all_hard_scenes_are_right_outside_of_holes() {
    right_outside_of_holes(1);
}

/// Checks every scene of which the number is a multiple of `step`.
#[track_caller]
fn right_outside_of_holes(step: usize) {
    let mut list = support::bare(demo("hard"));
    let list = support::lines(list.args(["--list", "--api", "egl"]));
    let scenes: Vec<&str> = list
        .lines()
        .filter_map(|line| line.split(' ').next())
        .collect();
    assert!(scenes.len() > 40, "{list}");
    let cameras = ["--eye-spacing", "0.3", "--focal-depth", "8"];
    for name in scenes.into_iter().step_by(step) {
        let scene = ["hard", "--case", name];
        let by = |options: &[&str]| views(&scene, &[&cameras[..], options].concat());
        let (exact, _) = by(&["--strategy", "replay"]);
        for way in WAYS {
            let (all, report) = by(way);
            let (marked, _) = by(&[way, &["--holes", "mark"]].concat());
            assert!(
                exact[OWN as usize] == all[OWN as usize],
                "{name}: the own view is another"
            );
            assert_eq!(report["gl_errors"], 0, "{name}");
            let mut worst = 0;
            for view in (0..VIEWS as usize).filter(|&view| view != OWN as usize) {
                worst = worst.max(odd(&exact[view], &all[view], &marked[view]));
            }
            let [_, tiles] = made(&report);
            println!(
                "{name} by {way:?}: {worst} pixels, {tiles} frames made, {:?}",
                reasons(&report)
            );
            let pixels = f64::from(exact[0].width() * exact[0].height());
            match BOUND_EXCEEDED.iter().find(|(scene, _)| *scene == name) {
                // With two true views the bound may be met.
                Some((_, why)) if !way.contains(&"hybrid") => {
                    assert!(worst as f64 > OUTSIDE * pixels, "{name}: {why}");
                }
                Some((_, why)) => assert!(worst as f64 <= 0.05 * pixels, "{name}: {why}"),
                None => assert!(
                    worst as f64 <= OUTSIDE * pixels,
                    "{name} by {way:?}: {worst}"
                ),
            }
        }
    }
}

/// Pixels outside holes that are more than 8 steps beyond the range of the drawn picture within a pixel of them. `marked` is the view with
/// its holes marked.
fn odd(exact: &RgbImage, made: &RgbImage, marked: &RgbImage) -> usize {
    let (width, height) = exact.dimensions();
    let all = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    all.filter(|&(x, y)| {
        marked.get_pixel(x, y) == made.get_pixel(x, y) && beyond(exact, made, x, y)
    })
    .count()
}

/// A frame that the panel showed straight from the own view has no tiles of the others; draws over it still appear in all views.
#[test]
fn a_program_that_does_not_clear_draws_on() {
    let program = support::compiled("onward", support::Compiled::Program, &["-lEGL", "-lGL"]);
    let folder = tempfile::tempdir().expect("a folder");
    let expected = support::lines(&mut support::bare(&program));
    assert_eq!(expected.matches("error 0x0").count(), 8, "{expected}");
    let report = folder.path().join("report.json");
    for frame in ["1", "2", "3", "4", "5", "6", "7", "8"] {
        let picture = |strategy: &str| {
            let out = folder.path().join(format!("{strategy}-{frame}.png"));
            let options = [
                ("DISPLAY", "lenticular-5"),
                ("STRATEGY", strategy),
                ("SEPARATION", "0.08"),
                ("REPORT", report.to_str().expect("UTF-8")),
                ("CONVERGENCE", "6"),
                ("CAPTURE_OUT", out.to_str().expect("UTF-8")),
                ("CAPTURE_FRAMES", frame),
            ];
            assert_eq!(
                support::lines(&mut support::layered(&program, &options)),
                expected
            );
            rgb(&out)
        };
        let (exact, panel) = (picture("replay"), picture("depth-image"));
        let told = std::fs::read_to_string(&report).expect("a report");
        let report: Value = serde_json::from_str(&told).expect("JSON");
        // Two frames begin a scene, two go on with it, two end it; after that nothing is synthesised.
        assert_eq!(made(&report), [4, 2], "{report}");
        // Columns at the edges of four squares, in four of five views.
        let wrong = pixels_over(&exact, &panel, 8);
        println!("frame {frame}: {wrong}");
        assert!(wrong <= 60, "frame {frame}: {wrong} of 3072 pixels");
    }
}

/// Quake's engines blend light with a surface by drawing it again, and draw the weapon in a part of the depth range: all of that belongs to
/// the scene. Glass does not: it has other vertices, or the same ones moved since, or shows their other side.
#[test]
fn another_pass_over_a_surface_has_its_depths() {
    let program = support::compiled("over", support::Compiled::Program, &["-lEGL", "-lGL"]);
    let folder = tempfile::tempdir().expect("a folder");
    let expected = support::lines(&mut support::bare(&program));
    assert_eq!(expected.matches("error 0x0").count(), 4, "{expected}");
    let glass = Some("what is transparent");
    let ways = [
        ("", None),
        ("copied", None),
        ("glass", glass),
        ("moved", glass),
        ("sides", glass),
    ];
    for (argument, reason) in ways {
        let picture = |strategy: &str, holes: &str| {
            let out = folder.path().join("views.png");
            let report = folder.path().join("report.json");
            let options = [
                ("VIEWS", "5"),
                ("STRATEGY", strategy),
                ("HOLES", holes),
                ("EYE_SPACING", "0.1"),
                ("FOCAL_DEPTH", "5"),
                ("REPORT", report.to_str().expect("UTF-8")),
                ("CAPTURE_OUT", out.to_str().expect("UTF-8")),
                ("CAPTURE_WHAT", "atlas"),
                ("CAPTURE_FRAMES", "3"),
            ];
            let mut command = support::layered(&program, &options);
            assert_eq!(support::lines(command.arg(argument)), expected);
            let told = std::fs::read_to_string(&report).expect("a report");
            let told: Value = serde_json::from_str(&told).expect("JSON");
            (rgb(&out), told)
        };
        let (exact, _) = picture("replay", "fill");
        for strategy in ["depth-image", "occlusion", "hybrid"] {
            let (filled, report) = picture(strategy, "fill");
            let (marked, _) = picture(strategy, "mark");
            assert!(made(&report)[1] > 0, "{report}");
            let told = reason.map(|reason| format!("views are synthesised before {reason}"));
            let found = reasons(&report);
            let ends: Vec<_> = found.iter().filter(|r| r.contains("before")).collect();
            assert_eq!(ends, told.iter().collect::<Vec<_>>(), "{strategy}");
            let width = exact.width() / VIEWS;
            for i in 0..VIEWS {
                let tile = |all: &RgbImage| all.view(i * width, 0, width, all.height()).to_image();
                let [exact, filled, marked] = [&exact, &filled, &marked].map(tile);
                let wrong = odd(&exact, &filled, &marked);
                println!("{argument} by {strategy}, view {i}: {wrong}");
                assert!(wrong <= 3, "{argument} by {strategy}, view {i}: {wrong}");
            }
        }
    }
}

/// One true view has no samples of the surfaces that it hides; with three, two see them from the sides.
#[test]
fn what_one_true_view_hides_another_shows() {
    let cameras = ["--separation", "0.04", "--convergence", "8"];
    let holes = |way: &[&str]| {
        let options = [&cameras[..], &["--holes", "mark"], way].concat();
        let (views, _) = views(&["gears"], &options);
        let marked = |view: &RgbImage| view.pixels().filter(|p| p.0 == [255, 0, 255]).count();
        views.iter().map(marked).max().unwrap_or(0)
    };
    let (one, three) = (holes(WAYS[0]), holes(WAYS[3]));
    println!("{one} and {three} of {} pixels", 300 * 220);
    assert!(one >= 600 && three * 10 <= one, "{one} and {three} holes");
}

/// The picture of `over` through a panel of five views, and the report.
fn over(strategy: &[(&str, &str)], arguments: [&str; 2]) -> (RgbImage, Value) {
    let program = support::compiled("over", support::Compiled::Program, &["-lEGL", "-lGL"]);
    let folder = tempfile::tempdir().expect("a folder");
    let [out, report] = ["last.png", "report.json"].map(|name| folder.path().join(name));
    let common = [
        ("DISPLAY", "lenticular-5"),
        ("EYE_SPACING", "0.1"),
        ("FOCAL_DEPTH", "5"),
        ("REPORT", report.to_str().expect("UTF-8")),
        ("CAPTURE_OUT", out.to_str().expect("UTF-8")),
        ("CAPTURE_FRAMES", arguments[1]),
    ];
    let mut bare = support::bare(&program);
    let expected = support::lines(bare.args(arguments));
    let mut command = support::layered(&program, &[&common[..], strategy].concat());
    assert_eq!(support::lines(command.args(arguments)), expected);
    let told = std::fs::read_to_string(&report).expect("a report");
    (rgb(&out), serde_json::from_str(&told).expect("JSON"))
}

/// Colours and depths are cleared by separate commands, after a frame that was shown straight from the own view.
#[test]
fn clears_of_their_own_begin_a_scene() {
    let frames = ["clears", "6"];
    for strategy in ["depth-image", "occlusion", "hybrid"] {
        let (_, report) = over(&[("STRATEGY", strategy)], frames);
        assert_eq!(made(&report), [6, 0], "{strategy}: {report}");
    }
}

/// Frames that cost next to nothing, with a budget of a second each: true views are added one after the other until all are drawn.
#[test]
fn all_views_are_drawn_where_there_is_time() {
    let governed = [("STRATEGY", "hybrid"), ("FPS", "1")];
    let frames = ["", "200"];
    let (exact, _) = over(&[("STRATEGY", "replay")], frames);
    let (last, report) = over(&governed, frames);
    let drawn = report["true_views"].as_array().expect("all frames");
    let drawn: Vec<_> = drawn.iter().filter_map(|frame| frame[1].as_u64()).collect();
    let mut steps = drawn.clone();
    steps.dedup();
    assert_eq!(steps, [2, 3, 4, 5], "{drawn:?}");
    assert_eq!(pixels_over(&exact, &last, 0), 0);

    // Pixels that were cleared only once are in the views that join as well.
    let frames = ["once", "60"];
    let (exact, _) = over(&[("STRATEGY", "replay")], frames);
    let (joined, report) = over(&governed, frames);
    let drawn = report["true_views"].as_array().expect("all frames");
    let drawn: Vec<_> = drawn.iter().filter_map(|frame| frame[1].as_u64()).collect();
    assert!(matches!(drawn.last(), Some(3 | 4)), "{drawn:?}");
    let wrong = pixels_over(&exact, &joined, 8);
    println!("{wrong} pixels");
    assert!(wrong <= 3, "{wrong} of 3072 pixels");
}
