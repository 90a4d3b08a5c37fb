/* Preloaded behind the layer: presents of EGL that this driver lacks, in which all of the window is shown. */
#define _GNU_SOURCE
#include <EGL/egl.h>
#include <dlfcn.h>

static EGLBoolean present(EGLDisplay display, EGLSurface surface)
{
    return ((EGLBoolean(*)(EGLDisplay, EGLSurface))dlsym(RTLD_NEXT, "eglSwapBuffers"))(display, surface);
}

EGLBoolean eglPostSubBufferNV(EGLDisplay display, EGLSurface surface, EGLint x, EGLint y, EGLint width, EGLint height)
{
    (void)x, (void)y, (void)width, (void)height;
    return present(display, surface);
}

EGLBoolean eglSwapBuffersRegionNOK(EGLDisplay display, EGLSurface surface, EGLint count, const EGLint *rectangles)
{
    (void)count, (void)rectangles;
    return present(display, surface);
}

EGLBoolean eglSwapBuffersRegion2NOK(EGLDisplay display, EGLSurface surface, EGLint count, const EGLint *rectangles)
{
    (void)count, (void)rectangles;
    return present(display, surface);
}
