//! The panel's own window under Wayland: on monitors that are turned or scaled, each of their pixels is a pixel of the picture.

use crate::panel::case::{CASE, Case, STEP, end, worst};
use crate::support::has;
use crate::support::wayland::{Compositor, Monitor, has_sway};
use image::RgbImage;
use image::imageops::{rotate90, rotate270};
use std::time::{Duration, Instant};

const LIMIT: Duration = Duration::from_secs(60);

const MONITOR: Monitor = Monitor {
    size: (800, 600),
    turned: "normal",
    scale: "1",
};

/// From the picture as one sees it to the pixels as they are sent to the monitor.
type Turn = fn(&RgbImage) -> RgbImage;

/// Shows a case on a monitor, and checks the pixels that it gets.
fn check(
    compositor: &Compositor,
    (name, number): (&str, usize),
    case: &Case,
    turn: Turn,
    what: &str,
) {
    let expected = turn(&case.expected());
    assert!(expected.pixels().any(|pixel| pixel.0 != [0; 3]), "{what}");
    let mut command = case.command(name, &[]);
    let child = compositor.give(&mut command).spawn().expect("it starts");
    let limit = Instant::now() + LIMIT;
    let off = loop {
        let shown = compositor.pixels(number);
        let same = shown.filter(|shown| shown.dimensions() == expected.dimensions());
        let off = same.map_or(u8::MAX, |shown| worst(&shown, &expected));
        if off <= STEP || Instant::now() > limit {
            break off;
        }
        std::thread::sleep(Duration::from_millis(50));
    };
    let takes_keys = compositor.has_window("manyview");
    assert_ne!(takes_keys, Some(true), "{what}: the keyboard");
    let said = end(child, what);
    assert_eq!(said, "");
    assert!(off <= STEP, "{what}: off by {off}");
}

#[test]
fn monitors_are_whole_turned_and_doubled() {
    if !has("weston") {
        return;
    }
    let portrait = Case {
        panel: (600, 800),
        ..CASE
    };
    let cases: [(Monitor, Case, Turn); 4] = [
        (MONITOR, CASE, Clone::clone),
        (
            Monitor {
                turned: "rotate-90",
                ..MONITOR
            },
            portrait,
            |shown| rotate270(shown),
        ),
        (
            Monitor {
                turned: "rotate-270",
                ..MONITOR
            },
            portrait,
            |shown| rotate90(shown),
        ),
        (
            Monitor {
                // Weston counts in pixels of the desk.
                size: (400, 300),
                scale: "2",
                ..MONITOR
            },
            CASE,
            Clone::clone,
        ),
    ];
    for (monitor, case, turn) in cases {
        let compositor = Compositor::weston(&[monitor]);
        let what = format!("{} at {}", monitor.turned, monitor.scale);
        check(&compositor, ("auto", 0), &case, turn, &what);
    }
}

#[test]
fn the_monitor_is_the_one_that_is_named() {
    if !has("weston") {
        return;
    }
    let wide = Monitor {
        size: (1000, 300),
        ..MONITOR
    };
    let compositor = Compositor::weston(&[MONITOR, wide]);
    let case = Case {
        panel: (1000, 300),
        ..CASE
    };
    check(&compositor, ("X1", 1), &case, Clone::clone, "the second");
    check(&compositor, ("1", 1), &case, Clone::clone, "the second");
    check(&compositor, ("X0", 0), &CASE, Clone::clone, "the first");
}

/// A desk of one and a half times the size shows each pixel as it is, and the panel has no window that the keyboard could go to.
#[test]
fn scaled_desks_show_each_pixel() {
    if !has_sway() {
        return;
    }
    let scaled = Monitor {
        size: (1200, 900),
        scale: "1.5",
        ..MONITOR
    };
    let compositor = Compositor::sway(&[MONITOR, scaled]);
    let case = Case {
        panel: (1200, 900),
        ..CASE
    };
    check(
        &compositor,
        ("HEADLESS-2", 1),
        &case,
        Clone::clone,
        "the second",
    );
}
