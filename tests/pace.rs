//! The panel's window holds the program back in no way, and has its newest picture all the same; `--fps-cap` does hold it back.

use crate::control::running::{Running, until};
use crate::support::x::User;
use crate::support::{Compiled, Screen, compiled, demo, layered, manyview, refused, sized_screen};
use image::RgbImage;
use serde_json::Value;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

const LIMIT: Duration = Duration::from_secs(60);
const SIZE: (u16, u16) = (400, 300);

fn hasty() -> PathBuf {
    compiled("hasty", Compiled::Program, &["-lGL", "-lX11"])
}

/// Starts the program in the panel's window; it shows so many frames at once.
fn start(screen: &Screen, program: &Path, arguments: &[&str], frames: &str) -> Child {
    let mut command = manyview();
    let command = command.args(["run", "--views", "2", "--display", "columns"]);
    let command = command.args(arguments).arg("--").arg(program).arg(frames);
    let command = command.stdin(Stdio::piped()).stderr(Stdio::piped());
    screen.give(command).spawn().expect("it starts")
}

fn end(mut child: Child) {
    drop(child.stdin.take());
    let mut said = String::new();
    let errors = child.stderr.as_mut().expect("a pipe");
    errors.read_to_string(&mut said).expect("text");
    assert!(child.wait().expect("it ends").success(), "{said}");
    assert_eq!(said, "");
}

/// The picture of the panel's window, once it has one.
fn shown(screen: &Screen) -> Option<RgbImage> {
    let user = User::at(screen.display());
    let window = user.window("manyview")?;
    Some(user.picture(window))
}

fn report(file: &Path) -> Value {
    let text = std::fs::read_to_string(file).expect("a report");
    serde_json::from_str(&text).expect("JSON")
}

/// Which picture a fast program leaves behind depends on how far the driver was when it stopped, so it is tried with several numbers of frames.
#[test]
fn the_last_picture_of_a_program_that_stops_is_shown() {
    for frames in ["1", "2", "3", "20", "50", "200"] {
        let screen = sized_screen(SIZE);
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("report.json");
        let name = file.to_string_lossy();
        let panel = ["--panel", "auto", "--report", &name];
        let child = start(&screen, &hasty(), &panel, frames);
        let limit = Instant::now() + LIMIT;
        let white = |picture: &RgbImage| picture.get_pixel(200, 150).0 == [255; 3];
        while !shown(&screen).is_some_and(|picture| white(&picture)) {
            assert!(Instant::now() < limit, "{frames} frames: the last one");
            std::thread::sleep(Duration::from_millis(20));
        }
        // It is woken once, and not for what it draws when it is woken.
        std::thread::sleep(Duration::from_millis(600));
        end(child);
        let all = report(&file)["frames"].as_u64().expect("frames");
        let most = frames.parse::<u64>().expect("a number") + 4;
        assert!(all <= most, "{all} frames for {frames}");
    }
}

#[test]
fn a_window_that_stands_still_holds_nothing_back() {
    let screen = sized_screen(SIZE);
    let folder = tempfile::tempdir().expect("a folder");
    let still = compiled("still", Compiled::Program, &["-lEGL", "-lGL"]);
    let file = folder.path().join("report.json");
    let name = file.to_string_lossy();
    let panel = ["--panel", "auto", "--report", &name];
    let child = start(&screen, &still, &panel, "64");
    let limit = Instant::now() + LIMIT;
    while shown(&screen).is_none_or(|picture| picture.pixels().all(|p| p.0 == [0; 3])) {
        assert!(Instant::now() < limit, "a picture");
        std::thread::sleep(Duration::from_millis(20));
    }
    let signal = |name: &str| {
        let id = child.id().to_string();
        let sent = Command::new("kill").args([name, &id]).status();
        assert!(sent.expect("kill").success());
    };
    signal("-STOP");
    std::thread::sleep(Duration::from_secs(3));
    signal("-CONT");
    end(child);
    let report = report(&file);
    // It waits 10 ms after each frame, so that there are about 200 in this time.
    let frames = report["frames"].as_u64().expect("frames");
    assert!(frames > 60, "{frames} frames");
    let slowest = report["frame_ms"]["p95"].as_f64().expect("a time");
    assert!(slowest < 500.0, "{slowest} ms");
}

#[test]
fn a_limit_to_the_frame_rate_is_held() {
    let screen = sized_screen(SIZE);
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("report.json");
    let name = file.to_string_lossy().into_owned();
    for cap in ["20", "20:late", "20:early"] {
        let options = ["--output", "view:0", "--fps-cap", cap, "--report", &name];
        let begun = Instant::now();
        let child = start(&screen, &hasty(), &options, "21");
        // The last frame is followed by the end.
        std::thread::sleep(Duration::from_millis(1500));
        end(child);
        let report = report(&file);
        let median = report["frame_ms"]["median"].as_f64().expect("a time");
        assert!((45.0..60.0).contains(&median), "{cap}: {median} ms");
        assert!(begun.elapsed() >= Duration::from_secs(1), "{cap}");
    }
}

#[test]
fn without_views_a_frame_takes_the_time_of_one() {
    let screen = sized_screen(SIZE);
    let median = |toggled: bool| {
        let options = [("CONTROL", "1"), ("VIEWS", "8"), ("REPORT", "report.json")];
        let mut command = layered(demo("mesh"), &options);
        command.args(["--size", "320x240", "--frames", "60"]);
        let mut running = Running::start_program(&screen, &mut command);
        until("a socket", || running.socket().exists().then_some(()));
        if toggled {
            running.done(&["toggle"]);
        }
        assert_eq!(running.end(), (Some(0), String::new()));
        let median = &report(&running.path("report.json"))["frame_ms"]["median"];
        median.as_f64().expect("a time")
    };
    let (all, one) = (median(false), median(true));
    assert!(one < 0.5 * all, "{one} ms of {all} ms");
}

#[test]
fn a_limit_that_is_none_is_refused() {
    for cap in ["0", "0.5", "1001", "fast", "60:soon", "60:", ":early"] {
        refused(
            &["run", "--fps-cap", cap, "--", "true"],
            2,
            "give frames per second from 1 to 1000, with :early or :late",
        );
    }
}
