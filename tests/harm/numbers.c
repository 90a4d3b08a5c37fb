/* A program that numbers its buffers, framebuffers, renderbuffers and queries itself, after frames in which the layer has made its own.
 * Prints which exist before, the errors, what the objects hold, and what the window shows. */
#define GL_GLEXT_PROTOTYPES
#include "shown.h"

enum { NAMES = 24, SIDE = 4 };

static void errors(const char *what, GLuint name)
{
    for (GLenum error; (error = glGetError());)
        printf("%s %u: error %x\n", what, name, error);
}

/* The first query of the program, which counts two draws of a frame. */
static void counted(const struct window *w)
{
    GLuint query, samples = 0;
    glGenQueries(1, &query);
    glBeginQuery(GL_SAMPLES_PASSED, query);
    halves(1);
    glRectf(-1, -1, 0, 0);
    glEndQuery(GL_SAMPLES_PASSED);
    glXSwapBuffers(w->display, w->window);
    glGetQueryObjectuiv(query, GL_QUERY_RESULT, &samples);
    printf("query %u: %u\n", query, samples);
}

static void queries(void)
{
    for (GLuint name = 1; name <= NAMES; name++) {
        GLuint result = 0;
        printf("query %u: %d\n", name, glIsQuery(name));
        GLenum target = name % 2 ? GL_SAMPLES_PASSED : GL_ANY_SAMPLES_PASSED;
        if (name == 1)
            target = GL_SAMPLES_PASSED; /* it was one */
        glBeginQuery(target, name);
        glRectf(-0.1f * (float)(name % 10), -1, 0, 1);
        glEndQuery(target);
        glGetQueryObjectuiv(name, GL_QUERY_RESULT, &result);
        printf("query %u: %u\n", name, result);
        errors("query", name);
    }
}

static void framebuffers(void)
{
    for (GLuint name = 1; name <= NAMES; name++) {
        unsigned char pixel[4] = {0};
        printf("framebuffer %u: %d, renderbuffer %d\n", name, glIsFramebuffer(name), glIsRenderbuffer(name));
        glBindFramebufferEXT(GL_FRAMEBUFFER, name);
        glBindRenderbufferEXT(GL_RENDERBUFFER, name);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, SIDE, SIDE);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, name);
        glViewport(0, 0, SIDE, SIDE);
        glClearColor(0, 0, (float)name / NAMES, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        glRectf(-1, -1, 0, 1);
        glReadPixels(SIDE - 1, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
        printf("framebuffer %u: %x, %d %d %d\n", name, glCheckFramebufferStatus(GL_FRAMEBUFFER), pixel[0], pixel[1], pixel[2]);
        glBindFramebufferEXT(GL_FRAMEBUFFER, 0);
        glViewport(0, 0, WIDTH, HEIGHT);
        errors("framebuffer", name);
    }
    glClearColor(0, 0, 0, 1);
}

static void buffers(void)
{
    for (GLuint name = 1; name <= NAMES; name++) {
        GLfloat corners[8] = {-1, -1, 0, -1, 0, 1, -1, 1}, first = 0;
        corners[0] = -(float)name / NAMES;
        printf("buffer %u: %d\n", name, glIsBuffer(name));
        glBindBuffer(GL_ARRAY_BUFFER, name);
        glBufferData(GL_ARRAY_BUFFER, sizeof corners, corners, GL_STATIC_DRAW);
        glEnableClientState(GL_VERTEX_ARRAY);
        glVertexPointer(2, GL_FLOAT, 0, NULL);
        glDrawArrays(GL_QUADS, 0, 4);
        glDisableClientState(GL_VERTEX_ARRAY);
        glGetBufferSubData(GL_ARRAY_BUFFER, 0, sizeof first, &first);
        printf("buffer %u: %g\n", name, first);
        glBindBuffer(GL_ARRAY_BUFFER, 0);
        errors("buffer", name);
    }
}

int main(void)
{
    struct window w = open_window();
    make_current(&w);
    for (int i = 0; i < 3; i++) {
        halves(i);
        glXSwapBuffers(w.display, w.window);
    }
    counted(&w);
    void (*const kinds[3])(void) = {queries, framebuffers, buffers};
    for (int i = 0; i < 3; i++) {
        glClear(GL_COLOR_BUFFER_BIT);
        kinds[i]();
        glXSwapBuffers(w.display, w.window);
        shown(&w, "frame", i);
        /* The layer goes on. */
        halves(i);
        glXSwapBuffers(w.display, w.window);
        shown(&w, "after", i);
    }
    return 0;
}
