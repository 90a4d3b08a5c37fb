// The part that all output passes share. A pass is cover.wgsl, this file, atlas.wgsl, and then layout.wgsl, anaglyph.wgsl,
// rgbd.wgsl, or mask.wgsl with interleave.wgsl, texels.wgsl or sample_aligned.wgsl; `source` in src/interleave/shader.rs has
// all combinations, also those of synthesis.
//
// Spaces. naga translates without ADJUST_COORDINATE_SPACE, so nothing is flipped: clip space is OpenGL's, and
// @builtin(position) is gl_FragCoord, whose y counts UP from the bottom of the window. Pictures and masks count rows DOWN
// from the top. `top_down` is the only place where the two meet; `texel_row` is the other flip, that of the atlas.
//
// All sizes are in pixels. The struct is no buffer: in GLSL an immediate becomes plain uniforms of our own program, so no
// binding of the application's is touched.

struct Uniforms {
    // Size of one view.
    tile: vec2<u32>,
    // Size of the output picture.
    picture: vec2<u32>,
    // Columns and rows of views in that picture (layout only).
    grid: vec2<u32>,
    // Pixels from the left edge of one slot of the atlas to that of the next.
    stride: u32,
    // Slots in a layer of the atlas.
    columns: u32,
    // N.
    views: u32,
    // View in the bottom left cell of the picture (layout only).
    first: u32,
    // 1: row 0 of the atlas texture is the top row of its picture (a flipped framebuffer); 0: the bottom row.
    rows_top_down: u32,
    // 1: rows of cells count from the top (layout only).
    cells_from_top: u32,
    // 1: colours are fetched and written as linear light.
    linear: u32,
    // 0: the mask holds views. 1, 2: it holds 256ths of views; 1 blends two views, 2 filters three (interleave only).
    filtered: u32,
    // Columns and rows after which the mask repeats (interleave and texels only).
    period: vec2<u32>,
    // Number of low bits of a value of the mask that are the column of a tile; the layer is above them (texels only).
    column_bits: u32,
    // Value of the mask at black subpixels (interleave and texels only).
    black: u32,
    // Weights of the left and the right view in each colour of the picture (anaglyph only).
    left_red: vec4<f32>,
    left_green: vec4<f32>,
    left_blue: vec4<f32>,
    right_red: vec4<f32>,
    right_green: vec4<f32>,
    right_blue: vec4<f32>,
    // Depth buffer values that are shown white (x) and black (y) (rgbd only).
    depth: vec4<f32>,
    // A place (x, y) of the window, in pixels with y upwards, lies in the tile of view i at the column and the row that are the dot
    // products of these with (x, y, 1, i) (sample_aligned only).
    column: vec4<f32>,
    row: vec4<f32>,
    // Disparities are x · depth + y. z: disparity of zero parallax. w: depth where nothing was drawn. (This and the rest are for
    // synthesis only, see disparity.wgsl.)
    disparity: vec4<f32>,
    // x: baseline of view 0. y: baseline from view to view. z: disparity where nothing was drawn. w: amount by which depths are moved away.
    baseline: vec4<f32>,
    // x: the view that is synthesised. y: left edge of its tile. z: 1 marks holes. w: longest baseline of any view that is synthesised
    // from the picture.
    aim: vec4<f32>,
    // x: pixels that an occlusion camera reaches behind an occluder at most (see distortion.wgsl). y, z, w while the disparity pyramid is
    // built: the `Place` of the picture. y while views are synthesised from several: 1 where these lie in copies, one to a layer.
    occlusion: vec4<f32>,
    // The drawn views, from left to right, 8 at most; unused places hold NO_VIEW (see between.wgsl).
    sources_low: vec4<f32>,
    sources_high: vec4<f32>,
    // Disparities of what is nearer than the depth z: x · depth + y. w: 1 where nearer depths are larger, -1 where they are smaller, 0 where all
    // depths take `disparity`.
    before: vec4<f32>,
}

var<immediate> u: Uniforms;

// Column from the left and row from the TOP of a fragment.
fn top_down(position: vec4<f32>) -> vec2<u32> {
    let at = vec2<u32>(position.xy);
    return vec2<u32>(at.x, u.picture.y - 1u - min(at.y, u.picture.y - 1u));
}

// Row of the texture, given the row counted UP from the bottom of the framebuffer that was drawn into.
fn texel_row(up: u32, texture_height: u32) -> u32 {
    return select(up, texture_height - 1u - up, u.rows_top_down != 0u);
}

// The view at the centre of the program's own camera; for even N, the left one of the two beside it.
fn middle() -> u32 {
    return (u.views - 1u) / 2u;
}

// One axis of a bilinear step: two texels and the weight of the second.
struct Tap {
    low: u32,
    high: u32,
    weight: f32,
}

// The place num/den, in (0, 1) across a tile, among `texels` texels with centres at half texels; clamped inside the tile.
// Integers are used up to the weight, so that no rounding can pick another texel. 2 · num · texels has to stay below 2^32,
// which it does for any output and tile up to 16384 pixels.
fn tap(num: u32, den: u32, texels: u32) -> Tap {
    // Minus half a texel for the centre, plus one to stay positive.
    let place = 2u * num * texels + den;
    let above = place / (2u * den);
    let rest = place - above * 2u * den;
    let last = texels - 1u;
    return Tap(min(max(above, 1u) - 1u, last), min(above, last), f32(rest) / f32(2u * den));
}

// Colour of a view at the place num/den of its tile, from the top left. It is bilinear, and exactly the texel where the place is
// the centre of one, as everywhere when tile and picture have the same size.
fn colour(view: u32, num: vec2<u32>, den: vec2<u32>) -> vec3<f32> {
    let x = tap(num.x, den.x, u.tile.x);
    let y = tap(num.y, den.y, u.tile.y);
    if x.weight == 0.0 && y.weight == 0.0 {
        return texel(view, vec2<u32>(x.low, y.low));
    }
    let upper = mix(texel(view, vec2<u32>(x.low, y.low)), texel(view, vec2<u32>(x.high, y.low)), x.weight);
    let lower = mix(texel(view, vec2<u32>(x.low, y.high)), texel(view, vec2<u32>(x.high, y.high)), x.weight);
    return mix(upper, lower, y.weight);
}

// sRGB to linear light; an sRGB texture has been decoded when it was fetched.
fn linear(colour: vec3<f32>) -> vec3<f32> {
    if u.linear != 0u {
        return colour;
    }
    let low = colour / 12.92;
    let high = pow((colour + 0.055) / 1.055, vec3<f32>(2.4));
    return select(high, low, colour <= vec3<f32>(0.04045));
}

// Linear light to sRGB; an sRGB framebuffer encodes by itself.
fn encoded(light: vec3<f32>) -> vec3<f32> {
    if u.linear != 0u {
        return light;
    }
    let low = light * 12.92;
    let high = 1.055 * pow(light, vec3<f32>(1.0 / 2.4)) - 0.055;
    return select(high, low, light <= vec3<f32>(0.0031308));
}
