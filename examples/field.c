/* Things all around by glBegin/glEnd, of which the turning camera sees a few: the program leaves culling to OpenGL. Some are cut by the sides
 * of the picture, some stand behind the eye; a net of lines and a fan of thick points reach into the picture from outside. */
#include "demo.h"
#include <math.h>

static int things = 60;
const struct demo_option demo_options[] = {{"--things", "tori around the camera, 1 to 2000 (default 60)", &things, 1}, {0}};

void demo_setup(void)
{
    static const GLfloat sun[4] = {0.4f, 1.0f, 0.3f, 0.0f};
    if (things > 2000)
        demo_fail(2, "--things: 1 to 2000");
    glClearColor(0.2f, 0.25f, 0.35f, 1.0f);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_LIGHT0);
    glLightfv(GL_LIGHT0, GL_POSITION, sun);
    glEnable(GL_COLOR_MATERIAL);
    glEnable(GL_NORMALIZE);
}

void demo_frame(int frame)
{
    double t = demo_time(frame);
    demo_viewport(0, 0, demo_width, demo_height);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    demo_perspective(50.0, (double)demo_width / demo_height, 0.5, 60.0);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glRotated(40.0 * t, 0.0, 1.0, 0.0);
    glEnable(GL_LIGHTING);
    for (int i = 0; i < things; i++) {
        double a = 2.399963 * i, r = 2.5 + 0.25 * i / (1.0 + things / 120.0);
        glPushMatrix();
        glTranslated(r * cos(a), 0.8 * sin(1.7 * i), r * sin(a));
        glRotated(77.0 * i + 50.0 * t, 1.0, 0.4, 0.2);
        glColor3d(0.5 + 0.5 * sin(i), 0.5 + 0.5 * sin(i + 2.0), 0.6);
        demo_torus(0.6, 0.2, 24, 12);
        glPopMatrix();
    }
    glDisable(GL_LIGHTING);
    glColor3d(0.92, 0.88, 0.48); /* no component half way between two steps of 255 */
    for (int i = -40; i <= 40; i++) {
        glBegin(GL_LINES);
        glVertex3d(i, -1.5, -40.0);
        glVertex3d(i, -1.5, 40.0);
        glEnd();
    }
    /* Points are wider than their spacing: of some only the edge shows. */
    glPointSize(15.0f);
    for (int i = 0; i < 90; i++) {
        glBegin(GL_POINTS);
        glVertex3d(6.0 * cos(0.07 * i), 1.2, 6.0 * sin(0.07 * i));
        glEnd();
    }
    /* Outlines that are as wide. */
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glLineWidth(9.0f);
    for (int i = 0; i < 45; i++) {
        double a = 0.14 * i;
        glBegin(GL_TRIANGLES);
        glVertex3d(5.0 * cos(a), -1.0, 5.0 * sin(a));
        glVertex3d(5.0 * cos(a + 0.05), -1.0, 5.0 * sin(a + 0.05));
        glVertex3d(5.0 * cos(a), -0.6, 5.0 * sin(a));
        glEnd();
    }
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glLineWidth(1.0f);
    glPointSize(1.0f);
}
