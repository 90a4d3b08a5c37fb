/* A pillar in the middle before a wall, and over them a crosshair in the middle and a cursor at three quarters of the width, half way up. */
#include "demo.h"

static int pillar = 4;
const struct demo_option demo_options[] = {{"--pillar", "distance of the pillar (default 4)", &pillar, 1}, {0}};

static GLuint stone;

void demo_setup(void)
{
    static const GLubyte pale[3] = {200, 190, 170}, brown[3] = {150, 120, 90};
    stone = demo_checker(64, 16, pale, brown);
    glEnable(GL_TEXTURE_2D);
    glEnable(GL_DEPTH_TEST);
}

static void upright(double half, double distance)
{
    glBegin(GL_QUADS);
    for (int c = 0; c < 4; c++) {
        double u = c == 1 || c == 2 ? 1.0 : -1.0, v = c >= 2 ? 1.0 : -1.0;
        glTexCoord2d(0.5 * u + 0.5, 0.5 * v + 0.5);
        glVertex3d(half * u, 20.0 * v, -distance);
    }
    glEnd();
}

static void flat(void)
{
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(0.0, 64.0, 0.0, 48.0, -1.0, 1.0);
    demo_flat_done();
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_TEXTURE_2D);
    glColor3f(0.91f, 0.2f, 0.2f);
    glRectd(30.5, 23.75, 33.5, 24.25);
    glColor3f(0.2f, 0.91f, 0.3f);
    glRectd(48.0, 22.5, 49.0, 24.0);
    glEnable(GL_TEXTURE_2D);
    glEnable(GL_DEPTH_TEST);
}

void demo_frame(int frame)
{
    (void)frame;
    demo_viewport(0, 0, demo_width, demo_height);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    demo_perspective(50.0, (double)demo_width / demo_height, 0.5, 60.0);
    glBindTexture(GL_TEXTURE_2D, stone);
    glColor3f(1.0f, 1.0f, 1.0f);
    upright(40.0, 20.0);
    glColor3f(0.7f, 0.8f, 1.0f);
    upright(0.1 * pillar, pillar);
    flat();
}
