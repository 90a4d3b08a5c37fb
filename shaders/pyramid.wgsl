// The disparity pyramid of a depth image: least and greatest disparities of blocks, by which disparity.wgsl skips samples.

fn enter_from_uniforms() {
    picture = Place(i32(u.occlusion.y), i32(u.occlusion.z), i32(u.occlusion.w));
}

// For each block: the greatest and the least disparity.
@fragment
fn block_bounds(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    enter_from_uniforms();
    let block = texel_at(position);
    let end = min((block.x + 1) * BLOCK, i32(u.tile.x));
    var greatest = NOTHING;
    var least = -NOTHING;
    for (var x = block.x * BLOCK; x < end; x++) {
        let here = disparity(x, block.y);
        greatest = max(greatest, here);
        least = min(least, here);
    }
    return vec4<f32>(greatest, least, 0.0, 0.0);
}

fn block(x: i32, row: i32) -> vec2<f32> {
    return textureLoad(block_bounds_texture, vec2<i32>(x, row), picture.layer_of_pyramid, 0).rg;
}

// For each row: the greatest disparity.
@fragment
fn row_maxima(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    enter_from_uniforms();
    let row = texel_at(position).y;
    let last = (i32(u.tile.x) - 1) / BLOCK;
    var top = 0.0;
    for (var x = 0; x <= last; x++) {
        top = max(top, block(x, row).x);
    }
    return vec4<f32>(top, 0.0, 0.0, 0.0);
}

// Distance in blocks at which samples of at most this disparity can still be seen by rays of a block, with the longest baseline. Either an infinitely
// far sample moves farthest, or one with this disparity.
fn reach(disparity: f32) -> f32 {
    return u.aim.w * max(u.disparity.z, disparity - u.disparity.z) / f32(BLOCK) + 1.0;
}

// For each block: the greatest and the least disparity that its rays can meet.
@fragment
fn ray_range(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    enter_from_uniforms();
    let at = texel_at(position);
    let last = (i32(u.tile.x) - 1) / BLOCK;
    let top = textureLoad(ray_range_texture, vec2<i32>(0, at.y), picture.layer_of_pyramid, 0).r;
    let farthest = i32(ceil(min(reach(top), 1.0e4)));
    var both = block(at.x, at.y);
    for (var x = max(at.x - farthest, 0); x <= min(at.x + farthest, last); x++) {
        let other = block(x, at.y);
        if f32(abs(x - at.x)) <= reach(other.x) {
            both = vec2<f32>(max(both.x, other.x), min(both.y, other.y));
        }
    }
    return vec4<f32>(both, 0.0, 0.0);
}
