/* The program leaves its debug callback by other ways than a return, while the driver is at work for it.
 *
 *   throws throw CALL   a C++ exception, which the program catches around its call
 *   throws jump CALL    longjmp
 *
 * CALL is a wrong call that the driver reports; see `calls`. Prints what was caught, and what the window shows before and after it. */
#define GL_GLEXT_PROTOTYPES
extern "C" {
#include "shown.h"
}
#include <GL/glext.h>
#include <csetjmp>
#include <cstring>
#include <stdexcept>

struct call {
    const char *name;
    void (*make)();
};

static unsigned char bytes[64];

/* Drawing, clearing and reading, commands with special hooks, and others. */
static const call calls[] = {
    {"draw", [] { glDrawArrays(0x77, 0, 3); }},
    {"elements", [] { glDrawElements(0x77, 3, GL_UNSIGNED_BYTE, bytes); }},
    {"clear", [] { glClear(0x1); }},
    {"pixels", [] { glDrawPixels(1, 1, 0x77, GL_UNSIGNED_BYTE, bytes); }},
    {"read", [] { glReadPixels(0, 0, 1, 1, 0x77, GL_UNSIGNED_BYTE, bytes); }},
    {"blit", [] { glBlitFramebuffer(0, 0, 1, 1, 0, 0, 1, 1, 0x77, GL_NEAREST); }},
    {"state", [] { glMatrixMode(0x77); }},
    {"bind", [] { glBindFramebuffer(0x77, 0); }},
    {"buffer", [] { glDrawBuffer(0x77); }},
    {"link", [] { glLinkProgram(777); }},
    {"query", [] { glBeginQuery(0x77, 1); }},
    {"begin", [] { glBegin(0x77); }},
    {"list", [] { glNewList(1, 0x77); }},
    {"message", [] { glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_MARKER, 1, GL_DEBUG_SEVERITY_HIGH, -1, "here"); }},
};

static jmp_buf before;
static bool leaves, jumps;

static void report(GLenum, GLenum, GLuint, GLenum, GLsizei, const GLchar *, const void *)
{
    if (!leaves)
        return;
    leaves = false;
    if (jumps)
        longjmp(before, 1);
    throw std::runtime_error("reported");
}

static void leave(void (*make)())
{
    leaves = true;
    if (jumps) {
        if (!setjmp(before))
            make();
        else
            printf("jumped\n");
    } else {
        try {
            make();
        } catch (const std::exception &error) {
            printf("caught: %s\n", error.what());
        }
    }
    if (leaves)
        printf("nothing was reported\n");
    leaves = false;
    /* Mesa records the error when the callback has returned. A callback that does not return under the layer has returned to the driver. */
    while (glGetError() != GL_NO_ERROR)
        ;
}

int main(int count, char **arguments)
{
    if (count < 3)
        return 1;
    jumps = !strcmp(arguments[1], "jump");
    struct window w = open_window();
    make_current(&w);
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(report, nullptr);
    for (int frame = 0; frame < 4; frame++) {
        halves(frame);
        for (const call &c : calls)
            if (frame == 1 && !strcmp(c.name, arguments[2]))
                leave(c.make);
        printf("error %x\n", glGetError());
        glXSwapBuffers(w.display, w.window);
        shown(&w, "frame", frame);
    }
    close_window(&w);
    return 0;
}
