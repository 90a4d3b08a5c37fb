/* Lines one pixel wide before a wall, or before nothing if there is an argument. */
#define SURFACE_SIZE
enum { WIDTH = 400, HEIGHT = 300 };
#include "surface.h"
int main(int argc, char **argv)
{
    (void)argv;
    if (!open_surface() || !new_context(EGL_NO_CONTEXT))
        return 2;
    set_camera();
    for (int frame = 1; frame <= 4; frame++) {
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        if (argc == 1) {
            glColor3f(0.2f, 0.3f, 0.6f);
            glBegin(GL_QUADS);
            for (int i = 0; i < 4; i++)
                glVertex3f(i == 1 || i == 2 ? 30 : -30, i / 2 ? 20 : -20, -20);
            glEnd();
        }
        glColor3f(1, 1, 0);
        glBegin(GL_LINES);
        for (int i = -5; i <= 5; i++) {
            glVertex3f((float)i * 0.61f, -2, -5);
            glVertex3f((float)i * 0.61f + 0.1f * (float)(i % 3), 2, -5);
        }
        glEnd();
        eglSwapBuffers(display, surface);
    }
    return 0;
}
