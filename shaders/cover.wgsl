// One triangle that covers the window, without vertex attributes.
@vertex
fn cover(@builtin(vertex_index) i: u32) -> @builtin(position) vec4<f32> {
    let corner = vec2<f32>(vec2<u32>((i << 1u) & 2u, i & 2u));
    return vec4<f32>(corner * 2.0 - 1.0, 0.0, 1.0);
}
