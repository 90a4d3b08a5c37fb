/* The accumulation buffer: motion blur and depth of field by many pictures of the scene, a trail of earlier frames in a display list, and sums
 * and products under a colour mask, each in its part of the window. */
#include "demo.h"
#include <math.h>

DEMO_NO_OPTIONS;
int demo_accumulation = 1;

static GLuint trail;

void demo_setup(void)
{
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_LIGHT0);
    glEnable(GL_NORMALIZE);
    glEnable(GL_COLOR_MATERIAL);
    glClearColor(0.13f, 0.19f, 0.27f, 0.61f);
    /* Fades the accumulated picture, adds the frame, and shows both without touching blue. */
    trail = glGenLists(1);
    glNewList(trail, GL_COMPILE);
    glAccum(GL_MULT, 0.57f);
    glAccum(GL_ACCUM, 0.43f);
    glColorMask(GL_TRUE, GL_TRUE, GL_FALSE, GL_TRUE);
    glAccum(GL_RETURN, 1.0f);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glEndList();
}

/* Moves the camera aside by x and y, with the frustum sheared so that depth 7 keeps its place. */
static void scene(double t, double x, double y)
{
    static const GLfloat light[4] = {1.5f, 2.5f, 2.0f, 0.0f};
    double h = 1.5 * tan(21.0 * 3.14159265358979 / 180.0), w = h * demo_width / demo_height;
    double dx = -x * 1.5 / 7.0, dy = -y * 1.5 / 7.0;
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-w + dx, w + dx, -h + dy, h + dy, 1.5, 40.0);
    demo_projection_done();
    glMatrixMode(GL_MODELVIEW);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_LIGHTING);
    glLoadIdentity();
    glLightfv(GL_LIGHT0, GL_POSITION, light);
    for (int i = 0; i < 4; i++) {
        glLoadIdentity();
        glTranslated(-x, -y, 0.0);
        glTranslated(-2.1 + 1.4 * i, 0.3 + 0.9 * sin(1.7 * i + 5.0 * t), -4.5 - 1.9 * i);
        glRotated(40.0 * i + 300.0 * t, 0.3, 1.0, 0.2);
        glColor3d(0.87 - 0.21 * i, 0.33 + 0.09 * i, 0.23 + 0.19 * i);
        if (i & 1)
            demo_box(0.6, 0.5, 0.5);
        else
            demo_torus(0.6, 0.23, 24, 12);
    }
    glDisable(GL_LIGHTING);
}

void demo_frame(int frame)
{
    int w = demo_width, h = demo_height;
    double t = demo_time(frame);
    demo_viewport(0, 0, w, h);
    /* Motion blur at the upper left. */
    demo_scissor(0, h / 3, w / 2, h);
    for (int i = 0; i < 5; i++) {
        scene(t + 0.013 * i, 0.0, 0.0);
        glAccum(i ? GL_ACCUM : GL_LOAD, 0.2f);
    }
    glAccum(GL_RETURN, 1.0f);
    /* Depth of field beside it, its weights adding up to more than 1. */
    demo_scissor(w / 2, h / 3, w, h);
    glClear(GL_ACCUM_BUFFER_BIT);
    for (int i = 0; i < 6; i++) {
        scene(t, 0.17 * sin(1.1 * i), 0.17 * cos(1.1 * i));
        glAccum(GL_ACCUM, 1.0f / 6.0f);
    }
    glAccum(GL_RETURN, 1.3f);
    /* Below, the frame and the earlier ones. */
    demo_scissor(0, 0, 2 * w / 3, h / 3);
    scene(t, 0.0, 0.0);
    if (!frame)
        glAccum(GL_LOAD, 0.43f);
    glCallList(trail);
    /* At the lower right, sums: the accumulation buffer is cleared together with the colours. */
    demo_scissor(2 * w / 3, 0, w, h / 3);
    scene(t, 0.0, 0.0);
    glClearAccum(0.23f, -0.17f, 0.41f, 0.0f);
    glClear(GL_DEPTH_BUFFER_BIT | GL_ACCUM_BUFFER_BIT);
    glAccum(GL_ACCUM, 0.71f);
    glAccum(GL_ADD, -0.11f);
    glAccum(GL_MULT, 1.29f);
    glAccum(GL_RETURN, 0.93f);
    glClearAccum(0.0f, 0.0f, 0.0f, 0.0f);
    demo_scissor_off();
}
