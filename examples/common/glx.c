/* A double-buffered X window with a legacy GLX context, or with a core one. */
#include "x11.h"
#ifndef DEMO_DLOPEN
#include <GL/glx.h>
#endif

static Display *display;
static Window win;
static GLXContext context;

/* Chooses a visual, and its config where the visual is chosen by config. */
static XVisualInfo *choose(const struct demo_window *w, GLXFBConfig *config)
{
    int screen = DefaultScreen(display);
    if (!w->samples && !w->srgb && !w->core) {
        int a[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 8, GLX_GREEN_SIZE, 8, GLX_BLUE_SIZE, 8,
                   GLX_DEPTH_SIZE, 24, GLX_STENCIL_SIZE, 8, w->accumulation ? GLX_ACCUM_RED_SIZE : None, 16, None};
        return glXChooseVisual(display, screen, a);
    }
    int a[32] = {GLX_DOUBLEBUFFER, True, GLX_RED_SIZE, 8, GLX_GREEN_SIZE, 8, GLX_BLUE_SIZE, 8,
                 GLX_DEPTH_SIZE, 24, GLX_STENCIL_SIZE, 8, GLX_X_RENDERABLE, True};
    int n = 14, count = 0;
    if (w->samples) {
        a[n++] = GLX_SAMPLE_BUFFERS;
        a[n++] = 1;
        a[n++] = GLX_SAMPLES;
        a[n++] = w->samples;
    }
    if (w->srgb) {
        a[n++] = GLX_FRAMEBUFFER_SRGB_CAPABLE_ARB;
        a[n++] = True;
    }
    if (w->accumulation && !w->samples) {
        a[n++] = GLX_ACCUM_RED_SIZE;
        a[n++] = 16;
    }
    a[n] = None;
    GLXFBConfig *configs = glXChooseFBConfig(display, screen, a, &count);
    XVisualInfo *visual = count ? glXGetVisualFromFBConfig(display, configs[0]) : NULL;
    if (count)
        *config = configs[0];
    if (configs)
        XFree(configs);
    return visual;
}

static GLXContext core_context(GLXFBConfig config)
{
    const int a[] = {GLX_CONTEXT_MAJOR_VERSION_ARB, 3, GLX_CONTEXT_MINOR_VERSION_ARB, 3,
                     GLX_CONTEXT_PROFILE_MASK_ARB, GLX_CONTEXT_CORE_PROFILE_BIT_ARB, None};
    return ((PFNGLXCREATECONTEXTATTRIBSARBPROC)demo_proc("glXCreateContextAttribsARB"))(display, config, NULL, True, a);
}

static void open_window(struct demo_window *w)
{
    display = x11_open();
#ifdef DEMO_DLOPEN
    dlgl_load();
#endif
    GLXFBConfig config = NULL;
    XVisualInfo *visual = choose(w, &config);
    if (!visual)
        demo_fail(1, "no GLX visual of this kind");
    context = w->core ? core_context(config) : glXCreateContext(display, visual, NULL, True);
    if (!context)
        demo_fail(1, "%s failed", w->core ? "glXCreateContextAttribsARB" : "glXCreateContext");
    win = x11_window(display, visual, w);
    XFree(visual);
    if (!glXMakeCurrent(display, win, context))
        demo_fail(1, "glXMakeCurrent failed");
}

static int frame_end(void)
{
    glXSwapBuffers(display, win);
    return x11_quit(display);
}

static demo_function proc(const char *name) { return (demo_function)glXGetProcAddressARB((const GLubyte *)name); }

/* A covered window is cheaper to draw, which would falsify timings. */
static void raise_window(void)
{
    XRaiseWindow(display, win);
    XSync(display, False);
}

static void close_window(void)
{
    glXMakeCurrent(display, None, NULL);
    glXDestroyContext(display, context);
    XDestroyWindow(display, win);
    XCloseDisplay(display);
}

const struct demo_api demo_glx = {"glx", open_window, frame_end, proc, close_window, raise_window};
