//! The panel's own window: its picture is, subpixel for subpixel, what the CPU interleaves of the same views at the panel's size.

pub(crate) mod case;

use crate::control::running;
use crate::control::running::{Running, until};
use crate::support;
use crate::support::x::User;
use crate::support::{Screen, manyview, refused, sized_screen};
use case::{CAMERAS, CASE, Case, DISPLAYS, STEP, end, still, word, worst};
use image::RgbImage;
use manyview::display::Fit;
use serde_json::Value;
use std::io::Read;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

const LIMIT: Duration = Duration::from_secs(60);

fn start(case: &Case, screen: &Screen, more: &[&str]) -> Child {
    start_on("auto", case, screen, more)
}

fn start_on(monitor: &str, case: &Case, screen: &Screen, more: &[&str]) -> Child {
    let mut command = case.command(monitor, more);
    screen.give(&mut command).spawn().expect("it starts")
}

/// Checks the pixels of the panel's window.
fn check(case: &Case, what: &str) {
    let expected = case.expected();
    let screen = sized_screen(case.panel);
    let child = start(case, &screen, &[]);
    let shown = wait_for(&screen, &expected);
    let off = worst(&shown, &expected);
    end(child, what);
    assert!(off <= STEP, "{what}: off by {off}");
    assert!(expected.pixels().any(|p| p.0 != [0; 3]), "{what}");
}

/// The picture of the panel's window, once it is the expected one, or at last.
fn wait_for(screen: &Screen, expected: &RgbImage) -> RgbImage {
    let user = User::at(screen.display());
    let limit = Instant::now() + LIMIT;
    loop {
        let window = user.window("manyview");
        let shown = window.map(|window| user.picture(window));
        match shown {
            Some(shown) if worst(&shown, expected) <= STEP || Instant::now() > limit => {
                return shown;
            }
            _ => assert!(Instant::now() < limit, "a window"),
        }
        std::thread::sleep(Duration::from_millis(50));
    }
}

#[test]
fn the_picture_is_interleaved_at_the_panels_size() {
    let portrait = (600, 800);
    let cases = [
        CASE,
        Case {
            panel: portrait,
            ..CASE
        },
        Case {
            panel: portrait,
            fit: Fit::Cover,
            ..CASE
        },
        Case {
            panel: portrait,
            fit: Fit::Stretch,
            ..CASE
        },
        Case {
            display: "slanted8",
            panel: (1000, 300),
            fit: Fit::Cover,
            ..CASE
        },
        Case {
            display: "columns",
            views: 2,
            window: (1024, 768),
            ..CASE
        },
        Case { grows: 2, ..CASE },
    ];
    for case in cases {
        let what = format!(
            "{} on {:?}, {}, {} times",
            case.display,
            case.panel,
            word(case.fit),
            case.grows
        );
        check(&case, &what);
    }
}

#[test]
#[ignore = "minutes"]
fn all_displays_have_their_picture() {
    for (display, views) in DISPLAYS {
        for (panel, fit) in [((1280, 800), Fit::Contain), ((800, 1280), Fit::Cover)] {
            let case = Case {
                display,
                views,
                panel,
                fit,
                ..CASE
            };
            check(&case, &format!("{display} on {panel:?}"));
        }
    }
    for window in [(801, 603), (1920, 1080), (3840, 2160)] {
        let case = Case {
            display: "slanted8",
            views: 4,
            window,
            panel: (1000, 1100),
            ..CASE
        };
        check(&case, &format!("{window:?}"));
    }
}

/// Mean difference of two pictures of one size, in steps of 255.
fn mean(a: &RgbImage, b: &RgbImage) -> f64 {
    let off = a
        .iter()
        .zip(b.iter())
        .map(|(a, b)| u64::from(a.abs_diff(*b)));
    off.sum::<u64>() as f64 / a.len() as f64
}

/// With `--view-scale auto` views have as many pixels as the panel shows of them, whatever the window has: the picture is that of a window of the panel's
/// size, or nearly.
#[test]
fn views_have_the_resolution_of_the_panel() {
    let panel = Case {
        panel: (1280, 960),
        ..CASE
    };
    for display in ["huebner8", "lenticular-8"] {
        let panel = Case { display, ..panel };
        let exact = Case {
            window: (1280, 960),
            ..panel
        };
        let exact = exact.expected();
        let screen = sized_screen(panel.panel);
        let coarse = mean(&panel.expected(), &exact);
        let child = start(&panel, &screen, &["--view-scale", "auto"]);
        let limit = Instant::now() + LIMIT;
        let user = User::at(screen.display());
        let fine = loop {
            let window = user.window("manyview");
            let shown = window.map(|window| mean(&user.picture(window), &exact));
            match shown {
                Some(fine) if fine < 0.5 * coarse || Instant::now() > limit => break fine,
                _ => assert!(Instant::now() < limit, "a window"),
            }
            std::thread::sleep(Duration::from_millis(50));
        };
        end(child, display);
        assert!(fine < 0.5 * coarse, "{display}: {fine} of {coarse}");
    }
}

/// The window covers the monitor that is named, to whatever side of the others, and the mask counts from that monitor's corner.
#[test]
fn the_monitor_is_the_one_that_is_named() {
    let expected = CASE.expected();
    for (at, desk) in [(900, 0), (0, 800)] {
        let screen = sized_screen((1700, 640));
        let user = User::at(screen.display());
        user.add_monitor("desk", [desk, 0, 900, 640]);
        user.add_monitor("panel", [at, 40, 800, 600]);
        let child = start_on("panel", &CASE, &screen, &[]);
        let shown = wait_for(&screen, &expected);
        let window = user.window("manyview").expect("a window");
        assert_eq!(user.place(window), [at, 40], "the desk at {desk}");
        end(child, "a named monitor");
        assert!(worst(&shown, &expected) <= STEP, "the desk at {desk}");
    }
    let screen = sized_screen((800, 600));
    let mut child = start_on("HDMI-9", &CASE, &screen, &[]);
    assert_eq!(child.wait().expect("it ends").code(), Some(2));
    let mut said = String::new();
    let errors = child.stderr.as_mut().expect("a pipe");
    errors.read_to_string(&mut said).expect("text");
    assert!(
        said.starts_with("manyview: --panel 'HDMI-9': there is no such monitor; give one of 0"),
        "{said}"
    );
}

/// The panel's window takes no keyboard from the program, and goes with it.
#[test]
fn the_window_takes_no_keyboard_and_ends_with_the_program() {
    let screen = sized_screen(CASE.panel);
    let folder = tempfile::tempdir().expect("a folder");
    let report = folder.path().join("report.json");
    let child = start(&CASE, &screen, &["--report", &report.to_string_lossy()]);
    wait_for(&screen, &CASE.expected());
    let user = User::at(screen.display());
    let window = user.window("manyview").expect("a window");
    assert_ne!(
        user.focused(),
        window,
        "the keyboard stays with the program"
    );
    let said = end(child, "report");
    assert_eq!(said, "");
    let report = std::fs::read_to_string(&report).expect("a report");
    let report: Value = serde_json::from_str(&report).expect("JSON");
    assert_eq!(report["gl_errors"], 0, "{report}");
    assert!(
        user.window("manyview").is_none(),
        "the window goes with the program"
    );
}

/// A program that covers all monitors covers the panel's window only for a moment.
#[test]
fn the_window_comes_back_above_a_program_that_covers_it() {
    let screen = sized_screen(CASE.panel);
    let expected = CASE.expected();
    let child = start(&CASE, &screen, &[]);
    wait_for(&screen, &expected);
    let user = User::at(screen.display());
    let (width, height) = (CASE.panel.0 as i16, CASE.panel.1 as i16);
    let cover = user.open(user.root);
    user.put(cover, [0, 0, width, height]);
    user.paint(cover, 0xff_ff00);
    until("the picture on the screen", || {
        (worst(&user.picture(user.root), &expected) <= STEP).then_some(())
    });
    end(child, "covered");
}

/// The user closes the panel's window: the program goes on, and shows the picture itself.
#[test]
fn a_window_that_is_closed_leaves_the_program_alone() {
    let screen = sized_screen(CASE.panel);
    let child = start(&CASE, &screen, &[]);
    wait_for(&screen, &CASE.expected());
    let user = User::at(screen.display());
    user.destroy(user.window("manyview").expect("a window"));
    std::thread::sleep(Duration::from_millis(500));
    let said = end(child, "closed");
    assert_eq!(said.lines().count(), 1, "{said}");
    assert!(said.contains("the panel's window is closed"), "{said}");
}

#[test]
fn a_program_without_the_launcher_is_told() {
    let mut command = support::layered(still(), &[("PANEL", "auto")]);
    let command = command.stdin(Stdio::piped()).stderr(Stdio::piped());
    let child = command.spawn().expect("it starts");
    std::thread::sleep(Duration::from_secs(1));
    let said = end(child, "without the launcher");
    assert!(said.contains("opened by manyview run"), "{said}");
}

#[test]
fn what_cannot_be_is_one_line() {
    let run = |more: &[&'static str]| [&["run"], more, &["--", "true"]].concat();
    refused(
        &run(&["--fit", "cover"]),
        2,
        "for a window of the panel's own",
    );
    refused(
        &run(&["--panel", "auto", "--fit", "wide"]),
        2,
        "contain, cover and stretch",
    );
    refused(&run(&["--panel", ""]), 2, "is empty");
    refused(
        &run(&["--panel", "auto", "--output", "quad"]),
        2,
        "another output",
    );
    refused(
        &run(&["--panel", "auto", "--window-output", "panel"]),
        2,
        "own, quilt",
    );
}

/// The program's own window, of its size.
fn own_window(user: &User) -> u32 {
    running::until("the program's window", || {
        let mut all = user.windows().into_iter();
        all.find(|window| user.picture(*window).dimensions() == STAYS)
    })
}

/// Width and height of the window of `stays`.
const STAYS: (u32, u32) = (96, 64);

/// A program with a window of its own: that shows the program's own view, or what is asked for, as if there were no panel; and the panel's picture stays as it is
/// while the window is moved.
#[test]
fn the_programs_window_keeps_its_own_picture() {
    let bare = {
        let screen = sized_screen((300, 200));
        let mut running = Running::start(&screen, &[("DISABLE", "1")]);
        let shown = running.steady_window();
        assert_eq!(running.end().0, Some(0));
        shown
    };
    let anaglyph = {
        let screen = sized_screen((300, 200));
        let options = [("VIEWS", "3"), ("OUTPUT", "anaglyph"), CAMERA[0], CAMERA[1]];
        let mut running = Running::start(&screen, &options);
        let shown = running.steady_window();
        assert_eq!(running.end().0, Some(0));
        shown
    };
    assert_ne!(bare, anaglyph);
    for (output, expected) in [("own", &bare), ("anaglyph", &anaglyph)] {
        let screen = sized_screen((700, 300));
        let user = User::at(screen.display());
        user.add_monitor("desk", [0, 0, 300, 300]);
        user.add_monitor("panel", [300, 0, 400, 300]);
        let folder = tempfile::tempdir().expect("a folder");
        let mut command = manyview();
        command.args([
            "run",
            "--panel",
            "panel",
            "--display",
            "lenticular-3",
            "--views",
            "3",
        ]);
        command.args(["--window-output", output]).args(CAMERAS);
        command.arg("--").arg(running::stays());
        let mut running = Running::start_in(folder, &screen, &mut command);
        let window = own_window(&user);
        running::until("its picture", || {
            (user.picture(window) == *expected).then_some(())
        });
        let panel = running::until("the panel's window", || user.window("manyview"));
        let before = running::until("a picture of the panel", || {
            let shown = user.picture(panel);
            shown
                .pixels()
                .any(|pixel| pixel.0 != [0; 3])
                .then_some(shown)
        });
        user.move_to(window, [150, 90]);
        std::thread::sleep(Duration::from_millis(300));
        assert_eq!(user.place(window), [150, 90]);
        running::same(&user.picture(panel), &before, "the panel after the move");
        running::same(&user.picture(window), expected, "the window after the move");
        assert_eq!(running.end(), (Some(0), String::new()), "{output}");
    }
}

const CAMERA: [(&str, &str); 2] = [("SEPARATION", "0.02"), ("CONVERGENCE", "8")];
