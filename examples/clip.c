/* User clip planes, from one to six, cutting solids; two of the solids are capped with the stencil. */
#include "demo.h"
#include <math.h>

DEMO_NO_OPTIONS;

typedef void (*solid)(void);

static void ball(void) { demo_sphere(1.0, 40, 20); }
static void ring(void) { demo_torus(0.75, 0.34, 40, 20); }
static void block(void) { demo_box(0.8, 0.8, 0.8); }
static void rod(void) { demo_box(0.4, 1.1, 0.4); }

void demo_setup(void)
{
    static const GLfloat grey[4] = {0.3f, 0.3f, 0.3f, 1.0f};
    glClearColor(0.16f, 0.14f, 0.20f, 1.0f);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_LIGHTING);
    glEnable(GL_LIGHT0);
    glEnable(GL_NORMALIZE);
    glEnable(GL_COLOR_MATERIAL);
    glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
    glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, grey);
    glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, 20.0f);
}

static void planes_on(int count, int except)
{
    for (int i = 0; i < 6; i++)
        if (i < count && i != except)
            glEnable(GL_CLIP_PLANE0 + (GLenum)i);
        else
            glDisable(GL_CLIP_PLANE0 + (GLenum)i);
}

static void plane_quad(const GLdouble *p, double half)
{ /* a square in the plane, around its point nearest to the origin, facing the side that is cut away */
    double u[3], v[3], n[3] = {-p[0], -p[1], -p[2]};
    int least = fabs(n[0]) < fabs(n[1]) ? (fabs(n[0]) < fabs(n[2]) ? 0 : 2) : (fabs(n[1]) < fabs(n[2]) ? 1 : 2);
    double axis[3] = {least == 0, least == 1, least == 2};
    for (int k = 0; k < 3; k++)
        u[k] = axis[(k + 1) % 3] * n[(k + 2) % 3] - axis[(k + 2) % 3] * n[(k + 1) % 3];
    double l = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    for (int k = 0; k < 3; k++)
        u[k] /= l;
    for (int k = 0; k < 3; k++)
        v[k] = n[(k + 1) % 3] * u[(k + 2) % 3] - n[(k + 2) % 3] * u[(k + 1) % 3];
    glNormal3dv(n);
    glBegin(GL_QUADS);
    for (int c = 0; c < 4; c++) {
        double s = c == 1 || c == 2 ? half : -half, t = c >= 2 ? half : -half;
        glVertex3d(p[3] * n[0] + s * u[0] + t * v[0], p[3] * n[1] + s * u[1] + t * v[1], p[3] * n[2] + s * u[2] + t * v[2]);
    }
    glEnd();
}

/* Draws the cut surface where a ray meets more back faces than front faces of the cut solid. */
static void cap(solid draw, const GLdouble (*planes)[4], int count)
{
    glEnable(GL_STENCIL_TEST);
    for (int i = 0; i < count; i++) {
        glClear(GL_STENCIL_BUFFER_BIT);
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        glDepthMask(GL_FALSE);
        glDisable(GL_DEPTH_TEST);
        planes_on(0, -1);
        glEnable(GL_CLIP_PLANE0 + (GLenum)i);
        glStencilFunc(GL_ALWAYS, 0, 255);
        glEnable(GL_CULL_FACE);
        glCullFace(GL_FRONT);
        glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);
        draw();
        glCullFace(GL_BACK);
        glStencilOp(GL_KEEP, GL_KEEP, GL_DECR);
        draw();
        glDisable(GL_CULL_FACE);
        glEnable(GL_DEPTH_TEST);
        glDepthMask(GL_TRUE);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        planes_on(count, i);
        glStencilFunc(GL_NOTEQUAL, 0, 255);
        glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
        glColor3d(0.95, 0.81 - 0.15 * i, 0.31);
        plane_quad(planes[i], 2.0);
    }
    glDisable(GL_STENCIL_TEST);
}

static void cut(solid draw, int count, const GLdouble (*planes)[4], int capped, double r, double g, double b)
{
    for (int i = 0; i < count; i++)
        glClipPlane(GL_CLIP_PLANE0 + (GLenum)i, planes[i]);
    planes_on(count, -1);
    glColor3d(r, g, b);
    draw();
    if (capped)
        cap(draw, planes, count);
    planes_on(0, -1);
}

static void at(double x, double y, double z, double turn)
{
    glLoadIdentity();
    glTranslated(x, y, z - 8.0);
    glRotated(turn, 0.3, 1.0, 0.0);
}

void demo_frame(int frame)
{
    static const GLfloat light[4] = {1.5f, 2.5f, 2.0f, 0.0f};
    double t = demo_time(frame), s = 0.25 * sin(2.0 * t), c = sqrt(0.5);
    const GLdouble one[1][4] = {{-c, -c, 0.0, 0.2 + s}};
    const GLdouble two[2][4] = {{0.0, -1.0, 0.0, 0.3 + s}, {0.0, 0.0, -1.0, 0.2}};
    const GLdouble three[3][4] = {{-1.0, 0.0, 0.0, 0.55}, {0.0, 1.0, 0.0, 0.6 + s}, {0.0, 0.0, -1.0, 0.15}};
    const GLdouble four[4][4] = {{c, c, 0.0, 0.5}, {-c, c, 0.0, 0.5}, {c, -c, 0.0, 0.5 + s}, {-c, -c, 0.0, 0.5}};
    const GLdouble five[5][4] = {{1, 0, 0, 0.7}, {-1, 0, 0, 0.7}, {0, 1, 0, 0.7}, {0, -1, 0, 0.4 + s}, {0, 0, -1, 0.4}};
    const GLdouble six[6][4] = {{1, 0, 0, 0.8}, {-1, 0, 0, 0.8}, {0, 1, 0, 0.8}, {0, -1, 0, 0.8}, {0, 0, 1, 0.8}, {0, 0, -1, 0.8 + s}};

    demo_viewport(0, 0, demo_width, demo_height);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    demo_perspective(42.0, (double)demo_width / demo_height, 1.5, 40.0);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glLightfv(GL_LIGHT0, GL_POSITION, light);
    at(-1.8, 0.9, 1.2, 30.0 + 30.0 * t);
    cut(block, 1, one, 0, 0.9, 0.3, 0.3);
    at(0.2, -0.8, 2.0, -35.0 + 20.0 * t);
    cut(ball, 2, two, 1, 0.3, 0.8, 0.4);
    at(2.0, 0.9, 0.8, -30.0);
    cut(ring, 3, three, 1, 0.41, 0.52, 0.95);
    at(-2.6, -1.6, -0.5, 40.0 * t);
    cut(rod, 4, four, 0, 0.8, 0.4, 0.8);
    at(0.3, 1.9, -3.0, -20.0 * t);
    cut(ball, 5, five, 0, 0.3, 0.8, 0.9);
    at(3.1, -1.7, -1.5, 25.0 + 40.0 * t);
    cut(ball, 6, six, 0, 0.91, 0.81, 0.52);

    glLoadIdentity(); /* a plane given in eye space cuts the wall at the back */
    const GLdouble eye[1][4] = {{-0.6, 0.8, 0.0, 1.0 + s}};
    glClipPlane(GL_CLIP_PLANE0, eye[0]);
    planes_on(1, -1);
    glTranslated(0.0, 0.0, -15.0);
    glColor3d(0.35, 0.31, 0.45);
    demo_box(9.0, 6.0, 0.5);
    planes_on(0, -1);
}
