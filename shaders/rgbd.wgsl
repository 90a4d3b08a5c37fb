// The program's own view in the left half, and its nearness as grey in the right half; see src/interleave/depth.rs.

// Depths, fetched as one value. The own view lies in slot 0: at the origin of layer 0.
@group(0) @binding(2) var depth_texture: texture_2d_array<f32>;

// Grey of the pixel that contains the place num/den across the tile.
fn grey(num: vec2<u32>, den: vec2<u32>) -> f32 {
    let at = num * u.tile / den;
    let y = texel_row(u.tile.y - 1u - at.y, u.tile.y);
    let d = textureLoad(depth_texture, vec2<i32>(vec2<u32>(at.x, y)), 0, 0).r;
    let near = u.depth.x;
    let far = u.depth.y;
    if near == far {
        return select(0.0, 1.0, d == near && d > 0.0 && d < 1.0);
    }
    return clamp((d - far) / (near - far), 0.0, 1.0);
}

// The value to write for a grey. A window that encodes to sRGB gets the linear light that becomes this grey.
fn stored(grey: f32) -> f32 {
    let low = grey / 12.92;
    let high = pow((grey + 0.055) / 1.055, 2.4);
    return select(grey, select(high, low, grey <= 0.04045), u.linear != 0u);
}

@fragment
fn rgbd(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = top_down(position);
    let wide = 2u * u.picture.x;
    let centre = 2u * (2u * at.x + 1u);
    let y = 2u * at.y + 1u;
    if centre < wide {
        return vec4<f32>(colour(middle(), vec2<u32>(centre, y), vec2<u32>(wide, 2u * u.picture.y)), 1.0);
    }
    return vec4<f32>(vec3<f32>(stored(grey(vec2<u32>(centre - wide, y), vec2<u32>(wide, 2u * u.picture.y)))), 1.0);
}
