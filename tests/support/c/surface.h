/* A surface without a window system, for small programs: 64 x 48 pixels, or a size of the program's where SURFACE_SIZE is defined. Colours
 * have 8 bits, depths 24 or DEPTH_BITS. Contexts are those of desktop OpenGL, or of OpenGL ES 3 where SURFACE_ES is defined. */
#define GL_GLEXT_PROTOTYPES 1
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>
#include <stdio.h>

#ifndef SURFACE_SIZE
#define SURFACE_COLOURS
enum { WIDTH = 64, HEIGHT = 48 };
#else
#define SURFACE_COLOURS EGL_RED_SIZE, 8, EGL_GREEN_SIZE, 8, EGL_BLUE_SIZE, 8, EGL_ALPHA_SIZE, 8,
#endif

#ifndef SURFACE_ES
enum { API = EGL_OPENGL_API, API_BIT = EGL_OPENGL_BIT };
static const EGLint *const context_attributes = NULL;
#else
enum { API = EGL_OPENGL_ES_API, API_BIT = EGL_OPENGL_ES3_BIT };
static const EGLint context_attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
#endif

#ifndef DEPTH_BITS
#define DEPTH_BITS 24
#endif

static EGLDisplay display;
static EGLConfig config;
static EGLSurface surface;

/* Returns 0 if there is none. */
static int open_surface(void)
{
    PFNEGLGETPLATFORMDISPLAYEXTPROC get =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, API_BIT, EGL_DEPTH_SIZE, DEPTH_BITS,
                             SURFACE_COLOURS EGL_NONE};
    const EGLint size[] = {EGL_WIDTH, WIDTH, EGL_HEIGHT, HEIGHT, EGL_NONE};
    EGLint count;
    display = get(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (!display || !eglInitialize(display, NULL, NULL) || !eglBindAPI(API))
        return 0;
    if (!eglChooseConfig(display, wanted, &config, 1, &count) || !count)
        return 0;
    /* The config with the smallest depth buffer comes first. */
    if (!eglGetConfigAttrib(display, config, EGL_DEPTH_SIZE, &count) || count != DEPTH_BITS)
        return 0;
    surface = eglCreatePbufferSurface(display, config, size);
    return surface != EGL_NO_SURFACE;
}

/* Makes a context current; returns EGL_NO_CONTEXT if there is none. */
static inline EGLContext new_context(EGLContext share)
{
    EGLContext context = eglCreateContext(display, config, share, context_attributes);
    return context && eglMakeCurrent(display, surface, surface, context) ? context : EGL_NO_CONTEXT;
}

#ifndef SURFACE_ES
/* The camera of fixed function: a frustum of 4 to 3, from 1 to 100. */
static inline void set_camera(void)
{
    glMatrixMode(GL_PROJECTION);
    glFrustum(-0.8, 0.8, -0.6, 0.6, 1, 100);
    glMatrixMode(GL_MODELVIEW);
    glEnable(GL_DEPTH_TEST);
}
#endif
