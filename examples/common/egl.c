/* OpenGL and OpenGL ES through EGL: an X window, or a pbuffer (the only choice without a DISPLAY). */
#include "x11.h"
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <stdlib.h>
#include <string.h>

static Display *x_display;
static Window win;
static EGLDisplay display;
static EGLSurface surface;
static EGLContext context;

static EGLDisplay default_display(void)
{
    const char *e = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    PFNEGLGETPLATFORMDISPLAYEXTPROC get =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    if (e && get && strstr(e, "EGL_MESA_platform_surfaceless"))
        return get(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    return eglGetDisplay(EGL_DEFAULT_DISPLAY);
}

static void open_surface(struct demo_window *w)
{
    if (w->accumulation == 1)
        demo_fail(1, "EGL has no accumulation buffer");
    const char *name = getenv("DISPLAY");
    int has_display = name && *name;
    if (w->pbuffer < 0)
        w->pbuffer = !has_display;
    if (has_display || !w->pbuffer) {
        x_display = x11_open();
        display = eglGetDisplay((EGLNativeDisplayType)x_display);
    } else {
        display = default_display();
    }
    if (!display || !eglInitialize(display, NULL, NULL))
        demo_fail(1, "no EGL display");
    if (!eglBindAPI(w->es ? EGL_OPENGL_ES_API : EGL_OPENGL_API))
        demo_fail(1, "this EGL has no %s", w->es ? "OpenGL ES" : "desktop OpenGL");

    const EGLint wanted[] = {EGL_SURFACE_TYPE, w->pbuffer ? EGL_PBUFFER_BIT : EGL_WINDOW_BIT,
                             EGL_RENDERABLE_TYPE, w->es == 3 ? EGL_OPENGL_ES3_BIT : w->es ? EGL_OPENGL_ES2_BIT : EGL_OPENGL_BIT,
                             EGL_RED_SIZE, 8, EGL_GREEN_SIZE, 8, EGL_BLUE_SIZE, 8,
                             EGL_DEPTH_SIZE, 24, EGL_STENCIL_SIZE, 8,
                             EGL_SAMPLE_BUFFERS, w->samples > 0, EGL_SAMPLES, w->samples, EGL_NONE};
    EGLConfig configs[256], config = NULL;
    EGLint count = 0, red;
    eglChooseConfig(display, wanted, configs, 256, &count);
    for (int i = count - 1; i >= 0; i--) /* EGL puts 10-bit colours first; the demos need 8 */
        if (eglGetConfigAttrib(display, configs[i], EGL_RED_SIZE, &red) && red == 8)
            config = configs[i];
    if (!config)
        demo_fail(1, "no EGL config of this kind");
    const EGLint core[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3,
                           EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    const EGLint es[] = {EGL_CONTEXT_MAJOR_VERSION, w->es, EGL_NONE};
    context = eglCreateContext(display, config, EGL_NO_CONTEXT, w->core ? core : w->es ? es : NULL);
    if (!context)
        demo_fail(1, "eglCreateContext failed (0x%x)", eglGetError());

    EGLint attributes[8] = {EGL_NONE}, n = 0;
    if (w->pbuffer) {
        attributes[n++] = EGL_WIDTH;
        attributes[n++] = w->width;
        attributes[n++] = EGL_HEIGHT;
        attributes[n++] = w->height;
    }
    const char *e = eglQueryString(display, EGL_EXTENSIONS);
    if (w->srgb && e && strstr(e, "EGL_KHR_gl_colorspace")) {
        attributes[n++] = EGL_GL_COLORSPACE_KHR;
        attributes[n++] = EGL_GL_COLORSPACE_SRGB_KHR;
    }
    attributes[n] = EGL_NONE;
    if (w->pbuffer) {
        surface = eglCreatePbufferSurface(display, config, attributes);
    } else {
        EGLint id;
        int found;
        eglGetConfigAttrib(display, config, EGL_NATIVE_VISUAL_ID, &id);
        XVisualInfo pattern = {.visualid = (VisualID)id};
        XVisualInfo *visual = XGetVisualInfo(x_display, VisualIDMask, &pattern, &found);
        if (!visual)
            demo_fail(1, "no X visual for the EGL config");
        win = x11_window(x_display, visual, w);
        XFree(visual);
        surface = eglCreateWindowSurface(display, config, (EGLNativeWindowType)win, attributes);
    }
    if (!surface || !eglMakeCurrent(display, surface, surface, context))
        demo_fail(1, "no EGL surface (0x%x)", eglGetError());
}

static int frame_end(void)
{
    eglSwapBuffers(display, surface);
    return win ? x11_quit(x_display) : 0;
}

static demo_function proc(const char *name) { return (demo_function)eglGetProcAddress(name); }

static void raise_window(void)
{
    if (!win)
        return;
    XRaiseWindow(x_display, win);
    XSync(x_display, False);
}

static void close_surface(void)
{
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroySurface(display, surface);
    eglDestroyContext(display, context);
    eglTerminate(display);
    if (win)
        XDestroyWindow(x_display, win);
    if (x_display)
        XCloseDisplay(x_display);
}

const struct demo_api demo_egl = {"egl", open_surface, frame_end, proc, close_surface, raise_window};
