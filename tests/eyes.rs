//! Programs that draw a picture for each eye themselves: they get a stereo window on every driver, and their eyes are what the views show.

use crate::support::{Compiled, bare, compiled, layered, own_screen, rgb, succeed};
use tempfile::tempdir;

#[test]
fn both_eyes_are_shown_to_the_bit() {
    let program = compiled("eyes", Compiled::Program, &["-lGL", "-lX11"]);
    let screen = own_screen();
    let folder = tempdir().expect("a folder");
    let out = folder.path().join("view.png");
    let refused = screen.give(&mut bare(&program)).output().expect("it runs");
    assert_eq!(
        refused.status.code(),
        Some(1),
        "no driver here has stereo windows"
    );
    let view = |words: &[&str], views: &str, view: u32| {
        let what = format!("view:{view}");
        let options = [
            ("VIEWS", views),
            ("CAPTURE_OUT", out.to_str().expect("UTF-8")),
            ("CAPTURE_FRAMES", "2"),
            ("CAPTURE_WHAT", &what),
        ];
        let mut command = layered(&program, &options);
        let output = succeed(screen.give(command.args(words)));
        let told = String::from_utf8(output.stdout).expect("UTF-8");
        (told, rgb(&out))
    };
    for way in ["visual", "config"] {
        let eyes = ["left", "right"].map(|eye| view(&[way, eye], "1", 0).1);
        assert!(eyes[0] != eyes[1]);
        for views in [2, 3, 8] {
            for number in 0..views {
                let (told, picture) = view(&[way], &views.to_string(), number);
                assert_eq!(told, "1 1 0\n", "{way}");
                let eye = usize::from(2 * number >= views);
                assert!(picture == eyes[eye], "view {number} of {views}, {way}");
            }
        }
    }
    succeed(
        screen.give(
            layered(&program, &[("VIEWS", "1")])
                .arg("visual")
                .arg("left"),
        ),
    );
}

/// A program that asks for a stereo window and draws as in any other.
#[test]
fn a_stereo_window_that_is_not_used_is_one_as_any_other() {
    let program = compiled("eyes", Compiled::Program, &["-lGL", "-lX11"]);
    let screen = own_screen();
    let folder = tempdir().expect("a folder");
    let out = folder.path().join("all.png");
    let options = [
        ("VIEWS", "3"),
        ("CAPTURE_OUT", out.to_str().expect("UTF-8")),
        ("CAPTURE_FRAMES", "2"),
        ("CAPTURE_WHAT", "atlas"),
    ];
    succeed(screen.give(layered(&program, &options).args(["visual", "unused"])));
    let all = rgb(&out);
    let tiles =
        [0, 1, 2].map(|view| image::imageops::crop_imm(&all, view * 96, 0, 96, 64).to_image());
    assert!(
        tiles[0] != tiles[1] && tiles[1] != tiles[2],
        "it has parallax"
    );
}
