/* A program that draws a picture for each eye to a stereo window, which drivers for Xvfb do not have.
 *
 * eyes visual|config [both|left|right|unused]
 *
 * both (unless given): the left eye and the right one, each to its own buffer, and a frame that both have. left, right: that eye alone, to a window without stereo; unused: the left one, to a window with. The last
 * line says whether the window has stereo. */
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <stdio.h>
#include <string.h>

enum { WIDTH = 96, HEIGHT = 64, FRAMES = 3 };

/* A wall and a rod before it, as an eye sees them. */
static void scene(float eye, int frame)
{
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-1.0 - eye, 1.0 - eye, -0.7, 0.7, 2.0, 20.0);
    glTranslatef(-2.0f * eye, 0.0f, 0.0f);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glBegin(GL_QUADS);
    glColor3f(0.2f, 0.5f + 0.1f * (float)frame, 0.8f);
    glVertex3f(-3, -2, -9), glVertex3f(3, -2, -9), glVertex3f(3, 2, -9), glVertex3f(-3, 2, -9);
    glColor3f(0.9f, 0.4f, 0.1f);
    glVertex3f(-0.3f, -0.9f, -4), glVertex3f(0.3f, -0.9f, -4), glVertex3f(0.3f, 0.9f, -4), glVertex3f(-0.3f, 0.9f, -4);
    glEnd();
}

int main(int count, char **words)
{
    const char *way = count > 1 ? words[1] : "visual", *which = count > 2 ? words[2] : "both";
    const int both = !strcmp(which, "both"), asks = both || !strcmp(which, "unused");
    Display *display = XOpenDisplay(NULL);
    if (!display)
        return 77;
    int screen = DefaultScreen(display), stereo = 0;
    GLboolean told = 0;
    XVisualInfo *visual;
    GLXContext context;
    if (!strcmp(way, "config")) {
        int number, list[] = {GLX_DOUBLEBUFFER, 1, GLX_DEPTH_SIZE, 16, GLX_STEREO, asks, None};
        GLXFBConfig *all = glXChooseFBConfig(display, screen, list, &number);
        if (!all)
            return puts("no window"), 1;
        visual = glXGetVisualFromFBConfig(display, all[0]);
        glXGetFBConfigAttrib(display, all[0], GLX_STEREO, &stereo);
        context = glXCreateNewContext(display, all[0], GLX_RGBA_TYPE, NULL, 1);
    } else {
        int list[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 16, asks ? GLX_STEREO : None, None};
        visual = glXChooseVisual(display, screen, list);
        if (!visual)
            return puts("no window"), 1;
        glXGetConfig(display, visual, GLX_STEREO, &stereo);
        context = glXCreateContext(display, visual, NULL, 1);
    }
    XSetWindowAttributes about = {0};
    about.colormap = XCreateColormap(display, RootWindow(display, screen), visual->visual, AllocNone);
    Window window = XCreateWindow(display, RootWindow(display, screen), 0, 0, WIDTH, HEIGHT, 0, visual->depth, InputOutput, visual->visual, CWColormap, &about);
    XMapWindow(display, window);
    glXMakeCurrent(display, window, context);
    glGetBooleanv(GL_STEREO, &told);
    glEnable(GL_DEPTH_TEST);
    for (int frame = 0; frame < FRAMES; frame++) {
        for (int eye = 0; eye < 2; eye++) {
            if (!both && eye != !strcmp(which, "right"))
                continue;
            if (both)
                glDrawBuffer(eye ? GL_BACK_RIGHT : GL_BACK_LEFT);
            scene(eye ? 0.1f : -0.1f, frame);
        }
        /* What both eyes see. */
        glDrawBuffer(GL_BACK);
        glDisable(GL_DEPTH_TEST);
        glLoadIdentity();
        glMatrixMode(GL_PROJECTION);
        glLoadIdentity();
        glColor3f(1, 1, 0);
        glRectf(-0.95f, -0.95f, -0.6f, -0.7f);
        glEnable(GL_DEPTH_TEST);
        glXSwapBuffers(display, window);
    }
    printf("%d %d %x\n", stereo, told, (unsigned)glGetError());
    return 0;
}
