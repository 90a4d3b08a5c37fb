//! A picture drawn to the front buffer is visible after a flush, without a swap.

use crate::support::{Compiled, bare, compiled, layered, own_screen, succeed};

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
