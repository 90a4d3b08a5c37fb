// The picture of a wall: a sheet with the pixels of all its panels. Each subpixel shows its view, by the mask of its panel, at the place of the
// picture that the panel's warp gives.

// The corners of cells of the sheet, row 0 on top: x and y are the place in the picture, 0 to 1 from its left and top, z is the share of the light.
@group(0) @binding(9) var warp_texture: texture_2d<f32>;

// Width and height of a cell in pixels; CELL in src/display/wall.rs.
const CELL = 16.0;

fn warped(at: vec2<u32>) -> vec3<f32> {
    let place = (vec2<f32>(at) + 0.5) / CELL;
    let cell = vec2<i32>(place);
    let within = place - floor(place);
    let upper = mix(
        textureLoad(warp_texture, cell, 0).xyz,
        textureLoad(warp_texture, cell + vec2<i32>(1, 0), 0).xyz,
        within.x,
    );
    let lower = mix(
        textureLoad(warp_texture, cell + vec2<i32>(0, 1), 0).xyz,
        textureLoad(warp_texture, cell + vec2<i32>(1, 1), 0).xyz,
        within.x,
    );
    return mix(upper, lower, within.y);
}

// One channel at a time: three fetches of one colour each where the views differ.
fn channel(view: u32, place: vec2<f32>) -> vec3<f32> {
    if view >= u.views {
        return vec3<f32>(0.0);
    }
    let last = vec2<f32>(u.tile - 1u);
    let texels = clamp(place * vec2<f32>(u.tile) - 0.5, vec2<f32>(0.0), last);
    let low = vec2<u32>(texels);
    let high = min(low + 1u, u.tile - 1u);
    let weight = texels - floor(texels);
    let upper = mix(texel(view, low), texel(view, vec2<u32>(high.x, low.y)), weight.x);
    let lower = mix(texel(view, vec2<u32>(low.x, high.y)), texel(view, high), weight.x);
    return mix(upper, lower, weight.y);
}

@fragment
fn wall(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = top_down(position);
    let views = mask(at);
    let place = warped(at);
    if any(place.xy < vec2<f32>(0.0)) || any(place.xy > vec2<f32>(1.0)) {
        return vec4<f32>(0.0, 0.0, 0.0, 1.0);
    }
    var colour = channel(views.r, place.xy);
    if any(views.gb != views.rr) {
        colour = vec3<f32>(colour.r, channel(views.g, place.xy).g, channel(views.b, place.xy).b);
    }
    if place.z < 1.0 {
        colour = encoded(linear(colour) * place.z);
    }
    return vec4<f32>(colour, 1.0);
}
