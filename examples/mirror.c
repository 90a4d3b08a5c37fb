/* A mirror by stencil (the scene again under glScaled(1,1,-1), with the other front face) and planar shadows with polygon offset and blending. */
#include "demo.h"
#include <math.h>

DEMO_NO_OPTIONS;

static GLuint floor_texture;
static const GLfloat light[4] = {-3.0f, 7.0f, 5.0f, 1.0f};

void demo_setup(void)
{
    static const GLubyte a[3] = {215, 205, 185}, b[3] = {120, 95, 80};
    static const GLfloat shine[4] = {0.7f, 0.7f, 0.7f, 1.0f};
    floor_texture = demo_checker(64, 2, a, b);
    glClearColor(0.31f, 0.36f, 0.45f, 1.0f);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    glEnable(GL_LIGHTING);
    glEnable(GL_LIGHT0);
    glEnable(GL_NORMALIZE);
    glEnable(GL_COLOR_MATERIAL);
    glMaterialfv(GL_FRONT, GL_SPECULAR, shine);
    glMaterialf(GL_FRONT, GL_SHININESS, 40.0f);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glPolygonOffset(-1.0f, -2.0f);
}

/* The mirror stands in the plane z = 0 and looks along +z; the floor is y = 0. */
static void objects(double t, int coloured)
{
    glPushMatrix();
    glTranslated(-1.2, 1.0, 1.6);
    glRotated(50.0 * t + 20.0, 0.2, 1.0, 0.1);
    if (coloured)
        glColor3f(0.91f, 0.31f, 0.2f);
    demo_torus(0.65, 0.28, 40, 20);
    glPopMatrix();
    glPushMatrix();
    glTranslated(1.1, 0.6 + 0.4 * fabs(sin(3.0 * t)), 3.4);
    if (coloured)
        glColor3f(0.2f, 0.6f, 0.91f);
    demo_sphere(0.55, 32, 16);
    glPopMatrix();
    glPushMatrix();
    glTranslated(0.7, 0.75, 1.2);
    glRotated(-30.0 * t + 15.0, 0.0, 1.0, 0.0);
    if (coloured)
        glColor3f(0.4f, 0.85f, 0.31f);
    demo_box(0.4, 0.75, 0.4);
    glPopMatrix();
}

static void floor_quads(void)
{
    glEnable(GL_TEXTURE_2D);
    glBindTexture(GL_TEXTURE_2D, floor_texture);
    glColor3f(1.0f, 1.0f, 1.0f);
    glNormal3d(0.0, 1.0, 0.0);
    glBegin(GL_QUADS);
    for (int z = 0; z < 8; z++)
        for (int x = -5; x < 5; x++)
            for (int c = 0; c < 4; c++) {
                int dx = c == 1 || c == 2, dz = c < 2;
                glTexCoord2d(0.5 * (x + dx), 0.5 * (z + dz));
                glVertex3d(x + dx, 0.0, z + dz);
            }
    glEnd();
    glDisable(GL_TEXTURE_2D);
}

/* Projects everything onto y = 0 from the light. */
static void shadows(double t)
{
    GLfloat m[16] = {light[1], 0, 0, 0, -light[0], 0, -light[2], -1, 0, 0, light[1], 0, 0, 0, 0, light[1]};
    glEnable(GL_STENCIL_TEST); /* darkens each pixel once: the stencil counts up where it was equal */
    glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glEnable(GL_BLEND);
    glDisable(GL_LIGHTING);
    glDisable(GL_CULL_FACE);
    glDepthMask(GL_FALSE);
    glColor4f(0.0f, 0.0f, 0.05f, 0.51f);
    glPushMatrix();
    glMultMatrixf(m);
    objects(t, 0);
    glPopMatrix();
    glDepthMask(GL_TRUE);
    glEnable(GL_CULL_FACE);
    glEnable(GL_LIGHTING);
    glDisable(GL_BLEND);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDisable(GL_STENCIL_TEST);
}

static void upright(double x0, double y0, double x1, double y1)
{
    glNormal3d(0.0, 0.0, 1.0);
    glBegin(GL_QUADS);
    glVertex3d(x0, y0, 0.0);
    glVertex3d(x1, y0, 0.0);
    glVertex3d(x1, y1, 0.0);
    glVertex3d(x0, y1, 0.0);
    glEnd();
}

static void mirror(void) { upright(-2.6, 0.25, 2.6, 3.0); }

static void mirror_frame(void)
{
    upright(-2.75, 0.1, 2.75, 0.25);
    upright(-2.75, 3.0, 2.75, 3.15);
    upright(-2.75, 0.25, -2.6, 3.0);
    upright(2.6, 0.25, 2.75, 3.0);
}

void demo_frame(int frame)
{
    double t = demo_time(frame);
    demo_viewport(0, 0, demo_width, demo_height);
    glClearStencil(0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    demo_perspective(40.0, (double)demo_width / demo_height, 1.5, 50.0);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslated(0.0, -1.2, -9.5);
    glRotated(14.0, 1.0, 0.0, 0.0);
    glRotated(12.0 * sin(t) + 10.0, 0.0, 1.0, 0.0);

    glEnable(GL_STENCIL_TEST); /* 1 where the mirror is visible */
    glStencilFunc(GL_ALWAYS, 1, 255);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glDepthMask(GL_FALSE);
    mirror();
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glStencilFunc(GL_EQUAL, 1, 255);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);

    glPushMatrix(); /* the reflected scene, only inside the mirror */
    glScaled(1.0, 1.0, -1.0);
    glFrontFace(GL_CW);
    glLightfv(GL_LIGHT0, GL_POSITION, light);
    objects(t, 1);
    floor_quads();
    glStencilFunc(GL_EQUAL, 1, 255);
    shadows(t);
    glFrontFace(GL_CCW);
    glPopMatrix();
    glDisable(GL_STENCIL_TEST);

    glLightfv(GL_LIGHT0, GL_POSITION, light);
    glEnable(GL_BLEND); /* the glass, slightly blue; it writes depths as well */
    glDisable(GL_LIGHTING);
    glColor4f(0.31f, 0.45f, 0.71f, 0.25f);
    mirror();
    glDisable(GL_BLEND);
    glEnable(GL_LIGHTING);
    glColor3f(0.75f, 0.6f, 0.25f);
    mirror_frame();

    glClear(GL_STENCIL_BUFFER_BIT);
    floor_quads();
    glStencilFunc(GL_EQUAL, 0, 255);
    shadows(t);
    objects(t, 1);
}
