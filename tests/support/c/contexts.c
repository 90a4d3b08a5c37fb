/* Makes contexts, draws a frame in each and destroys them; prints how many bytes are in use after the first ones and at the
 * end. Every other context is destroyed while it is current; every third shares with one that stays. */
#define GL_GLEXT_PROTOTYPES 1
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <malloc.h>
#include <stdio.h>

enum { FIRST = 20, ALL = 80 };

int main(void)
{
    PFNEGLGETPLATFORMDISPLAYEXTPROC get =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    EGLDisplay d = get(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (!d || !eglInitialize(d, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API))
        return 2;
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_DEPTH_SIZE, 24, EGL_NONE};
    const EGLint size[] = {EGL_WIDTH, 64, EGL_HEIGHT, 48, EGL_NONE};
    EGLConfig config;
    EGLint count;
    if (!eglChooseConfig(d, wanted, &config, 1, &count) || !count)
        return 2;
    EGLSurface s = eglCreatePbufferSurface(d, config, size);
    EGLContext stays = eglCreateContext(d, config, EGL_NO_CONTEXT, NULL);
    for (int i = 0; i < ALL; i++) {
        EGLContext c = eglCreateContext(d, config, i % 3 ? EGL_NO_CONTEXT : stays, NULL);
        if (!c || !eglMakeCurrent(d, s, s, c))
            return 1;
        GLuint list = glGenLists(1);
        glNewList(list, GL_COMPILE);
        glRectf(-1, -1, 0, 0);
        glEndList();
        glClear(GL_COLOR_BUFFER_BIT);
        glCallList(list);
        glDeleteLists(list, 1);
        eglSwapBuffers(d, s);
        if (i % 2)
            eglDestroyContext(d, c);
        eglMakeCurrent(d, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (i % 2 == 0)
            eglDestroyContext(d, c);
        if (i == FIRST - 1 || i == ALL - 1) {
            struct mallinfo2 m = mallinfo2();
            printf("%zu\n", m.uordblks + m.hblkhd);
        }
    }
    return 0;
}
