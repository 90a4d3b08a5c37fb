// The first and the last view for coloured glasses: two matrices on linear light.

@fragment
fn anaglyph(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = 2u * top_down(position) + 1u;
    let left = linear(colour(0u, at, 2u * u.picture));
    let right = linear(colour(u.views - 1u, at, 2u * u.picture));
    let light = vec3<f32>(
        dot(u.left_red.rgb, left) + dot(u.right_red.rgb, right),
        dot(u.left_green.rgb, left) + dot(u.right_green.rgb, right),
        dot(u.left_blue.rgb, left) + dot(u.right_blue.rgb, right),
    );
    return vec4<f32>(encoded(clamp(light, vec3<f32>(0.0), vec3<f32>(1.0))), 1.0);
}
