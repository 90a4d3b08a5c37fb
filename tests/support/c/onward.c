/* Clears its depths in every fourth frame only, and draws on over its last picture. */
#include "surface.h"

static void perspective(void)
{
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-0.8, 0.8, -0.6, 0.6, 1, 50);
    glEnable(GL_DEPTH_TEST);
}

static void quad(float r, float g, float b, float x, float size, float z)
{
    glColor3f(r, g, b);
    glBegin(GL_QUADS);
    glVertex3f(x, -size, z);
    glVertex3f(x + 2 * size, -size, z);
    glVertex3f(x + 2 * size, size, z);
    glVertex3f(x, size, z);
    glEnd();
}

int main(void)
{
    if (!open_surface() || !new_context(EGL_NO_CONTEXT))
        return 77;
    for (int frame = 0; frame < 8; frame++) {
        perspective();
        if (frame % 4 == 0) {
            glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
            quad(0, 0, 1, -9, 9, -20);
            quad(0, 1, 0, -1.6f, 0.7f, -3);
        } else if (frame % 4 == 1) {
            quad(1, 0, 0, 0.2f, 0.6f, -4);
        } else if (frame % 4 == 2) {
            glDisable(GL_DEPTH_TEST);
            glLoadIdentity();
            quad(1, 1, 0, -0.3f, 0.3f, 0);
        } else {
            quad(1, 0, 1, -0.2f, 0.3f, -2);
        }
        printf("frame %d: error 0x%x\n", frame + 1, glGetError());
        eglSwapBuffers(display, surface);
    }
    return 0;
}
