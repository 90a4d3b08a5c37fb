//! Programs with shaders of their own: shaders, uniforms and errors read back the same under the layer, whose variants are linked again
//! with them, follow the uniforms, and outlive deleted objects as the program does.

use crate::support::views::{REPLAYED, Views, extents};
use crate::support::{Compiled, bare, compiled, layered, lines};

#[test]
fn a_program_knows_of_its_shaders_what_it_knows_without_the_layer() {
    let program = compiled("shaded", Compiled::Program, &["-lEGL", "-lGL"]);
    let expected = lines(&mut bare(&program));
    assert_eq!(
        expected.matches("before a draw: 0x500").count(),
        3,
        "{expected}"
    );
    assert!(expected.contains("pixel 0 255 0"), "{expected}");
    assert!(expected.contains("deleted: 1 0, there: 0 1"), "{expected}");
    for atlas in ["side-by-side", "layers"] {
        let views = Views { atlas, ..REPLAYED };
        let (told, all) = views.shown(&mut layered(&program, &[]));
        assert_eq!(told, expected, "{atlas}");
        let [left, own, right] = extents(&all, [0, 255, 0]);
        // Moved by ±0.4 · (2 − 4) / 2 in 64 columns: the nearer of the two quads, to the right for the left camera.
        for (moved, shift) in [(left[0] - own[0], 12.8), (right[1] - own[1], -12.8)] {
            assert!(
                (moved - shift).abs() <= 1.5,
                "{atlas}: {left:?} {own:?} {right:?}"
            );
        }
    }
}
