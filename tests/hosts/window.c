#include "window.h"
#include "scene.h"
#include <stdlib.h>

struct window open_window(void)
{
    int wanted[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 16, None};
    struct window w = {.display = XOpenDisplay(NULL)};
    XVisualInfo *visual = w.display ? glXChooseVisual(w.display, DefaultScreen(w.display), wanted) : NULL;
    if (!visual)
        exit(2);
    Window root = DefaultRootWindow(w.display);
    XSetWindowAttributes a = {.colormap = XCreateColormap(w.display, root, visual->visual, AllocNone)};
    w.window = XCreateWindow(w.display, root, 0, 0, WIDTH, HEIGHT, 0, visual->depth, InputOutput, visual->visual, CWColormap, &a);
    XMapWindow(w.display, w.window);
    w.context = glXCreateContext(w.display, visual, NULL, True);
    XFree(visual);
    XSync(w.display, False);
    return w;
}

void make_current(const struct window *w)
{
    if (!glXMakeCurrent(w->display, w->window, w->context))
        exit(3);
}

void close_window(struct window *w)
{
    glXMakeCurrent(w->display, None, NULL);
    glXDestroyContext(w->display, w->context);
    XDestroyWindow(w->display, w->window);
    XCloseDisplay(w->display);
}
