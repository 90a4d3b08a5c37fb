/* The shaders of crowd.c. Each text follows a #version line and, with --pulled, a #define of it. */
#define CAMERA "layout(std140) uniform Camera { mat4 view; mat4 projection; vec4 sun; } camera;\n"
/* The place of an instance: an attribute, or two texels of a texture buffer that its number selects. */
#define PLACE \
    "#ifdef PULLED\n" \
    "uniform samplerBuffer crowd;\n" \
    "uniform int first;\n" \
    "vec3 standing() { return texelFetch(crowd, 2 * (first + gl_InstanceID)).xyz; }\n" \
    "#else\n" \
    "layout(location = 2) in vec3 place;\n" \
    "vec3 standing() { return place; }\n" \
    "#endif\n"
#define LIGHT /* in eye space */ \
    CAMERA \
    "uniform vec3 air;\n" \
    "in vec3 eye, n;\n" \
    "out vec4 shown;\n" \
    "vec3 light(vec3 colour, float gloss, float rim)\n" \
    "{\n" \
    "    vec3 d = normalize(n), v = normalize(eye), l = camera.sun.xyz;\n" \
    "    float sheen = pow(max(dot(reflect(-l, d), -v), 0.0), 36.0), edge = pow(1.0 - abs(dot(d, v)), 3.0);\n" \
    "    vec3 around = mix(vec3(0.19, 0.15, 0.17), vec3(0.34, 0.39, 0.52), 0.5 + 0.5 * dot(d, camera.view[1].xyz));\n" \
    "    vec3 c = colour * (around + vec3(0.83, 0.74, 0.61) * max(dot(d, l), 0.0)) + gloss * sheen + rim * edge * colour;\n" \
    "    return mix(c, air, smoothstep(8.5, 17.0, -eye.z));\n" \
    "}\n"

static const char vertex_crowd[] = CAMERA PLACE
    "layout(location = 0) in vec3 position;\n"
    "layout(location = 1) in vec3 normal;\n"
    "layout(location = 3) in vec3 size;\n" /* width, height, and direction */
    "layout(location = 4) in vec4 colour;\n"
    "layout(location = 5) in vec4 trim;\n"
    "uniform int kind;\n"
    "uniform float time;\n"
    "out vec3 eye, n, at, paint, band;\n"
    "mat2 turn(float a) { return mat2(cos(a), sin(a), -sin(a), cos(a)); }\n"
    "void main()\n"
    "{\n"
    "    float number = float(gl_InstanceID), height;\n"
    "    vec3 p = position * size.xyx, d = normal / size.xyx, where = standing();\n"
    "    height = where.y;\n"
    "    if (kind == 0) {\n" /* leans as it walks */
    "        mat2 lean = turn(0.17 * sin(4.1 * time + 1.9 * number));\n"
    "        p.xy = lean * p.xy, d.xy = lean * d.xy;\n"
    "        where.y += 0.05 * size.y * abs(sin(4.1 * time + 1.9 * number));\n"
    "    } else if (kind == 1) {\n" /* stands on its rim and turns */
    "        p = p.xzy, d = d.xzy;\n"
    "        mat2 spin = turn(1.3 * time + 0.7 * number);\n"
    "        p.xz = spin * p.xz, d.xz = spin * d.xz;\n"
    "        where.y += 0.09 * sin(1.7 * time + 0.9 * number);\n"
    "    } else if (kind == 2) {\n"
    "        mat2 spin = turn(2.3 * time + 1.1 * number);\n"
    "        p.xz = spin * p.xz, d.xz = spin * d.xz;\n"
    "        where.y += 0.12 * sin(2.9 * time + 0.5 * number);\n"
    "    } else {\n" /* the shadow of a thing, wider and fainter the higher the thing is */
    "        p *= 1.2 + 0.25 * height, where.y = 0.015;\n"
    "    }\n"
    "    mat2 look = turn(size.z);\n"
    "    p.xz = look * p.xz, d.xz = look * d.xz;\n"
    "    vec4 e = camera.view * vec4(where + p, 1.0);\n"
    "    eye = e.xyz;\n"
    "    n = mat3(camera.view) * d;\n"
    "    at = vec3(position.x, kind == 3 ? 0.63 / (1.0 + 0.9 * height) : position.y, position.z);\n"
    "    paint = colour.rgb;\n"
    "    band = trim.rgb;\n"
    "    gl_Position = camera.projection * e;\n"
    "}\n";
static const char fragment_crowd[] = LIGHT
    "uniform int kind;\n"
    "in vec3 at, paint, band;\n"
    "void main()\n"
    "{\n"
    "    if (kind == 3) {\n"
    "        shown = vec4(0.03, 0.04, 0.08, at.y * (1.0 - smoothstep(0.15, 1.0, length(at.xz))));\n"
    "        return;\n"
    "    }\n"
    "    float stripe = smoothstep(-0.3, 0.3, sin(8.0 * atan(at.z, at.x)));\n"
    "    float sash = smoothstep(0.27, 0.31, at.y) - smoothstep(0.40, 0.44, at.y);\n"
    "    vec3 c = kind == 0 ? mix(paint, band, sash) : kind == 1 ? mix(paint, band, stripe) : mix(band, paint, 0.5 + 0.5 * at.y);\n"
    "    shown = vec4(light(c, kind == 0 ? 0.3 : 0.6, kind == 2 ? 1.1 : 0.3), 1.0);\n"
    "}\n";
static const char vertex_floor[] = CAMERA
    "layout(location = 0) in vec3 position;\n"
    "layout(location = 1) in vec3 normal;\n"
    "layout(location = 4) in vec4 colour;\n"
    "out vec3 eye, n, paint;\n"
    "void main()\n"
    "{\n"
    "    vec4 e = camera.view * vec4(position, 1.0);\n"
    "    eye = e.xyz;\n"
    "    n = mat3(camera.view) * normal;\n"
    "    paint = colour.rgb;\n"
    "    gl_Position = camera.projection * e;\n"
    "}\n";
static const char fragment_floor[] = LIGHT
    "in vec3 paint;\n"
    "void main() { shown = vec4(light(paint, 0.1, 0.0), 1.0); }\n";
/* The display: rectangles, or a dot on its map for each member of the crowd. */
static const char vertex_flat[] = PLACE
    "layout(location = 0) in vec3 corner;\n"
    "layout(location = 4) in vec4 colour;\n"
    "layout(location = 6) in vec4 rectangle;\n"
    "uniform vec4 map;\n" /* centre and half size, which is 7 on the floor; 0 for rectangles */
    "uniform float time;\n"
    "out vec4 paint;\n"
    "void main()\n"
    "{\n"
    "    float pulse = 1.0 + 0.25 * sin(5.0 * time + 0.8 * float(gl_InstanceID));\n"
    "    vec4 r = map.z > 0.0 ? vec4(map.xy + map.zw * vec2(1.0, -1.0) * standing().xz / 7.0, map.zw * 0.025 * pulse) : rectangle;\n"
    "    paint = colour;\n"
    "    gl_Position = vec4(r.xy + r.zw * corner.xz, 0.3, 1.0);\n"
    "}\n";
static const char fragment_flat[] =
    "in vec4 paint;\n"
    "out vec4 shown;\n"
    "void main() { shown = paint; }\n";

enum { FIGURES, FLOOR, FLAT, PROGRAMS };
static const char *const texts[PROGRAMS][2] = {
    {vertex_crowd, fragment_crowd}, {vertex_floor, fragment_floor}, {vertex_flat, fragment_flat}};
