// The picture of a panel whose views have fewer texels than the panel has pixels: one for each lens, or evenly spread ones. The mask holds views. A
// pixel is looked up by its place, whatever the phase of its view, so that a point between two lenses is drawn between them.

// The place of a pixel's centre in the tile of a view, in texels from the bottom left.
fn place(view: u32, at: vec2<u32>) -> vec2<f32> {
    let window = vec4<f32>(f32(at.x) + 0.5, f32(u.picture.y) - f32(at.y) - 0.5, 1.0, f32(view));
    return vec2<f32>(dot(u.column, window), dot(u.row, window));
}

fn texel_up(view: u32, at: vec2<f32>) -> vec3<f32> {
    let inside = clamp(at, vec2<f32>(0.0), vec2<f32>(u.tile) - 1.0);
    return texel(view, vec2<u32>(u32(inside.x), u.tile.y - 1u - u32(inside.y)));
}

fn shown(view: u32) -> u32 {
    return min(view, u.views - 1u);
}

fn lit(colour: vec3<f32>, views: vec3<u32>) -> vec4<f32> {
    return vec4<f32>(select(colour, vec3<f32>(0.0), views >= vec3<u32>(u.black)), 1.0);
}

// For a mask of whole pixels, each of which is the centre of a texel.
@fragment
fn lens_pixels(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = top_down(position);
    let views = mask(at).rrr;
    let view = shown(views.r);
    return lit(texel_up(view, floor(place(view, at))), views);
}

fn fetched(x: f32, y: f32, layer: f32) -> vec3<f32> {
    return textureLoad(views_texture, vec2<i32>(vec2<f32>(x, y)), i32(layer), 0).rgb;
}

fn corner(x: vec3<f32>, y: vec3<f32>, layer: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(
        fetched(x.r, y.r, layer.r).r,
        fetched(x.g, y.g, layer.g).g,
        fetched(x.b, y.b, layer.b).b,
    );
}

// All three colours at once: on a CPU the arithmetic around the fetches takes most of the time.
@fragment
fn lens_texels(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let window = vec3<f32>(position.xy, 1.0);
    let views = mask(top_down(position));
    let view = vec3<f32>(vec3<i32>(min(views, vec3<u32>(u.views - 1u))));

    let last = vec2<f32>(u.tile) - 1.0;
    let x = clamp(dot(u.column.xyz, window) - 0.5 + u.column.w * view, vec3<f32>(0.0), vec3<f32>(last.x));
    let y = clamp(dot(u.row.xyz, window) - 0.5 + u.row.w * view, vec3<f32>(0.0), vec3<f32>(last.y));
    let low = floor(y);
    let high = min(low + 1.0, vec3<f32>(last.y));
    let left = floor(x);
    let right = min(left + 1.0, vec3<f32>(last.x));

    // As in `slot` and `texel` of atlas.wgsl.
    let own = f32(middle());
    let first = select(view, vec3<f32>(own), view == vec3<f32>(0.0));
    let slots = select(first, vec3<f32>(0.0), view == vec3<f32>(own));
    let columns = f32(u.columns);
    let layer = floor((slots + 0.5) / columns);
    let start = (slots - layer * columns) * f32(u.stride);
    let flipped = u.rows_top_down != 0u;
    let lower = select(low, last.y - low, flipped);
    let upper = select(high, last.y - high, flipped);

    let beside = x - left;
    let below = mix(corner(start + left, lower, layer), corner(start + right, lower, layer), beside);
    let above = mix(corner(start + left, upper, layer), corner(start + right, upper, layer), beside);
    return lit(mix(below, above, y - low), views);
}
