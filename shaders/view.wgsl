// Synthesises a view into its tile.

// Share of the step from a sample to the next by which depths are moved away.
const SLOPE = 0.25;

struct Made {
    @location(0) colour: vec4<f32>,
    @builtin(frag_depth) depth: f32,
}

// Writes depths for later draws, a little farther than the surface, so that another pass over the same surface lies
// before it.
@fragment
fn view(@builtin(position) position: vec4<f32>) -> Made {
    let at = vec2<u32>(position.xy);
    let row = i32(texel_row(min(at.y, u.tile.y - 1u), u.tile.y));
    let x = position.x - u.aim.y;
    let seen = see(u.aim.x, x, row, range_of(u32(x), row));
    let low = sample_depth(seen.low, row, seen.behind);
    let high = sample_depth(seen.high, row, seen.behind);
    // A curved surface leaves the straight line between two samples.
    let away = u.baseline.w + sign(u.baseline.w) * SLOPE * abs(high - low);
    let moved = clamp(mix(low, high, seen.weight) + away, 0.0, 1.0);
    let depth = select(moved, low, is_clear(low));
    return Made(vec4<f32>(colour_of(seen, row), 1.0), depth);
}
