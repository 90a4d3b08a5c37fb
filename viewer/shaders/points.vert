#version 330 core
// A point of a node of the tree. Where nodes below it are drawn as well, it is as small as their points.

layout(location = 0) in vec3 place;
layout(location = 1) in vec4 colour;
layout(location = 2) in vec4 normal;
layout(location = 3) in float radius;

uniform mat4 view;
uniform mat4 projection;
// Pixels that a length of one has at a distance of one.
uniform float pixels;
// A factor of the user's.
uniform float scale;
// Middle and half of the side of the node's cube.
uniform vec4 cube;
// The node's number in the list of those that are drawn.
uniform uint node;
// Of each drawn node: which octants have a drawn one below, from bit 8 on which have any, and from bit 16 on the number of the first drawn one; the radius of its points, as the bits of a float.
uniform usampler2D nodes;

flat out vec4 shade;
// In the space of a camera that looks at the point; length 0 where there is none.
flat out vec3 facing;

uint ones(uint bits) {
    uint sum = bits - ((bits >> 1) & 0x55u);
    sum = (sum & 0x33u) + ((sum >> 2) & 0x33u);
    return (sum + (sum >> 4)) & 0xfu;
}

uvec2 entry(uint number) {
    return texelFetch(nodes, ivec2(int(number & 1023u), int(number >> 10)), 0).xy;
}

// The radius of the points of the lowest node that is drawn here.
float lowest() {
    vec4 at = cube;
    uvec2 own = entry(node);
    for (int level = 0; level < 32; level++) {
        uvec3 side = uvec3(greaterThanEqual(place, at.xyz));
        uint octant = side.x | side.y << 1 | side.z << 2;
        if ((own.x >> octant & 1u) == 0u) {
            if ((own.x >> (octant + 8u) & 1u) != 0u) {
                break;
            }
            // All points here are drawn. They are as dense as elsewhere in the node: a thin slice of a surface has few neighbours.
            for (int below = level; below < 32 && (own.x & 0xffu) != 0u; below++) {
                own = entry(own.x >> 16);
            }
            break;
        }
        uint before = ones(own.x & ((1u << octant) - 1u));
        at = vec4(at.xyz + (vec3(side) - 0.5) * at.w, at.w * 0.5);
        own = entry((own.x >> 16) + before);
    }
    return uintBitsToFloat(own.y);
}

void main() {
    vec4 eye = view * vec4(place, 1.0);
    gl_Position = projection * eye;
    float cover = lowest();
    // Below zero: guessed from neighbours, and too large where points lie between them. Else the file's: too small where points are left out.
    float size = radius < 0.0 ? min(-radius, cover) : max(radius, cover);
    gl_PointSize = max(2.0 * size * scale * pixels / max(-eye.z, 1e-30), 1.0);
    shade = vec4(colour.rgb, 1.0);
    facing = vec3(0.0);
    if (normal.w > 0.5) {
        vec3 n = normalize(mat3(view) * normal.xyz);
        vec3 z = normalize(-eye.xyz);
        vec3 x = normalize(cross(vec3(0.0, 1.0, 0.0), z));
        facing = vec3(dot(n, x), dot(n, cross(z, x)), dot(n, z));
        if (facing.z < 0.0) {
            facing = -facing;
        }
        // A light at the eye, so that shape is seen whichever side a normal is on.
        shade.rgb *= 0.25 + 0.75 * facing.z;
    }
}
