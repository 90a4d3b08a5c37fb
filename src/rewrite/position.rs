//! The shift of a view, in clip space.
//!
//! ```text
//! x' = x + s·w − s·conv     in the scene: the same as the view's own projection where w of the eye is 1
//! x' = x + flat             where w of the clip space is 1: no perspective, so no depth to shift by
//! ```
//! y, z and w do not change. Nothing is called here: programs may have functions of their own under the names of GLSL's.

use super::edit::Edits;
use super::names::{Names, Uniform};
use super::version::Version;

/// The uniforms of the shift.
pub(super) fn declare(edits: &mut Edits, names: &Names, version: Version, views: u32) {
    let (highp, shift) = (version.highp(), names.uniform(Uniform::Shift));
    edits.append(format!("uniform {highp}vec4 {shift}[{views}];"));
}

/// Moves `gl_Position`, in the body of a function. `view` is an index into the uniforms.
pub(super) fn shift(edits: &mut Edits, names: &Names, version: Version, view: &str) {
    let (highp, shift, by) = (
        version.highp(),
        names.uniform(Uniform::Shift),
        names.other("by"),
    );
    edits.append(format!("    {highp}vec4 {by} = {shift}[{view}];"));
    edits.append("    if (gl_Position.w > 0.999999 && gl_Position.w < 1.000001)");
    edits.append(format!("        gl_Position.x += {by}.z;"));
    edits.append("    else");
    edits.append(format!(
        "        gl_Position.x += {by}.x * gl_Position.w - {by}.y;"
    ));
}
