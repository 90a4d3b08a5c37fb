/* The shaders of relief.c. All light is in world space; only positions go through matrices. */
#define GLSL_330 "#version 330 core\n"
#define GLSL_400 "#version 400 core\n"
#define LAND /* smooth everywhere, so that rounding makes no visible difference */ \
    "uniform float time;\n" \
    "float height(vec2 p)\n" \
    "{\n" \
    "    float h = 0.62 * sin(0.55 * p.x + 0.4) * cos(0.48 * p.y - 0.6) + 0.35 * sin(1.05 * p.x - 0.83 * p.y + 1.3);\n" \
    "    h += 0.16 * sin(1.9 * p.x + 1.37 * p.y) + 0.07 * sin(3.7 * p.x - 1.1 * p.y) * sin(3.1 * p.y + 0.9 * p.x);\n" \
    "    h += 0.035 * sin(6.3 * p.x + 2.0 * sin(2.1 * p.y)) * sin(7.1 * p.y + 1.7 * sin(1.3 * p.x));\n" \
    "    return h + 2.3 * smoothstep(-3.5, -11.0, p.y) * (0.55 + 0.45 * sin(0.83 * p.x + 0.9)) - 0.12;\n" \
    "}\n" \
    "vec3 upright(vec2 p)\n" \
    "{\n" \
    "    vec2 d = vec2(0.03, 0.0);\n" \
    "    return normalize(vec3(height(p - d) - height(p + d), 0.06, height(p - d.yx) - height(p + d.yx)));\n" \
    "}\n"
#define LIGHT \
    "uniform vec3 from;\n" /* the camera's position */ \
    "const vec3 sun = vec3(-0.55, 0.56, 0.62);\n" \
    "vec3 sky(float up) { return mix(vec3(0.83, 0.71, 0.59), vec3(0.31, 0.47, 0.72), smoothstep(0.0, 0.45, up)); }\n" \
    "vec3 lit(vec3 colour, vec3 n, float open)\n" \
    "{\n" \
    "    return colour * (mix(vec3(0.17, 0.15, 0.16), vec3(0.33, 0.38, 0.49), 0.5 + 0.5 * n.y)\n" \
    "        + open * vec3(0.93, 0.81, 0.62) * max(dot(n, sun), 0.0));\n" \
    "}\n" \
    "vec3 hazy(vec3 colour, vec3 p) { return mix(colour, sky(0.02), 0.87 * smoothstep(6.0, 23.0, distance(p, from))); }\n"
#define EARTH /* colours of the ground */ \
    "vec3 earth(vec3 p, vec3 n)\n" \
    "{\n" \
    "    float rough = sin(5.3 * p.x + 1.2 * sin(4.1 * p.z)) * sin(4.7 * p.z);\n" \
    "    vec3 c = mix(vec3(0.67, 0.59, 0.41), vec3(0.26, 0.43, 0.15) + 0.05 * rough, smoothstep(-0.34, -0.12, p.y + 0.05 * rough));\n" \
    "    c = mix(c, vec3(0.43, 0.38, 0.35), smoothstep(0.83, 0.70, n.y + 0.04 * rough));\n" \
    "    return mix(c, vec3(0.91, 0.93, 0.97), smoothstep(1.25, 1.6, p.y + 0.15 * rough) * smoothstep(0.55, 0.75, n.y));\n" \
    "}\n"

/* ---- the land in patches ---- */

static const char vertex_patch[] = GLSL_400
    "layout(location = 0) in vec2 position;\n"
    "void main() { gl_Position = vec4(position.x, 0.0, position.y, 1.0); }\n"; /* in the world; nothing is projected yet */
static const char control[] = GLSL_400 LAND
    "layout(vertices = 4) out;\n"
    "uniform mat4 view;\n"
    "uniform float finest;\n"
    "patch out float tint;\n"
    "vec3 seen(int k)\n" /* a corner in eye space */
    "{\n"
    "    vec4 p = gl_in[k].gl_Position;\n"
    "    return (view * vec4(p.x, height(p.xz), p.z, 1.0)).xyz;\n"
    "}\n"
    "float level(vec3 a, vec3 b) { return clamp(finest * distance(a, b) / length(0.5 * (a + b)), 1.0, 24.0); }\n"
    "void main()\n"
    "{\n"
    "    gl_out[gl_InvocationID].gl_Position = gl_in[gl_InvocationID].gl_Position;\n"
    "    if (gl_InvocationID == 0) {\n"
    "        vec3 a = seen(0), b = seen(1), c = seen(2), d = seen(3);\n"
    "        gl_TessLevelOuter[0] = level(a, d);\n"
    "        gl_TessLevelOuter[1] = level(a, b);\n"
    "        gl_TessLevelOuter[2] = level(b, c);\n"
    "        gl_TessLevelOuter[3] = level(c, d);\n"
    "        gl_TessLevelInner[0] = 0.5 * (gl_TessLevelOuter[1] + gl_TessLevelOuter[3]);\n"
    "        gl_TessLevelInner[1] = 0.5 * (gl_TessLevelOuter[0] + gl_TessLevelOuter[2]);\n"
    "        tint = 0.965 + 0.01 * float(gl_PrimitiveID % 7);\n"
    "    }\n"
    "}\n";
#define EVALUATION GLSL_400 LAND \
    "layout(quads, fractional_odd_spacing, ccw) in;\n" \
    "patch in float tint;\n" \
    "vec3 displaced()\n" \
    "{\n" \
    "    vec3 a = mix(gl_in[0].gl_Position.xyz, gl_in[1].gl_Position.xyz, gl_TessCoord.x);\n" \
    "    vec3 b = mix(gl_in[3].gl_Position.xyz, gl_in[2].gl_Position.xyz, gl_TessCoord.x);\n" \
    "    vec3 p = mix(a, b, gl_TessCoord.y);\n" \
    "    return vec3(p.x, height(p.xz), p.z);\n" \
    "}\n"
static const char evaluation[] = EVALUATION
    "uniform mat4 projection, view;\n"
    "out vec3 place;\n"
    "out float shade;\n"
    "void main()\n"
    "{\n"
    "    place = displaced();\n"
    "    shade = tint;\n"
    "    gl_Position = projection * view * vec4(place, 1.0);\n"
    "}\n";
static const char evaluation_grass[] = EVALUATION
    "out vec3 corner;\n"
    "void main()\n"
    "{\n"
    "    corner = displaced();\n"
    "    gl_Position = vec4(corner, tint);\n" /* for the geometry shader, which projects */
    "}\n";
/* Uses the true slope in each pixel, however coarse the triangles, and shadows by hills. */
static const char fragment_land[] = GLSL_400 LAND LIGHT EARTH
    "in vec3 place;\n"
    "in float shade;\n"
    "out vec4 shown;\n"
    "void main()\n"
    "{\n"
    "    vec3 n = upright(place.xz);\n"
    "    float open = 1.0;\n"
    "    for (int k = 1; k <= 5; k++) {\n"
    "        vec3 p = place + sun * 0.09 * float(k * k);\n"
    "        open = min(open, 1.0 - smoothstep(-0.02, 0.14, (height(p.xz) - p.y) / float(k)));\n"
    "    }\n"
    "    shown = vec4(hazy(lit(shade * earth(place, n), n, open), place), 1.0);\n"
    "}\n";

/* ---- the land with grass, which a geometry shader grows on each triangle ---- */

static const char vertex_grass[] = GLSL_330 LAND
    "layout(location = 0) in vec2 position;\n"
    "out vec3 corner;\n"
    "void main()\n"
    "{\n"
    "    corner = vec3(position.x, height(position), position.y);\n"
    "    gl_Position = vec4(corner, 1.0);\n"
    "}\n";
#define GRASS LAND \
    "layout(triangles) in;\n" \
    "layout(triangle_strip, max_vertices = 12) out;\n" \
    "uniform mat4 everything;\n" /* projection and camera */ \
    "in vec3 corner[];\n" \
    "out vec3 place, paint;\n" \
    "flat out vec3 n;\n" \
    "void put(vec3 p, vec3 normal, vec3 colour)\n" \
    "{\n" \
    "    place = p;\n" \
    "    n = normal;\n" \
    "    paint = colour;\n" \
    "    gl_Position = everything * vec4(p, 1.0);\n" \
    "    EmitVertex();\n" \
    "}\n" \
    "void blade(vec3 root, vec3 up, float number, float high)\n" \
    "{\n" \
    "    float a = 2.4 * number, bow = 0.35 * sin(1.7 * time + 0.9 * root.x + 0.6 * root.z);\n" \
    "    vec3 wide = 0.022 * vec3(cos(a), 0.0, sin(a));\n" \
    "    vec3 tip = root + high * (up + 0.3 * vec3(sin(a), 0.0, cos(a)) + vec3(bow, 0.0, 0.0));\n" \
    "    vec3 normal = normalize(cross(wide, tip - root));\n" \
    "    vec3 green = mix(vec3(0.33, 0.53, 0.13), vec3(0.72, 0.70, 0.23), 0.5 + 0.5 * sin(1.3 * number));\n" \
    "    normal *= normal.z < 0.0 ? -1.0 : 1.0;\n" \
    "    put(root - wide, normal, 0.55 * green);\n" \
    "    put(root + wide, normal, 0.55 * green);\n" \
    "    put(tip, normal, 1.25 * green);\n" \
    "    EndPrimitive();\n" \
    "}\n" \
    "void grow(float number, float tint)\n" \
    "{\n" \
    "    vec3 flat_n = normalize(cross(corner[1] - corner[0], corner[2] - corner[0]));\n" \
    "    vec3 middle = (corner[0] + corner[1] + corner[2]) / 3.0;\n" \
    "    for (int k = 0; k < 3; k++)\n" \
    "        put(corner[k], flat_n, vec3(tint, tint, -1.0));\n" \
    "    EndPrimitive();\n" \
    "    float high = 0.24 * smoothstep(-0.2, 0.0, middle.y) * smoothstep(1.2, 0.8, middle.y) * smoothstep(0.66, 0.8, flat_n.y);\n" \
    "    for (int k = 0; k < 3 && high > 0.03; k++)\n" \
    "        blade(mix(middle, corner[k], 0.55 * float(k + 1) / 3.0), flat_n, number + float(k), high * (0.8 + 0.2 * float(k)));\n" \
    "}\n"
static const char geometry_grass[] = GLSL_330 GRASS
    "void main() { grow(float(gl_PrimitiveIDIn % 1000), gl_PrimitiveIDIn % 2 == 0 ? 1.0 : 0.93); }\n";
/* Without gl_PrimitiveIDIn: llvmpipe counts triangles here, others may count patches. */
static const char geometry_both[] = GLSL_400 GRASS
    "void main() { grow(9.0 * corner[0].x + 7.0 * corner[0].z, gl_in[0].gl_Position.w); }\n";
static const char fragment_grass[] = GLSL_330 LIGHT EARTH
    "in vec3 place, paint;\n"
    "flat in vec3 n;\n"
    "out vec4 shown;\n"
    "void main()\n"
    "{\n"
    "    bool ground = paint.b < 0.0;\n" /* no blade has this colour */
    "    shown = vec4(hazy(lit(ground ? paint.r * earth(place, n) : paint, n, 1.0), place), 1.0);\n"
    "}\n";

/* ---- water, trees and seeds, the sky, the display ---- */

static const char vertex_water[] = GLSL_330
    "layout(location = 0) in vec2 position;\n"
    "uniform mat4 everything;\n"
    "out vec3 place;\n"
    "void main()\n"
    "{\n"
    "    place = vec3(position.x, -0.4, position.y);\n"
    "    gl_Position = everything * vec4(place, 1.0);\n"
    "}\n";
static const char fragment_water[] = GLSL_330 LAND LIGHT
    "in vec3 place;\n"
    "out vec4 shown;\n"
    "void main()\n"
    "{\n"
    "    vec2 p = place.xz;\n"
    "    float deep = -0.4 - height(p);\n"
    "    float a = 9.0 * p.x + 2.0 * sin(2.3 * p.y) + 2.1 * time, b = 11.0 * p.y + 2.0 * sin(1.9 * p.x) + 1.7 * time;\n"
    "    vec3 n = normalize(vec3(0.05 * cos(a), 1.0, 0.05 * cos(b))), v = normalize(place - from), r = reflect(v, n);\n"
    "    float bent = pow(1.0 - max(dot(-v, n), 0.0), 3.0);\n"
    "    vec3 c = mix(vec3(0.07, 0.23, 0.29), sky(r.y), 0.15 + 0.8 * bent) + 0.7 * pow(max(dot(r, sun), 0.0), 60.0);\n"
    "    c = mix(vec3(0.86, 0.90, 0.88), c, smoothstep(0.0, 0.05 + 0.02 * sin(b), deep));\n"
    "    shown = vec4(hazy(c, place), 0.37 + 0.5 * smoothstep(0.0, 0.4, deep));\n"
    "}\n";
static const char vertex_points[] = GLSL_330 LAND
    "layout(location = 0) in vec4 position;\n" /* across, height over the land, away, half size */
    "out float drift;\n"
    "uniform int seeds;\n"
    "void main()\n"
    "{\n"
    "    vec3 p = position.xyz;\n"
    "    drift = 3.1 * p.x + 4.7 * p.z;\n"
    "    if (seeds != 0)\n"
    "        p += vec3(0.5 * sin(0.7 * time + drift), 0.25 * sin(1.1 * time + 2.0 * drift), 0.4 * cos(0.6 * time + drift));\n"
    "    gl_Position = vec4(p.x, p.y + height(p.xz), p.z, position.w);\n"
    "}\n";
/* Squares that face the camera: built in eye space, then projected. Three for a tree, one for a seed. */
static const char geometry_points[] = GLSL_330
    "layout(points) in;\n"
    "layout(triangle_strip, max_vertices = 12) out;\n"
    "uniform mat4 projection, view;\n"
    "uniform int seeds;\n"
    "in float drift[];\n"
    "out vec2 across;\n"
    "out vec3 place;\n"
    "flat out float kind;\n"
    "void square(vec4 middle, vec3 world, float size)\n"
    "{\n"
    "    for (int k = 0; k < 4; k++) {\n"
    "        across = vec2(k % 2, k / 2) * 2.0 - 1.0;\n"
    "        place = world;\n"
    "        kind = fract(0.37 * float(gl_PrimitiveIDIn));\n"
    "        gl_Position = projection * (middle + vec4(across * size, 0.0, 0.0));\n"
    "        EmitVertex();\n"
    "    }\n"
    "    EndPrimitive();\n"
    "}\n"
    "void main()\n"
    "{\n"
    "    vec3 p = gl_in[0].gl_Position.xyz;\n"
    "    float size = gl_in[0].gl_Position.w;\n"
    "    if (seeds == 0 && p.y < -0.1)\n" /* no trees in the water */
    "        return;\n"
    "    for (int k = 0; k < (seeds != 0 ? 1 : 3); k++) {\n"
    "        vec3 w = p + size * float(k) * vec3(0.1 * sin(drift[0]), 0.85, 0.1 * cos(drift[0]));\n"
    "        square(view * vec4(w, 1.0), w, size * (1.0 - 0.27 * float(k)));\n"
    "    }\n"
    "}\n";
static const char fragment_points[] = GLSL_330 LIGHT
    "uniform mat4 view;\n" /* for its axes */
    "uniform int seeds;\n"
    "in vec2 across;\n"
    "in vec3 place;\n"
    "flat in float kind;\n"
    "out vec4 shown;\n"
    "void main()\n"
    "{\n"
    "    float r = dot(across, across);\n"
    "    if (r > 1.0)\n"
    "        discard;\n"
    "    vec3 n = vec3(across, sqrt(1.0 - r)) * mat3(view);\n"
    "    vec3 c = mix(vec3(0.15, 0.34, 0.14), vec3(0.55, 0.37, 0.12), kind * kind);\n"
    "    shown = seeds != 0 ? vec4(vec3(0.96, 0.84, 0.51) * pow(1.0 - r, 2.0), 0.0) : vec4(hazy(lit(c, n, 1.0), place), 1.0);\n"
    "}\n";
static const char vertex_sky[] = GLSL_330
    "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.5, 1.0); }\n";
static const char fragment_sky[] = GLSL_330 LIGHT
    "uniform vec3 window;\n" /* origin, and height */
    "out vec4 shown;\n"
    "void main() { shown = vec4(sky((gl_FragCoord.y - window.y) / window.z - 0.62), 1.0); }\n";
/* Rectangles by instance and vertex number, or points. */
static const char vertex_flat[] = GLSL_330
    "layout(location = 0) in vec4 rectangle;\n"
    "layout(location = 1) in vec4 colour;\n"
    "out vec4 paint;\n"
    "void main()\n"
    "{\n"
    "    paint = colour;\n"
    "    gl_Position = vec4(rectangle.xy + rectangle.zw * (vec2(gl_VertexID % 2, gl_VertexID / 2) * 2.0 - 1.0), 0.3, 1.0);\n"
    "}\n";
static const char vertex_dots[] = GLSL_330
    "layout(location = 0) in vec4 rectangle;\n"
    "layout(location = 1) in vec4 colour;\n"
    "out vec4 ink;\n"
    "void main()\n"
    "{\n"
    "    ink = colour;\n"
    "    gl_Position = rectangle;\n"
    "}\n";
static const char geometry_dots[] = GLSL_330
    "layout(points) in;\n"
    "layout(triangle_strip, max_vertices = 4) out;\n"
    "in vec4 ink[];\n"
    "out vec4 paint;\n"
    "void main()\n"
    "{\n"
    "    vec4 r = gl_in[0].gl_Position;\n"
    "    for (int k = 0; k < 4; k++) {\n"
    "        paint = ink[0];\n"
    "        gl_Position = vec4(r.xy + r.zw * (vec2(k % 2, k / 2) * 2.0 - 1.0), 0.3, 1.0);\n"
    "        EmitVertex();\n"
    "    }\n"
    "    EndPrimitive();\n"
    "}\n";
static const char fragment_flat[] = GLSL_330
    "in vec4 paint;\n"
    "out vec4 shown;\n"
    "void main() { shown = paint; }\n";

enum { PATCHES, MEADOW, BOTH, WATER, POINTS, SKY, FLAT, DOTS, PROGRAMS };
static const char *const texts[PROGRAMS][5] = {
    {vertex_patch, control, evaluation, 0, fragment_land}, {vertex_grass, 0, 0, geometry_grass, fragment_grass},
    {vertex_patch, control, evaluation_grass, geometry_both, fragment_grass}, {vertex_water, 0, 0, 0, fragment_water},
    {vertex_points, 0, 0, geometry_points, fragment_points}, {vertex_sky, 0, 0, 0, fragment_sky}, {vertex_flat, 0, 0, 0, fragment_flat},
    {vertex_dots, 0, 0, geometry_dots, fragment_flat}};
