/* Preloaded behind the layer, or alone: counts the calls that make a driver on a thread of its own catch up, and round trips to the X server.
 *   COUNT_FROM, COUNT_TO  numbers of swaps, counted from 1: calls between these two are counted
 *   COUNT_OUT             a file that gets a line for each command that was called: its name and the number of calls
 * All of these take whole numbers and pointers alone, at most eight, and answer one or nothing, so one signature serves them. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

#define COMMANDS(X) \
    X(glGetIntegerv) X(glGetFloatv) X(glGetDoublev) X(glGetBooleanv) X(glGetInteger64v) X(glGetIntegeri_v) X(glGetFloati_v) \
    X(glIsEnabled) X(glIsEnabledi) X(glGetError) X(glGetString) X(glGetStringi) X(glGetMaterialfv) X(glGetLightfv) \
    X(glGetTexGeniv) X(glGetTexGenfv) X(glGetTexEnviv) X(glGetTexEnvfv) X(glGetTexParameteriv) X(glGetTexParameterfv) \
    X(glGetTexLevelParameteriv) X(glGetTextureParameteriv) X(glGetUniformfv) X(glGetUniformiv) X(glGetUniformuiv) X(glGetUniformdv) \
    X(glGetProgramiv) X(glGetActiveUniformBlockiv) X(glGetActiveUniformsiv) X(glGetActiveUniform) X(glGetActiveAttrib) \
    X(glGetUniformLocation) X(glGetUniformBlockIndex) X(glGetProgramInterfaceiv) X(glGetAttachedShaders) X(glGetShaderiv) \
    X(glGetVertexAttribiv) X(glGetVertexAttribfv) X(glGetVertexAttribPointerv) X(glGetPointerv) X(glGetBufferSubData) \
    X(glGetBufferParameteriv) X(glGetRenderbufferParameteriv) X(glGetFramebufferAttachmentParameteriv) X(glCheckFramebufferStatus) \
    X(glReadPixels) X(glGetTexImage) X(glFinish) X(glClientWaitSync) X(glIsList) X(glIsTexture) X(glIsFramebuffer) X(glIsProgram) \
    X(glGetQueryiv) X(glGetQueryObjectiv) X(glGetQueryObjectuiv) X(xcb_wait_for_reply) X(xcb_wait_for_reply64)

#define NUMBER(name) n_##name,
enum { COMMANDS(NUMBER) LAST };
static const char *const names[] = {
#define NAME(name) #name,
    COMMANDS(NAME)
};
static long counts[LAST];

typedef long (*any)(long, long, long, long, long, long, long, long);

static any next(const char *name)
{
    return (any)dlsym(RTLD_NEXT, name);
}

#define COUNTED(name) \
    long name(long a, long b, long c, long d, long e, long f, long g, long h) \
    { \
        static any real; \
        counts[n_##name]++; \
        if (!real) \
            real = next(#name); \
        if (!real) \
            real = ((any (*)(const char *))dlsym(RTLD_NEXT, "glXGetProcAddressARB"))(#name); \
        return real(a, b, c, d, e, f, g, h); \
    }
COMMANDS(COUNTED)

static void write_counts(const long *before)
{
    FILE *out = fopen(getenv("COUNT_OUT"), "w");
    if (!out)
        return;
    for (int i = 0; i < LAST; i++)
        if (counts[i] > before[i])
            fprintf(out, "%s %ld\n", names[i], counts[i] - before[i]);
    fclose(out);
}

static void swapped(void)
{
    static long swaps, before[LAST];
    const char *from = getenv("COUNT_FROM"), *to = getenv("COUNT_TO");
    swaps++;
    if (from && swaps == atol(from))
        for (int i = 0; i < LAST; i++)
            before[i] = counts[i];
    if (to && swaps == atol(to))
        write_counts(before);
}

void glXSwapBuffers(void *display, unsigned long drawable)
{
    next("glXSwapBuffers")((long)display, (long)drawable, 0, 0, 0, 0, 0, 0);
    swapped();
}

unsigned eglSwapBuffers(void *display, void *surface)
{
    long done = next("eglSwapBuffers")((long)display, (long)surface, 0, 0, 0, 0, 0, 0);
    swapped();
    return (unsigned)done;
}
