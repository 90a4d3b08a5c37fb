/* Surfaces in two passes, the second of which blends with the first and writes no depths; and a weapon with the same projection in the nearest
 * part of the depth range. "copied": the second pass has its vertices and elements elsewhere in memory. "glass": the box's second pass draws
 * as many other elements of the same arrays, a pane before the box. "moved": the vertices move before the second pass. "sides": it shows the
 * back faces. "clears": colours and depths are cleared by separate calls. "once": colours are cleared in the first frame and, to other values,
 * in the tenth, and there is no wall. A second argument is the number of frames. */
#include "surface.h"
#include <stdlib.h>
#include <string.h>

/* A wall; the front and the side of a box; a pane before the box. */
static float places[] = {
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

static void surface_of(const float *vertices, const unsigned short *first, const unsigned short *second, int count)
{
    glVertexPointer(3, GL_FLOAT, 0, vertices);
    pass(first, count, 0);
    pass(second, count, 1);
}

static void box_of(const char *how)
{
    static float other[sizeof places / sizeof *places];
    static unsigned short elements[12];
    glVertexPointer(3, GL_FLOAT, 0, places);
    pass(box, 12, 0);
    memcpy(other, places, sizeof other);
    memcpy(elements, box, sizeof elements);
    if (!strcmp(how, "copied"))
        glVertexPointer(3, GL_FLOAT, 0, other);
    if (!strcmp(how, "moved"))
        for (int i = 4; i < 12; i++)
            places[3 * i + 2] += 2;
    if (!strcmp(how, "sides")) {
        glEnable(GL_CULL_FACE);
        glCullFace(GL_BACK);
    }
    pass(!strcmp(how, "glass") ? pane : elements, 12, 1);
    glDisable(GL_CULL_FACE);
    memcpy(places, other, sizeof other);
}

int main(int argc, char **argv)
{
    if (!open_surface() || !new_context(EGL_NO_CONTEXT))
        return 77;
    int frames = argc > 2 ? atoi(argv[2]) : 4;
    for (int frame = 0; frame < frames; frame++) {
        glMatrixMode(GL_PROJECTION);
        glLoadIdentity();
        glFrustum(-0.8, 0.8, -0.6, 0.6, 1, 50);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LEQUAL);
        glDepthMask(GL_TRUE);
        int once = argc > 1 && !strcmp(argv[1], "once");
        glClearColor(frame < 9 ? 0.3f : 0.6f, 0.5f, 0.7f, 1);
        if (once && frame != 0 && frame != 9) {
            glClear(GL_DEPTH_BUFFER_BIT);
        } else if (argc > 1 && !strcmp(argv[1], "clears")) {
            glClear(GL_COLOR_BUFFER_BIT);
            glClear(GL_DEPTH_BUFFER_BIT);
        } else {
            glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        }
        glEnableClientState(GL_VERTEX_ARRAY);
        glColor3f(0.2f, 0.7f, 0.3f);
        if (!once)
            surface_of(places, wall, wall, 6);
        glColor3f(0.9f, 0.6f, 0.2f);
        box_of(argc > 1 ? argv[1] : "");
        glDepthRange(0, 0.3);
        glColor3f(0.3f, 0.4f, 0.9f);
        surface_of(weapon, wall, wall, 6);
        glDepthRange(0, 1);
        printf("frame %d: error 0x%x\n", frame + 1, glGetError());
        eglSwapBuffers(display, surface);
    }
    return 0;
}
