//! `gl_FragCoord` as the program would see it in its own window.
//!
//! ```text
//! (X, Y) = (x − stride·⌊x/stride⌋)·across + y·up + origin        z and w as they are
//! ```
//! x and y are in pixels of the atlas, X and Y in pixels of the window. Under distorted rays there are no strides; the displacement
//! of the sample is subtracted from x instead. The expression replaces every use, so that it holds in initialisers of globals and in
//! helper functions too. The quotient is not negative, so `int` is its floor. No function is called, because the program may have
//! defined one under the name of a built-in.

use super::Target;
use super::displacement;
use super::edit::Edits;
use super::names::{Names, Uniform};
use super::scan::Scan;
use super::version::Version;

const COORD: &[u8] = b"gl_FragCoord";

/// Whether the token needs no edit: it is in a redeclaration (`in vec4 gl_FragCoord`, `invariant gl_FragCoord`), or only its z or w
/// is read.
fn stays(scan: &Scan, at: usize) -> bool {
    let members = scan.name(at + 2);
    matches!(&*scan.name(at.wrapping_sub(1)), b"vec4" | b"invariant")
        || (scan.is(at + 1, b'.')
            && !members.is_empty()
            && members.iter().all(|c| b"zwbapq".contains(c)))
}

/// Rewrites the uses of `gl_FragCoord` in a fragment shader; returns whether there are any.
pub(super) fn rewrite(
    edits: &mut Edits,
    scan: &Scan,
    names: &Names,
    version: Version,
    target: Target,
) -> bool {
    let (across, up) = (names.uniform(Uniform::Across), names.uniform(Uniform::Up));
    let local = match target {
        Target::DistortedRays => displacement::write_displacement(names),
        _ => format!("(gl_FragCoord.x - {across}.z * float(int(gl_FragCoord.x / {across}.z)))"),
    };
    let coord = format!(
        "vec4({local} * {across}.xy + gl_FragCoord.y * {up}.xy + {up}.zw, gl_FragCoord.zw)"
    );
    let mut first = None;
    for (at, token) in scan.tokens.iter().enumerate() {
        if *scan.name(at) == *COORD && !stays(scan, at) {
            first.get_or_insert(at);
            edits.replace(token, coord.as_str());
        }
    }
    let Some(first) = first else {
        return false;
    };
    let uniforms = |precision: &str| format!("uniform {precision}vec4 {across}, {up};");
    // In fragment shaders of GLSL ES 1.00, highp is optional; the macro says whether there is any.
    let declaration = if version.es && version.number < 300 {
        format!(
            "#ifdef GL_FRAGMENT_PRECISION_HIGH\n{}\n#else\n{}\n#endif",
            uniforms("highp "),
            uniforms("mediump ")
        )
    } else if target == Target::DistortedRays {
        format!(
            "{} {}",
            uniforms(""),
            displacement::declaration(names, version)
        )
    } else {
        uniforms(version.highp())
    };
    edits.declare(declaration, first);
    true
}
