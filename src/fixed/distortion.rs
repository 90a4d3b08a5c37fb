//! Projection by the distorted rays of an occlusion camera.
//!
//! Based on: Popescu et al., "3D display rendering acceleration using occlusion camera reference images", Equations 1 and 2, with
//! the map of `synthesis::RowDistortionMap`, in the encoding of `shaders/distortion.wgsl`:
//! ```text
//! u = x/w·window.x + window.z     v = y/w·window.y + window.w       the place, in pixels; a texel covers two of a row
//! h = z/w·disparity.x + disparity.y                                   the disparity, which is linear in 1/w
//! x' = x + displacement·disparity.z·w                                the displacement in pixels
//! ```
//! In a draw of many small triangles, `disparity.w` is 1: a vertex that is not moved is put behind the far plane, and the fragments
//! of its triangles are discarded. The own view shows those surfaces already, so the reference image does not need them, and few
//! triangles remain to be drawn.
//!
//! The vertex stage passes on displacement·w. It is interpolated linearly in clip space, so divided by w it is linear in the picture, as
//! the displacement is, however the triangle is clipped.

use super::text::{Text, VERSION};

/// Varying between the stages: displacement of a sample in pixels, times w; and a value below 1 where a vertex is left out.
pub(super) const DISPLACEMENT: &str = "mv_displacement";
/// `uniform sampler2DArray mv_distortion_map`
pub const UNIFORM_DISTORTION_MAP: &str = "mv_distortion_map";
/// `uniform vec4 mv_window`
pub const UNIFORM_WINDOW: &str = "mv_window";
/// `uniform vec4 mv_disparity`
pub const UNIFORM_DISPARITY: &str = "mv_disparity";

/// The uniforms.
pub(super) const UNIFORMS: &str = "\
uniform sampler2DArray mv_distortion_map; // the distortion map
uniform vec4 mv_window; // texels of the map per unit of NDC, x and y; the texel of its middle
uniform vec4 mv_disparity; // disparity per unit of NDC's z, what is added; a pixel in NDC; 1: what is not moved is left out";

const BODY: &str = "\
float mv_distorted(vec4 p) {
    if (!(p.w > 0.0))
        return 0.0;
    vec3 at = p.xyz / p.w;
    vec2 place = clamp(at.xy * mv_window.xy + mv_window.zw, vec2(-1.0), vec2(65536.0));
    ivec2 texel = ivec2(floor(place * vec2(0.5, 1.0)));
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, textureSize(mv_distortion_map, 0).xy)))
        return 0.0;
    vec4 entry = texelFetch(mv_distortion_map, ivec3(texel, 0), 0);
    float side = sign(entry.y);
    float radius = abs(entry.y);
    float level = floor(entry.x / 128.0 + 0.5);
    float from = (place.x - float(2 * texel.x + 1) - (entry.x - 128.0 * level)) * side;
    if (radius == 0.0 || from < -radius)
        return 0.0;
    float depth = clamp((entry.z - (at.z * mv_disparity.x + mv_disparity.y)) / (entry.z - entry.w), 0.0, 1.0);
    return side * max(radius - (from + radius) / (1.0 + exp2(-level)), 0.0) * depth;
}

vec4 mv_distort_rays(vec4 p) {
    mv_displacement.x = mv_distorted(p) * p.w;
    p.x += mv_displacement.x * mv_disparity.z;
    mv_displacement.y = 1.0;
    if (mv_disparity.w > 0.0 && mv_displacement.x == 0.0 && p.w > 0.0) {
        mv_displacement.y = 0.0;
        p.z = -2.0 * sign(mv_disparity.x) * p.w;
    }
    return p;
}";

/// Writes `mv_place(p)`, which sets the position and the displacement.
pub(super) fn write_position(text: &mut Text) {
    text.line(BODY);
    text.line("");
    text.open("void mv_place(vec4 p) {");
    text.line("gl_Position = mv_distort_rays(p);");
    text.close("}");
}

/// Source of a vertex shader object that is linked beside another. Its `vec4 mv_distort_rays(vec4 p)` returns the moved position
/// of p in clip space, and writes the displacement to a varying. The `#version` is its own, so that the functions which it calls
/// exist. `prefix` replaces `mv_` in all names.
pub fn ray_distortion(prefix: &str) -> String {
    format!("#version {VERSION}\n{UNIFORMS}\nout vec2 {DISPLACEMENT};\n\n{BODY}\n")
        .replace("mv_", prefix)
}
