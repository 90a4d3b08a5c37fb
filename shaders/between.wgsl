// Views between several drawn ones: the nearest drawn view is the source, and its disocclusions are looked for in the nearest one on the other side.

// Beyond all views.
const NO_VIEW = 1.0e9;

fn source(i: i32) -> f32 {
    return select(u.sources_low[i & 3], u.sources_high[i & 3], i > 3);
}

fn up_to(view: f32) -> i32 {
    let one = vec4<f32>(1.0);
    let none = vec4<f32>(0.0);
    let low = select(none, one, u.sources_low <= vec4<f32>(view));
    let high = select(none, one, u.sources_high <= vec4<f32>(view));
    return i32(dot(low, one) + dot(high, one));
}

// Indices of the nearest drawn view and of the nearest one on the other side of `view`; where there is none, of the next one beyond the first.
// As Sources::pair in src/interleave/sources.rs.
fn pair(view: f32) -> vec2<i32> {
    let count = up_to(0.5 * NO_VIEW);
    let right = up_to(view);
    if right == 0 {
        return vec2<i32>(0, min(1, count - 1));
    }
    if right == count {
        return vec2<i32>(count - 1, max(count - 2, 0));
    }
    let left = right - 1;
    let both = vec2<i32>(left, right);
    return select(both, both.yx, source(right) - view < view - source(left));
}

// Makes a drawn view the picture that is read from now on, and returns the baseline of `view` from it.
fn enter(i: i32, view: f32) -> f32 {
    let at = source(i);
    let s = slot(u32(at));
    let layer = u32((f32(s) + 0.5) / f32(u.columns));
    let left = (s - layer * u.columns) * u.stride;
    // Copies lie in one layer each.
    picture = Place(i32(left), i32(layer), i);
    if u.occlusion.y > 0.0 {
        picture = Place(0, i, i);
    }
    return (view - at) * u.baseline.y;
}

fn see(view: f32, x: f32, row: i32, range: vec2<f32>) -> Seen {
    let both = pair(view);
    var i = both.x;
    var seen = Seen(0, 0, 0.0, true, false, -1);
    var deepest = 1.0e9;
    var held = picture;
    // The second pass is for holes only. The loop tests at its end: with a test at the beginning, llvmpipe runs one more pass to find that it is
    // over.
    loop {
        let baseline = enter(i, view);
        let other = seek(x, row, baseline, range_of(u32(x), row));
        // Of two holes, the deeper sample is the background.
        let deep = disparity(other.low, row);
        let better = !other.hole || deep < deepest;
        if better {
            seen = other;
            held = picture;
            deepest = deep;
        }
        let over = !seen.hole || i == both.y;
        i = both.y;
        if over {
            break;
        }
    }
    picture = held;
    return seen;
}

fn sample_at(x: i32, row: i32, behind: bool) -> vec3<f32> {
    return textureLoad(views_texture, vec2<i32>(picture.left + x, row), picture.layer, 0).rgb;
}

fn sample_depth(x: i32, row: i32, behind: bool) -> f32 {
    return depth_at(x, row);
}
