#version 330 core
layout(location = 0) in vec3 position;
layout(location = 3) in vec4 placed;
layout(std140) uniform Camera {
    layout(row_major) mat4 view;
    mat4 projection, previous[2];
    vec4 eye;
} camera;
layout(std140) uniform Bones { mat4 bones[64]; };
#define WHO (gl_InstanceID % 7)
flat out int who;

void main() {
    who = WHO;
    gl_Position = camera.projection * camera.view * bones[gl_InstanceID] * vec4(position + placed.xyz, 1.0);
}
