/* The same picture again and again, in a surface of the size that is given (width and height), until its input ends, ten frames at least. With a third argument, the surface
 * has that many times the width from the tenth frame on. */
static int width, height;
#define SURFACE_SIZE
#define WIDTH width
#define HEIGHT height
#include "surface.h"
#include <poll.h>
#include <stdlib.h>

static void quad(float left, float low, float side, float near, float red)
{
    static const float corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    glBegin(GL_QUADS);
    for (int i = 0; i < 4; i++) {
        glColor3f(red, corners[i][0], corners[i][1]);
        glVertex3f(left + side * corners[i][0], low + side * corners[i][1], -near);
    }
    glEnd();
}

static int draw(int frames)
{
    struct pollfd input = {0, POLLIN, 0};
    glViewport(0, 0, width, height);
    for (int frame = 0; frame < frames || !frames; frame++) {
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        quad(-40, -40, 80, 30, 0.3f);
        for (int i = 0; i < 6; i++)
            quad((float)i * 1.3f - 4, (float)(i % 3) - 2, 1.2f, 5 + 2 * (float)i, (float)i / 6);
        eglSwapBuffers(display, surface);
        if (poll(&input, 1, 10) && input.revents && frame >= 10)
            return 0;
    }
    return 1;
}

int main(int argc, char **argv)
{
    width = argc > 2 ? atoi(argv[1]) : 320;
    height = argc > 2 ? atoi(argv[2]) : 240;
    if (!open_surface() || !new_context(EGL_NO_CONTEXT))
        return 2;
    set_camera();
    if (argc > 3 && draw(10)) {
        EGLContext context = eglGetCurrentContext();
        width *= atoi(argv[3]);
        const EGLint size[] = {EGL_WIDTH, width, EGL_HEIGHT, height, EGL_NONE};
        surface = eglCreatePbufferSurface(display, config, size);
        if (!eglMakeCurrent(display, surface, surface, context))
            return 2;
    }
    draw(0);
    return 0;
}
