#version 150
#ifdef DEEP
uniform sampler2D depths; vec4 before = gl_FragCoord;
#endif
layout(origin_upper_left, pixel_center_integer) in vec4 gl_FragCoord;
uniform sampler2D scene;
uniform vec2 size;
out vec4 colour;
#define HERE (gl_FragCoord.xy / size)

void main() {
    vec4 here = texture(scene, HERE);
    colour = fwidth(here) * gl_FragCoord.w;
}
