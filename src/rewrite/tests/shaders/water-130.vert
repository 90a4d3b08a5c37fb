#version 130
in vec3 position;
uniform mat4 camera;
uniform vec4 water, ground;
#line 12
void main() {
    vec4 world = vec4(position, 1.0);
    gl_Position = camera * world;
    gl_ClipDistance[0] = dot(water, world);
    gl_ClipDistance[1] = dot(ground, world);
}
