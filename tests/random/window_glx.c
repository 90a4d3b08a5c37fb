/* Double-buffered X windows; with an accumulation buffer where there is one. */
#include "random.h"
#include <GL/glx.h>
#include <pthread.h>

static Display *display;
static XVisualInfo *visual;
/* Made by glXCreateWindow: of a window that is its own drawable Mesa forgets what was drawn when a context leaves it. */
static GLXWindow windows[(CONTEXTS + 1) * (1 + OTHERS)];

static GLXFBConfig config_of(XVisualInfo *of, int screen)
{
    int count = 0, id;
    GLXFBConfig *all = glXGetFBConfigs(display, screen, &count), found = NULL;
    for (int i = 0; i < count && !found; i++)
        if (!glXGetFBConfigAttrib(display, all[i], GLX_VISUAL_ID, &id) && (VisualID)id == of->visualid)
            found = all[i];
    XFree(all);
    if (!found)
        fail("no GLX configuration");
    return found;
}

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
    GLXFBConfig config = config_of(visual, screen);
    for (int i = 0; i < drawables; i++) {
        /* Side by side: pixels under another window are undefined. */
        Window window = XCreateWindow(display, root, i % 8 * WIDTH, i / 8 * HEIGHT, WIDTH, HEIGHT, 0, visual->depth, InputOutput, visual->visual,
                                      CWColormap | CWBorderPixel | CWOverrideRedirect, &a);
        XMapWindow(display, window);
        windows[i] = glXCreateWindow(display, config, window, NULL);
    }
    XSync(display, False);
}

static void *glx_create(void *share) { return glXCreateContext(display, visual, share, True); }

static void glx_current(void *handle, int draw, int read)
{
    if (!glXMakeContextCurrent(display, handle ? windows[draw] : None, handle ? windows[read] : None, handle))
        fail("glXMakeContextCurrent failed");
}

static void glx_destroy(void *handle) { glXDestroyContext(display, handle); }
static void glx_swap(int drawable) { glXSwapBuffers(display, windows[drawable]); }

const struct window_api window_glx = {"glx", glx_open, glx_create, glx_current, glx_destroy, glx_swap, 1, 1};
