#version 330 core
// A corner of the box in which a Gaussian is not too faint (Kerbl et al. 2023, equations 5 and 6; the reference is src/gaussian/reference.rs).

layout(location = 0) in uint number;

uniform mat4 view;
uniform mat4 projection;
// Width and height of the picture in pixels; pixels that a length of one has at a distance of one; depth of the near plane.
uniform vec4 picture;
// A factor of the user's.
uniform float scale;
// Three texels for each: place and opacity; covariance xx, xy, xz, yy; yz, zz.
uniform sampler2D shapes;
uniform sampler2D colours;

flat out vec4 colour;
flat out vec3 conic;
out vec2 away;

const float BLUR = 0.3;
const float LEAST_ALPHA = 1.0 / 255.0;
// Gaussians in a row of the textures.
const uint ROW = 1024u;

void main() {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    colour = vec4(0.0);
    conic = vec3(0.0);
    away = vec2(0.0);
    ivec2 at = ivec2(int(number % ROW), int(number / ROW));
    vec4 place = texelFetch(shapes, at * ivec2(3, 1), 0);
    vec4 a = texelFetch(shapes, at * ivec2(3, 1) + ivec2(1, 0), 0);
    vec2 b = texelFetch(shapes, at * ivec2(3, 1) + ivec2(2, 0), 0).xy;
    vec4 t = view * vec4(place.xyz, 1.0);
    float depth = -t.z;
    if (depth < picture.w) {
        return;
    }
    float focal = picture.z;
    // Far outside of the picture the linear approximation is too far off, so it is taken at its edge.
    vec2 edge = 1.3 * picture.xy / 2.0 / focal;
    vec2 slope = clamp(t.xy / depth, -edge, edge);
    mat3 covariance = mat3(a.x, a.y, a.z, a.y, a.w, b.x, a.z, b.x, b.y);
    mat3 jacobian = mat3(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, slope.x, slope.y, 0.0) * (focal / depth);
    mat3 turn = jacobian * mat3(view);
    mat3 spread = turn * covariance * transpose(turn) * (scale * scale);
    float xx = spread[0][0] + BLUR;
    float xy = spread[0][1];
    float yy = spread[1][1] + BLUR;
    float determinant = xx * yy - xy * xy;
    float faint = 2.0 * log(place.w / LEAST_ALPHA);
    if (determinant <= 0.0 || faint <= 0.0) {
        return;
    }
    conic = vec3(yy, -xy, xx) / determinant;
    vec2 reach = sqrt(faint * vec2(xx, yy)) + 1.0;
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    away = corner * reach;
    colour = vec4(texelFetch(colours, at, 0).rgb, place.w);
    gl_Position = projection * t;
    gl_Position.xy += 2.0 * away / picture.xy * gl_Position.w;
}
