/* Draws a frame, forks, ends the child before it makes a GL call, and draws another frame. */
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <sys/wait.h>
#include <unistd.h>

int main(void)
{
    int wanted[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 16, None}, status = 1;
    Display *d = XOpenDisplay(NULL);
    if (!d)
        return 2;
    XVisualInfo *v = glXChooseVisual(d, DefaultScreen(d), wanted);
    XSetWindowAttributes a = {0};
    a.colormap = XCreateColormap(d, DefaultRootWindow(d), v->visual, AllocNone);
    Window w = XCreateWindow(d, DefaultRootWindow(d), 0, 0, 64, 48, 0, v->depth, InputOutput, v->visual,
                             CWBorderPixel | CWColormap, &a);
    XMapWindow(d, w);
    GLXContext c = glXCreateContext(d, v, NULL, True);
    glXMakeCurrent(d, w, c);
    for (int frame = 0; frame < 2; frame++) {
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glBegin(GL_TRIANGLES);
        glVertex2f(-1, -1);
        glVertex2f(1, -1);
        glVertex2f(0, 1);
        glEnd();
        glXSwapBuffers(d, w);
        if (frame)
            break;
        pid_t child = fork();
        if (!child)
            _exit(0);
        waitpid(child, &status, 0);
    }
    glXMakeCurrent(d, None, NULL);
    glXDestroyContext(d, c);
    XCloseDisplay(d);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}
