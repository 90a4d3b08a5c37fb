/* A plugin that is bound to its own libraries draws by the GL utility library, which is no part of OpenGL although its name begins alike.
 *
 *   deep PLUGIN   opens the plugin, which is this file compiled with -DPLUGIN
 *
 * Prints what the window shows. */
#ifdef PLUGIN
#include <GL/glu.h>

void plugin_draw(int frame)
{
    GLUquadric *quadric = gluNewQuadric();
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-0.5, 0.5, -0.5, 0.5, 1, 10);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslatef(frame % 2 ? 1 : -1, 0, -4);
    glClear(GL_COLOR_BUFFER_BIT);
    glColor3f(1, 1, 0);
    gluSphere(quadric, 0.8, 8, 8);
    gluDeleteQuadric(quadric);
}
#else
#define _GNU_SOURCE
#include "shown.h"
#include <dlfcn.h>

int main(int count, char **arguments)
{
    void *library = count > 1 ? dlopen(arguments[1], RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND) : NULL;
    void (*draw)(int) = library ? (void (*)(int))dlsym(library, "plugin_draw") : NULL;
    if (!draw)
        return 2;
    struct window w = open_window();
    make_current(&w);
    for (int frame = 0; frame < 4; frame++) {
        draw(frame);
        glXSwapBuffers(w.display, w.window);
        shown(&w, "frame", frame);
    }
    close_window(&w);
    return 0;
}
#endif
