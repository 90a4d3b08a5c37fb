/* Display lists that push attributes in one of the layer's runs and pop them in a later one: what is drawn after them has the state of before.
 *
 *   popped         glNewList with GL_COMPILE
 *   popped now     with GL_COMPILE_AND_EXECUTE
 *
 * Prints pixels. */
#include "../support/c/surface.h"
#include <string.h>

enum { INNER = 1, OUTER };

static void viewport(void) { glViewport(0, 0, WIDTH / 2, HEIGHT); }

static void scissor(void)
{
    glScissor(0, 0, WIDTH / 2, HEIGHT);
    glEnable(GL_SCISSOR_TEST);
}

static void depth(void)
{
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_NEVER);
}

static void mode(void) { glMatrixMode(GL_PROJECTION); }

static const struct {
    GLbitfield bits;
    void (*change)(void);
} cases[] = {{GL_VIEWPORT_BIT, viewport}, {GL_SCISSOR_BIT | GL_ENABLE_BIT, scissor}, {GL_DEPTH_BUFFER_BIT, depth}, {GL_TRANSFORM_BIT, mode}};

static void list(int at, GLenum how)
{
    glNewList((GLuint)(OUTER + at), how);
    glPushAttrib(cases[at].bits);
    cases[at].change();
    glColor3f(0, 0, 1);
    glRectf(-1, -1, 1, 1);
    glCallList(INNER);
    glPopAttrib();
    glEndList();
    if (how == GL_COMPILE)
        glCallList((GLuint)(OUTER + at));
}

int main(int argc, char **argv)
{
    GLenum how = argc > 1 && !strcmp(argv[1], "now") ? GL_COMPILE_AND_EXECUTE : GL_COMPILE;
    if (!open_surface() || !new_context(EGL_NO_CONTEXT))
        return 1;
    glNewList(INNER, GL_COMPILE);
    glColor3f(0, 1, 0);
    glRectf(-1, -1, 0, 0);
    glEndList();
    for (int at = 0; at < 4; at++) {
        glMatrixMode(GL_MODELVIEW);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glLoadIdentity();
        list(at, how);
        glScalef(0.5f, 0.5f, 1);
        glColor3f(1, 0, 0);
        glRectf(-1, -1, 1.5f, 1.5f);
        glLoadIdentity();
        for (int x = 0; x < 4; x++) {
            unsigned char pixel[4];
            glReadPixels(x * WIDTH / 4 + WIDTH / 8, HEIGHT / 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
            printf("%d: %d %d %d\n", at, pixel[0], pixel[1], pixel[2]);
        }
        printf("%d: error 0x%x\n", at, glGetError());
        eglSwapBuffers(display, surface);
    }
    return 0;
}
