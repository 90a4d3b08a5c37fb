/* Draws to the front buffer of an X window, with a back buffer or (argument "single") without one, flushes, and prints the pixels of the
 * window then and after a swap. */
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <stdio.h>
#include <string.h>

enum { WIDTH = 64, HEIGHT = 48 };

static Display *display;
static Window window;

static void shown(const char *when)
{
    XSync(display, False);
    XImage *image = XGetImage(display, window, 0, 0, WIDTH, HEIGHT, AllPlanes, ZPixmap);
    printf("%s: corner %06lx, middle %06lx\n", when, XGetPixel(image, 2, 2), XGetPixel(image, WIDTH / 2, HEIGHT / 2));
    XDestroyImage(image);
}

static void clear(float red, float green, float blue)
{
    glClearColor(red, green, blue, 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

int main(int argc, char **argv)
{
    int single = argc > 1 && !strcmp(argv[1], "single");
    int wanted[] = {GLX_RGBA, GLX_DEPTH_SIZE, 24, single ? None : GLX_DOUBLEBUFFER, None};
    display = XOpenDisplay(NULL);
    XVisualInfo *visual = display ? glXChooseVisual(display, 0, wanted) : NULL;
    if (!visual)
        return 2;
    Window root = DefaultRootWindow(display);
    XSetWindowAttributes attributes = {.colormap = XCreateColormap(display, root, visual->visual, AllocNone)};
    window = XCreateWindow(display, root, 0, 0, WIDTH, HEIGHT, 0, visual->depth, InputOutput, visual->visual, CWColormap, &attributes);
    XMapWindow(display, window);
    GLXContext context = glXCreateContext(display, visual, NULL, True);
    if (!glXMakeCurrent(display, window, context))
        return 2;
    glDrawBuffer(GL_FRONT);
    clear(0, 0, 1);
    glColor3f(0, 1, 0);
    glRectf(-0.5f, -0.5f, 0.5f, 0.5f);
    glFlush();
    shown("flushed");
    if (single) {
        clear(1, 0, 0);
        glXSwapBuffers(display, window);
        shown("swapped");
    } else {
        glDrawBuffer(GL_BACK);
        clear(1, 0, 0);
        glFlush();
        shown("back buffer drawn");
        glXSwapBuffers(display, window);
        shown("swapped");
        glDrawBuffer(GL_FRONT_AND_BACK);
        clear(1, 1, 1);
        glFinish();
        shown("both drawn");
    }
    printf("error 0x%x\n", glGetError());
    return 0;
}
