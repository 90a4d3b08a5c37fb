/* Threads that draw at the same time, each in a window and a context of its own. The contexts share their objects.
 *
 *   together THREADS FRAMES
 *
 * Each thread calls lists that all share and those that it makes itself, makes and deletes textures, buffers and queries, and swaps. Prints what
 * each thread reads back in each frame. */
#define GL_GLEXT_PROTOTYPES
#include "shown.h"
#include <GL/glext.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 8 };

struct worker {
    struct window at;
    int number, frames;
    char *text;
    size_t length;
};

static GLuint common;

static void texture(int number, int frame)
{
    unsigned char texels[4 * 4 * 3];
    GLuint name;
    memset(texels, 40 * number + frame, sizeof texels);
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 4, 4, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
    if (frame % 3 == 0)
        glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 0, 0, 4, 4, 0);
    glEnable(GL_TEXTURE_2D);
    glRectf(-0.25f, -1.0f, 0.25f, 1.0f);
    glDisable(GL_TEXTURE_2D);
    glDeleteTextures(1, &name);
}

static GLuint buffer(int frame)
{
    const GLfloat places[6] = {-1, -1, -0.5f, -1, -1, (float)(frame % 4) / 4};
    GLuint name, query, samples = 0;
    glGenBuffers(1, &name);
    glBindBuffer(GL_ARRAY_BUFFER, name);
    glBufferData(GL_ARRAY_BUFFER, sizeof places, places, GL_STREAM_DRAW);
    glVertexPointer(2, GL_FLOAT, 0, NULL);
    glEnableClientState(GL_VERTEX_ARRAY);
    glGenQueries(1, &query);
    glBeginQuery(GL_SAMPLES_PASSED, query);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEndQuery(GL_SAMPLES_PASSED);
    glGetQueryObjectuiv(query, GL_QUERY_RESULT, &samples);
    glDeleteQueries(1, &query);
    glDisableClientState(GL_VERTEX_ARRAY);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glDeleteBuffers(1, &name);
    return samples;
}

static void *run(void *argument)
{
    struct worker *w = argument;
    FILE *out = open_memstream(&w->text, &w->length);
    make_current(&w->at);
    for (int frame = 0; frame < w->frames; frame++) {
        unsigned char pixels[3][3];
        GLuint own = glGenLists(2);
        halves(frame);
        glNewList(own, frame % 2 ? GL_COMPILE : GL_COMPILE_AND_EXECUTE);
        glColor3f(0, (float)w->number / MOST, 1);
        glRectf(0.5f, -0.5f, 0.75f, 0.5f);
        glCallList(common);
        glEndList();
        glCallList(own);
        texture(w->number, frame);
        GLuint samples = buffer(frame);
        for (int i = 0; i < 3; i++)
            glReadPixels(WIDTH * (1 + 2 * i) / 6, HEIGHT / 2, 1, 1, GL_RGB, GL_UNSIGNED_BYTE, pixels[i]);
        glDeleteLists(own, 2);
        glXSwapBuffers(w->at.display, w->at.window);
        fprintf(out, "thread %d, frame %d: %u samples", w->number, frame, samples);
        for (int i = 0; i < 3; i++)
            fprintf(out, ", %d %d %d", pixels[i][0], pixels[i][1], pixels[i][2]);
        fprintf(out, ", error 0x%x\n", glGetError());
    }
    glXMakeCurrent(w->at.display, None, NULL);
    fclose(out);
    return NULL;
}

/* A window like another one, on the same connection, whose context shares objects with that one's. */
static struct window beside(const struct window *first)
{
    int want[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 16, None};
    XVisualInfo *visual = glXChooseVisual(first->display, DefaultScreen(first->display), want);
    Window root = DefaultRootWindow(first->display);
    XSetWindowAttributes with = {.colormap = XCreateColormap(first->display, root, visual->visual, AllocNone)};
    struct window w = {.display = first->display};
    w.window = XCreateWindow(w.display, root, 0, 0, WIDTH, HEIGHT, 0, visual->depth, InputOutput, visual->visual, CWColormap, &with);
    XMapWindow(w.display, w.window);
    w.context = glXCreateContext(w.display, visual, first->context, True);
    XSync(w.display, False);
    return w;
}

int main(int count, char **arguments)
{
    static struct worker workers[MOST];
    pthread_t threads[MOST];
    int all = count > 1 ? atoi(arguments[1]) : 0, frames = count > 2 ? atoi(arguments[2]) : 0;
    XInitThreads();
    struct window first = open_window();
    if (all < 1 || all > MOST)
        return 2;
    make_current(&first);
    common = glGenLists(1);
    glNewList(common, GL_COMPILE);
    glColor3f(0.5f, 0.5f, 0);
    glRectf(0.8f, -1, 0.9f, 1);
    glEndList();
    glXMakeCurrent(first.display, None, NULL);
    for (int i = 0; i < all; i++)
        workers[i] = (struct worker){.at = beside(&first), .number = i, .frames = frames};
    for (int i = 0; i < all; i++)
        if (pthread_create(&threads[i], NULL, run, &workers[i]))
            return 4;
    for (int i = 0; i < all; i++) {
        pthread_join(threads[i], NULL);
        fputs(workers[i].text, stdout);
    }
    make_current(&first);
    halves(0);
    glXSwapBuffers(first.display, first.window);
    shown(&first, "main", 0);
    return 0;
}
