// The second pass of deferred blending (Hübner et al., Figure 13): the images of all groups put together. shaders/deferred.wgsl says what they hold.

struct Uniforms {
    // Images.
    groups: u32,
    // Whether an image holds the subpixels of the panel, those of one view, or pixels that three views see.
    kind: u32,
    // x: depth of the near plane. y: what is so far behind the nearest splat is blended with it.
    depth: vec4<f32>,
}

var<immediate> u: Uniforms;

@group(0) @binding(0) var images: texture_2d_array<f32>;

const SUBPIXELS: u32 = 0u;
const VIEW: u32 = 1u;

fn unpack_colours(packed: f32) -> vec3<f32> {
    let red = floor(packed / 65536.0);
    let green = floor((packed - red * 65536.0) / 256.0);
    return vec3<f32>(red, green, packed - red * 65536.0 - green * 256.0) / 255.0;
}

fn weights(image: vec4<f32>) -> vec3<f32> {
    if u.kind == VIEW {
        return vec3<f32>(image.b);
    }
    let red = floor(image.b / 4096.0);
    return vec3<f32>(vec2<f32>(red, image.b - red * 4096.0) / 4095.0, image.a);
}

// The least near/z that is blended, where this is the greatest.
fn behind(nearest: f32) -> f32 {
    return u.depth.x / (u.depth.x / nearest + u.depth.y);
}

fn subpixel(at: vec2<i32>) -> f32 {
    var nearest = 0.0;
    for (var k = 0; k < i32(u.groups); k++) {
        nearest = max(nearest, textureLoad(images, at, k, 0).r);
    }
    if nearest == 0.0 {
        return 0.0;
    }
    let least = behind(nearest);
    var sum = vec2<f32>(0.0);
    for (var k = 0; k < i32(u.groups); k++) {
        let image = textureLoad(images, at, k, 0);
        if image.r >= least {
            sum += vec2<f32>(image.g, 1.0) * image.b;
        }
    }
    return sum.x / sum.y;
}

fn pixel(at: vec2<i32>) -> vec3<f32> {
    var nearest = 0.0;
    for (var k = 0; k < i32(u.groups); k++) {
        nearest = max(nearest, textureLoad(images, at, k, 0).r);
    }
    if nearest == 0.0 {
        return vec3<f32>(0.0);
    }
    let least = behind(nearest);
    var colours = vec3<f32>(0.0);
    var sum = vec3<f32>(0.0);
    for (var k = 0; k < i32(u.groups); k++) {
        let image = textureLoad(images, at, k, 0);
        if image.r >= least {
            let own = weights(image);
            colours += own * unpack_colours(image.g);
            sum += own;
        }
    }
    return colours / max(sum, vec3<f32>(1e-6));
}

@fragment
fn compose(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = vec2<i32>(position.xy);
    if u.kind == SUBPIXELS {
        let left = vec2<i32>(3 * at.x, at.y);
        let right = vec2<i32>(1, 0);
        return vec4<f32>(subpixel(left), subpixel(left + right), subpixel(left + 2 * right), 1.0);
    }
    return vec4<f32>(pixel(at), 1.0);
}
