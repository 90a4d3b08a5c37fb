/* The shaders of passes.c, and the texture units of their samplers. */
#define GLSL "#version 330 core\n"
#define CAMERA "layout(std140) uniform Camera { mat4 view; mat4 projection; vec4 lamp, towards; } camera;\n"
#define SURFACE /* colour and glow; the floor has tiles */ \
    "uniform vec4 colour;\n" \
    "uniform float tiles;\n" \
    "in vec3 eye, n, place;\n" \
    "vec4 surface()\n" \
    "{\n" \
    "    float tile = smoothstep(-0.2, 0.2, sin(place.x * 2.1) * sin(place.z * 2.1));\n" \
    "    return vec4(colour.rgb * mix(1.0, 0.42 + 0.58 * tile, tiles), colour.a);\n" \
    "}\n"
#define SKY \
    "uniform vec2 size;\n" \
    "vec3 sky() { return mix(vec3(0.23, 0.14, 0.12), vec3(0.02, 0.04, 0.11), sqrt(gl_FragCoord.y / size.y)); }\n"
#define LIGHT /* in eye space, except for the shadow map; colours may exceed 1 */ \
    SKY CAMERA \
    "uniform mat4 shadow;\n" \
    "uniform sampler2DShadow shadows;\n" \
    "vec3 light(vec4 surface, vec3 n, vec3 p, float open)\n" \
    "{\n" \
    "    vec4 s = shadow * vec4(p + n * 0.06, 1.0);\n" \
    "    vec3 l = normalize(camera.lamp.xyz - p), at = s.xyz / s.w;\n" \
    "    float lit = 0.0, sheen = pow(max(dot(reflect(-l, n), -normalize(p)), 0.0), 40.0);\n" \
    "    for (int k = 0; k < 9; k++)\n" \
    "        lit += texture(shadows, at + vec3(k % 3 - 1, k / 3 - 1, 0.0) / 512.0) / 9.0;\n" \
    "    lit *= smoothstep(0.84, 0.93, dot(-l, camera.towards.xyz));\n" \
    "    vec3 around = mix(vec3(0.09, 0.07, 0.07), vec3(0.14, 0.17, 0.25), 0.5 + 0.5 * n.y) * open;\n" \
    "    vec3 direct = vec3(0.85, 0.76, 0.63) * lit * max(dot(n, l), 0.0) * (0.4 + 0.6 * open);\n" \
    "    vec3 c = surface.rgb * (around + direct + 3.3 * surface.a) + 0.4 * sheen * lit;\n" \
    "    return mix(c, sky(), smoothstep(9.0, 19.0, -p.z));\n" \
    "}\n"

static const char vertex_shadow[] = GLSL
    "uniform mat4 light, model;\n"
    "layout(location = 0) in vec3 position;\n"
    "void main() { gl_Position = light * model * vec4(position, 1.0); }\n";
static const char fragment_shadow[] = GLSL
    "void main() { }\n";
static const char vertex_scene[] = GLSL CAMERA
    "uniform mat4 model;\n"
    "layout(location = 0) in vec3 position;\n"
    "layout(location = 1) in vec3 normal;\n"
    "out vec3 eye, n, place;\n"
    "void main()\n"
    "{\n"
    "    vec4 w = model * vec4(position, 1.0), e = camera.view * w;\n"
    "    place = w.xyz;\n"
    "    eye = e.xyz;\n"
    "    n = mat3(camera.view) * (mat3(model) * normal);\n"
    "    gl_Position = camera.projection * e;\n"
    "}\n";
static const char fragment_geometry[] = GLSL SURFACE
    "layout(location = 0) out vec4 albedo;\n"
    "layout(location = 1) out vec4 normal;\n"
    "layout(location = 2) out vec4 position;\n"
    "void main()\n"
    "{\n"
    "    albedo = surface();\n"
    "    normal = vec4(normalize(n), 0.0);\n"
    "    position = vec4(eye, 1.0);\n"
    "}\n";
static const char vertex_screen[] = GLSL
    "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }\n";
static const char fragment_depths[] = GLSL
    "uniform sampler2D depths;\n"
    "uniform mat4 unproject;\n"
    "uniform vec2 size;\n"
    "out vec4 position;\n"
    "void main()\n"
    "{\n"
    "    float d = texelFetch(depths, ivec2(gl_FragCoord.xy), 0).r;\n"
    "    vec4 e = unproject * vec4(vec3(gl_FragCoord.xy / size, d) * 2.0 - 1.0, 1.0);\n"
    "    position = d < 1.0 ? vec4(e.xyz / e.w, 1.0) : vec4(0.0, 0.0, -1000.0, 0.0);\n"
    "}\n";
static const char fragment_occlusion[] = GLSL
    "uniform sampler2D normals, positions;\n"
    "out float open;\n"
    "const ivec2 offsets[16] = ivec2[16](ivec2(3, 0), ivec2(-3, 3), ivec2(0, -5), ivec2(4, 5), ivec2(-8, -1), ivec2(8, -5),\n"
    "    ivec2(-3, 10), ivec2(-5, -10), ivec2(12, 4), ivec2(-13, 5), ivec2(7, -14), ivec2(5, 16), ivec2(-16, -9), ivec2(19, -4),\n"
    "    ivec2(-12, 17), ivec2(-3, -22));\n"
    "void main()\n"
    "{\n"
    "    ivec2 here = 2 * ivec2(gl_FragCoord.xy), last = textureSize(positions, 0) - 1;\n"
    "    vec4 p = texelFetch(positions, here, 0);\n"
    "    vec3 n = texelFetch(normals, here, 0).xyz;\n"
    "    float sum = 0.0;\n"
    "    for (int k = 0; k < 16; k++) {\n"
    "        vec3 d = texelFetch(positions, clamp(here + offsets[k], ivec2(0), last), 0).xyz - p.xyz;\n"
    "        float far = dot(d, d);\n"
    "        sum += max(dot(n, d) * inversesqrt(far + 0.001) - 0.12, 0.0) / (1.0 + 4.0 * far);\n"
    "    }\n"
    "    open = 1.0 - p.w * min(sum * 0.19, 0.93);\n"
    "}\n";
static const char fragment_lighting[] = GLSL LIGHT
    "uniform sampler2D albedo, normals, positions, occlusion;\n"
    "out vec4 shown;\n"
    "void main()\n"
    "{\n"
    "    ivec2 here = ivec2(gl_FragCoord.xy);\n"
    "    vec4 p = texelFetch(positions, here, 0);\n"
    "    float open = 0.0;\n"
    "    for (int k = 0; k < 4; k++)\n"
    "        open += 0.25 * texture(occlusion, (gl_FragCoord.xy + vec2(k % 2, k / 2) * 4.0 - 2.0) / size).r;\n"
    "    vec3 c = p.w > 0.5 ? light(texelFetch(albedo, here, 0), texelFetch(normals, here, 0).xyz, p.xyz, open) : sky();\n"
    "    shown = vec4(c, 1.0);\n"
    "}\n";
static const char fragment_forward[] = GLSL LIGHT SURFACE
    "out vec4 shown;\n"
    "void main() { shown = vec4(light(surface(), normalize(n), eye, 1.0), 1.0); }\n";
static const char fragment_sky[] = GLSL SKY
    "out vec4 shown;\n"
    "void main() { shown = vec4(sky(), 1.0); }\n";
static const char fragment_glow[] = GLSL
    "uniform vec4 colour;\n"
    "in vec3 eye, n;\n"
    "out vec4 shown;\n"
    "void main() { shown = vec4(colour.rgb * pow(1.0 - abs(dot(normalize(n), normalize(eye))), colour.a), 0.0); }\n";
static const char fragment_glass[] = GLSL
    "uniform vec4 colour;\n"
    "uniform vec2 size;\n"
    "uniform sampler2D picture;\n"
    "in vec3 eye, n;\n"
    "out vec4 shown;\n"
    "void main()\n"
    "{\n"
    "    vec3 d = normalize(n);\n"
    "    float rim = pow(1.0 - abs(dot(d, normalize(eye))), 3.0);\n"
    "    shown = vec4(texture(picture, gl_FragCoord.xy / size - vec2(0.27, 0.36) * d.xy).rgb * colour.rgb + rim * colour.a, 1.0);\n"
    "}\n";
static const char fragment_bright[] = GLSL
    "uniform vec2 size;\n"
    "uniform sampler2D picture;\n"
    "out vec4 shown;\n"
    "void main()\n"
    "{\n"
    "    vec3 c = texture(picture, 2.0 * gl_FragCoord.xy / size).rgb;\n"
    "    shown = vec4(c * smoothstep(0.7, 1.6, max(c.r, max(c.g, c.b))), 1.0);\n"
    "}\n";
static const char fragment_blur[] = GLSL
    "uniform sampler2D picture;\n"
    "uniform ivec2 along;\n"
    "uniform int level;\n"
    "out vec4 shown;\n"
    "const float weights[5] = float[5](0.227, 0.195, 0.122, 0.054, 0.0155);\n"
    "void main()\n"
    "{\n"
    "    ivec2 here = ivec2(gl_FragCoord.xy), last = textureSize(picture, level) - 1;\n"
    "    vec3 sum = vec3(0.0);\n"
    "    for (int k = -4; k <= 4; k++)\n"
    "        sum += weights[abs(k)] * texelFetch(picture, clamp(here + k * along, ivec2(0), last), level).rgb;\n"
    "    shown = vec4(sum, 1.0);\n"
    "}\n";
static const char fragment_tone[] = GLSL
    "uniform vec2 size, corner;\n"
    "uniform sampler2D picture, bloom;\n"
    "out vec4 shown;\n"
    "void main()\n"
    "{\n"
    "    vec2 p = gl_FragCoord.xy - corner, v = p / size - 0.5;\n"
    "    vec3 c = texelFetch(picture, ivec2(p), 0).rgb + 0.8 * texture(bloom, p / size).rgb;\n"
    "    c *= 1.0 - 1.1 * dot(v, v);\n"
    "    shown = vec4(pow(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), vec3(1.0 / 2.2)), 1.0);\n"
    "}\n";
static const char vertex_display[] = GLSL
    "uniform vec4 rectangle;\n"
    "layout(location = 0) in vec3 position;\n"
    "void main() { gl_Position = vec4(rectangle.xy + rectangle.zw * position.xy, 0.25, 1.0); }\n";
static const char fragment_display[] = GLSL
    "uniform vec4 colour;\n"
    "out vec4 shown;\n"
    "void main() { shown = colour; }\n";

enum { SHADOW, GEOMETRY, OCCLUSION, LIGHTING, FORWARD, BACKGROUND, GLOW, GLASS, BRIGHT, BLUR, TONE, DISPLAY, DEPTHS, PROGRAMS };
static const char *const texts[PROGRAMS][2] = {
    {vertex_shadow, fragment_shadow}, {vertex_scene, fragment_geometry}, {vertex_screen, fragment_occlusion},
    {vertex_screen, fragment_lighting}, {vertex_scene, fragment_forward}, {vertex_screen, fragment_sky}, {vertex_scene, fragment_glow},
    {vertex_scene, fragment_glass}, {vertex_screen, fragment_bright}, {vertex_screen, fragment_blur}, {vertex_screen, fragment_tone},
    {vertex_display, fragment_display}, {vertex_screen, fragment_depths}};
/* Texture units by the names of samplers. */
enum { ALBEDO, NORMALS, POSITIONS, OPEN, SHADOWS, PICTURE, BLOOM, DEEP, UNITS };
static const char *const samplers[UNITS] = {"albedo", "normals", "positions", "occlusion", "shadows", "picture", "bloom", "depths"};
