/* A GLX window of one thread, which has a connection of its own. */
#include <GL/glx.h>
#include <X11/Xlib.h>

struct window {
    Display *display;
    Window window;
    GLXContext context;
};

struct window open_window(void);
void make_current(const struct window *w);
void close_window(struct window *w);
