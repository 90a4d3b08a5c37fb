/* Three meshing gears: begin/end quads and quad strips, flat and smooth shading, one light. */
#include "demo.h"
#include <math.h>

DEMO_NO_OPTIONS;

/* The outline of tooth t at corner c (0 and 3 at the root, 1 and 2 at the tip). */
static void outline(double root, double tip, int teeth, int corner, double *x, double *y)
{
    double a = 2.0 * M_PI * corner / (4.0 * teeth);
    double r = (corner & 3) == 1 || (corner & 3) == 2 ? tip : root;
    *x = r * cos(a);
    *y = r * sin(a);
}

static void gear(double bore, double root, double tip, double thickness, int teeth)
{
    double x, y, z = thickness / 2.0;
    int corners = 4 * teeth;

    glShadeModel(GL_FLAT);
    for (int side = 1; side >= -1; side -= 2) { /* the two faces */
        glNormal3d(0.0, 0.0, side);
        glBegin(GL_QUAD_STRIP);
        for (int c = 0; c <= corners; c++) {
            int k = side > 0 ? c : corners - c;
            double a = 2.0 * M_PI * k / corners;
            outline(root, root, teeth, k, &x, &y);
            glVertex3d(bore * cos(a), bore * sin(a), side * z);
            glVertex3d(x, y, side * z);
        }
        glEnd();
        glBegin(GL_QUADS);
        for (int t = 0; t < teeth; t++)
            for (int c = 0; c < 4; c++) {
                outline(root, tip, teeth, 4 * t + (side > 0 ? c : 3 - c), &x, &y);
                glVertex3d(x, y, side * z);
            }
        glEnd();
    }
    glBegin(GL_QUADS); /* the outer rim, with a normal for each flank */
    for (int c = 0; c < corners; c++) {
        double x1, y1;
        outline(root, tip, teeth, c, &x, &y);
        outline(root, tip, teeth, c + 1, &x1, &y1);
        glNormal3d(y1 - y, x - x1, 0.0);
        glVertex3d(x, y, z);
        glVertex3d(x, y, -z);
        glVertex3d(x1, y1, -z);
        glVertex3d(x1, y1, z);
    }
    glEnd();
    glShadeModel(GL_SMOOTH);
    glBegin(GL_QUAD_STRIP); /* the bore */
    for (int c = 0; c <= corners; c++) {
        double a = 2.0 * M_PI * c / corners;
        glNormal3d(-cos(a), -sin(a), 0.0);
        glVertex3d(bore * cos(a), bore * sin(a), -z);
        glVertex3d(bore * cos(a), bore * sin(a), z);
    }
    glEnd();
}

void demo_setup(void)
{
    static const GLfloat dim[4] = {0.15f, 0.15f, 0.18f, 1.0f};
    glClearColor(0.11f, 0.12f, 0.16f, 1.0f);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    glEnable(GL_LIGHTING);
    glEnable(GL_LIGHT0);
    glEnable(GL_NORMALIZE);
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, dim);
}

static void place(double x, double y, double z, double angle, const GLfloat *colour,
                  double bore, double root, double tip, double thickness, int teeth)
{
    static const GLfloat white[4] = {0.6f, 0.6f, 0.6f, 1.0f};
    glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, colour);
    glMaterialfv(GL_FRONT, GL_SPECULAR, white);
    glMaterialf(GL_FRONT, GL_SHININESS, 24.0f);
    glPushMatrix();
    glTranslated(x, y, z);
    glRotated(angle, 0.0, 0.0, 1.0);
    gear(bore, root, tip, thickness, teeth);
    glPopMatrix();
}

void demo_frame(int frame)
{
    static const GLfloat light[4] = {4.0f, 6.0f, 8.0f, 0.0f};
    static const GLfloat red[4] = {0.85f, 0.15f, 0.05f, 1.0f}, green[4] = {0.05f, 0.75f, 0.25f, 1.0f},
                         blue[4] = {0.25f, 0.30f, 0.95f, 1.0f};
    double angle = 70.0 * demo_time(frame);

    demo_viewport(0, 0, demo_width, demo_height);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    demo_perspective(46.0, (double)demo_width / demo_height, 2.0, 40.0);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glLightfv(GL_LIGHT0, GL_POSITION, light);
    glTranslated(0.2, -0.3, -8.8);
    glRotated(25.0, 1.0, 0.0, 0.0);
    glRotated(40.0 + 10.0 * sin(demo_time(frame)), 0.0, 1.0, 0.0);

    /* The big gear has twice the teeth, so it turns at half the speed of the others. */
    place(-1.35, -0.75, 0.0, angle, red, 0.45, 1.75, 2.20, 0.9, 20);
    place(1.80, -0.95, 0.0, -2.0 * angle - 9.0, green, 0.25, 0.75, 1.20, 1.6, 10);
    place(-1.45, 2.38, 0.0, -2.0 * angle - 25.0, blue, 0.60, 0.75, 1.20, 0.5, 10);

    /* The same gear far and near, scaled, to show depth. */
    glScaled(0.8, 0.8, 0.8);
    place(3.8, 2.6, -4.5, angle, blue, 0.4, 1.6, 2.1, 0.6, 16);
    place(-1.3, -1.0, 3.2, -angle, green, 0.3, 0.7, 1.0, 0.3, 8);
}
