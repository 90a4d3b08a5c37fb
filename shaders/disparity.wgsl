// A depth image, and how another camera beside its own sees it. The ray of a pixel is followed over a row, from near to far, until it meets the
// surface. The result is that of src/synthesis/warp.rs, which draws the surface instead.
//
// The disparity of a sample is the number of pixels by which it moves, relative to an infinitely far point, for a camera one place to the side. It
// is linear in 1/w, and so in the values of the depth buffer. A camera with the baseline t, in places, sees a sample at x with disparity h at
// x + t · (u.disparity.z − h).

@group(0) @binding(2) var depth_texture: texture_2d_array<f32>;
// For each block of a row: the greatest and the least disparity that its rays can meet. The pass that computes this (ray_range in pyramid.wgsl) has
// the greatest disparity of each row here instead.
@group(0) @binding(3) var ray_range_texture: texture_2d_array<f32>;
// The greatest and the least disparity of each block itself.
@group(0) @binding(4) var block_bounds_texture: texture_2d_array<f32>;

// Where the picture lies that is read: its left edge in pixels and its layer in the textures of colours and depths, and its layer in the two
// textures above.
struct Place {
    left: i32,
    layer: i32,
    layer_of_pyramid: i32,
}

// The view at the origin, unless another one is entered.
var<private> picture: Place = Place(0, 0, 0);

// Samples of a row in one block, which is one texel of those two textures.
const BLOCK = 16;
// Stands for the disparity where nothing was drawn, unless that counts as infinitely far: below everything.
const NOTHING = -1.0e6;
// Stands for the disparity before the first sample of a row: above everything.
const OUTSIDE = 4.0e6;

// The texel that is drawn; these textures have the same order of rows as the views.
fn texel_at(position: vec4<f32>) -> vec2<i32> {
    let at = vec2<u32>(position.xy);
    return vec2<i32>(vec2<u32>(at.x, texel_row(at.y, u.tile.y)));
}

fn depth_at(x: i32, row: i32) -> f32 {
    return textureLoad(depth_texture, vec2<i32>(picture.left + x, row), picture.layer, 0).r;
}

// Whether a depth says that nothing was drawn. Depths of 24 bits come back with the error of one step.
fn is_clear(depth: f32) -> bool {
    return abs(depth - u.disparity.w) < 1e-7;
}

fn disparity_of(depth: f32) -> f32 {
    if is_clear(depth) {
        return u.baseline.z;
    }
    let line = select(u.disparity.xy, u.before.xy, (depth - u.before.z) * u.before.w > 0.0);
    return max(line.x * depth + line.y, 0.0);
}

fn disparity(x: i32, row: i32) -> f32 {
    return disparity_of(depth_at(x, row));
}

// What a ray meets: a point between two samples, or a hole, and then the background of its occluder.
struct Seen {
    low: i32,
    high: i32,
    weight: f32,
    // No sample shows what is there.
    hole: bool,
    // `low` and `high` are hidden samples, from the reference image: see reference.wgsl.
    behind: bool,
    // For a hole, the last sample before the occluder; below 0 where the picture ends.
    last: i32,
}

// The first sample of a row in a direction whose centre lies at or beyond a place.
fn first_beyond(place: f32, along: i32) -> i32 {
    let middle = clamp(place, -1.0e6, 1.0e6) - 0.5;
    return i32(select(ceil(middle), floor(middle), along < 0));
}

// The greatest and the least disparity that any ray of a column can meet.
fn range_of(x: u32, row: i32) -> vec2<f32> {
    return textureLoad(ray_range_texture, vec2<i32>(i32(x) / BLOCK, row), picture.layer_of_pyramid, 0).rg;
}

// What a camera with the baseline t sees at x, in pixels from the left of its picture, in a row of the textures. Few fetches are in branches,
// because llvmpipe executes all branches. Loops test at their ends: with a test at the beginning, llvmpipe runs one more pass to find that a loop
// is over.
fn seek(x: f32, row: i32, t: f32, range: vec2<f32>) -> Seen {
    let width = i32(u.tile.x);
    let own = clamp(i32(floor(x)), 0, width - 1);
    let far = u.disparity.z;
    var seen = Seen(own, own, 0.0, false, false, -1);
    // The ray can meet nothing that was drawn, or the camera is the picture's own.
    if range.x < 0.0 || abs(t) < 1e-6 {
        return seen;
    }
    // Half a pixel of the view, as a disparity: the ray falls by 1/|t| from sample to sample.
    let edge = 0.5 / abs(t);
    let along = select(1, -1, t > 0.0);
    let first = select(0, width - 1, along < 0);
    // The search begins where the ray is above everything that it can meet, and ends where it is below all of that.
    var k = first_beyond(x + t * (range.x + edge - far), along);
    k = select(max(k, first), min(k, first), along < 0);
    var last = first_beyond(x + t * (max(range.y, 0.0) - far), along) + along;
    last = clamp(last, 0, width - 1);
    // Where the ray passes behind an occluder: the last sample before that, and its distance from the ray. The closest one counts.
    var behind = own;
    var behind_away = OUTSIDE;
    var before = OUTSIDE;
    var slope = 0.0;
    var found = false;
    var fresh = true;
    var open = (last - k) * along >= 0;
    if open {
        loop {
            // Skips what lies below the ray, block by block.
            let start = k;
            loop {
                let greatest = textureLoad(block_bounds_texture, vec2<i32>(k / BLOCK, row), picture.layer_of_pyramid, 0).r;
                let in_block = k & (BLOCK - 1);
                let next = select(k - in_block + BLOCK, k - in_block - 1, along < 0);
                let low = first_beyond(x + t * (greatest + edge - far), along);
                let to = select(min(low, next), max(low, next), along < 0);
                let further = (to - k) * along > 0;
                k = select(k, to, further);
                if !further || to != next || (last - k) * along < 0 {
                    break;
                }
            }
            let one = disparity(clamp(k - along, 0, width - 1), row);
            let two = disparity(clamp(k - 2 * along, 0, width - 1), row);
            if fresh || k != start {
                before = select(one, OUTSIDE, k == first);
                slope = select(one - two, 0.0, k == first);
            }
            fresh = false;
            // Goes from sample to sample, to the end of a block.
            open = (last - k) * along >= 0;
            if open {
                loop {
                    let here = disparity(k, row);
                    let ray = (f32(k) + 0.5 - x) / t + far;
                    let above = ray + 2.0 * edge - before;
                    let below = ray - here;
                    // Two samples belong to one surface if the step between them is small in the view, or equals the step before it.
                    let step = here - before;
                    let begins = before == OUTSIDE;
                    let joined = !begins && min(here, before) >= 0.0 && min(abs(step), abs(step - slope)) <= edge;
                    let between = joined && above > 0.0 && below <= 0.0;
                    // Otherwise each surface ends half a pixel beyond its last sample.
                    let ends = !joined && before >= 0.0 && above >= 0.0 && above <= edge;
                    let starts = !joined && here >= 0.0 && below <= 0.0 && below >= -edge;
                    found = between || ends || starts;
                    if found {
                        let at = select(k, k - along, between || ends);
                        seen = Seen(at, select(at, k, between), select(0.0, above / (above - below), between), false, false, -1);
                    }
                    // A sample where nothing was drawn keeps its own place; all others lie where the view sees them.
                    let away = select(above, abs(f32(k - along) + 0.5 - x) / abs(t), before < 0.0);
                    if !begins && above > 0.0 && below < 0.0 && away < behind_away {
                        behind = k - along;
                        behind_away = away;
                    }
                    slope = select(step, 0.0, begins);
                    before = here;
                    k += along;
                    let in_block = k & (BLOCK - 1);
                    open = !found && (last - k) * along >= 0;
                    if !open || in_block == select(0, BLOCK - 1, along < 0) {
                        break;
                    }
                }
            }
            if !open {
                break;
            }
        }
    }
    // At the end of the picture, too, a surface ends half a pixel beyond its last sample.
    let end = k - along;
    let above = (f32(end) + 0.5 - x) / t + far - before;
    let ends = (k < 0 || k >= width) && before >= 0.0 && above >= 0.0 && above <= edge;
    if !found {
        // A pixel on which nothing was drawn is no hole: that lies behind everything and is the same in all views.
        let nothing = u.baseline.z < 0.0 && disparity(own, row) < 0.0;
        let last_one = ends || behind_away == OUTSIDE;
        let at = select(select(behind, clamp(end, 0, width - 1), last_one), own, nothing);
        seen = Seen(at, at, 0.0, !ends && !nothing, false, select(behind, -1, last_one));
    }
    return seen;
}

fn colour_of(seen: Seen, row: i32) -> vec3<f32> {
    let low = sample_at(seen.low, row, seen.behind);
    let high = sample_at(seen.high, row, seen.behind);
    return select(mix(low, high, seen.weight), vec3<f32>(1.0, 0.0, 1.0), seen.hole && u.aim.z > 0.0);
}
