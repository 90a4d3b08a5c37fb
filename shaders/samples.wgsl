// The samples of the views that a panel shows, one texel for each: they are gathered from the tiles, drawn to, and scattered back. See src/atlas/samples.rs.
// Texel (x, y) of the samples belongs to the subpixel x % parts of pixel x / parts, where a pixel has several.

struct Uniforms {
    // Size of a tile, which is that of the picture.
    tile: vec2<u32>,
    // Columns and rows after which the mask repeats.
    period: vec2<u32>,
    // Pixels from the left edge of one slot of the atlas to that of the next.
    stride: u32,
    // Slots in a layer of the atlas.
    columns: u32,
    // N.
    views: u32,
    // 1: row 0 of all textures is the top row.
    rows_top_down: u32,
    // Samples of a pixel: 3, or 1 where each pixel shows one view.
    parts: u32,
    // The view whose tile is drawn to, and the left edge of that (scatter only).
    view: u32,
    left: u32,
}

var<immediate> u: Uniforms;

// Colours: of the tiles to gather from, of the samples to scatter.
@group(0) @binding(0) var views_texture: texture_2d_array<f32>;
// Their depths.
@group(0) @binding(2) var depth_texture: texture_2d_array<f32>;
// The view of each sample, as a fraction of 255; 255 is black.
@group(0) @binding(3) var seen_texture: texture_2d<f32>;

struct Sample {
    @location(0) colour: vec4<f32>,
    @builtin(frag_depth) depth: f32,
}

// Row of a texture for one that counts up.
fn texel_row(up: u32) -> u32 {
    return select(up, u.tile.y - 1u - up, u.rows_top_down != 0u);
}

fn slot(view: u32) -> u32 {
    let middle = (u.views - 1u) / 2u;
    if view == middle {
        return 0u;
    }
    return select(view, middle, view == 0u);
}

// Not as integers: those would be divided one at a time.
fn pixel_of(column: u32) -> u32 {
    return u32((f32(column) + 0.5) / f32(u.parts));
}

fn seen(at: vec2<u32>) -> u32 {
    return u32(textureLoad(seen_texture, vec2<i32>(vec2<u32>(at.x, texel_row(at.y))), 0).r * 255.0 + 0.5);
}

// The views of the samples, from the mask.
@fragment
fn seen_views(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = vec2<u32>(position.xy);
    let x = pixel_of(at.x);
    let view = mask(vec2<u32>(x, u.tile.y - 1u - at.y))[at.x - x * u.parts];
    return vec4<f32>(select(f32(view) / 255.0, 1.0, view >= u.views));
}

@fragment
fn gather(@builtin(position) position: vec4<f32>) -> Sample {
    let at = vec2<u32>(position.xy);
    let view = seen(at);
    if view >= u.views {
        discard;
    }
    let s = slot(view);
    let layer = u32((f32(s) + 0.5) / f32(u.columns));
    let place = vec2<i32>(vec2<u32>((s - layer * u.columns) * u.stride + pixel_of(at.x), texel_row(at.y)));
    return Sample(textureLoad(views_texture, place, i32(layer), 0), textureLoad(depth_texture, place, i32(layer), 0).r);
}

@fragment
fn scatter(@builtin(position) position: vec4<f32>) -> Sample {
    let at = vec2<u32>(vec2<u32>(position.xy) - vec2<u32>(u.left, 0u));
    var column = at.x * u.parts;
    let end = column + u.parts;
    while column < end && seen(vec2<u32>(column, at.y)) != u.view {
        column++;
    }
    if column == end {
        discard;
    }
    let place = vec2<i32>(vec2<u32>(column, texel_row(at.y)));
    return Sample(textureLoad(views_texture, place, 0, 0), textureLoad(depth_texture, place, 0, 0).r);
}
