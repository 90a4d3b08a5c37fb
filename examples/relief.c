/* A landscape by the later stages of a program: quads refined by tessellation, or grass by a geometry shader, or both; trees and seeds are
 * points that a geometry shader expands to squares; water, a sky, a flat display. The camera is in plain uniforms: projection and view, or
 * (grass, water) only their product. */
#include "demo.h"
#include "relief/texts.h"
#include <math.h>
#include <string.h>

static int geometry, both, points;
const struct demo_option demo_options[] = {
    {"--geometry", "no tessellation: triangles, and a geometry shader grows grass on them (GLSL 3.30)", &geometry, 0},
    {"--both", "tessellation, then grass on what it makes", &both, 0},
    {"--points", "with trees and seeds, squares that a geometry shader makes of points", &points, 0},
    {0}};

enum { SIDE = 96, CORNERS = (SIDE + 1) * (SIDE + 1), STEP = 4, TREES = 110, SEEDS = 140, RECTANGLES = 64 };
struct rectangle { GLfloat middle[2], half[2], colour[4]; };
static GLuint programs[PROGRAMS], used, land_arrays, point_arrays, flat_arrays, no_arrays, rectangles;
static GLsizei indices;
static int ground; /* the program that draws the ground */

static void use(int program) { glUseProgram(used = programs[program]); }
static GLint at(const char *name) { return glGetUniformLocation(used, name); }

/* ---- set up ---- */

/* 20 across and 22 away, from behind the camera: two triangles a square, or a patch for every STEP by STEP squares. */
static void make_land(void)
{
    static GLfloat v[CORNERS + 4][2];
    static GLushort list[6 * SIDE * SIDE];
    int step = geometry ? 1 : STEP;
    for (int z = 0; z <= SIDE; z++)
        for (int x = 0; x <= SIDE; x++) {
            v[z * (SIDE + 1) + x][0] = (GLfloat)(20.0 * x / SIDE - 10.0);
            v[z * (SIDE + 1) + x][1] = (GLfloat)(22.0 * z / SIDE - 15.0);
        }
    for (int z = 0; z < SIDE; z += step)
        for (int x = 0; x < SIDE; x += step) {
            GLushort a = (GLushort)(z * (SIDE + 1) + x), b = (GLushort)(a + step);
            GLushort d = (GLushort)(a + step * (SIDE + 1)), c = (GLushort)(d + step);
            GLushort patch[4] = {d, c, b, a}, triangles[6] = {d, c, b, d, b, a};
            memcpy(list + indices, geometry ? triangles : patch, geometry ? sizeof triangles : sizeof patch);
            indices += geometry ? 6 : 4;
        }
    for (int k = 0; k < 4; k++) /* and the water over the whole ground */
        v[CORNERS + k][0] = k % 2 ? 10.0f : -10.0f, v[CORNERS + k][1] = k < 2 ? 7.0f : -15.0f;
    glGenVertexArrays(1, &land_arrays);
    glBindVertexArray(land_arrays);
    demo_buffer(GL_ARRAY_BUFFER, v, sizeof v);
    demo_buffer(GL_ELEMENT_ARRAY_BUFFER, list, (size_t)indices * sizeof *list);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 2, GL_FLOAT, 0, sizeof *v, NULL);
}

static double noise(unsigned n) { n = (n ^ 61u) * 2654435761u; n = (n ^ n >> 15) * 2246822519u; return (n >> 8) / 16777216.0; }

static void make_points(void)
{
    static GLfloat v[TREES + SEEDS][4];
    for (unsigned k = 0; k < TREES + SEEDS; k++) {
        int tree = k < TREES;
        double size = tree ? 0.13 + 0.1 * noise(3 * k + 2) : 0.035 + 0.03 * noise(3 * k + 2);
        v[k][0] = (GLfloat)(tree ? 15.0 * noise(3 * k) - 7.5 : 9.0 * noise(3 * k) - 4.5);
        v[k][1] = (GLfloat)(tree ? 0.8 * size : 0.3 + 1.7 * noise(7 * k));
        v[k][2] = (GLfloat)(tree ? 4.0 - 14.0 * noise(3 * k + 1) : 5.0 - 10.0 * noise(3 * k + 1));
        v[k][3] = (GLfloat)size;
    }
    glGenVertexArrays(1, &point_arrays);
    glBindVertexArray(point_arrays);
    demo_buffer(GL_ARRAY_BUFFER, v, sizeof v);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 4, GL_FLOAT, 0, sizeof *v, NULL);
}

void demo_setup(void)
{
    if (geometry && both)
        demo_fail(2, "--geometry: not with --both");
    demo_needs(geometry ? 33 : 40);
    ground = geometry ? MEADOW : both ? BOTH : PATCHES;
    make_land();
    make_points();
    glGenVertexArrays(1, &no_arrays);
    glGenVertexArrays(1, &flat_arrays);
    glBindVertexArray(flat_arrays);
    rectangles = demo_buffer(GL_ARRAY_BUFFER, NULL, RECTANGLES * sizeof(struct rectangle));
    for (GLuint k = 0; k < 2; k++) {
        glEnableVertexAttribArray(k);
        glVertexAttribPointer(k, 4, GL_FLOAT, 0, sizeof(struct rectangle), (void *)(16 * (size_t)k));
        glVertexAttribDivisor(k, points ? 0 : 1);
    }
    for (int p = 0; p < PROGRAMS; p++)
        if (p <= BOTH ? p == ground : points ? p != FLAT : p != POINTS && p != DOTS)
            programs[p] = demo_stages(texts[p]);
    glBindVertexArray(0);
}

/* ---- drawing ---- */

static void display(double t)
{
    struct rectangle r[RECTANGLES] = {
        {{0.0f, 0.905f}, {0.46f, 0.06f}, {0.06f, 0.08f, 0.12f, 0.62f}},
        {{0.001f, 0.93f}, {0.004f, 0.033f}, {0.95f, 0.33f, 0.22f, 1.0f}},
        {{-0.83f, -0.69f}, {0.13f, 0.26f}, {0.06f, 0.08f, 0.12f, 0.62f}},
        {{0.003f, 0.004f}, {0.006f, 0.041f}, {0.95f, 0.92f, 0.81f, 0.83f}},
        {{0.003f, 0.004f}, {0.032f, 0.008f}, {0.95f, 0.92f, 0.81f, 0.83f}},
        {{0.72f, -0.87f}, {0.23f, 0.068f}, {0.06f, 0.08f, 0.12f, 0.62f}}};
    GLsizei n = 6;
    for (int k = 0; k < 19; k++) { /* a turning compass */
        double x = 0.05 * (k - 9) + 0.05 * (1.5 * t - floor(1.5 * t)) - 0.025;
        int small = (k + 80 - (int)floor(1.5 * t)) % 4;
        struct rectangle tick = {{(GLfloat)x, 0.885f}, {0.003f, small ? 0.012f : 0.03f}, {0.93f, 0.89f, 0.75f, 0.96f}};
        if (fabs(x) < 0.44)
            r[n++] = tick;
    }
    for (int k = 0; k < 12; k++) { /* two columns of lamps */
        int on = k / 2 < 3.0 + 2.4 * sin(1.9 * t + 2.0 * (k % 2));
        struct rectangle lamp = {{k % 2 ? -0.775f : -0.885f, (GLfloat)(-0.9 + 0.084 * (k / 2))}, {0.042f, 0.027f},
                                 {(GLfloat)(0.27 + 0.11 * (k / 2)), (GLfloat)(0.81 - 0.07 * (k / 2)), 0.27f, on ? 1.0f : 0.18f}};
        r[n++] = lamp;
    }
    for (int k = 0; k < 22; k++) { /* a depth sounder */
        GLfloat high = (GLfloat)(0.024 + 0.017 * sin(0.61 * k + 2.1 * t) + 0.008 * sin(1.7 * k - t));
        struct rectangle bar = {{(GLfloat)(0.51 + 0.02 * k), -0.93f + high}, {0.008f, high}, {0.31f, 0.77f, 0.84f, 0.93f}};
        r[n++] = bar;
    }
    glBindVertexArray(flat_arrays);
    glBindBuffer(GL_ARRAY_BUFFER, rectangles);
    glBufferData(GL_ARRAY_BUFFER, sizeof r, r, GL_STREAM_DRAW);
    use(points ? DOTS : FLAT);
    if (points)
        glDrawArrays(GL_POINTS, 0, n);
    else
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, n);
}

void demo_frame(int frame)
{
    double t = demo_time(frame);
    double eye[3] = {1.3 * sin(0.4 * t + 0.2), 2.5 + 0.2 * sin(0.6 * t), 6.9}, centre[3] = {0.2, 0.1, -0.6};
    demo_matrix projection, view, back, everything;

    demo_look(view, back, eye, centre);
    demo_frustum(projection, 42.0, (double)demo_width / demo_height, 0.7, 50.0);
    demo_view(projection);
    demo_times(everything, projection, view);
    for (int p = 0; p < PROGRAMS; p++)
        if (programs[p]) {
            use(p);
            glUniform1f(at("time"), (GLfloat)t);
            glUniform3f(at("from"), (GLfloat)eye[0], (GLfloat)eye[1], (GLfloat)eye[2]);
            glUniform3f(at("window"), (GLfloat)demo_x, (GLfloat)demo_y, (GLfloat)demo_height);
            glUniform1f(at("finest"), both ? 62.0f : 75.0f);
            glUniformMatrix4fv(at("projection"), 1, 0, projection);
            glUniformMatrix4fv(at("view"), 1, 0, view);
            glUniformMatrix4fv(at("everything"), 1, 0, everything);
        }
    demo_viewport(0, 0, demo_width, demo_height);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    use(SKY);
    glBindVertexArray(no_arrays);
    glDrawArrays(GL_TRIANGLES, 0, 3);

    glEnable(GL_DEPTH_TEST);
    use(ground);
    glBindVertexArray(land_arrays);
    if (!geometry)
        glPatchParameteri(GL_PATCH_VERTICES, 4);
    glDrawElements(geometry ? GL_TRIANGLES : GL_PATCHES, indices, GL_UNSIGNED_SHORT, NULL);
    if (points) {
        use(POINTS);
        glBindVertexArray(point_arrays);
        glUniform1i(at("seeds"), 0);
        glDrawArrays(GL_POINTS, 0, TREES);
    }
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    use(WATER);
    glBindVertexArray(land_arrays);
    glDrawArrays(GL_TRIANGLE_STRIP, CORNERS, 4);
    if (points) { /* they glow, so blending adds */
        use(POINTS);
        glDepthMask(GL_FALSE);
        glBlendFunc(GL_ONE, GL_ONE);
        glBindVertexArray(point_arrays);
        glUniform1i(at("seeds"), 1);
        glDrawArrays(GL_POINTS, TREES, SEEDS);
        glDepthMask(GL_TRUE);
        glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    }
    glDisable(GL_DEPTH_TEST);
    display(t);
    glBindVertexArray(0);
    glUseProgram(0);
}
