#version 410 core
layout(quads, fractional_odd_spacing) in;
in gl_PerVertex { vec4 gl_Position; float gl_ClipDistance[4]; } gl_in[];
uniform sampler2D heights;
uniform mat4 camera;
out vec2 at;

void main() {
    at = gl_TessCoord.xy;
    vec4 low = mix(gl_in[0].gl_Position, gl_in[1].gl_Position, at.x);
    vec4 high = mix(gl_in[3].gl_Position, gl_in[2].gl_Position, at.x);
    gl_Position = camera * (mix(low, high, at.y) + vec4(0.0, texture(heights, at).r, 0.0, 0.0));
}
