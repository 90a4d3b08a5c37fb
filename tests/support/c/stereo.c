/* Stands in for a driver with stereo windows, which no driver for Xvfb has. Preloaded after the layer, it answers the layer's calls and not
 * the program's: a window that is asked for with GLX_STEREO has a right buffer too, a framebuffer object of the size in scene.h. Before the
 * swap STEREO_FRAME (counted from 1) of such a window both buffers are written to STEREO_LEFT and STEREO_RIGHT, as binary PPM; the left one
 * twice where nothing was drawn to the right one.
 *
 * It removes GLX_STEREO from attribute lists, since the true driver would find no config. */
#define _GNU_SOURCE
#define GL_GLEXT_PROTOTYPES
#include "scene.h"
#include <GL/glext.h>
#include <GL/glx.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

/* Uses the C library's own dlsym: the layer hooks dlsym in the process, but not dlvsym. */
static void *next(const char *name)
{
    static void *(*look)(void *, const char *);
    if (!look)
        look = (void *(*)(void *, const char *))dlvsym(RTLD_NEXT, "dlsym", sizeof(void *) == 4 ? "GLIBC_2.0" : "GLIBC_2.2.5");
    return look(RTLD_NEXT, name);
}

#define NEXT(name) ((__typeof__(&name))next(#name))

static int stereo, frame, in_right;
static GLuint right, colour;

enum { MOST = 64 };

static const int *without(const int *list, int all_have_values)
{
    static int kept[MOST];
    int n = 0;
    stereo = 0;
    while (list && *list && n < MOST - 3) {
        int name = *list++, flag = !all_have_values && (name == GLX_USE_GL || (name >= GLX_RGBA && name <= GLX_STEREO));
        if (name == GLX_STEREO) {
            stereo = flag || *list == True;
        } else {
            kept[n++] = name;
            if (!flag)
                kept[n++] = *list;
        }
        list += !flag;
    }
    kept[n] = None;
    return kept;
}

XVisualInfo *glXChooseVisual(Display *d, int screen, int *list)
{
    return NEXT(glXChooseVisual)(d, screen, (int *)without(list, 0));
}

GLXFBConfig *glXChooseFBConfig(Display *d, int screen, const int *list, int *count)
{
    return NEXT(glXChooseFBConfig)(d, screen, without(list, 1), count);
}

GLXFBConfig *glXChooseFBConfigSGIX(Display *d, int screen, int *list, int *count)
{
    return NEXT(glXChooseFBConfig)(d, screen, without(list, 1), count);
}

void glGetIntegerv(GLenum name, GLint *value)
{
    GLint bound = 0;
    NEXT(glGetIntegerv)(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    NEXT(glGetIntegerv)(name, value);
    if (name == GL_STEREO)
        *value = stereo && (!bound || bound == (GLint)right);
}

/* The draw buffer is state of framebuffer 0, which keeps it while others are bound. */
void glBindFramebuffer(GLenum target, GLuint name)
{
    NEXT(glBindFramebuffer)(target, name);
    if (in_right && !name && target != GL_READ_FRAMEBUFFER)
        NEXT(glBindFramebuffer)(GL_DRAW_FRAMEBUFFER, right);
}

void glDrawBuffer(GLenum buffer)
{
    GLint bound = 0, two = 0;
    NEXT(glGetIntegerv)(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    if (in_right && bound == (GLint)right) {
        NEXT(glBindFramebuffer)(GL_DRAW_FRAMEBUFFER, 0);
        bound = in_right = 0;
    }
    NEXT(glGetIntegerv)(GL_DOUBLEBUFFER, &two);
    if (!stereo || bound || buffer != (two ? GL_BACK_RIGHT : GL_FRONT_RIGHT)) {
        NEXT(glDrawBuffer)(buffer);
        return;
    }
    if (!right) {
        NEXT(glGenFramebuffers)(1, &right);
        NEXT(glGenRenderbuffers)(1, &colour);
        NEXT(glBindRenderbuffer)(GL_RENDERBUFFER, colour);
        NEXT(glRenderbufferStorage)(GL_RENDERBUFFER, GL_RGBA8, WIDTH, HEIGHT);
        NEXT(glBindRenderbuffer)(GL_RENDERBUFFER, 0);
    }
    NEXT(glBindFramebuffer)(GL_DRAW_FRAMEBUFFER, right);
    NEXT(glFramebufferRenderbuffer)(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour);
    in_right = 1;
}

static void dump(const char *path, GLuint framebuffer)
{
    static unsigned char pixels[HEIGHT][WIDTH][4];
    FILE *out = path ? fopen(path, "wb") : NULL;
    if (!out)
        abort();
    NEXT(glBindFramebuffer)(GL_READ_FRAMEBUFFER, framebuffer);
    NEXT(glReadPixels)(0, 0, WIDTH, HEIGHT, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    fprintf(out, "P6\n%d %d\n255\n", WIDTH, HEIGHT);
    for (int y = HEIGHT - 1; y >= 0; y--)
        for (int x = 0; x < WIDTH; x++)
            fwrite(pixels[y][x], 1, 3, out);
    fclose(out);
}

void glXSwapBuffers(Display *d, GLXDrawable drawable)
{
    const char *wanted = getenv("STEREO_FRAME");
    if (stereo && wanted && ++frame == atoi(wanted)) {
        GLint bound = 0;
        NEXT(glGetIntegerv)(GL_READ_FRAMEBUFFER_BINDING, &bound);
        dump(getenv("STEREO_LEFT"), 0);
        dump(getenv("STEREO_RIGHT"), right);
        NEXT(glBindFramebuffer)(GL_READ_FRAMEBUFFER, (GLuint)bound);
    }
    NEXT(glXSwapBuffers)(d, drawable);
}
