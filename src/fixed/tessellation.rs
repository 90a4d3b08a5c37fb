//! Tessellation shaders: triangles and quads are subdivided until their edges in the picture are too short for distorted rays to
//! bend them visibly.
//!
//! Based on: Popescu et al., section V: an occlusion camera does not keep lines straight, so primitives are subdivided before
//! they are projected. Values of the new vertices are interpolated linearly in clip space, as over the whole triangle. No level is
//! above [`LEVELS`]: edges that need more stay coarser, and each sample still says how far it was moved.

use super::components::varyings;
use super::distortion::UNIFORM_WINDOW;
use super::key::{FixedKey, Primitive, Provoking};
use super::text::{TESSELLATION_VERSION, Text};
use super::vertex;

/// Length of an edge after subdivision, in pixels.
const LONGEST: u32 = 4;
/// The highest level that every driver with tessellation has.
pub const LEVELS: u32 = 64;
/// `uniform float mv_levels`
pub const UNIFORM_LEVELS: &str = "mv_levels";

fn corners(key: &FixedKey) -> u8 {
    match key.target.primitive {
        Primitive::Quads => 4,
        _ => 3,
    }
}

/// Source of the tessellation control shader of a canonical key.
pub(super) fn write_control(key: &FixedKey) -> String {
    let mut text = Text::default();
    text.line(format!("#version {TESSELLATION_VERSION} compatibility"));
    text.line(format!("layout(vertices = {}) out;", corners(key)));
    vertex::write_block(&mut text, key, "in", "mv_in[]");
    vertex::write_block(&mut text, key, "out", "mv_out[]");
    text.line(format!("uniform vec4 {UNIFORM_WINDOW};"));
    text.line(format!(
        "uniform float {UNIFORM_LEVELS}; // the highest level"
    ));
    text.line("");
    text.open("float mv_level(int from, int to) {");
    text.line("vec4 a = gl_in[from].gl_Position;");
    text.line("vec4 b = gl_in[to].gl_Position;");
    text.line("if (!(a.w > 0.0 && b.w > 0.0))");
    text.line(format!("    return {UNIFORM_LEVELS};"));
    text.line(format!(
        "return clamp(length((a.xy / a.w - b.xy / b.w) * {UNIFORM_WINDOW}.xy) / {LONGEST}.0, 1.0, {UNIFORM_LEVELS});"
    ));
    text.close("}");
    text.line("");
    text.open("void main() {");
    text.line("gl_out[gl_InvocationID].gl_Position = gl_in[gl_InvocationID].gl_Position;");
    for varying in varyings(key) {
        let member = varying.member();
        text.line(format!(
            "mv_out[gl_InvocationID].{member} = mv_in[gl_InvocationID].{member};"
        ));
    }
    text.open("if (gl_InvocationID == 0) {");
    // Outer levels belong to the sides opposite to the corners of a triangle, or to the left, lower, right and upper side of a quad.
    let sides: &[[u8; 2]] = match corners(key) {
        4 => &[[0, 3], [0, 1], [1, 2], [3, 2]],
        _ => &[[1, 2], [2, 0], [0, 1]],
    };
    for (at, [from, to]) in sides.iter().enumerate() {
        text.line(format!("gl_TessLevelOuter[{at}] = mv_level({from}, {to});"));
    }
    let inner: &[&str] = match corners(key) {
        4 => &[
            "max(gl_TessLevelOuter[1], gl_TessLevelOuter[3])",
            "max(gl_TessLevelOuter[0], gl_TessLevelOuter[2])",
        ],
        _ => &["max(max(gl_TessLevelOuter[0], gl_TessLevelOuter[1]), gl_TessLevelOuter[2])"],
    };
    for (at, level) in inner.iter().enumerate() {
        text.line(format!("gl_TessLevelInner[{at}] = {level};"));
    }
    text.close("}");
    text.close("}");
    text.finish()
}

/// The corner that gives a flat primitive its colours.
fn flat_source(key: &FixedKey) -> Option<u8> {
    key.flat.then(|| match key.provoking {
        Provoking::First => 0,
        Provoking::Last => corners(key) - 1,
    })
}

/// Source of the tessellation evaluation shader of a canonical key.
pub(super) fn write_evaluation(key: &FixedKey) -> String {
    let corners = corners(key);
    let mut text = Text::default();
    text.line(format!("#version {TESSELLATION_VERSION} compatibility"));
    let domain = if corners == 4 { "quads" } else { "triangles" };
    text.line(format!("layout({domain}, equal_spacing, ccw) in;"));
    vertex::write_last(&mut text, key);
    text.open("void main() {");
    text.line(match corners {
        4 => "vec4 at = vec4((1.0 - gl_TessCoord.x) * (1.0 - gl_TessCoord.y), gl_TessCoord.x * (1.0 - gl_TessCoord.y), gl_TessCoord.x * gl_TessCoord.y, (1.0 - gl_TessCoord.x) * gl_TessCoord.y);",
        _ => "vec3 at = gl_TessCoord;",
    });
    let between = |of: &dyn Fn(u8) -> String| {
        let parts = (0..corners).map(|i| format!("at[{i}] * {}", of(i)));
        parts.collect::<Vec<_>>().join(" + ")
    };
    vertex::write_between(&mut text, key, flat_source(key), &between);
    let position = between(&|i| format!("gl_in[{i}].gl_Position"));
    text.line(format!("mv_place({position});"));
    text.close("}");
    text.finish()
}
