// The mask: what each subpixel shows. The texture holds one period.

// Row 0 is the top row. Values are views, steps between views, or tile addresses; `u.black` and above is black.
@group(0) @binding(1) var mask_texture: texture_2d<u32>;

// Values for the pixel in a column from the left and a row from the top. In floats: integers would be divided one at a time. The
// remainders are exact: (x + 1/2) / period is at least 1 / (2 · period) away from any integer, and floats are off by less than
// 2^-21 · x / period, which for x up to 32768 is 1 / (64 · period).
fn mask(at: vec2<u32>) -> vec3<u32> {
    let place = vec2<f32>(at);
    let period = vec2<f32>(u.period);
    let within = place - period * floor((place + 0.5) / period);
    return textureLoad(mask_texture, vec2<i32>(within), 0).rgb;
}
