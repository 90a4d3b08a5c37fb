//! The on-screen display: a program that reads text reads it from every view, and pictures that are captured do not have it.

use crate::control::running::{Running, same, until};
use crate::support::x::User;
use crate::support::{Screen, demo, has, layered, sized_screen};
use image::imageops::{FilterType, crop_imm, resize};
use image::{DynamicImage, RgbImage};
use std::process::{Command, Stdio};

/// The window, and columns and rows of its quilt.
const WINDOW: (u16, u16) = (1280, 960);
const VIEWS: u32 = 4;
const HALF: [u32; 2] = [640, 480];

/// A scene that runs until it is killed.
fn start(screen: &Screen, scene: &str, more: &[&str], options: &[(&str, &str)]) -> Running {
    let views = VIEWS.to_string();
    let mut all = vec![
        ("CONTROL", "1"),
        ("VIEWS", views.as_str()),
        ("OUTPUT", "quilt"),
        ("SEPARATION", "0.03"),
        ("CONVERGENCE", "8"),
    ];
    all.extend(options);
    let size = format!("{}x{}", WINDOW.0, WINDOW.1);
    let mut command = layered(demo(scene), &all);
    command.args(["--size", &size]).args(more);
    let running = Running::start_program(screen, &mut command);
    until("a socket", || running.socket().exists().then_some(()));
    running
}

/// The window, as the screen has it.
fn picture(screen: &Screen) -> RgbImage {
    let user = User::at(screen.display());
    let window = until("a window", || user.windows().first().copied());
    user.picture(window)
}

/// The words that tesseract reads in a picture of light letters on a dark ground.
fn read(picture: &RgbImage) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("text.png");
    let mut grey = DynamicImage::from(picture.clone()).into_luma8();
    image::imageops::invert(&mut grey);
    let (width, height) = grey.dimensions();
    let large = resize(&grey, width * 3, height * 3, FilterType::CatmullRom);
    large.save(&file).expect("saved");
    let mut command = Command::new("tesseract");
    let command = command.arg(&file).args(["-", "--psm", "6"]);
    let output = command.stderr(Stdio::null()).output().expect("tesseract");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The dark ground in the left top corner of a view, which is at `at`.
fn ground(picture: &RgbImage, at: [u32; 2]) -> RgbImage {
    let dark = |x: u32, y: u32| picture.get_pixel(at[0] + x, at[1] + y).0 == [16; 3];
    let margin = (0..100)
        .find(|&n| dark(n, n))
        .expect("a ground in the corner");
    let wide = (margin..HALF[0]).take_while(|&x| dark(x, margin)).count() as u32;
    let high = (margin..HALF[1]).take_while(|&y| dark(margin, y)).count() as u32;
    let [left, top] = at.map(|n| n + margin);
    crop_imm(picture, left, top, wide, high).to_image()
}

/// Left and top of each view in the window.
fn corners() -> impl Iterator<Item = [u32; 2]> {
    (0..VIEWS).map(|view| [view % 2 * HALF[0], view / 2 * HALF[1]])
}

#[test]
fn text_is_read_from_every_view_of_three_scenes() {
    if !has("tesseract") {
        return;
    }
    for scene in ["teapot", "room", "sky"] {
        let screen = sized_screen(WINDOW);
        let running = start(&screen, scene, &[], &[("OSD", "values")]);
        running.done(&["set", "separation", "0.0375", "hud-depth", "0.1"]);
        running.done(&["get"]);
        let shown = picture(&screen);
        for (view, at) in corners().enumerate() {
            let text = read(&ground(&shown, at));
            assert_eq!(
                text, "hud-depth 0.1 separation 0.0375",
                "{scene}, view {view}"
            );
        }
    }
}

#[test]
fn it_is_shown_in_windows_of_every_kind() {
    if !has("tesseract") {
        return;
    }
    for more in [
        &["--samples", "4"][..],
        &["--srgb"],
        &["--api", "egl"],
        &["--api", "egl", "--profile", "es3"],
        &["--profile", "core"],
    ] {
        let screen = sized_screen(WINDOW);
        let running = start(&screen, "shade", more, &[("OSD", "values")]);
        running.done(&["set", "output", "quilt"]);
        running.done(&["get"]);
        let shown = picture(&screen);
        for at in corners() {
            assert_eq!(read(&ground(&shown, at)), "output quilt", "{more:?}");
        }
    }
}

#[test]
fn frames_and_views_that_are_drawn_are_counted() {
    if !has("tesseract") {
        return;
    }
    let screen = sized_screen(WINDOW);
    let options = [("OSD", "fps"), ("STRATEGY", "hybrid"), ("FPS", "1")];
    let running = start(&screen, "teapot", &[], &options);
    let text = until("a count", || {
        running.done(&["get"]);
        let shown = picture(&screen);
        let there = shown.get_pixel(12, 12).0 == [16; 3];
        there.then(|| read(&ground(&shown, [0, 0])))
    });
    let words: Vec<_> = text.split(' ').collect();
    let rate: f64 = words[0].parse().unwrap_or_else(|_| panic!("{text}"));
    assert!(rate > 0.1, "{text}");
    assert_eq!(words[1..3], ["fps", "K"], "{text}");
    assert_eq!(words[4..], ["of", "4"], "{text}");
}

#[test]
fn captures_do_not_have_it() {
    let screen = sized_screen(WINDOW);
    let options = [("OSD", "crosshair"), ("OUTPUT", "view:0"), ("VIEWS", "2")];
    let mut running = Running::controlled(&screen, &options);
    let with = running.steady_window();
    let captured = running.capture("output");
    running.done(&["set", "osd", "off"]);
    running.done(&["get"]);
    let (without, shown) = (running.capture("output"), running.steady_window());
    same(&captured, &without, "a picture with the cross");
    same(&shown, &without, "the window without it");
    // The cross is in the middle, which it leaves free, and changes nothing elsewhere.
    let [x, y] = [with.width() / 2, with.height() / 2];
    let mut changed = 0;
    for (px, py, pixel) in with.enumerate_pixels() {
        if pixel != shown.get_pixel(px, py) {
            assert!(px.abs_diff(x) < 20 && py.abs_diff(y) < 20, "{px} {py}");
            changed += 1;
        }
    }
    assert!(changed > 100, "{changed} pixels of the cross");
    assert_eq!(with.get_pixel(x, y), shown.get_pixel(x, y), "the middle");
    assert_eq!(with.get_pixel(x + 8, y).0, [255; 3]);
    assert_eq!(running.end(), (Some(0), String::new()));
}
