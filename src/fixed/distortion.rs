//! Projection by the distorted rays of an occlusion camera.
//!
//! Based on: Popescu et al., "3D display rendering acceleration using occlusion camera reference images", Equations 1 and 2, with
//! the map of `synthesis::RowDistortionMap` and what `shaders/distortion.wgsl` keeps of it:
//! ```text
//! u = x/w·window.x + window.z     v = y/w·window.y + window.w       the place, in texels
//! h = z/w·entry.x + entry.y                                           the height: it goes with 1/w
//! x' = x + moved·entry.z·w                                           moved: pixels
//! ```
//! Of many small triangles, a corner that is not moved is put behind the far plane, and what it is a corner of is discarded: the own
//! view has it, and nobody asks the reference image for it. That leaves few triangles to draw. The vertex stage hands moved·w on: what is linear in clip space divided by w is linear in the picture, as moved is, however the
//! triangle is cut.

use super::text::{Text, VERSION};

/// Between the stages: pixels by which a sample is moved, times w; and what is below 1 where a corner is not moved.
pub(super) const MOVED: &str = "mv_moved";
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
uniform vec4 mv_disparity; // height per unit of NDC's z, what is added; a pixel in NDC; 1: what is not moved is left out";

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
    mv_moved.x = mv_distorted(p) * p.w;
    p.x += mv_moved.x * mv_disparity.z;
    mv_moved.y = 1.0;
    if (mv_disparity.w > 0.0 && mv_moved.x == 0.0 && p.w > 0.0) {
        mv_moved.y = 0.0;
        p.z = -2.0 * sign(mv_disparity.x) * p.w;
    }
    return p;
}";

/// `mv_place(p)`: position, and by how much it is moved.
pub(super) fn write_position(text: &mut Text) {
    text.line(BODY);
    text.line("");
    text.open("void mv_place(vec4 p) {");
    text.line("gl_Position = mv_distort_rays(p);");
    text.close("}");
}

/// Text of a vertex shader object beside another's: `vec4 mv_distort_rays(vec4 p)` is the position of p, and by how much it is moved is handed on. Of
/// a version of its own, which has what it calls. `prefix`: what its names begin with, in the place of `mv_`.
pub fn ray_distortion(prefix: &str) -> String {
    format!("#version {VERSION}\n{UNIFORMS}\nout vec2 {MOVED};\n\n{BODY}\n").replace("mv_", prefix)
}
