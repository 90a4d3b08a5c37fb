/* A window that lies at 7,5, then at 8,5, then at 8,6, two frames at each place. Each argument is a word:
 *   drawable    drawn to through a drawable of glXCreateWindow
 *   egl         drawn to through EGL; with `platform` by eglCreatePlatformWindowSurface
 *   samples     four samples per pixel
 *   reversed    near things have the larger depths */
#include "scene.h"
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <string.h>

static int count;
static char **words;

static int has(const char *word)
{
    for (int i = 1; i < count; i++)
        if (!strcmp(words[i], word))
            return 1;
    return 0;
}

static Window window(Display *display, XVisualInfo *visual)
{
    Window root = DefaultRootWindow(display);
    XSetWindowAttributes a = {.colormap = XCreateColormap(display, root, visual->visual, AllocNone), .override_redirect = True};
    Window made = XCreateWindow(display, root, 7, 5, WIDTH, HEIGHT, 0, visual->depth, InputOutput, visual->visual,
                                CWColormap | CWOverrideRedirect, &a);
    XMapWindow(display, made);
    XSync(display, False);
    return made;
}

static void frame(Display *display, Window window, int i)
{
    static const int places[3][2] = {{7, 5}, {8, 5}, {8, 6}};
    XMoveWindow(display, window, places[i / 2][0], places[i / 2][1]);
    XSync(display, False);
    if (has("reversed")) {
        glDepthRange(1, 0);
        glDepthFunc(GL_GREATER);
        glClearDepth(0);
    }
    bars();
}

static int by_glx(Display *display)
{
    int wanted[] = {GLX_DOUBLEBUFFER, True, GLX_DEPTH_SIZE, 16, GLX_SAMPLES, has("samples") ? 4 : 0, None}, found;
    GLXFBConfig *configs = glXChooseFBConfig(display, DefaultScreen(display), wanted, &found);
    XVisualInfo *visual = configs ? glXGetVisualFromFBConfig(display, configs[0]) : NULL;
    if (!visual)
        return 2;
    Window shown = window(display, visual);
    GLXDrawable drawable = has("drawable") ? glXCreateWindow(display, configs[0], shown, NULL) : shown;
    GLXContext context = glXCreateNewContext(display, configs[0], GLX_RGBA_TYPE, NULL, True);
    if (!glXMakeContextCurrent(display, drawable, drawable, context))
        return 3;
    for (int i = 0; i < 6; i++) {
        frame(display, shown, i);
        glXSwapBuffers(display, drawable);
    }
    glXMakeContextCurrent(display, None, None, NULL);
    if (has("drawable"))
        glXDestroyWindow(display, drawable);
    return 0;
}

static int by_egl(Display *display)
{
    EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_WINDOW_BIT, EGL_RED_SIZE, 8, EGL_DEPTH_SIZE, 16, EGL_NONE};
    EGLint found, id;
    EGLConfig config;
    EGLDisplay egl = eglGetPlatformDisplay(EGL_PLATFORM_X11_EXT, display, NULL);
    if (!eglInitialize(egl, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API) || !eglChooseConfig(egl, wanted, &config, 1, &found) || !found ||
        !eglGetConfigAttrib(egl, config, EGL_NATIVE_VISUAL_ID, &id))
        return 4;
    XVisualInfo like = {.visualid = (VisualID)id}, *visual = XGetVisualInfo(display, VisualIDMask, &like, &found);
    if (!visual)
        return 5;
    Window shown = window(display, visual);
    /* Older programs give the window itself, newer ones its address. */
    EGLSurface surface = has("platform") ? eglCreatePlatformWindowSurface(egl, config, &shown, NULL)
                                         : eglCreateWindowSurface(egl, config, (EGLNativeWindowType)shown, NULL);
    EGLContext context = eglCreateContext(egl, config, EGL_NO_CONTEXT, NULL);
    if (!eglMakeCurrent(egl, surface, surface, context))
        return 6;
    for (int i = 0; i < 6; i++) {
        frame(display, shown, i);
        eglSwapBuffers(egl, surface);
    }
    eglMakeCurrent(egl, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroySurface(egl, surface);
    return 0;
}

int main(int argc, char **argv)
{
    count = argc;
    words = argv;
    Display *display = XOpenDisplay(NULL);
    return !display ? 1 : has("egl") ? by_egl(display) : by_glx(display);
}
