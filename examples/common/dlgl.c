#define DLGL_IMPLEMENTATION
#include "dlgl.h"
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DLGL_DEFINE(name) __typeof__(name) *dl_##name;
DLGL_FUNCTIONS(DLGL_DEFINE)

static void *library;
static int count;

static void *find(const char *name)
{
    void *f = NULL;
    if (count++ % 2 && strncmp(name, "glX", 3))
        f = (void *)dl_glXGetProcAddressARB((const GLubyte *)name);
    else
        f = dlsym(library, name);
    if (!f) {
        fprintf(stderr, "dlopen_gears: libGL.so.1 has no %s\n", name);
        exit(1);
    }
    return f;
}

void dlgl_load(void)
{
    library = dlopen("libGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        fprintf(stderr, "dlopen_gears: %s\n", dlerror());
        exit(1);
    }
    dl_glXGetProcAddressARB = (__typeof__(dl_glXGetProcAddressARB))dlsym(library, "glXGetProcAddressARB");
#define DLGL_FILL(name) dl_##name = (__typeof__(dl_##name))find(#name);
    DLGL_FUNCTIONS(DLGL_FILL)
}
