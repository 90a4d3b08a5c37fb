/* A libEGL.so and a libGLESv2.so of a program's own, as ANGLE in browsers: they have the file names of the system's, but not its objects.
 * The display is of one pixel, in the library's own memory. With private_over the library draws by the system's EGL, as ANGLE does too.
 *
 * EGL is defined for libEGL.so, which needs the other one. */
#include <dlfcn.h>
#include <string.h>

typedef void *Handle;
typedef void (*Function)(void);
typedef void (*Read)(int, int, int, int, unsigned, unsigned, void *);

#ifndef EGL
/* The pixel, as floats of 0 to 1. */
static float colour[4], held[4];
static int over;

static Function system_function(const char *name)
{
    Handle library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    Function (*find)(const char *) = library ? (Function(*)(const char *))dlsym(library, "eglGetProcAddress") : NULL;
    return find ? find(name) : NULL;
}

void private_over(int on)
{
    over = on;
}

void glClearColor(float red, float green, float blue, float alpha)
{
    if (over) {
        ((void (*)(float, float, float, float))system_function("glClearColor"))(red, green, blue, alpha);
        return;
    }
    colour[0] = red, colour[1] = green, colour[2] = blue, colour[3] = alpha;
}

void glClear(unsigned mask)
{
    if (over)
        ((void (*)(unsigned))system_function("glClear"))(mask);
    else if (mask & 0x4000)
        memcpy(held, colour, sizeof held);
}

void glReadPixels(int x, int y, int width, int height, unsigned format, unsigned type, void *pixels)
{
    if (over) {
        ((Read)system_function("glReadPixels"))(x, y, width, height, format, type, pixels);
        return;
    }
    for (int i = 0; i < 4; i++)
        ((unsigned char *)pixels)[i] = (unsigned char)(held[i] * 255 + 0.5f);
}

const unsigned char *glGetString(unsigned name)
{
    (void)name;
    return (const unsigned char *)"the program's own";
}

unsigned glGetError(void)
{
    return over ? ((unsigned (*)(void))system_function("glGetError"))() : 0;
}
#else
/* The system's function of the same name; all of them take numbers and addresses. */
static Handle forward(const char *name, Handle a, Handle b, Handle c, Handle d, Handle e)
{
    Handle library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    Handle (*function)(Handle, Handle, Handle, Handle, Handle) = (Handle(*)(Handle, Handle, Handle, Handle, Handle))dlsym(library, name);
    return function ? function(a, b, c, d, e) : NULL;
}

static int over;
static char object[4];
static Handle current;
void private_over(int on);

void private_over_egl(int on)
{
    over = on;
    private_over(on);
}

Handle eglGetDisplay(Handle native)
{
    return over ? forward("eglGetDisplay", native, 0, 0, 0, 0) : &object[0];
}

unsigned eglInitialize(Handle display, int *major, int *minor)
{
    return over ? (unsigned)(long)forward("eglInitialize", display, major, minor, 0, 0) : display == &object[0];
}

unsigned eglBindAPI(unsigned api)
{
    return over ? (unsigned)(long)forward("eglBindAPI", (Handle)(long)api, 0, 0, 0, 0) : 1;
}

unsigned eglChooseConfig(Handle display, const int *wanted, Handle *configs, int size, int *count)
{
    if (over)
        return (unsigned)(long)forward("eglChooseConfig", display, (Handle)wanted, configs, (Handle)(long)size, count);
    *configs = &object[1];
    *count = 1;
    return 1;
}

Handle eglCreateContext(Handle display, Handle config, Handle share, const int *attribs)
{
    return over ? forward("eglCreateContext", display, config, share, (Handle)attribs, 0) : &object[2];
}

Handle eglCreatePbufferSurface(Handle display, Handle config, const int *attribs)
{
    return over ? forward("eglCreatePbufferSurface", display, config, (Handle)attribs, 0, 0) : &object[3];
}

unsigned eglMakeCurrent(Handle display, Handle draw, Handle read, Handle context)
{
    if (over)
        return (unsigned)(long)forward("eglMakeCurrent", display, draw, read, context, 0);
    current = context;
    return display == &object[0];
}

Handle eglGetCurrentContext(void)
{
    return over ? forward("eglGetCurrentContext", 0, 0, 0, 0, 0) : current;
}

unsigned eglQuerySurface(Handle display, Handle surface, int name, int *value)
{
    if (over)
        return (unsigned)(long)forward("eglQuerySurface", display, surface, (Handle)(long)name, value, 0);
    *value = 1;
    return 1;
}

unsigned eglSwapBuffers(Handle display, Handle surface)
{
    return over ? (unsigned)(long)forward("eglSwapBuffers", display, surface, 0, 0, 0) : surface == &object[3];
}

int eglGetError(void)
{
    return over ? (int)(long)forward("eglGetError", 0, 0, 0, 0, 0) : 0x3000;
}

Function eglGetProcAddress(const char *name)
{
    return (Function)dlsym(RTLD_DEFAULT, name);
}
#endif
