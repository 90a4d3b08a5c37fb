//! Outputs that depend on the place of the window, and those for two eyes, against pictures that this file puts together from the tiles of
//! the same frame of a second run.

use crate::support;
use crate::support::{Compiled, Screen, compiled, layered, own_screen, rgb, succeed};
use image::{Rgb, RgbImage, imageops};
use manyview::config::Filter;
use manyview::display::{Display, Placement};
use manyview::interleave::reference;

/// Places of the window in tests/support/c/moves.c, and a frame that each is shown in.
const PLACES: [(i32, i32, usize); 3] = [(7, 5, 2), (8, 5, 4), (8, 6, 6)];
/// Size of the screen that the tests start.
const SCREEN: (u32, u32) = (1920, 1200);

/// Frames 1 to 6 of the program that moves its window.
fn frames(screen: &Screen, views: u32, options: &[(&str, &str)], what: &str) -> Vec<RgbImage> {
    frames_of(screen, views, options, what, &[])
}

/// [`frames`] with arguments for the program.
fn frames_of(
    screen: &Screen,
    views: u32,
    options: &[(&str, &str)],
    what: &str,
    arguments: &[&str],
) -> Vec<RgbImage> {
    let program = program();
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("%d.png");
    let count = views.to_string();
    let mut all = vec![
        ("VIEWS", count.as_str()),
        ("CAPTURE_OUT", out.to_str().expect("UTF-8")),
        ("CAPTURE_FRAMES", "1..6"),
        ("CAPTURE_WHAT", what),
        // Far enough apart for a visible disparity in 96 pixels.
        ("EYE_SPACING", "0.3"),
        ("FOCAL_DEPTH", "8"),
    ];
    all.extend(options);
    succeed(screen.give(layered(&program, &all).args(arguments)));
    let frame = |i: i32| rgb(&folder.path().join(format!("{i}.png")));
    (1..=6).map(frame).collect()
}

fn program() -> std::path::PathBuf {
    compiled("moves", Compiled::Program, &["-lGL", "-lEGL", "-lX11"])
}

fn tiles(atlas: &RgbImage, views: u32) -> Vec<RgbImage> {
    let (width, height) = (atlas.width() / views, atlas.height());
    (0..views)
        .map(|view| imageops::crop_imm(atlas, view * width, 0, width, height).to_image())
        .collect()
}

#[track_caller]
fn same(expected: &RgbImage, actual: &RgbImage, lsb: i32, what: &str) {
    assert_eq!(expected.dimensions(), actual.dimensions(), "{what}");
    let far = |a: &Rgb<u8>, b: &Rgb<u8>| {
        let pairs = a.0.into_iter().zip(b.0);
        pairs
            .map(|(a, b)| (i32::from(a) - i32::from(b)).abs())
            .max()
            > Some(lsb)
    };
    let wrong = expected
        .pixels()
        .zip(actual.pixels())
        .filter(|(a, b)| far(a, b))
        .count();
    assert_eq!(wrong, 0, "{what}: pixels that differ by more than {lsb}");
}

/// Interlaced stereo follows the pixels of the screen: exact also after the window moved by one pixel to the right, and by one down.
#[test]
fn interlaced_outputs_follow_the_window() {
    let screen = own_screen();
    for views in [2u32, 5] {
        let atlas = frames(&screen, views, &[], "atlas");
        for (output, right) in [
            ("rows", (|_, y| y % 2 == 1) as fn(i32, i32) -> bool),
            ("columns", |x, _| x % 2 == 1),
            ("checker", |x, y| (x + y) % 2 == 1),
        ] {
            let shown = frames(&screen, views, &[("OUTPUT", output)], "output");
            for (x, y, frame) in PLACES {
                let tiles = tiles(&atlas[frame - 1], views);
                let (left, last) = (&tiles[0], &tiles[views as usize - 1]);
                assert_ne!(left, last, "the eyes differ");
                let expected = RgbImage::from_fn(left.width(), left.height(), |px, py| {
                    let eye = if right(x + px as i32, y + py as i32) {
                        last
                    } else {
                        left
                    };
                    *eye.get_pixel(px, py)
                });
                same(
                    &expected,
                    &shown[frame - 1],
                    0,
                    &format!("{output} of {views} at {x},{y}"),
                );
            }
        }
    }
}

/// The same for a drawable of glXCreateWindow, which GLFW and others draw to.
#[test]
fn drawables_of_windows_follow_them() {
    let screen = own_screen();
    let options = [("OUTPUT", "checker")];
    let plain = frames(&screen, 2, &options, "output");
    let drawable = frames_of(&screen, 2, &options, "output", &["drawable"]);
    for (x, y, frame) in PLACES {
        same(
            &plain[frame - 1],
            &drawable[frame - 1],
            0,
            &format!("at {x},{y}"),
        );
    }
    assert_ne!(plain[1], plain[3], "the phase moved");
}

/// The same under EGL, which takes the window itself or its address.
#[test]
fn surfaces_of_egl_follow_their_windows() {
    let screen = own_screen();
    for views in [2, 3] {
        let options = [("OUTPUT", "checker")];
        let plain = frames(&screen, views, &options, "output");
        assert_ne!(plain[1], plain[3], "the phase moved");
        for words in [&["egl"][..], &["egl", "platform"]] {
            let surface = frames_of(&screen, views, &options, "output", words);
            for (x, y, frame) in PLACES {
                let what = format!("{words:?} at {x},{y}");
                same(&plain[frame - 1], &surface[frame - 1], 0, &what);
            }
        }
    }
}

#[test]
fn masks_follow_the_window() {
    let screen = own_screen();
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("panel.toml");
    let text = "kind = \"slanted\"\nviews = 7\npitch = \"16/3\"\nslant = \"2/3\"\noffset = 0.25";
    std::fs::write(&file, text).expect("written");
    let sheet = file.to_str().expect("UTF-8");
    for (name, layout) in [
        (sheet, "side-by-side"),
        (sheet, "layers"),
        ("huebner8", "side-by-side"),
        ("huebner8", "layers"),
        ("lenticular-7", "side-by-side"),
        ("lenticular-7", "layers"),
    ] {
        let display = Display::load(name).expect("a display");
        let atlas = frames(&screen, 7, &[("ATLAS", layout)], "atlas");
        let shown = frames(
            &screen,
            7,
            &[("DISPLAY", name), ("ATLAS", layout)],
            "output",
        );
        for (x, y, frame) in PLACES {
            let tiles = tiles(&atlas[frame - 1], 7);
            let at = Placement {
                screen_width: SCREEN.0,
                screen_height: SCREEN.1,
                x,
                y,
                width: tiles[0].width(),
                height: tiles[0].height(),
            };
            let mask = display.mask(&at, 7).expect("a mask");
            let expected = reference::interleave(&tiles, &mask).expect("a picture");
            same(
                &expected,
                &shown[frame - 1],
                0,
                &format!("{name} {layout} at {x},{y}"),
            );
        }
        assert_ne!(shown[1], shown[3], "{name}: the phase moved");
    }
}

#[test]
fn filtered_panels_are_the_reference() {
    let screen = own_screen();
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("panel.toml");
    let text = "kind = \"slanted\"\nviews = 7\npitch = 18.6579\nslant = -0.41\noffset = 0.25";
    std::fs::write(&file, text).expect("written");
    let name = file.to_str().expect("UTF-8");
    let display = Display::load(name).expect("a display");
    let atlas = frames(&screen, 7, &[], "atlas");
    let tiles = tiles(&atlas[1], 7);
    let at = Placement {
        screen_width: SCREEN.0,
        screen_height: SCREEN.1,
        x: PLACES[0].0,
        y: PLACES[0].1,
        width: tiles[0].width(),
        height: tiles[0].height(),
    };
    let mask = display.fine_mask(&at, 7).expect("a mask");
    let nearest = frames(&screen, 7, &[("DISPLAY", name)], "output");
    for (word, filter) in [("blend", Filter::Blend), ("gaussian", Filter::Gaussian)] {
        let shown = frames(&screen, 7, &[("DISPLAY", name), ("FILTER", word)], "output");
        let expected = reference::filtered(&tiles, &mask, filter).expect("a picture");
        // The driver's floats may round the other way.
        same(&expected, &shown[1], 1, word);
        assert_ne!(shown[1], nearest[1], "{word} does something");
    }
}

/// The own view beside its captured depth, by an implementation of its own: white is the nearest and black the farthest depth that was
/// drawn, without the extreme 0.5 % on each side; grey is linear in the depth buffer.
fn beside_depth(own: &RgbImage, depth: &[f64], size: (u32, u32)) -> RgbImage {
    let (width, height) = own.dimensions();
    let mut drawn: Vec<f64> = depth.iter().copied().filter(|d| *d < 1.0).collect();
    drawn.sort_by(f64::total_cmp);
    let outside = drawn.len() / 200;
    let (near, far) = (drawn[outside], drawn[drawn.len() - 1 - outside]);
    RgbImage::from_fn(size.0, size.1, |x, y| {
        let at = |num: u32, den: u32, of: u32| {
            ((f64::from(num) + 0.5) / f64::from(den) * f64::from(of)) as u32
        };
        let (column, row) = (at(x, size.0, 2 * width), at(y, size.1, height));
        if column < width {
            return if size.0 == width {
                mean(own.get_pixel(2 * x, y), own.get_pixel(2 * x + 1, y))
            } else {
                *own.get_pixel(column, row)
            };
        }
        let d = depth[(row * width + column - width) as usize];
        let grey = ((far - d) / (far - near)).clamp(0.0, 1.0);
        Rgb([(grey * 255.0).round() as u8; 3])
    })
}

#[test]
fn depth_beside_colour() {
    let screen = own_screen();
    let folder = tempfile::tempdir().expect("a folder");
    let ppm = folder.path().join("window.ppm");
    for (views, words) in [
        (1, &[][..]),
        (3, &[]),
        (2, &["reversed"]),
        (3, &["samples"]),
        (1, &["egl"]),
    ] {
        let what = format!("{views} views {words:?}");
        let pictures = |what| frames_of(&screen, views, &[("OUTPUT", "rgbd")], what, words);
        let own = format!("view:{}", (views - 1) / 2);
        let own = pictures(&own).swap_remove(1);
        let written = pictures("output").swap_remove(1);
        let out = folder.path().join("depth.png");
        let count = views.to_string();
        let options = [
            ("VIEWS", count.as_str()),
            ("OUTPUT", "rgbd"),
            ("CAPTURE_OUT", out.to_str().expect("UTF-8")),
            ("CAPTURE_FRAMES", "2"),
            ("CAPTURE_WHAT", "depth"),
            ("EYE_SPACING", "0.3"),
            ("FOCAL_DEPTH", "8"),
        ];
        let mut command = layered(program(), &options);
        command.args(words);
        support::watch_window(&mut command, &support::window_library(), 2, &ppm);
        succeed(screen.give(&mut command));
        let depth = image::open(&out).expect("a picture").into_luma16();
        let far_is_1 = |v: u16| {
            let d = f64::from(v) / 65535.0;
            if words.contains(&"reversed") {
                1.0 - d
            } else {
                d
            }
        };
        let depth: Vec<f64> = depth.iter().map(|&v| far_is_1(v)).collect();
        let (width, height) = own.dimensions();
        same(
            &beside_depth(&own, &depth, (2 * width, height)),
            &written,
            1,
            &what,
        );
        let window = support::window_picture(&ppm);
        same(
            &beside_depth(&own, &depth, (width, height)),
            &window,
            1,
            &format!("{what}, the window"),
        );
        let grey = |x, y| written.get_pixel(width + x, y).0[0];
        let greys: std::collections::BTreeSet<u8> = (0..width).map(|x| grey(x, 40)).collect();
        assert!(greys.len() > 4 && greys.contains(&0), "{what}: {greys:?}");
    }
}

/// The picture through coloured glasses, in floats, by the published matrices.
fn mixed(left: &RgbImage, right: &RgbImage, l: [[f64; 3]; 3], r: [[f64; 3]; 3]) -> RgbImage {
    let linear = |v: u8| {
        let v = f64::from(v) / 255.0;
        if v <= 0.04045 {
            v / 12.92
        } else {
            ((v + 0.055) / 1.055).powf(2.4)
        }
    };
    let encoded = |v: f64| {
        let v = v.clamp(0.0, 1.0);
        let s = if v <= 0.003_130_8 {
            12.92 * v
        } else {
            1.055 * v.powf(1.0 / 2.4) - 0.055
        };
        (255.0 * s).round() as u8
    };
    RgbImage::from_fn(left.width(), left.height(), |x, y| {
        let [a, b] = [left, right].map(|eye| eye.get_pixel(x, y).0.map(linear));
        let row = |i: usize| (0..3).map(|c| l[i][c] * a[c] + r[i][c] * b[c]).sum::<f64>();
        Rgb([0, 1, 2].map(|i| encoded(row(i))))
    })
}

#[test]
fn anaglyphs() {
    const NO: [f64; 3] = [0.0; 3];
    const GREY: [f64; 3] = [0.2126, 0.7152, 0.0722];
    const RED: [f64; 3] = [1.0, 0.0, 0.0];
    const GREEN: [f64; 3] = [0.0, 1.0, 0.0];
    const BLUE: [f64; 3] = [0.0, 0.0, 1.0];
    let screen = own_screen();
    let atlas = frames(&screen, 3, &[], "atlas");
    let tiles = tiles(&atlas[1], 3);
    for (kind, left, right) in [
        (
            "red-cyan",
            [
                [0.437, 0.449, 0.164],
                [-0.062, -0.062, -0.024],
                [-0.048, -0.050, -0.017],
            ],
            [
                [-0.011, -0.032, -0.007],
                [0.377, 0.761, 0.009],
                [-0.026, -0.093, 1.234],
            ],
        ),
        (
            "green-magenta",
            [
                [-0.062, -0.158, -0.039],
                [0.284, 0.668, 0.143],
                [-0.015, -0.027, 0.021],
            ],
            [
                [0.529, 0.705, 0.024],
                [-0.016, -0.015, -0.065],
                [0.009, 0.075, 0.937],
            ],
        ),
        (
            "amber-blue",
            [
                [1.062, -0.205, 0.299],
                [-0.026, 0.908, 0.068],
                [-0.038, -0.173, 0.022],
            ],
            [
                [-0.016, -0.123, -0.017],
                [0.006, 0.062, -0.017],
                [0.094, 0.185, 0.911],
            ],
        ),
        ("red-cyan-half", [GREY, NO, NO], [NO, GREEN, BLUE]),
        ("green-magenta-half", [NO, GREY, NO], [RED, NO, BLUE]),
        ("amber-blue-half", [RED, GREEN, NO], [NO, NO, GREY]),
        ("red-cyan-grey", [GREY, NO, NO], [NO, GREY, GREY]),
        ("green-magenta-grey", [NO, GREY, NO], [GREY, NO, GREY]),
        ("amber-blue-grey", [GREY, GREY, NO], [NO, NO, GREY]),
    ] {
        let output = format!("anaglyph:{kind}");
        let shown = frames(&screen, 3, &[("OUTPUT", &output)], "output");
        let expected = mixed(&tiles[0], &tiles[2], left, right);
        // The driver's floats may round the other way.
        same(&expected, &shown[1], 1, &output);
    }
    let plain = frames(&screen, 3, &[("OUTPUT", "anaglyph")], "output");
    let dubois = frames(&screen, 3, &[("OUTPUT", "anaglyph:red-cyan")], "output");
    assert_eq!(plain[1], dubois[1]);
}

#[test]
fn whole_and_half_pictures() {
    let screen = own_screen();
    let atlas = frames(&screen, 2, &[], "atlas");
    let tiles = tiles(&atlas[1], 2);
    let (width, height) = tiles[0].dimensions();
    let below = |offset: (u32, u32), size: (u32, u32)| {
        let mut picture = RgbImage::new(size.0, size.1);
        imageops::replace(&mut picture, &tiles[0], 0, 0);
        imageops::replace(&mut picture, &tiles[1], offset.0.into(), offset.1.into());
        picture
    };
    let shown = |output: &str| frames(&screen, 2, &[("OUTPUT", output)], "output").swap_remove(1);
    same(
        &below((width, 0), (2 * width, height)),
        &shown("sbs"),
        0,
        "sbs",
    );
    same(
        &below((0, height), (width, 2 * height)),
        &shown("tb"),
        0,
        "tb",
    );
    // The mean of two texels, rounded half up.
    let half_width = RgbImage::from_fn(width, height, |x, y| {
        let (tile, x) = (&tiles[(x / (width / 2)) as usize], 2 * (x % (width / 2)));
        mean(tile.get_pixel(x, y), tile.get_pixel(x + 1, y))
    });
    same(&half_width, &shown("half-sbs"), 0, "half-sbs");
    let half_height = RgbImage::from_fn(width, height, |x, y| {
        let (tile, y) = (&tiles[(y / (height / 2)) as usize], 2 * (y % (height / 2)));
        mean(tile.get_pixel(x, y), tile.get_pixel(x, y + 1))
    });
    same(&half_height, &shown("half-tb"), 0, "half-tb");
}

fn mean(a: &Rgb<u8>, b: &Rgb<u8>) -> Rgb<u8> {
    Rgb([0, 1, 2].map(|c| (u16::from(a.0[c]) + u16::from(b.0[c])).div_ceil(2) as u8))
}

#[test]
fn a_model_of_the_looking_glass_makes_its_quilt() {
    let screen = own_screen();
    let shown = frames(
        &screen,
        48,
        &[("DISPLAY", "looking-glass-portrait")],
        "output",
    );
    assert_eq!(shown[0].dimensions(), (8 * 96, 6 * 64));
}
