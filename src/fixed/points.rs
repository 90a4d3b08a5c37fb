//! Points for all views at once: the geometry shader makes of each point one quad, which holds it in every view, and the fragment shader asks for each pixel
//! of a panel what the view that this pixel shows sees of the point.
//!
//! Based on: Hübner, Zhang, Pajarola, "Multi-View Point Splatting" (Equation 6: a quad that holds a splat in all views), for points as OpenGL defines them:
//! squares of a size in pixels (OpenGL 4.6 compatibility, 14.4). The square of a view is found as the rasteriser finds it, with places rounded to the
//! subpixels of GL_SUBPIXEL_BITS. Measured on llvmpipe 22.3, with and without GL_POINT_SPRITE: equal pixels for all sizes and places.
//!
//! The target has the rows of the window and one column for each pixel or, where the colours of a pixel show different views, for each subpixel.

use super::text::Text;

/// Where a view sees a point: the way in which its x in clip space is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PointPlace {
    /// By row 0 of the view's projection times the modelview matrix, as fixed function does.
    Rows,
    /// By the shift of a program variant.
    Shift,
}

/// The quads of the points: text of a geometry shader behind its inputs. It calls `PREFIX_pass()`, which sets the outputs of the program, before each
/// vertex. `glsl` is the version of the fragment shader. The expressions are those of the point's size, and of its vertex where [`PointPlace::Rows`] needs it.
pub fn point_quads(
    prefix: &str,
    place: PointPlace,
    glsl: u32,
    [size, vertex]: [&str; 2],
) -> String {
    let mut text = Text::default();
    let output = match glsl < 130 {
        true => "out",
        false => "flat out",
    };
    write_uniforms(&mut text, prefix, place);
    text.lines(&[
        &format!("{output} vec4 {prefix}clip;"),
        &format!("{output} vec4 {prefix}vertex;"),
        // Size in pixels, and the row of the centre in the framebuffer.
        &format!("{output} vec2 {prefix}square;"),
        "",
    ]);
    write_functions(&mut text, prefix, place);
    text.open(format!(
        "void {prefix}corner(vec2 at, vec4 p, vec2 square) {{"
    ));
    text.line(format!("{prefix}pass();"));
    text.line(format!("{prefix}clip = p;"));
    text.line(format!("{prefix}vertex = {vertex};"));
    text.line(format!("{prefix}square = square;"));
    // All corners have the depth of the point.
    text.line(format!(
        "gl_Position = vec4(at * vec2(2.0 / {prefix}target.x, 2.0 / {prefix}target.y) - 1.0, p.z * (1.0 / p.w), 1.0);"
    ));
    text.line("EmitVertex();");
    text.close("}");
    text.line("");
    text.open("void main() {");
    text.line("vec4 p = gl_in[0].gl_Position;");
    text.line("if (!(p.w > 0.0) || p.y > p.w || p.y < -p.w) return;");
    text.line(format!(
        "float size = min({prefix}rule.w > 0.0 ? {prefix}rule.w : {size}, {prefix}rule.z);"
    ));
    // No less than a pixel, and rounded as places are.
    text.line(format!(
        "size = max(floor(size * {prefix}rule.y + 0.5) / {prefix}rule.y, 1.0);"
    ));
    text.line(format!(
        "vec2 ends = vec2({prefix}centre({prefix}x(p, {vertex}, 0), p.w), {prefix}centre({prefix}x(p, {vertex}, int({prefix}target.w) - 1), p.w));"
    ));
    // Places of views between them are rounded otherwise.
    text.line("ends = vec2(min(ends.x, ends.y) - 0.004, max(ends.x, ends.y) + 0.004);");
    text.line(format!(
        "vec2 columns = vec2({prefix}span(ends.x, size, 0.0).x, {prefix}span(ends.y, size, 0.0).y);"
    ));
    text.line(format!(
        "columns = clamp(columns, 0.0, {prefix}target.x / {prefix}target.z) * {prefix}target.z;"
    ));
    text.line(format!(
        "float row = p.y * (1.0 / p.w) * {prefix}window.z + {prefix}window.w;"
    ));
    text.line(format!(
        "vec2 rows = clamp({prefix}span(row, size, {prefix}rows_down), 0.0, {prefix}target.y);"
    ));
    text.line("if (!(columns.x < columns.y) || !(rows.x < rows.y)) return;");
    text.line(format!(
        "if ({prefix}rows_down > 0.5) rows = {prefix}target.y - rows.yx;"
    ));
    text.line("vec2 square = vec2(size, row);");
    for corner in [
        "columns.x, rows.x",
        "columns.y, rows.x",
        "columns.x, rows.y",
        "columns.y, rows.y",
    ] {
        text.line(format!("{prefix}corner(vec2({corner}), p, square);"));
    }
    text.line("EndPrimitive();");
    text.close("}");
    text.finish()
}

/// What the fragment shader adds, for a shader of this version of GLSL: `bool PREFIX_visible()`, which says whether the view of a pixel sees the point there, and sets
/// `PREFIX_coord` and `PREFIX_point_coord`, which stand for gl_FragCoord and gl_PointCoord; these are declared here.
pub fn point_test(prefix: &str, place: PointPlace, glsl: u32) -> String {
    let mut text = Text::default();
    let (input, fetch) = match glsl < 130 {
        true => ("varying", "texture2D"),
        false => ("flat in", "texture"),
    };
    text.line(format!("uniform sampler2D {prefix}seen;"));
    write_uniforms(&mut text, prefix, place);
    text.lines(&[
        &format!("{input} vec4 {prefix}clip;"),
        &format!("{input} vec4 {prefix}vertex;"),
        &format!("{input} vec2 {prefix}square;"),
        "",
    ]);
    write_functions(&mut text, prefix, place);
    text.open(format!("bool {prefix}visible() {{"));
    text.line(format!(
        "float up = {prefix}rows_down > 0.5 ? {prefix}target.y - gl_FragCoord.y : gl_FragCoord.y;"
    ));
    text.line(format!(
        "int view = int({fetch}({prefix}seen, vec2(gl_FragCoord.x, up) / {prefix}target.xy).x * 255.0 + 0.5);"
    ));
    text.line(format!("if (view >= int({prefix}target.w)) return false;"));
    text.line(format!("vec4 p = {prefix}clip;"));
    text.line(format!("float x = {prefix}x(p, {prefix}vertex, view);"));
    // A point whose centre is outside is clipped as a whole.
    text.line("if (x > p.w || x < -p.w) return false;");
    text.line(format!("float at = {prefix}centre(x, p.w);"));
    text.line(format!(
        "vec2 columns = {prefix}span(at, {prefix}square.x, 0.0);"
    ));
    text.line(format!(
        "float column = floor(gl_FragCoord.x / {prefix}target.z);"
    ));
    text.line("if (column < columns.x || column >= columns.y) return false;");
    text.line(format!(
        "{prefix}coord = vec4(column + 0.5, gl_FragCoord.yz, 1.0 / p.w);"
    ));
    text.line(format!(
        "{prefix}point_coord = 0.5 + vec2(column + 0.5 - at, (up - {prefix}square.y) * {prefix}coord_sign) / {prefix}square.x;"
    ));
    text.line("return true;");
    text.close("}");
    text.finish()
}

/// The globals that [`point_test`] sets; they may be used before it.
pub fn point_globals(prefix: &str) -> String {
    format!("vec4 {prefix}coord; vec2 {prefix}point_coord;")
}

/// `float PREFIX_x(p, vertex, view)`: x of a point in clip space in a view, by the shift of program variants, which is declared before.
pub fn point_shift(prefix: &str) -> String {
    let mut text = Text::default();
    write_x(&mut text, prefix, PointPlace::Shift);
    text.finish()
}

fn write_uniforms(text: &mut Text, prefix: &str, place: PointPlace) {
    let views = super::VIEWS;
    let name = match place {
        PointPlace::Rows => "view",
        PointPlace::Shift => "shift",
    };
    text.lines(&[
        &format!("uniform vec4 {prefix}{name}[{views}];"),
        // x, y: columns and rows. z: columns for each pixel. w: number of views.
        &format!("uniform vec4 {prefix}target;"),
        // From NDC to pixels of the framebuffer: factor and offset of x, and of y.
        &format!("uniform vec4 {prefix}window;"),
        // x: 1 for squares about the centre, 0 for whole pixels. y: places in a pixel. z: largest size. w: size, 0 where the vertex has it.
        &format!("uniform vec4 {prefix}rule;"),
        // 1 where rows of the framebuffer run down.
        &format!("uniform float {prefix}rows_down;"),
        // From rows to gl_PointCoord: 1 or -1.
        &format!("uniform float {prefix}coord_sign;"),
    ]);
}

fn write_x(text: &mut Text, prefix: &str, place: PointPlace) {
    text.open(format!("float {prefix}x(vec4 p, vec4 vertex, int view) {{"));
    match place {
        PointPlace::Rows => {
            text.line(format!("vec4 row = {prefix}view[view];"));
            text.line(
                "return row.x * vertex.x + row.y * vertex.y + row.z * vertex.z + row.w * vertex.w;",
            );
        }
        // As in `rewrite::position`.
        PointPlace::Shift => {
            text.line(format!("vec4 by = {prefix}shift[view];"));
            text.line("if (by.w > 1.5) return p.x + (by.x * p.z - by.y * p.w);");
            text.open("if (p.w > 0.999999 && p.w < 1.000001) {");
            text.line("bool moves = by.w == 0.0 || p.x * p.x < 0.999999 || p.y * p.y < 0.999999;");
            text.line("return moves ? p.x + by.z : p.x;");
            text.close("}");
            text.line("return p.x + (by.x * p.w - by.y);");
        }
    }
    text.close("}");
}

fn write_functions(text: &mut Text, prefix: &str, place: PointPlace) {
    write_x(text, prefix, place);
    text.open(format!("float {prefix}centre(float x, float w) {{"));
    text.line(format!(
        "return x * (1.0 / w) * {prefix}window.x + {prefix}window.y;"
    ));
    text.close("}");
    // The first pixel of a square, and the one after the last.
    text.open(format!(
        "vec2 {prefix}span(float at, float size, float rows_down) {{"
    ));
    text.line(format!("float parts = {prefix}rule.y;"));
    text.open(format!("if ({prefix}rule.x > 0.5) {{"));
    text.lines(&[
        "float wide = size * parts;",
        "float low = floor((at - 0.5) * parts + 0.5) - floor(wide * 0.5) + rows_down;",
        "return ceil(vec2(low, low + wide) / parts);",
    ]);
    text.close("}");
    text.lines(&[
        "float whole = max(ceil(size - 0.5), 1.0);",
        "float before = floor(whole * 0.5);",
        "float even = before * 2.0 == whole ? 0.5 : 0.0;",
        "float first = floor((floor(at * parts + 0.5) - rows_down) / parts + even) - before;",
        "return vec2(first, first + whole);",
    ]);
    text.close("}");
}
