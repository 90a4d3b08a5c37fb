#include "x11.h"
#include <X11/keysym.h>
#include <stdlib.h>

static Atom delete_window;

Display *x11_open(void)
{
    const char *name = getenv("DISPLAY");
    Display *d = XOpenDisplay(NULL);
    if (!d)
        demo_fail(1, "cannot open the X display %s", name ? name : "(DISPLAY is not set)");
    return d;
}

Window x11_window(Display *display, XVisualInfo *visual, const struct demo_window *w)
{
    Window root = RootWindow(display, visual->screen);
    XSetWindowAttributes a = {0};
    a.colormap = XCreateColormap(display, root, visual->visual, AllocNone);
    a.event_mask = StructureNotifyMask | KeyPressMask;
    Window win = XCreateWindow(display, root, 0, 0, (unsigned)w->width, (unsigned)w->height, 0, visual->depth,
                               InputOutput, visual->visual, CWBackPixel | CWBorderPixel | CWColormap | CWEventMask, &a);
    XSizeHints fixed = {.flags = PMinSize | PMaxSize,
                        .min_width = w->width, .max_width = w->width,
                        .min_height = w->height, .max_height = w->height};
    XSetStandardProperties(display, win, w->title, w->title, None, NULL, 0, &fixed);
    delete_window = XInternAtom(display, "WM_DELETE_WINDOW", False);
    XSetWMProtocols(display, win, &delete_window, 1);
    XMapWindow(display, win);
    for (XEvent e; XWindowEvent(display, win, StructureNotifyMask, &e), e.type != MapNotify;) { }
    return win;
}

int x11_quit(Display *display)
{
    int quit = 0;
    while (XPending(display)) {
        XEvent e;
        XNextEvent(display, &e);
        if (e.type == ClientMessage && (Atom)e.xclient.data.l[0] == delete_window)
            quit = 1;
        if (e.type == KeyPress) {
            KeySym key = XLookupKeysym(&e.xkey, 0);
            quit |= key == XK_Escape || key == XK_q;
        }
    }
    return quit;
}
