/* Every way to draw from arrays: all modes, all index types, interleaved, in buffer objects, ranges,
 * several at once, single elements within begin/end, and with an array left out. With --many N a frame is N small
 * glDrawArrays; with --time, a measure of what a layer costs. */
#include "demo.h"
#include <math.h>
#include <stddef.h>
#include <string.h>

static int many;
const struct demo_option demo_options[] = {{"--many", "small draws a frame in place of all this", &many, 1}, {0}};

enum { RIM = 12, COUNT = RIM + 2 };
struct vertex { GLfloat uv[2]; GLubyte colour[4]; GLfloat normal[3], position[3]; };
static struct vertex disc[COUNT];                                        /* a centre, and the rim closed */
static struct { GLfloat colour[4], normal[3], position[3]; } packed[COUNT]; /* GL_C4F_N3F_V3F */
static GLuint texture, buffers[2];

void demo_setup(void)
{
    static const GLubyte white[3] = {255, 255, 255}, grey[3] = {150, 150, 170};
    static const GLuint order[6] = {1, 5, 9, 3, 7, 11};
    static const GLfloat light[4] = {1.0f, 2.0f, 3.0f, 0.0f};
    for (int i = 0; i < COUNT; i++) {
        double a = 2.0 * M_PI * (i - 1) / RIM, r = i ? 0.42 : 0.0;
        GLfloat x = (GLfloat)(r * cos(a)), y = (GLfloat)(r * sin(a));
        struct vertex v = {{x + 0.5f, y + 0.5f},
                           {(GLubyte)(128 + 127 * cos(a)), (GLubyte)(128 + 127 * sin(a)), (GLubyte)(i * 18), 255},
                           {x, y, 0.5f}, {x, y, i ? 0.05f * (GLfloat)(i % 4) : 0.3f}}; /* no overlaps in one plane */
        disc[i] = v;
        for (int k = 0; k < 4; k++)
            packed[i].colour[k] = (GLfloat)v.colour[k] / 255.0f;
        memcpy(packed[i].normal, v.normal, sizeof v.normal);
        memcpy(packed[i].position, v.position, sizeof v.position);
    }
    texture = demo_checker(32, 4, white, grey);
    glGenBuffers(2, buffers);
    glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    glBufferData(GL_ARRAY_BUFFER, sizeof disc, disc, GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof order, order, GL_STATIC_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    glClearColor(0.12f, 0.11f, 0.14f, 1.0f);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_LIGHT0);
    glEnable(GL_NORMALIZE);
    glEnable(GL_COLOR_MATERIAL);
    glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
    glPointSize(4.0f);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glLightfv(GL_LIGHT0, GL_POSITION, light);
}

enum { COLOUR = 1, NORMAL = 2, UV = 4, ALL = 7 };

static void set(int which, GLenum array)
{
    if (which)
        glEnableClientState(array);
    else
        glDisableClientState(array);
}

/* Points the arrays at memory, or into a bound buffer where base is null. */
static void arrays(const struct vertex *base, int which)
{
    const GLubyte *p = (const GLubyte *)base;
    GLsizei stride = sizeof(struct vertex);
    glEnableClientState(GL_VERTEX_ARRAY);
    set(which & COLOUR, GL_COLOR_ARRAY);
    set(which & NORMAL, GL_NORMAL_ARRAY);
    set(which & UV, GL_TEXTURE_COORD_ARRAY);
    glVertexPointer(3, GL_FLOAT, stride, p + offsetof(struct vertex, position));
    glColorPointer(4, GL_UNSIGNED_BYTE, stride, p + offsetof(struct vertex, colour));
    glNormalPointer(GL_FLOAT, stride, p + offsetof(struct vertex, normal));
    glTexCoordPointer(2, GL_FLOAT, stride, p + offsetof(struct vertex, uv));
    if (which & NORMAL)
        glEnable(GL_LIGHTING);
    else
        glDisable(GL_LIGHTING);
    if (which & UV)
        glEnable(GL_TEXTURE_2D);
    else
        glDisable(GL_TEXTURE_2D);
}

static void cell(int n, double t) /* the next cell of the grid; each row is farther away */
{
    int column = n % 6, row = n / 6;
    glLoadIdentity();
    glTranslated(0.95 * (column - 2.5) * (1.0 + 0.12 * (3 - row)), 1.05 * (1.5 - row), -5.0 - 0.9 * (3 - row) - 0.4 * (column % 3));
    glRotated(40.0 * sin(2.0 * t + n), 0.2, 1.0, 0.1);
}

static void ways(double t)
{
    static const GLubyte fan8[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13};
    static const GLushort strip16[] = {1, 2, 13, 3, 12, 4, 11, 5, 10, 6};
    static const GLuint loop32[] = {1, 6, 11, 4, 9, 2, 7, 12, 5, 10, 3, 8};
    static const GLint firsts[2] = {1, 8};
    static const GLsizei counts[2] = {5, 5};
    static const GLvoid *const starts[2] = {strip16, strip16 + 5};
    int n = 10;

    arrays(disc, COLOUR);
    cell(n++, t); /* the three index types */
    glDrawElements(GL_TRIANGLE_FAN, COUNT, GL_UNSIGNED_BYTE, fan8);
    cell(n++, t);
    glDrawElements(GL_TRIANGLE_STRIP, 10, GL_UNSIGNED_SHORT, strip16);
    cell(n++, t);
    glDrawElements(GL_LINE_LOOP, RIM, GL_UNSIGNED_INT, loop32);
    arrays(disc, ALL);
    cell(n++, t);
    glDrawRangeElements(GL_POLYGON, 1, RIM, RIM - 2, GL_UNSIGNED_BYTE, fan8 + 2);
    cell(n++, t);
    glMultiDrawArrays(GL_POLYGON, firsts, counts, 2);
    cell(n++, t);
    glMultiDrawElements(GL_TRIANGLE_STRIP, counts, GL_UNSIGNED_SHORT, (const GLvoid *const *)starts, 2);

    cell(n++, t); /* single elements between glBegin and glEnd, with other calls between them */
    glBegin(GL_TRIANGLE_FAN);
    for (int i = 0; i < COUNT - 1; i++)
        glArrayElement(i);
    glColor3f(1.0f, 1.0f, 0.0f);
    glVertex3fv(disc[1].position);
    glEnd();

    cell(n++, t); /* no colour array: the current colour */
    arrays(disc, NORMAL);
    glColor3f(0.91f, 0.51f, 0.11f);
    glDrawArrays(GL_TRIANGLE_FAN, 0, COUNT);
    cell(n++, t); /* no normal array: the current normal */
    arrays(disc, COLOUR | UV);
    glEnable(GL_LIGHTING);
    glNormal3f(0.2f, 0.5f, 0.8f);
    glDrawArrays(GL_TRIANGLE_FAN, 0, COUNT);

    cell(n++, t);
    glInterleavedArrays(GL_C4F_N3F_V3F, 0, packed);
    glDisable(GL_TEXTURE_2D);
    glDrawArrays(GL_TRIANGLE_FAN, 0, COUNT);

    glBindBuffer(GL_ARRAY_BUFFER, buffers[0]); /* buffer objects; then indices in a buffer too */
    arrays(NULL, ALL);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    cell(n++, t);
    glDrawArrays(GL_TRIANGLE_FAN, 0, COUNT);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
    cell(n++, t);
    glDrawElements(GL_TRIANGLES, 6, GL_UNSIGNED_INT, NULL);
    glDrawElements(GL_LINES, 2, GL_UNSIGNED_INT, (const GLubyte *)NULL + 2 * sizeof(GLuint));
    cell(n++, t); /* vertices in memory, indices in the buffer */
    arrays(disc, COLOUR);
    glDrawElements(GL_TRIANGLES, 6, GL_UNSIGNED_INT, NULL);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    cell(n++, t); /* a range at the end of the arrays */
    glDrawArrays(GL_QUADS, 5, 8);
}

void demo_frame(int frame)
{
    static const GLenum modes[10] = {GL_POINTS, GL_LINES, GL_LINE_STRIP, GL_LINE_LOOP, GL_TRIANGLES,
                                     GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN, GL_QUADS, GL_QUAD_STRIP, GL_POLYGON};
    double t = demo_time(frame);
    demo_viewport(0, 0, demo_width, demo_height);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    demo_perspective(44.0, (double)demo_width / demo_height, 1.0, 60.0);
    glMatrixMode(GL_MODELVIEW);
    glBindTexture(GL_TEXTURE_2D, texture);
    if (many) {
        arrays(disc, COLOUR | NORMAL);
        /* A sheet of 12 by 7.5 units, whatever the number of draws. */
        int columns = (int)ceil(sqrt(1.6 * many)), rows = (many + columns - 1) / columns;
        double side = 12.0 / columns, size = 40.0 / columns;
        for (int i = 0; i < many; i++) {
            double column = i % columns - (columns - 1) / 2.0, row = i / columns - (rows - 1) / 2.0;
            glLoadIdentity();
            glTranslated(side * column, side * row, -9.0 + 2.5 * sin(1.23 * side * column + 1.67 * side * row + t));
            glRotated(10.0 * (i % 36) + 90.0 * t, 0.0, 1.0, 0.0);
            glScaled(size, size, size);
            glDrawArrays(modes[4 + i % 6], i % 2, RIM);
        }
        return;
    }
    for (int m = 0; m < 10; m++) {
        cell(m, t);
        arrays(disc, m < 4 ? COLOUR : m % 2 ? COLOUR | NORMAL : ALL);
        glShadeModel(m % 3 ? GL_SMOOTH : GL_FLAT);
        glDrawArrays(modes[m], 1, RIM);
    }
    glShadeModel(GL_SMOOTH);
    ways(t);
}
