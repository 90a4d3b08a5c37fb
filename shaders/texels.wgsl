// The picture of a panel whose views have the picture's size: the result of interleave.wgsl for this size and no filter. The mask holds
// tile addresses instead of views: the layer of a tile above the lowest `u.column_bits` bits, its column in those.

fn inside(place: vec3<u32>) -> vec3<u32> {
    // Not `select`: before GLSL 4.50 there is none for vectors of integers.
    return place * vec3<u32>(place < vec3<u32>(u.black));
}

fn lit(colour: vec3<f32>, place: vec3<u32>) -> vec4<f32> {
    return vec4<f32>(select(colour, vec3<f32>(0.0), place >= vec3<u32>(u.black)), 1.0);
}

fn fetched(x: u32, y: u32, layer: u32) -> vec3<f32> {
    return textureLoad(views_texture, vec2<i32>(vec2<u32>(x, y)), i32(layer), 0).rgb;
}

// The row of the texture.
fn row(at: vec2<u32>) -> u32 {
    return texel_row(u.tile.y - 1u - at.y, u.tile.y);
}

// Any mask, any atlas.
@fragment
fn subpixels(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = top_down(position);
    let places = mask(at);
    let tiles = inside(places);
    let layers = tiles >> vec3<u32>(u.column_bits);
    let x = (tiles - (layers << vec3<u32>(u.column_bits))) * u.stride + at.x;
    let y = row(at);
    return lit(vec3<f32>(fetched(x.r, y, layers.r).r, fetched(x.g, y, layers.g).g, fetched(x.b, y, layers.b).b), places);
}

// All tiles are beside each other in one layer.
@fragment
fn subpixels_of_one_layer(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = top_down(position);
    let places = mask(at);
    let x = inside(places) * u.stride + at.x;
    let y = row(at);
    return lit(vec3<f32>(fetched(x.r, y, 0u).r, fetched(x.g, y, 0u).g, fetched(x.b, y, 0u).b), places);
}

// A mask of whole pixels: one view for all three colours.
@fragment
fn pixels(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = top_down(position);
    let places = mask(at).rrr;
    let tile = inside(places).r;
    let layer = tile >> u.column_bits;
    let x = (tile - (layer << u.column_bits)) * u.stride + at.x;
    return lit(fetched(x, row(at), layer), places);
}
