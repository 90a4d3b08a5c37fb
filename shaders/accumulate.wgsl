// glAccum: one entry point for each step. A pass is cover.wgsl, then this file.
//
// The arithmetic is that of Mesa's accumulation buffer (measured, and described in src/accumulation): 16-bit integers, of
// which 32767 stands for 1; fractions are cut off, and overflow wraps. Everything happens texel by texel, so the rows of all
// textures run the same way and nothing is flipped.

struct Uniforms {
    // The largest value of each channel of the colour buffer; 0 where it is floating point or has no such channel.
    steps: vec4<f32>,
    // 1 / steps.
    unit: vec4<f32>,
    // Four values for `fill`, else one in x.
    value: vec4<f32>,
    // Layer of the colours.
    layer: u32,
    // Layer of the accumulated values before this step.
    before: u32,
    // Red, green and blue of the colour buffer are sRGB, and go through the table. 1: their texture gives them as they are
    // stored, 2: decoded. They are drawn as they are stored.
    srgb: u32,
}

var<immediate> u: Uniforms;

@group(0) @binding(0) var colours: texture_2d_array<f32>;
@group(0) @binding(1) var accumulated: texture_2d_array<i32>;
// Only for sRGB. One row of 256 stored colours, each with its accumulated value; or all accumulated values, 256 to a row, each with its stored
// colour.
@group(0) @binding(2) var table: texture_2d<i32>;

fn wrapped(v: vec4<i32>) -> vec4<i32> {
    return (v << vec4<u32>(16u)) >> vec4<u32>(16u);
}

// Conversion to a 16-bit integer as a CPU does it: a value that fits no 32-bit integer becomes one whose lower half is 0.
fn short(v: vec4<f32>) -> vec4<i32> {
    let fits = abs(v) < vec4<f32>(2147483648.0);
    return wrapped(vec4<i32>(select(vec4<f32>(0.0), v, fits)));
}

fn encoded(c: vec3<f32>) -> vec3<f32> {
    return select(1.055 * pow(c, vec3<f32>(1.0 / 2.4)) - 0.055, c * 12.92, c <= vec3<f32>(0.0031308));
}

fn looked_up(x: i32, y: i32) -> i32 {
    return textureLoad(table, vec2<i32>(x, y), 0).r;
}

// The colour of this texel as an accumulated value.
fn taken(position: vec4<f32>) -> vec4<i32> {
    let c = textureLoad(colours, vec2<i32>(position.xy), i32(u.layer), 0);
    // The exact multiple of a unit that the fetched colour stands for.
    let exact = select(round(c * u.steps) * u.unit, c, u.steps == vec4<f32>(0.0));
    let plain = short(exact * u.value.x);
    if u.srgb == 0u {
        return plain;
    }
    var stored = c.rgb;
    if u.srgb == 2u {
        stored = encoded(c.rgb);
    }
    let at = vec3<i32>(round(stored * 255.0));
    return vec4<i32>(looked_up(at.r, 0), looked_up(at.g, 0), looked_up(at.b, 0), plain.a);
}

// The stored colour for an accumulated value, by the table.
fn stored(v: i32) -> f32 {
    let at = v + 32768;
    return f32(looked_up(at & 255, at >> 8u)) / 255.0;
}

fn before(position: vec4<f32>) -> vec4<i32> {
    return textureLoad(accumulated, vec2<i32>(position.xy), i32(u.before), 0);
}

@fragment
fn fill() -> @location(0) vec4<i32> {
    return vec4<i32>(u.value);
}

@fragment
fn copy(@builtin(position) position: vec4<f32>) -> @location(0) vec4<i32> {
    return before(position);
}

@fragment
fn load(@builtin(position) position: vec4<f32>) -> @location(0) vec4<i32> {
    return taken(position);
}

@fragment
fn accumulate(@builtin(position) position: vec4<f32>) -> @location(0) vec4<i32> {
    return wrapped(before(position) + taken(position));
}

@fragment
fn multiply(@builtin(position) position: vec4<f32>) -> @location(0) vec4<i32> {
    return short(vec4<f32>(before(position)) * u.value.x);
}

@fragment
fn add(@builtin(position) position: vec4<f32>) -> @location(0) vec4<i32> {
    return wrapped(before(position) + i32(u.value.x));
}

@fragment
fn give_back(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let b = before(position);
    let v = vec4<f32>(b) * u.value.x;
    // Rounding happens here, so that none is left to the driver.
    let rounded = round(clamp(v, vec4<f32>(0.0), vec4<f32>(1.0)) * u.steps) * u.unit;
    let c = select(rounded, v, u.steps == vec4<f32>(0.0));
    if u.srgb == 0u {
        return c;
    }
    return vec4<f32>(stored(b.r), stored(b.g), stored(b.b), c.a);
}
