/* Vertices: immediate mode, arrays, elements, rectangles, evaluators, clears, accumulation. */
#include "random.h"
#include <string.h>

/* The data of all arrays: VERTICES vertices at up to 64 bytes, the same in the program's memory and in buffers. */
static struct {
    GLfloat floats[VERTICES * 16 + 16];
    GLdouble doubles[VERTICES * 8 + 16];
    GLshort shorts[VERTICES * 32 + 16];
    GLubyte bytes[VERTICES * 64 + 64];
    GLboolean flags[VERTICES]; /* 0 and 1 only: Mesa 22.3 draws the edge of any other flag, although glGet answers false */
    GLuint indices[VERTICES * 4];
} data;

void prepare_data(void)
{
    struct run run = {.random = 1};
    R = &run;
    for (size_t i = 0; i < sizeof data.floats / sizeof *data.floats; i++)
        data.floats[i] = within(-1.2f, 1.2f);
    for (size_t i = 0; i < sizeof data.doubles / sizeof *data.doubles; i++)
        data.doubles[i] = (double)within(-1.2f, 1.2f);
    for (size_t i = 0; i < sizeof data.shorts / sizeof *data.shorts; i++)
        data.shorts[i] = (GLshort)((int)below(5) - 2);
    for (size_t i = 0; i < sizeof data.bytes; i++)
        data.bytes[i] = (GLubyte)below(256);
    for (size_t i = 0; i < VERTICES; i++)
        data.flags[i] = below(4) != 0;
    for (size_t i = 0; i < VERTICES * 4; i++)
        data.indices[i] = below(VERTICES);
    R = NULL;
}

int bound(GLenum name)
{
    GLint value = 0;
    if (!R->begin)
        glGetIntegerv(name, &value);
    return value;
}

/* ---- immediate mode ---- */

static void vertex(void)
{
    float x = within(-1.3f, 1.3f), y = within(-1, 1), z = within(-1, 1);
    switch (below(12)) {
    case 0: CALL(glVertex2f, x, y); break;
    case 1: CALL(glVertex2i, (int)below(3) - 1, (int)below(3) - 1); break;
    case 2: CALL(glVertex3d, (double)x, (double)y, (double)z); break;
    case 3: CALL(glVertex3s, (GLshort)((int)below(3) - 1), (GLshort)((int)below(3) - 1), (GLshort)0); break;
    case 4: CALL(glVertex4f, x, y, z, within(0.5f, 1.5f)); break;
    case 5: CALL(glVertex3fv, floats(3, -1, 1)); break;
    case 6: CALL(glVertex4dv, doubles(4, 0.2f, 1)); break;
    case 7: CALL(glVertex2iv, ints(2, 1)); break;
    case 8: CALL(glVertexAttrib4f, 0u, x, y, z, 1.0f); break;
    default: CALL(glVertex3f, x, y, z); break;
    }
}

/* Colours and coordinates always have four components: Mesa 22.3 sometimes drops the fourth of a vertex when a later one has three, depending
 * on its flushes. */
static void attribute(void)
{
    float a = within(0, 1), b = within(0, 1), c = within(0, 1), d = within(0.3f, 1);
    switch (below(24)) {
    case 0: case 1: case 2: CALL(glColor4f, a, b, c, d); break;
    case 3: CALL(glColor4fv, floats(4, 0, 1)); break;
    case 4: CALL(glColor4ub, (GLubyte)below(256), (GLubyte)below(256), (GLubyte)below(256), (GLubyte)below(256)); break;
    case 5: CALL(glColor4dv, doubles(4, 0, 1)); break;
    case 6: CALL(glColor4s, (GLshort)below(32768), (GLshort)below(32768), (GLshort)below(32768), (GLshort)32767); break;
    case 7: case 8: CALL(glNormal3f, a - 0.5f, b - 0.5f, c); break;
    case 9: CALL(glNormal3b, (GLbyte)below(128), (GLbyte)below(128), (GLbyte)100); break;
    case 10: CALL(glNormal3dv, doubles(3, -1, 1)); break;
    case 11: case 12: CALL(glTexCoord4f, a * 2, b * 2, 0.0f, 1.0f); break;
    case 13: CALL(glTexCoord4d, (double)a, (double)b, (double)c, (double)d); break;
    case 14: CALL(glTexCoord4iv, ints(4, 2)); break;
    case 15: CALL(glMultiTexCoord4f, ENUM(GL_TEXTURE0, GL_TEXTURE1, GL_TEXTURE2), a, b, c, d); break;
    case 16: CALL(glMultiTexCoord4fv, PICK(GL_TEXTURE0, GL_TEXTURE1, GL_TEXTURE3), floats(4, 0.1f, 1)); break;
    case 17: CALL(glSecondaryColor3f, a, b, c); break;
    case 18: CALL(glSecondaryColor3ubv, (const GLubyte *)data.bytes + below(64)); break;
    case 19: CALL(glFogCoordf, a * 5); break;
    case 20: CALL(glEdgeFlag, chance(50)); break;
    case 21: CALL(glVertexAttrib4fv, 1 + below(6), floats(4, 0, 1)); break;
    case 22: CALL(glMaterialf, GL_FRONT_AND_BACK, GL_SHININESS, a * 128); break;
    default: CALL(glMaterialfv, ENUM(GL_FRONT, GL_BACK, GL_FRONT_AND_BACK),
                  ENUM(GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_EMISSION, GL_AMBIENT_AND_DIFFUSE), floats(4, 0, 1)); break;
    }
}

void vertex_calls(int n)
{
    if (n < 0) { /* no vertices */
        attribute();
        return;
    }
    while (n > 0) {
        part();
        if (dropped()) {
            n -= chance(60);
        } else if (R->loop) {
            CALL(glVertex4f, within(-1, 1), within(-1, 1), within(-1, 1), 1.0f);
            n--;
        } else if (chance(60)) {
            vertex();
            n--;
        } else if (chance(88)) {
            attribute();
        } else if (!(O.without >> ARRAYS & 1) && chance(50)) {
            CALL(glArrayElement, (int)below(VERTICES));
            n--;
        } else if (!(O.without >> EVALUATORS & 1)) {
            switch (below(4)) {
            case 0: CALL(glEvalCoord1f, within(0, 1)); break;
            case 1: CALL(glEvalCoord2f, within(0, 1), within(0, 1)); break;
            case 2: CALL(glEvalPoint1, (int)below(5)); break;
            default: CALL(glEvalPoint2, (int)below(5), (int)below(5)); break;
            }
            n--;
        } else {
            n--;
        }
    }
    /* Mesa 22.3 forgets attributes that a list sets after its last vertex, or takes them from uninitialised memory. */
    if (R->list)
        CALL(glVertex4f, 0.5f, 0.25f, 0.0f, 1.0f);
}

/* With GL_COMPILE_AND_EXECUTE Mesa 22.3 has not sent all vertices at glEnd, so that a query right after it is an error. The next change of
 * state sends them. */
void after_primitive(void)
{
    if (R->executes)
        CALL(glHint, GL_FOG_HINT, GL_DONT_CARE);
}

static void primitive(void)
{
    GLenum mode = PICK(GL_POINTS, GL_LINES, GL_LINE_STRIP, GL_LINE_LOOP, GL_TRIANGLES, GL_TRIANGLES, GL_TRIANGLE_STRIP,
                       GL_TRIANGLE_FAN, GL_QUADS, GL_QUADS, GL_QUAD_STRIP, GL_POLYGON);
    /* Mesa 22.3 may crash at the end of a list that has errors of this kind. */
    if (!R->list && !(O.without >> ERRORS & 1) && chance(1))
        mode = 0x123;
    /* A vertex outside of glBegin and glEnd is undefined. */
    int refused = is_refused(mode), empty = mode == 0x123 || refused;
    CALL(glBegin, mode);
    R->begin = 1;
    /* In a loop Mesa 22.3 loses edges where an attribute is set for the first time since its last flush, so none is set. */
    R->loop = mode == GL_LINE_LOOP;
    int n = chance(5) || empty ? 0 : (int)below(14);
    int inside = !R->list && !R->loop && !(O.without >> IN_BEGIN & 1) && chance(8) && !refused;
    if (n)
        vertex_calls(n / 2);
    if (inside) { /* nearly all of these are errors here */
        part();
        if (!dropped())
            any_call();
    }
    vertex_calls(n - n / 2);
    R->part = 0;
    R->begin = R->loop = 0;
    CALL0(glEnd);
    if (inside) /* ends a list or a primitive that was begun inside */
        CALL0(glEnd);
    after_primitive();
}

/* Calls lists between glBegin and glEnd. */
static void primitive_of_lists(void)
{
    if (R->executes)
        return;
    GLenum mode = PICK(GL_TRIANGLES, GL_QUADS, GL_LINE_STRIP, GL_POINTS);
    int empty = is_refused(mode);
    CALL(glBegin, mode);
    R->begin = 1;
    vertex_calls(empty ? 0 : (int)below(3));
    if (!R->list && !empty)
        CALL(glCallList, 111 + below(2));
    vertex_calls(empty ? 0 : (int)below(3));
    R->part = 0;
    R->begin = 0;
    CALL0(glEnd);
}

/* ---- arrays ---- */

void array_pointers(void)
{
    glVertexPointer(3, GL_FLOAT, 0, data.floats);
    glNormalPointer(GL_FLOAT, 0, data.floats);
    glColorPointer(4, GL_UNSIGNED_BYTE, 0, data.bytes);
    glEdgeFlagPointer(0, data.flags);
    glFogCoordPointer(GL_FLOAT, 0, data.floats);
    glSecondaryColorPointer(3, GL_FLOAT, 0, data.floats);
    glIndexPointer(GL_FLOAT, 0, data.floats);
    for (int i = 3; i >= 0; i--) {
        glClientActiveTexture(GL_TEXTURE0 + (GLenum)i);
        glTexCoordPointer(4, GL_FLOAT, 0, data.floats);
    }
    for (GLuint i = 1; i < 5; i++)
        glVertexAttribPointer(i, 4, GL_FLOAT, 0, 0, data.floats);
}

static void pointer(void)
{
    /* Buffers hold floats. */
    int buffer = bound(GL_ARRAY_BUFFER_BINDING) != 0;
    int stride = PICK(0, 0, 16, 32, 64, 24), offset = (int)below(4) * 4;
    const void *f = buffer ? (const void *)(uintptr_t)offset : (const char *)data.floats + offset;
    if (!buffer && chance(30)) {
        if (chance(50))
            CALL(glVertexPointer, 2 + (int)below(3), GL_SHORT, stride ? 16 : 0, data.shorts);
        else
            CALL(glVertexPointer, 2 + (int)below(3), GL_DOUBLE, stride ? 32 : 0, data.doubles);
        return;
    }
    switch (below(9)) {
    case 0: CALL(glVertexPointer, (int)(chance(97) ? 2 + below(3) : 7), ENUM(GL_FLOAT), chance(97) ? stride : -1, f); break;
    case 1: CALL(glNormalPointer, GL_FLOAT, stride, f); break;
    case 2: CALL(glColorPointer, 4, GL_FLOAT, stride, f); break;
    case 3: CALL(glColorPointer, 4, GL_UNSIGNED_BYTE, buffer ? 4 : (int)below(2) * 4, buffer ? f : data.bytes); break;
    case 4: CALL(glTexCoordPointer, 4, GL_FLOAT, stride, f); break;
    case 5: CALL(glFogCoordPointer, GL_FLOAT, stride, f); break;
    case 6: CALL(glSecondaryColorPointer, 3, GL_FLOAT, stride, f); break;
    case 7: CALL(glClientActiveTexture, ENUM(GL_TEXTURE0, GL_TEXTURE1, GL_TEXTURE3)); break;
    default: CALL(glInterleavedArrays, ENUM(GL_V2F, GL_V3F, GL_C4UB_V3F, GL_N3F_V3F, GL_C4F_N3F_V3F),
                  stride ? 64 : 0, f); break;
    }
}

static GLenum draw_mode(void)
{
    return ENUM(GL_POINTS, GL_LINES, GL_LINE_STRIP, GL_LINE_LOOP, GL_TRIANGLES, GL_TRIANGLES, GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN,
                GL_QUADS, GL_QUAD_STRIP, GL_POLYGON);
}

static void arrays(void)
{
    int first = (int)below(32), count = (int)below(32);
    GLint many[3] = {0, (int)below(20), 7}, counts[3] = {(int)below(12), (int)below(12), 3};
    if (chance(15) && !R->list)
        CALL(glMultiDrawArrays, draw_mode(), many, counts, 3);
    else if (chance(10) && !R->list)
        CALL(glDrawArraysInstanced, draw_mode(), first, count, (int)below(3));
    else
        CALL(glDrawArrays, draw_mode(), first, chance(97) ? count : -2);
    after_primitive();
}

static void elements(void)
{
    int buffer = bound(GL_ELEMENT_ARRAY_BUFFER_BINDING) != 0;
    GLenum type = ENUM(GL_UNSIGNED_INT, GL_UNSIGNED_SHORT, GL_UNSIGNED_BYTE);
    uintptr_t offset = below(8) * 4;
    const void *from = buffer ? (const void *)offset : (const char *)data.indices + offset;
    int count = chance(97) ? (int)below(24) : -1;
    if (chance(25))
        CALL(glDrawRangeElements, draw_mode(), 0u, (unsigned)VERTICES - 1, count, type, from);
    else if (chance(10) && !R->list)
        CALL(glDrawElementsBaseVertex, draw_mode(), count, type, from, 0);
    else
        CALL(glDrawElements, draw_mode(), count, type, from);
    after_primitive();
}

static void buffers(void)
{
    GLuint name = below(5);
    if (name < 3) {
        CALL(glBindBuffer, ENUM(GL_ARRAY_BUFFER), name);
        if (name && bound(GL_ARRAY_BUFFER_BINDING) == (GLint)name)
            CALL(glBufferData, GL_ARRAY_BUFFER, (GLsizeiptr)BUFFER, (const void *)data.bytes ? (const void *)data.floats : NULL, GL_STATIC_DRAW);
    } else {
        CALL(glBindBuffer, GL_ELEMENT_ARRAY_BUFFER, name == 3 ? 0u : 3u);
        if (name != 3 && !R->begin)
            CALL(glBufferData, GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)sizeof data.indices, (const void *)data.indices, GL_STATIC_DRAW);
    }
}

/* ---- rectangles, evaluators ---- */

static void rectangle(void)
{
    switch (below(4)) {
    case 0: CALL(glRectf, within(-1, 0), within(-1, 0), within(0, 1), within(0, 1)); break;
    case 1: CALL(glRecti, -1, (int)below(2) - 1, 1, 1); break;
    case 2: CALL(glRectdv, doubles(2, -1, 0), (const GLdouble *)data.doubles); break;
    default: CALL(glRects, (GLshort)-1, (GLshort)-1, (GLshort)below(2), (GLshort)1); break;
    }
    after_primitive();
}

/* No colours and normals: Mesa does not define the current value after an evaluator has set them. */
static void maps(void)
{
    int order = chance(95) ? 1 + (int)below(4) : 99;
    switch (below(7)) {
    case 0: CALL(glMap1f, ENUM(GL_MAP1_VERTEX_3), 0.0f, within(0.5f, 1), 4, order, (const GLfloat *)data.floats + below(9)); break;
    case 1: CALL(glMap2f, ENUM(GL_MAP2_VERTEX_3, GL_MAP2_VERTEX_4), 0.0f, 1.0f, 4, order, 0.0f, 1.0f, 16,
                 1 + (int)below(4), (const GLfloat *)data.floats + below(9)); break;
    case 2: CALL(glMapGrid1f, chance(95) ? 1 + (int)below(6) : 0, 0.0f, 1.0f); break;
    case 3: CALL(glMapGrid2f, 1 + (int)below(5), 0.0f, 1.0f, 1 + (int)below(5), 0.0f, 1.0f); break;
    case 4: CALL(glEnable, PICK(GL_MAP1_VERTEX_3, GL_MAP2_VERTEX_3, GL_MAP2_VERTEX_4)); break;
    case 5: CALL(glEvalMesh1, ENUM(GL_POINT, GL_LINE), 0, (int)below(6)); break;
    default: CALL(glEvalMesh2, ENUM(GL_POINT, GL_LINE, GL_FILL), 0, (int)below(5), 0, (int)below(5)); break;
    }
}

/* ---- clears, accumulation ---- */

static void clear(void)
{
    switch (below(8)) {
    case 0: CALL(glClearColor, within(0, 1), within(0, 1), within(0, 1), within(0, 1)); break;
    case 1: CALL(glClearDepth, (double)within(0, 1)); break;
    case 2: CALL(glClearStencil, (int)below(256)); break;
    case 3: {
        const float *f = floats(4, 0, 1);
        /* Mesa 22.3 does not clear the colour of pbuffers here; the layer does. */
        CALL(glClearBufferfv, W->windows ? ENUM(GL_COLOR, GL_DEPTH) : GL_DEPTH, 0, f);
        break;
    }
    case 4: CALL(glClearBufferfi, GL_DEPTH_STENCIL, 0, within(0, 1), (int)below(256)); break;
    default: CALL(glClear, PICK(GL_COLOR_BUFFER_BIT, GL_DEPTH_BUFFER_BIT, GL_STENCIL_BUFFER_BIT,
                                GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT)); break;
    }
}

static void accumulation(void)
{
    if (chance(20))
        CALL(glClearAccum, within(-1, 1), within(-1, 1), within(-1, 1), within(-1, 1));
    else if (chance(15))
        CALL(glClear, GL_ACCUM_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    else
        CALL(glAccum, ENUM(GL_LOAD, GL_ACCUM, GL_RETURN, GL_MULT, GL_ADD), within(0.2f, 1));
}

static void draw_buffer(void)
{
    /* Mesa 22.3 forgets that they have changed within an inner level that has not saved them (whole_mask()). */
    if (bound(GL_ATTRIB_STACK_DEPTH) > 1)
        return;
    if (chance(60))
        CALL(glDrawBuffer, ENUM(GL_BACK, GL_BACK, GL_NONE, GL_BACK_LEFT, GL_BACK_RIGHT, GL_AUX0, GL_COLOR_ATTACHMENT0));
    else if (chance(60))
        CALL(glReadBuffer, ENUM(W->windows ? GL_BACK : GL_FRONT, W->windows ? GL_BACK_LEFT : GL_FRONT, GL_NONE, GL_RIGHT, GL_COLOR_ATTACHMENT0));
    else {
        GLenum both[2] = {PICK(GL_BACK_LEFT, GL_NONE), PICK(GL_NONE, GL_NONE, GL_BACK_LEFT)};
        CALL(glDrawBuffers, 1 + (int)below(2), both);
    }
}

static void front_buffer(void)
{
    if (bound(GL_ATTRIB_STACK_DEPTH) > 1) /* as above */
        return;
    if (chance(50))
        CALL(glDrawBuffer, PICK(GL_FRONT, GL_FRONT_AND_BACK, GL_LEFT, GL_FRONT_LEFT));
    else
        CALL(glReadBuffer, PICK(GL_FRONT, GL_LEFT, GL_FRONT_LEFT));
}

const struct generator draw_calls[] = {
    {"primitive", IMMEDIATE, 150, primitive}, {"primitive_of_lists", LISTS, 4, primitive_of_lists}, {"pointer", ARRAYS, 30, pointer},
    {"arrays", ARRAYS, 35, arrays}, {"elements", ARRAYS, 35, elements}, {"buffers", BUFFERS, 20, buffers},
    {"rectangle", IMMEDIATE, 25, rectangle}, {"maps", EVALUATORS, 35, maps}, {"clear", CLEARS, 35, clear},
    {"accumulation", ACCUM, 20, accumulation}, {"draw_buffer", CLEARS, 12, draw_buffer}, {"front_buffer", FRONT, 10, front_buffer}, {0},
};
