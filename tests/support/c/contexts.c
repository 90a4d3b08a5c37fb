/* Makes contexts, draws a frame in each and destroys them; prints how many bytes are in use after the first ones and at the
 * end. Every other context is destroyed while it is current; every third shares with one that stays. */
#include "surface.h"
#include <malloc.h>

enum { FIRST = 20, ALL = 80 };

int main(void)
{
    if (!open_surface())
        return 2;
    EGLContext stays = eglCreateContext(display, config, EGL_NO_CONTEXT, NULL);
    for (int i = 0; i < ALL; i++) {
        EGLContext c = new_context(i % 3 ? EGL_NO_CONTEXT : stays);
        if (!c)
            return 1;
        GLuint list = glGenLists(1);
        glNewList(list, GL_COMPILE);
        glRectf(-1, -1, 0, 0);
        glEndList();
        glClear(GL_COLOR_BUFFER_BIT);
        glCallList(list);
        glDeleteLists(list, 1);
        eglSwapBuffers(display, surface);
        if (i % 2)
            eglDestroyContext(display, c);
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (i % 2 == 0)
            eglDestroyContext(display, c);
        if (i == FIRST - 1 || i == ALL - 1) {
            struct mallinfo2 m = mallinfo2();
            printf("%zu\n", m.uordblks + m.hblkhd);
        }
    }
    return 0;
}
