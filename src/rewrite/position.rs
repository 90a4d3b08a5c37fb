//! The shift of a view, in clip space.
//!
//! ```text
//! x' = x + s·w − s·conv     in the scene: equal to the view's own projection if w in eye space is 1
//! x' = x + flat             if w in clip space is 1: no perspective, so no depth to shift by
//! x' = x + s·z − s·conv·w   in an orthographic scene
//! ```
//! Where such a vertex belongs to the scene, it stays if it is a corner of the screen or beyond: of a sky or another picture that covers the
//! screen, which would have a gap at its edge.
//!
//! y, z and w do not change. No function is called, because the program may have defined one under the name of a built-in.

use super::edit::Edits;
use super::names::{Names, Uniform};
use super::version::Version;

/// Declares the uniforms of the shift.
pub(super) fn declare(edits: &mut Edits, names: &Names, version: Version, views: u32) {
    let (highp, shift) = (version.highp(), names.uniform(Uniform::Shift));
    edits.append(format!("uniform {highp}vec4 {shift}[{views}];"));
}

/// Writes the statements that shift `gl_Position`. `view` is an index into the uniforms.
pub(super) fn shift(edits: &mut Edits, names: &Names, version: Version, view: &str) {
    let (highp, shift, by) = (
        version.highp(),
        names.uniform(Uniform::Shift),
        names.other("by"),
    );
    edits.append(format!("    {highp}vec4 {by} = {shift}[{view}];"));
    edits.append(format!("    if ({by}.w > 1.5)"));
    edits.append(format!(
        "        gl_Position.x += {by}.x * gl_Position.z - {by}.y * gl_Position.w;"
    ));
    edits.append("    else if (gl_Position.w > 0.999999 && gl_Position.w < 1.000001)");
    edits.append("    {");
    edits.append(format!(
        "        if ({by}.w == 0.0 || gl_Position.x * gl_Position.x < 0.999999 || gl_Position.y * gl_Position.y < 0.999999)"
    ));
    edits.append(format!("            gl_Position.x += {by}.z;"));
    edits.append("    }");
    edits.append("    else");
    edits.append(format!(
        "        gl_Position.x += {by}.x * gl_Position.w - {by}.y;"
    ));
}
