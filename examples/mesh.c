/* One big closed surface, a knotted tube with ripples, with normals and one light: by glDrawElements from client arrays
 * or (--vbo) from buffer objects and, where there is one, a vertex array object; or by glBegin/glEnd, called in each
 * frame (--immediate) or once, into a display list (--list). */
#include "demo.h"
#include <math.h>
#include <stdlib.h>

static int triangles = 100000, vbo, immediate, list;
const struct demo_option demo_options[] = {
    {"--triangles", "1000 to 4000000 (default 100000)", &triangles, 1},
    {"--vbo", "buffer objects in place of client arrays", &vbo, 0},
    {"--immediate", "glBegin/glEnd in place of arrays", &immediate, 0},
    {"--list", "the same in a display list", &list, 0},
    {0}};

struct vertex { GLfloat position[3], normal[3]; };
static struct vertex *vertices;
static GLuint *indices;
static GLsizei index_count;
static PFNGLBINDVERTEXARRAYPROC bind_vertex_array;
static GLuint array_object, display_list;

static void knot(double a, double *p)
{ /* a (2,3) torus knot */
    double r = 1.65 + 0.6 * cos(3.0 * a);
    p[0] = r * cos(2.0 * a);
    p[1] = r * sin(2.0 * a);
    p[2] = 0.75 * sin(3.0 * a);
}

static void cross(const double *a, const double *b, double *n)
{
    for (int k = 0; k < 3; k++)
        n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    double l = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++)
        n[k] /= l;
}

static void surface(double a, double b, double *p)
{ /* a runs along the knot, b around it */
    static const double z_axis[3] = {0.0, 0.0, 1.0}; /* never parallel to the knot */
    double c0[3], c1[3], along[3], side[3], up[3];
    knot(a - 1e-4, c0);
    knot(a + 1e-4, c1);
    knot(a, p);
    for (int k = 0; k < 3; k++)
        along[k] = c1[k] - c0[k];
    cross(along, z_axis, side);
    cross(side, along, up);
    double r = 0.34 + 0.03 * sin(40.0 * a + 6.0 * b) + 0.015 * cos(12.0 * b);
    for (int k = 0; k < 3; k++)
        p[k] += r * (cos(b) * side[k] + sin(b) * up[k]);
}

static void build(void)
{
    int around = (int)sqrt(triangles / 32.0), along = triangles / 2 / around;
    size_t count = (size_t)around * (size_t)along;
    vertices = malloc(count * sizeof *vertices);
    indices = malloc(count * 6 * sizeof *indices);
    if (!vertices || !indices)
        demo_fail(1, "out of memory");
    for (int i = 0; i < along; i++)
        for (int j = 0; j < around; j++) {
            double a = 2.0 * M_PI * i / along, b = 2.0 * M_PI * j / around, d = 1e-3;
            double p[3], pa[3], pb[3], n[3];
            surface(a, b, p);
            surface(a + d, b, pa);
            surface(a, b + d, pb);
            for (int k = 0; k < 3; k++) {
                pa[k] -= p[k];
                pb[k] -= p[k];
            }
            cross(pb, pa, n);
            struct vertex *v = &vertices[i * around + j];
            for (int k = 0; k < 3; k++) {
                v->position[k] = (GLfloat)p[k];
                v->normal[k] = (GLfloat)n[k];
            }
            GLuint q[4] = {(GLuint)(i * around + j), (GLuint)((i + 1) % along * around + j),
                           (GLuint)((i + 1) % along * around + (j + 1) % around), (GLuint)(i * around + (j + 1) % around)};
            static const int order[6] = {0, 2, 1, 0, 3, 2};
            for (int k = 0; k < 6; k++)
                indices[index_count++] = q[order[k]];
        }
}

static void arrays(const struct vertex *base)
{
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_NORMAL_ARRAY);
    glVertexPointer(3, GL_FLOAT, sizeof *base, base->position);
    glNormalPointer(GL_FLOAT, sizeof *base, base->normal);
}

static void begin_end(void)
{
    glBegin(GL_TRIANGLES);
    for (GLsizei i = 0; i < index_count; i++) {
        const struct vertex *v = &vertices[indices[i]];
        glNormal3fv(v->normal);
        glVertex3fv(v->position);
    }
    glEnd();
}

void demo_setup(void)
{
    static const GLfloat gold[4] = {0.85f, 0.62f, 0.22f, 1.0f}, shine[4] = {0.9f, 0.85f, 0.7f, 1.0f},
                         from[4] = {2.0f, 3.0f, 4.0f, 0.0f};
    if (triangles < 1000 || triangles > 4000000)
        demo_fail(2, "--triangles: 1000 to 4000000");
    if (vbo + immediate + list > 1)
        demo_fail(2, "--vbo, --immediate, --list: at most one of them");
    build();
    if (list) {
        display_list = glGenLists(1);
        glNewList(display_list, GL_COMPILE);
        begin_end();
        glEndList();
    } else if (vbo) {
        GLuint buffers[2];
        if (((const char *)glGetString(GL_VERSION))[0] >= '3') {
            bind_vertex_array = (PFNGLBINDVERTEXARRAYPROC)demo_proc("glBindVertexArray");
            ((PFNGLGENVERTEXARRAYSPROC)demo_proc("glGenVertexArrays"))(1, &array_object);
            bind_vertex_array(array_object);
        }
        glGenBuffers(2, buffers);
        glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
        glBufferData(GL_ARRAY_BUFFER, index_count / 6 * (GLsizeiptr)sizeof *vertices, vertices, GL_STATIC_DRAW);
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
        glBufferData(GL_ELEMENT_ARRAY_BUFFER, index_count * (GLsizeiptr)sizeof *indices, indices, GL_STATIC_DRAW);
        arrays(NULL);
        if (bind_vertex_array)
            bind_vertex_array(0);
    } else if (!immediate) {
        arrays(vertices);
    }
    glClearColor(0.13f, 0.16f, 0.20f, 1.0f);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    glEnable(GL_LIGHTING);
    glEnable(GL_LIGHT0);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glLightfv(GL_LIGHT0, GL_POSITION, from);
    glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, gold);
    glMaterialfv(GL_FRONT, GL_SPECULAR, shine);
    glMaterialf(GL_FRONT, GL_SHININESS, 40.0f);
}

void demo_frame(int frame)
{
    double t = demo_time(frame);
    demo_viewport(0, 0, demo_width, demo_height);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    demo_perspective(38.0, (double)demo_width / demo_height, 1.0, 40.0);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslated(0.0, 0.0, -8.0);
    glRotated(-40.0 + 30.0 * t, 1.0, 0.4, 0.0);
    if (immediate) {
        begin_end();
        return;
    }
    if (list) {
        glCallList(display_list);
        return;
    }
    if (bind_vertex_array)
        bind_vertex_array(array_object);
    glDrawElements(GL_TRIANGLES, index_count, GL_UNSIGNED_INT, vbo ? NULL : indices);
    if (bind_vertex_array)
        bind_vertex_array(0);
}
