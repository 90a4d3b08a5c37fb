//! `gl_FragCoord` as the program would see it in its own window.
//!
//! ```text
//! (X, Y) = (x − stride·⌊x/stride⌋)·across + y·up + origin        z and w as they are
//! ```
//! x and y are pixels of the atlas, X and Y of the window. By distorted rays there are no strides, and a pixel shows what lies as much to the side as
//! it was moved. Written out where it is used, so that it is right in the values of globals
//! and in helpers as well. The quotient is not negative, so its whole part is its floor, and no function of GLSL is called under a
//! name that the program may have given to its own.

use super::Target;
use super::edit::Edits;
use super::moved;
use super::names::{Names, Uniform};
use super::scan::Scan;
use super::version::Version;

const COORD: &[u8] = b"gl_FragCoord";

/// Whether the token is right as it is: in a declaration of its own (`in vec4 gl_FragCoord`, `invariant gl_FragCoord`), or only z or
/// w are looked at.
fn stays(scan: &Scan, at: usize) -> bool {
    let members = scan.name(at + 2);
    matches!(&*scan.name(at.wrapping_sub(1)), b"vec4" | b"invariant")
        || (scan.is(at + 1, b'.')
            && !members.is_empty()
            && members.iter().all(|c| b"zwbapq".contains(c)))
}

/// Rewrites a fragment shader that uses `gl_FragCoord`; whether it does.
pub(super) fn rewrite(
    edits: &mut Edits,
    scan: &Scan,
    names: &Names,
    version: Version,
    target: Target,
) -> bool {
    let (across, up) = (names.uniform(Uniform::Across), names.uniform(Uniform::Up));
    let local = match target {
        Target::DistortedRays => moved::write_displacement(names),
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
    // The first ES has no more than mediump in fragment shaders of some hardware, and says so by a macro.
    let declaration = if version.es && version.number < 300 {
        format!(
            "#ifdef GL_FRAGMENT_PRECISION_HIGH\n{}\n#else\n{}\n#endif",
            uniforms("highp "),
            uniforms("mediump ")
        )
    } else if target == Target::DistortedRays {
        format!("{} {}", uniforms(""), moved::declaration(names, version))
    } else {
        uniforms(version.highp())
    };
    edits.declare(declaration, first);
    true
}
