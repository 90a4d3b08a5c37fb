//! Programs ask for state and results and use rare commands: all answers are those without the layer, and what is drawn is in every
//! view. (The programs lie in tests/answers; their heads list the modes.)

mod lists;

use crate::support::share;
use crate::support::views::{REPLAYED, VIEWS, Views, extents};
use crate::support::{
    Compiled, bare, built, extent, layered, lines, preloaded, rgb, window_picture,
};
use image::{RgbImage, imageops};
use std::path::{Path, PathBuf};
use std::process::Command;

const ATLASES: [&str; 2] = ["side-by-side", "layers"];

/// A program of tests/answers.
fn program(name: &str) -> PathBuf {
    let source = Path::new("tests/answers").join(name).with_extension("c");
    let libraries = ["-lEGL", "-lGL", "-lX11"];
    let built_as = format!("answers-{name}");
    built(
        &built_as,
        &[source.as_path()],
        Compiled::Program,
        &libraries,
    )
}

/// Lets a command of `timeout` run a program.
fn limited(mut timeout: Command, program: &Path, arguments: &[&str]) -> Command {
    timeout.args(["-k", "2", "20"]).arg(program).args(arguments);
    timeout
}

/// A program with a time limit, bare.
fn plain(program: &Path, arguments: &[&str]) -> Command {
    limited(bare("timeout"), program, arguments)
}

/// A program with a time limit, under the layer.
fn under(program: &Path, arguments: &[&str], options: &[(&str, &str)]) -> Command {
    limited(layered("timeout", options), program, arguments)
}

/// The views of an atlas.
fn tiles(all: &RgbImage) -> Vec<RgbImage> {
    let (width, height) = (all.width() / VIEWS, all.height());
    let tile = |view| imageops::crop_imm(all, view * width, 0, width, height).to_image();
    (0..VIEWS).map(tile).collect()
}

/// Checks that a program prints the same bare and in three views, and that all views of a frame are the same: what it draws is flat, or
/// at the depth of zero parallax.
#[track_caller]
fn alike(name: &str, arguments: &[&str], frame: u32) {
    let program = program(name);
    let expected = lines(&mut plain(&program, arguments));
    for atlas in ATLASES {
        let views = Views {
            atlas,
            frame,
            ..REPLAYED
        };
        let (told, all) = views.shown(&mut under(&program, arguments, &[]));
        assert_eq!(told, expected, "{name} {arguments:?}, {atlas}");
        let tiles = tiles(&all);
        for (view, tile) in tiles.iter().enumerate() {
            let differing = manyview::metric::pixels_over(&tiles[1], tile, 0);
            assert_eq!(differing, 0, "{name} {arguments:?}, {atlas}, view {view}");
        }
    }
}

/// As [`alike`], with the shaders that move nothing, and with a camera.
#[track_caller]
fn alike_by_both_shaders(name: &str, mode: &str, frame: u32) {
    for shaders in ["flat", "camera"] {
        alike(name, &[mode, shaders], frame);
    }
}

/// Checks that what a program with feedback draws at a depth of 4 has the parallax of each view.
#[track_caller]
fn moved_beside_feedback(mode: &str) {
    let (program, arguments) = (program("feedback"), [mode, "camera"]);
    for atlas in ATLASES {
        let views = Views {
            atlas,
            convergence: 8.0,
            ..REPLAYED
        };
        let (_, all) = views.shown(&mut under(&program, &arguments, &[]));
        // Moved by ±0.4 · (4 − 8) / 4 in 32 columns: to the right for the left camera.
        let [left, own, right] = extents(&all, [0, 255, 0]);
        for (at, shift) in [(left, 12.8), (right, -12.8)] {
            let by = [at[0] - own[0], at[1] - own[1]];
            assert!(
                by.iter().all(|by: &f64| (by - shift).abs() <= 1.5),
                "{mode}, {atlas}: {by:?} for {shift}"
            );
        }
    }
}

/// Checks that what shaders write to memory is what they write without the layer, and that each view has the picture of its own camera.
#[track_caller]
fn written_once(mode: &str) {
    let program = program("effects");
    let expected = lines(&mut plain(&program, &[mode]));
    for (atlas, strategy) in [
        ("side-by-side", "replay"),
        ("layers", "replay"),
        ("layers", "instanced"),
        ("layers", "hybrid"),
    ] {
        for frame in [1, 2] {
            let views = Views {
                atlas,
                strategy,
                frame,
                ..REPLAYED
            };
            let (told, all) = views.shown(&mut under(&program, &[mode], &[]));
            assert_eq!(told, expected, "{mode}, {atlas}, {strategy}");
            // What is executed while it is compiled is drawn in the own view first, and the others begin with what that has written.
            let first = mode == "executed";
            let red = manyview::metric::pixels_over(
                &all,
                &RgbImage::from_fn(all.width(), all.height(), |x, y| {
                    let [_, green, blue] = all.get_pixel(x, y).0;
                    image::Rgb([0, green, blue])
                }),
                0,
            );
            assert!(
                first || red == 0,
                "{mode}, {atlas}, {strategy}: views go on with each other's"
            );
            if first || mode == "pixels" || mode == "pipeline" {
                continue;
            }
            if mode == "nowhere" {
                // What is drawn nowhere is drawn once.
                let [left, own, right] = extents(&all, [0, 255, 0]);
                assert!(left == own && own == right && own[1] > own[0]);
                continue;
            }
            // At depth 2, moved by ±0.4 · (2 − 4) / 2 in 32 columns.
            let [left, own, right] = extents(&all, [0, 255, 0]);
            for (at, shift) in [(left, 12.8), (right, -12.8)] {
                let by = at[0] - own[0];
                assert!(
                    (by - shift).abs() <= 1.5,
                    "{mode}, {atlas}, {strategy}: {by} for {shift}"
                );
            }
        }
    }
}

#[test]
fn counters_are_counted_once() {
    for mode in ["counter", "list", "executed", "pixels"] {
        written_once(mode);
    }
}

#[test]
fn images_are_written_once_and_shown_by_each_view() {
    for mode in ["image", "level", "atomic", "nowhere"] {
        written_once(mode);
    }
}

#[test]
fn storage_blocks_are_written_once() {
    for mode in ["storage", "vertex", "rebound", "arrays", "readonly"] {
        written_once(mode);
    }
    alike("unhooked", &["esblock"], 1);
}

#[test]
fn program_pipelines_write_once() {
    written_once("pipeline");
}

#[test]
fn what_is_fed_back_is_fed_back_once_and_drawn_in_every_view() {
    for mode in ["active", "discard", "again", "clear", "copy", "offscreen"] {
        alike_by_both_shaders("feedback", mode, 1);
    }
}

#[test]
fn what_is_drawn_while_feedback_is_paused_is_in_every_view() {
    for mode in ["paused", "program", "object"] {
        alike_by_both_shaders("feedback", mode, 1);
    }
}

#[test]
fn what_is_drawn_while_feedback_is_active_has_parallax() {
    for mode in ["active", "paused", "program", "offscreen"] {
        moved_beside_feedback(mode);
    }
}

#[test]
fn a_frame_ends_while_feedback_is_active() {
    for mode in ["swap", "pausedswap"] {
        for frame in [1, 2] {
            alike_by_both_shaders("feedback", mode, frame);
        }
    }
    // The panel's picture is made by passes, which draw.
    let folder = tempfile::tempdir().expect("a folder");
    let picture = folder.path().join("frame.png");
    let options = [
        ("VIEWS", "3"),
        ("OUTPUT", "panel"),
        ("CAPTURE_OUT", picture.to_str().expect("UTF-8")),
        ("CAPTURE_FRAMES", "1"),
    ];
    lines(&mut under(
        &program("feedback"),
        &["swap", "flat"],
        &options,
    ));
    // The first of three bars.
    assert_eq!(extent(&rgb(&picture), 1, 0, [255, 0, 0]), [6.0, 18.0]);
}

/// Between glBegin and glEnd the driver has a primitive without vertices, which feedback takes as well.
#[test]
fn primitives_begin_while_feedback_is_active() {
    alike("immediate", &[], 1);
}

#[test]
fn what_is_told_while_feedback_is_active_is_told_once() {
    alike_by_both_shaders("feedback", "told", 1);
}

#[test]
fn feedback_that_is_refused_changes_nothing() {
    for mode in ["wrong", "failed"] {
        alike_by_both_shaders("feedback", mode, 1);
    }
}

#[test]
fn every_viewport_stays_where_the_program_has_put_it() {
    for mode in ["viewport", "array", "fraction", "all", "list"] {
        alike("indexed", &[mode], 2);
    }
}

#[test]
fn every_scissor_test_is_as_the_program_has_switched_it() {
    for mode in ["scissor", "first", "copied"] {
        alike("indexed", &[mode], 2);
    }
}

#[test]
fn every_depth_range_keeps_its_place() {
    alike("indexed", &["range"], 2);
}

#[test]
fn no_state_changes_between_two_commands() {
    let program = program("state");
    for mode in ["default", "set", "program", "pipeline", "framebuffer"] {
        let expected = lines(&mut plain(&program, &[mode]));
        assert!(!expected.contains("became"), "{mode}: {expected}");
        for atlas in ATLASES {
            for (strategy, output) in [
                ("replay", "panel"),
                ("replay", "rgbd"),
                ("depth-image", "panel"),
                ("occlusion", "panel"),
            ] {
                let options = [
                    ("VIEWS", "3"),
                    ("ATLAS", atlas),
                    ("STRATEGY", strategy),
                    ("OUTPUT", output),
                ];
                let told = lines(&mut under(&program, &[mode], &options));
                assert_eq!(told, expected, "{mode}, {options:?}");
            }
        }
    }
}

#[test]
fn draws_whose_count_lies_in_a_buffer_are_in_every_view() {
    for mode in ["arrays", "elements"] {
        alike("unhooked", &[mode], 1);
    }
}

#[test]
fn a_camera_in_a_block_that_is_flat_in_the_menu_before_it_is_found() {
    zoomed("level");
}

#[test]
fn uniforms_of_64_bits_are_those_of_every_view() {
    for mode in ["double", "long"] {
        alike("unhooked", &[mode], 1);
    }
}

#[test]
fn draws_in_several_primitive_modes_are_in_every_view() {
    for mode in ["modes", "modeelements"] {
        alike("unhooked", &[mode], 1);
    }
}

/// The modes of unhooked.c in which a texture is written that was drawn to.
const WRITES: [&str; 11] = [
    "image",
    "subimage",
    "bound",
    "multi",
    "copied",
    "boundcopied",
    "corecopied",
    "unitcopied",
    "mipmap",
    "unitmipmap",
    "nvcopied",
];

#[test]
fn textures_that_are_written_show_what_was_written() {
    for mode in WRITES {
        alike("unhooked", &[mode], 1);
    }
}

#[test]
fn textures_that_display_lists_write_show_what_was_written() {
    for mode in WRITES.into_iter().step_by(share::every(3)) {
        for listed in ["list", "execute"] {
            alike("unhooked", &[mode, listed], 1);
        }
    }
    // No list compiles this command.
    alike("unhooked", &["corecopied", "within"], 1);
}

#[test]
fn textures_of_the_views_have_the_parameters_of_the_programs() {
    for mode in ["filter", "pushed"] {
        alike("unhooked", &[mode], 1);
        for listed in ["list", "execute"] {
            alike("unhooked", &[mode, listed], 1);
        }
    }
}

#[test]
fn framebuffers_get_other_images_by_their_names() {
    for mode in ["attached", "renderbuffer", "named", "readbuffers"] {
        alike("unhooked", &[mode], 1);
    }
}

#[test]
fn a_raster_position_with_four_coordinates_is_a_place_in_the_window() {
    alike("unhooked", &["windowpos"], 1);
}

#[test]
fn queries_of_all_kinds_count_what_is_drawn_once() {
    for mode in [
        "indexed",
        "statistics",
        "results",
        "resultsbound",
        "resultsfixed",
    ] {
        alike("unhooked", &[mode], 1);
    }
}

#[test]
fn a_primitive_is_restarted_within_it() {
    alike("unhooked", &["restart"], 1);
}

#[test]
fn an_extension_of_embedded_contexts_chooses_draw_buffers() {
    alike("unhooked", &["buffers"], 1);
}

#[test]
fn subroutines_are_those_that_were_chosen() {
    for frame in [1, 2] {
        alike("unhooked", &["subroutine"], frame);
    }
}

/// The picture of a view that a program draws itself.
fn drawn(program: &Path, mode: &str, view: u32, frame: u32) -> RgbImage {
    let folder = tempfile::tempdir().expect("a folder");
    let picture = folder.path().join("frame.ppm");
    let path = picture.to_str().expect("UTF-8");
    let (view, frame) = (view.to_string(), frame.to_string());
    lines(&mut plain(program, &[mode, &view, &frame, path]));
    window_picture(&picture)
}

/// Checks the views before and after the camera has zoomed against those that the program draws itself.
#[track_caller]
fn zoomed(mode: &str) {
    let program = program("blocks");
    let expected = lines(&mut plain(&program, &[mode, "1", "0"]));
    for (frame, strategy) in [(2, "replay"), (5, "replay"), (5, "instanced")] {
        let folder = tempfile::tempdir().expect("a folder");
        let picture = folder.path().join("frame.png");
        let frames = frame.to_string();
        let options = [
            ("VIEWS", "3"),
            ("STRATEGY", strategy),
            ("ATLAS", "layers"),
            // As in the program.
            ("EYE_SPACING", "0.4"),
            ("FOCAL_DEPTH", "4"),
            ("CAPTURE_OUT", picture.to_str().expect("UTF-8")),
            ("CAPTURE_FRAMES", &*frames),
            ("CAPTURE_WHAT", "atlas"),
        ];
        let told = lines(&mut under(&program, &[mode, "1", "0"], &options));
        assert_eq!(told, expected, "{mode}, {strategy}");
        for (view, tile) in (0..).zip(tiles(&rgb(&picture))) {
            let own = drawn(&program, mode, view, frame);
            let differing = manyview::metric::pixels_over(&own, &tile, 0);
            // A camera that is not followed is wrong in hundreds of pixels.
            assert!(
                differing <= 8,
                "{mode}, {strategy}, frame {frame}, view {view}: {differing} pixels"
            );
        }
    }
}

#[test]
fn a_camera_in_a_plain_uniform_zooms() {
    for mode in ["subdata", "weapon", "flat", "level", "menu"] {
        zoomed(&format!("uniform{mode}"));
    }
}

/// Ways to change a camera in a uniform block that every program uses.
const WAYS: [&str; 8] = [
    "subdata", "mapped", "coherent", "before", "copied", "range", "weapon", "compute",
];

#[test]
fn a_camera_in_a_uniform_block_zooms() {
    WAYS.iter().for_each(|mode| zoomed(mode));
}

#[test]
#[ignore = "half a minute: make test-long"]
fn a_camera_in_a_uniform_block_zooms_in_every_way() {
    let others = [
        "data",
        "named",
        "orphaned",
        "flushed",
        "persistent",
        "base",
        "multi",
        "binding",
        "feedback",
        "pixels",
        "cleared",
        "flat",
        "level",
        "menu",
        "rows",
    ];
    others.iter().for_each(|mode| zoomed(mode));
}

/// What the program writes is in the layer's hands: no buffer is read back, except what shaders have written, and that once.
#[test]
fn cameras_in_uniform_blocks_are_not_asked_for() {
    let source = Path::new("tests/answers/asked.c");
    let behind = built("asked", &[source], Compiled::Library, &["-ldl"]);
    let both = format!("{}:{}", preloaded(), behind.display());
    let folder = tempfile::tempdir().expect("a folder");
    let (told, program) = (folder.path().join("asked"), program("blocks"));
    for (mode, most) in [
        ("data", 0),
        ("subdata", 0),
        ("weapon", 0),
        ("mapped", 0),
        ("flushed", 0),
        ("coherent", 0),
        ("before", 0),
        ("copied", 0),
        ("range", 0),
        ("binding", 0),
        ("compute", 1),
    ] {
        let mut command = under(&program, &[mode, "1", "0"], &[("VIEWS", "3")]);
        command.env("LD_PRELOAD", &both).env("ASKED", &told);
        lines(&mut command);
        // Also of the command that limits the time.
        let counts = std::fs::read_to_string(&told).expect("counts");
        std::fs::remove_file(&told).expect("removed");
        let asked: u32 = counts
            .lines()
            .map(|n| n.parse::<u32>().expect("a number"))
            .sum();
        assert_eq!(asked, most, "{mode}");
    }
}

/// Gaps that are known, and stated in docs/limits.md: a mode that is mended fails here, and gets a test of its own.
#[test]
#[ignore = "seconds: make test-full"]
fn full_gaps_are_still_there() {
    // Which camera of an array is used, and which numbers of a storage buffer are a matrix, is in the shader alone.
    const MODES: [&str; 2] = ["element", "storage"];
    // Without the layer all of them run here.
    for mode in MODES {
        lines(&mut plain(&program("blocks"), &[mode, "1", "0"]));
    }
    let is_right = |mode: &str| std::panic::catch_unwind(|| zoomed(mode)).is_ok();
    let mended: Vec<_> = MODES.iter().filter(|mode| is_right(mode)).collect();
    assert!(mended.is_empty(), "right now: {mended:?}");
}
