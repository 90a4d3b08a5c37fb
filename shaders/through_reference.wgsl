// As through.wgsl, with the reference image of an occlusion camera. Most subpixels do not need it, so a loop asks it only for those that do, one
// after another. Otherwise a CPU would ask it for all three colours of each pixel.

@fragment
fn panel_subpixels_reference(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = top_down(position);
    let row = i32(texel_row(u.tile.y - 1u - at.y, u.tile.y));
    let x = f32(at.x) + 0.5;
    let views = mask(at);
    let range = range_of(at.x, row);
    let baselines = u.baseline.x + vec3<f32>(views) * u.baseline.y;
    let red = seek(x, row, baselines.r, range);
    let green = seek(x, row, baselines.g, range);
    let blue = seek(x, row, baselines.b, range);
    var colour = vec3<f32>(colour_of(red, row).r, colour_of(green, row).g, colour_of(blue, row).b);
    var holes = vec3<bool>(red.hole, green.hole, blue.hole);
    loop {
        var seen = blue;
        var baseline = baselines.b;
        var asks = vec3<bool>(false, false, holes.b);
        if holes.g {
            seen = green;
            baseline = baselines.g;
            asks = vec3<bool>(false, true, false);
        }
        if holes.r {
            seen = red;
            baseline = baselines.r;
            asks = vec3<bool>(true, false, false);
        }
        colour = select(colour, colour_of(look_behind(seen, x, row, baseline), row), asks);
        holes = holes & !asks;
        if !any(holes) {
            break;
        }
    }
    return vec4<f32>(select(colour, vec3<f32>(0.0), views >= vec3<u32>(u.views)), 1.0);
}
