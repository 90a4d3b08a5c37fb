/* Cases of depth: surfaces through the plane of the camera, coplanar surfaces, other depth ranges, passes that have to match exactly. */
#include "hard.h"
#include <math.h>

/* Triangles from in front of the camera through its plane to far behind it. The sides of the first two nearly run along the sides of the
 * picture, where clipping is least certain. */
static void through_camera(double ratio)
{
    static const unsigned rgb[4] = {0xff4040, 0x40ff40, 0x4040ff, 0xffff40};
    static const double foot[4][2] = {{-0.79, -0.55}, {0.64, -0.5}, {0.1, 0.05}, {-0.3, 0.05}};
    static const double way[4][2] = {{0.8, 0.9}, {-0.8, 1}, {-0.3, -0.2}, {0.35, -0.25}};
    usual_frustum(0.1, 1000);
    for (int k = 0; k < 4; k++) {
        double d = 2 + k, x = foot[k][0] * d, y = foot[k][1] * d, far = ratio * d;
        start(GL_TRIANGLES);
        colour(rgb[k]);
        at(x, y, -d), at(x + 0.15 * d, y, -d), at(way[k][0] * far, way[k][1] * far, far);
        finish();
    }
}

static void draw_behind_1e3(int frame) { (void)frame; through_camera(1e3); }
static void draw_behind_1e4(int frame) { (void)frame; through_camera(1e4); }
static void draw_behind_1e6(int frame) { (void)frame; through_camera(1e6); }

/* ---- coplanar surfaces ---- */

static const double wall[4][3] = {{-3, -2, -4}, {5, -2, -16}, {-3, 2, -4}, {5, 2, -16}};

static void part(double s0, double t0, double s1, double t1, double out[4][3])
{
    const double s[4] = {s0, s1, s0, s1}, t[4] = {t0, t0, t1, t1};
    for (int k = 0; k < 4; k++) {
        for (int c = 0; c < 3; c++)
            out[k][c] = (1 - t[k]) * ((1 - s[k]) * wall[0][c] + s[k] * wall[1][c])
                        + t[k] * ((1 - s[k]) * wall[2][c] + s[k] * wall[3][c]);
    }
}

/* Decals in the plane of a slanting wall, kept in front by polygon offset alone. */
static void draw_decals(int frame)
{
    (void)frame;
    static const unsigned wall_rgb[2] = {0x806040, 0x907050}, decal_rgb[2] = {0x40c0ff, 0xffc040};
    usual_frustum(1, 100);
    glEnable(GL_DEPTH_TEST);
    patch(wall, 6, 4, wall_rgb);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(-1, -2);
    for (int k = 0; k < 4; k++) {
        double corner[4][3];
        part(0.06 + 0.23 * k, 0.1 + 0.07 * k, 0.24 + 0.23 * k, 0.8 - 0.03 * k, corner);
        patch(corner, 3, 5, decal_rgb);
    }
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDisable(GL_DEPTH_TEST);
}

/* A wedge in front of a slope that is pushed back by GL_POLYGON_OFFSET_FILL with a factor alone. The wedge sinks into the slope row by row, so
 * its visible green area measures the offset. Orthographic slopes have one slope everywhere. */
static void draw_offset_gauge(int frame)
{
    (void)frame;
    const double run = 40; /* the factor's range over the wedge's height */
    usual_frustum(1, 2000);
    glEnable(GL_DEPTH_TEST);
    start(GL_TRIANGLES); /* an invisible triangle in perspective, so that the cameras are known */
    at(5000, 0, -9), at(5001, 0, -9), at(5000, 1, -9);
    finish();
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(0, demo_width, 0, demo_height, 0, 256);
    glMatrixMode(GL_MODELVIEW);
    double w = demo_width, h = demo_height;
    /* A slope of depth 0.25 per pixel to the right: an offset of 1 is a quarter of a unit. */
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(20, 0);
    start(GL_TRIANGLE_FAN);
    colour(0x904040);
    at(0, 0, -20), at(w, 0, -20 - w / 4), at(w, h, -20 - w / 4), at(0, h, -20);
    finish();
    glDisable(GL_POLYGON_OFFSET_FILL);
    start(GL_TRIANGLE_FAN);
    colour(0x00ff00);
    at(0, 0, -20), at(w, 0, -20 - w / 4), at(w, h, -20 - w / 4 - run / 4), at(0, h, -20 - run / 4);
    finish();
    glDisable(GL_DEPTH_TEST);
}

/* ---- depth ranges ---- */

static void crossing(void)
{
    static const unsigned a[2] = {0xd04040, 0xe06060}, b[2] = {0x40d040, 0x60e060}, c[2] = {0x4040d0, 0x6060e0};
    const double first[4][3] = {{-4, -3, -3}, {6, -3, -30}, {-4, 3, -3}, {6, 3, -30}};
    const double second[4][3] = {{-6, -3, -25}, {3, -3, -4}, {-6, 3, -25}, {3, 3, -4}};
    const double third[4][3] = {{-5, -2.5, -3}, {5, -2.5, -3}, {-9, 6, -40}, {9, 6, -40}};
    patch(first, 5, 5, a);
    patch(second, 5, 5, b);
    patch(third, 6, 6, c);
}

/* Sets row 2 of a matrix with near plane n, by the depths at the near plane and at infinity. */
static void infinite(double n, double at_near, double at_infinity)
{
    /* z_clip / w = -p10 + p14 / w with w = -z_eye. */
    GLdouble p[16] = {1.25, 0, 0, 0, 0, 1 / 0.6, 0, 0, 0, 0, -at_infinity, -1, 0, 0, n * (at_near - at_infinity), 0};
    glMatrixMode(GL_PROJECTION);
    glLoadMatrixd(p);
    demo_projection_done();
    glMatrixMode(GL_MODELVIEW);
}

static void draw_reversed(int frame)
{
    (void)frame;
    infinite(0.5, 1, -1);
    glClearDepth(0);
    glClear(GL_DEPTH_BUFFER_BIT);
    glDepthFunc(GL_GREATER);
    glEnable(GL_DEPTH_TEST);
    crossing();
    glDisable(GL_DEPTH_TEST);
}

static void draw_infinite(int frame)
{
    (void)frame;
    infinite(0.5, -1, 1);
    glEnable(GL_DEPTH_TEST);
    crossing();
    glDisable(GL_DEPTH_TEST);
}

/* glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE) with depths from 1 to 0, where it is available. */
static void draw_zero_to_one(int frame)
{
    typedef void (APIENTRY *clip_control)(GLenum, GLenum);
    (void)frame;
    clip_control control = (clip_control)demo_proc("glClipControl");
    control(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    infinite(0.5, 1, 0);
    glClearDepth(0);
    glClear(GL_DEPTH_BUFFER_BIT);
    glDepthFunc(GL_GREATER);
    glEnable(GL_DEPTH_TEST);
    crossing();
    glDisable(GL_DEPTH_TEST);
    control(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
}

/* The depth range inverted and split in two: draws into its near part are in front of everything. */
static void draw_depth_range(int frame)
{
    (void)frame;
    usual_frustum(0.5, 1e6);
    glClearDepth(0);
    glClear(GL_DEPTH_BUFFER_BIT);
    glDepthFunc(GL_GREATER);
    glEnable(GL_DEPTH_TEST);
    glDepthRange(0.5, 0);
    crossing();
    glDepthRange(1, 0.5);
    glTranslated(1, 0.5, -20);
    glScaled(0.7, 0.7, 0.7);
    crossing();
    glDepthRange(0, 1);
    glDisable(GL_DEPTH_TEST);
}

/* ---- passes ---- */

static GLuint list, program;
static const unsigned red[2] = {0xff0000, 0xff0000}, green[2] = {0x00ff00, 0x00ff00};
static const double slope[4][3] = {{-5, -4, -3.3}, {9, -3, -27.7}, {-7, 3.1, -9.1}, {5, 6, -19}};

static void setup_passes(void)
{
    list = glGenLists(1);
    glNewList(list, GL_COMPILE);
    patch(slope, 5, 4, green);
    glEndList();
}

static void before_passes(void)
{
    usual_frustum(1, 100);
    glRotated(3, 1, 2, 3);
    glEnable(GL_DEPTH_TEST);
    patch(slope, 5, 4, red);
    glDepthFunc(GL_EQUAL);
}

static void after_passes(void)
{
    glDepthFunc(GL_LESS);
    glDisable(GL_DEPTH_TEST);
}

/* Red pixels show where the second pass has missed the first. */
static void draw_equal_arrays(int frame)
{
    (void)frame;
    before_passes();
    patch(slope, 5, 4, green);
    after_passes();
}

static void draw_equal_immediate(int frame)
{
    (void)frame;
    before_passes();
    send_immediate(1);
    patch(slope, 5, 4, green);
    send_immediate(0);
    after_passes();
}

static void draw_equal_list(int frame)
{
    (void)frame;
    before_passes();
    glCallList(list);
    after_passes();
}

/* ftransform() has to give the position of fixed function. */
static void setup_program(void)
{
    PFNGLCREATESHADERPROC create = (PFNGLCREATESHADERPROC)demo_proc("glCreateShader");
    PFNGLSHADERSOURCEPROC source = (PFNGLSHADERSOURCEPROC)demo_proc("glShaderSource");
    PFNGLCOMPILESHADERPROC compile = (PFNGLCOMPILESHADERPROC)demo_proc("glCompileShader");
    PFNGLCREATEPROGRAMPROC make = (PFNGLCREATEPROGRAMPROC)demo_proc("glCreateProgram");
    PFNGLATTACHSHADERPROC attach = (PFNGLATTACHSHADERPROC)demo_proc("glAttachShader");
    PFNGLLINKPROGRAMPROC link = (PFNGLLINKPROGRAMPROC)demo_proc("glLinkProgram");
    static const char *const text[2] = {"void main() { gl_Position = ftransform(); gl_FrontColor = gl_Color; }",
                                        "void main() { gl_FragColor = gl_Color; }"};
    program = make();
    for (int k = 0; k < 2; k++) {
        GLuint shader = create(k ? GL_FRAGMENT_SHADER : GL_VERTEX_SHADER);
        source(shader, 1, &text[k], NULL);
        compile(shader);
        attach(program, shader);
    }
    link(program);
}

static void draw_equal_program(int frame)
{
    (void)frame;
    PFNGLUSEPROGRAMPROC use = (PFNGLUSEPROGRAMPROC)demo_proc("glUseProgram");
    before_passes();
    use(program);
    patch(slope, 5, 4, green);
    use(0);
    after_passes();
}

/* Six clip planes of the program's own beside those that keep views apart. */
static void draw_clip_planes(int frame)
{
    (void)frame;
    static const unsigned tiles[2] = {0xe0c060, 0x3060a0};
    const double sheet[4][3] = {{-20, -12, -4}, {20, -12, -12}, {-20, 12, -12}, {20, 12, -30}};
    usual_frustum(1, 100);
    glEnable(GL_DEPTH_TEST);
    for (int k = 0; k < 6; k++) {
        double turn = k * M_PI / 3 + 0.2;
        const GLdouble plane[4] = {cos(turn), sin(turn), 0.05, 6 + 0.5 * k};
        glClipPlane(GL_CLIP_PLANE0 + (GLenum)k, plane);
        glEnable(GL_CLIP_PLANE0 + (GLenum)k);
    }
    patch(sheet, 12, 9, tiles);
    for (int k = 0; k < 6; k++)
        glDisable(GL_CLIP_PLANE0 + (GLenum)k);
    glDisable(GL_DEPTH_TEST);
}

const struct hard_case depths_cases[] = {
    {"behind-1e3", "triangles through the plane of the camera to 1,000 times as far behind it", NULL, draw_behind_1e3},
    {"behind-1e4", "to 10,000 times as far", NULL, draw_behind_1e4},
    {"behind-1e6", "to 1,000,000 times as far", NULL, draw_behind_1e6},
    {"decals", "decals in the plane of a wall by polygon offset", NULL, draw_decals},
    {"offset-gauge", "an area as large as a polygon offset", NULL, draw_offset_gauge},
    {"reversed", "infinite projection, near depths largest", NULL, draw_reversed},
    {"infinite", "infinite projection", NULL, draw_infinite},
    {"zero-to-one", "glClipControl, depths from 1 to 0", NULL, draw_zero_to_one},
    {"depth-range", "glDepthRange turned round and in two parts", NULL, draw_depth_range},
    {"equal-arrays", "two passes with GL_EQUAL, from arrays", NULL, draw_equal_arrays},
    {"equal-immediate", "the second one by glBegin", NULL, draw_equal_immediate},
    {"equal-list", "the second one by a display list", setup_passes, draw_equal_list},
    {"equal-program", "the second one by a shader with ftransform()", setup_program, draw_equal_program},
    {"clip-planes", "six clip planes", NULL, draw_clip_planes},
    {0}};
