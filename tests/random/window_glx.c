/* Double-buffered X windows; with an accumulation buffer where there is one. */
#include "random.h"
#include <GL/glx.h>
#include <pthread.h>

static Display *display;
static XVisualInfo *visual;
static Window windows[8];

static void glx_open(int drawables)
{
    XInitThreads();
    display = XOpenDisplay(NULL);
    if (!display)
        fail("no X server");
    int screen = DefaultScreen(display);
    int wanted[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 8, GLX_GREEN_SIZE, 8, GLX_BLUE_SIZE, 8, GLX_DEPTH_SIZE, 24,
                    GLX_STENCIL_SIZE, 8, GLX_ACCUM_RED_SIZE, 8, None};
    visual = glXChooseVisual(display, screen, wanted);
    if (!visual) {
        wanted[12] = None;
        visual = glXChooseVisual(display, screen, wanted);
    }
    if (!visual)
        fail("no GLX visual");
    Window root = RootWindow(display, screen);
    XSetWindowAttributes a = {.colormap = XCreateColormap(display, root, visual->visual, AllocNone)};
    for (int i = 0; i < drawables; i++) {
        /* Side by side: pixels under another window are undefined. */
        windows[i] = XCreateWindow(display, root, i * WIDTH, 0, WIDTH, HEIGHT, 0, visual->depth, InputOutput, visual->visual,
                                   CWColormap | CWBorderPixel | CWOverrideRedirect, &a);
        XMapWindow(display, windows[i]);
    }
    XSync(display, False);
}

static void *glx_create(void *share) { return glXCreateContext(display, visual, share, True); }

static void glx_current(void *handle, int drawable)
{
    if (!glXMakeCurrent(display, handle ? windows[drawable] : None, handle))
        fail("glXMakeCurrent failed");
}

static void glx_destroy(void *handle) { glXDestroyContext(display, handle); }
static void glx_swap(int drawable) { glXSwapBuffers(display, windows[drawable]); }

const struct window_api window_glx = {"glx", glx_open, glx_create, glx_current, glx_destroy, glx_swap, 1};
