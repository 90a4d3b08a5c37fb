/* Ways in which programs load OpenGL and use its contexts:
 *
 *   host draws PLUGIN HOW   the host makes the context, the plugin draws
 *   host all PLUGIN HOW     the plugin does everything
 *   host threads            one context, made current by two threads in turn
 *   host windows            two windows with a context each, in turn
 *   host both               a GLX window and an EGL pbuffer, in turn
 *   host moved              another thread moves the window and resizes it between frames, on a connection of its own
 *
 * HOW: "local" for RTLD_LOCAL, "deep" for RTLD_DEEPBIND too, "lazy" for that and RTLD_LAZY.
 *
 * Prints a hash of each frame that is read back. */
#include "scene.h"
#include "window.h"
#include <EGL/egl.h>
#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void *plugin(char **arguments, const char *name)
{
    int local = !strcmp(arguments[1], "local"), lazy = !strcmp(arguments[1], "lazy");
    void *library = dlopen(arguments[0], RTLD_LOCAL | (lazy ? RTLD_LAZY : RTLD_NOW) | (local ? 0 : RTLD_DEEPBIND));
    void *symbol = library ? dlsym(library, name) : NULL;
    if (!symbol) {
        fprintf(stderr, "%s\n", dlerror());
        exit(2);
    }
    return symbol;
}

static void draws(char **arguments)
{
    void (*draw)(int) = (void (*)(int))plugin(arguments, "plugin_draw");
    struct window w = open_window();
    make_current(&w);
    for (int frame = 0; frame < FRAMES; frame++) {
        draw(frame);
        glXSwapBuffers(w.display, w.window);
    }
    close_window(&w);
}

struct turn {
    struct window *w;
    int first;
};

static void *take_turn(void *argument)
{
    struct turn *t = argument;
    make_current(t->w);
    scene("thread", t->first, WIDTH, HEIGHT);
    glXSwapBuffers(t->w->display, t->w->window);
    glXMakeCurrent(t->w->display, None, NULL);
    return NULL;
}

static void threads(void)
{
    struct window w = open_window();
    for (int frame = 0; frame < FRAMES; frame++) {
        struct turn t = {&w, frame};
        pthread_t other;
        if (frame % 2 == 0) {
            take_turn(&t);
        } else {
            pthread_create(&other, NULL, take_turn, &t);
            pthread_join(other, NULL);
        }
    }
    close_window(&w);
}

static void windows(void)
{
    struct window w[2] = {open_window(), open_window()};
    XMoveWindow(w[1].display, w[1].window, 2 * WIDTH, 0);
    XSync(w[1].display, False);
    for (int frame = 0; frame < 2 * FRAMES; frame++) {
        struct window *now = &w[frame % 2];
        make_current(now);
        scene(frame % 2 ? "second" : "first", frame, WIDTH, HEIGHT);
        glXSwapBuffers(now->display, now->window);
    }
    close_window(&w[0]);
    close_window(&w[1]);
}

static void both(void)
{
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_DEPTH_SIZE, 16, EGL_NONE};
    const EGLint size[] = {EGL_WIDTH, WIDTH, EGL_HEIGHT, HEIGHT, EGL_NONE};
    struct window w = open_window();
    EGLDisplay d = eglGetDisplay((EGLNativeDisplayType)w.display);
    EGLConfig config;
    EGLint count;
    if (!eglInitialize(d, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API) || !eglChooseConfig(d, wanted, &config, 1, &count) || !count)
        exit(2);
    EGLSurface surface = eglCreatePbufferSurface(d, config, size);
    EGLContext context = eglCreateContext(d, config, EGL_NO_CONTEXT, NULL);
    for (int frame = 0; frame < FRAMES; frame++) {
        make_current(&w);
        scene("glx", frame, WIDTH, HEIGHT);
        glXSwapBuffers(w.display, w.window);
        glXMakeCurrent(w.display, None, NULL);
        eglMakeCurrent(d, surface, surface, context);
        scene("egl", frame, WIDTH, HEIGHT);
        eglSwapBuffers(d, surface);
        eglMakeCurrent(d, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    eglDestroyContext(d, context);
    eglTerminate(d);
    close_window(&w);
}

static int frame_now;

static void *move(void *window)
{
    Display *display = XOpenDisplay(NULL);
    XMoveResizeWindow(display, *(Window *)window, 10 * frame_now, 5, WIDTH - 16u * (unsigned)frame_now, HEIGHT - 8u * (unsigned)frame_now);
    XSync(display, False);
    XCloseDisplay(display);
    return NULL;
}

static void moved(void)
{
    struct window w = open_window();
    make_current(&w);
    for (frame_now = 0; frame_now < FRAMES; frame_now++) {
        pthread_t other;
        pthread_create(&other, NULL, move, &w.window);
        pthread_join(other, NULL);
        /* Drivers apply the new size with the next frame. */
        glClear(GL_COLOR_BUFFER_BIT);
        glXSwapBuffers(w.display, w.window);
        scene("moved", frame_now, WIDTH - 16 * frame_now, HEIGHT - 8 * frame_now);
        glXSwapBuffers(w.display, w.window);
    }
    close_window(&w);
}

int main(int argc, char **argv)
{
    const char *what = argc > 1 ? argv[1] : "";
    XInitThreads();
    if (!strcmp(what, "draws"))
        draws(argv + 2);
    else if (!strcmp(what, "all"))
        ((void (*)(void))plugin(argv + 2, "plugin_all"))();
    else if (!strcmp(what, "threads"))
        threads();
    else if (!strcmp(what, "windows"))
        windows();
    else if (!strcmp(what, "both"))
        both();
    else if (!strcmp(what, "moved"))
        moved();
    else
        return 2;
    return 0;
}
