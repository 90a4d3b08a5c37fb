/* The X window that glx.c and egl.c draw into. */
#ifndef X11_H
#define X11_H
#include "demo.h"
#include <X11/Xlib.h>
#include <X11/Xutil.h>

Display *x11_open(void);
Window x11_window(Display *display, XVisualInfo *visual, const struct demo_window *w);
int x11_quit(Display *display); /* handles events; non-zero after Escape, q or the close button */
#endif
