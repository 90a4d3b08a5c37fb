/* 20,000 vertices a frame by glBegin/glEnd, each with normal, colour and position. With --time it measures what a layer costs. */
#include "demo.h"
#include <math.h>

DEMO_NO_OPTIONS;

enum { STRIPS = 100, COLUMNS = 100 }; /* 100 strips of 200 vertices */

static double height[STRIPS + 1][COLUMNS], slope[STRIPS + 1][COLUMNS][2];

void demo_setup(void)
{
    static const GLfloat sun[4] = {-0.5f, 0.8f, 0.4f, 0.0f};
    for (int j = 0; j <= STRIPS; j++)
        for (int i = 0; i < COLUMNS; i++) {
            double x = 0.2 * i, z = 0.2 * j;
            height[j][i] = 0.5 * sin(1.1 * x) * cos(0.9 * z) + 0.18 * sin(2.7 * x + 1.9 * z) + 0.06 * sin(7.0 * x - 5.0 * z);
            slope[j][i][0] = 0.55 * cos(1.1 * x) * cos(0.9 * z) + 0.486 * cos(2.7 * x + 1.9 * z) + 0.42 * cos(7.0 * x - 5.0 * z);
            slope[j][i][1] = -0.45 * sin(1.1 * x) * sin(0.9 * z) + 0.342 * cos(2.7 * x + 1.9 * z) - 0.30 * cos(7.0 * x - 5.0 * z);
        }
    glClearColor(0.55f, 0.71f, 0.91f, 1.0f);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_LIGHTING);
    glEnable(GL_LIGHT0);
    glEnable(GL_NORMALIZE);
    glEnable(GL_COLOR_MATERIAL);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glLightfv(GL_LIGHT0, GL_POSITION, sun);
}

static void vertex(int i, int j)
{
    double h = height[j][i];
    glColor3d(0.35 + 0.6 * h, 0.65 + 0.2 * h, 0.25 + 0.71 * (h > 0.31) * (h - 0.31));
    glNormal3d(-slope[j][i][0], 1.0, -slope[j][i][1]);
    glVertex3d(0.16 * (i - COLUMNS / 2), h, 3.0 - 0.16 * j);
}

void demo_frame(int frame)
{
    double t = demo_time(frame);
    demo_viewport(0, 0, demo_width, demo_height);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    demo_perspective(45.0, (double)demo_width / demo_height, 1.0, 60.0);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslated(0.0, -0.9, -6.0);
    glRotated(22.0, 1.0, 0.0, 0.0);
    glRotated(20.0 * sin(t), 0.0, 1.0, 0.0);
    for (int j = 0; j < STRIPS; j++) {
        glBegin(j % 2 ? GL_TRIANGLE_STRIP : GL_QUAD_STRIP);
        for (int i = 0; i < COLUMNS; i++) {
            vertex(i, j + 1);
            vertex(i, j);
        }
        glEnd();
    }
}
