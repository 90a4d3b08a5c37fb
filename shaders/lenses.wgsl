// The picture of a panel whose views were drawn lens by lens: the tile's texels lie where the panel shows its view, or next to it. The
// mask has views. A pixel is looked up by its place, whatever the phase of its view, so that what lies between two lenses is drawn
// between them.

// The place of a pixel's middle in the tile of a view, in texels from the bottom left.
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

// A mask of whole pixels, each of them the middle of a texel.
@fragment
fn lens_pixels(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = top_down(position);
    let views = mask(at).rrr;
    let view = shown(views.r);
    return lit(texel_up(view, floor(place(view, at))), views);
}

fn between_columns(view: u32, at: vec2<u32>) -> vec3<f32> {
    let place = place(view, at) - vec2<f32>(0.5, 0.0);
    let low = floor(place);
    let left = texel_up(view, low);
    return mix(left, texel_up(view, low + vec2<f32>(1.0, 0.0)), place.x - low.x);
}

// Rows are those of the window.
@fragment
fn lens_columns(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = top_down(position);
    let views = mask(at);
    let colour = vec3<f32>(
        between_columns(shown(views.r), at).r,
        between_columns(shown(views.g), at).g,
        between_columns(shown(views.b), at).b,
    );
    return lit(colour, views);
}

fn between_texels(view: u32, at: vec2<u32>) -> vec3<f32> {
    let place = place(view, at) - 0.5;
    let low = floor(place);
    let weight = place - low;
    let lower = mix(texel_up(view, low), texel_up(view, low + vec2<f32>(1.0, 0.0)), weight.x);
    let upper = mix(texel_up(view, low + vec2<f32>(0.0, 1.0)), texel_up(view, low + 1.0), weight.x);
    return mix(lower, upper, weight.y);
}

@fragment
fn lens_texels(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = top_down(position);
    let views = mask(at);
    let colour = vec3<f32>(
        between_texels(shown(views.r), at).r,
        between_texels(shown(views.g), at).g,
        between_texels(shown(views.b), at).b,
    );
    return lit(colour, views);
}
