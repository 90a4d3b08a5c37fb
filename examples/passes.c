/* Draws like modern renderers, first into framebuffers of its own: a shadow map, a G-buffer, ambient occlusion at half size, light in half
 * floats, glows added in a forward pass, bloom, and tone mapping to the window; then a flat display. GLSL 3.30 core, the camera in a uniform
 * block, no fixed function. No fragment shader uses a projection. OpenGL ES 3.2 can do all of it. */
#include "demo.h"
#include "passes/texts.h"
#include <math.h>
#include <stddef.h>

static int copy, depth_blit, from_depth, mipmap, screen_blit, samples;
const struct demo_option demo_options[] = {
    {"--copy", "a glass ball that bends a copy of the picture (glCopyTexSubImage2D)", &copy, 0},
    {"--from-depth", "positions are computed from the depths, by the inverse of the projection", &from_depth, 0},
    {"--depth-blit", "the light has a depth buffer of its own, a copy of the G-buffer's", &depth_blit, 0},
    {"--mipmap", "bloom gets from half to quarter size by glGenerateMipmap, not by a blit", &mipmap, 0},
    {"--screen-blit", "tone mapping into a texture that is blitted to the window", &screen_blit, 0},
    {"--samples-inside", "no G-buffer: drawn forward with N samples, then resolved", &samples, 1},
    {0}};

enum { TORUS, SPHERE, BOX, SHAPES, SLICES = 48, STACKS = 24, MAP = 512 };
struct thing {
    int shape;
    GLfloat colour[4]; /* with the strength of its glow in alpha */
    double x, y, z, size[3], tilt, angle, spin;
};
static const struct thing solid[] = {
    {BOX, {0.47f, 0.43f, 0.40f, 0.0f}, 0.0, -1.55, -1.0, {9.0, 0.15, 8.0}, 0.0, 0.0, 0.0},
    {TORUS, {0.86f, 0.31f, 0.21f, 0.0f}, -1.9, 0.0, -0.6, {0.95, 0.95, 0.95}, 0.9, 0.4, 0.7},
    {TORUS, {1.00f, 0.31f, 0.05f, 0.8f}, 1.75, 0.35, 0.3, {0.42, 0.42, 0.42}, 0.4, 0.7, -1.1},
    {SPHERE, {0.24f, 0.62f, 0.34f, 0.0f}, -0.85, -0.87, 2.4, {0.53, 0.53, 0.53}, 0.0, 0.0, 0.0},
    {SPHERE, {0.81f, 0.77f, 0.66f, 0.0f}, 0.35, -0.5, -1.9, {0.9, 0.9, 0.9}, 0.0, 0.0, 0.0},
    {BOX, {0.28f, 0.41f, 0.82f, 0.0f}, 1.55, -0.98, 1.9, {0.42, 0.42, 0.42}, 0.0, 0.6, 0.5},
    {BOX, {0.71f, 0.56f, 0.27f, 0.0f}, 2.75, -0.2, -1.6, {0.37, 1.2, 0.37}, 0.0, 0.3, 0.0},
    {BOX, {0.62f, 0.52f, 0.57f, 0.0f}, -3.3, 0.1, -4.3, {0.34, 1.5, 0.34}, 0.0, 0.2, 0.0},
    {BOX, {0.62f, 0.52f, 0.57f, 0.0f}, -0.9, 0.1, -5.6, {0.34, 1.5, 0.34}, 0.0, 0.5, 0.0},
    {BOX, {0.62f, 0.52f, 0.57f, 0.0f}, 1.9, 0.1, -5.6, {0.34, 1.5, 0.34}, 0.0, 0.8, 0.0},
    {TORUS, {0.22f, 0.66f, 0.71f, 0.0f}, 1.35, 1.1, 3.3, {0.24, 0.24, 0.3}, 0.9, 0.8, 1.3}};
static const struct thing glows[] = { /* with the exponent of their rims */
    {SPHERE, {0.12f, 0.44f, 1.10f, 2.0f}, -2.15, 1.15, 1.9, {0.45, 0.45, 0.45}, 0.0, 0.0, 0.0},
    {SPHERE, {0.90f, 0.20f, 0.62f, 1.5f}, 0.5, 1.5, -3.8, {0.8, 0.8, 0.8}, 0.0, 0.0, 0.0},
    {TORUS, {0.24f, 0.52f, 0.13f, 0.9f}, 0.35, -0.35, -1.9, {0.95, 0.95, 0.2}, 1.2, 1.3, 0.4}};
static const struct thing glass = {SPHERE, {0.90f, 0.97f, 0.93f, 0.8f}, 0.05, 0.5, 2.6, {0.62, 0.62, 0.62}, 0.0, 0.0, 0.0};

static GLuint programs[PROGRAMS], used, scene_arrays, no_arrays, block, first[SHAPES + 1];
static GLuint albedo, normals, positions, open_sky, shadows, depths, light, before, bright, quarter[2], final;
static GLuint shadow_target, geometry_target, position_target, open_target, light_target, samples_target, bright_target, quarter_target[2], final_target;

/* ---- set up ---- */

static void surface(int shape, double s, double t, GLfloat p[6])
{
    double a = 2.0 * M_PI * s, b = 2.0 * M_PI * (shape == TORUS ? t : 0.5 * t - 0.25);
    double n[3] = {cos(b) * cos(a), cos(b) * sin(a), sin(b)}, out[3] = {n[0], n[1], n[2]};
    if (shape == TORUS)
        out[0] = cos(a) + 0.4 * n[0], out[1] = sin(a) + 0.4 * n[1], out[2] = 0.4 * n[2];
    if (shape >= BOX) { /* a box has a range per face */
        int face = shape - BOX, axis = face % 3;
        double side = face < 3 ? 1.0 : -1.0;
        n[0] = n[1] = n[2] = 0.0;
        out[axis] = n[axis] = side, out[(axis + 1) % 3] = side * (2.0 * s - 1.0), out[(axis + 2) % 3] = 2.0 * t - 1.0;
    }
    for (int k = 0; k < 3; k++)
        p[k] = (GLfloat)out[k], p[3 + k] = (GLfloat)n[k];
}

static void make_shapes(void)
{
    enum { MOST = 2 * (SLICES + 1) * (STACKS + 1) + 24, MOST_INDICES = 12 * SLICES * STACKS + 36 };
    static GLfloat v[MOST][6];
    static GLushort i[MOST_INDICES];
    GLuint vertices = 0, indices = 0, buffers[2];
    for (int shape = 0; shape < BOX + 6; shape++) {
        int slices = shape < BOX ? SLICES : 1, stacks = shape < BOX ? STACKS : 1;
        if (shape <= BOX)
            first[shape] = indices;
        for (int s = 0; s < slices; s++)
            for (int t = 0; t < stacks; t++) {
                GLuint a = vertices + (GLuint)(s * (stacks + 1) + t), b = a + (GLuint)stacks + 1;
                GLuint six[6] = {a, b, b + 1, a, b + 1, a + 1};
                for (int k = 0; k < 6; k++)
                    i[indices++] = (GLushort)six[k];
            }
        for (int s = 0; s <= slices; s++)
            for (int t = 0; t <= stacks; t++)
                surface(shape, shape < BOX ? (double)(s % slices) / slices : s, (double)t / stacks, v[vertices++]);
    }
    first[SHAPES] = indices;
    glGenVertexArrays(1, &no_arrays);
    glGenVertexArrays(1, &scene_arrays);
    glBindVertexArray(scene_arrays);
    glGenBuffers(2, buffers);
    glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    glBufferData(GL_ARRAY_BUFFER, sizeof v, v, GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof i, i, GL_STATIC_DRAW);
    glEnableVertexAttribArray(0);
    glEnableVertexAttribArray(1);
    glVertexAttribPointer(0, 3, GL_FLOAT, 0, 24, (void *)0);
    glVertexAttribPointer(1, 3, GL_FLOAT, 0, 24, (void *)12);
}

static GLuint texture(GLint format, int width, int height)
{
    GLenum kind = format == GL_DEPTH_COMPONENT24 ? GL_DEPTH_COMPONENT : format == GL_R8 ? GL_RED : GL_RGBA;
    GLenum type = kind == GL_DEPTH_COMPONENT ? GL_UNSIGNED_INT : format == GL_RGBA16F ? GL_FLOAT : GL_UNSIGNED_BYTE;
    GLuint name;
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, kind, type, NULL);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return name;
}

static GLuint renderbuffer(GLenum format, int of)
{
    GLuint name;
    glGenRenderbuffers(1, &name);
    glBindRenderbuffer(GL_RENDERBUFFER, name);
    if (of)
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, of, format, demo_width, demo_height);
    else
        glRenderbufferStorage(GL_RENDERBUFFER, format, demo_width, demo_height);
    return name;
}

/* A framebuffer of up to three colours, and a depth where it is not 0: textures, or renderbuffers where it is multisampled. */
static GLuint framebuffer(const GLuint colours[3], GLuint depth, int of)
{
    GLenum buffers[3];
    GLuint name;
    int n = 0;
    glGenFramebuffers(1, &name);
    glBindFramebuffer(GL_FRAMEBUFFER, name);
    for (; n < 3 && colours[n]; n++) {
        buffers[n] = GL_COLOR_ATTACHMENT0 + (GLenum)n;
        if (of)
            glFramebufferRenderbuffer(GL_FRAMEBUFFER, buffers[n], GL_RENDERBUFFER, colours[n]);
        else
            glFramebufferTexture2D(GL_FRAMEBUFFER, buffers[n], GL_TEXTURE_2D, colours[n], 0);
    }
    if (depth && depth == depths)
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
    else if (depth)
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, depth);
    if (n) {
        glDrawBuffers(n, buffers);
    } else {
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, shadows, 0);
        glDrawBuffers(1, (const GLenum[]){GL_NONE});
        glReadBuffer(GL_NONE);
    }
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        demo_fail(1, "a framebuffer is not complete");
    return name;
}

static void use(int program) { glUseProgram(used = programs[program]); }
static GLint at(const char *name) { return glGetUniformLocation(used, name); }
static int half(int size) { return size > 1 ? size / 2 : 1; }

void demo_setup(void)
{
    int w = demo_width, h = demo_height;
    if (from_depth && (samples || depth_blit))
        demo_fail(2, "--from-depth: neither with --samples-inside nor with --depth-blit");
    if (samples && (copy || depth_blit))
        demo_fail(2, "--samples-inside: neither with --copy nor with --depth-blit");
    make_shapes();
    glGenBuffers(1, &block);
    glBindBufferBase(GL_UNIFORM_BUFFER, 2, block);
    for (int p = 0; p < PROGRAMS; p++) {
        programs[p] = demo_program(texts[p][0], texts[p][1]);
        use(p);
        for (int u = 0; u < UNITS; u++)
            glUniform1i(at(samplers[u]), u);
        glUniform2f(at("size"), (GLfloat)w, (GLfloat)h);
        GLuint camera = glGetUniformBlockIndex(used, "Camera");
        if (camera != GL_INVALID_INDEX)
            glUniformBlockBinding(used, camera, 2);
    }
    shadows = texture(GL_DEPTH_COMPONENT24, MAP, MAP);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    shadow_target = framebuffer((GLuint[3]){0}, 0, 0);
    light = texture(GL_RGBA16F, w, h);
    if (samples) {
        GLuint depth = renderbuffer(GL_DEPTH24_STENCIL8, samples);
        samples_target = framebuffer((GLuint[3]){renderbuffer(GL_RGBA16F, samples)}, depth, samples);
        light_target = framebuffer((GLuint[3]){light}, 0, 0);
    } else {
        GLuint depth = from_depth ? (depths = texture(GL_DEPTH_COMPONENT24, w, h)) : renderbuffer(GL_DEPTH24_STENCIL8, 0);
        if (from_depth) { /* OpenGL ES filters depths only with a comparison */
            glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
            glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        }
        albedo = texture(GL_RGBA8, w, h), normals = texture(GL_RGBA16F, w, h), positions = texture(GL_RGBA16F, w, h);
        geometry_target = framebuffer((GLuint[3]){albedo, normals, positions}, depth, 0);
        position_target = framebuffer((GLuint[3]){positions}, 0, 0);
        open_sky = texture(GL_R8, half(w), half(h));
        open_target = framebuffer((GLuint[3]){open_sky}, 0, 0);
        light_target = framebuffer((GLuint[3]){light}, depth_blit ? renderbuffer(GL_DEPTH24_STENCIL8, 0) : depth, 0);
        before = texture(GL_RGBA16F, w, h);
    }
    bright = texture(GL_RGBA16F, half(w), half(h));
    if (mipmap)
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
    bright_target = framebuffer((GLuint[3]){bright}, 0, 0);
    for (int k = 0; k < 2; k++) {
        quarter[k] = texture(GL_RGBA16F, half(half(w)), half(half(h)));
        quarter_target[k] = framebuffer((GLuint[3]){quarter[k]}, 0, 0);
    }
    final = texture(GL_RGBA8, w, h);
    final_target = framebuffer((GLuint[3]){final}, 0, 0);
}

/* ---- drawing ---- */

static void place(demo_matrix m, const struct thing *o, double t)
{
    demo_turned(m, o->angle + o->spin * t, sin(o->tilt), cos(o->tilt), o->x, o->y, o->z);
    for (int k = 0; k < 12; k++)
        m[k] = (GLfloat)(m[k] * o->size[k / 4]);
}

static void target(GLuint name, int width, int height)
{
    glBindFramebuffer(GL_FRAMEBUFFER, name);
    glViewport(0, 0, width, height);
}

static void input(int unit, GLuint name)
{
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    glBindTexture(GL_TEXTURE_2D, name);
}

static void blit(GLuint from, int w, int h, GLuint to, const GLint area[4], GLbitfield mask, GLenum filter)
{
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
    glBlitFramebuffer(0, 0, w, h, area[0], area[1], area[2], area[3], mask, filter);
}

static void draw(const struct thing *things, size_t count, double t)
{
    demo_matrix model;
    glBindVertexArray(scene_arrays);
    for (const struct thing *o = things; o < things + count; o++) {
        place(model, o, t);
        glUniformMatrix4fv(at("model"), 1, 0, model);
        glUniform4fv(at("colour"), 1, o->colour);
        glUniform1f(at("tiles"), o == solid ? 1.0f : 0.0f);
        glDrawElements(GL_TRIANGLES, (GLsizei)(first[o->shape + 1] - first[o->shape]), GL_UNSIGNED_SHORT,
                       (void *)(sizeof(GLushort) * first[o->shape]));
    }
}
#define DRAW(things, t) draw(things, sizeof things / sizeof *things, t)

/* One triangle over the whole viewport. */
static void cover(void)
{
    glBindVertexArray(no_arrays);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

/* Extracts bright pixels, scales them down and blurs them twice; the result is in quarter[0]. */
static void make_bloom(void)
{
    int w = half(demo_width), h = half(demo_height);
    const GLint quarter_size[4] = {0, 0, half(w), half(h)};
    target(bright_target, w, h);
    use(BRIGHT);
    input(PICTURE, light);
    cover();
    if (mipmap) {
        input(PICTURE, bright);
        glGenerateMipmap(GL_TEXTURE_2D);
    } else {
        blit(bright_target, w, h, quarter_target[0], quarter_size, GL_COLOR_BUFFER_BIT, GL_LINEAR);
    }
    use(BLUR);
    for (int k = 0; k < 4; k++) {
        target(quarter_target[1 - k % 2], half(w), half(h));
        input(PICTURE, mipmap && !k ? bright : quarter[k % 2]);
        glUniform1i(at("level"), mipmap && !k);
        glUniform2i(at("along"), k % 2 ? 0 : 1 + k / 2, k % 2 ? 1 + k / 2 : 0);
        cover();
    }
}

static void display(double t)
{
    GLfloat bar = (GLfloat)(0.12 + 0.1 * sin(1.7 * t));
    const GLfloat things[][8] = { /* centre, half size, colour */
        {-0.66f, -0.83f, 0.29f, 0.12f, 0.03f, 0.05f, 0.09f, 0.62f}, {-0.9f + bar, -0.785f, bar, 0.021f, 0.86f, 0.27f, 0.22f, 1.0f},
        {-0.7f, -0.843f, 0.2f, 0.021f, 0.27f, 0.72f, 0.42f, 1.0f}, {-0.76f, -0.901f, 0.14f, 0.013f, 0.87f, 0.77f, 0.31f, 1.0f},
        {0.003f, 0.004f, 0.031f, 0.004f, 0.93f, 0.94f, 0.88f, 0.83f}, {0.003f, 0.004f, 0.003f, 0.041f, 0.93f, 0.94f, 0.88f, 0.83f},
        {0.74f, 0.87f, 0.19f, 0.062f, 0.14f, 0.19f, 0.31f, 0.72f}, {0.63f, 0.87f, 0.03f, 0.033f, 0.93f, 0.62f, 0.18f, 1.0f},
        {0.74f, 0.87f, 0.03f, 0.033f, 0.93f, 0.62f, 0.18f, 1.0f}, {0.85f, 0.87f, 0.03f, 0.033f, 0.36f, 0.39f, 0.46f, 1.0f}};
    use(DISPLAY);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glBindVertexArray(scene_arrays);
    for (size_t k = 0; k < sizeof things / sizeof *things; k++) {
        glUniform4fv(at("rectangle"), 1, things[k]);
        glUniform4fv(at("colour"), 1, things[k] + 4);
        glDrawElements(GL_TRIANGLES, 6, GL_UNSIGNED_SHORT, (void *)(sizeof(GLushort) * (first[BOX] + 12))); /* its face +z */
    }
    glDisable(GL_BLEND);
}

void demo_frame(int frame)
{
    int w = demo_width, h = demo_height;
    double t = demo_time(frame);
    double eye[3] = {0.9 * sin(0.5 * t), 2.3 + 0.2 * sin(0.9 * t), 7.8}, centre[3] = {0.0, 0.0, 0.0};
    double lamp[3] = {-3.4 + sin(0.8 * t), 6.6, 4.2}, aim[3] = {0.0, -0.7, -0.6};
    const demo_matrix bias = {0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0.5f, 0, 0.5f, 0.5f, 0.5f, 1};
    const GLint whole[4] = {0, 0, w, h};
    demo_matrix back, lamp_view, lamp_back, shadow, from_lamp;
    struct { demo_matrix view, projection; GLfloat lamp[4], towards[4]; } camera;

    demo_look(camera.view, back, eye, centre);
    demo_look(lamp_view, lamp_back, lamp, aim);
    demo_frustum(camera.projection, 42.0, (double)w / h, 1.0, 60.0);
    demo_view(camera.projection);
    demo_times(from_lamp, camera.view, lamp_back);
    for (int k = 0; k < 4; k++)
        camera.lamp[k] = from_lamp[12 + k], camera.towards[k] = -from_lamp[8 + k];
    glBindBuffer(GL_UNIFORM_BUFFER, block);
    glBufferData(GL_UNIFORM_BUFFER, sizeof camera, &camera, GL_STREAM_DRAW);
    glDisable(GL_SCISSOR_TEST); /* the scissor rectangle is for the window */

    /* The lamp's view, which is no view of the picture. */
    demo_frustum(shadow, 68.0, 1.0, 3.0, 20.0);
    demo_times(shadow, shadow, lamp_view);
    target(shadow_target, MAP, MAP);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(2.0f, 4.0f);
    glClear(GL_DEPTH_BUFFER_BIT);
    use(SHADOW);
    glUniformMatrix4fv(at("light"), 1, 0, shadow);
    DRAW(solid, t);
    glDisable(GL_POLYGON_OFFSET_FILL);
    demo_times(shadow, bias, shadow);
    demo_times(shadow, shadow, back);
    input(SHADOWS, shadows);

    if (samples) {
        target(samples_target, w, h);
        glClear(GL_DEPTH_BUFFER_BIT);
        glDisable(GL_DEPTH_TEST);
        use(BACKGROUND);
        cover();
        glEnable(GL_DEPTH_TEST);
        use(FORWARD);
        glUniformMatrix4fv(at("shadow"), 1, 0, shadow);
        DRAW(solid, t);
    } else {
        const GLfloat nothing[2][4] = {{0}, {0.0f, 0.0f, -1000.0f, 0.0f}};
        target(geometry_target, w, h);
        for (GLint k = 0; k < 3; k++)
            glClearBufferfv(GL_COLOR, k, nothing[k == 2]);
        glClearBufferfi(GL_DEPTH_STENCIL, 0, 1.0f, 0);
        use(GEOMETRY);
        DRAW(solid, t);

        glDisable(GL_DEPTH_TEST);
        if (from_depth) {
            demo_matrix unproject;
            demo_inverse(unproject, camera.projection);
            target(position_target, w, h);
            use(DEPTHS);
            glUniformMatrix4fv(at("unproject"), 1, 0, unproject);
            input(DEEP, depths);
            cover();
        }
        target(open_target, half(w), half(h));
        use(OCCLUSION);
        input(NORMALS, normals);
        input(POSITIONS, positions);
        cover();

        target(light_target, w, h);
        use(LIGHTING);
        glUniformMatrix4fv(at("shadow"), 1, 0, shadow);
        input(ALBEDO, albedo);
        input(OPEN, open_sky);
        cover();
        if (depth_blit)
            blit(geometry_target, w, h, light_target, whole, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
        glBindFramebuffer(GL_FRAMEBUFFER, light_target);
        glEnable(GL_DEPTH_TEST);
    }

    /* Forward pass of glows, in front of the surfaces and behind them. */
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    use(GLOW);
    DRAW(glows, t);
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
    if (copy) {
        input(PICTURE, before);
        glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, w, h);
        use(GLASS);
        draw(&glass, 1, t);
    }
    if (samples)
        blit(samples_target, w, h, light_target, whole, GL_COLOR_BUFFER_BIT, GL_NEAREST);

    glDisable(GL_DEPTH_TEST);
    make_bloom();
    use(TONE);
    input(PICTURE, light);
    input(BLOOM, quarter[0]);
    if (screen_blit) {
        target(final_target, w, h);
        cover();
        demo_scissor_off();
        blit(final_target, w, h, 0, (GLint[]){demo_x, demo_y, demo_x + w, demo_y + h}, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        demo_viewport(0, 0, w, h);
    } else {
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        demo_scissor_off();
        demo_viewport(0, 0, w, h);
        glUniform2f(at("corner"), (GLfloat)demo_x, (GLfloat)demo_y);
        cover();
    }
    display(t);
    glBindVertexArray(0);
    glUseProgram(0);
}
