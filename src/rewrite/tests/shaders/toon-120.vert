#version 120 /* toon */ // shading
#extension GL_ARB_draw_instanced : enable
attribute vec3 offset;
uniform mat4 view, projection[2];
varying vec3 normal;

void main() {
    float row = float(gl_InstanceIDARB);
    normal = gl_NormalMatrix * gl_Normal;
    gl_Position = projection[0] * view * (gl_Vertex + vec4(offset * row, 0.0));
}
