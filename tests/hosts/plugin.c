/* A library that is opened at run time and linked with libGL: it draws in its host's context, or in one of its own. */
#include "scene.h"
#include "window.h"

void plugin_draw(int frame) { scene("plugin", frame, WIDTH, HEIGHT); }

void plugin_all(void)
{
    struct window w = open_window();
    make_current(&w);
    for (int frame = 0; frame < FRAMES; frame++) {
        scene("plugin", frame, WIDTH, HEIGHT);
        glXSwapBuffers(w.display, w.window);
    }
    close_window(&w);
}
