/* Points and lines: wide, smooth, stippled, attenuated, sprites; polygons as lines and points with edge
 * flags; polygon stipple. */
#include "demo.h"
#include <math.h>

DEMO_NO_OPTIONS;

static GLuint spark;

void demo_setup(void)
{
    static GLubyte texels[32][32][4];
    for (int y = 0; y < 32; y++) /* a disc with a bright corner, which would show a flip */
        for (int x = 0; x < 32; x++) {
            double r = hypot(x - 15.5, y - 15.5) / 15.5;
            texels[y][x][0] = 255;
            texels[y][x][1] = (GLubyte)(x * 8);
            texels[y][x][2] = (GLubyte)(y * 8);
            texels[y][x][3] = (GLubyte)(r < 1.0 ? 255.0 * (1.0 - r * r) : 0.0);
        }
    glGenTextures(1, &spark);
    glBindTexture(GL_TEXTURE_2D, spark);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 32, 32, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    glClearColor(0.05f, 0.06f, 0.11f, 1.0f);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glEnable(GL_DEPTH_TEST);
}

static void helix(GLenum mode, int count, double x, double y, double radius, double turns, double t)
{
    glBegin(mode);
    for (int i = 0; i < count; i++) {
        double f = (double)i / count, a = 2.0 * M_PI * turns * f + t;
        glColor3d(0.31 + 0.71 * f, 1.0 - 0.6 * f, 0.51 + 0.51 * sin(6.0 * f));
        glVertex3d(x + radius * cos(a), y + radius * sin(a), 3.0 - 9.0 * f);
    }
    glEnd();
}

static void ring(GLenum mode, double x, double y, double z, double radius, int corners)
{
    glBegin(mode);
    for (int i = 0; i < corners; i++) {
        double a = 2.0 * M_PI * i / corners;
        glColor3d(0.51 + 0.51 * cos(a), 0.71, 0.51 + 0.51 * sin(a));
        glEdgeFlag(mode != GL_POLYGON || i % 3 != 0);
        glVertex3d(x + radius * cos(a), y + radius * sin(a), z + 0.5 * sin(a));
    }
    glEdgeFlag(GL_TRUE);
    glEnd();
}

static void points(double t)
{
    static const GLfloat fades[3] = {0.0f, 0.0f, 0.012f}, constant[3] = {1.0f, 0.0f, 0.0f};
    glPointSize(5.0f); /* plain, wide */
    helix(GL_POINTS, 60, -2.0, 1.2, 0.7, 4.0, t);

    glEnable(GL_BLEND); /* smooth, smaller with the distance, faded below the threshold */
    glEnable(GL_POINT_SMOOTH);
    glPointSize(8.0f);
    glPointParameterfv(GL_POINT_DISTANCE_ATTENUATION, fades);
    glPointParameterf(GL_POINT_SIZE_MIN, 2.0f);
    glPointParameterf(GL_POINT_FADE_THRESHOLD_SIZE, 4.0f);
    helix(GL_POINTS, 80, 2.0, 1.2, 0.7, 5.0, -t);
    glDisable(GL_POINT_SMOOTH);

    glEnable(GL_TEXTURE_2D); /* sprites */
    glEnable(GL_POINT_SPRITE);
    glTexEnvi(GL_POINT_SPRITE, GL_COORD_REPLACE, GL_TRUE);
    glPointSize(40.0f);
    glDepthMask(GL_FALSE);
    helix(GL_POINTS, 24, 0.0, 1.2, 0.6, 2.0, t);
    glDepthMask(GL_TRUE);
    glTexEnvi(GL_POINT_SPRITE, GL_COORD_REPLACE, GL_FALSE);
    glDisable(GL_POINT_SPRITE);
    glDisable(GL_TEXTURE_2D);
    glDisable(GL_BLEND);
    glPointParameterfv(GL_POINT_DISTANCE_ATTENUATION, constant);
    glPointParameterf(GL_POINT_SIZE_MIN, 0.0f);
    glPointParameterf(GL_POINT_FADE_THRESHOLD_SIZE, 1.0f);
}

static void lines(double t)
{
    glLineWidth(1.0f);
    helix(GL_LINE_STRIP, 200, -2.4, -0.6, 0.6, 6.0, -t);
    glLineWidth(4.0f);
    helix(GL_LINES, 60, 2.4, -0.6, 0.6, 3.0, t);
    glEnable(GL_LINE_STIPPLE);
    glLineStipple(2, 0x1C47);
    glLineWidth(2.0f);
    for (int i = 0; i < 5; i++)
        ring(GL_LINE_LOOP, 0.0, -0.5, 2.0 - 2.0 * i, 0.6 + 0.1 * i, 12);
    glDisable(GL_LINE_STIPPLE);
    glEnable(GL_BLEND);
    glEnable(GL_LINE_SMOOTH);
    glLineWidth(3.0f);
    helix(GL_LINE_STRIP, 60, 0.0, 1.2, 1.1, 2.0, 2.0 * t);
    glDisable(GL_LINE_SMOOTH);
    glDisable(GL_BLEND);
    glLineWidth(1.0f);
}

static void polygons(double t)
{
    static GLubyte halftone[128];
    for (int i = 0; i < 128; i++)
        halftone[i] = i / 8 % 2 ? 0x33 : 0xC6;
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glLineWidth(2.0f);
    ring(GL_POLYGON, -1.5, -1.9, 1.5, 0.6, 9); /* every third edge is missing */
    glPushMatrix();
    glTranslated(0.0, -1.9, 0.5);
    glRotated(60.0 * t + 20.0, 0.4, 1.0, 0.2);
    glColor3f(1.0f, 0.8f, 0.31f);
    demo_box(0.5, 0.5, 0.5); /* quads: no diagonals */
    glPopMatrix();
    glPolygonMode(GL_FRONT_AND_BACK, GL_POINT);
    glPointSize(3.0f);
    glPushMatrix();
    glTranslated(1.6, -1.9, 0.8);
    glRotated(40.0 * t, 0.0, 1.0, 0.3);
    glColor3f(0.4f, 1.0f, 0.91f);
    demo_sphere(0.6, 16, 10);
    glPopMatrix();
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glEnable(GL_POLYGON_STIPPLE);
    glPolygonStipple(halftone);
    ring(GL_POLYGON, 0.0, 0.0, -7.0, 5.0, 24); /* a stippled screen behind everything */
    glDisable(GL_POLYGON_STIPPLE);
    glLineWidth(1.0f);
}

void demo_frame(int frame)
{
    double t = demo_time(frame);
    demo_viewport(0, 0, demo_width, demo_height);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    demo_perspective(42.0, (double)demo_width / demo_height, 1.5, 40.0);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslated(0.0, 0.2, -7.5);
    polygons(t);
    lines(t);
    points(t);
}
