/* Cases of appearance: vertex colours, light, textures, points and lines wider than their place. */
#include "hard.h"
#include <math.h>
#include <stdlib.h>

/* Wide and smooth points and lines on the sides of the picture: the part beyond the side must not show in another view. */
static void draw_wide(int frame)
{
    (void)frame;
    usual_frustum(1, 100);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    for (int smooth = 0; smooth < 2; smooth++) {
        (smooth ? glEnable : glDisable)(GL_BLEND);
        (smooth ? glEnable : glDisable)(GL_POINT_SMOOTH);
        (smooth ? glEnable : glDisable)(GL_LINE_SMOOTH);
        glPointSize(20);
        start(GL_POINTS);
        colour(smooth ? 0xff8000 : 0xff0000);
        for (int side = -1; side <= 1; side += 2) {
            for (int k = 0; k < 7; k++)
                at(side * (6.4 + 0.03 * (k - 3)), -3 + 0.6 * k + 0.25 * smooth, -8); /* in focus, so at the side of every view */
        }
        finish();
        glLineWidth(9);
        start(GL_LINES);
        colour(smooth ? 0x00ff80 : 0x00ff00);
        for (int side = -1; side <= 1; side += 2) {
            at(side * 6.4, 1 + 2 * smooth, -8), at(side * 6.38, 2.5 + 1.5 * smooth, -8);
            at(side * 7.5, 2 * smooth, -8), at(side * 5.5, 0.5 + 2 * smooth, -8);
        }
        finish();
    }
    glDisable(GL_BLEND);
    glDisable(GL_POINT_SMOOTH);
    glDisable(GL_LINE_SMOOTH);
    glPointSize(1);
    glLineWidth(1);
}

/* Every mode that has a provoking vertex, flat-shaded, with a colour for each vertex. */
static void flat(GLenum convention)
{
    static const GLenum modes[] = {GL_TRIANGLES, GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN, GL_QUADS, GL_QUAD_STRIP, GL_POLYGON};
    PFNGLPROVOKINGVERTEXPROC provoking = (PFNGLPROVOKINGVERTEXPROC)demo_proc("glProvokingVertex");
    provoking(convention);
    usual_frustum(1, 100);
    glShadeModel(GL_FLAT);
    for (int m = 0; m < 6; m++) {
        int round = modes[m] == GL_POLYGON || modes[m] == GL_TRIANGLE_FAN || modes[m] == GL_QUADS;
        for (int turned = 0; turned < 2; turned++) {
            glPushMatrix();
            glTranslated(-4.1 + 1.7 * m, turned ? 1.7 : -1.7, -7 - m);
            start(modes[m]);
            for (int k = 0; k < 12; k++) {
                unsigned n = (unsigned)(k + 1);
                colour((n * 20) << 16 | (n * 53 % 256) << 8 | (255 - n * 17));
                if (modes[m] == GL_QUADS || modes[m] == GL_TRIANGLES) {
                    int cell = k / (round ? 4 : 3), corner = k % (round ? 4 : 3);
                    at(0.5 * cell + (corner == 1 || corner == 2 ? 0.45 : 0), (corner >= 2 ? 1.3 : 0), 0.3 * cell);
                } else if (round) {
                    at(0.8 + 0.8 * cos(k * M_PI / 6), 0.8 * sin(k * M_PI / 6), 0.2);
                } else {
                    at(0.28 * (k / 2), k & 1 ? 1.2 : 0, 0.1 * k);
                }
            }
            finish();
            glPopMatrix();
        }
    }
    glShadeModel(GL_SMOOTH);
    provoking(GL_LAST_VERTEX_CONVENTION);
}

static void draw_flat_first(int frame) { (void)frame; flat(GL_FIRST_VERTEX_CONVENTION); }
static void draw_flat_last(int frame) { (void)frame; flat(GL_LAST_VERTEX_CONVENTION); }

/* ---- light ---- */

static void ball(double radius)
{
    for (int stack = 0; stack < 14; stack++) {
        start(GL_TRIANGLE_STRIP);
        for (int slice = 0; slice <= 20; slice++) {
            for (int k = 0; k < 2; k++) {
                double a = M_PI * (stack + 1 - k) / 14, b = 2 * M_PI * slice / 20;
                double x = sin(a) * cos(b), y = cos(a), z = sin(a) * sin(b);
                normal(x, y, z);
                colour((unsigned)(128 + 100 * x) << 16 | (unsigned)(128 + 100 * y) << 8 | (unsigned)(128 + 100 * z));
                texture(slice / 20.0, (stack + k) / 14.0);
                at(radius * x, radius * y, radius * z);
            }
        }
        finish();
    }
}

static void light(void)
{
    static const GLfloat sun[4] = {1, 2, 3, 0}, lamp[4] = {-2, 3, -4, 1}, down[3] = {0.4f, -1, -0.4f}, white[4] = {1, 1, 1, 1};
    static const GLfloat blue[4] = {0.2f, 0.2f, 0.9f, 1}, warm[4] = {0.9f, 0.6f, 0.2f, 1};
    glLightfv(GL_LIGHT0, GL_POSITION, sun);
    glLightfv(GL_LIGHT1, GL_POSITION, lamp);
    glLightfv(GL_LIGHT1, GL_SPOT_DIRECTION, down);
    glLightf(GL_LIGHT1, GL_SPOT_CUTOFF, 35);
    glLightf(GL_LIGHT1, GL_SPOT_EXPONENT, 4);
    glLightf(GL_LIGHT1, GL_LINEAR_ATTENUATION, 0.1f);
    glLightfv(GL_LIGHT1, GL_DIFFUSE, warm);
    glLightfv(GL_LIGHT1, GL_SPECULAR, white);
    glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, white);
    glMaterialfv(GL_BACK, GL_DIFFUSE, blue);
    glMaterialf(GL_FRONT, GL_SHININESS, 40);
    glMaterialf(GL_BACK, GL_SHININESS, 7);
    glEnable(GL_LIGHTING);
    glEnable(GL_LIGHT0);
    glEnable(GL_LIGHT1);
    glEnable(GL_DEPTH_TEST);
}

static void dark(void)
{
    glDisable(GL_LIGHTING);
    glDisable(GL_DEPTH_TEST);
}

/* Two sides, a separate specular colour, colours as material, a spot light, fog. */
static void draw_lighting(int frame)
{
    (void)frame;
    static const GLfloat haze[4] = {0.3f, 0.35f, 0.4f, 1};
    static const GLdouble half[4] = {0.3, 0.2, 1, 0.4};
    usual_frustum(1, 100);
    light();
    glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
    glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, 1);
    glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, GL_SEPARATE_SPECULAR_COLOR);
    glColorMaterial(GL_FRONT, GL_AMBIENT_AND_DIFFUSE);
    glEnable(GL_COLOR_MATERIAL);
    glEnable(GL_FOG);
    glFogi(GL_FOG_MODE, GL_EXP2);
    glFogf(GL_FOG_DENSITY, 0.06f);
    glFogfv(GL_FOG_COLOR, haze);
    for (int k = 0; k < 3; k++) {
        glPushMatrix();
        glTranslated(-3 + 2.8 * k, 0.4 * k - 0.5, -6 - 2 * k);
        glRotated(20 + 40 * k, 1, 0.5, 0);
        glClipPlane(GL_CLIP_PLANE0, half);
        glEnable(GL_CLIP_PLANE0); /* shows the inside */
        ball(1.6);
        glPopMatrix();
    }
    glDisable(GL_CLIP_PLANE0);
    glDisable(GL_FOG);
    glDisable(GL_COLOR_MATERIAL);
    dark();
}

/* Normals under scales that differ by 30,000 and mirror. */
static void draw_normals(int frame)
{
    (void)frame;
    static const double scale[4][3] = {{1e-4, 3, 2}, {-1.5, 0.3, 1}, {100, 100, 100}, {0.9, 0.01, -2}};
    usual_frustum(1, 100);
    light();
    for (int k = 0; k < 4; k++) {
        glPushMatrix();
        (k == 2 ? glEnable : glDisable)(GL_RESCALE_NORMAL);
        (k == 2 ? glDisable : glEnable)(GL_NORMALIZE);
        glTranslated(-3.6 + 2.4 * k, 0.2 * k, -7);
        glRotated(70 * k + 15, 0.3, 1, 0.2);
        glScaled(scale[k][0], scale[k][1], scale[k][2]);
        ball(k == 2 ? 0.011 : 1.2);
        glPopMatrix();
    }
    glDisable(GL_NORMALIZE);
    glDisable(GL_RESCALE_NORMAL);
    dark();
}

/* ---- small triangles ---- */

/* A mesh whose cells are smaller than pixels, and slivers across the picture; some edges end in the middle of others. */
static void draw_slivers(int frame)
{
    (void)frame;
    static const unsigned two[2] = {0xffd090, 0x203060};
    const double sheet[4][3] = {{-3, -2.4, -4}, {3.3, -2.2, -7}, {-3.1, 0, -5}, {3, 0.3, -9}};
    usual_frustum(1, 100);
    glEnable(GL_DEPTH_TEST);
    patch(sheet, 150, 70, two);
    start(GL_TRIANGLES);
    for (int k = 0; k < 60; k++) {
        double y = 0.9 + 0.045 * k, z = -6 - 0.05 * k;
        colour(k & 1 ? 0xff4040 : 0x40ffff);
        at(-5, y, z), at(5, y + 0.013, z - 0.3), at(5, y + 0.03, z - 0.3);
        at(-5, y, z), at(0.001 * k, y + 0.02, z - 0.15), at(-5, y + 0.03, z);
    }
    finish();
    glDisable(GL_DEPTH_TEST);
}

/* ---- textures ---- */

static GLuint checker;

static void setup_checker(void)
{
    static const GLubyte a[3] = {250, 240, 200}, b[3] = {30, 60, 90};
    checker = demo_checker(64, 8, a, b);
}

/* Texture coordinates of 100,000: a float keeps 7 bits of a repeat, which is half a texel. */
static void draw_texture(int frame)
{
    (void)frame;
    static const double corner[4][3] = {{-4, -3, -5}, {5, -2, -9}, {-4, 3, -5}, {5, 3, -9}};
    usual_frustum(1, 100);
    glEnable(GL_TEXTURE_2D);
    glBindTexture(GL_TEXTURE_2D, checker);
    start(GL_TRIANGLE_FAN);
    colour(0xffffff);
    for (int k = 0; k < 4; k++) {
        static const int order[4] = {0, 1, 3, 2};
        const double *p = corner[order[k]];
        texture(100000 + 0.7 * p[0], -100000 + 0.7 * p[1]);
        at(p[0], p[1], p[2]);
    }
    finish();
    glDisable(GL_TEXTURE_2D);
}

static GLuint levels;

/* Level k of the texture has the grey 24 k: a pixel shows its level of detail to 1/24. */
static void setup_levels(void)
{
    glGenTextures(1, &levels);
    glBindTexture(GL_TEXTURE_2D, levels);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    GLubyte *grey = malloc(1024 * 1024);
    if (!grey)
        demo_fail(1, "out of memory");
    for (int level = 0; level <= 10; level++) {
        int side = 1024 >> level;
        for (int k = 0; k < side * side; k++)
            grey[k] = (GLubyte)(24 * level);
        glTexImage2D(GL_TEXTURE_2D, level, GL_LUMINANCE, side, side, 0, GL_LUMINANCE, GL_UNSIGNED_BYTE, grey);
    }
    free(grey);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
}

/* A floor to the horizon, in focus half way. */
static void draw_levels(int frame)
{
    (void)frame;
    static const double floor[4][3] = {{-60, -2, -2}, {60, -2, -2}, {-60, -2, -80}, {60, -2, -80}};
    static const unsigned white[2] = {0xffffff, 0xffffff};
    usual_frustum(1, 100);
    glEnable(GL_TEXTURE_2D);
    glBindTexture(GL_TEXTURE_2D, levels);
    glMatrixMode(GL_TEXTURE);
    glScaled(8, 8, 1);
    patch(floor, 1, 1, white);
    glLoadIdentity();
    glMatrixMode(GL_MODELVIEW);
    glDisable(GL_TEXTURE_2D);
}

const struct hard_case surfaces_cases[] = {
    {"wide", "wide and smooth points and lines on the sides of the picture", NULL, draw_wide},
    {"flat-first", "flat primitives, the first vertex provokes", NULL, draw_flat_first},
    {"flat-last", "flat primitives, the last vertex provokes", NULL, draw_flat_last},
    {"lighting", "two sides, separate specular colour, colour material, spot light, fog", NULL, draw_lighting},
    {"normals", "normals under scales that differ by 30,000", NULL, draw_normals},
    {"slivers", "triangles smaller than pixels, slivers, edges that meet others' middles", NULL, draw_slivers},
    {"texture", "texture coordinates of 100,000", setup_checker, draw_texture},
    {"levels", "a floor whose grey is the level of detail", setup_levels, draw_levels},
    {0}};
