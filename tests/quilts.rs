//! Quilts: the names of captured quilts, and the way back to a panel.

use crate::support::{demo, library, manyview, own_screen, refused, rgb, run, succeed};
use image::{Rgb, RgbImage};
use std::path::Path;

/// Size of the window in the top left corner of the screen, and so of each view.
const SIZE: &str = "96x72";

/// Captures frame 3 of a demo and returns its stdout.
fn capture(folder: &Path, views: &str, options: &[&str]) -> String {
    library();
    let screen = own_screen();
    let mut command = manyview();
    command
        .current_dir(folder)
        .args([
            "capture",
            "--timeout",
            "30",
            "--frame",
            "3",
            "--views",
            views,
        ])
        .args(["--separation", "0.03", "--convergence", "8"])
        .args(options)
        .arg("--")
        .arg(demo("teapot"))
        .args(["--size", SIZE]);
    let output = succeed(screen.give(&mut command));
    String::from_utf8(output.stdout).expect("UTF-8")
}

fn files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let mut names: Vec<_> = entries
        .map(|entry| entry.expect("an entry").file_name())
        .map(|name| name.into_string().expect("UTF-8"))
        .collect();
    names.sort();
    names
}

/// A captured quilt gives the picture of the panel back, bit by bit.
#[test]
fn a_quilt_that_is_woven_is_what_the_window_shows() {
    for (views, grid, panel) in [("8", "4x2", "slanted8"), ("5", "3x2", "lenticular-5")] {
        let folder = tempfile::tempdir().expect("a folder");
        let name = format!("scene_qs{grid}a1.3333.png");
        let told = capture(
            folder.path(),
            views,
            &["--output", "quilt", "--out", "scene.png"],
        );
        let own = Path::new(told.trim_end()).file_name().expect("a name");
        assert_eq!(own.to_str(), Some(name.as_str()));
        assert_eq!(files(folder.path()), [name.as_str()]);
        let told = capture(
            folder.path(),
            views,
            &["--display", panel, "--out", "shown.png"],
        );
        assert_eq!(
            told, "",
            "other pictures have the names that they are given"
        );
        let mut weave = manyview();
        weave.current_dir(folder.path());
        weave.args(["weave", "--display", panel, "--views", views, "--in", &name]);
        succeed(weave.args(["--out", "woven.png"]));
        let woven = rgb(&folder.path().join("woven.png"));
        assert!(woven == rgb(&folder.path().join("shown.png")), "{panel}");
        let plain = rgb(&folder.path().join(&name));
        assert!(woven.dimensions() == (96, 72) && plain.dimensions() != (96, 72));
    }
}

#[test]
fn names_that_are_complete_stay_and_placeholders_are_filled() {
    let folder = tempfile::tempdir().expect("a folder");
    for (out, name) in [
        ("own_qs9x9.png", "own_qs9x9.png"),
        ("%q-there.png", "_qs2x2a1.3333-there.png"),
        ("%d.png", "3_qs2x2a1.3333.png"),
    ] {
        capture(folder.path(), "4", &["--output", "quilt", "--out", out]);
        assert_eq!(files(folder.path()), [name]);
        std::fs::remove_file(folder.path().join(name)).expect("removed");
    }
}

#[test]
fn panels_of_another_size_and_filters() {
    let folder = tempfile::tempdir().expect("a folder");
    // Views of one colour each, in a picture whose sides are no multiples of 3 and 2; the name has rows and columns exchanged.
    let quilt = RgbImage::from_fn(98, 33, |x, y| {
        let view = (x / 32).min(2) + if y < 17 { 3 } else { 0 };
        Rgb([40 * view as u8; 3])
    });
    quilt
        .save(folder.path().join("a_QS2x3a2.png"))
        .expect("saved");
    let weave = |options: &[&str]| {
        let mut command = manyview();
        command.current_dir(folder.path()).arg("weave");
        run(command.args(options))
    };
    let panel = [
        "--display",
        "lenticular-6",
        "--in",
        "a_QS2x3a2.png",
        "--out",
        "p.png",
    ];
    let (code, _, stderr) = weave(&[&panel[..], &["--size", "48x20"]].concat());
    assert!(
        code == 0 && stderr.contains("note: the name says 2x3"),
        "{stderr}"
    );
    let woven = rgb(&folder.path().join("p.png"));
    assert_eq!(woven.dimensions(), (48, 20));
    for (x, y, pixel) in woven.enumerate_pixels() {
        assert_eq!(pixel.0, [40 * (x % 6) as u8; 3], "{x},{y}");
    }
    let (code, ..) = weave(&[&panel[..], &["--filter", "gaussian", "--quilt", "3x2"]].concat());
    assert_eq!(code, 0);
    let filtered = rgb(&folder.path().join("p.png"));
    assert_eq!(filtered.dimensions(), (32, 16), "of one view");
    assert!(filtered.get_pixel(1, 0).0[0] > 40);
}

#[test]
fn what_cannot_be_woven_is_explained_by_one_sentence() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let quilt = RgbImage::new(40, 20);
    for name in ["plain.png", "a_qs4x2.png", "bad_qs4.png"] {
        quilt.save(path(name)).expect("saved");
    }
    std::fs::write(path("text_qs2x1.png"), "no picture").expect("written");
    let out = path("out.png");
    for (input, options, part) in [
        ("plain.png", &[][..], "--quilt 8x6"),
        ("bad_qs4.png", &[], "columns x rows"),
        ("no_qs2x1.png", &[], "give a quilt as PNG"),
        ("text_qs2x1.png", &[], "give a quilt as PNG"),
        ("plain.png", &["--quilt", "8"], "--quilt is '8'"),
        ("plain.png", &["--quilt", "41x1"], "has no 41x1 views"),
        ("a_qs4x2.png", &["--views", "9"], "--views 1 to 8"),
        ("a_qs4x2.png", &["--size", "0x4"], "--size is '0x4'"),
        (
            "a_qs4x2.png",
            &["--display", "looking-glass-go"],
            "calibration",
        ),
        ("a_qs4x2.png", &["--filter", "sharp"], "--filter is 'sharp'"),
    ] {
        let input = path(input);
        let base = ["weave", "--in", &input, "--out", &out];
        refused(&[&base[..], options].concat(), 2, part);
    }
    refused(
        &[
            "weave",
            "--in",
            &path("a_qs4x2.png"),
            "--out",
            "no/such/p.png",
        ],
        2,
        "no folder",
    );
}
