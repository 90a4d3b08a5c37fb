/* Chooses a window by its first argument, prints the choice and OpenGL's answers about its buffers, and draws three frames.
 *   visual    glXChooseVisual
 *   config    glXChooseFBConfig
 *   sgix      glXChooseFBConfigSGIX, by its address
 *   any       glXChooseFBConfig without a list
 * After that, `single` asks for a window without a back buffer, and `unlike` for one that is not stereo. */
#define GLX_GLXEXT_PROTOTYPES
#include "scene.h"
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <stdio.h>
#include <string.h>

static int single, unlike;

static GLXFBConfig config(Display *display, const char *way)
{
    int wanted[] = {GLX_DRAWABLE_TYPE, GLX_WINDOW_BIT, GLX_DOUBLEBUFFER, !single, GLX_DEPTH_SIZE, 16, unlike ? GLX_STEREO : None, False, None}, found;
    GLXFBConfig *all;
    if (!strcmp(way, "sgix")) {
        GLXFBConfig *(*choose)(Display *, int, int *, int *) =
            (GLXFBConfig * (*)(Display *, int, int *, int *)) glXGetProcAddressARB((const GLubyte *)"glXChooseFBConfigSGIX");
        all = choose(display, DefaultScreen(display), wanted, &found);
    } else
        all = glXChooseFBConfig(display, DefaultScreen(display), strcmp(way, "any") ? wanted : NULL, &found);
    for (int i = 0; all && i < found; i++) {
        int depth = 0, two = 0;
        XVisualInfo *visual = glXGetVisualFromFBConfig(display, all[i]);
        glXGetFBConfigAttrib(display, all[i], GLX_DEPTH_SIZE, &depth);
        glXGetFBConfigAttrib(display, all[i], GLX_DOUBLEBUFFER, &two);
        if (visual && visual->depth == 24 && depth >= 16 && two == !single)
            return all[i];
    }
    return NULL;
}

int main(int count, char **words)
{
    const char *way = count > 1 ? words[1] : "visual";
    for (int i = 2; i < count; i++) {
        single |= !strcmp(words[i], "single");
        unlike |= !strcmp(words[i], "unlike");
    }
    int wanted[] = {GLX_RGBA, GLX_RED_SIZE, 8, GLX_DEPTH_SIZE, 16, single ? None : GLX_DOUBLEBUFFER, None};
    Display *display = XOpenDisplay(NULL);
    if (!display)
        return 1;
    GLXFBConfig chosen = strcmp(way, "visual") ? config(display, way) : NULL;
    XVisualInfo *visual = chosen ? glXGetVisualFromFBConfig(display, chosen) : glXChooseVisual(display, DefaultScreen(display), wanted);
    if (!visual)
        return 2;
    Window root = DefaultRootWindow(display);
    XSetWindowAttributes a = {.colormap = XCreateColormap(display, root, visual->visual, AllocNone), .override_redirect = True};
    Window window = XCreateWindow(display, root, 0, 0, WIDTH, HEIGHT, 0, visual->depth, InputOutput, visual->visual,
                                  CWColormap | CWOverrideRedirect, &a);
    XMapWindow(display, window);
    XSync(display, False);
    GLXContext context = chosen ? glXCreateNewContext(display, chosen, GLX_RGBA_TYPE, NULL, True) : glXCreateContext(display, visual, NULL, True);
    if (!glXMakeCurrent(display, window, context))
        return 3;
    GLboolean stereo = 9;
    GLint draw = 0, read = 0;
    glGetBooleanv(GL_STEREO, &stereo);
    for (int i = 0; i < 3; i++) {
        glGetIntegerv(GL_DRAW_BUFFER, &draw);
        glGetIntegerv(GL_READ_BUFFER, &read);
        printf("visual %lx stereo %d draws %x reads %x error %x\n", visual->visualid, stereo, draw, read, glGetError());
        bars();
        glXSwapBuffers(display, window);
    }
    return 0;
}
