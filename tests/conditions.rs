//! Conditional rendering depends on all samples that a query has counted, however the layer splits the draws.

use crate::support::{Compiled, bare, compiled, layered, rgb, succeed};

#[test]
fn draws_depend_on_all_that_a_query_has_counted() {
    let program = compiled("conditions", Compiled::Program, &["-lEGL", "-lGL"]);
    let folder = tempfile::tempdir().expect("a folder");
    let picture = folder.path().join("frame.png");
    let lines = |mut command: std::process::Command| {
        let output = succeed(command.env_remove("DISPLAY"));
        String::from_utf8(output.stdout).expect("text")
    };
    let expected = lines(bare(&program));
    assert_eq!(expected.lines().count(), 30, "{expected}");
    for (strategy, atlas) in [
        ("replay", "side-by-side"),
        ("replay", "layers"),
        ("geometry", "layers"),
    ] {
        let options = [
            ("VIEWS", "3"),
            ("STRATEGY", strategy),
            ("ATLAS", atlas),
            ("CAPTURE_OUT", picture.to_str().expect("UTF-8")),
            ("CAPTURE_FRAMES", "1"),
        ];
        let actual = lines(layered(&program, &options));
        assert_eq!(actual, expected, "{strategy}, {atlas}");
        let shown = rgb(&picture);
        assert!(
            shown.pixels().all(|p| p.0 == [255, 0, 0]),
            "{strategy}, {atlas}: the frame under a condition is not shown"
        );
    }
}
