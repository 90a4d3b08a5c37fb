#version 420 core
layout(location = 0) in vec4 position;
layout(location = 0) out vec4 colour;
out gl_PerVertex {
    vec4 gl_Position;
    float gl_PointSize;
};
uniform mat4 matrix;
void main() { colour = position; gl_Position = matrix * position; gl_PointSize = 2.0; }
