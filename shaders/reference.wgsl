// Synthesis from a depth image and a reference image: disocclusions are looked for in the latter, whose camera has rays that reach behind occluders.

@group(0) @binding(6) var reference_texture: texture_2d_array<f32>;
@group(0) @binding(7) var reference_depth_texture: texture_2d_array<f32>;
// The distortion map, of distortion.wgsl.
@group(0) @binding(5) var map_texture: texture_2d_array<f32>;
// Pixels to the right by which the distortion has moved each sample.
@group(0) @binding(8) var moved_texture: texture_2d_array<f32>;

// Factor of the asymmetry's logarithm in the map.
const LEVEL = 128.0;
// Pixels by which an occluder may have moved since the frame whose depths gave the distortion map.
const SLACK = 4;

fn sample_at(x: i32, row: i32, behind: bool) -> vec3<f32> {
    var colour = textureLoad(views_texture, vec2<i32>(x, row), 0, 0).rgb;
    if behind {
        colour = textureLoad(reference_texture, vec2<i32>(x, row), 0, 0).rgb;
    }
    return colour;
}

fn reference_depth(x: i32, row: i32) -> f32 {
    return textureLoad(reference_depth_texture, vec2<i32>(x, row), 0, 0).r;
}

fn sample_depth(x: i32, row: i32, behind: bool) -> f32 {
    var depth = depth_at(x, row);
    if behind {
        depth = reference_depth(x, row);
    }
    return depth;
}

fn see(view: f32, x: f32, row: i32, range: vec2<f32>) -> Seen {
    let baseline = u.baseline.x + view * u.baseline.y;
    return look_behind(seek(x, row, baseline, range), x, row, baseline);
}

// Follows the hidden samples of the reference image from the occluder outwards. They lie side by side up to its edge, and the one farthest behind it
// lies closest to the edge. Of the places where the ray meets their surface, it meets the outermost first, so the last one found counts.
fn look_behind(seen: Seen, x: f32, row: i32, t: f32) -> Seen {
    let width = i32(u.tile.x);
    let edge = 0.5 / max(abs(t), 1e-6);
    let along = select(1, -1, t > 0.0);
    let splat = textureLoad(map_texture, vec2<i32>(max(seen.last, 0) / 2, row), 0, 0);
    // Hidden samples have about the disparity of the background that is seen.
    let low = mix(splat.w, splat.z, 0.25);
    var best = seen;
    var k = seen.last + along * SLACK;
    // Samples that are left to the end of the splat.
    let level = floor(splat.x / LEVEL + 0.5);
    var left = i32(ceil(abs(splat.y) * exp2(-level))) + 2 * SLACK;
    var open = seen.hole && seen.last >= 0 && splat.y != 0.0;
    var known = false;
    var before = vec3<f32>(0.0, 0.0, 0.0);
    var slope = 0.0;
    if open {
        loop {
            let at = clamp(k, 0, width - 1);
            let depth = reference_depth(at, row);
            let moved = textureLoad(moved_texture, vec2<i32>(at, row), 0, 0).r;
            let there = f32(at) + 0.5 - moved;
            let disparity = disparity_of(depth);
            let above = (there - x) / t + u.disparity.z - disparity;
            let drawn = !is_clear(depth);
            // Samples lie closer together in the reference image than their undistorted places.
            let step = disparity - before.y;
            let apart = edge * max(abs(there - before.x), 1.0);
            let joined = drawn && known && min(abs(step), abs(step - slope)) <= apart;
            if joined && above > 0.0 && before.z <= 0.0 {
                best = Seen(at, at + along, above / (above - before.z), false, true, -1);
            } else if !best.behind && drawn && moved != 0.0 && above > 0.0 && disparity < low {
                // The hidden sample farthest behind the occluder stands in for all that lies deeper. It remains a hole.
                best = Seen(at, at, 0.0, true, true, -1);
            }
            slope = select(0.0, step, known);
            before = vec3<f32>(there, disparity, above);
            known = drawn;
            left -= 1;
            if left <= 0 || at != k {
                break;
            }
            k -= along;
        }
    }
    return best;
}
