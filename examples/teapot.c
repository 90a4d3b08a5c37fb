/* A pot of swept surfaces in client arrays (glDrawElements): texture with mipmaps, separate specular,
 * two-sided lighting with a local viewer, a spot light, a lamp with attenuation. */
#include "demo.h"
#include <math.h>
#include <stdlib.h>

DEMO_NO_OPTIONS;

struct vertex { GLfloat uv[2], normal[3], position[3]; };
struct patch { struct vertex *vertices; GLushort *indices; int count; GLenum mode; };
typedef void (*surface)(double u, double v, double *p); /* u, v in 0..1 */

static void lathe(const double (*profile)[2], int last, double u, double v, double *p)
{ /* the profile (radius, height) as a Catmull-Rom curve */
    double t = v * last;
    int i = (int)t < last ? (int)t : last - 1;
    double f = t - i, c[2], a = 2.0 * M_PI * u;
    for (int k = 0; k < 2; k++) {
        double p0 = profile[i ? i - 1 : 0][k], p1 = profile[i][k], p2 = profile[i + 1][k],
               p3 = profile[i + 2 <= last ? i + 2 : last][k];
        c[k] = 0.5 * (2 * p1 + (p2 - p0) * f + (2 * p0 - 5 * p1 + 4 * p2 - p3) * f * f
                      + (3 * p1 - p0 - 3 * p2 + p3) * f * f * f);
    }
    p[0] = c[0] * cos(a);
    p[1] = c[1];
    p[2] = -c[0] * sin(a);
}

static void body(double u, double v, double *p)
{
    static const double curve[][2] = {{0.01, 0.0}, {0.8, 0.02}, {1.35, 0.4}, {1.6, 0.95}, {1.4, 1.5}, {1.05, 1.8}, {1.12, 1.92}};
    lathe(curve, 6, u, v, p);
}

static void lid(double u, double v, double *p)
{
    static const double curve[][2] = {{1.02, 0.0}, {0.85, 0.18}, {0.35, 0.3}, {0.14, 0.42}, {0.26, 0.6}, {0.01, 0.74}};
    lathe(curve, 5, u, v, p);
}

static void tube(double cx, double cy, double dx, double dy, double r, double u, double *p)
{ /* a circle around (cx, cy), at a right angle to the direction (dx, dy) */
    double l = sqrt(dx * dx + dy * dy), a = 2.0 * M_PI * u;
    p[0] = cx - r * cos(a) * dy / l;
    p[1] = cy + r * cos(a) * dx / l;
    p[2] = r * sin(a);
}

static void spout(double u, double v, double *p)
{
    tube(1.2 + 1.6 * v, 0.6 + 1.5 * v * v, 1.6, 3.0 * v, 0.42 - 0.26 * v, u, p);
}

static void handle(double u, double v, double *p)
{
    double a = M_PI * (0.5 + v);
    tube(-1.3 + 0.95 * cos(a), 1.05 + 0.6 * sin(a), -0.95 * sin(a), 0.6 * cos(a), 0.16, u, p);
}

static void table(double u, double v, double *p)
{
    p[0] = 9.0 * (u - 0.5);
    p[1] = 0.0;
    p[2] = 12.0 * (0.5 - v);
}

static struct patch sweep(surface s, int nu, int nv, double repeat, GLenum mode)
{
    struct patch m = {malloc(sizeof(struct vertex) * (size_t)((nu + 1) * (nv + 1))),
                      malloc(sizeof(GLushort) * (size_t)(6 * nu * nv)), 0, mode};
    if (!m.vertices || !m.indices)
        demo_fail(1, "out of memory");
    for (int j = 0; j <= nv; j++)
        for (int i = 0; i <= nu; i++) {
            struct vertex *o = &m.vertices[j * (nu + 1) + i];
            double u = (double)i / nu, v = (double)j / nv, d = 1e-4, p[3], a[3], b[3], c[3], e[3], n[3];
            s(u, v, p);
            s(u + d, v, a);
            s(u - d, v, b);
            s(u, v + d < 1.0 ? v + d : v, c);
            s(u, v - d > 0.0 ? v - d : v, e);
            for (int k = 0; k < 3; k++) {
                a[k] -= b[k];
                c[k] -= e[k];
                o->position[k] = (GLfloat)p[k];
            }
            for (int k = 0; k < 3; k++)
                n[k] = a[(k + 1) % 3] * c[(k + 2) % 3] - a[(k + 2) % 3] * c[(k + 1) % 3];
            double l = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
            for (int k = 0; k < 3; k++)
                o->normal[k] = (GLfloat)(l > 0.0 ? n[k] / l : k == 1);
            o->uv[0] = (GLfloat)(u * repeat);
            o->uv[1] = (GLfloat)(v * repeat);
        }
    for (int j = 0; j < nv; j++)
        for (int i = 0; i < nu; i++) {
            GLushort a = (GLushort)(j * (nu + 1) + i), b = (GLushort)(a + 1),
                     c = (GLushort)(b + nu + 1), d = (GLushort)(a + nu + 1);
            GLushort t[6] = {a, b, c, a, c, d}, q[4] = {a, b, c, d};
            int n = mode == GL_QUADS ? 4 : 6;
            for (int k = 0; k < n; k++)
                m.indices[m.count++] = mode == GL_QUADS ? q[k] : t[k];
        }
    return m;
}

static void draw(const struct patch *m)
{
    glVertexPointer(3, GL_FLOAT, sizeof(struct vertex), m->vertices->position);
    glNormalPointer(GL_FLOAT, sizeof(struct vertex), m->vertices->normal);
    glTexCoordPointer(2, GL_FLOAT, sizeof(struct vertex), m->vertices->uv);
    glDrawElements(m->mode, m->count, GL_UNSIGNED_SHORT, m->indices);
}

static struct patch pot, cover, nose, grip, floor_patch;
static GLuint china, wood;

void demo_setup(void)
{
    static const GLubyte white[3] = {250, 245, 235}, blue[3] = {90, 120, 210}, dark[3] = {130, 85, 50},
                         light[3] = {200, 150, 95};
    pot = sweep(body, 64, 48, 3.0, GL_TRIANGLES);
    cover = sweep(lid, 48, 24, 2.0, GL_TRIANGLES);
    nose = sweep(spout, 24, 24, 1.0, GL_QUADS);
    grip = sweep(handle, 16, 32, 1.0, GL_QUADS);
    floor_patch = sweep(table, 60, 80, 8.0, GL_QUADS);
    china = demo_checker(128, 8, white, blue);
    wood = demo_checker(128, 2, dark, light);
    glClearColor(0.08f, 0.07f, 0.11f, 1.0f);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_LIGHTING);
    glEnable(GL_LIGHT0);
    glEnable(GL_LIGHT1);
    glEnable(GL_TEXTURE_2D);
    glEnable(GL_NORMALIZE);
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
    glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
    glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, 1);
    glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, GL_SEPARATE_SPECULAR_COLOR);
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_NORMAL_ARRAY);
    glEnableClientState(GL_TEXTURE_COORD_ARRAY);
}

static void lights(double t)
{
    static const GLfloat warm[4] = {1.0f, 0.9f, 0.75f, 1.0f}, cool[4] = {0.9f, 1.0f, 1.2f, 1.0f}, none[4] = {0, 0, 0, 1};
    GLfloat lamp[4] = {(GLfloat)(4.0 * cos(t)), 4.0f, (GLfloat)(4.0 + 1.0 * sin(t)), 1.0f};
    GLfloat spot[4] = {-2.5f, 6.0f, 2.0f, 1.0f}, aim[3] = {(GLfloat)(0.42 + 0.1 * sin(2.0 * t)), -1.0f, -0.2f};
    glLightfv(GL_LIGHT0, GL_POSITION, lamp);
    glLightfv(GL_LIGHT0, GL_DIFFUSE, warm);
    glLightfv(GL_LIGHT0, GL_SPECULAR, warm);
    glLightf(GL_LIGHT0, GL_CONSTANT_ATTENUATION, 0.5f);
    glLightf(GL_LIGHT0, GL_LINEAR_ATTENUATION, 0.06f);
    glLightf(GL_LIGHT0, GL_QUADRATIC_ATTENUATION, 0.015f);
    glLightfv(GL_LIGHT1, GL_POSITION, spot);
    glLightfv(GL_LIGHT1, GL_SPOT_DIRECTION, aim);
    glLightf(GL_LIGHT1, GL_SPOT_CUTOFF, 28.0f);
    glLightf(GL_LIGHT1, GL_SPOT_EXPONENT, 12.0f);
    glLightfv(GL_LIGHT1, GL_DIFFUSE, cool);
    glLightfv(GL_LIGHT1, GL_SPECULAR, none);
}

void demo_frame(int frame)
{
    static const GLfloat shine[4] = {0.9f, 0.9f, 0.9f, 1.0f}, dull[4] = {0.1f, 0.1f, 0.1f, 1.0f},
                         outside[4] = {0.8f, 0.8f, 0.8f, 1.0f}, inside[4] = {0.9f, 0.45f, 0.2f, 1.0f};
    double t = demo_time(frame);
    demo_viewport(0, 0, demo_width, demo_height);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    demo_perspective(42.0, (double)demo_width / demo_height, 1.5, 40.0);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslated(0.0, -1.1, -7.5);
    glRotated(24.0, 1.0, 0.0, 0.0);
    lights(t);

    glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, outside);
    glMaterialfv(GL_BACK, GL_AMBIENT_AND_DIFFUSE, inside);
    glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, dull);
    glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, 8.0f);
    glBindTexture(GL_TEXTURE_2D, wood);
    draw(&floor_patch);

    glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, shine);
    glMaterialf(GL_FRONT, GL_SHININESS, 60.0f);
    glBindTexture(GL_TEXTURE_2D, china);
    glRotated(30.0 + 40.0 * t, 0.0, 1.0, 0.0);
    draw(&pot);
    draw(&nose);
    draw(&grip);
    glTranslated(0.5, 2.35, 0.0); /* lifted and tilted, so that the inside shows */
    glRotated(-25.0, 0.0, 0.0, 1.0);
    draw(&cover);
}
