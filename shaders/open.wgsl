// Where the program's own draws are let into views that are made: what was a hole in the frame before, and some pixels around it.

// 1 where they are, in cells of CELL pixels each way, a layer for each view; while the cells are found, of the view alone.
@group(0) @binding(5) var open_texture: texture_2d_array<f32>;

// As src/atlas/openings.rs has it.
const CELL = 4;

fn is_open(view: i32, at: vec2<i32>) -> bool {
    return textureLoad(open_texture, at / CELL, view, 0).r > 0.5;
}

// What a view shows at a place of its textures: what was drawn there, or what is made.
fn drawn_or(view: u32, x: i32, row: i32, made: vec3<f32>) -> vec3<f32> {
    let at = min(view, u.views - 1u);
    let s = slot(at);
    let layer = u32((f32(s) + 0.5) / f32(u.columns));
    let left = i32((s - layer * u.columns) * u.stride);
    let drawn = textureLoad(views_texture, vec2<i32>(left + x, row), i32(layer), 0).rgb;
    return select(made, drawn, is_open(i32(at), vec2<i32>(x, row)));
}
