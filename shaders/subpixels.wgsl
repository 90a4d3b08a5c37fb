// The picture of a panel from one of three times its width, whose pixels are the subpixels (shaders/points.wgsl).

// Red holds the colour of each subpixel.
@group(0) @binding(0) var subpixels: texture_2d<f32>;

@fragment
fn join_subpixels(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = vec2<i32>(position.xy);
    let red = textureLoad(subpixels, vec2<i32>(3 * at.x, at.y), 0).r;
    let green = textureLoad(subpixels, vec2<i32>(3 * at.x + 1, at.y), 0).r;
    let blue = textureLoad(subpixels, vec2<i32>(3 * at.x + 2, at.y), 0).r;
    return vec4<f32>(red, green, blue, 1.0);
}
