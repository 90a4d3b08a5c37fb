/* Display lists. */
#include "random.h"

/* With --apart a list is compiled in pieces with invisible calls between them, and then as one list that calls the pieces: a program cannot
 * tell the two apart. */
static __thread struct {
    GLuint name, pieces;
    GLenum mode;
} list;

static void next_piece(void)
{
    if (!list.mode || R->begin)
        return;
    if (list.pieces) {
        glEndList();
        disturb();
    }
    glNewList(1000 * (list.name + 1) + list.pieces++, list.mode);
}

static void open_list(GLuint name, GLenum mode)
{
    int apart = O.apart && (mode == GL_COMPILE || mode == GL_COMPILE_AND_EXECUTE);
    list.name = name, list.mode = apart ? mode : 0, list.pieces = 0;
    next_piece();
    if (!apart)
        CALL(glNewList, name, mode);
    R->list = (int)name;
    R->executes = mode == GL_COMPILE_AND_EXECUTE;
}

static void close_list(void)
{
    R->list = R->executes = 0;
    CALL0(glEndList);
    if (!list.mode)
        return;
    list.mode = 0;
    glNewList(list.name, GL_COMPILE);
    for (GLuint i = 0; i < list.pieces; i++)
        glCallList(1000 * (list.name + 1) + i);
    glEndList();
}

/* Lists 1 to 8 call only lower ones, at most two each, and 101 to 112 call none: so no list is endless, whatever the base. */
static void define(GLuint name, int parts, int may_call)
{
    GLenum mode = chance(97) ? PICK(GL_COMPILE, GL_COMPILE, GL_COMPILE_AND_EXECUTE) : GL_RGBA;
    open_list(name, mode);
    int begin = R->begin;
    for (int i = 0; i < parts; i++) {
        part();
        if (dropped())
            continue;
        int at = R->part;
        any_call();
        R->part = at + 64; /* a primitive has its own parts */
        R->begin = begin;
        next_piece();
    }
    part();
    GLuint other = 1 + below(name > 1 && name <= 8 ? name - 1 : 1);
    GLint base = 0;
    glGetIntegerv(GL_LIST_BASE, &base);
    /* Mesa 22.3 may crash at the end of a list that calls one that does not exist. */
    if (may_call && name > 1 && !dropped() && glIsList(other) && glIsList(other + (GLuint)base)) {
        const GLubyte names[2] = {(GLubyte)other, (GLubyte)other};
        if (chance(50))
            CALL(glCallList, other);
        else if (chance(70))
            CALL(glCallLists, 2, GL_UNSIGNED_BYTE, (const GLubyte *)names);
    }
    close_list();
}

static void new_list(void)
{
    if (R->list || R->begin) {
        CALL(glNewList, 1 + below(8), GL_COMPILE); /* an error */
        return;
    }
    GLuint name = chance(75) ? 1 + below(8) : 101 + below(4);
    define(name, (int)below(10), name <= 8);
}

/* A list of commands that are legal between glBegin and glEnd. */
static void vertex_list(void)
{
    if (R->list || R->begin)
        return;
    CALL(glNewList, 111 + below(2), GL_COMPILE);
    R->list = 111;
    vertex_calls((int)below(6));
    R->part = 0;
    R->list = R->executes = 0;
    CALL0(glEndList);
}

/* A list as programs make them: one object with some state around it. */
static void object_list(void)
{
    if (R->list || R->begin)
        return;
    GLenum mode = PICK(GL_COMPILE, GL_COMPILE_AND_EXECUTE);
    open_list(1 + below(8), mode);
    CALL0(glPushMatrix);
    CALL(glRotatef, within(-180, 180), 0.0f, 1.0f, 0.2f);
    if (chance(30))
        CALL(glPushAttrib, whole_mask());
    CALL(glColor4f, within(0, 1), within(0, 1), within(0, 1), 1.0f);
    next_piece();
    CALL(glBegin, PICK(GL_TRIANGLES, GL_QUADS, GL_TRIANGLE_STRIP));
    vertex_calls(8);
    R->part = 0;
    CALL0(glEnd);
    next_piece();
    if (chance(30))
        CALL0(glPopAttrib);
    CALL0(glPopMatrix);
    close_list();
}

static void call_list(void)
{
    if (R->list)
        return;
    if (chance(60)) {
        CALL(glCallList, chance(95) ? 1 + below(8) : 101 + below(20));
        return;
    }
    union {
        GLubyte b[16];
        GLshort s[8];
        GLint i[4];
        GLfloat f[4];
    } names = {{0}};
    GLenum type = ENUM(GL_BYTE, GL_UNSIGNED_BYTE, GL_SHORT, GL_UNSIGNED_SHORT, GL_INT, GL_UNSIGNED_INT, GL_FLOAT, GL_2_BYTES,
                       GL_3_BYTES, GL_4_BYTES);
    int n = chance(97) ? (int)below(4) : -1;
    for (int k = 0; k < 3; k++) {
        int v = 1 + (int)below(8);
        if (O.trace)
            fprintf(R->out, "%d.%d  list %d\n", R->step, R->part, v);
        switch (type) {
        case GL_SHORT: case GL_UNSIGNED_SHORT: names.s[k] = (GLshort)v; break;
        case GL_INT: case GL_UNSIGNED_INT: names.i[k] = v; break;
        case GL_FLOAT: names.f[k] = (GLfloat)v + within(0, 0.9f); break;
        case GL_2_BYTES: names.b[2 * k + 1] = (GLubyte)v; break;
        case GL_3_BYTES: names.b[3 * k + 2] = (GLubyte)v; break;
        case GL_4_BYTES: names.b[4 * k + 3] = (GLubyte)v; break;
        default: names.b[k] = (GLubyte)v; break;
        }
    }
    CALL(glCallLists, n, type, (const void *)&names);
}

static void other(void)
{
    switch (below(6)) {
    case 0: case 1: CALL(glListBase, PICK(0, 0, 100, 0xfffffffe)); break;
    case 2: CALL(glDeleteLists, 1 + below(8), chance(95) ? (int)below(3) : -1); break;
    case 3: {
        GLuint name = 1 + below(8);
        tell(&R->answers, "%d.%d list %u %d", R->step, R->part, name, CALL(glIsList, name));
        break;
    }
    case 4: CALL(glListBase, 0u); break;
    default: {
        if (R->list || R->begin)
            break;
        GLuint base = CALL(glGenLists, 2);
        tell(&R->answers, "%d.%d new lists %u", R->step, R->part, base);
        CALL(glDeleteLists, base, 2);
    }
    }
}

const struct generator list_calls[] = {
    {"new_list", LISTS, 25, new_list}, {"object_list", LISTS, 20, object_list}, {"vertex_list", LISTS, 8, vertex_list},
    {"call_list", LISTS, 60, call_list}, {"other", LISTS, 12, other}, {0},
};
