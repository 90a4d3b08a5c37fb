//! Programs with shaders of their own: what they know of them, of their uniforms and of their errors is the same under the layer, whose
//! twins are linked anew, follow the uniforms, and outlive what is deleted as the program does.
#![forbid(unsafe_code)]

mod support;

use support::{Compiled, bare, compiled, extent, layered, lines, rgb};

const VIEWS: u32 = 3;

#[test]
fn a_program_knows_of_its_shaders_what_it_knows_without_the_layer() {
    let program = compiled("shaded", Compiled::Program, &["-lEGL", "-lGL"]);
    let folder = tempfile::tempdir().expect("a folder");
    let picture = folder.path().join("frame.png");
    let expected = lines(&mut bare(&program));
    assert_eq!(
        expected.matches("before a draw: 0x500").count(),
        3,
        "{expected}"
    );
    assert!(expected.contains("pixel 0 255 0"), "{expected}");
    assert!(expected.contains("deleted: 1 0, there: 0 1"), "{expected}");
    for atlas in ["side-by-side", "layers"] {
        let options = [
            ("VIEWS", "3"),
            ("ATLAS", atlas),
            ("STRATEGY", "replay"),
            ("SEPARATION", "0.4"),
            ("CONVERGENCE", "4"),
            ("CAPTURE_OUT", picture.to_str().expect("UTF-8")),
            ("CAPTURE_FRAMES", "1"),
            ("CAPTURE_WHAT", "atlas"),
        ];
        assert_eq!(lines(&mut layered(&program, &options)), expected, "{atlas}");
        let all = rgb(&picture);
        let [left, own, right] = [0, 1, 2].map(|view| extent(&all, VIEWS, view, [0, 255, 0]));
        // Moved by ±0.4 · (2 − 4) / 2 in 64 columns: the nearer one of the two quads, the left camera's to the right.
        for (moved, shift) in [(left[0] - own[0], 12.8), (right[1] - own[1], -12.8)] {
            assert!(
                (moved - shift).abs() <= 1.5,
                "{atlas}: {left:?} {own:?} {right:?}"
            );
        }
    }
}
