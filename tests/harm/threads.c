/* Threads that end in the middle of a call, and threads with small stacks.
 *
 *   threads cancel WHEN   a thread is cancelled in its third frame: in its "swap" or in its "draw"
 *   threads exit          a thread ends with pthread_exit in the debug callback of a wrong draw
 *   threads stack KIB     a thread with a stack of this size, which draws in a window of its own
 *   threads main          the same in the main thread, whose stack `ulimit -s` limits
 *
 * After that the main thread draws in another window. Prints what the windows show. */
#define GL_GLEXT_PROTOTYPES
#include "shown.h"
#include <GL/glext.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *when = "";

static void frames(struct window *w, const char *who)
{
    for (int frame = 0; frame < 4; frame++) {
        /* A thread that is cancelled ends at its next cancellation point, of which the driver's calls to the X server have some. */
        if (frame == 2 && !strcmp(when, "draw"))
            pthread_cancel(pthread_self());
        halves(frame);
        if (frame == 2 && !strcmp(when, "exit"))
            glDrawArrays(0x77, 0, 3);
        if (frame == 2 && !strcmp(when, "swap"))
            pthread_cancel(pthread_self());
        glXSwapBuffers(w->display, w->window);
        shown(w, who, frame);
    }
}

static void *thread(void *argument)
{
    struct window *w = argument;
    make_current(w);
    frames(w, "thread");
    glXMakeCurrent(w->display, None, NULL);
    return "ended";
}

static void GLAPIENTRY leave(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length, const GLchar *text, const void *data)
{
    (void)source, (void)type, (void)id, (void)severity, (void)length, (void)text, (void)data;
    pthread_exit("left");
}

static void *reported(void *argument)
{
    struct window *w = argument;
    make_current(w);
    glEnable(GL_DEBUG_OUTPUT);
    glDebugMessageCallback(leave, NULL);
    frames(w, "thread");
    return "ended";
}

static void run(void *(*start)(void *), size_t stack)
{
    struct window w = open_window();
    pthread_attr_t with;
    pthread_t other;
    void *answer = NULL;
    pthread_attr_init(&with);
    if (stack)
        pthread_attr_setstacksize(&with, stack);
    if (pthread_create(&other, &with, start, &w) || pthread_join(other, &answer))
        exit(4);
    printf("the thread was %s\n", answer == PTHREAD_CANCELED ? "cancelled" : (const char *)answer);
    fflush(stdout);
    when = "";
}

int main(int count, char **arguments)
{
    const char *mode = count > 1 ? arguments[1] : "", *what = count > 2 ? arguments[2] : "";
    XInitThreads();
    if (!strcmp(mode, "cancel")) {
        when = what;
        run(thread, 0);
    } else if (!strcmp(mode, "exit")) {
        when = mode;
        run(reported, 0);
    } else if (!strcmp(mode, "stack"))
        run(thread, (size_t)atoi(what) * 1024);
    struct window w = open_window();
    make_current(&w);
    frames(&w, "main");
    /* A thread that was cancelled in the driver may have left its locks held. */
    if (!strcmp(mode, "cancel"))
        _exit(0);
    close_window(&w);
    return 0;
}
