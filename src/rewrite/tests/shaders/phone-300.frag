#version 300 es
precision lowp float;
uniform highp vec2 size;
out vec4 colour;
void main() { colour = vec4(gl_FragCoord.xy / size, gl_FragCoord.z, 1.0); }
