//! Output `quad`: two eyes in the left and right buffer of a stereo window, and the fallback where the driver has no such window.
//!
//! No driver for Xvfb has stereo windows, so tests/support/c/stereo.c stands in for one.

use crate::support;
use crate::support::{
    Compiled, Screen, bare, compiled, layered, library, own_screen, rgb, succeed, watch_window,
    window_library, window_picture,
};
use image::{RgbImage, imageops};
use std::path::Path;
use std::process::Command;

const VIEWS: &str = "3";
/// Far enough apart for a visible disparity in 96 pixels.
const CAMERAS: [(&str, &str); 2] = [("EYE_SPACING", "0.3"), ("FOCAL_DEPTH", "8")];
/// Ways to choose a visual, as the program's arguments.
const WAYS: [&[&str]; 7] = [
    &["visual"],
    &["config"],
    &["sgix"],
    &["any"],
    &["visual", "single"],
    &["config", "single"],
    &["config", "unlike"],
];

fn program() -> std::path::PathBuf {
    compiled("visuals", Compiled::Program, &["-lGL", "-lX11"])
}

/// The program under the layer, with a capture of its second frame and a report in the folder.
fn shown(folder: &Path, output: &str, what: &str, program: &Path, words: &[&str]) -> Command {
    let (out, report) = (folder.join("out.png"), folder.join("report.json"));
    let mut options = vec![
        ("VIEWS", VIEWS),
        ("OUTPUT", output),
        ("CAPTURE_OUT", out.to_str().expect("UTF-8")),
        ("CAPTURE_FRAMES", "2"),
        ("CAPTURE_WHAT", what),
        ("REPORT", report.to_str().expect("UTF-8")),
    ];
    options.extend(CAMERAS);
    let mut command = layered(program, &options);
    command.args(words);
    command
}

/// One view of the captured frame.
fn view(screen: &Screen, view: u32, program: &Path, words: &[&str]) -> RgbImage {
    let folder = tempfile::tempdir().expect("a folder");
    let what = format!("view:{view}");
    succeed(screen.give(&mut shown(folder.path(), "sbs", &what, program, words)));
    rgb(&folder.path().join("out.png"))
}

fn beside(left: &RgbImage, right: &RgbImage) -> RgbImage {
    let mut both = RgbImage::new(2 * left.width(), left.height());
    imageops::replace(&mut both, left, 0, 0);
    imageops::replace(&mut both, right, left.width().into(), 0);
    both
}

fn notes(folder: &Path) -> Vec<String> {
    let report = std::fs::read(folder.join("report.json")).expect("a report");
    let report: serde_json::Value = serde_json::from_slice(&report).expect("JSON");
    serde_json::from_value(report["notes"].clone()).expect("notes")
}

/// The sentences about stereo among the notes on the driver.
fn about_stereo(notes: &[String]) -> Vec<&String> {
    notes
        .iter()
        .filter(|note| note.contains("GL_STEREO"))
        .collect()
}

/// Runs with the library that stands in for a driver with stereo windows; returns the program's stdout, and the left and the right buffer
/// if it has both.
fn in_stereo(
    screen: &Screen,
    command: &mut Command,
    layer: bool,
) -> (String, Option<[RgbImage; 2]>) {
    let folder = tempfile::tempdir().expect("a folder");
    let [left, right] = ["left.ppm", "right.ppm"].map(|name| folder.path().join(name));
    let driver = compiled("stereo", Compiled::Library, &["-ldl"]);
    let mut preload = driver.into_os_string();
    if layer {
        // Preloaded after the layer, which then finds it before the driver.
        let mut both = library().into_os_string();
        both.push(":");
        both.push(&preload);
        preload = both;
    }
    command
        .env("LD_PRELOAD", preload)
        .env("STEREO_FRAME", "2")
        .env("STEREO_LEFT", &left)
        .env("STEREO_RIGHT", &right);
    let said = succeed(screen.give(command)).stdout;
    let pictures = right
        .exists()
        .then(|| [left, right].map(|path| window_picture(&path)));
    (String::from_utf8(said).expect("UTF-8"), pictures)
}

#[test]
fn each_eye_has_its_buffer_and_the_program_sees_what_it_saw() {
    let screen = own_screen();
    let program = program();
    for words in WAYS {
        let (plain, none) = in_stereo(&screen, bare(&program).args(words), false);
        assert_eq!(none, None, "{words:?}: no stereo window without the layer");
        let folder = tempfile::tempdir().expect("a folder");
        let mut command = shown(folder.path(), "quad", "output", &program, words);
        let (said, pictures) = in_stereo(&screen, &mut command, true);
        let [left, right] = pictures.expect("a stereo window");
        assert_eq!(said, plain, "{words:?}");
        let [first, last] = [0, 2].map(|i| view(&screen, i, &program, words));
        assert_ne!(first, last, "the eyes differ");
        assert!(left == first, "{words:?}: the left buffer");
        assert!(right == last, "{words:?}: the right buffer");
        let captured = rgb(&folder.path().join("out.png"));
        assert!(captured == beside(&first, &last), "{words:?}: the capture");
        let notes = notes(folder.path());
        assert_eq!(about_stereo(&notes), Vec::<&String>::new(), "{words:?}");
    }
}

/// Only `quad` asks for a stereo window.
#[test]
fn other_outputs_leave_the_window_alone() {
    let screen = own_screen();
    let program = program();
    for words in WAYS {
        let folder = tempfile::tempdir().expect("a folder");
        let mut command = shown(folder.path(), "half-sbs", "output", &program, words);
        assert_eq!(in_stereo(&screen, &mut command, true).1, None, "{words:?}");
    }
}

/// Where the driver has no such window, the program gets its own one, with the first view and a sentence in the report.
#[test]
fn without_stereo_the_first_view_is_shown() {
    let screen = own_screen();
    let program = program();
    for words in WAYS {
        let plain = succeed(screen.give(bare(&program).args(words))).stdout;
        let folder = tempfile::tempdir().expect("a folder");
        let ppm = folder.path().join("window.ppm");
        let mut command = shown(folder.path(), "quad", "output", &program, words);
        watch_window(&mut command, &window_library(), 2, &ppm);
        let said = succeed(screen.give(&mut command)).stdout;
        assert_eq!(said, plain, "{words:?}: visual and answers");
        let [first, last] = [0, 2].map(|i| view(&screen, i, &program, words));
        assert!(window_picture(&ppm) == first, "{words:?}: the window");
        let captured = rgb(&folder.path().join("out.png"));
        assert!(captured == beside(&first, &last), "{words:?}: the capture");
        let notes = notes(folder.path());
        let said = about_stereo(&notes);
        assert_eq!(said.len(), 1, "{notes:?}");
        assert!(
            said[0].contains("output is 'quad'")
                && said[0].ends_with("choose another output, such as anaglyph or half-sbs"),
            "{notes:?}"
        );
    }
}

#[test]
fn windows_of_egl_show_the_first_view() {
    let screen = own_screen();
    let program = compiled("moves", Compiled::Program, &["-lGL", "-lEGL", "-lX11"]);
    let folder = tempfile::tempdir().expect("a folder");
    let ppm = folder.path().join("window.ppm");
    let mut command = shown(folder.path(), "quad", "output", &program, &["egl"]);
    watch_window(&mut command, &window_library(), 2, &ppm);
    succeed(screen.give(&mut command));
    assert!(window_picture(&ppm) == view(&screen, 0, &program, &["egl"]));
    let notes = notes(folder.path());
    let said = about_stereo(&notes);
    assert_eq!(said.len(), 1, "{notes:?}");
    assert!(said[0].contains("no window of EGL has"), "{notes:?}");
}

/// `capture` warns of it.
#[test]
fn capture_says_that_there_is_no_stereo_window() {
    let screen = own_screen();
    let folder = tempfile::tempdir().expect("a folder");
    let mut command = support::manyview();
    command
        .args(["capture", "--output", "quad", "--frame", "2", "--out"])
        .arg(folder.path().join("out.png"))
        .arg("--")
        .arg(program());
    let said = succeed(screen.give(&mut command)).stderr;
    let said = String::from_utf8(said).expect("UTF-8");
    assert!(
        said.contains("output is 'quad', but the window has no left and right buffer"),
        "{said}"
    );
}
