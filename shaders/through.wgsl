// The picture of a panel straight from a depth image: each subpixel seeks the sample that its view sees, so that the cost does not
// depend on the number of views.

fn through(view: u32, at: vec2<u32>, row: i32, range: vec2<f32>) -> vec3<f32> {
    let x = f32(at.x) + 0.5;
    let seen = see(f32(view), x, row, range);
    return select(colour_of(seen, row), vec3<f32>(0.0), view >= u.views);
}

// A mask of whole pixels: one view for all three colours.
@fragment
fn panel_pixels(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = top_down(position);
    let row = i32(texel_row(u.tile.y - 1u - at.y, u.tile.y));
    return vec4<f32>(through(mask(at).r, at, row, range_of(at.x, row)), 1.0);
}

@fragment
fn panel_subpixels(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = top_down(position);
    let row = i32(texel_row(u.tile.y - 1u - at.y, u.tile.y));
    let views = mask(at);
    let range = range_of(at.x, row);
    return vec4<f32>(
        through(views.r, at, row, range).r,
        through(views.g, at, row, range).g,
        through(views.b, at, row, range).b,
        1.0,
    );
}
