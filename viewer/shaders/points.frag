#version 330 core
// The part of a point's square that its disk covers.

flat in vec4 shade;
flat in vec3 facing;
out vec4 colour;

// A disk seen from its edge is drawn at least so wide.
const float NARROW = 0.2;

void main() {
    vec2 at = 2.0 * gl_PointCoord - 1.0;
    at.y = -at.y;
    // How far the disk's plane is behind the middle, where it is seen from aslant.
    float behind = dot(facing.xy, at) / max(facing.z, NARROW);
    if (dot(at, at) + behind * behind > 1.0) {
        discard;
    }
    colour = shade;
}
