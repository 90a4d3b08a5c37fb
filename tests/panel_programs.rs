//! The panel's own window beside programs that change their window, have several, or have one of another kind; and captures of it.

use crate::control::running;
use crate::control::running::{Running, until};
use crate::panel::case::{CAMERAS, CASE, STEP, worst};
use crate::support::x::User;
use crate::support::{Compiled, Screen, compiled, demo, manyview, rgb, sized_screen, succeed};
use image::{GenericImageView, RgbImage};
use manyview::config::panel::load;
use manyview::display::Fit;
use manyview::interleave::reference;
use std::io::Write;
use std::process::{Command, Stdio};
use std::time::Duration;

const VIEWS: u32 = 3;
const DISPLAY: &str = "lenticular-3";
/// The size of the panel, which is to the right of the desk.
const PANEL: (u32, u32) = (400, 300);
const DESK: u32 = 400;

/// A desk, and the panel beside it.
fn desk() -> Screen {
    let screen = sized_screen(((DESK + PANEL.0) as u16, 300));
    let user = User::at(screen.display());
    user.add_monitor("desk", [0, 0, DESK as i16, 300]);
    user.add_monitor("panel", [DESK as i16, 0, PANEL.0 as i16, PANEL.1 as i16]);
    screen
}

/// A program whose picture is on that panel.
fn command(more: &[&str]) -> Command {
    let mut command = manyview();
    command
        .args(["run", "--panel", "panel", "--control"])
        .args(["--display", DISPLAY, "--views", &VIEWS.to_string()])
        .args(CAMERAS)
        .args(more)
        .arg("--");
    command
}

/// The views of the running program, interleaved by the CPU for the panel.
fn woven(running: &Running) -> RgbImage {
    interleaved(&running.capture("atlas"))
}

/// Views beside each other, interleaved for the panel.
fn interleaved(all: &RgbImage) -> RgbImage {
    let (width, height) = (all.width() / VIEWS, all.height());
    let views: Vec<_> = (0..VIEWS)
        .map(|i| all.view(i * width, 0, width, height).to_image())
        .collect();
    let place = Fit::Contain.place((width, height), PANEL);
    let mask = load(DISPLAY).expect("a display").mask(&place, VIEWS);
    let picture = reference::interleave(&views, &mask.expect("a mask")).expect("a picture");
    let mut whole = RgbImage::new(PANEL.0, PANEL.1);
    image::imageops::replace(&mut whole, &picture, place.x.into(), place.y.into());
    whole
}

/// Waits until the program can be asked.
fn listens(running: &Running) {
    until("a socket", || (running.ctl(&["get"]).0 == 0).then_some(()));
}

/// The pixels of the panel's window.
fn shown(user: &User) -> RgbImage {
    let window = until("the panel's window", || user.window("manyview"));
    user.picture(window)
}

/// The program's window gets other sizes, and becomes full screen: the panel shows its views at the panel's size each time.
#[test]
fn the_picture_follows_a_window_that_is_resized() {
    let screen = desk();
    let user = User::at(screen.display());
    let folder = tempfile::tempdir().expect("a folder");
    let mut command = command(&[]);
    command.arg(running::stays());
    let mut running = Running::start_in(folder, &screen, &mut command);
    let window = until("the program's window", || {
        let mut all = user.windows().into_iter();
        all.find(|window| user.picture(*window).dimensions() == (96, 64))
    });
    listens(&running);
    for place in [
        [0, 0, 96, 64],
        [10, 20, 150, 220],
        [0, 0, 400, 300],
        [5, 5, 96, 64],
    ] {
        user.put(window, place);
        let size = (place[2] as u32 * VIEWS, place[3] as u32);
        until("views of that size", || {
            (running.capture("atlas").dimensions() == size).then_some(())
        });
        let expected = woven(&running);
        assert!(expected.pixels().any(|pixel| pixel.0[0] > 60), "{place:?}");
        until(&format!("the picture at {place:?}"), || {
            (worst(&shown(&user), &expected) <= STEP).then_some(())
        });
    }
    assert_eq!(running.end(), (Some(0), String::new()));
}

/// Of two windows that are drawn all the time the panel shows the larger one, and the smaller one when it is alone.
#[test]
fn of_several_windows_the_largest_is_shown() {
    let screen = desk();
    let user = User::at(screen.display());
    let folder = tempfile::tempdir().expect("a folder");
    let mut command = command(&[]);
    command.arg(compiled("pair", Compiled::Program, &["-lGL", "-lX11"]));
    let mut running = Running::start_in(folder, &screen, &mut command);
    let is = |colour: [u8; 3]| shown(&user).get_pixel(200, 150).0 == colour;
    until("the large one", || is([255, 0, 0]).then_some(()));
    for _ in 0..100 {
        assert!(is([255, 0, 0]), "the small one is shown meanwhile");
        std::thread::sleep(Duration::from_millis(5));
    }
    std::fs::write(running.path("stop.small"), "").expect("written");
    until("the small one", || is([0, 255, 0]).then_some(()));
    assert_eq!(running.end(), (Some(0), String::new()));
}

/// A window that converts to sRGB when it is drawn to: the panel has its bytes.
#[test]
fn windows_with_srgb_have_their_picture() {
    const FRAMES: u32 = 5;
    let size = format!("{}x{}", PANEL.0, PANEL.1);
    let scene = ["--srgb", "--size", &size];
    let folder = tempfile::tempdir().expect("a folder");
    let atlas = folder.path().join("atlas.png");
    let mut capture = manyview();
    capture
        .args(["capture", "--frame", &FRAMES.to_string(), "--what", "atlas"])
        .args(["--display", DISPLAY, "--views", &VIEWS.to_string()])
        .args(CAMERAS)
        .arg("--out")
        .arg(&atlas)
        .arg("--")
        .arg(demo("shade"))
        .args(scene);
    succeed(&mut capture);
    let expected = interleaved(&rgb(&atlas));
    let screen = desk();
    let user = User::at(screen.display());
    let mut command = command(&[]);
    command.arg(demo("shade")).arg("--bench").args(scene);
    command.stdin(Stdio::piped()).stdout(Stdio::null());
    let mut child = screen.give(&mut command).spawn().expect("it starts");
    let mut orders = child.stdin.take().expect("a pipe");
    for _ in 0..FRAMES {
        // A program that shows frames rarely has each of them read at once.
        std::thread::sleep(Duration::from_millis(100));
        writeln!(orders, "1").expect("sent");
    }
    until("the last frame", || {
        (worst(&shown(&user), &expected) == 0).then_some(())
    });
    drop(orders);
    assert!(child.wait().expect("it ends").success());
}

/// A capture is of the panel's picture, whether its window is open or not.
#[test]
fn captures_are_of_the_panel() {
    let expected = CASE.expected();
    let screen = sized_screen(CASE.panel);
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("panel.png");
    let mut command = CASE.capture(&["--panel", "auto"], &out);
    succeed(screen.give(&mut command));
    assert!(worst(&rgb(&out), &expected) <= STEP);
    let user = User::at(screen.display());
    assert!(user.window("manyview").is_none());
}

#[test]
fn a_running_program_is_captured_as_the_panel_shows_it() {
    let screen = desk();
    let user = User::at(screen.display());
    let folder = tempfile::tempdir().expect("a folder");
    let mut command = command(&["--osd", "values"]);
    command.arg(running::stays());
    let mut running = Running::start_in(folder, &screen, &mut command);
    let expected = until("a picture", || {
        let shown = shown(&user);
        shown.pixels().any(|pixel| pixel.0[0] > 60).then_some(shown)
    });
    listens(&running);
    assert_eq!(worst(&running.capture("output"), &expected), 0);
    assert!(worst(&woven(&running), &expected) <= STEP);
    assert_eq!(running.end(), (Some(0), String::new()));
}
