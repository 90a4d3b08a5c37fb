//! The geometry shader, which emits the primitive for each view.
//!
//! Based on: Q. Luo et al., "GPU-based multi-view rendering" and F. de Sorbier et al., "GPU rendering for
//! autostereoscopic displays" (3DPVT 2008): the primitive is emitted once per view, shifted and clipped to its tile. All three ways
//! of the latter to clip are here: fragments are discarded, whole primitives are dropped as well, or triangles are cut.
//!
//! The order of emission keeps the order of the input, so the driver's provoking vertex is the program's own. A quad or
//! polygon arrives as another primitive (see [`Primitive`]), so its flat colour is written to every vertex.

use super::components::{Varying, varyings};
use super::key::{Amplifier, Diagonal, FixedKey, PointSize, Primitive, Provoking};
use super::limits::Limits;
use super::points::{PointPlace, point_quads};
use super::reason::Unsupported;
use super::surface::{SURFACE_EXTENSION, surface_size};
use super::text::{Text, VERSION};
use super::{UNIFORM_CLIP, UNIFORM_FIRST, UNIFORM_VIEWS, vertex};
use crate::config::Clip;

/// Vertices in the order of emission, with their index in the input, by primitive.
fn order(key: &FixedKey) -> &'static [&'static [u8]] {
    match (key.target.primitive, key.target.diagonal) {
        (Primitive::Points, _) => &[&[0]],
        (Primitive::Lines, _) => &[&[0, 1]],
        (Primitive::Triangles | Primitive::Polygon, _) => &[&[0, 1, 2]],
        (Primitive::Quads | Primitive::QuadStrip, Diagonal::OneThree) => &[&[0, 1, 3], &[1, 2, 3]],
        (Primitive::Quads | Primitive::QuadStrip, Diagonal::ZeroTwo) => &[&[0, 1, 2], &[0, 2, 3]],
    }
}

/// The input vertex whose colours all vertices of a flat primitive take, by table 13.2 in the vertex order of [`Primitive`];
/// `None` where the driver's provoking vertex is the right one.
fn flat_source(key: &FixedKey) -> Option<u8> {
    if !key.flat {
        return None;
    }
    match (key.target.primitive, key.provoking) {
        (Primitive::Points | Primitive::Lines | Primitive::Triangles, _) => None,
        (Primitive::Polygon, _) => Some(0),
        (Primitive::Quads, Provoking::Last) => Some(3),
        (Primitive::QuadStrip, Provoking::Last) => Some(2),
        (Primitive::Quads | Primitive::QuadStrip, Provoking::First) => Some(0),
    }
}

fn input_layout(primitive: Primitive) -> &'static str {
    match primitive {
        Primitive::Points => "points",
        Primitive::Lines => "lines",
        Primitive::Triangles | Primitive::Polygon => "triangles",
        Primitive::Quads | Primitive::QuadStrip => "lines_adjacency",
    }
}

fn output_layout(primitive: Primitive) -> &'static str {
    match primitive {
        Primitive::Points => "points",
        Primitive::Lines => "line_strip",
        Primitive::Triangles | Primitive::Polygon | Primitive::Quads | Primitive::QuadStrip => {
            "triangle_strip"
        }
    }
}

/// Source of the geometry shader of a canonical key.
pub(super) fn write(key: &FixedKey, limits: &Limits) -> Result<String, Unsupported> {
    if key.target.amplifier == Amplifier::Points {
        return Ok(write_points(key));
    }
    let mut text = Text::default();
    let views = key.target.views;
    let primitive = key.target.primitive;
    let invocations = key.target.amplifier == Amplifier::GeometryInvocations;
    let extension = invocations && limits.glsl < 400;
    if invocations && (limits.geometry_invocations == 0 || extension && !limits.gpu_shader5) {
        return Err(Unsupported::Invocations);
    }
    text.line(if invocations && !extension {
        "#version 400 compatibility"
    } else {
        "#version 150 compatibility"
    });
    if extension {
        text.line("#extension GL_ARB_gpu_shader5 : require");
    }
    if key.target.surface {
        text.line(SURFACE_EXTENSION);
    }
    text.line("");
    let runs = if invocations {
        format!(", invocations = {views}")
    } else {
        String::new()
    };
    text.line(format!("layout({}{runs}) in;", input_layout(primitive)));
    let loops = if invocations { 1 } else { u32::from(views) };
    text.line(format!(
        "layout({}, max_vertices = {}) out;",
        output_layout(primitive),
        key.target.emitted() * loops
    ));
    vertex::write_last(&mut text, key);
    if key.target.surface {
        text.line(surface_size("mv_"));
    }
    if key.target.cuts() {
        write_emit_between(&mut text, key);
        text.line("");
        write_cut(&mut text);
    } else {
        write_emit(&mut text, key);
    }
    text.line("");
    if key.target.clip == Clip::Both {
        write_outside(&mut text);
        text.line("");
    }
    write_main(&mut text, key, invocations);
    Ok(text.finish())
}

/// The geometry shader of points for all views. A point has the colours of its front.
fn write_points(key: &FixedKey) -> String {
    let mut text = Text::default();
    text.line("#version 150 compatibility");
    text.line("layout(points) in;");
    text.line("layout(triangle_strip, max_vertices = 4) out;");
    vertex::write_block(&mut text, key, "in", "mv_in[]");
    let distances = key.clip_distances();
    if distances != 0 {
        text.line(format!("out float gl_ClipDistance[{distances}];"));
    }
    text.open("void mv_pass() {");
    for varying in varyings(key) {
        let member = match varying {
            Varying::PointSize => continue,
            Varying::Back => Varying::Front.member(),
            Varying::BackSecondary => Varying::FrontSecondary.member(),
            _ => varying.member(),
        };
        if let Some(builtin) = varying.builtin(key) {
            text.line(format!("{builtin} = mv_in[0].{member};"));
        }
    }
    text.close("}");
    let size = match key.point {
        PointSize::Attenuated => "mv_in[0].size",
        PointSize::Unused | PointSize::Constant => "1.0",
    };
    let quads = point_quads("mv_", PointPlace::Rows, VERSION, [size, "mv_in[0].vertex"]);
    text.finish() + &quads
}

/// Writes `mv_emit(vertex, view)`, which emits one vertex with all outputs that the fixed fragment stage and the rasteriser
/// read. It sets all of them each time, because outputs are undefined after `EmitVertex()`.
fn write_emit(text: &mut Text, key: &FixedKey) {
    text.open("void mv_emit(int vertex, int view) {");
    text.line("mv_place(view, gl_in[vertex].gl_Position, mv_in[vertex].vertex);");
    for varying in varyings(key) {
        let Some(builtin) = varying.builtin(key) else {
            continue;
        };
        let source = match flat_source(key) {
            Some(source) if varying.is_color() => source.to_string(),
            _ => "vertex".into(),
        };
        text.line(format!("{builtin} = mv_in[{source}].{};", varying.member()));
    }
    if key.target.surface {
        let size = match key.point {
            PointSize::Attenuated => "mv_in[vertex].size",
            PointSize::Unused | PointSize::Constant => "mv_surface.z",
        };
        text.line(format!(
            "gl_PointSize = mv_point_size(gl_in[vertex].gl_Position, {size});"
        ));
    }
    text.line("gl_PrimitiveID = gl_PrimitiveIDIn;");
    text.line("EmitVertex();");
    text.close("}");
}

/// Writes `mv_emit(at, view)`, which emits a vertex inside a triangle or on its edges; `at` holds its barycentric coordinates.
/// Values are linear in these in clip space, so the vertex gets the values of that point of the whole triangle.
fn write_emit_between(text: &mut Text, key: &FixedKey) {
    let between = |of: &dyn Fn(u8) -> String| {
        format!("at.x * {} + at.y * {} + at.z * {}", of(0), of(1), of(2))
    };
    text.open("void mv_emit(vec3 at, int view) {");
    let position = between(&|i| format!("gl_in[{i}].gl_Position"));
    let vertex = between(&|i| format!("mv_in[{i}].vertex"));
    text.line(format!("mv_place(view, {position}, {vertex});"));
    vertex::write_between(text, key, flat_source(key), &between);
    text.line("gl_PrimitiveID = gl_PrimitiveIDIn;");
    text.line("EmitVertex();");
    text.close("}");
}

/// Writes `mv_cut(view)`, which cuts the triangle at the left and the right edge of its tile by the algorithm of Sutherland and
/// Hodgman. Distances from an edge are in homogeneous coordinates, so the sign of w does not matter.
fn write_cut(text: &mut Text) {
    text.open("void mv_cut(int view) {");
    text.line(format!("vec4 row = {UNIFORM_VIEWS}[view];"));
    text.line("vec3 x = vec3(dot(row, mv_in[0].vertex), dot(row, mv_in[1].vertex), dot(row, mv_in[2].vertex));");
    text.line(
        "vec3 w = vec3(gl_in[0].gl_Position.w, gl_in[1].gl_Position.w, gl_in[2].gl_Position.w);",
    );
    text.line("vec3 corners[5];");
    text.line("corners[0] = vec3(1.0, 0.0, 0.0);");
    text.line("corners[1] = vec3(0.0, 1.0, 0.0);");
    text.line("corners[2] = vec3(0.0, 0.0, 1.0);");
    text.line("int count = 3;");
    text.open("for (int side = 0; side < 2; ++side) {");
    text.line(format!(
        "vec3 inside = side == 0 ? x - {UNIFORM_CLIP}.x * w : {UNIFORM_CLIP}.y * w - x;"
    ));
    text.line("vec3 kept[5];");
    text.line("int number = 0;");
    text.open("for (int i = 0; i < count; ++i) {");
    text.line("vec3 from = corners[i];");
    text.line("vec3 to = corners[i + 1 < count ? i + 1 : 0];");
    text.line("float here = dot(inside, from);");
    text.line("float there = dot(inside, to);");
    text.line("if (here >= 0.0 && number < 5) kept[number++] = from;");
    text.line("if ((here < 0.0) != (there < 0.0) && number < 5) kept[number++] = from + (to - from) * (here / (here - there));");
    text.close("}");
    text.line("corners = kept;");
    text.line("count = number;");
    text.close("}");
    text.line("if (count < 3) return;");
    // Alternating from both ends, so that a strip covers the polygon.
    text.line("int low = 0;");
    text.line("int high = count;");
    text.open("for (int i = 0; i < count; ++i) {");
    text.line("mv_emit(corners[i == 0 ? 0 : i % 2 == 1 ? ++low : --high], view);");
    text.close("}");
    text.line("EndPrimitive();");
    text.close("}");
}

/// Writes `mv_outside(view)`, which tells whether the whole primitive lies beyond the left or beyond the right edge of its tile.
/// The edges are planes in homogeneous coordinates: a primitive lies beyond one if all its corners do, whatever the sign of w.
fn write_outside(text: &mut Text) {
    text.open("bool mv_outside(int view) {");
    text.line(format!("vec4 row = {UNIFORM_VIEWS}[view];"));
    text.line("bool left = true;");
    text.line("bool right = true;");
    text.open("for (int i = 0; i < gl_in.length(); ++i) {");
    text.line("float x = dot(row, mv_in[i].vertex);");
    text.line("float w = gl_in[i].gl_Position.w;");
    text.line(format!("left = left && x < {UNIFORM_CLIP}.x * w;"));
    text.line(format!("right = right && x > {UNIFORM_CLIP}.y * w;"));
    text.close("}");
    text.line("return left || right;");
    text.close("}");
}

fn write_main(text: &mut Text, key: &FixedKey, invocations: bool) {
    text.open("void main() {");
    if invocations {
        text.line(format!("int view = {UNIFORM_FIRST} + gl_InvocationID;"));
    } else {
        text.open(format!("for (int i = 0; i < {}; ++i) {{", key.target.views));
        text.line(format!("int view = {UNIFORM_FIRST} + i;"));
    }
    if key.target.clip == Clip::Both {
        text.line("if (mv_outside(view)) {");
        text.line(if invocations {
            "    return;"
        } else {
            "    continue;"
        });
        text.line("}");
    }
    if key.target.cuts() {
        text.line("mv_cut(view);");
    }
    for primitive in order(key).iter().filter(|_| !key.target.cuts()) {
        for vertex in *primitive {
            text.line(format!("mv_emit({vertex}, view);"));
        }
        text.line("EndPrimitive();");
    }
    if !invocations {
        text.close("}");
    }
    text.close("}");
}
