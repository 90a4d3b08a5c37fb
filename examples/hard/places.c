/* Cases of position: markers at known depths under all kinds of cameras. */
#include "hard.h"
#include <math.h>

/* The frustum of all cases here: |x| <= 0.8 and |y| <= 0.6 at depth 1. */
static const double A = 1.25, B = 1 / 0.6;
static const unsigned colours[] = {0xff0000, 0x00ff00, 0x0000ff, 0xffff00, 0xff00ff};

static void frustum(double z_near, double z_far)
{
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-z_near / A, z_near / A, -z_near / B, z_near / B, z_near, z_far);
}

static void scene_projection_done(void)
{
    demo_projection_done();
    glMatrixMode(GL_MODELVIEW);
}

/* Five markers at depths whose disparities keep them apart; they write depths, so that no rule takes them for a sky. */
static void five(const double depth[5], const double w[5])
{
    glEnable(GL_DEPTH_TEST);
    for (int k = 0; k < 5; k++)
        marker(colours[k], demo_width * (k + 0.5) / 5 + 0.37 * k, depth[k], w ? w[k] : 1, A, B);
    glDisable(GL_DEPTH_TEST);
}

static const double near_to_far[5] = {4, 6, 8, 20, 1000};

static void draw_depths(int frame)
{
    (void)frame;
    tell_lens(A);
    frustum(1, 2000);
    scene_projection_done();
    five(near_to_far, NULL);
}

static void draw_homogeneous(int frame)
{
    (void)frame;
    static const double w[5] = {2, 0.5, 1000, 1e-3, 3};
    tell_lens(A);
    frustum(1, 2000);
    scene_projection_done();
    five(near_to_far, w);
}

/* Sides of a shadow volume, from an occluder to infinity, counted in the stencil buffer, seen from the front. */
static void draw_extruded(int frame)
{
    (void)frame;
    static const double light[3] = {1, 3, -4};
    static const unsigned ground[2] = {0x808080, 0xa0a0a0}, occluder[2] = {0x4060c0, 0x4060c0};
    static const double floor[4][3] = {{-8, -2, -2}, {8, -2, -2}, {-8, -2, -30}, {8, -2, -30}};
    static const double square[4][3] = {{-0.7, 0, -6}, {0.7, 0.2, -6}, {-0.7, 0, -7.4}, {0.7, 0.2, -7.4}};
    static const int rim[5] = {0, 1, 3, 2, 0};
    frustum(1, 2000);
    scene_projection_done();
    glEnable(GL_DEPTH_TEST);
    patch(floor, 8, 8, ground);
    patch(square, 1, 1, occluder);
    glColorMask(0, 0, 0, 0);
    glDepthMask(0);
    glEnable(GL_STENCIL_TEST);
    glEnable(GL_CULL_FACE);
    for (int back = 0; back < 2; back++) {
        glCullFace(back ? GL_FRONT : GL_BACK);
        glStencilFunc(GL_ALWAYS, 0, ~0u);
        glStencilOp(GL_KEEP, GL_KEEP, back ? GL_DECR_WRAP : GL_INCR_WRAP);
        start(GL_TRIANGLE_STRIP);
        for (int k = 0; k < 5; k++) {
            const double *p = square[rim[k]];
            at(p[0], p[1], p[2]);
            at4(p[0] - light[0], p[1] - light[1], p[2] - light[2], 0);
        }
        finish();
    }
    glDisable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glColorMask(1, 1, 1, 1);
    glDisable(GL_DEPTH_TEST);
    glDepthMask(1);
    glStencilFunc(GL_NOTEQUAL, 0, ~0u);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glMatrixMode(GL_MODELVIEW);
    start(GL_TRIANGLE_FAN);
    colour(0x101010);
    at(-1, -1, 0), at(1, -1, 0), at(1, 1, 0), at(-1, 1, 0);
    finish();
    glDisable(GL_STENCIL_TEST);
}

/* A sky: it turns and never moves, writes no depth, comes before everything else: infinitely far. */
static void draw_sky(int frame)
{
    (void)frame;
    static const double box[2] = {3, 300}, far[3] = {1000, 1e5, 1e7};
    tell_lens(A);
    glMatrixMode(GL_PROJECTION);
    double h = 1 / B;
    demo_perspective_sky(2 * atan(h) * 180 / M_PI, B / A, 1, 1e8);
    glMatrixMode(GL_MODELVIEW);
    glRotated(90, 0, 1, 0);
    glDepthMask(0);
    for (int k = 0; k < 2; k++) {
        double corner[4][2], x = demo_width * (k + 0.5) / 5 + 0.37 * k;
        marker_corners(x, corner);
        tell_marker(colours[k], x, INFINITY);
        start(GL_TRIANGLE_FAN);
        colour(colours[k]);
        for (int c = 0; c < 4; c++) /* its position after the turn */
            at(box[k], (2 * corner[c][1] / demo_height - 1) * box[k] / B, (2 * corner[c][0] / demo_width - 1) * box[k] / A);
        finish();
    }
    glDepthMask(1);
    glLoadIdentity();
    glEnable(GL_DEPTH_TEST);
    frustum(1, 1e8);
    scene_projection_done();
    for (int k = 0; k < 3; k++)
        marker(colours[k + 2], demo_width * (k + 2.5) / 5 + 0.37 * k, far[k], 1, A, B);
    glDisable(GL_DEPTH_TEST);
}

/* P with its axes and as a whole scaled: mirrored cameras and cameras that look along +z. Only front faces are visible. */
static void scaled(double x, double z, double whole)
{
    GLdouble all[16] = {whole, 0, 0, 0, 0, whole, 0, 0, 0, 0, whole, 0, 0, 0, 0, whole};
    glMatrixMode(GL_PROJECTION);
    glLoadMatrixd(all);
    glFrustum(-1 / A, 1 / A, -1 / B, 1 / B, 1, 2000);
    glScaled(x, 1, z);
    scene_projection_done();
    /* The modelview undoes the scale, so that the markers keep their places. */
    glScaled(x, 1, z);
    tell_lens(A * x);
    glEnable(GL_CULL_FACE);
    five(near_to_far, NULL);
    glDisable(GL_CULL_FACE);
}

static void draw_mirrored(int frame) { (void)frame; scaled(-1, 1, 1); }
static void draw_left_handed(int frame) { (void)frame; scaled(1, -1, 1); }
static void draw_turned(int frame) { (void)frame; scaled(-1, -1, 1); }
static void draw_large_matrix(int frame) { (void)frame; scaled(1, 1, 1024); }
static void draw_small_matrix(int frame) { (void)frame; scaled(1, 1, 1.0 / 1024); }

/* A frustum whose axis is far outside of the picture. */
static void draw_off_axis(int frame)
{
    (void)frame;
    const double shift = 7; /* of the frustum, at depth 1 */
    tell_lens(A);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(shift - 1 / A, shift + 1 / A, -1 / B, 1 / B, 1, 2000);
    scene_projection_done();
    for (int k = 0; k < 5; k++) {
        double d = near_to_far[k];
        glPushMatrix();
        glTranslated(shift * d, 0, 0);
        marker(colours[k], demo_width * (k + 0.5) / 5 + 0.37 * k, d, 1, A, B);
        glPopMatrix();
    }
}

/* The camera's position and rotation are in the projection matrix, as in some engines. */
static void draw_camera(int frame)
{
    (void)frame;
    tell_lens(A);
    frustum(1, 2000);
    glRotated(40, 0, 1, 0);
    glRotated(25, 1, 0, 0);
    glTranslated(3, -2, 5);
    scene_projection_done();
    glTranslated(-3, 2, -5);
    glRotated(-25, 1, 0, 0);
    glRotated(-40, 0, 1, 0);
    five(near_to_far, NULL);
}

/* A focal depth just before the near plane: --focal-depth 0.02. */
static void draw_near_focus(int frame)
{
    (void)frame;
    static const double depth[5] = {0.015, 0.02, 0.03, 0.1, 100};
    tell_lens(A);
    frustum(0.01, 1000);
    scene_projection_done();
    five(depth, NULL);
}

/* World coordinates are large and the camera is near: transformation cancels 20 bits of a float. */
static void draw_far_from_origin(int frame)
{
    (void)frame;
    static const unsigned tiles[2] = {0xe0c060, 0x3060a0};
    const double x = 1 << 20, z = -(1 << 19);
    const double wall[4][3] = {{x - 6, -4, z - 5}, {x + 6, -4, z - 12}, {x - 6, 4, z - 5}, {x + 6, 4, z - 12}};
    frustum(1, 100);
    scene_projection_done();
    glEnable(GL_DEPTH_TEST);
    glTranslated(-x, 0, -z);
    patch(wall, 9, 7, tiles);
    glDisable(GL_DEPTH_TEST);
}

/* Cameras far apart: things leave the picture, and are seen from the side. */
static void draw_apart(int frame)
{
    (void)frame;
    static const unsigned tiles[2] = {0xe0c060, 0x3060a0};
    static const double floor[4][3] = {{-60, -3, -2}, {60, -3, -2}, {-60, -3, -90}, {60, -3, -90}};
    frustum(1, 200);
    scene_projection_done();
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    patch(floor, 20, 20, tiles);
    for (int k = -6; k <= 6; k++) {
        static const unsigned sides[2] = {0xc04040, 0x40c040};
        const double post[4][3] = {{6.0 * k, -3, -10 - k}, {6.0 * k + 2, -3, -10 - k}, {6.0 * k, 2, -10 - k}, {6.0 * k + 2, 2, -10 - k}};
        patch(post, 2, 5, sides);
    }
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
}

/* A display over the whole picture: the same in all views. */
static void draw_hud(int frame)
{
    (void)frame;
    frustum(1, 2000);
    scene_projection_done();
    glEnable(GL_DEPTH_TEST);
    start(GL_TRIANGLES); /* an invisible triangle in perspective, so that the cameras are known */
    at(500, 0, -9), at(501, 0, -9), at(500, 1, -9);
    finish();
    glDisable(GL_DEPTH_TEST);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(0, demo_width, 0, demo_height, -1, 1);
    glMatrixMode(GL_MODELVIEW);
    static const GLubyte letter[8] = {0x7e, 0x81, 0xa5, 0x81, 0xbd, 0x99, 0x81, 0x7e};
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glColor3f(1, 1, 0);
    glRasterPos2f(3, (GLfloat)demo_height - 12);
    for (int k = 0; k < 12; k++)
        glBitmap(8, 8, 0, 0, 9, 0, letter);
    start(GL_TRIANGLES);
    for (int k = 0; k < 30; k++) {
        colour(0x4080ffu + 0x1000u * (unsigned)k);
        double x = 8.3 * k + 2, y = 20 + 3.7 * k;
        at(x, y, 0), at(x + 13, y + 1.3, 0), at(x + 4.4, y + 17, 0);
    }
    finish();
    start(GL_LINE_STRIP);
    for (int k = 0; k < 40; k++)
        at(6.5 * k, 15.5 + 9 * sin(k), 0);
    finish();
}

const struct hard_case places_cases[] = {
    {"depths", "markers at depths 4 to 1000", NULL, draw_depths},
    {"homogeneous", "the same, vertices with w of 0.001 to 1000", NULL, draw_homogeneous},
    {"extruded", "a shadow volume to vertices with w = 0, counted in the stencil buffer", NULL, draw_extruded},
    {"sky", "markers infinitely far, and three at 1000 to 10,000,000", NULL, draw_sky},
    {"mirrored", "a camera that mirrors, back faces culled", NULL, draw_mirrored},
    {"left-handed", "a camera along +z, back faces culled", NULL, draw_left_handed},
    {"turned", "a camera that mirrors along +z, back faces culled", NULL, draw_turned},
    {"large-matrix", "a projection times 1024", NULL, draw_large_matrix},
    {"small-matrix", "a projection over 1024", NULL, draw_small_matrix},
    {"off-axis", "a frustum whose axis is 8 pictures beside it", NULL, draw_off_axis},
    {"camera", "the camera in the projection matrix", NULL, draw_camera},
    {"near-focus", "a focal depth of twice the near plane's; for --focal-depth 0.02", NULL, draw_near_focus},
    {"far-from-origin", "a world at 1,000,000", NULL, draw_far_from_origin},
    {"apart", "a scene for cameras far from each other", NULL, draw_apart},
    {"hud", "a flat display: bitmaps, triangles, lines", NULL, draw_hud},
    {0}};
