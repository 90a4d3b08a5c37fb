/* Frames of three draws, of which only the second has edges between pixels: a flat display over the whole window, a moving triangle of the
 * scene, a flat display over a quarter. With an argument nothing is cleared and there is only the triangle. */
#include "surface.h"

static void quad(float left, float bottom)
{
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glBegin(GL_QUADS);
    glVertex2f(left, bottom);
    glVertex2f(1, bottom);
    glVertex2f(1, 1);
    glVertex2f(left, 1);
    glEnd();
}

static void triangle(float x)
{
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-1, 1, -1, 1, 1, 100);
    glColor3f(1, 1, 0);
    glBegin(GL_TRIANGLES);
    glVertex3f(x - 3, -2.7f, -4);
    glVertex3f(x + 1.3f, -2.1f, -6);
    glVertex3f(x - 1, 2.3f, -5);
    glEnd();
}

int main(int count, char **arguments)
{
    (void)arguments;
    if (!open_surface() || !new_context(EGL_NO_CONTEXT))
        return 1;
    glClearColor(0.5f, 0, 0.25f, 0);
    for (int frame = 0; frame < 16; frame++) {
        if (count == 1) {
            glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
            glColor3f(0.2f, 0.3f, 0.4f);
            quad(-1, -1);
        }
        triangle(0.1f * (float)frame);
        if (count == 1) {
            glColor3f(0.8f, 0.8f, 0.8f);
            quad(0, 0);
        }
        eglSwapBuffers(display, surface);
    }
    return glGetError() != GL_NO_ERROR;
}
