//! Points as surfaces: the geometry shader gives each point the size at which it closes the gap to its neighbours, and the fragment shader makes a disk of it
//! that faces the camera.
//!
//! Based on: Hübner, Zhang, Pajarola, "Multi-View Point Splatting" (splats with a radius from their neighbourhood). The radii lie in a storage block, by the number of
//! the point in its draw; the positions are written behind them where they are to be measured.

use super::text::Text;

/// The binding point of the storage block: the last one that all drivers with storage blocks have.
pub const SURFACE_BINDING: u32 = 7;

/// The extension that a geometry shader of surfaces needs, as a line behind `#version`.
pub const SURFACE_EXTENSION: &str = "#extension GL_ARB_shader_storage_buffer_object : require";

/// Declares `float PREFIX_point_size(p, size)` in a geometry shader: the size of the current point, whose place in clip space is `p` and which the program draws in `size`.
pub fn surface_size(prefix: &str) -> String {
    let mut text = Text::default();
    text.line(format!(
        "layout(std430, binding = {SURFACE_BINDING}) buffer {prefix}cloud {{ vec4 {prefix}points[]; }};"
    ));
    write_uniform(&mut text, prefix);
    text.open(format!("float {prefix}point_size(vec4 p, float size) {{"));
    text.line(format!("int count = int({prefix}surface.w);"));
    text.line("if (gl_PrimitiveIDIn >= count) return size;");
    text.line(format!(
        "if ({prefix}surface.y > 0.5) {prefix}points[gl_PrimitiveIDIn + count] = p;"
    ));
    text.line(format!(
        "if ({prefix}surface.x <= 0.0 || p.w <= 0.0) return size;"
    ));
    text.line(format!(
        "return max({prefix}points[gl_PrimitiveIDIn].x * {prefix}surface.x / p.w, 1.0);"
    ));
    text.close("}");
    text.finish()
}

/// Declares `bool PREFIX_in_disk()` in a fragment shader.
pub fn surface_disk(prefix: &str) -> String {
    let mut text = Text::default();
    write_uniform(&mut text, prefix);
    text.open(format!("bool {prefix}in_disk() {{"));
    text.line("vec2 from = gl_PointCoord - 0.5;");
    text.line(format!(
        "return {prefix}surface.x <= 0.0 || dot(from, from) <= 0.25;"
    ));
    text.close("}");
    text.finish()
}

/// x: pixels of a diameter for a radius of 1 where w is 1; 0 where points have the program's size. y: 1 where places are to be written. z: the size of points; 0
/// where the vertex shader sets it. w: number of points.
fn write_uniform(text: &mut Text, prefix: &str) {
    text.line(format!("uniform vec4 {prefix}surface;"));
}
