//! `manyview points`: the viewer of point clouds under the layer.

use crate::control::running::until;
use crate::support::wayland::{Compositor, Monitor, has_sway};
use crate::support::x::User;
use crate::support::{
    library, manyview, own_screen, rgb, run, scratch, screen, succeed, target_folder,
};
use image::RgbImage;
use manyview::report::Summary;
use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

const VIEWER: &str = "manyview-points";
const LEFT: u32 = 0xff51;
const HOME: u32 = 0xff50;
const PAGE_UP: u32 = 0xff55;

/// A ball of points, whose colours are their places.
fn ball(file: &Path) {
    let mut text = "ply\nformat ascii 1.0\nelement vertex 4000\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n\
                    property uchar green\nproperty uchar blue\nend_header\n"
        .to_owned();
    for n in 0..4000 {
        // A spiral from pole to pole.
        let z = 1.0 - 2.0 * (f64::from(n) + 0.5) / 4000.0;
        let (radius, angle) = ((1.0 - z * z).sqrt(), 2.399_963 * f64::from(n));
        let (x, y) = (radius * angle.cos(), radius * angle.sin());
        let [r, g, b] = [x, y, z].map(|value| (128.0 + 120.0 * value) as u8);
        writeln!(text, "{x} {y} {z} {r} {g} {b}").expect("a string");
    }
    std::fs::write(file, text).expect("written");
}

fn points(options: &[&str], file: &Path, viewers: &[&str]) -> Command {
    library();
    let mut command = manyview();
    command.arg("points").args(options).arg(file).args(viewers);
    command
}

#[test]
fn every_view_is_what_the_viewer_draws_with_its_projection() {
    library();
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name| folder.path().join(name);
    let (file, report) = (path("ball.ply"), path("report.json"));
    ball(&file);
    let mut command = manyview();
    command
        .args([
            "capture", "--views", "5", "--prove", "5", "--frame", "22", "--report",
        ])
        .args([
            &report,
            Path::new("--out"),
            &path("picture.png"),
            Path::new("--"),
        ])
        .arg(target_folder().join(VIEWER))
        .arg(&file)
        .args(["--turn", "30", "--size", "320x240"]);
    succeed(screen().give(&mut command));
    let text = std::fs::read_to_string(&report).expect("a report");
    let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let proof: Summary = serde_json::from_value(report["proof"].clone()).expect("a proof");
    assert_eq!((proof.frames, proof.verdict()), (4, "equal"), "{proof:?}");
    // In front of the middle and behind it.
    let [least, most] = ["min", "max"].map(|end| report["disparity"]["px"][end].as_f64());
    assert!(
        least < Some(-0.1) && most > Some(0.1),
        "{}",
        report["disparity"]
    );
}

/// The columns by which the ball is farther right in the leftmost view than in the rightmost one: e·f·(1/d − 1/ξ), with the eyes' distance e, the focal length f in
/// pixels, the ball's distance d and the focal depth ξ.
#[test]
fn views_are_as_far_apart_as_their_cameras() {
    library();
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("ball.ply");
    ball(&file);
    let screen = screen();
    let [left, right] = [0, 4].map(|view| {
        let out = folder.path().join(format!("{view}.png"));
        let mut command = manyview();
        command
            .args(["capture", "--views", "5", "--frame", "8"])
            .args(["--eye-spacing", "0.3", "--focal-depth", "20"])
            .args(["--what", &format!("view:{view}"), "--out"])
            .args([&out, Path::new("--"), &target_folder().join(VIEWER), &file])
            .args(["--size", "480x240"]);
        succeed(screen.give(&mut command));
        middle(&rgb(&out))
    });
    // The viewer sees 0.35 to each side of the middle, and the ball's bounding box from corner to corner: 1.7 to each side.
    let (pixels, distance) = (120.0 / 0.35_f64.tan(), 1.7 / 0.35_f64.sin());
    let want = 4.0 * 0.3 * pixels * (1.0 / distance - 1.0 / 20.0);
    assert!(
        (left - right - want).abs() < 0.1 * want,
        "{} for {want}",
        left - right
    );
}

/// The mean column of what is drawn.
fn middle(picture: &RgbImage) -> f64 {
    let drawn = picture
        .enumerate_pixels()
        .filter(|(_, _, pixel)| pixel.0.iter().any(|&value| value > 40));
    let columns: Vec<f64> = drawn.map(|(x, _, _)| f64::from(x)).collect();
    columns.iter().sum::<f64>() / columns.len() as f64
}

/// Where a picture is not as dark as where nothing is drawn.
fn lit(picture: &RgbImage) -> usize {
    picture
        .pixels()
        .filter(|pixel| pixel.0.iter().any(|&value| value > 40))
        .count()
}

#[test]
fn keys_and_mouse_move_what_is_seen() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("ball.ply");
    ball(&file);
    let screen = own_screen();
    let user = User::at(screen.display());
    let options = ["--views", "1"];
    let mut command = points(&options, &file, &["--size", "320x240"]);
    let mut viewer = screen.give(&mut command).spawn().expect("started");
    let title = "ball.ply - 4,000 points";
    let window = until("the whole cloud", || user.window(title));
    user.focus(window);
    let until_seen = |what: &str, is_so: &dyn Fn(&RgbImage) -> bool| {
        until(what, || {
            Some(user.picture(window)).filter(|picture| is_so(picture))
        })
    };
    let first = until_seen("a picture", &|picture| lit(picture) > 5000);
    user.press(&[LEFT]);
    let turned = until_seen("a turn", &|picture| *picture != first);
    user.press(&[PAGE_UP]);
    until_seen("a larger ball", &|picture| {
        lit(picture) > lit(&turned) * 5 / 4
    });
    user.press(&[HOME]);
    until_seen("the start", &|picture| *picture == first);
    for _ in 0..8 {
        user.press(&[u32::from('-')]);
    }
    until_seen("smaller points", &|picture| {
        lit(picture) < lit(&first) * 99 / 100
    });
    user.press(&[HOME]);
    until_seen("the start", &|picture| *picture == first);
    user.drag([160, 120], [190, 150]);
    until_seen("a turn by the mouse", &|picture| *picture != first);
    user.press(&[u32::from('q')]);
    let ended = viewer.wait().expect("an end");
    assert!(ended.success(), "{ended}");
}

#[test]
fn a_spoilt_file_is_refused_with_the_place() {
    let folder = tempfile::tempdir().expect("a folder");
    let screen = screen();
    let refused = |name: &str, text: Option<&str>, part: &str| {
        let file = folder.path().join(name);
        if let Some(text) = text {
            std::fs::write(&file, text).expect("written");
        }
        let (status, _, said) = run(screen.give(&mut points(&[], &file, &[])));
        assert_eq!(status, 2, "{said}");
        assert!(said.contains(part), "{said}");
    };
    refused("none.ply", None, "none.ply, start: No such file");
    let part = "bad.xyz, line 2: 2 numbers are no place; three are";
    refused("bad.xyz", Some("# x y z\n1 2\n"), part);
}

#[test]
fn under_wayland_it_has_the_pixels_of_a_doubled_monitor() {
    if !has_sway() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("ball.ply");
    ball(&file);
    let monitor = Monitor {
        size: (600, 450),
        turned: "normal",
        scale: "2",
    };
    let compositor = Compositor::sway(&[monitor]);
    let report = folder.path().join("report.json");
    let options = ["--views", "5", "--report", report.to_str().expect("UTF-8")];
    let mut command = points(&options, &file, &["--turn", "20"]);
    let mut viewer = compositor.give(&mut command).spawn().expect("started");
    // Sway gives a window the whole monitor, whose own background is lighter than the viewer's.
    until("a picture", || {
        let picture = compositor.pixels(0)?;
        (20_000..200_000).contains(&lit(&picture)).then_some(())
    });
    std::thread::sleep(Duration::from_secs(1));
    let process = rustix::process::Pid::from_child(&viewer);
    rustix::process::kill_process(process, rustix::process::Signal::TERM).expect("sent");
    viewer.wait().expect("an end");
    let text = std::fs::read_to_string(&report).expect("a report");
    let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    // Five views of four bytes of colour and four of depth, beside the title bar of the compositor.
    let bytes = report["view_bytes"].as_u64().expect("bytes");
    let pixels = bytes / (5 * 8);
    assert!((600 * 350..640 * 450).contains(&pixels), "{pixels}");
}

/// Bytes of memory that the viewer has, which the command has started, of those that are not files.
fn memory(command: u32) -> Option<u64> {
    let children = format!("/proc/{command}/task/{command}/children");
    let children = std::fs::read_to_string(children).ok()?;
    let viewer = children.split_whitespace().next()?;
    let text = std::fs::read_to_string(format!("/proc/{viewer}/status")).ok()?;
    let line = text.lines().find(|line| line.starts_with("RssAnon:"))?;
    let number: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(number * 1024)
}

/// What a program has without points: the driver's threads, the views, the blocks of a file that are read.
const OTHERWISE: u64 = 450 << 20;
const POINTS: &str = "100000000";

#[test]
#[ignore = "of test-full: it makes a file of 560 MB"]
fn full_a_hundred_million_points_are_shown() {
    let file = scratch("viewer").join("land.laz");
    if !file.is_file() {
        let mut cargo = Command::new(env!("CARGO"));
        cargo
            .args([
                "run",
                "--release",
                "-p",
                "manyview-viewer",
                "--example",
                "cloud",
                "land",
                POINTS,
            ])
            .arg(&file);
        succeed(&mut cargo);
    }
    let report = file.with_extension("json");
    let screen = own_screen();
    let user = User::at(screen.display());
    let viewers = [
        "--turn", "20", "--memory", "600M", "--size", "1280x720", "--fps", "30",
    ];
    let options = ["--views", "8", "--report", report.to_str().expect("UTF-8")];
    let mut command = points(&options, &file, &viewers);
    // As a user has it, because its time counts.
    for name in [
        "LP_NUM_THREADS",
        "GALLIVM_PERF",
        "MANYVIEW_STRATEGY",
        "MANYVIEW_AUTO_DEPTH",
    ] {
        command.env_remove(name);
    }
    let start = Instant::now();
    let mut viewer = screen.give(&mut command).spawn().expect("started");
    let window = until("a window", || user.windows().first().copied());
    until("a picture", || {
        (lit(&user.picture(window)) > 1000).then_some(())
    });
    let first = start.elapsed().as_secs_f64();
    let (mut most, mut read) = (0, None);
    while start.elapsed() < Duration::from_secs(100) {
        most = most.max(memory(viewer.id()).expect("it runs"));
        if read.is_none() && user.window("land.laz - 100,000,000 points").is_some() {
            read = Some(start.elapsed().as_secs_f64());
        }
        std::thread::sleep(Duration::from_millis(100));
    }
    user.focus(window);
    user.press(&[u32::from('q')]);
    assert!(viewer.wait().expect("an end").success());
    let text = std::fs::read_to_string(&report).expect("a report");
    let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let [median, p95] = ["median", "p95"].map(|part| report["frame_ms"][part].as_f64());
    println!(
        "first picture {first:.1} s, all read {read:.0?} s, frames {median:.0?} and {p95:.0?} ms (median, 95 %), memory {} MiB",
        most >> 20
    );
    assert!(first < 3.0, "{first}");
    assert!(read.is_some(), "not all were read");
    assert!(median < Some(1000.0 / 12.0), "{median:?}");
    assert!(most < (600 << 20) + OTHERWISE, "{most}");
}

#[test]
fn its_help_names_every_option_of_the_viewer() {
    let viewer = target_folder().join(VIEWER);
    let own = succeed(Command::new(viewer).arg("--help"));
    let all = succeed(manyview().args(["points", "--help"]));
    let [own, all] = [own, all].map(|output| String::from_utf8(output.stdout).expect("UTF-8"));
    let words = own.split(|c: char| !c.is_ascii_alphanumeric() && c != '-');
    let flags: Vec<_> = words
        .filter(|word| word.len() > 3 && word.starts_with("--"))
        .collect();
    assert!(flags.len() > 4, "{own}");
    for flag in flags {
        assert!(all.contains(flag), "{flag} is not in the help of points");
    }
}
