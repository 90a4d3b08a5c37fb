/* Preloaded behind the layer: a driver that is out of memory once, or from some call on.
 *   FAIL_AT    the number of the call that fails, counted from 1 over all commands below
 *   FAIL_FROM  all calls from this number on fail
 *   FAIL_OUT   a file that gets the name of the command that has failed first
 *   LOST_AT    the context is lost at this swap of buffers: from then on all of them fail, and glGetError says so for ever */
#define _GNU_SOURCE
#include <GL/gl.h>
#include <GL/glext.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

static __thread GLenum error;
static int lost;

static void *next(const char *name)
{
    void *found = dlsym(RTLD_NEXT, name);
    if (!found)
        found = ((void *(*)(const char *))dlsym(RTLD_NEXT, "glXGetProcAddressARB"))(name);
    return found;
}

static int fails(const char *name)
{
    static long calls, failed;
    const char *at = getenv("FAIL_AT"), *from = getenv("FAIL_FROM");
    calls++;
    if (lost)
        return 1;
    if (!(at && calls == atol(at)) && !(from && calls >= atol(from)))
        return 0;
    if (!failed++) {
        FILE *out = fopen(getenv("FAIL_OUT"), "w");
        if (out) {
            fputs(name, out);
            fclose(out);
        }
    }
    error = GL_OUT_OF_MEMORY;
    return 1;
}

#define NAMES(command) \
    void command(GLsizei count, GLuint *names) \
    { \
        if (!fails(#command)) { \
            ((void (*)(GLsizei, GLuint *))next(#command))(count, names); \
            return; \
        } \
        for (int i = 0; i < count; i++) \
            names[i] = 0; \
    }
NAMES(glGenTextures) NAMES(glGenFramebuffers) NAMES(glGenBuffers) NAMES(glGenVertexArrays) NAMES(glGenQueries) NAMES(glGenRenderbuffers)

GLuint glCreateShader(GLenum kind)
{
    return fails("glCreateShader") ? 0 : ((PFNGLCREATESHADERPROC)next("glCreateShader"))(kind);
}

GLuint glCreateProgram(void)
{
    return fails("glCreateProgram") ? 0 : ((PFNGLCREATEPROGRAMPROC)next("glCreateProgram"))();
}

GLsync glFenceSync(GLenum condition, GLbitfield flags)
{
    return fails("glFenceSync") ? 0 : ((PFNGLFENCESYNCPROC)next("glFenceSync"))(condition, flags);
}

void glTexImage2D(GLenum target, GLint level, GLint internal, GLsizei width, GLsizei height, GLint border, GLenum format, GLenum type,
                  const void *data)
{
    if (!fails("glTexImage2D"))
        ((void (*)(GLenum, GLint, GLint, GLsizei, GLsizei, GLint, GLenum, GLenum, const void *))next("glTexImage2D"))(
            target, level, internal, width, height, border, format, type, data);
}

void glTexImage3D(GLenum target, GLint level, GLint internal, GLsizei width, GLsizei height, GLsizei depth, GLint border, GLenum format,
                  GLenum type, const void *data)
{
    if (!fails("glTexImage3D"))
        ((PFNGLTEXIMAGE3DPROC)next("glTexImage3D"))(target, level, internal, width, height, depth, border, format, type, data);
}

void glBufferData(GLenum target, GLsizeiptr size, const void *data, GLenum usage)
{
    if (!fails("glBufferData"))
        ((PFNGLBUFFERDATAPROC)next("glBufferData"))(target, size, data, usage);
}

void glRenderbufferStorage(GLenum target, GLenum format, GLsizei width, GLsizei height)
{
    if (!fails("glRenderbufferStorage"))
        ((PFNGLRENDERBUFFERSTORAGEPROC)next("glRenderbufferStorage"))(target, format, width, height);
}

GLenum glCheckFramebufferStatus(GLenum target)
{
    if (!fails("glCheckFramebufferStatus"))
        return ((PFNGLCHECKFRAMEBUFFERSTATUSPROC)next("glCheckFramebufferStatus"))(target);
    return GL_FRAMEBUFFER_UNSUPPORTED;
}

void glXSwapBuffers(void *display, unsigned long drawable)
{
    static int swaps;
    const char *at = getenv("LOST_AT");
    ((void (*)(void *, unsigned long))next("glXSwapBuffers"))(display, drawable);
    lost |= at && ++swaps == atoi(at);
}

GLenum glGetGraphicsResetStatus(void)
{
    return lost ? GL_UNKNOWN_CONTEXT_RESET : GL_NO_ERROR;
}

GLenum glGetError(void)
{
    if (lost)
        return GL_CONTEXT_LOST;
    GLenum pending = error;
    error = GL_NO_ERROR;
    return pending ? pending : ((GLenum(*)(void))next("glGetError"))();
}
