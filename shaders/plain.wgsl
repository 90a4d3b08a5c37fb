// Synthesis from one depth image without a source of disocclusions: hidden samples are unknown.

fn see(view: f32, x: f32, row: i32, range: vec2<f32>) -> Seen {
    return seek(x, row, u.baseline.x + view * u.baseline.y, range);
}

fn sample_at(x: i32, row: i32, behind: bool) -> vec3<f32> {
    return textureLoad(views_texture, vec2<i32>(x, row), 0, 0).rgb;
}

fn sample_depth(x: i32, row: i32, behind: bool) -> f32 {
    return depth_at(x, row);
}
