#version 420 core
in vec4 position;
out gl_PerVertex { vec4 gl_Position; float gl_ClipDistance[]; };
uniform mat4 matrix;
uniform vec4 plane;
void main() { gl_Position = matrix * position; gl_ClipDistance[0] = dot(plane, position); }
