/* Pbuffers without a window system. */
#include "random.h"
#include <EGL/egl.h>
#include <EGL/eglext.h>

static EGLDisplay display;
static EGLConfig config;
static EGLSurface surfaces[(CONTEXTS + 1) * (1 + OTHERS)];

static void egl_open(int drawables)
{
    PFNEGLGETPLATFORMDISPLAYEXTPROC get =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    display = get ? get(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL) : EGL_NO_DISPLAY;
    if (!display || !eglInitialize(display, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API))
        fail("no EGL without a window system");
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_RED_SIZE, 8,
                             EGL_GREEN_SIZE, 8, EGL_BLUE_SIZE, 8, EGL_ALPHA_SIZE, 8, EGL_DEPTH_SIZE, 24,
                             EGL_STENCIL_SIZE, 8, EGL_NONE};
    EGLConfig configs[64];
    EGLint count = 0, red;
    eglChooseConfig(display, wanted, configs, 64, &count);
    for (int i = count - 1; i >= 0; i--)
        if (eglGetConfigAttrib(display, configs[i], EGL_RED_SIZE, &red) && red == 8)
            config = configs[i];
    if (!config)
        fail("no EGL config");
    const EGLint size[] = {EGL_WIDTH, WIDTH, EGL_HEIGHT, HEIGHT, EGL_NONE};
    for (int i = 0; i < drawables; i++)
        surfaces[i] = eglCreatePbufferSurface(display, config, size);
}

static void *egl_create(void *share)
{
    eglBindAPI(EGL_OPENGL_API); /* the API is a setting of the thread */
    return eglCreateContext(display, config, share ? share : EGL_NO_CONTEXT, NULL);
}

static void egl_current(void *handle, int draw, int read)
{
    EGLSurface to = handle ? surfaces[draw] : EGL_NO_SURFACE, from = handle ? surfaces[read] : EGL_NO_SURFACE;
    if (!eglMakeCurrent(display, to, from, handle ? handle : EGL_NO_CONTEXT))
        fail("eglMakeCurrent: 0x%x", eglGetError());
}

static void egl_destroy(void *handle) { eglDestroyContext(display, handle); }
static void egl_swap(int drawable) { eglSwapBuffers(display, surfaces[drawable]); }

const struct window_api window_egl = {"egl", egl_open, egl_create, egl_current, egl_destroy, egl_swap, 0, 1};
