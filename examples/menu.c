/* A menu that is the same in all views, and a scene that comes and goes behind it. In turns: six frames of the menu alone, six that draw over
 * the last frame without a clear, six with a scene between the background and the menu, six with the menu alone, which clear all but the
 * stencil. --flat: no scene. */
#include "demo.h"
#include <math.h>

static int flat;
const struct demo_option demo_options[] = {{"--flat", "no scene, ever", &flat, 0}, {0}};

enum { ROWS = 12, EDGES = 400 };

static GLuint paper;

void demo_setup(void)
{
    static const GLubyte light[3] = {60, 70, 110}, dark[3] = {40, 45, 80};
    paper = demo_checker(128, 8, light, dark);
    glClearColor(0.1f, 0.05f, 0.1f, 1.0f);
    glEnable(GL_LIGHT0);
    glEnable(GL_COLOR_MATERIAL);
    glEnable(GL_NORMALIZE);
}

static void flat_projection(void)
{
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(0.0, 1.0, 0.0, 1.0, -1.0, 1.0);
    demo_flat_done();
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_LIGHTING);
}

static void background(void)
{
    flat_projection();
    glEnable(GL_TEXTURE_2D);
    glBindTexture(GL_TEXTURE_2D, paper);
    glColor3d(1.0, 1.0, 1.0);
    glBegin(GL_QUADS);
    for (int c = 0; c < 4; c++) {
        int x = c == 1 || c == 2, y = c >= 2;
        glTexCoord2i(3 * x, 3 * y);
        glVertex2i(x, y);
    }
    glEnd();
    glDisable(GL_TEXTURE_2D);
}

static void scene(double t)
{
    demo_perspective(45.0, (double)demo_width / demo_height, 1.0, 30.0);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_LIGHTING);
    /* The scene's outline stays in the stencil. */
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_ALWAYS, 1, 255);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    glTranslated(0.8 * sin(t), 0.0, -5.0);
    glRotated(60.0 * t, 0.3, 1.0, 0.0);
    glColor3d(0.9, 0.6, 0.3);
    demo_torus(1.0, 0.35, 32, 16);
    glDisable(GL_STENCIL_TEST);
}

static void menu(int frame, double t)
{
    flat_projection();
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    for (int r = 0; r < ROWS; r++) {
        double y = 0.04 + 0.93 * r / ROWS, h = 0.055, x = 0.18 + 0.04 * sin(t * 3.0 + r);
        glColor4d(0.2, r == frame / 2 % ROWS ? 0.8 : 0.4, 0.5, 0.45);
        glBegin(GL_TRIANGLE_FAN);
        for (int e = 0; e < EDGES; e++) {
            double a = 2.0 * M_PI * e / EDGES;
            glVertex2d(x + 0.32 + 0.32 * cbrt(cos(a)), y + h / 2 + h / 2 * cbrt(sin(a)));
        }
        glEnd();
        glColor3d(1.0, 1.0, 0.9);
        glBegin(GL_LINE_STRIP);
        for (int e = 0; e < 40; e++)
            glVertex2d(x + 0.1 + 0.01 * e, y + h / 2 + 0.02 * sin(e * (r + 2.0)));
        glEnd();
    }
    /* Draws only where the scene was, by its outline in the stencil. */
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_EQUAL, 1, 255);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    glColor4d(1.0, 0.3, 0.3, 0.3);
    glRectd(0.0, 0.0, 1.0, 1.0);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_BLEND);
}

void demo_frame(int frame)
{
    enum { ALONE, OVER, BEFORE_A_SCENE, WITHOUT_STENCIL } turn = flat ? ALONE : frame / 6 % 4;
    double t = demo_time(frame);
    demo_viewport(0, 0, demo_width, demo_height);
    if (turn != OVER)
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | (turn == WITHOUT_STENCIL ? 0 : GL_STENCIL_BUFFER_BIT));
    if (turn != OVER)
        background();
    if (turn == BEFORE_A_SCENE)
        scene(t);
    menu(frame, t);
}
