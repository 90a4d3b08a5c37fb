// A copy texel by texel, with which the cost of other passes is compared. A pass is cover.wgsl, then this file.

@group(0) @binding(0) var picture: texture_2d<f32>;

@fragment
fn copied(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    return textureLoad(picture, vec2<i32>(position.xy), 0);
}
