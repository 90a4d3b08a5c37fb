/* Asks for each window system's functions in turn, like a loader that detects which one it runs under. Status 0 when it gets those of the
 * libraries that are loaded and no others. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>

static int wrong;

static void want(void *handle, const char *name, int there)
{
    if (!dlsym(handle, name) == !there)
        return;
    fprintf(stderr, "%s is %sthere\n", name, there ? "not " : "");
    wrong = 1;
}

int main(void)
{
    void *gl = dlopen("libGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!gl)
        return 77;
    want(gl, "glXGetProcAddressARB", 1);
    want(RTLD_DEFAULT, "eglGetProcAddress", 0);
    want(RTLD_DEFAULT, "OSMesaGetProcAddress", 0);
    void *egl = dlopen("libEGL.so.1", RTLD_NOW | RTLD_GLOBAL);
    if (!egl)
        return 77;
    want(egl, "eglGetProcAddress", 1);
    want(RTLD_DEFAULT, "eglGetProcAddress", 1);
    want(RTLD_DEFAULT, "OSMesaGetProcAddress", 0);
    return wrong;
}
