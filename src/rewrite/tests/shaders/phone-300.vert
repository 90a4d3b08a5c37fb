#version 300 es
in vec4 position;
uniform highp mat4 matrix;
void main() { gl_Position = matrix * position; }
