// The picture of a panel: each subpixel from the view that the mask names, or from the views around its place between two.
// For views of any size, filtered or not; texels.wgsl is for views of the picture's size without a filter.

// Steps from view to view.
const FINE = 256.0;
// Standard deviation of the Gaussian, in views. In the middle of a view, its neighbours have a quarter of its weight.
const SIGMA = 0.6;

// One channel at a time: three fetches of one colour each where the views differ.
fn channel(view: u32, at: vec2<u32>) -> vec3<f32> {
    if view >= u.views {
        return vec3<f32>(0.0);
    }
    return colour(view, 2u * at + 1u, 2u * u.picture);
}

// Linear light of a view. Beyond the first and the last view, that one is taken.
fn light(view: i32, at: vec2<u32>) -> vec3<f32> {
    let inside = u32(clamp(view, 0, i32(u.views) - 1));
    return linear(colour(inside, 2u * at + 1u, 2u * u.picture));
}

// Colour at a place between views; `step` counts 256ths of a view from the left end of view 0.
fn between(step: u32, at: vec2<u32>) -> vec3<f32> {
    if step >= u.black {
        return vec3<f32>(0.0);
    }
    // The middle of the step, in views from the middle of view 0.
    let place = (f32(step) + 0.5) / FINE - 0.5;
    if u.filtered == 1u {
        let low = floor(place);
        return encoded(mix(light(i32(low), at), light(i32(low) + 1, at), place - low));
    }
    let middle = floor(place + 0.5);
    var sum = vec3<f32>(0.0);
    var weights = 0.0;
    for (var i = -1; i <= 1; i++) {
        let distance = (middle + f32(i) - place) / SIGMA;
        let weight = exp(-0.5 * distance * distance);
        sum += weight * light(i32(middle) + i, at);
        weights += weight;
    }
    return encoded(sum / weights);
}

@fragment
fn interleave(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = top_down(position);
    let views = mask(at);
    if u.filtered != 0u {
        return vec4<f32>(between(views.r, at).r, between(views.g, at).g, between(views.b, at).b, 1.0);
    }
    let red = channel(views.r, at);
    // Masks of whole pixels name one view three times.
    if all(views.gb == views.rr) {
        return vec4<f32>(red, 1.0);
    }
    return vec4<f32>(red.r, channel(views.g, at).g, channel(views.b, at).b, 1.0);
}
