//! `manyview volume` as its users meet it, and slices of a reference image against those of the geometry.
#![forbid(unsafe_code)]

mod support;

use manyview::volume::{Difference, RotatingScreen, Triangle, Vertex, Volume};
use std::fs;
use support::surfaces::{depth_image, statues};
use support::{manyview, refused, run};
use tempfile::tempdir;

const SMALL: RotatingScreen = RotatingScreen {
    slices: 30,
    pixels: 96,
    ..RotatingScreen::POPESCU
};

/// A folder with a stack: a white square to the right of the middle, across the viewer's sight.
fn stack_of_a_square() -> tempfile::TempDir {
    let folder = tempdir().expect("a folder");
    let corner = |x: f32, y: f32| Vertex {
        at: [x, y, 0.5],
        colour: [255; 3],
    };
    let square: [Triangle; 2] = [
        [corner(1.0, -1.0), corner(3.0, -1.0), corner(3.0, 1.0)],
        [corner(1.0, -1.0), corner(3.0, 1.0), corner(1.0, 1.0)],
    ];
    let slices = Volume::of_triangles(&SMALL, &square)
        .expect("a display")
        .dithered();
    slices.write(&folder.path().join("stack")).expect("written");
    folder
}

#[test]
fn an_eye_sees_a_stack() {
    let folder = stack_of_a_square();
    let simulate = |rest: &[&str]| {
        let (code, stdout, stderr) = run(manyview()
            .current_dir(&folder)
            .args(["volume", "simulate", "stack", "--out", "seen.png"])
            .args(rest));
        assert_eq!((code, stdout.as_str()), (0, ""), "{stderr}");
        assert_eq!(stderr, "manyview: wrote seen.png\n");
        let seen = image::open(folder.path().join("seen.png"));
        seen.expect("a picture").into_rgb8()
    };
    let lit = |picture: &image::RgbImage, x, y| picture.get_pixel(x, y).0[0] > 60;
    let seen = simulate(&[]);
    assert_eq!(seen.dimensions(), (720, 480));
    // An inch is some 46 pixels.
    assert!(lit(&seen, 452, 240) && !lit(&seen, 268, 240) && !lit(&seen, 452, 340));
    assert_eq!(simulate(&["--eye", "0,0,50in"]), seen, "the viewer");
    let behind = simulate(&["--eye", "0, 0, -50"]);
    assert!(lit(&behind, 268, 240) && !lit(&behind, 452, 240));
    let small = simulate(&["--size", "96x96", "--sphere"]);
    assert_eq!(small.dimensions(), (96, 96));
    assert!(small.get_pixel(48, 2).0[0] > 0, "the sphere's top");
}

#[test]
fn what_cannot_be_simulated_is_one_line_and_status_2() {
    let folder = stack_of_a_square();
    let place = |name: &str| {
        let path = folder.path().join(name);
        path.to_str().expect("UTF-8").to_owned()
    };
    let (stack, out) = (place("stack"), place("seen.png"));
    let with = |stack: &str, rest: &[&str], part: &str| {
        let arguments = ["volume", "simulate", stack, "--out", &out];
        refused(&[&arguments, rest].concat(), 2, part);
    };
    for eye in ["", "left", "0,50", "0,0,nan", "0,0,0,50"] {
        with(&stack, &["--eye", eye], "such as -4,0,50");
    }
    with(&stack, &["--eye", "0,0,5"], "give a place at least 5.25 in");
    with(&stack, &["--size", "720"], "such as 720x480");
    with(&place("none"), &[], "display.toml: No such file");
    with(&place(""), &[], "name a folder that slices were written to");
    fs::remove_file(place("stack/slice-007.png")).expect("removed");
    with(&stack, &[], "slice-007.png: No such file");
    let nowhere = [
        "volume",
        "simulate",
        &stack,
        "--out",
        "no-such-folder/a.png",
    ];
    refused(&nowhere, 2, "there is no folder");
    assert!(!fs::exists(&out).expect("known"), "nothing is written");
}

#[test]
fn a_reference_image_has_what_its_viewer_sees() {
    let screen = RotatingScreen::POPESCU;
    let triangles = statues(200_000);
    let image = depth_image(&screen, &triangles, [720, 480], 0.3);
    let whole = Volume::of_triangles(&screen, &triangles).expect("a display");
    let seen = Volume::of_reference(&screen, &image).expect("a display");
    assert!(seen.len() * 2 < whole.len(), "much is hidden");
    let at = |eye| Difference::between(&whole, &seen, &[eye]).expect("an eye outside");
    let front = at([0.0, 0.0, screen.viewer]);
    assert!(front.lost * 33 < front.seen, "{front:?}");
    assert!(
        front.wrong * 50 < front.drawn && front.colour < 3.0,
        "{front:?}"
    );
    let side = at([screen.viewer, 0.0, 0.0]);
    assert!(
        side.lost * 3 > side.seen,
        "it is not for other places: {side:?}"
    );
}
