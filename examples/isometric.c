/* An orthographic scene, as isometric games and CAD programs have it: a floor of tiles, towers with light, a river that is blended, trees as
 * pictures that face the eye, a ring that is seen from the front, and over it a flat display without depths. */
#include "demo.h"
#include <math.h>

DEMO_NO_OPTIONS;

enum { SIDE = 7 };
static GLuint paving;

static double height(int i, int j) { return 0.3 + 0.55 * ((5 * i + 3 * j) % 4); }

/* A square of the floor, one wide. */
static void tile(double x, double z)
{
    static const int corners[4][2] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    glBegin(GL_QUADS);
    for (int c = 0; c < 4; c++) {
        glTexCoord2iv(corners[c]);
        glVertex3d(x + corners[c][0], 0.0, z + corners[c][1]);
    }
    glEnd();
}

static void town(double t)
{
    static const GLfloat sun[4] = {0.3f, 0.9f, 0.5f, 0.0f};
    glLightfv(GL_LIGHT0, GL_POSITION, sun);
    glEnable(GL_TEXTURE_2D);
    glBindTexture(GL_TEXTURE_2D, paving);
    glColor3f(1.0f, 1.0f, 1.0f);
    glNormal3d(0.0, 1.0, 0.0);
    for (int i = 0; i < SIDE; i++)
        for (int j = 0; j < SIDE; j++)
            tile(i - SIDE / 2.0, j - SIDE / 2.0);
    glDisable(GL_TEXTURE_2D);
    for (int i = 0; i < SIDE; i++)
        for (int j = i % 2; j < SIDE; j += 2) {
            double h = height(i, j);
            glPushMatrix();
            glTranslated(i + 0.5 - SIDE / 2.0, h, j + 0.5 - SIDE / 2.0);
            glRotated(15.0 * i + 40.0 * t, 0.0, 1.0, 0.0);
            glColor3d(0.4 + 0.08 * i, 0.9 - 0.09 * j, 0.5 + 0.06 * ((i + j) % 5));
            demo_box(0.22, h, 0.22);
            glPopMatrix();
        }
    glDisable(GL_LIGHTING);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glColor4f(0.2f, 0.5f, 0.9f, 0.5f);
    glBegin(GL_QUADS);
    glVertex3d(-3.5, 0.2, -0.5);
    glVertex3d(-3.5, 0.2, 0.5);
    glVertex3d(3.5, 0.2, 0.5);
    glVertex3d(3.5, 0.2, -0.5);
    glEnd();
    glDisable(GL_BLEND);
}

/* Trees that face the eye: placed by the camera, drawn without it. */
static void trees(void)
{
    GLfloat m[16];
    glGetFloatv(GL_MODELVIEW_MATRIX, m);
    glPushMatrix();
    glLoadIdentity();
    for (int i = 0; i < SIDE; i++)
        for (int j = 1 - i % 2; j < SIDE; j += 2) {
            double x = i + 0.5 - SIDE / 2.0, z = j + 0.5 - SIDE / 2.0, at[3];
            for (int r = 0; r < 3; r++)
                at[r] = m[r] * x + m[8 + r] * z + m[12 + r];
            glColor3d(0.1, 0.4 + 0.07 * i, 0.15 + 0.02 * j);
            glBegin(GL_TRIANGLES);
            glVertex3d(at[0] - 0.25, at[1], at[2]);
            glVertex3d(at[0] + 0.25, at[1], at[2]);
            glVertex3d(at[0], at[1] + 0.9, at[2]);
            glEnd();
        }
    glPopMatrix();
}

static void display(int frame)
{
    glDisable(GL_DEPTH_TEST);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(0.0, 512.0, 0.0, 384.0, -1.0, 1.0);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glColor3f(0.1f, 0.1f, 0.15f);
    glRecti(10, 10, 150, 40);
    glColor3f(0.9f, 0.8f, 0.2f);
    for (int k = 0; k < 6; k++)
        glRecti(18 + 21 * k, 16, 33 + 21 * k, 20 + 3 * ((k + frame) % 6));
    glEnable(GL_DEPTH_TEST);
}

void demo_setup(void)
{
    static const GLubyte grey[3] = {150, 150, 140}, pale[3] = {205, 200, 180};
    paving = demo_checker(32, 4, grey, pale);
    glClearColor(0.2f, 0.25f, 0.3f, 1.0f);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_LIGHT0);
    glEnable(GL_NORMALIZE);
    glEnable(GL_COLOR_MATERIAL);
}

void demo_frame(int frame)
{
    double wide = 4.2 * demo_width / demo_height;
    demo_viewport(0, 0, demo_width, demo_height);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(-wide, wide, -4.2, 4.2, 1.0, 17.0);
    demo_slanted_done();
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslated(0.0, -0.4, -8.5);
    glRotated(35.0, 1.0, 0.0, 0.0);
    glRotated(45.0, 0.0, 1.0, 0.0);
    glEnable(GL_LIGHTING);
    town(demo_time(frame));
    trees();
    glLoadIdentity();
    glTranslated(3.6, 2.4, -6.0);
    glEnable(GL_LIGHTING);
    glColor3f(0.9f, 0.4f, 0.3f);
    demo_torus(0.7, 0.3, 24, 12);
    glDisable(GL_LIGHTING);
    display(frame);
}
