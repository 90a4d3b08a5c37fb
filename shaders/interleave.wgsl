// The picture of a panel: each subpixel from the view that the mask names.

// Row 0 is the top row. A value of N or more, such as the guard 65535, is black.
@group(0) @binding(1) var mask_texture: texture_2d<u32>;

// One channel at a time: three fetches of one colour each where the views differ.
fn channel(view: u32, at: vec2<u32>) -> vec3<f32> {
    if view >= u.views {
        return vec3<f32>(0.0);
    }
    return colour(view, 2u * at + 1u, 2u * u.picture);
}

@fragment
fn interleave(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = top_down(position);
    var views = textureLoad(mask_texture, vec2<i32>(at), 0).rgb;
    if u.eyes != 0u {
        views = select(views, vec3<u32>(u.views - 1u), views == vec3<u32>(1u));
    }
    let red = channel(views.r, at);
    // Masks of whole pixels name one view three times.
    if all(views.gb == views.rr) {
        return vec4<f32>(red, 1.0);
    }
    return vec4<f32>(red.r, channel(views.g, at).g, channel(views.b, at).b, 1.0);
}
