/* Preloaded before everything else: writes the pixels of the X window after a swap as a binary PPM.
 *   WINDOW_DUMP   file    WINDOW_FRAME  the swap it is written after, counted from 1
 * XGetImage reads the window itself, so no glReadPixels stands between the driver and the picture. */
#define _GNU_SOURCE
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

static Display *display;
static Window window;
static int frame;

int XMapWindow(Display *d, Window w)
{
    int (*next)(Display *, Window) = (int (*)(Display *, Window))dlsym(RTLD_NEXT, "XMapWindow");
    display = d;
    window = w;
    return next(d, w);
}

static void swapped(void)
{
    const char *path = getenv("WINDOW_DUMP"), *wanted = getenv("WINDOW_FRAME");
    XWindowAttributes a;
    if (!path || !wanted || !display || ++frame != atoi(wanted))
        return;
    XSync(display, False);
    XGetWindowAttributes(display, window, &a);
    XImage *image = XGetImage(display, window, 0, 0, (unsigned)a.width, (unsigned)a.height, AllPlanes, ZPixmap);
    FILE *out = fopen(path, "wb");
    if (!image || !out)
        abort();
    fprintf(out, "P6\n%d %d\n255\n", a.width, a.height);
    for (int y = 0; y < a.height; y++)
        for (int x = 0; x < a.width; x++) {
            unsigned long p = XGetPixel(image, x, y);
            fputc((int)(p >> 16 & 255), out);
            fputc((int)(p >> 8 & 255), out);
            fputc((int)(p & 255), out);
        }
    fclose(out);
    XDestroyImage(image);
}

void glXSwapBuffers(Display *d, unsigned long drawable)
{
    ((void (*)(Display *, unsigned long))dlsym(RTLD_NEXT, "glXSwapBuffers"))(d, drawable);
    swapped();
}

unsigned eglSwapBuffers(void *d, void *surface)
{
    unsigned ok = ((unsigned (*)(void *, void *))dlsym(RTLD_NEXT, "eglSwapBuffers"))(d, surface);
    swapped();
    return ok;
}
