/* Programs that bring libraries of EGL and OpenGL ES of their own, or have them in a namespace of their own.
 *
 *   loads own FOLDER      opens libEGL.so and libGLESv2.so in a folder
 *   loads over FOLDER     the same, whose libraries draw by the system's
 *   loads beside FOLDER   the same, beside the system's EGL
 *   loads plugin FOLDER   opens loads-plugin.so in a folder: this program as a library, linked with them
 *   loads linked          this program, linked with them
 *   loads over-linked     the same, whose libraries draw by the system's
 *   loads space FOLDER    the same, opened by dlmopen in a namespace of their own
 *   loads spaces FOLDER   the same, beside the system's EGL
 *   loads system          the system's EGL, opened by dlopen
 *
 * Prints what the functions return and a pixel of each frame. */
#define _GNU_SOURCE
#include <EGL/egl.h>
#include <GL/gl.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef LINKED
void private_over_egl(int on);
#endif

/* The functions of one EGL and its OpenGL. */
struct api {
    EGLDisplay (*get_display)(EGLNativeDisplayType);
    EGLBoolean (*initialize)(EGLDisplay, EGLint *, EGLint *);
    EGLBoolean (*bind_api)(EGLenum);
    EGLBoolean (*choose)(EGLDisplay, const EGLint *, EGLConfig *, EGLint, EGLint *);
    EGLContext (*create_context)(EGLDisplay, EGLConfig, EGLContext, const EGLint *);
    EGLSurface (*create_surface)(EGLDisplay, EGLConfig, const EGLint *);
    EGLBoolean (*make_current)(EGLDisplay, EGLSurface, EGLSurface, EGLContext);
    EGLContext (*get_current)(void);
    EGLBoolean (*swap)(EGLDisplay, EGLSurface);
    void (*clear_color)(GLfloat, GLfloat, GLfloat, GLfloat);
    void (*clear)(GLbitfield);
    void (*read)(GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void *);
    EGLDisplay display;
    EGLSurface surface;
    EGLContext context;
};

static void *found(void *library, const char *name)
{
    void *symbol = dlsym(library, name);
    if (!symbol) {
        printf("%s is missing\n", name);
        exit(3);
    }
    return symbol;
}

static struct api loaded(void *egl, void *gl)
{
    return (struct api){
        .get_display = (EGLDisplay(*)(EGLNativeDisplayType))found(egl, "eglGetDisplay"),
        .initialize = (EGLBoolean(*)(EGLDisplay, EGLint *, EGLint *))found(egl, "eglInitialize"),
        .bind_api = (EGLBoolean(*)(EGLenum))found(egl, "eglBindAPI"),
        .choose = (EGLBoolean(*)(EGLDisplay, const EGLint *, EGLConfig *, EGLint, EGLint *))found(egl, "eglChooseConfig"),
        .create_context = (EGLContext(*)(EGLDisplay, EGLConfig, EGLContext, const EGLint *))found(egl, "eglCreateContext"),
        .create_surface = (EGLSurface(*)(EGLDisplay, EGLConfig, const EGLint *))found(egl, "eglCreatePbufferSurface"),
        .make_current = (EGLBoolean(*)(EGLDisplay, EGLSurface, EGLSurface, EGLContext))found(egl, "eglMakeCurrent"),
        .get_current = (EGLContext(*)(void))found(egl, "eglGetCurrentContext"),
        .swap = (EGLBoolean(*)(EGLDisplay, EGLSurface))found(egl, "eglSwapBuffers"),
        .clear_color = (void (*)(GLfloat, GLfloat, GLfloat, GLfloat))found(gl, "glClearColor"),
        .clear = (void (*)(GLbitfield))found(gl, "glClear"),
        .read = (void (*)(GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void *))found(gl, "glReadPixels"),
    };
}

#ifdef LINKED
static struct api linked(void)
{
    return (struct api){
        .get_display = eglGetDisplay,
        .initialize = eglInitialize,
        .bind_api = eglBindAPI,
        .choose = eglChooseConfig,
        .create_context = eglCreateContext,
        .create_surface = eglCreatePbufferSurface,
        .make_current = eglMakeCurrent,
        .get_current = eglGetCurrentContext,
        .swap = eglSwapBuffers,
        .clear_color = glClearColor,
        .clear = glClear,
        .read = glReadPixels,
    };
}
#endif

static void *opened(Lmid_t space, const char *folder, const char *name)
{
    char path[4096];
    snprintf(path, sizeof path, "%s%s%s", folder, *folder ? "/" : "", name);
    void *library = dlmopen(space, path, RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        printf("%s\n", dlerror());
        exit(2);
    }
    return library;
}

static void start(struct api *a, const char *who)
{
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    const EGLint size[] = {EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
    EGLConfig config;
    EGLint count = 0;
    a->display = a->get_display(EGL_DEFAULT_DISPLAY);
    printf("%s: a display %d\n", who, a->display != EGL_NO_DISPLAY);
    printf("%s: initialized %d\n", who, a->initialize(a->display, NULL, NULL));
    printf("%s: OpenGL %d\n", who, a->bind_api(EGL_OPENGL_API));
    EGLBoolean chosen = a->choose(a->display, wanted, &config, 1, &count);
    printf("%s: a configuration %d %d\n", who, chosen, count);
    if (!count)
        exit(4);
    a->surface = a->create_surface(a->display, config, size);
    a->context = a->create_context(a->display, config, EGL_NO_CONTEXT, NULL);
    printf("%s: a surface %d, a context %d\n", who, a->surface != EGL_NO_SURFACE, a->context != EGL_NO_CONTEXT);
    fflush(stdout);
}

static void frame(struct api *a, const char *who, int number)
{
    GLubyte p[4] = {9, 9, 9, 9};
    EGLBoolean made = a->make_current(a->display, a->surface, a->surface, a->context);
    printf("%s: current %d %d\n", who, made, a->get_current() == a->context);
    a->clear_color(1, (float)number / 4, 0, 1);
    a->clear(GL_COLOR_BUFFER_BIT);
    a->read(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, p);
    printf("%s: frame %d: %d %d %d, swapped %d\n", who, number, p[0], p[1], p[2], a->swap(a->display, a->surface));
    fflush(stdout);
}

#ifdef LINKED
static struct api own_api(const char *mode, const char *folder)
{
    (void)folder;
    private_over_egl(!strcmp(mode, "over-linked"));
    return linked();
}
#else
static struct api own_api(const char *mode, const char *folder)
{
    Lmid_t space = LM_ID_BASE;
    if (!strcmp(mode, "system"))
        return loaded(opened(space, "", "libEGL.so.1"), opened(space, "", "libOpenGL.so.0"));
    void *gl = opened(strncmp(mode, "space", 5) ? space : LM_ID_NEWLM, folder, "libGLESv2.so");
    dlinfo(gl, RTLD_DI_LMID, &space);
    void *egl = opened(space, folder, "libEGL.so");
    ((void (*)(int))found(egl, "private_over_egl"))(!strcmp(mode, "over"));
    return loaded(egl, gl);
}
#endif

int main(int count, char **arguments)
{
    const char *mode = count > 1 ? arguments[1] : "", *folder = count > 2 ? arguments[2] : "";
#ifndef LINKED
    if (!strcmp(mode, "plugin")) {
        int (*run)(int, char **) = (int (*)(int, char **))found(opened(LM_ID_BASE, folder, "loads-plugin.so"), "main");
        return run(1, arguments);
    }
#endif
    int beside = !strcmp(mode, "beside") || !strcmp(mode, "spaces");
    struct api own = own_api(mode, folder), other;
    start(&own, "own");
    if (beside) {
        other = loaded(opened(LM_ID_BASE, "", "libEGL.so.1"), opened(LM_ID_BASE, "", "libOpenGL.so.0"));
        start(&other, "system");
    }
    for (int i = 0; i < 3; i++) {
        frame(&own, "own", i);
        if (beside)
            frame(&other, "system", i);
    }
    return 0;
}
