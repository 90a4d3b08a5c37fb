/* Outdoors: a sky box that turns with the camera but never moves and writes no depth, a ground with pillars and smoke, balloons at the far end
 * of the depth range, a weapon in the viewer's hand at its near end, and over it a flat display. With --far-off the camera is far from the origin,
 * and the sky is moved to it by a second matrix, so that the two cancel but for what they round. With --cleared the sky is a small box that writes
 * depths, which are cleared for the ground; with --sun as well, a sun is drawn between the two, at a place of its own and without depths. With
 * --mist something transparent follows the sky. With --renamed the textures have other names, and with --repaint the program paints over that of
 * the ground before the second frame. */
#include "demo.h"
#include <math.h>

static int far_off, cleared, sun, mist, renamed, repaint;
const struct demo_option demo_options[] = {{"--far-off", "the camera and the sky are far from the origin", &far_off, 0},
                                           {"--cleared", "the sky writes depths, which are cleared after it", &cleared, 0},
                                           {"--sun", "a sun is drawn after the sky", &sun, 0},
                                           {"--mist", "a mist before the sky is drawn before the ground", &mist, 0},
                                           {"--renamed", "the textures have other names", &renamed, 0},
                                           {"--repaint", "the ground is painted over before the second frame", &repaint, 0},
                                           {0}};

static GLuint clouds, grass, stone;

void demo_setup(void)
{
    static const GLubyte white[3] = {235, 240, 245}, blue[3] = {120, 165, 220}, green[3] = {95, 140, 70},
                         dark[3] = {60, 100, 50}, pale[3] = {200, 190, 170}, brown[3] = {150, 120, 90};
    if (renamed)
        demo_checker(8, 2, pale, brown);
    clouds = demo_checker(64, 8, white, blue);
    grass = demo_checker(64, 2, green, dark);
    stone = demo_checker(64, 4, pale, brown);
    glEnable(GL_TEXTURE_2D);
    glEnable(GL_DEPTH_TEST);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
}

/* Leaves of the matrix what is left of it where a program with a camera far from the origin moves something to that camera. */
static void move_to_eye(void)
{
    static const double eye[3] = {431.7, -23.9, -871.3};
    GLfloat view[16];
    glGetFloatv(GL_MODELVIEW_MATRIX, view);
    for (int row = 0; row < 3; row++)
        view[12 + row] = (GLfloat)-(view[row] * eye[0] + view[4 + row] * eye[1] + view[8 + row] * eye[2]);
    glLoadMatrixf(view);
    glTranslated(eye[0], eye[1], eye[2]);
}

/* In front of the sky, and behind all that follows: without depths, at a place of its own. */
static void sun_disc(void)
{
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_TEXTURE_2D);
    glColor3f(1.0f, 0.95f, 0.6f);
    glPushMatrix();
    glTranslated(-4.0, 3.0, -20.0);
    glBegin(GL_QUADS);
    for (int c = 0; c < 4; c++)
        glVertex2d(c == 1 || c == 2 ? 1.0 : -1.0, c >= 2 ? 1.0 : -1.0);
    glEnd();
    glPopMatrix();
    glEnable(GL_TEXTURE_2D);
}

/* Six sides around the eye. Its size does not matter: it is drawn first, and none of its depths are left. */
static void sky(void)
{
    const double size = cleared ? 2.0 : 10.0;
    if (!cleared) {
        glDisable(GL_DEPTH_TEST);
        glDepthMask(GL_FALSE);
    }
    glBindTexture(GL_TEXTURE_2D, clouds);
    glColor3f(1.0f, 1.0f, 1.0f);
    for (int side = 0; side < 6; side++) {
        glBegin(GL_QUADS);
        for (int c = 0; c < 4; c++) {
            double p[3], u = c == 1 || c == 2 ? 1.0 : -1.0, v = c >= 2 ? 1.0 : -1.0;
            p[side % 3] = side < 3 ? size : -size;
            p[(side + 1) % 3] = size * u;
            p[(side + 2) % 3] = size * v;
            glTexCoord2d(0.5 * u + 0.5, 0.5 * v + 0.5);
            glVertex3dv(p);
        }
        glEnd();
    }
    if (sun)
        sun_disc();
    glDepthMask(GL_TRUE);
    glEnable(GL_DEPTH_TEST);
    if (cleared)
        glClear(GL_DEPTH_BUFFER_BIT);
}

static void paint_over(void)
{
    static const GLubyte ice[32 * 32 * 3] = {225};
    glBindTexture(GL_TEXTURE_2D, grass);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 16, 16, 32, 32, GL_RGB, GL_UNSIGNED_BYTE, ice);
}

static void ground(void)
{
    glBindTexture(GL_TEXTURE_2D, grass);
    glColor3f(1.0f, 1.0f, 1.0f);
    glBegin(GL_QUADS);
    for (int z = -6; z < 6; z++)
        for (int x = -6; x < 6; x++)
            for (int c = 0; c < 4; c++) {
                int dx = c == 1 || c == 2, dz = c < 2;
                glTexCoord2d(x + dx, z + dz);
                glVertex3d(4.0 * (x + dx), 0.0, 4.0 * (z + dz));
            }
    glEnd();
    glBindTexture(GL_TEXTURE_2D, stone);
    for (int i = 0; i < 9; i++) {
        glPushMatrix();
        glTranslated(5.0 * (i % 3) - 5.0, 1.5, 5.0 * (i / 3) - 9.0);
        glRotated(20.0 * i, 0.0, 1.0, 0.0);
        glColor3d(1.0, 1.0 - 0.06 * i, 0.6 + 0.04 * i);
        demo_box(0.4, 1.5, 0.4);
        glPopMatrix();
    }
}

/* Behind everything by their depth range: infinitely far, although they move with the ground and come after it. */
static void balloons(double aspect)
{
    demo_perspective_sky(50.0, aspect, 0.5, 60.0);
    glDepthFunc(GL_LEQUAL);
    glDepthRange(1.0, 1.0);
    glDisable(GL_TEXTURE_2D);
    glColor3f(0.75f, 0.35f, 0.3f);
    glBegin(GL_QUADS);
    for (int i = 0; i < 12; i++)
        for (int c = 0; c < 4; c++) {
            double angle = 0.5236 * i + (c == 1 || c == 2 ? 0.06 : -0.06);
            glVertex3d(40.0 * sin(angle), 8.0 + 4.0 * (c >= 2), 40.0 * cos(angle));
        }
    glEnd();
    glEnable(GL_TEXTURE_2D);
    glDepthRange(0.0, 1.0);
    glDepthFunc(GL_LESS);
    demo_perspective(50.0, aspect, 0.5, 60.0);
}

/* Begins and ends what is transparent: without a texture, and writing no depth. */
static void transparent(int begins)
{
    (begins ? glDisable : glEnable)(GL_TEXTURE_2D);
    (begins ? glEnable : glDisable)(GL_BLEND);
    glDepthMask(!begins);
}

/* Drawn after the solid things without writing depth: not a sky, since it has a place. */
static void smoke(void)
{
    transparent(1);
    glColor4f(0.8f, 0.8f, 0.85f, 0.4f);
    glBegin(GL_QUADS);
    for (int i = 0; i < 3; i++)
        for (int c = 0; c < 4; c++)
            glVertex3d(-2.0 + 2.0 * i + (c == 1 || c == 2), 0.4 + 1.4 * (c >= 2), -1.0 - 2.0 * i);
    glEnd();
    transparent(0);
}

/* Far behind the ground, but not infinitely far. */
static void veil(void)
{
    transparent(1);
    glColor4f(0.9f, 0.9f, 0.95f, 0.3f);
    glBegin(GL_QUADS);
    for (int c = 0; c < 4; c++)
        glVertex3d(c == 1 || c == 2 ? 30.0 : -30.0, c >= 2 ? 6.0 : -2.0, -30.0);
    glEnd();
    transparent(0);
}

/* Near the eye, in eye coordinates, and solid; it is always in front. */
static void hand(void)
{
    glLoadIdentity();
    glTranslated(0.7, -0.6, -2.0);
    glRotated(25.0, 0.2, 1.0, 0.0);
    glColor3f(0.6f, 0.65f, 0.71f);
    glDepthRange(0.0, 0.3);
    demo_box(0.12, 0.12, 0.5);
    glDepthRange(0.0, 1.0);
}

static void display(void)
{
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(0.0, 64.0, 0.0, 48.0, -1.0, 1.0);
    demo_flat_done();
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_TEXTURE_2D);
    glColor3f(1.0f, 0.85f, 0.2f);
    glRectd(4.0, 4.0, 20.0, 7.0);
    glRectd(52.0, 40.0, 60.0, 44.0);
    glColor3f(0.91f, 0.2f, 0.2f);
    glBegin(GL_LINES); /* cross-hair */
    glVertex2d(30.05, 24.05); glVertex2d(34.05, 24.05);
    glVertex2d(32.05, 22.05); glVertex2d(32.05, 26.05);
    glEnd();
    glEnable(GL_TEXTURE_2D);
    glEnable(GL_DEPTH_TEST);
}

void demo_frame(int frame)
{
    double t = demo_time(frame), aspect = (double)demo_width / demo_height;
    if (repaint && frame == 1)
        paint_over();
    demo_viewport(0, 0, demo_width, demo_height);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glRotated(8.0, 1.0, 0.0, 0.0);
    glRotated(25.0 + 30.0 * sin(t), 0.0, 1.0, 0.0);
    glPushMatrix();
    if (far_off)
        move_to_eye();
    demo_perspective_sky(50.0, aspect, 0.5, 60.0);
    sky();
    glPopMatrix();
    demo_perspective(50.0, aspect, 0.5, 60.0);
    glTranslated(0.5, -1.8, -9.0 + 2.0 * t);
    if (mist)
        veil();
    ground();
    balloons(aspect);
    smoke();
    hand();
    display();
}
