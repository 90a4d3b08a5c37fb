/* Surfaces in two passes, the second blended with the first and without depths of its own, from arrays that are locked between the two;
 * and a weapon by the same projection in the nearest part of the depth range. With "glass" the second pass of the box is over other
 * elements of the same arrays, as many of them, which stand before it. */
#include "surface.h"
#include <string.h>

typedef void (*lock_t)(GLint, GLsizei);
typedef void (*unlock_t)(void);

static lock_t lock;
static unlock_t unlock;

/* A wall; a box's front and its side; a pane before it. */
static const float places[] = {
    -30, -20, -20, 30, -20, -20, 30, 20, -20, -30, 20, -20,
    -2, -1, -6, 0, -1, -6, 0, 1, -6, -2, 1, -6,
    0, -1, -6, 0, -1, -9, 0, 1, -9, 0, 1, -6,
    -1, -2, -4, 1.5f, -2, -4, 1.5f, 0.5f, -4, -1, 0.5f, -4,
};
static const float weapon[] = {
    0.3f, -1.2f, -2, 0.7f, -1.2f, -2, 0.6f, -0.3f, -2.6f, 0.35f, -0.3f, -2.6f,
};
static const unsigned short wall[] = {0, 1, 2, 0, 2, 3};
static const unsigned short box[] = {4, 5, 6, 4, 6, 7, 8, 9, 10, 8, 10, 11};
static const unsigned short pane[] = {12, 13, 14, 12, 14, 15, 12, 13, 14, 12, 14, 15};

static void pass(const unsigned short *elements, int count, int second)
{
    if (second) {
        glEnable(GL_BLEND);
        glBlendFunc(GL_DST_COLOR, GL_SRC_COLOR);
        glDepthMask(GL_FALSE);
        glColor3f(0.7f, 0.4f, 0.6f);
    } else {
        glDisable(GL_BLEND);
        glDepthMask(GL_TRUE);
    }
    glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_SHORT, elements);
}

static void surface_of(const float *vertices, int all, const unsigned short *first, const unsigned short *second, int count)
{
    glVertexPointer(3, GL_FLOAT, 0, vertices);
    lock(0, all);
    pass(first, count, 0);
    pass(second, count, 1);
    unlock();
}

int main(int argc, char **argv)
{
    int glass = argc > 1 && !strcmp(argv[1], "glass");
    if (!open_surface() || !new_context(EGL_NO_CONTEXT))
        return 77;
    lock = (lock_t)eglGetProcAddress("glLockArraysEXT");
    unlock = (unlock_t)eglGetProcAddress("glUnlockArraysEXT");
    if (!lock || !unlock)
        return 77;
    for (int frame = 0; frame < 4; frame++) {
        glMatrixMode(GL_PROJECTION);
        glLoadIdentity();
        glFrustum(-0.8, 0.8, -0.6, 0.6, 1, 50);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LEQUAL);
        glDepthMask(GL_TRUE);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glEnableClientState(GL_VERTEX_ARRAY);
        glColor3f(0.2f, 0.7f, 0.3f);
        surface_of(places, 16, wall, wall, 6);
        glColor3f(0.9f, 0.6f, 0.2f);
        surface_of(places, 16, box, glass ? pane : box, 12);
        glDepthRange(0, 0.3);
        glColor3f(0.3f, 0.4f, 0.9f);
        surface_of(weapon, 4, wall, wall, 6);
        glDepthRange(0, 1);
        printf("frame %d: error 0x%x\n", frame + 1, glGetError());
        eglSwapBuffers(display, surface);
    }
    return 0;
}
