/* Preloaded behind the layer: a driver that has no memory for large array textures, nor for their samples.
 *   REFUSE_TEXELS  the most texels that an array texture may have
 *   REFUSE_NEXT    how many array textures after such a one are refused as well
 *   REFUSE_FROM    the number of the first array texture that is refused, counted from 1, whatever its size
 *   REFUSE_ONE     the number of the only array texture that is refused */
#define _GNU_SOURCE
#include <GL/gl.h>
#include <dlfcn.h>
#include <stdlib.h>

static __thread GLenum error;

static void *next(const char *name)
{
    return dlsym(RTLD_NEXT, name);
}

static long limit(const char *name)
{
    const char *value = getenv(name);
    return value ? atol(value) : 0;
}

static int refuses(GLsizei width, GLsizei height, GLsizei depth)
{
    static long made, next_ones;
    long texels = limit("REFUSE_TEXELS"), from = limit("REFUSE_FROM"), one = limit("REFUSE_ONE");
    int large = texels && (long)width * height * depth > texels, after = !large && next_ones > 0;
    made++;
    next_ones = large ? limit("REFUSE_NEXT") : next_ones - after;
    if (!large && !after && !(from && made >= from) && made != one)
        return 0;
    error = GL_OUT_OF_MEMORY;
    return 1;
}

void glTexImage3D(GLenum target, GLint level, GLint internal, GLsizei width, GLsizei height, GLsizei depth, GLint border, GLenum format,
                  GLenum type, const void *data)
{
    if (!refuses(width, height, depth))
        ((PFNGLTEXIMAGE3DPROC)next("glTexImage3D"))(target, level, internal, width, height, depth, border, format, type, data);
}

void glTexImage3DMultisample(GLenum target, GLsizei samples, GLenum internal, GLsizei width, GLsizei height, GLsizei depth, GLboolean fixed)
{
    if (!refuses(width, height, depth))
        ((PFNGLTEXIMAGE3DMULTISAMPLEPROC)next("glTexImage3DMultisample"))(target, samples, internal, width, height, depth, fixed);
}

GLenum glGetError(void)
{
    GLenum pending = error;
    error = GL_NO_ERROR;
    return pending ? pending : ((GLenum(*)(void))next("glGetError"))();
}
