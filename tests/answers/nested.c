/* Lists of text within as many lists as the driver follows, and one more: prints what is drawn. */
#include "../support/c/surface.h"

enum { LETTER = 1, TEXT, FIRST };

int main(void)
{
    static const GLubyte letters[] = {LETTER, LETTER};
    GLint most = 0;
    if (!open_surface() || !new_context(EGL_NO_CONTEXT))
        return 1;
    glGetIntegerv(GL_MAX_LIST_NESTING, &most);
    glNewList(LETTER, GL_COMPILE);
    glRectf(-1, -1, 1, 1);
    glEndList();
    glNewList(TEXT, GL_COMPILE);
    glCallLists(2, GL_UNSIGNED_BYTE, letters);
    glEndList();
    for (GLuint list = FIRST; list < FIRST + (GLuint)most; list++) {
        glNewList(list, GL_COMPILE);
        glCallList(list > FIRST ? list - 1 : TEXT);
        glEndList();
    }
    for (GLuint within = (GLuint)most - 4; within <= (GLuint)most; within++) {
        unsigned char pixel[4];
        glClear(GL_COLOR_BUFFER_BIT);
        glCallList(FIRST + within - 1);
        glReadPixels(WIDTH / 2, HEIGHT / 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
        printf("text within %u of %d lists: %d %d %d, error 0x%x\n", within, most, pixel[0], pixel[1], pixel[2], glGetError());
        eglSwapBuffers(display, surface);
    }
    return 0;
}
