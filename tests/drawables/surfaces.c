/* The same with EGL, and contexts without a drawable:
 *
 *   egl-read         a surface to draw to, and another one to read from
 *   egl-one          one context with two windows in turn, of which only the current one may be swapped
 *   egl-two          a context for each window
 *   egl-both         two contexts draw to one window
 *   egl-formats      surfaces of other formats than the first one of a context
 *   egl-copied       eglCopyBuffers to a pixmap
 *   egl-post         eglPostSubBufferNV, eglSwapBuffersRegionNOK and eglSwapBuffersRegion2NOK (offers.c)
 *   egl-none         a context that had a surface is current without one
 *   glx-none         the same with GLX
 *   egl-before       a context sets state before it has a surface */
#define _GNU_SOURCE
#include "drawables.h"
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

static EGLDisplay egl;
static EGLConfig config;

static EGLConfig choose(int depth, int alpha, int samples)
{
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_WINDOW_BIT | EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                             EGL_DEPTH_SIZE, depth, EGL_ALPHA_SIZE, alpha, EGL_RED_SIZE, 8, EGL_SAMPLES, samples, EGL_NONE};
    EGLConfig all[64];
    EGLint count = 0, has, bits;
    eglChooseConfig(egl, wanted, all, 64, &count);
    for (int i = 0; i < count; i++)
        if (eglGetConfigAttrib(egl, all[i], EGL_ALPHA_SIZE, &has) && has == alpha && eglGetConfigAttrib(egl, all[i], EGL_DEPTH_SIZE, &bits)
            && bits == depth)
            return all[i];
    exit(2);
}

static void open_egl(void)
{
    open_display(0);
    egl = eglGetDisplay((EGLNativeDisplayType)display);
    if (!eglInitialize(egl, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API))
        exit(2);
    config = choose(24, 0, 0);
}

static EGLSurface pbuffer(EGLConfig of)
{
    const EGLint size[] = {EGL_WIDTH, SIZE, EGL_HEIGHT, SIZE, EGL_NONE};
    return eglCreatePbufferSurface(egl, of, size);
}

static EGLSurface surface(Window window)
{
    return eglCreateWindowSurface(egl, config, window, NULL);
}

static EGLContext context(void)
{
    return eglCreateContext(egl, config, EGL_NO_CONTEXT, NULL);
}

static void bind(const char *what, EGLSurface draw, EGLSurface read, EGLContext with)
{
    if (!eglMakeCurrent(egl, draw, read, with))
        printf("%s: not current, error 0x%x\n", what, eglGetError());
}

static void swap(const char *what, EGLSurface of)
{
    EGLBoolean done = eglSwapBuffers(egl, of);
    printf("swap of %s: %u, error 0x%x\n", what, done, eglGetError());
}

static void read_from(void)
{
    open_egl();
    Window a = open_window(0);
    EGLSurface window = surface(a), aside = pbuffer(config);
    EGLContext first = context();
    bind("pbuffer", aside, aside, first);
    clear(GREEN);
    middle(BLUE);
    bind("window", window, window, first);
    clear(RED);
    middle(WHITE);
    bind("both", window, aside, first);
    pixels("pbuffer");
    glBlitFramebuffer(0, 0, SIZE, SIZE, 0, 0, SIZE, SIZE / 2 + 8, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    swap("pbuffer", aside);
    swap("window", window);
    shown("window", a);
}

static void in_turn(int contexts)
{
    open_egl();
    Window a = open_window(0), b = open_window(1);
    EGLSurface first = surface(a), second = surface(b);
    EGLContext one = context(), other = contexts == 2 ? context() : one;
    for (int frame = 0; frame < 2; frame++) {
        bind("first", first, first, one);
        clear(frame ? BLUE : RED);
        middle(WHITE);
        bind("second", second, second, other);
        clear(frame ? RED : BLUE);
        middle(GREEN);
        swap("first", first);
        swap("second", second);
        bind("first", first, first, one);
        pixels("first again");
        swap("first", first);
        shown("first", a);
        shown("second", b);
    }
}

static void both(void)
{
    open_egl();
    Window a = open_window(0);
    EGLSurface window = surface(a);
    EGLContext one = context(), other = context();
    bind("one", window, window, one);
    clear(RED);
    bind("other", window, window, other);
    pixels("of the other context");
    middle(WHITE);
    swap("window", window);
    shown("window", a);
}

static void tell_format(const char *what)
{
    static const GLenum names[] = {GL_RED_BITS, GL_ALPHA_BITS, GL_DEPTH_BITS, GL_STENCIL_BITS, GL_SAMPLES, GL_DOUBLEBUFFER};
    unsigned char pixel[4];
    printf("%s:", what);
    for (unsigned i = 0; i < sizeof names / sizeof *names; i++) {
        GLint value = -1;
        glGetIntegerv(names[i], &value);
        printf(" %d", value);
    }
    glClearColor(1, 0, 0, 0.2f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glReadPixels(2, 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
    printf(", cleared %d %d %d %d", pixel[0], pixel[1], pixel[2], pixel[3]);
    glEnable(GL_DEPTH_TEST);
    glRectf(-1, -1, 1, 1);
    glColor3ub(0, 255, 0);
    glTranslatef(0, 0, 0.5f);
    glRectf(-1, -1, 0, 1);
    glLoadIdentity();
    glReadPixels(SIZE / 4, SIZE / 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
    glColor3ub(255, 255, 255);
    printf(", behind %d %d %d %d, error 0x%x\n", pixel[0], pixel[1], pixel[2], pixel[3], glGetError());
}

static void formats(void)
{
    open_egl();
    EGLContext any = eglCreateContext(egl, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, NULL);
    static const struct { const char *name; int depth, alpha, samples; } all[] = {
        {"depths", 24, 0, 0}, {"no depths", 0, 0, 0}, {"alpha", 24, 8, 0}, {"samples", 24, 0, 4}, {"few depths", 16, 0, 0},
    };
    for (unsigned i = 0; i < sizeof all / sizeof *all; i++) {
        EGLSurface s = pbuffer(choose(all[i].depth, all[i].alpha, all[i].samples));
        bind(all[i].name, s, s, any);
        tell_format(all[i].name);
    }
}

static Pixmap open_behind(void)
{
    int screen = DefaultScreen(display);
    Pixmap behind = XCreatePixmap(display, DefaultRootWindow(display), SIZE, SIZE, (unsigned)DefaultDepth(display, screen));
    XSetForeground(display, DefaultGC(display, screen), GREY);
    XFillRectangle(display, behind, DefaultGC(display, screen), 0, 0, SIZE, SIZE);
    XSync(display, False);
    return behind;
}

static void copied(void)
{
    open_egl();
    Pixmap behind = open_behind();
    EGLSurface window = surface(open_window(0));
    bind("window", window, window, context());
    clear(RED);
    middle(WHITE);
    EGLBoolean done = eglCopyBuffers(egl, window, behind);
    printf("copy: %u, error 0x%x\n", done, eglGetError());
    shown("pixmap", behind);
}

/* A command of an extension, as a program finds it that looks for symbols. */
static void *command(const char *name)
{
    void *found = dlsym(RTLD_DEFAULT, name);
    if (!found)
        exit(77);
    return found;
}

static void post(void)
{
    static const EGLint all[] = {0, 0, SIZE, SIZE};
    open_egl();
    Window a = open_window(0);
    EGLSurface window = surface(a);
    bind("window", window, window, context());
    clear(RED);
    middle(WHITE);
    ((EGLBoolean(*)(EGLDisplay, EGLSurface, EGLint, EGLint, EGLint, EGLint))command("eglPostSubBufferNV"))(egl, window, 0, 0, SIZE, SIZE);
    shown("posted", a);
    clear(BLUE);
    ((EGLBoolean(*)(EGLDisplay, EGLSurface, EGLint, const EGLint *))command("eglSwapBuffersRegionNOK"))(egl, window, 1, all);
    shown("region", a);
    clear(GREEN);
    ((EGLBoolean(*)(EGLDisplay, EGLSurface, EGLint, const EGLint *))command("eglSwapBuffersRegion2NOK"))(egl, window, 1, all);
    shown("other region", a);
}

/* Binds a framebuffer with a renderbuffer, and prints what becomes of a clear. */
static void beside(void)
{
    use_framebuffer();
    clear(GREEN);
    pixels("framebuffer");
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

static void tell_none(void)
{
    GLint draw = -1, read = -1;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw);
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read);
    printf("bound %d %d, status 0x%x\n", draw, read, glCheckFramebufferStatus(GL_FRAMEBUFFER));
    clear(BLUE);
    printf("cleared: error 0x%x\n", glGetError());
    pixels("nothing");
    beside();
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw);
    printf("bound %d, status 0x%x, error 0x%x\n", draw, glCheckFramebufferStatus(GL_FRAMEBUFFER), glGetError());
}

static void egl_none(void)
{
    open_egl();
    EGLSurface aside = pbuffer(config);
    EGLContext first = context();
    bind("pbuffer", aside, aside, first);
    clear(RED);
    bind("nothing", EGL_NO_SURFACE, EGL_NO_SURFACE, first);
    tell_none();
    bind("pbuffer", aside, aside, first);
    pixels("pbuffer");
}

static void glx_none(void)
{
    open_display(0);
    GLXPbuffer aside = open_pbuffer(SIZE, SIZE);
    GLXContext first = open_context(NULL);
    use(aside, aside, first);
    clear(RED);
    use(None, None, first);
    tell_none();
    use(aside, aside, first);
    pixels("pbuffer");
}

static void egl_before(void)
{
    static const GLubyte red[3] = {255};
    open_egl();
    EGLSurface aside = pbuffer(config);
    EGLContext first = context();
    bind("nothing", EGL_NO_SURFACE, EGL_NO_SURFACE, first);
    glColorPointer(3, GL_UNSIGNED_BYTE, 0, red);
    glEnableClientState(GL_COLOR_ARRAY);
    bind("pbuffer", aside, aside, first);
    clear(GREEN);
    glBindVertexArray(0);
    glColor3f(1, 1, 1);
    glBegin(GL_QUADS);
    glArrayElement(0);
    glEnd();
    glBegin(GL_QUADS);
    for (int i = 0; i < 4; i++)
        glVertex2f(i == 1 || i == 2, i > 1);
    glColor3f(0, 0, 1);
    glEnd();
    pixels("pbuffer");
}

int surfaces(const char *mode)
{
    if (is(mode, "egl-read"))
        read_from();
    else if (is(mode, "egl-one") || is(mode, "egl-two"))
        in_turn(is(mode, "egl-one") ? 1 : 2);
    else if (is(mode, "egl-both"))
        both();
    else if (is(mode, "egl-formats"))
        formats();
    else if (is(mode, "egl-copied"))
        copied();
    else if (is(mode, "egl-post"))
        post();
    else if (is(mode, "egl-none"))
        egl_none();
    else if (is(mode, "glx-none"))
        glx_none();
    else if (is(mode, "egl-before"))
        egl_before();
    else
        return 0;
    return 1;
}
