/* Shows frames as fast as it can, as many as its argument says, each a little lighter and the last one white. After that it draws only when its window is uncovered,
 * until its input ends. */
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <poll.h>
#include <stdlib.h>

static Display *display;
static Window window;

static void show(float light)
{
    glClearColor(light, light, light, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glBegin(GL_TRIANGLES);
    glColor3f(light, light, light);
    glVertex3f(-1, -1, 0);
    glVertex3f(1, -1, 0);
    glVertex3f(0, 1, 0);
    glEnd();
    glXSwapBuffers(display, window);
}

int main(int argc, char **argv)
{
    int frames = argc > 1 ? atoi(argv[1]) : 30;
    int wanted[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 16, None};
    display = XOpenDisplay(NULL);
    if (!display)
        return 2;
    XVisualInfo *visual = glXChooseVisual(display, DefaultScreen(display), wanted);
    if (!visual)
        return 2;
    XSetWindowAttributes attributes = {.event_mask = ExposureMask};
    Window root = DefaultRootWindow(display);
    attributes.colormap = XCreateColormap(display, root, visual->visual, AllocNone);
    window = XCreateWindow(display, root, 0, 0, 64, 48, 0, visual->depth, InputOutput, visual->visual,
                           CWColormap | CWEventMask, &attributes);
    XMapWindow(display, window);
    GLXContext context = glXCreateContext(display, visual, NULL, True);
    if (!glXMakeCurrent(display, window, context))
        return 2;
    for (int frame = 1; frame <= frames; frame++)
        show((float)frame / (float)frames);
    /* That the window was uncovered when it was mapped is no news any more. */
    XSync(display, True);
    for (;;) {
        struct pollfd inputs[2] = {{0, POLLIN, 0}, {ConnectionNumber(display), POLLIN, 0}};
        int uncovered = 0;
        while (XPending(display)) {
            XEvent event;
            XNextEvent(display, &event);
            uncovered |= event.type == Expose;
        }
        if (uncovered)
            show(1);
        poll(inputs, 2, -1);
        if (inputs[0].revents)
            return 0;
    }
}
