/* A crowd of small things by instancing: attributes with divisors 1 and 3, gl_InstanceID, base instances, draws whose parameters lie in
 * buffers; shadows, a tiled floor and a flat display with a map. GLSL 3.30 core, the camera in a uniform block. Every option draws exactly the
 * same picture in another way. */
#include "demo.h"
#include "crowd/places.h"
#include "crowd/texts.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static int indirect, multi, persistent, pulled;
const struct demo_option demo_options[] = {
    {"--indirect", "draws from a GL_DRAW_INDIRECT_BUFFER", &indirect, 0},
    {"--multi", "the floor by one glMultiDrawElementsBaseVertex", &multi, 0},
    {"--persistent", "instances are written into a buffer that stays mapped", &persistent, 0},
    {"--pulled", "the vertex shader finds places in a texture buffer", &pulled, 0},
    {0}};

enum { SLICES = 24, SIDE = 16, TILES = SIDE * SIDE, RECTANGLES = 40 };
struct corner { GLfloat place[3], normal[3]; };
struct command { GLuint numbers[5], unused[3]; }; /* so the stride is 32 */
struct rectangle { GLfloat middle[2], half[2], colour[4]; };

static GLuint programs[PROGRAMS], used, block, instances, trims, commands, rectangles;
static GLuint crowd_arrays, floor_arrays, flat_arrays;
static GLuint elements[SHADOW + 1], first[SHADOW + 1], corners[SHADOW + 1]; /* of each kind: indices or vertices, and the first of them */
static struct one *mapped; /* two halves, so that no frame overwrites what the last one still reads */
static GLsync fences[2];
static const GLfloat air[3] = {0.17f, 0.22f, 0.33f};

static void use(int program) { glUseProgram(used = programs[program]); }
static GLint at(const char *name) { return glGetUniformLocation(used, name); }

/* ---- set up ---- */

/* A profile (radius, height) rotated about the y axis; its indices begin at 0. */
static void turned(const double (*profile)[2], int n, int closed, struct corner *v, GLuint *vertices, GLushort *i, GLuint *indices)
{
    for (int s = 0; s <= SLICES; s++)
        for (int k = 0; k < n; k++) {
            int before = k ? k - 1 : closed ? n - 2 : k, after = k < n - 1 ? k + 1 : closed ? 1 : k;
            double a = 2.0 * M_PI * (s % SLICES) / SLICES, u = profile[after][0] - profile[before][0];
            double w = profile[after][1] - profile[before][1], far = sqrt(u * u + w * w), r = profile[k][0];
            struct corner c = {{(GLfloat)(r * cos(a)), (GLfloat)profile[k][1], (GLfloat)(r * sin(a))},
                               {(GLfloat)(w / far * cos(a)), (GLfloat)(-u / far), (GLfloat)(w / far * sin(a))}};
            v[(*vertices)++] = c;
            if (s < SLICES && k < n - 1) {
                GLushort p = (GLushort)(s * n + k), q = (GLushort)(p + n);
                GLushort six[6] = {p, (GLushort)(p + 1), q, q, (GLushort)(p + 1), (GLushort)(q + 1)};
                memcpy(i + *indices, six, sizeof six);
                *indices += 6;
            }
        }
}

static void attribute(GLuint index, GLint size, GLenum type, size_t stride, size_t offset, GLuint divisor)
{
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, size, type, type == GL_UNSIGNED_BYTE, (GLsizei)stride, (void *)offset);
    glVertexAttribDivisor(index, divisor);
}

static void make_shapes(void)
{
    static struct corner v[2000];
    static GLushort i[8000];
    double pawn[19][2] = {{0.0, 0.0}, {0.29, 0.0}, {0.32, 0.03}, {0.30, 0.09}, {0.22, 0.14}, {0.15, 0.26}, {0.11, 0.42}, {0.10, 0.53},
                          {0.19, 0.56}, {0.18, 0.60}, {0.09, 0.63}}, ring[13][2];
    for (int k = 0; k < 8; k++)
        pawn[11 + k][0] = 0.155 * cos(0.38 * k - 1.09), pawn[11 + k][1] = 0.77 + 0.155 * sin(0.38 * k - 1.09);
    for (int k = 0; k < 13; k++)
        ring[k][0] = 1.0 + 0.27 * cos(M_PI * k / 6.0), ring[k][1] = 0.27 * sin(M_PI * k / 6.0);
    pawn[18][0] = 0.0, pawn[18][1] = 0.925;
    GLuint vertices = 0, indices = 0;
    turned(pawn, 19, 0, v, &vertices, i, &indices);
    elements[PAWN] = indices;
    first[RING] = indices, corners[RING] = vertices;
    turned(ring, 13, 1, v, &vertices, i, &indices);
    elements[RING] = indices - first[RING];
    corners[GEM] = vertices; /* two six-sided pyramids, flat-shaded */
    for (int k = 0; k < 12; k++) {
        double side = k < 6 ? 1.0 : -1.0, a = M_PI / 3.0 * k, b = a + side * M_PI / 3.0, m = (a + b) / 2.0;
        struct corner c[3] = {{{0.0f, (GLfloat)side, 0.0f}, {0}}, {{(GLfloat)cos(b), 0.0f, (GLfloat)sin(b)}, {0}},
                              {{(GLfloat)cos(a), 0.0f, (GLfloat)sin(a)}, {0}}};
        for (int j = 0; j < 3; j++) {
            c[j].normal[0] = (GLfloat)(0.756 * cos(m)), c[j].normal[1] = (GLfloat)(0.655 * side);
            c[j].normal[2] = (GLfloat)(0.756 * sin(m));
            v[vertices++] = c[j];
        }
    }
    elements[GEM] = vertices - corners[GEM];
    corners[SHADOW] = vertices, elements[SHADOW] = 4; /* a square, also for the display */
    for (int k = 0; k < 4; k++)
        v[vertices++] = (struct corner){{k % 2 ? 1.0f : -1.0f, 0.0f, k < 2 ? 1.0f : -1.0f}, {0.0f, 1.0f, 0.0f}};

    glGenVertexArrays(1, &crowd_arrays);
    glBindVertexArray(crowd_arrays);
    demo_buffer(GL_ELEMENT_ARRAY_BUFFER, i, indices * sizeof *i);
    GLuint shapes = demo_buffer(GL_ARRAY_BUFFER, v, vertices * sizeof *v);
    attribute(0, 3, GL_FLOAT, sizeof *v, 0, 0);
    attribute(1, 3, GL_FLOAT, sizeof *v, 12, 0);
    glGenVertexArrays(1, &flat_arrays);
    glBindVertexArray(flat_arrays);
    glBindBuffer(GL_ARRAY_BUFFER, shapes);
    attribute(0, 3, GL_FLOAT, sizeof *v, 0, 0);
    rectangles = demo_buffer(GL_ARRAY_BUFFER, NULL, RECTANGLES * sizeof(struct rectangle));
    attribute(6, 4, GL_FLOAT, sizeof(struct rectangle), 0, 1);
    attribute(4, 4, GL_FLOAT, sizeof(struct rectangle), 16, 1);
}

/* Each tile has eight vertices of its own; the indices are the same for all. */
static void make_floor(void)
{
    static struct { struct corner c; GLubyte colour[4]; } v[TILES][8];
    static GLushort i[30] = {0, 2, 1, 0, 3, 2};
    for (int k = 0; k < 4; k++) {
        GLushort a = (GLushort)k, b = (GLushort)((k + 1) % 4), c = (GLushort)(b + 4), d = (GLushort)(a + 4), six[6] = {a, b, c, a, c, d};
        memcpy(i + 6 + 6 * k, six, sizeof six);
    }
    for (unsigned t = 0; t < TILES; t++)
        for (int k = 0; k < 8; k++) {
            double x = (int)(t % SIDE) - (SIDE - 1) / 2.0, z = (int)(t / SIDE) - (SIDE - 1) / 2.0, out = k < 4 ? 0.44 : 0.5;
            double u = k % 4 == 1 || k % 4 == 2 ? 1.0 : -1.0, w = k % 4 >= 2 ? 1.0 : -1.0, up = -0.06 * noise(t);
            int dark = (int)(t + t / SIDE) % 2;
            struct corner c = {{(GLfloat)(1.1 * (x + out * u)), (GLfloat)(k < 4 ? up : -0.13), (GLfloat)(1.1 * (z + out * w))},
                               {k < 4 ? 0.0f : (GLfloat)(0.67 * u), k < 4 ? 1.0f : 0.32f, k < 4 ? 0.0f : (GLfloat)(0.67 * w)}};
            v[t][k].c = c;
            hue(v[t][k].colour, 0.1 + 0.1 * noise(t + 1000), (dark ? 0.37 : 0.62) + 0.08 * noise(t + 500), 0.05);
        }
    glGenVertexArrays(1, &floor_arrays);
    glBindVertexArray(floor_arrays);
    demo_buffer(GL_ELEMENT_ARRAY_BUFFER, i, sizeof i);
    demo_buffer(GL_ARRAY_BUFFER, v, sizeof v);
    attribute(0, 3, GL_FLOAT, sizeof **v, 0, 0);
    attribute(1, 3, GL_FLOAT, sizeof **v, 12, 0);
    attribute(4, 4, GL_UNSIGNED_BYTE, sizeof **v, 24, 0);
}

/* Sets attributes by instance from instance `from` on, except where a draw adds it as its base instance. */
static void arrays(GLuint half, GLuint from)
{
    size_t begin = (half * CROWD + from) * sizeof(struct one);
    glBindBuffer(GL_ARRAY_BUFFER, instances);
    if (!pulled)
        attribute(2, 3, GL_FLOAT, sizeof(struct one), begin, 1);
    attribute(3, 3, GL_FLOAT, sizeof(struct one), begin + 12, 1);
    attribute(4, 4, GL_UNSIGNED_BYTE, sizeof(struct one), begin + 24, 1);
    glBindBuffer(GL_ARRAY_BUFFER, trims);
    attribute(5, 4, GL_UNSIGNED_BYTE, 4, from * 4, 3);
}

void demo_setup(void)
{
    static char text[2][8000];
    static GLubyte trim[CROWD][4];
    demo_needs(persistent ? 44 : indirect ? 43 : 42);
    make_shapes();
    make_floor();
    for (unsigned k = 0; k < CROWD; k++)
        hue(trim[k], 0.61803 * k, 0.62, 0.31);
    trims = demo_buffer(GL_ARRAY_BUFFER, trim, sizeof trim);
    if (persistent) {
        GLbitfield how = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
        GLsizeiptr size = 2 * CROWD * sizeof(struct one);
        glGenBuffers(1, &instances);
        glBindBuffer(GL_ARRAY_BUFFER, instances);
        glBufferStorage(GL_ARRAY_BUFFER, size, NULL, how);
        mapped = glMapBufferRange(GL_ARRAY_BUFFER, 0, size, how);
        if (!mapped)
            demo_fail(1, "glMapBufferRange gives nothing");
    } else {
        instances = demo_buffer(GL_ARRAY_BUFFER, NULL, CROWD * sizeof(struct one));
    }
    if (pulled) {
        GLuint texture;
        glGenTextures(1, &texture);
        glBindTexture(GL_TEXTURE_BUFFER, texture);
        glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, instances);
    }
    if (indirect) {
        struct command c[GROUPS] = {{{0}, {0}}};
        for (int g = 0; g < GROUPS; g++) {
            int kind = groups[g].kind;
            GLuint indexed[5] = {elements[kind], groups[g].count, first[kind], corners[kind], groups[g].from};
            GLuint plain[5] = {elements[kind], groups[g].count, corners[kind], groups[g].from, 0};
            memcpy(c[g].numbers, kind <= RING ? indexed : plain, sizeof plain);
        }
        commands = demo_buffer(GL_DRAW_INDIRECT_BUFFER, c, sizeof c);
    }
    block = demo_buffer(GL_UNIFORM_BUFFER, NULL, 36 * sizeof(GLfloat));
    glBindBufferBase(GL_UNIFORM_BUFFER, 1, block);
    for (int p = 0; p < PROGRAMS; p++) {
        for (int k = 0; k < 2; k++)
            snprintf(text[k], sizeof text[k], "#version 330 core\n%s%s", pulled ? "#define PULLED\n" : "", texts[p][k]);
        programs[p] = demo_program(text[0], text[1]);
        use(p);
        glUniform3fv(at("air"), 1, air);
        GLuint camera = glGetUniformBlockIndex(used, "Camera");
        if (camera != GL_INVALID_INDEX)
            glUniformBlockBinding(used, camera, 1);
    }
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glClearColor(air[0], air[1], air[2], 1.0f);
}

/* ---- drawing ---- */

static void draw_floor(void)
{
    static GLsizei counts[TILES];
    static const void *begins[TILES];
    static GLint bases[TILES];
    for (int t = 0; t < TILES; t++) {
        counts[t] = 30, bases[t] = 8 * t;
        if (!multi)
            glDrawElementsBaseVertex(GL_TRIANGLES, 30, GL_UNSIGNED_SHORT, NULL, bases[t]);
    }
    if (multi)
        glMultiDrawElementsBaseVertex(GL_TRIANGLES, counts, GL_UNSIGNED_SHORT, begins, TILES, bases);
}

static void draw_group(int g, GLuint half)
{
    int kind = groups[g].kind;
    GLenum mode = kind == SHADOW ? GL_TRIANGLE_STRIP : GL_TRIANGLES;
    GLsizei count = (GLsizei)elements[kind], n = (GLsizei)groups[g].count;
    GLuint from = groups[g].from;
    void *begin = (void *)(first[kind] * sizeof(GLushort)), *command = (void *)(g * sizeof(struct command));
    glUniform1i(at("kind"), kind);
    glUniform1i(at("first"), (GLint)(half * CROWD + from));
    if (indirect) {
        if (kind > RING)
            glDrawArraysIndirect(mode, command);
        else if (kind == PAWN || pulled) /* each group's command has its base instance */
            glDrawElementsIndirect(mode, GL_UNSIGNED_SHORT, command);
        else if (groups[g - 1].kind != kind)
            glMultiDrawElementsIndirect(mode, GL_UNSIGNED_SHORT, command, 2, sizeof(struct command));
    } else if (kind == PAWN) {
        glDrawElementsInstanced(mode, count, GL_UNSIGNED_SHORT, begin, n);
    } else if (kind == RING) {
        glDrawElementsInstancedBaseVertexBaseInstance(mode, count, GL_UNSIGNED_SHORT, begin, n, (GLint)corners[kind], from);
    } else {
        arrays(half, from);
        glDrawArraysInstanced(mode, (GLint)corners[kind], count, n);
        arrays(half, 0);
    }
}

static void display(double t, GLuint half, const double eye[3])
{
    struct rectangle r[RECTANGLES] = {
        {{-0.68f, -0.78f}, {0.28f, 0.17f}, {0.04f, 0.06f, 0.11f, 0.68f}}, {{0.76f, -0.7f}, {0.2f, 0.255f}, {0.04f, 0.06f, 0.11f, 0.76f}},
        {{0.76f, -0.452f}, {0.2f, 0.007f}, {0.92f, 0.77f, 0.38f, 1.0f}}, {{0.76f, -0.948f}, {0.2f, 0.007f}, {0.92f, 0.77f, 0.38f, 1.0f}},
        {{0.76f, -0.7f}, {0.003f, 0.236f}, {0.92f, 0.77f, 0.38f, 0.37f}}, {{0.76f, -0.7f}, {0.185f, 0.004f}, {0.92f, 0.77f, 0.38f, 0.37f}},
        {{(GLfloat)(0.76 + 0.185 * eye[0] / 7.0), -0.933f}, {0.012f, 0.016f}, {0.96f, 0.31f, 0.24f, 1.0f}},
        {{-0.88f, 0.87f}, {0.03f, 0.04f}, {0.93f, 0.46f, 0.22f, 1.0f}}, {{-0.801f, 0.87f}, {0.03f, 0.04f}, {0.93f, 0.46f, 0.22f, 1.0f}},
        {{-0.72f, 0.87f}, {0.03f, 0.04f}, {0.36f, 0.38f, 0.46f, 0.87f}}};
    GLsizei n = 10;
    for (int k = 0; k < 26; k++) {
        double high = 0.07 + 0.06 * sin(0.9 * k + 3.0 * t) * cos(0.37 * k - 1.3 * t);
        struct rectangle bar = {{(GLfloat)(-0.93 + 0.02 * k), (GLfloat)(-0.92 + high)}, {0.0073f, (GLfloat)high},
                                {(GLfloat)(0.23 + 0.0257 * k), 0.81f, (GLfloat)(0.87 - 0.023 * k), 0.94f}};
        r[n++] = bar;
    }
    use(FLAT);
    glUniform1f(at("time"), (GLfloat)t);
    glDisable(GL_DEPTH_TEST);
    glBindVertexArray(flat_arrays);
    glBindBuffer(GL_ARRAY_BUFFER, rectangles);
    glBufferData(GL_ARRAY_BUFFER, sizeof r, r, GL_STREAM_DRAW);
    glUniform4f(at("map"), 0.0f, 0.0f, 0.0f, 0.0f);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, (GLint)corners[SHADOW], 4, n);
    glBindVertexArray(crowd_arrays);
    glUniform4f(at("map"), 0.76f, -0.70f, 0.185f, 0.237f);
    glUniform1i(at("first"), (GLint)(half * CROWD));
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, (GLint)corners[SHADOW], 4, CROWD);
    glEnable(GL_DEPTH_TEST);
}

void demo_frame(int frame)
{
    static struct one now[CROWD];
    double t = demo_time(frame);
    double eye[3] = {2.6 * sin(0.4 * t - 0.5), 3.3 + 0.3 * sin(0.7 * t), 7.4}, centre[3] = {0.0, 0.75, 0.0};
    const double sun[3] = {-0.48, 0.72, 0.5};
    GLuint half = persistent ? (GLuint)frame % 2 : 0;
    struct { demo_matrix view, projection; GLfloat sun[4]; } camera = {.sun = {0}};
    demo_matrix back;

    if (persistent && fences[half]) {
        if (glClientWaitSync(fences[half], GL_SYNC_FLUSH_COMMANDS_BIT, 5000000000u) == GL_TIMEOUT_EXPIRED)
            demo_fail(1, "a frame takes more than 5 s");
        glDeleteSync(fences[half]);
    }
    move(persistent ? mapped + half * CROWD : now, t);
    if (!persistent) {
        glBindBuffer(GL_ARRAY_BUFFER, instances);
        glBufferSubData(GL_ARRAY_BUFFER, 0, sizeof now, now);
    }
    demo_look(camera.view, back, eye, centre);
    demo_frustum(camera.projection, 44.0, (double)demo_width / demo_height, 0.8, 40.0);
    demo_view(camera.projection);
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            camera.sun[r] += (GLfloat)(camera.view[4 * c + r] * sun[c]);
    glBindBuffer(GL_UNIFORM_BUFFER, block);
    glBufferData(GL_UNIFORM_BUFFER, sizeof camera, &camera, GL_STREAM_DRAW);

    demo_viewport(0, 0, demo_width, demo_height);
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    use(FLOOR);
    glBindVertexArray(floor_arrays);
    draw_floor();
    use(FIGURES);
    glUniform1f(at("time"), (GLfloat)t);
    glBindVertexArray(crowd_arrays);
    arrays(half, 0);
    for (int g = 0; g < GROUPS; g++) {
        if (groups[g].kind == SHADOW) { /* darkens the floor where no thing covers it */
            glEnable(GL_BLEND);
            glDepthMask(GL_FALSE);
        }
        draw_group(g, half);
    }
    glDepthMask(GL_TRUE);
    display(t, half, eye);
    if (persistent)
        fences[half] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    glBindVertexArray(0);
    glUseProgram(0);
}
