// Views as tiles of an array texture: side by side in one layer, in several layers, or one to a layer.
//
// View i lies in slot i, except that the middle view and view 0 change places: the view that the program itself reads back has
// to lie at the origin. Slot s is in column s % columns of layer s / columns.

@group(0) @binding(0) var views_texture: texture_2d_array<f32>;

fn slot(view: u32) -> u32 {
    if view == middle() {
        return 0u;
    }
    return select(view, middle(), view == 0u);
}

// One texel of a view, `at` from the top left of its tile.
fn texel(view: u32, at: vec2<u32>) -> vec3<f32> {
    let s = slot(view);
    // In floats: integers would be divided one at a time. The half keeps the quotient away from the next integer.
    let layer = u32((f32(s) + 0.5) / f32(u.columns));
    let x = (s - layer * u.columns) * u.stride + at.x;
    let y = texel_row(u.tile.y - 1u - at.y, u.tile.y);
    return textureLoad(views_texture, vec2<i32>(vec2<u32>(x, y)), i32(layer), 0).rgb;
}
