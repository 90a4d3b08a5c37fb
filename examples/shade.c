/* Programs with shaders, in buffers: light per pixel, or in steps (--toon), and a flat display by the same program. --glsl 120: attributes and
 * varyings, matrices as uniforms; 330: the camera in a uniform block, the model in a uniform. In OpenGL ES these are GLSL 1.00 and 3.00 es.
 * --sky: a triangle over the whole screen, whose fragments compute their rays by the inverse of the projection: before the scene, with depths
 * (120), or after it, at the far end (330). --box: a sky on a box around the eye, before the scene and without depths (120), or after it, with z = w
 * (330). --orthographic: the scene has no perspective; it cannot have a sky. */
#include "demo.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static int version = 120, toon, combined, apart, sky, box, orthographic;
const struct demo_option demo_options[] = {
    {"--glsl", "120 or 330 (default 120)", &version, 1},
    {"--toon", "steps of light and dark outlines", &toon, 0},
    {"--combined", "one matrix for projection, camera and model (120)", &combined, 0},
    {"--apart", "no matrix: the camera in numbers and vectors (120)", &apart, 0},
    {"--sky", "a sky by the rays of fragments", &sky, 0},
    {"--box", "a sky on a box around the eye", &box, 0},
    {"--orthographic", "the scene without perspective", &orthographic, 0},
    {0}};

static const char *const vertex_120 =
    "#version 120\n"
    "attribute vec3 position, normal;\n"
    "uniform mat4 projection, modelview;\n"
    "uniform float size;\n"
    "varying vec3 eye, n;\n"
    "void main(void)\n"
    "{\n"
    "    vec4 e = modelview * vec4(position * size, 1.0);\n"
    "    eye = e.xyz;\n"
    "    n = mat3(modelview[0].xyz, modelview[1].xyz, modelview[2].xyz) * normal;\n"
    "    gl_Position = projection * e;\n"
    "}\n";
static const char *const vertex_combined =
    "#version 120\n"
    "attribute vec3 position, normal;\n"
    "uniform mat4 modelview, everything;\n"
    "uniform float size;\n"
    "varying vec3 eye, n;\n"
    "void main()\n"
    "{\n"
    "    eye = (modelview * vec4(position * size, 1.0)).xyz;\n"
    "    n = mat3(modelview[0].xyz, modelview[1].xyz, modelview[2].xyz) * normal;\n"
    "    gl_Position = everything * vec4(position * size, 1.0);\n"
    "}\n";
static const char *const vertex_apart =
    "#version 120\n"
    "attribute vec3 position, normal;\n"
    "uniform vec4 lens, skew, right, up, back;\n"
    "uniform float size;\n"
    "varying vec3 eye, n;\n"
    "void main()\n"
    "{\n"
    "    vec4 p = vec4(position * size, 1.0);\n"
    "    vec3 e = vec3(dot(right, p), dot(up, p), dot(back, p));\n"
    "    eye = e;\n"
    "    n = vec3(dot(right.xyz, normal), dot(up.xyz, normal), dot(back.xyz, normal));\n"
    "    gl_Position = vec4(lens.x * e.x + skew.x * e.z + skew.y, lens.y * e.y, lens.z * e.z + lens.w, skew.z * e.z + skew.w);\n"
    "}\n";
static const char *const fragment_120 =
    "#version 120\n"
    "uniform vec4 colour;\n"
    "uniform float steps, unlit;\n"
    "varying vec3 eye, n;\n"
    "void main()\n"
    "{\n"
    "    vec3 d = normalize(n), l = normalize(vec3(3.0, 6.0, 2.0) - eye);\n"
    "    float light = max(dot(d, l), 0.0), edge = abs(dot(d, normalize(eye)));\n"
    "    light = steps > 0.0 ? floor(light * steps + 0.5) / steps * step(0.25, edge) : light + pow(light, 30.0) * 0.4;\n"
    "    vec2 at = gl_FragCoord.xy;\n" /* gl_FragCoord has only eleven bits in GLSL 1.00 where it is used in expressions directly */
    "    float net = mod(floor(at.x) + floor(at.y), 2.0);\n"
    "    gl_FragColor = vec4(colour.rgb * mix(0.17 + 0.8 * light, 0.8 + 0.2 * net, unlit), colour.a);\n"
    "}\n";
#define CAMERA "layout(std140) uniform Camera { vec4 sun; mat4 projection; mat4 view; mat4 unprojection; } camera;\n"
static const char *const vertex_330 =
    "#version 330 core\n"
    CAMERA
    "uniform mat4 model;\n"
    "uniform float size;\n"
    "layout(location = 0) in vec3 position;\n"
    "layout(location = 1) in vec3 normal;\n"
    "out vec3 eye, n;\n"
    "void main()\n"
    "{\n"
    "    vec4 e = camera.view * model * vec4(position * size, 1.0);\n"
    "    eye = e.xyz;\n"
    "    n = mat3(camera.view) * mat3(model) * normal;\n"
    "    gl_Position = camera.projection * e;\n"
    "}\n";
static const char *const fragment_330 =
    "#version 330 core\n"
    CAMERA
    "uniform vec4 colour;\n"
    "uniform float steps, unlit;\n"
    "in vec3 eye, n;\n"
    "out vec4 shown;\n"
    "void main()\n"
    "{\n"
    "    vec3 d = normalize(n), l = normalize(camera.sun.xyz - eye);\n"
    "    float light = max(dot(d, l), 0.0), edge = abs(dot(d, normalize(eye)));\n"
    "    light = steps > 0.0 ? floor(light * steps + 0.5) / steps * step(0.25, edge) : light + pow(light, 30.0) * 0.4;\n"
    "    float net = mod(floor(gl_FragCoord.x) + floor(gl_FragCoord.y), 2.0);\n"
    "    shown = vec4(colour.rgb * mix(0.17 + 0.8 * light, 0.8 + 0.2 * net, unlit), colour.a);\n"
    "}\n";

/* At the far end of the depth range. */
static const char *const sky_vertex_120 =
    "#version 120\n"
    "attribute vec3 position;\n"
    "void main() { gl_Position = vec4(position.xy, 1.0, 1.0); }\n";
static const char *const sky_vertex_330 =
    "#version 330 core\n"
    "layout(location = 0) in vec3 position;\n"
    "void main() { gl_Position = vec4(position.xy, 1.0, 1.0); }\n";
#define CLOUDS \
    "    vec3 ray = normalize(far.xyz / far.w);\n" \
    "    float band = 0.5 + 0.5 * sin(24.0 * ray.x) * sin(24.0 * ray.y);\n"
static const char *const sky_fragment_120 =
    "#version 120\n"
    "uniform vec4 screen;\n"
    "uniform mat4 projection, unprojection;\n"
    "void main()\n"
    "{\n"
    "    vec2 at = (gl_FragCoord.xy - screen.xy) / screen.zw * 2.0 - 1.0;\n"
    "    vec4 far = unprojection * vec4(at, 1.0, 1.0);\n"
    CLOUDS
    "    gl_FragColor = vec4(0.2, 0.3, 0.3 + 0.5 * band, 1.0 + 0.0 * projection[0][0]);\n"
    "}\n";
static const char *const sky_fragment_330 =
    "#version 330 core\n"
    CAMERA
    "uniform vec4 screen;\n"
    "out vec4 shown;\n"
    "void main()\n"
    "{\n"
    "    vec2 at = (gl_FragCoord.xy - screen.xy) / screen.zw * 2.0 - 1.0;\n"
    "    vec4 far = camera.unprojection * vec4(at, 1.0, 1.0);\n"
    CLOUDS
    "    shown = vec4(0.2, 0.3, 0.3 + 0.5 * band, 1.0);\n"
    "}\n";

static const char *const box_vertex_120 =
    "#version 120\n"
    "attribute vec3 position;\n"
    "uniform mat4 projection, modelview;\n"
    "varying vec3 way;\n"
    "void main()\n"
    "{\n"
    "    way = position;\n"
    "    gl_Position = projection * modelview * vec4(position, 1.0);\n"
    "}\n";
static const char *const box_vertex_combined =
    "#version 120\n"
    "attribute vec3 position;\n"
    "uniform mat4 everything;\n"
    "varying vec3 way;\n"
    "void main()\n"
    "{\n"
    "    way = position;\n"
    "    gl_Position = everything * vec4(position, 1.0);\n"
    "}\n";
static const char *const box_vertex_330 =
    "#version 330 core\n"
    CAMERA
    "layout(location = 0) in vec3 position;\n"
    "out vec3 way;\n"
    "void main()\n"
    "{\n"
    "    way = position;\n"
    "    gl_Position = (camera.projection * mat4(mat3(camera.view)) * vec4(position, 1.0)).xyww;\n"
    "}\n";
#define STARS \
    "    vec3 ray = normalize(way);\n" \
    "    float band = 0.5 + 0.5 * sin(24.0 * ray.x) * sin(24.0 * ray.y);\n"
static const char *const box_fragment_120 =
    "#version 120\n"
    "varying vec3 way;\n"
    "void main()\n"
    "{\n"
    STARS
    "    gl_FragColor = vec4(0.2, 0.3, 0.3 + 0.5 * band, 1.0);\n"
    "}\n";
static const char *const box_fragment_330 =
    "#version 330 core\n"
    "in vec3 way;\n"
    "out vec4 shown;\n"
    "void main()\n"
    "{\n"
    STARS
    "    shown = vec4(0.2, 0.3, 0.3 + 0.5 * band, 1.0);\n"
    "}\n";

enum { SLICES = 48, STACKS = 24, QUAD = 4, TRIANGLE = 3, BOX = 36 };
static GLuint program, heaven, buffer, indices, block;
static GLsizei count;

void demo_setup(void)
{
    GLfloat(*v)[6] = calloc((SLICES + 1) * (STACKS + 1) + QUAD + TRIANGLE + BOX, sizeof *v);
    GLushort *i = malloc(sizeof *i * 6 * SLICES * STACKS), *o = i;
    if (!v || !i)
        demo_fail(1, "out of memory");
    if (version != 120 && version != 330)
        demo_fail(2, "--glsl: 120 or 330");
    for (int s = 0; s <= SLICES; s++)
        for (int t = 0; t <= STACKS; t++) {
            double a = 2.0 * M_PI * (s % SLICES) / SLICES, b = 2.0 * M_PI * (t % STACKS) / STACKS;
            double x = cos(b) * cos(a), y = cos(b) * sin(a), z = sin(b);
            GLfloat *p = v[s * (STACKS + 1) + t];
            p[0] = (GLfloat)(cos(a) + 0.4 * x), p[1] = (GLfloat)(sin(a) + 0.4 * y), p[2] = (GLfloat)(0.4 * z);
            p[3] = (GLfloat)x, p[4] = (GLfloat)y, p[5] = (GLfloat)z;
        }
    for (int s = 0; s < SLICES; s++)
        for (int t = 0; t < STACKS; t++) {
            GLushort a = (GLushort)(s * (STACKS + 1) + t), b = (GLushort)(a + STACKS + 1);
            GLushort six[6] = {a, b, (GLushort)(b + 1), a, (GLushort)(b + 1), (GLushort)(a + 1)};
            memcpy(o, six, sizeof six);
            o += 6;
        }
    count = (GLsizei)(o - i);
    for (int c = 0; c < QUAD; c++) {
        GLfloat *p = v[(SLICES + 1) * (STACKS + 1) + c];
        p[0] = c == 1 || c == 2 ? 1.0f : -1.0f, p[1] = c >= 2 ? 1.0f : -1.0f, p[2] = 0.0f;
        p[3] = p[4] = 0.0f, p[5] = 1.0f;
    }
    for (int c = 0; c < TRIANGLE; c++) {
        GLfloat *p = v[(SLICES + 1) * (STACKS + 1) + QUAD + c];
        p[0] = c == 1 ? 3.0f : -1.0f, p[1] = c == 2 ? 3.0f : -1.0f;
    }
    for (int c = 0; c < BOX; c++) {
        static const int corners[6] = {0, 1, 2, 2, 1, 3};
        GLfloat *p = v[(SLICES + 1) * (STACKS + 1) + QUAD + TRIANGLE + c];
        int side = c / 6, corner = corners[c % 6], axis = side / 2;
        p[axis] = side % 2 ? 1.0f : -1.0f;
        p[(axis + 1) % 3] = corner & 1 ? 1.0f : -1.0f;
        p[(axis + 2) % 3] = corner & 2 ? 1.0f : -1.0f;
    }
    if (version == 330) {
        GLuint arrays;
        glGenVertexArrays(1, &arrays);
        glBindVertexArray(arrays);
    }
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(sizeof *v * ((SLICES + 1) * (STACKS + 1) + QUAD + TRIANGLE + BOX)), v, GL_STATIC_DRAW);
    glGenBuffers(1, &indices);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)sizeof *i * count, i, GL_STATIC_DRAW);
    free(v);
    free(i);
    program = demo_program(version == 330 ? vertex_330 : apart ? vertex_apart : combined ? vertex_combined : vertex_120,
                           version == 330 ? fragment_330 : fragment_120);
    if (sky)
        heaven = demo_program(version == 330 ? sky_vertex_330 : sky_vertex_120, version == 330 ? sky_fragment_330 : sky_fragment_120);
    if (box)
        heaven = demo_program(version == 330 ? box_vertex_330 : combined ? box_vertex_combined : box_vertex_120,
                              version == 330 ? box_fragment_330 : box_fragment_120);
    if (version == 330) {
        glGenBuffers(1, &block);
        glUniformBlockBinding(program, glGetUniformBlockIndex(program, "Camera"), 3);
        if (heaven)
            glUniformBlockBinding(heaven, glGetUniformBlockIndex(heaven, "Camera"), 3);
        glBindBufferBase(GL_UNIFORM_BUFFER, 3, block);
    }
    glEnableVertexAttribArray(0);
    glEnableVertexAttribArray(1);
    glVertexAttribPointer(0, 3, GL_FLOAT, 0, 24, (void *)0);
    glVertexAttribPointer(1, 3, GL_FLOAT, 0, 24, (void *)12);
    glClearColor(0.12f, 0.13f, 0.2f, 1.0f);
}

static GLint at(const char *name) { return glGetUniformLocation(program, name); }

/* Sets the uniforms of a projection, a camera and a model. */
static void load(const demo_matrix projection, const demo_matrix view, const demo_matrix model)
{
    demo_matrix mv, all;
    if (version == 330) {
        GLfloat camera[52] = {3.0f, 6.0f, 2.0f, 1.0f};
        memcpy(camera + 4, projection, sizeof(demo_matrix));
        memcpy(camera + 20, view, sizeof(demo_matrix));
        demo_inverse(camera + 36, projection);
        glBindBuffer(GL_UNIFORM_BUFFER, block);
        glBufferData(GL_UNIFORM_BUFFER, sizeof camera, camera, GL_STREAM_DRAW);
        glUniformMatrix4fv(at("model"), 1, 0, model);
        return;
    }
    demo_times(mv, view, model);
    if (apart) {
        static const char *const rows[3] = {"right", "up", "back"};
        for (int row = 0; row < 3; row++)
            glUniform4f(at(rows[row]), mv[row], mv[4 + row], mv[8 + row], mv[12 + row]);
        glUniform4f(at("lens"), projection[0], projection[5], projection[10], projection[14]);
        glUniform4f(at("skew"), projection[8], projection[12], projection[11], projection[15]);
        return;
    }
    demo_times(all, projection, mv);
    glUniformMatrix4fv(at("modelview"), 1, 0, mv);
    glUniformMatrix4fv(at(combined ? "everything" : "projection"), 1, 0, combined ? all : projection);
}

static void draw_sky(const demo_matrix projection)
{
    demo_matrix back;
    glUseProgram(heaven);
    glUniform4f(glGetUniformLocation(heaven, "screen"), (GLfloat)demo_x, (GLfloat)demo_y, (GLfloat)demo_width, (GLfloat)demo_height);
    if (version == 120) {
        demo_inverse(back, projection);
        glUniformMatrix4fv(glGetUniformLocation(heaven, "projection"), 1, 0, projection);
        glUniformMatrix4fv(glGetUniformLocation(heaven, "unprojection"), 1, 0, back);
    }
    glDepthFunc(GL_LEQUAL);
    glDrawArrays(GL_TRIANGLES, (SLICES + 1) * (STACKS + 1) + QUAD, TRIANGLE);
    glDepthFunc(GL_LESS);
    glUseProgram(program);
}

static void draw_box(double t)
{
    demo_matrix projection, view, all;
    demo_frustum(projection, 40.0, (double)demo_width / demo_height, 1.0, 50.0);
    demo_view_sky(projection);
    demo_turned(view, 0.15 + 0.2 * t, 0.6, 0.8, 0.0, 0.0, 0.0);
    glUseProgram(heaven);
    if (version == 330) {
        GLfloat camera[52] = {0};
        memcpy(camera + 4, projection, sizeof(demo_matrix));
        view[12] = 3.0f;
        memcpy(camera + 20, view, sizeof(demo_matrix));
        glBufferData(GL_UNIFORM_BUFFER, sizeof camera, camera, GL_STREAM_DRAW);
    } else if (combined) {
        demo_times(all, projection, view);
        glUniformMatrix4fv(glGetUniformLocation(heaven, "everything"), 1, 0, all);
    } else {
        glUniformMatrix4fv(glGetUniformLocation(heaven, "projection"), 1, 0, projection);
        glUniformMatrix4fv(glGetUniformLocation(heaven, "modelview"), 1, 0, view);
    }
    glDepthFunc(GL_LEQUAL);
    glDepthMask(version == 330);
    glDrawArrays(GL_TRIANGLES, (SLICES + 1) * (STACKS + 1) + QUAD + TRIANGLE, BOX);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glUseProgram(program);
}

void demo_frame(int frame)
{
    double t = demo_time(frame);
    demo_matrix plain = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, projection, view, model;
    demo_viewport(0, 0, demo_width, demo_height);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glUseProgram(program);
    if (orthographic) {
        double wide = 3.5 * demo_width / demo_height;
        demo_matrix flat = {(GLfloat)(1.0 / wide), 0, 0, 0, 0, 1.0f / 3.5f, 0, 0, 0, 0, -1.0f / 20.0f, 0, 0, 0, 0, 1};
        memcpy(projection, flat, sizeof flat);
        demo_view_slanted(projection);
    } else {
        demo_frustum(projection, 40.0, (double)demo_width / demo_height, 1.0, 50.0);
        demo_view(projection);
    }
    if (sky && version == 120)
        draw_sky(projection);
    if (box && version == 120)
        draw_box(t);
    glUniform1f(at("steps"), toon ? 3.0f : 0.0f);
    glUniform1f(at("unlit"), 0.0f);
    glUniform1f(at("size"), 1.0f);
    demo_turned(view, 0.15, 0.6, 0.8, 0.0, -0.3, -8.5);
    for (int k = 0; k < 5; k++) {
        demo_turned(model, t + 1.3 * k, 0.6, 0.8, 1.9 * (k - 2), 0.9 * sin(1.9 * k), -2.5 * (k % 3) + 2.0);
        load(projection, view, model);
        glUniform4f(at("colour"), (GLfloat)(0.55 + 0.4 * sin(1.1 * k)), (GLfloat)(0.55 + 0.4 * sin(1.1 * k + 2.0)), 0.7f, 1.0f);
        glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_SHORT, (void *)0);
    }
    if (sky && version == 330)
        draw_sky(projection);
    if (box && version == 330)
        draw_box(t);
    /* The display: no depth, no perspective. */
    glDisable(GL_DEPTH_TEST);
    glUniform1f(at("unlit"), 1.0f);
    glUniform1f(at("size"), 0.1f);
    for (int k = 0; k < 4; k++) {
        memcpy(model, plain, sizeof model);
        model[12] = (GLfloat)(-0.75 + 0.5 * k);
        model[13] = -0.82f;
        load(plain, plain, model);
        glUniform4f(at("colour"), 0.9f, (GLfloat)(0.3 + 0.15 * k), 0.25f, 1.0f);
        glDrawArrays(GL_TRIANGLE_FAN, (SLICES + 1) * (STACKS + 1), QUAD);
    }
    glUseProgram(0);
}
