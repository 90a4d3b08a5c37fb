//! Programs with shaders of their own: what they know of them, of their uniforms and of their errors is the same under the layer, whose
//! twins are linked anew, follow the uniforms, and outlive what is deleted as the program does.
#![forbid(unsafe_code)]

mod support;

use image::RgbImage;
use std::process::Command;
use support::{Compiled, bare, compiled, layered, rgb, succeed};

const VIEWS: u32 = 3;

/// The first and the last column of the middle row of a view that the quad covers which was drawn last.
fn quad(all: &RgbImage, view: u32) -> [f64; 2] {
    let width = all.width() / VIEWS;
    let at = |x: u32| all.get_pixel(view * width + x, all.height() / 2).0;
    let mut green = (0..width).filter(|&x| at(x) == [0, 255, 0]);
    let left = green.next().expect("it is drawn");
    [left, green.next_back().unwrap_or(left)].map(f64::from)
}

#[test]
fn a_program_knows_of_its_shaders_what_it_knows_without_the_layer() {
    let program = compiled("shaded", Compiled::Program, &["-lEGL", "-lGL"]);
    let folder = tempfile::tempdir().expect("a folder");
    let picture = folder.path().join("frame.png");
    let lines = |mut command: Command| {
        let output = succeed(command.env_remove("DISPLAY"));
        String::from_utf8(output.stdout).expect("text")
    };
    let expected = lines(bare(&program));
    assert_eq!(
        expected.matches("before a draw: 0x500").count(),
        3,
        "{expected}"
    );
    assert!(expected.contains("pixel 0 255 0"), "{expected}");
    assert!(expected.contains("deleted: 1 0, there: 0 1"), "{expected}");
    for atlas in ["side-by-side", "layers"] {
        let options = [
            ("VIEWS", "3"),
            ("ATLAS", atlas),
            ("STRATEGY", "replay"),
            ("SEPARATION", "0.4"),
            ("CONVERGENCE", "4"),
            ("CAPTURE_OUT", picture.to_str().expect("UTF-8")),
            ("CAPTURE_FRAMES", "1"),
            ("CAPTURE_WHAT", "atlas"),
        ];
        assert_eq!(lines(layered(&program, &options)), expected, "{atlas}");
        let all = rgb(&picture);
        let [left, own, right] = [0, 1, 2].map(|view| quad(&all, view));
        // Moved by ±0.4 · (2 − 4) / 2 in 64 columns: the nearer one of the two quads, the left camera's to the right.
        for (moved, shift) in [(left[0] - own[0], 12.8), (right[1] - own[1], -12.8)] {
            assert!(
                (moved - shift).abs() <= 1.5,
                "{atlas}: {left:?} {own:?} {right:?}"
            );
        }
    }
}
