//! A picture drawn to the front buffer is visible after a flush, without a swap.

use crate::support::{Compiled, bare, compiled, layered, manyview, own_screen, rgb, succeed};
use tempfile::tempdir;

#[test]
fn the_front_buffer_is_shown_at_a_flush() {
    let screen = own_screen();
    let program = compiled("front", Compiled::Program, &["-lGL", "-lX11"]);
    for (buffers, lines) in [("double", 5), ("single", 3)] {
        let told = |mut command: std::process::Command| {
            let output = succeed(screen.give(command.arg(buffers)));
            String::from_utf8(output.stdout).expect("text")
        };
        let expected = told(bare(&program));
        assert_eq!(expected.lines().count(), lines, "{expected}");
        assert!(
            expected.starts_with("flushed: corner 0000ff, middle 00ff00"),
            "{expected}"
        );
        for (atlas, strategy) in [
            ("side-by-side", "replay"),
            ("layers", "replay"),
            ("layers", "geometry"),
        ] {
            let options = [
                ("VIEWS", "3"),
                ("OUTPUT", "view:0"),
                ("ATLAS", atlas),
                ("STRATEGY", strategy),
            ];
            let actual = told(layered(&program, &options));
            assert_eq!(actual, expected, "{buffers}, {atlas}, {strategy}");
        }
    }
}

/// With one view the program draws it itself, and the frames that a flush shows are frames, too.
#[test]
fn frames_of_one_view_are_shown_at_a_flush() {
    let screen = own_screen();
    let program = compiled("front", Compiled::Program, &["-lGL", "-lX11"]);
    let folder = tempdir().expect("a folder");
    let (picture, report) = (
        folder.path().join("picture.png"),
        folder.path().join("report.json"),
    );
    for buffers in ["double", "single"] {
        let frames = ["1", "3"].map(|views| {
            let mut command = manyview();
            command.args(["capture", "--frame", "1", "--views", views]);
            command.args(["--what", "view:0", "--out"]).arg(&picture);
            command.arg("--").arg(&program).arg(buffers);
            succeed(screen.give(&mut command));
            let picture = rgb(&picture);
            let colours = [(2, 2), (32, 24)].map(|(x, y)| picture.get_pixel(x, y).0);
            assert_eq!(
                colours,
                [[0, 0, 255], [0, 255, 0]],
                "{buffers}, {views} views"
            );
            let options = [
                ("VIEWS", views),
                ("REPORT", report.to_str().expect("UTF-8")),
            ];
            succeed(screen.give(layered(&program, &options).arg(buffers)));
            let text = std::fs::read_to_string(&report).expect("a report");
            let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
            report["frames"].clone()
        });
        assert_eq!(frames[0], frames[1], "{buffers}");
        assert!(frames[0].as_u64() > Some(1), "{buffers}: {frames:?}");
    }
}
