/* A window that lies at 7,5, then at 8,5, then at 8,6, two frames at each place. With an argument it is drawn to through a drawable
 * of glXCreateWindow. */
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xlib.h>

enum { WIDTH = 96, HEIGHT = 64 };

static void draw(void)
{
    glClearColor(0.1f, 0.2f, 0.3f, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-0.6, 0.6, -0.4, 0.4, 1, 50);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    /* Bars at several depths, each with its own colour. */
    for (int i = 0; i < 12; i++) {
        float x = -3 + 0.55f * i, z = -3 - 2.3f * (float)((i * 5) % 12);
        glColor3f((float)(i % 3) / 2, (float)(i % 5) / 4, 1 - (float)(i % 7) / 6);
        glBegin(GL_TRIANGLES);
        glVertex3f(x, -2, z);
        glVertex3f(x + 0.8f, -2, z);
        glVertex3f(x + 0.3f, 3, z - 1);
        glEnd();
    }
}

int main(int argc, char **argv)
{
    int wanted[] = {GLX_DOUBLEBUFFER, True, GLX_DEPTH_SIZE, 16, None}, count;
    (void)argv;
    Display *display = XOpenDisplay(NULL);
    GLXFBConfig *configs = display ? glXChooseFBConfig(display, DefaultScreen(display), wanted, &count) : NULL;
    XVisualInfo *visual = configs ? glXGetVisualFromFBConfig(display, configs[0]) : NULL;
    if (!visual)
        return 2;
    Window root = DefaultRootWindow(display);
    XSetWindowAttributes a = {.colormap = XCreateColormap(display, root, visual->visual, AllocNone), .override_redirect = True};
    Window window = XCreateWindow(display, root, 7, 5, WIDTH, HEIGHT, 0, visual->depth, InputOutput, visual->visual,
                                  CWColormap | CWOverrideRedirect, &a);
    XMapWindow(display, window);
    XSync(display, False);
    GLXDrawable drawable = argc > 1 ? glXCreateWindow(display, configs[0], window, NULL) : window;
    GLXContext context = glXCreateNewContext(display, configs[0], GLX_RGBA_TYPE, NULL, True);
    if (!glXMakeContextCurrent(display, drawable, drawable, context))
        return 3;
    static const int places[3][2] = {{7, 5}, {8, 5}, {8, 6}};
    for (int i = 0; i < 6; i++) {
        XMoveWindow(display, window, places[i / 2][0], places[i / 2][1]);
        XSync(display, False);
        draw();
        glXSwapBuffers(display, drawable);
    }
    glXMakeContextCurrent(display, None, None, NULL);
    if (argc > 1)
        glXDestroyWindow(display, drawable);
    return 0;
}
