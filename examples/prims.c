/* Every primitive mode of glBegin, flat and smooth, in four sub-viewports with four kinds of projection:
 * plain, mirrored or left-handed, orthographic, and one that includes the camera. Colours and materials
 * change inside begin/end; some vertices have w other than 1, or 0. */
#include "demo.h"
#include <math.h>

DEMO_NO_OPTIONS;

static const GLenum modes[10] = {GL_POINTS, GL_LINES, GL_LINE_STRIP, GL_LINE_LOOP, GL_TRIANGLES,
                                 GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN, GL_QUADS, GL_QUAD_STRIP, GL_POLYGON};

void demo_setup(void)
{
    static const GLfloat grey[4] = {0.4f, 0.4f, 0.4f, 1.0f};
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_LIGHT0);
    glEnable(GL_NORMALIZE);
    glPointSize(4.0f);
    glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, grey);
    glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, 12.0f);
    glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
}

static void corner(GLenum mode, int i, double *x, double *y)
{ /* strips zigzag, other modes run round */
    if (mode == GL_TRIANGLE_STRIP || mode == GL_QUAD_STRIP) {
        *x = -0.45 + 0.3 * (i / 2);
        *y = i % 2 ? 0.32 : -0.32;
    } else {
        double a = 2.0 * M_PI * i / 8.0 + 0.2;
        *x = 0.45 * cos(a);
        *y = 0.40 * sin(a);
    }
}

/* Eight vertices (nine for triangles: the last is incomplete, as are remainders of other modes). */
static void primitive(GLenum mode, int style, int frame)
{
    int count = mode == GL_TRIANGLES ? 7 : mode == GL_QUADS ? 9 : 8;
    glColor3d(1.0, 1.0, 1.0);
    glNormal3d(0.0, 0.0, 1.0);
    glBegin(mode);
    for (int i = 0; i < count; i++) {
        double x, y, z = 0.15 * (i % 3), w = style == 2 && i % 2 ? 2.0 : 1.0; /* every other vertex at the same place with w = 2 */
        GLfloat c[4] = {0.25f + 0.75f * (GLfloat)(i % 2), 0.21f + 0.1f * (GLfloat)i, 1.0f - 0.12f * (GLfloat)i, 1.0f};
        corner(mode, i, &x, &y);
        if (i != (frame & 1)) { /* the first or the second vertex keeps the colour that was set before */
            if (style == 1)
                glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, c);
            else
                glColor3fv(c);
        }
        glNormal3d(x, y, 0.8);
        glVertex4d(x * w, y * w, z * w, w);
    }
    glColor3d(0.11, 0.11, 0.11); /* too late for any vertex */
    glEnd();
}

/* Every mode unlit, lit by glMaterial, and lit by colour material with w = 2; each of these flat in one
 * frame and smooth in the next. */
static void zoo(int frame)
{
    for (int i = 0; i < 30; i++) {
        int mode = i % 10, style = i / 10;
        glPushMatrix();
        glTranslated(1.15 * (i % 6 - 2.5), 1.15 * (i / 6 - 2), 1.5 - 1.1 * (i % 4));
        glRotated(35.0 * sin(0.3 * frame + i), 0.2, 1.0, 0.0);
        glScaled(1.2, 1.2, 1.2);
        glShadeModel((i / 5 + mode + frame) % 2 ? GL_FLAT : GL_SMOOTH);
        if (style)
            glEnable(GL_LIGHTING);
        if (style == 2)
            glEnable(GL_COLOR_MATERIAL);
        primitive(modes[mode], style, frame);
        glDisable(GL_COLOR_MATERIAL);
        glDisable(GL_LIGHTING);
        glPopMatrix();
    }
    glShadeModel(GL_SMOOTH);
}

/* Lines and triangles that end at infinity, as sides of a shadow volume do. */
static void directions(void)
{
    glBegin(GL_LINES);
    for (int i = 0; i < 6; i++) {
        glColor3d(1.0, 0.91, 0.15 * i);
        glVertex4d(i - 2.5, -2.9, 2.0, 1.0);
        glVertex4d(0.12 * (i - 2.5), 0.02, -1.0, 0.0);
    }
    glEnd();
    glBegin(GL_TRIANGLES);
    glColor3d(0.2, 0.51, 0.31);
    glVertex3d(-4.0, 3.0, -4.0);
    glColor3d(0.51, 0.6, 0.2);
    glVertex3d(4.0, 3.0, -4.0);
    glColor3d(0.11, 0.2, 0.4);
    glVertex4d(0.0, -0.1, -1.0, 0.0);
    glEnd();
}

static int w2, h2;

static void sub_viewport(int column, int row, double r, double g, double b)
{
    demo_viewport(column * w2, row * h2, w2, h2);
    demo_scissor(column * w2, row * h2, w2, h2);
    glClearColor((GLclampf)r, (GLclampf)g, (GLclampf)b, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    demo_scissor(column * w2 + 6, row * h2 + 6, w2 - 12, h2 - 12);
    glClearColor((GLclampf)(r * 0.4), (GLclampf)(g * 0.4), (GLclampf)(b * 0.4), 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
}

static void camera(void)
{
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslated(0.0, 0.0, -8.0);
}

void demo_frame(int frame)
{
    double aspect;
    w2 = demo_width / 2;
    h2 = demo_height / 2;
    aspect = (double)w2 / h2;

    /* Plain perspective, lower left. */
    sub_viewport(0, 0, 0.3, 0.4, 0.6);
    demo_perspective(44.0, aspect, 1.0, 60.0);
    camera();
    directions();
    zoo(frame);

    /* Mirrored (even frames) or left-handed (odd), lower right. */
    sub_viewport(1, 0, 0.6, 0.4, 0.3);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-0.4 * aspect, 0.4 * aspect, -0.4, 0.4, 1.0, 60.0);
    glScaled(frame % 2 ? 1.0 : -1.0, 1.0, frame % 2 ? -1.0 : 1.0);
    demo_projection_done();
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glScaled(1.0, 1.0, frame % 2 ? -1.0 : 1.0);
    glTranslated(0.0, 0.0, -8.0);
    zoo(frame);

    /* Orthographic, upper left, with a perspective inset by push and pop of the projection. */
    sub_viewport(0, 1, 0.3, 0.6, 0.4);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(-3.2 * aspect, 3.2 * aspect, -3.2, 3.2, 1.0, 60.0);
    camera();
    zoo(frame);
    glMatrixMode(GL_PROJECTION);
    glPushMatrix();
    demo_scissor(w2 / 2, h2 + h2 / 2, w2 / 2 - 10, h2 / 2 - 10);
    glClear(GL_DEPTH_BUFFER_BIT);
    demo_viewport(w2 / 2, h2 + h2 / 2, w2 / 2, h2 / 2);
    demo_perspective(50.0, aspect, 1.0, 60.0);
    camera();
    zoo(frame);
    glMatrixMode(GL_PROJECTION);
    glPopMatrix();
    demo_viewport(0, h2, w2, h2); /* orthographic again */
    demo_scissor(0, h2, w2, h2);
    camera();
    glTranslated(0.0, -2.7, 3.0);
    primitive(GL_QUAD_STRIP, 0, frame);

    /* The camera in the projection matrix, upper right. */
    sub_viewport(1, 1, 0.55, 0.35, 0.6);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-0.4 * aspect, 0.4 * aspect, -0.4, 0.4, 1.0, 60.0);
    glRotated(15.0, 1.0, 0.0, 0.0);
    glRotated(16.0, 0.0, 1.0, 0.0);
    glTranslated(2.2, -1.8, -7.5);
    demo_projection_done();
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    directions();
    zoo(frame);
    demo_scissor_off();
}
