//! The picture of 8 views reaches the screen by every way of loading the layer: the command, variables only, programs that load GL at run
//! time, and glretrace. Each picture is compared bit by bit with the CPU reference, which interleaves the atlas of the same frame of a
//! second run through [`Display::mask`].

use crate::support;
use crate::support::share;
use crate::support::{bare, demo, has, layered, manyview, record, rgb, run_until, screen, succeed};
use image::{RgbImage, imageops};
use manyview::display::{Display, Placement};
use manyview::interleave::{Layout, reference};
use manyview::metric::pixels_over;
use std::path::Path;
use std::process::Command;

const VIEWS: u32 = 8;
const FRAME: &str = "30";
const SIZE: (u32, u32) = (300, 220);
/// Size of the screen that the tests start.
const SCREEN: (u32, u32) = (1920, 1200);

/// glxgears turns with the clock, so it gets a clock of its own: 0.02 s from one reading to the next.
const GLXGEARS: [&str; 6] = [
    "faketime",
    "-f",
    "@2020-01-01 00:00:00 i0.02",
    "glxgears",
    "-geometry",
    "300x220",
];

/// The tiles of an atlas picture.
fn tiles(atlas: &RgbImage, views: u32) -> Vec<RgbImage> {
    let (width, height) = (atlas.width() / views, atlas.height());
    (0..views)
        .map(|view| imageops::crop_imm(atlas, view * width, 0, width, height).to_image())
        .collect()
}

/// The picture of a panel: under X with its own window system it is that of the whole screen, with the window in its corner; elsewhere the
/// picture is the screen.
fn panel(api: &str, atlas: &RgbImage, display: &Display, views: u32) -> RgbImage {
    let tiles = tiles(atlas, views);
    let (width, height) = tiles[0].dimensions();
    let mut placement = Placement::full_screen(width, height);
    if api == "glx" {
        (placement.screen_width, placement.screen_height) = SCREEN;
    }
    let mask = display.mask(&placement, views).expect("a mask");
    reference::interleave(&tiles, &mask).expect("a picture")
}

#[track_caller]
fn same(expected: &RgbImage, actual: &RgbImage, what: &str) {
    within(0, expected, actual, what);
}

/// Checks that two pictures are equal but for some LSB.
#[track_caller]
fn within(lsb: u8, expected: &RgbImage, actual: &RgbImage, what: &str) {
    assert_eq!(expected.dimensions(), actual.dimensions(), "{what}");
    let differing = pixels_over(expected, actual, lsb);
    assert_eq!(
        differing, 0,
        "{what}: pixels that differ by more than {lsb} LSB"
    );
    // If the views did not differ, the comparison would show nothing.
    let first = actual.get_pixel(0, 0);
    assert!(actual.pixels().any(|pixel| pixel != first), "{what}: empty");
}

/// Checks that the views of an atlas are not all the same picture.
#[track_caller]
fn differ(atlas: &RgbImage, views: u32) {
    let tiles = tiles(atlas, views);
    for pair in tiles.windows(2) {
        assert!(
            pixels_over(&pair[0], &pair[1], 0) > 20,
            "neighbouring views have parallax"
        );
    }
}

/// Runs something twice, for the output and for the atlas, and compares. `run` writes one picture of a kind to a path.
#[track_caller]
fn panel_is_the_reference(run: impl Fn(&str, &Path)) {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |what: &str| folder.path().join(what).with_extension("png");
    for what in ["output", "atlas"] {
        run(what, &at(what));
    }
    let (output, atlas) = (rgb(&at("output")), rgb(&at("atlas")));
    assert_eq!(atlas.width(), VIEWS * output.width());
    differ(&atlas, VIEWS);
    same(
        &panel("glx", &atlas, &Display::default(), VIEWS),
        &output,
        "the panel",
    );
}

fn with_command(what: &str, out: &Path, program: &[&str]) -> Command {
    support::library();
    let mut command = manyview();
    command
        .args(["capture", "--frame", FRAME, "--views", "8", "--what", what])
        .arg("--out")
        .arg(out)
        .arg("--")
        .args(program);
    command
}

fn with_variables(what: &str, out: &Path, program: &[&str]) -> Command {
    let out = out.to_str().expect("UTF-8");
    let mut command = layered(
        program[0],
        &[
            ("VIEWS", "8"),
            ("CAPTURE_OUT", out),
            ("CAPTURE_FRAMES", FRAME),
            ("CAPTURE_WHAT", what),
        ],
    );
    command
        .args(&program[1..])
        .stdout(std::process::Stdio::null());
    command
}

#[test]
fn glxgears_by_the_command() {
    if !has("faketime") {
        return;
    }
    let screen = screen();
    panel_is_the_reference(|what, out| {
        succeed(screen.give(&mut with_command(what, out, &GLXGEARS)));
    });
}

#[test]
fn glxgears_by_the_command_without_a_display() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out.png");
    let program = &["glxgears", "-geometry", "300x220"];
    succeed(
        with_command("output", &out, program)
            .env_remove("DISPLAY")
            .env_remove("WAYLAND_DISPLAY"),
    );
    assert_eq!(rgb(&out).dimensions(), SIZE);
}

#[test]
fn glxgears_by_variables_only() {
    if !has("faketime") {
        return;
    }
    let screen = screen();
    panel_is_the_reference(|what, out| {
        run_until(screen.give(&mut with_variables(what, out, &GLXGEARS)), out);
    });
}

#[test]
fn a_program_that_loads_gl_at_run_time() {
    let program = demo("dlopen_gears");
    let program = [
        program.to_str().expect("UTF-8"),
        "--frames",
        "30",
        "--size",
        "300x220",
    ];
    let screen = screen();
    panel_is_the_reference(|what, out| {
        succeed(screen.give(&mut with_variables(what, out, &program)));
    });
    panel_is_the_reference(|what, out| {
        succeed(screen.give(&mut with_command(what, out, &program)));
    });
}

#[test]
fn glretrace_of_a_recording() {
    if !has("apitrace") || !has("glretrace") {
        return;
    }
    let screen = screen();
    let folder = tempfile::tempdir().expect("a folder");
    let gears = demo("gears");
    let program = [
        gears.to_str().expect("UTF-8"),
        "--size",
        "300x220",
        "--frames",
        "40",
    ];
    // The trace ends by itself, however slow the machine is.
    let trace = record(&screen, &program, 120, "gl", folder.path());
    let program = ["glretrace", trace.to_str().expect("UTF-8")];
    panel_is_the_reference(|what, out| {
        succeed(screen.give(&mut with_variables(what, out, &program)));
    });
    panel_is_the_reference(|what, out| {
        succeed(screen.give(&mut with_command(what, out, &program)));
    });
}

/// Frame 2 of a demo, set up by variables: the atlas, the picture of `--what output`, and the window's pixels.
fn demo_pictures(api: &str, options: &[(&str, &str)]) -> (RgbImage, RgbImage, Option<RgbImage>) {
    let screen = support::own_screen();
    let folder = tempfile::tempdir().expect("a folder");
    let (png, ppm) = (folder.path().join("a.png"), folder.path().join("a.ppm"));
    let run = |what: &str, watch: bool| {
        let mut options = options.to_vec();
        options.extend([
            ("CAPTURE_OUT", png.to_str().expect("UTF-8")),
            ("CAPTURE_FRAMES", "2"),
            ("CAPTURE_WHAT", what),
        ]);
        let mut command = layered(demo("teapot"), &options);
        command.args([
            "--api", api, "--frames", "2", "--size", "300x220", "--check",
        ]);
        if watch {
            support::watch_window(&mut command, &support::window_library(), 2, &ppm);
        }
        succeed(screen.give(&mut command));
        rgb(&png)
    };
    let window = api != "osmesa";
    let (atlas, output) = (run("atlas", false), run("output", window));
    (atlas, output, window.then(|| support::window_picture(&ppm)))
}

#[test]
fn every_display_and_api() {
    for (api, display, views) in [
        ("glx", "huebner8", 8),
        ("egl", "huebner8", 8),
        ("osmesa", "huebner8", 8),
        ("glx", "huebner8", 5),
        ("glx", "slanted8", 8),
        ("egl", "lenticular-5", 5),
        ("osmesa", "slanted8", 9),
    ]
    .into_iter()
    .step_by(share::every(2))
    {
        let what = format!("{api} {display} {views}");
        let options = [("VIEWS", &*views.to_string()), ("DISPLAY", display)];
        let (atlas, output, window) = demo_pictures(api, &options);
        differ(&atlas, views);
        let expected = panel(api, &atlas, &Display::named(display).expect("known"), views);
        same(&expected, &output, &what);
        if let Some(window) = window {
            same(&expected, &window, &format!("{what}, the window"));
        }
    }
}

/// Compares the window's picture of a layout with the reference's. Where texels are blended, floats may round the other way: 1 LSB. Where
/// the window is sRGB-capable, as all of Mesa's are, the layer blends in linear light and the reference never does.
#[track_caller]
fn shows(tiles: &[RgbImage], layout: Layout, reference: &RgbImage, window: &RgbImage, what: &str) {
    if let Layout::View(_) = layout {
        return same(reference, window, what);
    }
    if pixels_over(reference, window, 1) > 0 {
        within(1, &linear(tiles, layout), window, what);
    }
}

/// `reference::arrange` at the window's size, in floats and in linear light.
fn linear(tiles: &[RgbImage], layout: Layout) -> RgbImage {
    let views = tiles.len() as u32;
    let (columns, rows) = layout.grid(views);
    let (width, height) = SIZE;
    // Cell, the two texels, and the weight of the second.
    let tap = |at: u32, size: u32, cells: u32| {
        let cell = (2 * at + 1) * cells / (2 * size);
        let place = (f64::from(at) + 0.5) * f64::from(cells) - f64::from(cell * size) - 0.5;
        let last = f64::from(size - 1);
        let texel = |place: f64| place.clamp(0.0, last) as u32;
        let low = place.floor();
        (cell, texel(low), texel(low + 1.0), place - low)
    };
    RgbImage::from_fn(width, height, |x, y| {
        let ((column, x0, x1, wx), (row, y0, y1, wy)) =
            (tap(x, width, columns), tap(y, height, rows));
        let Some(view) = layout.view_at(column, row, views) else {
            return image::Rgb([0; 3]);
        };
        let tile = &tiles[view as usize];
        image::Rgb([0, 1, 2].map(|channel| {
            let value = |x, y| decode(tile.get_pixel(x, y).0[channel]);
            let upper = value(x0, y0) * (1.0 - wx) + value(x1, y0) * wx;
            let lower = value(x0, y1) * (1.0 - wx) + value(x1, y1) * wx;
            encode(upper * (1.0 - wy) + lower * wy)
        }))
    })
}

fn decode(value: u8) -> f64 {
    let v = f64::from(value) / 255.0;
    if v <= 0.04045 {
        v / 12.92
    } else {
        ((v + 0.055) / 1.055).powf(2.4)
    }
}

fn encode(v: f64) -> u8 {
    let s = if v <= 0.003_130_8 {
        v * 12.92
    } else {
        1.055 * v.powf(1.0 / 2.4) - 0.055
    };
    (s * 255.0).round() as u8
}

/// The written picture has all pixels of all tiles; the window's is the same, resampled to the window.
#[test]
fn quilts_rows_and_single_views() {
    for (api, output, layout, views) in [
        ("glx", "quilt", Layout::quilt(8, None), 8),
        ("egl", "quilt", Layout::quilt(9, None), 9),
        ("osmesa", "quilt", Layout::quilt(5, None), 5),
        ("glx", "sbs", Layout::SideBySide { half: false }, 8),
        ("glx", "sbs", Layout::SideBySide { half: false }, 2),
        ("egl", "sbs", Layout::SideBySide { half: false }, 3),
        ("glx", "view:0", Layout::View(0), 8),
        ("egl", "view:3", Layout::View(3), 8),
        ("osmesa", "view:7", Layout::View(7), 8),
    ] {
        let layouts = ["side-by-side", "layers"];
        for atlas_layout in layouts.into_iter().step_by(share::every(2)) {
            let what = format!("{api} {output} {views} {atlas_layout}");
            let count = views.to_string();
            let options = [
                ("VIEWS", count.as_str()),
                ("OUTPUT", output),
                ("ATLAS", atlas_layout),
            ];
            let (atlas, written, window) = demo_pictures(api, &options);
            let tiles = tiles(&atlas, views);
            let whole = reference::arrange(&tiles, layout, layout.native_size(views, SIZE));
            same(&whole.expect("a picture"), &written, &what);
            if let Some(window) = window {
                let shown = reference::arrange(&tiles, layout, SIZE).expect("a picture");
                shows(
                    &tiles,
                    layout,
                    &shown,
                    &window,
                    &format!("{what}, the window"),
                );
            }
        }
    }
}

/// Without the layer the window shows the picture that the demo reads back, as the other tests assume.
#[test]
fn the_window_shows_what_a_program_draws() {
    let screen = support::own_screen();
    let folder = tempfile::tempdir().expect("a folder");
    let (png, ppm) = (folder.path().join("a.png"), folder.path().join("a.ppm"));
    for api in ["glx", "egl"] {
        let mut command = bare(demo("teapot"));
        command.args(["--api", api, "--frames", "2", "--size", "300x220", "--dump"]);
        command.arg(&png);
        support::watch_window(&mut command, &support::window_library(), 2, &ppm);
        succeed(screen.give(&mut command));
        same(&rgb(&png), &support::window_picture(&ppm), api);
    }
}
