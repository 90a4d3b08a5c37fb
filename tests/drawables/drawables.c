#include "drawables.h"
#include <X11/Xutil.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

Display *display;
static GLXFBConfig config;

static int told(Display *unused, XErrorEvent *event)
{
    (void)unused;
    printf("X error %d of request %d\n", event->error_code, event->request_code);
    return 0;
}

void open_display(int single)
{
    const int wanted[] = {GLX_DOUBLEBUFFER, !single, GLX_RED_SIZE, 8, GLX_GREEN_SIZE, 8, GLX_BLUE_SIZE, 8, GLX_DEPTH_SIZE, 24,
                          GLX_DRAWABLE_TYPE, GLX_WINDOW_BIT | GLX_PIXMAP_BIT | GLX_PBUFFER_BIT, GLX_X_RENDERABLE, True, None};
    int count;
    XInitThreads();
    display = XOpenDisplay(NULL);
    GLXFBConfig *configs = display ? glXChooseFBConfig(display, DefaultScreen(display), wanted, &count) : NULL;
    /* A pixmap of the screen's depth has no alpha. */
    for (int i = 0; configs && i < count && !config; i++) {
        XVisualInfo *visual = glXGetVisualFromFBConfig(display, configs[i]);
        if (visual && visual->depth == DefaultDepth(display, DefaultScreen(display)))
            config = configs[i];
        XFree(visual);
    }
    if (!config)
        exit(2);
    XFree(configs);
    XSetErrorHandler(told);
}

Window open_window(int place)
{
    return open_wide_window(place, SIZE);
}

Window open_wide_window(int place, unsigned width)
{
    XVisualInfo *visual = glXGetVisualFromFBConfig(display, config);
    Window root = DefaultRootWindow(display), window;
    XSetWindowAttributes a = {.colormap = XCreateColormap(display, root, visual->visual, AllocNone), .override_redirect = True,
                              .background_pixel = GREY, .event_mask = ExposureMask};
    XEvent event;
    window = XCreateWindow(display, root, 2 * SIZE * place, 0, width, SIZE, 0, visual->depth, InputOutput, visual->visual,
                           CWColormap | CWOverrideRedirect | CWBackPixel | CWEventMask, &a);
    XFree(visual);
    XMapWindow(display, window);
    XWindowEvent(display, window, ExposureMask, &event);
    return window;
}

GLXWindow drawn(Window window)
{
    return glXCreateWindow(display, config, window, NULL);
}

GLXPixmap open_pixmap(Pixmap *behind)
{
    static const int attributes[] = {GLX_TEXTURE_TARGET_EXT, GLX_TEXTURE_2D_EXT, GLX_TEXTURE_FORMAT_EXT, GLX_TEXTURE_FORMAT_RGB_EXT, None};
    int screen = DefaultScreen(display);
    *behind = XCreatePixmap(display, DefaultRootWindow(display), SIZE, SIZE, (unsigned)DefaultDepth(display, screen));
    XSetForeground(display, DefaultGC(display, screen), GREY);
    XFillRectangle(display, *behind, DefaultGC(display, screen), 0, 0, SIZE, SIZE);
    return glXCreatePixmap(display, config, *behind, attributes);
}

GLXPbuffer open_pbuffer(int width, int height)
{
    const int attributes[] = {GLX_PBUFFER_WIDTH, width, GLX_PBUFFER_HEIGHT, height, GLX_PRESERVED_CONTENTS, True, None};
    return glXCreatePbuffer(display, config, attributes);
}

GLXContext open_context(GLXContext share)
{
    return glXCreateNewContext(display, config, GLX_RGBA_TYPE, share, True);
}

void use(GLXDrawable draw, GLXDrawable read, GLXContext context)
{
    if (!glXMakeContextCurrent(display, draw, read, context))
        printf("not current\n");
}

void clear(int colour)
{
    glClearColor((float)(colour >> 16 & 255) / 255, (float)(colour >> 8 & 255) / 255, (float)(colour & 255) / 255, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void middle(int colour)
{
    glColor3ub((GLubyte)(colour >> 16), (GLubyte)(colour >> 8), (GLubyte)colour);
    glRectf(-0.75f, -0.75f, 0.75f, 0.75f);
}

void use_framebuffer(void)
{
    GLuint name, colours;
    glGenFramebuffers(1, &name);
    glGenRenderbuffers(1, &colours);
    glBindFramebuffer(GL_FRAMEBUFFER, name);
    glBindRenderbuffer(GL_RENDERBUFFER, colours);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, SIZE, SIZE);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colours);
}

void shown(const char *what, Drawable drawable)
{
    XSync(display, False);
    XImage *image = XGetImage(display, drawable, 0, 0, SIZE, SIZE, AllPlanes, ZPixmap);
    unsigned long corner = image ? XGetPixel(image, 2, 2) : 0, centre = image ? XGetPixel(image, SIZE / 2, SIZE / 2) : 0;
    printf("%s: corner %06lx, middle %06lx\n", what, corner & WHITE, centre & WHITE);
    if (image)
        XDestroyImage(image);
}

void pixels(const char *what)
{
    unsigned char p[2][4] = {{0}};
    glReadPixels(2, 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, p[0]);
    glReadPixels(SIZE / 2, SIZE / 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, p[1]);
    printf("%s: corner %02x%02x%02x, middle %02x%02x%02x, error 0x%x\n", what, p[0][0], p[0][1], p[0][2], p[1][0], p[1][1], p[1][2],
           glGetError());
}

int is(const char *mode, const char *name)
{
    return !strcmp(mode, name);
}
