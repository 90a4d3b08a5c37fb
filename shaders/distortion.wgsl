// The distortion map of an occlusion camera whose rays are distorted along rows; src/synthesis/rows.rs is its reference.

// For each block of a row, one bit for each sample on whose left side there is a depth discontinuity: steps down in r, steps up in g.
@group(0) @binding(5) var steps_texture: texture_2d_array<f32>;
// For each block of a row: whether one of its samples can lie in a splat.
@group(0) @binding(6) var splats_texture: texture_2d_array<f32>;

// Disparity, where pixels on which nothing was drawn count as infinitely far.
fn solid(x: i32, row: i32) -> f32 {
    return max(disparity(x, row), 0.0);
}

@fragment
fn steps(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let block = texel_at(position);
    let width = i32(u.tile.x);
    let first = block.x * BLOCK;
    let end = min(first + BLOCK, width);
    // Disparities of the two samples before, and of this one.
    var two = solid(max(first - 2, 0), block.y);
    var one = solid(max(first - 1, 0), block.y);
    var here = solid(first, block.y);
    var bits = vec2<f32>(0.0, 0.0);
    var bit = 1.0;
    for (var x = first; x < end; x++) {
        let next = solid(min(x + 1, width - 1), block.y);
        let own = here - one;
        let before = select(abs(own - (one - two)), 1.0e9, x < 2);
        let after = select(abs(own - (next - here)), 1.0e9, x + 1 >= width);
        var excess = min(before, after);
        excess = select(excess, abs(own), x < 2 && x + 1 >= width);
        let torn = x > 0 && excess * u.aim.w > 1.0;
        bits += select(vec2<f32>(0.0, 0.0), select(vec2<f32>(0.0, bit), vec2<f32>(bit, 0.0), own < 0.0), torn);
        bit *= 2.0;
        two = one;
        one = here;
        here = next;
    }
    return vec4<f32>(bits, 0.0, 0.0);
}

fn step_bits(block: i32, row: i32) -> vec2<u32> {
    let last = (i32(u.tile.x) - 1) / BLOCK;
    let bits = textureLoad(steps_texture, vec2<i32>(clamp(block, 0, last), row), 0, 0).rg;
    return select(vec2<u32>(bits), vec2<u32>(0u, 0u), block < 0 || block > last);
}

// All bits of a block.
const ALL = 0xFFFFu;

// Index of the highest bit that is set.
fn highest(bits: u32) -> i32 {
    let of_16 = select(0u, 8u, bits > 0xFFu);
    let of_8 = of_16 + select(0u, 4u, (bits >> of_16) > 0xFu);
    let of_4 = of_8 + select(0u, 2u, (bits >> of_8) > 3u);
    return i32(of_4 + select(0u, 1u, (bits >> of_4) > 1u));
}

// The first sample from `start` on, in the direction `along` and before `end`, with a wanted discontinuity on its left side; `end` if there is none.
fn first_step(start: i32, end: i32, along: i32, down: bool, up: bool, row: i32) -> i32 {
    var block = start >> 4u;
    let within = u32(start & (BLOCK - 1));
    // Samples of the first block that lie before the start are left out.
    var kept = select(ALL << within, (2u << within) - 1u, along < 0);
    var at = end;
    loop {
        let both = step_bits(block, row);
        let bits = kept & (select(0u, both.x, down) | select(0u, both.y, up));
        kept = ALL;
        if bits != 0u {
            at = block * BLOCK + highest(select(bits & (~bits + 1u), bits, along < 0));
        }
        block += along;
        // The nearest sample of the next block.
        let begin = block * BLOCK + select(0, BLOCK - 1, along < 0);
        if bits != 0u || (end - begin) * along <= 0 {
            break;
        }
    }
    return select(end, at, (end - at) * along > 0);
}

// For each block: nonzero where there are discontinuities within the reach of splats.
@fragment
fn splats(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = texel_at(position);
    let blocks = i32(ceil(u.occlusion.x / f32(BLOCK)));
    var any = vec2<u32>(0u, 0u);
    for (var x = at.x - blocks; x <= at.x + blocks; x++) {
        any |= step_bits(x, at.y);
    }
    return vec4<f32>(f32(any.x | any.y), 0.0, 0.0, 0.0);
}

// Factor of the asymmetry's logarithm, greater than any distance, so that one number holds both.
const LEVEL = 128.0;

// The splat of each two samples. x: pixels from their middle to the right to the discontinuity, plus LEVEL · log2 of the asymmetry. y: radius,
// below 0 where the background lies to the left. z, w: the disparities in front and behind, between which the splat distorts. All are 0 where there
// is no splat.
@fragment
fn distortion_map(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = texel_at(position);
    let row = at.y;
    // Steps lie on the left sides of samples.
    let middle = 2 * at.x + 1;
    if textureLoad(splats_texture, vec2<i32>(2 * at.x / BLOCK, row), 0, 0).r == 0.0 {
        return vec4<f32>(0.0, 0.0, 0.0, 0.0);
    }
    let reach = i32(ceil(u.occlusion.x));
    let left = first_step(middle, middle - reach - 1, -1, true, true, row);
    let right = first_step(middle + 1, middle + reach + 1, 1, true, true, row);
    let nearest = select(left, right, right - middle < middle - left);
    if abs(nearest - middle) > reach {
        return vec4<f32>(0.0, 0.0, 0.0, 0.0);
    }
    let before = solid(nearest - 1, row);
    let after = solid(nearest, row);
    let down = before > after;
    let near = max(before, after);
    let far = min(before, after);
    // The nearest discontinuities that distort in the other direction: behind the occluder, and on the side of the background.
    let side = select(-1, 1, down);
    let wide = i32(ceil(2.0 * u.occlusion.x)) + 1;
    let hidden = first_step(nearest - side, nearest - side * wide, -side, !down, down, row);
    let open = first_step(nearest + side, nearest + side * wide, side, !down, down, row);
    let wanted = min(min(u.occlusion.x, u.aim.w * (near - far) + 1.0), 0.5 * f32(abs(hidden - nearest)));
    let room = 0.5 * f32(abs(open - nearest));
    let level = select(select(2.0, 1.0, wanted <= 2.0 * room), 0.0, wanted <= room);
    let radius = min(wanted, room * exp2(level));
    return vec4<f32>(f32(nearest - middle) + LEVEL * level, radius * f32(side), near, far);
}
