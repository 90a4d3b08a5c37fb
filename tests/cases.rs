//! Small cases that once came out differently under the layer: all that a program can read back is the same with it.

use crate::support::{Compiled, bare, compiled, layered, succeed};

#[test]
fn small_cases_are_the_same() {
    let program = compiled("cases", Compiled::Program, &["-lEGL", "-lGL"]);
    let lines = |mut command: std::process::Command| {
        let output = succeed(command.env_remove("DISPLAY"));
        String::from_utf8(output.stdout).expect("text")
    };
    let expected = lines(bare(&program));
    assert_eq!(expected.lines().count(), 25, "{expected}");
    for atlas in ["side-by-side", "layers"] {
        let options = [("VIEWS", "3"), ("STRATEGY", "replay"), ("ATLAS", atlas)];
        let actual = lines(layered(&program, &options));
        assert_eq!(actual, expected, "{atlas}");
    }
}
