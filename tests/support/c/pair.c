/* Shows two windows again and again until the file STOP exists: a large red one and a small green one, of the sizes LARGE and SMALL.
 *   pair STOP
 * A second context draws to the small one. Once the file `STOP.small` exists, only the small one is shown. */
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <stdio.h>
#include <unistd.h>

enum { FRAMES = 20000 };
static const int sizes[2][2] = {{160, 120}, {80, 60}};

int main(int count, char **arguments)
{
    int wanted[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 16, None};
    Display *display = XOpenDisplay(NULL);
    XVisualInfo *visual = display ? glXChooseVisual(display, DefaultScreen(display), wanted) : NULL;
    if (count < 2 || !visual)
        return 2;
    char small[4096];
    snprintf(small, sizeof small, "%s.small", arguments[1]);
    Window root = DefaultRootWindow(display);
    XSetWindowAttributes a = {.colormap = XCreateColormap(display, root, visual->visual, AllocNone), .override_redirect = True};
    Window windows[2];
    GLXContext contexts[2];
    for (int i = 0; i < 2; i++) {
        windows[i] = XCreateWindow(display, root, 200 * i, 0, (unsigned)sizes[i][0], (unsigned)sizes[i][1], 0, visual->depth, InputOutput,
                                   visual->visual, CWColormap | CWOverrideRedirect, &a);
        XMapWindow(display, windows[i]);
        contexts[i] = glXCreateContext(display, visual, NULL, True);
    }
    XSync(display, False);
    for (int frame = 0; frame < FRAMES && access(arguments[1], F_OK); frame++) {
        for (int i = access(small, F_OK) ? 0 : 1; i < 2; i++) {
            if (!glXMakeCurrent(display, windows[i], contexts[i]))
                return 3;
            glClearColor(i == 0, i == 1, 0, 1);
            glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
            glXSwapBuffers(display, windows[i]);
        }
        usleep(2000);
    }
    XCloseDisplay(display);
    return 0;
}
