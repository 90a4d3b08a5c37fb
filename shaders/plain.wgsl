// Of what is hidden in a picture with depths nothing is known.

fn look_behind(seen: Seen, x: f32, row: i32, t: f32) -> Seen {
    return seen;
}

fn sample_at(x: i32, row: i32, behind: bool) -> vec3<f32> {
    return textureLoad(views_texture, vec2<i32>(x, row), 0, 0).rgb;
}

fn sample_depth(x: i32, row: i32, behind: bool) -> f32 {
    return depth_at(x, row);
}
