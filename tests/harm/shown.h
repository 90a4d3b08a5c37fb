/* What a window of a test shows. */
#ifndef SHOWN_H
#define SHOWN_H
#include "../hosts/scene.h"
#include "../hosts/window.h"
#include <X11/Xutil.h>
#include <stdio.h>

/* Prints two pixels of the window, a quarter from its left and from its right edge. */
static inline void shown(const struct window *w, const char *what, int frame)
{
    glFinish();
    XSync(w->display, False);
    XImage *image = XGetImage(w->display, w->window, 0, 0, WIDTH, HEIGHT, AllPlanes, ZPixmap);
    unsigned long left = XGetPixel(image, WIDTH / 4, HEIGHT / 2), right = XGetPixel(image, 3 * WIDTH / 4, HEIGHT / 2);
    printf("%s %d: %06lx %06lx\n", what, frame, left & 0xffffff, right & 0xffffff);
    fflush(stdout);
    XDestroyImage(image);
}

/* Draws a square over the left half of the window in frames of even numbers, and over the right half in the others. */
static inline void halves(int frame)
{
    float x = frame % 2 ? 0 : -1;
    glClear(GL_COLOR_BUFFER_BIT);
    glColor3f(1, (float)frame / 8, 0);
    glRectf(x, -1, x + 1, 1);
}
#endif
