// Splats that overlap become one surface by deferred blending in 1 + 1 passes (Hübner et al., sections 4.2 to 4.4): an image for each group of splats that do not overlap, and
// then their mean by weights. The images of our own way hold the subpixels of the panel; those of the paper's two ways hold its pixels, each with what three views see and one depth.
// The reference is `Surface::Deferred` in src/splat/reference.rs.

// Of an image: red is near/z, 0 where nothing is; green the colour, or three of 8 bits; blue the weight, or two of 12 bits; alpha the third weight.

// 1 in the middle of a splat, 0 at its edge, from the square of the distance.
fn kernel(squared: f32) -> f32 {
    let left = max(1.0 - squared, 0.0);
    return max(left * left, 1.0 / 4095.0);
}

fn pack_colours(colour: vec3<f32>) -> f32 {
    let steps = floor(clamp(colour, vec3<f32>(0.0), vec3<f32>(1.0)) * 255.0 + 0.5);
    return steps.r * 65536.0 + steps.g * 256.0 + steps.b;
}

fn pack_weights(weights: vec2<f32>) -> f32 {
    let steps = floor(weights * 4095.0 + 0.5);
    return steps.x * 4096.0 + steps.y;
}

// near/z and the weight where the ray of a view through the middle of a pixel meets the disk; 0 where it does not.
fn met(c: Corner, view: u32, middle: vec2<f32>) -> vec2<f32> {
    let i = f32(view);
    return met_at(parameters(c, middle, i), c.base.w + c.x.w * i);
}

fn met_at(at: vec3<f32>, plane: f32) -> vec2<f32> {
    let ahead = u.eyes.y * plane * sign(at.z);
    let near = u.eyes.z * abs(at.z);
    let meets = dot(at.xy, at.xy) <= at.z * at.z && ahead >= near && near > 0.0;
    let weight = kernel(dot(at.xy, at.xy) / max(at.z * at.z, 1e-30));
    return select(vec2<f32>(0.0), vec2<f32>(near / ahead, weight), meets);
}

@fragment
fn deferred_subpixels(c: Corner) -> Seen {
    let at = vec2<u32>(c.position.xy);
    let x = floor(c.position.x / 3.0);
    let channel = at.x - 3u * u32(x);
    let view = mask(vec2<u32>(u32(x), u.picture.y - 1u - at.y))[channel];
    let seen = met(c, view, vec2<f32>(x + 0.5, c.position.y));
    if view >= u.black || seen.y == 0.0 {
        discard;
    }
    let colour = colour_of(c);
    return Seen(vec4<f32>(seen.x, colour[channel], seen.y, 0.0), 1.0 - seen.x);
}

@fragment
fn deferred_view(c: Corner) -> Seen {
    let seen = met(c, u.view, c.position.xy);
    if seen.y == 0.0 {
        discard;
    }
    return Seen(vec4<f32>(seen.x, pack_colours(colour_of(c)), seen.y, 0.0), 1.0 - seen.x);
}

// A pixel that three views see, with the mean of their depths.
fn pixel_of(seen: array<vec2<f32>, 3>, colour: vec3<f32>) -> Seen {
    let weights = vec3<f32>(seen[0].y, seen[1].y, seen[2].y);
    var depths = 0.0;
    var count = 0.0;
    for (var i = 0; i < 3; i++) {
        if seen[i].y > 0.0 {
            depths += 1.0 / seen[i].x;
            count += 1.0;
        }
    }
    // near/z of the mean of z.
    let near = select(0.0, count / depths, count > 0.0);
    let shown = select(vec3<f32>(0.0), colour, weights > vec3<f32>(0.0));
    return Seen(vec4<f32>(near, pack_colours(shown), pack_weights(weights.xy), weights.z), 1.0 - near);
}

// The splat itself, for rays that are intersected in the fragment.
struct Disk {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat) centre: vec4<f32>,
    @location(1) @interpolate(flat) normal: vec3<f32>,
    @location(2) @interpolate(flat) colour: vec3<f32>,
}

@vertex
fn disk_corner(@builtin(vertex_index) index: u32) -> Disk {
    let splat = splat_of(index);
    return Disk(corner_of(splat, index), vec4<f32>(splat.p, splat.radius), splat.n, splat.colour);
}

// The paper's second way: the ray of each view is intersected with the plane of the splat (Equation 4).
@fragment
fn deferred_rays(d: Disk) -> Seen {
    let at = vec2<u32>(d.position.xy);
    let views = mask(vec2<u32>(at.x, u.picture.y - 1u - at.y));
    let pixel = 2.0 * u.eyes.w / f32(u.picture.x);
    let x = vec3<f32>((d.position.xy - 0.5 * vec2<f32>(u.picture)) * pixel, u.eyes.y);
    var seen: array<vec2<f32>, 3>;
    for (var i = 0; i < 3; i++) {
        let view = views[i];
        let vp = vec3<f32>((f32(view) - 0.5 * f32(u.views - 1u)) * u.eyes.x, 0.0, 0.0);
        let l = dot(d.normal, d.centre.xyz - vp) / dot(d.normal, x - vp);
        let hit = vp + l * (x - vp);
        let away = (hit - d.centre.xyz) / d.centre.w;
        let squared = dot(away, away);
        let meets = squared <= 1.0 && l > 0.0 && hit.z >= u.eyes.z && view < u.black;
        seen[i] = select(vec2<f32>(0.0), vec2<f32>(u.eyes.z / hit.z, kernel(squared)), meets);
    }
    if seen[0].y + seen[1].y + seen[2].y == 0.0 {
        discard;
    }
    return pixel_of(seen, d.colour);
}

// (r·D, s·D, D) of eight views at a corner of the quad, and n·(p − vp) of the first view and per view.
struct Parameters {
    @builtin(position) position: vec4<f32>,
    @location(0) view_0: vec3<f32>,
    @location(1) view_1: vec3<f32>,
    @location(2) view_2: vec3<f32>,
    @location(3) view_3: vec3<f32>,
    @location(4) view_4: vec3<f32>,
    @location(5) view_5: vec3<f32>,
    @location(6) view_6: vec3<f32>,
    @location(7) view_7: vec3<f32>,
    @location(8) @interpolate(flat) colour: vec3<f32>,
    @location(9) @interpolate(flat) plane: vec2<f32>,
}

@vertex
fn parameters_corner(@builtin(vertex_index) index: u32) -> Parameters {
    let c = corner_at(index);
    let middle = (c.position.xy * 0.5 + 0.5) * vec2<f32>(u.picture);
    return Parameters(
        c.position,
        parameters(c, middle, 0.0),
        parameters(c, middle, 1.0),
        parameters(c, middle, 2.0),
        parameters(c, middle, 3.0),
        parameters(c, middle, 4.0),
        parameters(c, middle, 5.0),
        parameters(c, middle, 6.0),
        parameters(c, middle, 7.0),
        colour_of(c),
        vec2<f32>(c.base.w, c.x.w),
    );
}

// The paper's first way: the parameters of each view are interpolated.
@fragment
fn deferred_parameters(p: Parameters) -> Seen {
    let at = vec2<u32>(p.position.xy);
    let views = mask(vec2<u32>(at.x, u.picture.y - 1u - at.y));
    var seen: array<vec2<f32>, 3>;
    for (var i = 0; i < 3; i++) {
        let view = views[i];
        var own = p.view_0;
        switch view {
            case 1u: { own = p.view_1; }
            case 2u: { own = p.view_2; }
            case 3u: { own = p.view_3; }
            case 4u: { own = p.view_4; }
            case 5u: { own = p.view_5; }
            case 6u: { own = p.view_6; }
            case 7u: { own = p.view_7; }
            default: {}
        }
        let met = met_at(own, p.plane.x + p.plane.y * f32(view));
        seen[i] = select(vec2<f32>(0.0), met, view < u.black);
    }
    if seen[0].y + seen[1].y + seen[2].y == 0.0 {
        discard;
    }
    return pixel_of(seen, p.colour);
}
