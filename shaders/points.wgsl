// Splats, drawn once for all views: a quad for each that holds the disk in every view, and for each subpixel the ray of its own view. The mathematics are those
// of src/splat, where each step has its reference: `cover` in src/splat/cover.rs, `Parameters` in src/splat/disk.rs.

struct Uniforms {
    // Size of the picture in pixels.
    picture: vec2<u32>,
    // Columns and rows after which the mask repeats.
    period: vec2<u32>,
    // Splats in a row of their texture.
    row: u32,
    // Value of the mask at black subpixels.
    black: u32,
    // N.
    views: u32,
    // The view that is drawn, where it is one alone.
    view: u32,
    // x: distance of neighbouring cameras. y: depth of the screen. z: depth of the near plane. w: half of the width of the screen.
    eyes: vec4<f32>,
    // x, y: by how much a quad is larger than the disk, in pixels of the picture. w: the first splat that is drawn.
    margin: vec4<f32>,
}

var<immediate> u: Uniforms;

// Three texels for each splat: centre and radius; normal; colour.
@group(0) @binding(0) var splats: texture_2d<f32>;

struct Corner {
    @builtin(position) position: vec4<f32>,
    // (r·D, s·D, D) for the lower left corner of the picture and view 0; n·(p − vp) for view 0.
    @location(0) @interpolate(flat) base: vec4<f32>,
    // Per pixel to the right. And n·(p − vp) per view.
    @location(1) @interpolate(flat) x: vec4<f32>,
    // Per pixel upwards. And the colour: red, green and blue in this one and the next two.
    @location(2) @interpolate(flat) y: vec4<f32>,
    // Per view.
    @location(3) @interpolate(flat) view: vec4<f32>,
    // Per view and pixel upwards.
    @location(4) @interpolate(flat) both: vec4<f32>,
}

// The least and the largest slope of lines from the eye to a disk before it.
fn slopes(p: f32, z: f32, n: f32, nz: f32, r: f32) -> vec2<f32> {
    let a = z * z - r * r * (1.0 - nz * nz);
    let b = p * z + r * r * n * nz;
    let aside = z * n - p * nz;
    let root = r * sqrt(max(z * z + p * p - aside * aside - r * r * (1.0 - n * n - nz * nz), 0.0));
    return vec2<f32>(b - root, b + root) / a;
}

// r·D or s·D per one, x, y, offset and y·offset (`Parameters`).
struct Axis {
    base: f32,
    x: f32,
    y: f32,
    offset: f32,
    both: f32,
}

fn along(axis: vec3<f32>, p: vec3<f32>, n: vec3<f32>, radius: f32) -> Axis {
    let focal = u.eyes.y;
    let start = -dot(p, axis);
    let plane = dot(n, p);
    return Axis(
        (n.z * focal * start + plane * axis.z * focal) / radius,
        (n.x * start + plane * axis.x) / radius,
        (n.y * start + plane * axis.y) / radius,
        (n.z * focal * axis.x - n.x * start - plane * axis.x - n.x * axis.z * focal) / radius,
        (n.y * axis.x - n.x * axis.y) / radius,
    );
}

struct Splat {
    p: vec3<f32>,
    radius: f32,
    n: vec3<f32>,
    colour: vec3<f32>,
}

fn splat_of(index: u32) -> Splat {
    let number = index / 3u + u32(u.margin.w);
    let at = vec2<i32>(i32(number % u.row) * 3, i32(number / u.row));
    let place = textureLoad(splats, at, 0);
    let n = textureLoad(splats, at + vec2<i32>(1, 0), 0).xyz;
    let colour = textureLoad(splats, at + vec2<i32>(2, 0), 0).rgb;
    return Splat(place.xyz, place.w, n, colour);
}

fn half_screen() -> vec2<f32> {
    return vec2<f32>(u.eyes.w, u.eyes.w * f32(u.picture.y) / f32(u.picture.x));
}

// A corner of the quad that holds a splat in all views.
fn corner_of(splat: Splat, index: u32) -> vec4<f32> {
    let p = splat.p;
    let n = splat.n;
    let radius = splat.radius;
    let focal = u.eyes.y;
    let half = half_screen();
    let end = 0.5 * f32(u.views - 1u) * abs(u.eyes.x);
    let tilt = radius * length(n.xy);
    var low = vec2<f32>(-1.0);
    var high = vec2<f32>(1.0);
    if p.z - tilt >= u.eyes.z {
        let left = slopes(p.x + end, p.z, n.x, n.z, radius) * focal - end;
        let right = slopes(p.x - end, p.z, n.x, n.z, radius) * focal + end;
        let up = slopes(p.y, p.z, n.y, n.z, radius) * focal;
        let margin = 2.0 * u.margin.xy / vec2<f32>(u.picture);
        low = max(vec2<f32>(min(left.x, right.x), up.x) / half - margin, low);
        high = min(vec2<f32>(max(left.y, right.y), up.y) / half + margin, high);
    }
    // A triangle that holds the quad: for splats of a few pixels its vertices cost more than its pixels.
    let which = index % 3u;
    high = select(low, low + 2.0 * (high - low), high > low);
    let is_right = which == 1u;
    let is_upper = which == 2u;
    if p.z + tilt < u.eyes.z || low.x >= high.x || low.y >= high.y {
        // Outside of the picture.
        return vec4<f32>(2.0, 2.0, 0.0, 1.0);
    }
    return vec4<f32>(select(low.x, high.x, is_right), select(low.y, high.y, is_upper), 0.0, 1.0);
}

@vertex
fn corner(@builtin(vertex_index) index: u32) -> Corner {
    return corner_at(index);
}

fn corner_at(index: u32) -> Corner {
    let splat = splat_of(index);
    let p = splat.p;
    let n = splat.n;
    let radius = splat.radius;
    let colour = splat.colour;
    let focal = u.eyes.y;
    let half = half_screen();
    var out: Corner;
    out.position = corner_of(splat, index);

    // Its plane (Equation 3).
    let across = select(vec3<f32>(-n.z, 0.0, n.x), vec3<f32>(0.0, -n.z, n.y), length(n.yz) >= 0.5);
    let axis = normalize(across);
    let r = along(axis, p, n, radius);
    let s = along(cross(n, axis), p, n, radius);
    // In pixels and views, so that a fragment has the least to do.
    let pixel = 2.0 * half.x / f32(u.picture.x);
    let step = u.eyes.x;
    let first = -0.5 * f32(u.views - 1u) * step;
    let both = vec3<f32>(r.both, s.both, 0.0);
    let x = vec3<f32>(r.x, s.x, n.x);
    let y = vec3<f32>(r.y, s.y, n.y) + both * first;
    let offset = vec3<f32>(r.offset, s.offset, -n.x);
    let base = vec3<f32>(r.base, s.base, n.z * focal) + offset * first - x * half.x - y * half.y;
    out.base = vec4<f32>(base, dot(n, p) - n.x * first);
    out.x = vec4<f32>(x * pixel, -n.x * step);
    out.y = vec4<f32>(y * pixel, colour.r);
    out.view = vec4<f32>((offset - both * half.y) * step, colour.g);
    out.both = vec4<f32>(both * pixel * step, colour.b);
    return out;
}

// (r·D, s·D, D) for the middle of a pixel and a view.
fn parameters(c: Corner, middle: vec2<f32>, view: f32) -> vec3<f32> {
    return c.base.xyz + c.x.xyz * middle.x + c.y.xyz * middle.y + (c.view.xyz + c.both.xyz * middle.y) * view;
}

fn colour_of(c: Corner) -> vec3<f32> {
    return vec3<f32>(c.y.w, c.view.w, c.both.w);
}

// 1 − near/depth where the ray of a view through the middle of a pixel meets the disk; below 0 where it does not.
fn depth(c: Corner, view: u32, middle: vec2<f32>) -> f32 {
    let i = f32(view);
    let at = parameters(c, middle, i);
    let ahead = u.eyes.y * (c.base.w + c.x.w * i) * sign(at.z);
    let near = u.eyes.z * abs(at.z);
    let meets = dot(at.xy, at.xy) <= at.z * at.z && ahead >= near && near > 0.0;
    return select(-1.0, 1.0 - near / ahead, meets);
}

struct Seen {
    @location(0) colour: vec4<f32>,
    @builtin(frag_depth) depth: f32,
}

// A picture of three times the width, whose pixels are the subpixels of the panel: red holds the colour of each.
@fragment
fn points_subpixels(c: Corner) -> Seen {
    let at = vec2<u32>(c.position.xy);
    let x = floor(c.position.x / 3.0);
    let channel = at.x - 3u * u32(x);
    let view = mask(vec2<u32>(u32(x), u.picture.y - 1u - at.y))[channel];
    let depth = depth(c, view, vec2<f32>(x + 0.5, c.position.y));
    if view >= u.black || depth < 0.0 {
        discard;
    }
    let colour = colour_of(c);
    return Seen(vec4<f32>(colour[channel]), depth);
}

// A picture whose pixels each show one view.
@fragment
fn points_pixels(c: Corner) -> Seen {
    let at = vec2<u32>(c.position.xy);
    let view = mask(vec2<u32>(at.x, u.picture.y - 1u - at.y)).r;
    let depth = depth(c, view, c.position.xy);
    if view >= u.black || depth < 0.0 {
        discard;
    }
    return Seen(vec4<f32>(colour_of(c), 1.0), depth);
}

// One view alone.
@fragment
fn points_view(c: Corner) -> Seen {
    let depth = depth(c, u.view, c.position.xy);
    if depth < 0.0 {
        discard;
    }
    return Seen(vec4<f32>(colour_of(c), 1.0), depth);
}
