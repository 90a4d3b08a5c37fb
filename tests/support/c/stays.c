/* Draws the same frame again and again until the file STOP exists or the frames are over.
 *   stays STOP [FOLDER]
 * With IDLE in the environment it draws only when the window was exposed.
 * The keysyms of the window's key presses are added to `keys` in FOLDER, a line each.
 * Where FOLDER has a file `shoot`, the program writes the window's pixels to `shot.ppm` and removes `shoot`. */
#include "scene.h"
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { FRAMES = 20000 };

static void draw(void)
{
    bars();
    /* A gauge before the scene. */
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(0, WIDTH, 0, HEIGHT, -1, 1);
    glDisable(GL_DEPTH_TEST);
    glColor3f(1, 1, 0);
    glRecti(40, 4, 56, 12);
}

static void shoot(Display *display, Window window, const char *folder)
{
    char order[4096], growing[4096], done[4096];
    snprintf(order, sizeof order, "%s/shoot", folder);
    snprintf(growing, sizeof growing, "%s/growing", folder);
    snprintf(done, sizeof done, "%s/shot.ppm", folder);
    if (access(order, F_OK))
        return;
    XSync(display, False);
    XImage *image = XGetImage(display, window, 0, 0, WIDTH, HEIGHT, AllPlanes, ZPixmap);
    FILE *out = fopen(growing, "wb");
    if (!image || !out)
        return;
    fprintf(out, "P6\n%d %d\n255\n", WIDTH, HEIGHT);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            unsigned long p = XGetPixel(image, x, y);
            fputc((int)(p >> 16 & 255), out);
            fputc((int)(p >> 8 & 255), out);
            fputc((int)(p & 255), out);
        }
    fclose(out);
    XDestroyImage(image);
    rename(growing, done);
    unlink(order);
}

/* Returns whether the window was exposed. */
static int type(Display *display, const char *folder)
{
    int exposed = 0;
    while (XPending(display)) {
        XEvent event;
        XNextEvent(display, &event);
        exposed |= event.type == Expose;
        char path[4096];
        snprintf(path, sizeof path, "%s/keys", folder);
        FILE *out = event.type == KeyPress ? fopen(path, "a") : NULL;
        if (out) {
            fprintf(out, "%lx\n", XLookupKeysym(&event.xkey, 0));
            fclose(out);
        }
    }
    return exposed;
}

int main(int count, char **arguments)
{
    const int idle = getenv("IDLE") != NULL;
    int wanted[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 16, None};
    Display *display = XOpenDisplay(NULL);
    XVisualInfo *visual = display ? glXChooseVisual(display, DefaultScreen(display), wanted) : NULL;
    if (count < 2 || !visual)
        return 2;
    Window root = DefaultRootWindow(display);
    XSetWindowAttributes a = {.colormap = XCreateColormap(display, root, visual->visual, AllocNone), .override_redirect = True,
                              .event_mask = KeyPressMask | (idle ? ExposureMask : 0)};
    Window window = XCreateWindow(display, root, 0, 0, WIDTH, HEIGHT, 0, visual->depth, InputOutput, visual->visual,
                                  CWColormap | CWOverrideRedirect | CWEventMask, &a);
    XMapWindow(display, window);
    XSync(display, False);
    GLXContext context = glXCreateContext(display, visual, NULL, True);
    if (!glXMakeCurrent(display, window, context))
        return 3;
    for (int i = 0; i < FRAMES && access(arguments[1], F_OK); i++) {
        int exposed = count > 2 && type(display, arguments[2]);
        if (idle && !exposed) {
            usleep(2000);
            continue;
        }
        draw();
        glXSwapBuffers(display, window);
        if (count > 2)
            shoot(display, window, arguments[2]);
        usleep(2000);
    }
    glXMakeCurrent(display, None, NULL);
    glXDestroyContext(display, context);
    XCloseDisplay(display);
    return 0;
}
