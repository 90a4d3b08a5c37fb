/* Two ways from a picture in a program's context to a window over another monitor: a second window within the process, and a copy that another process gives to the
 * X server. Prints the median milliseconds of a frame.
 *   ways WIDTH HEIGHT FRAMES none|window|paced|copy
 * none: the picture is drawn and not shown. window: the second window's swaps do not wait for its monitor. paced: they do. */
#define _GNU_SOURCE
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

enum { SLOTS = 3, MOST = 10000 };

static int width, height;
static Display *display;
static XVisualInfo *visual;

static Window window(Display *on, int at, int w, int h)
{
    Window root = DefaultRootWindow(on);
    XSetWindowAttributes a = {.colormap = XCreateColormap(on, root, visual->visual, AllocNone), .override_redirect = True};
    Window made = XCreateWindow(on, root, at, 0, (unsigned)w, (unsigned)h, 0, visual->depth, InputOutput, visual->visual,
                                CWColormap | CWOverrideRedirect, &a);
    XMapWindow(on, made);
    XSync(on, False);
    return made;
}

/* The other process: puts each picture that it is told of into its window, and says when it has. */
static void serve(int socket, const unsigned char *pictures)
{
    Display *own = XOpenDisplay(NULL);
    Window shown = window(own, 64, width, height);
    GC gc = XCreateGC(own, shown, 0, NULL);
    unsigned char slot;
    while (read(socket, &slot, 1) == 1) {
        char *pixels = (char *)pictures + (size_t)slot * (size_t)width * (size_t)height * 4;
        XImage *image = XCreateImage(own, visual->visual, (unsigned)visual->depth, ZPixmap, 0, pixels, (unsigned)width,
                                     (unsigned)height, 32, width * 4);
        XPutImage(own, shown, gc, image, 0, 0, 0, 0, (unsigned)width, (unsigned)height);
        XSync(own, False);
        image->data = NULL;
        XDestroyImage(image);
        if (write(socket, &slot, 1) != 1)
            break;
    }
    _exit(0);
}

static void draw(int frame)
{
    glClearColor(0.2f, 0.3f, 0.4f, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glBegin(GL_TRIANGLES);
    for (int i = 0; i < 8; i++) {
        glColor3f((float)i / 8, (float)(frame % 64) / 64, 0.5f);
        glVertex2f(-1, -1);
        glVertex2f(1, -1 + 0.2f * (float)i);
        glVertex2f(-1 + 0.2f * (float)i, 1);
    }
    glEnd();
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec / 1e6;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(int argc, char **argv)
{
    if (argc < 5)
        return 2;
    width = atoi(argv[1]), height = atoi(argv[2]);
    int frames = atoi(argv[3]) < MOST ? atoi(argv[3]) : MOST;
    int copies = !strcmp(argv[4], "copy"), paced = !strcmp(argv[4], "paced"), second = paced || !strcmp(argv[4], "window");
    int wanted[] = {GLX_RGBA, GLX_DOUBLEBUFFER, None};
    display = XOpenDisplay(NULL);
    visual = display ? glXChooseVisual(display, DefaultScreen(display), wanted) : NULL;
    if (!visual)
        return 2;
    size_t bytes = (size_t)width * (size_t)height * 4;
    unsigned char *pictures = NULL;
    int ends[2] = {-1, -1}, free_slots[SLOTS] = {1, 1, 1};
    if (copies) {
        int file = memfd_create("pictures", 0);
        if (file < 0 || ftruncate(file, (off_t)(bytes * SLOTS)) || socketpair(AF_UNIX, SOCK_STREAM, 0, ends))
            return 2;
        pictures = mmap(NULL, bytes * SLOTS, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
        if (!fork()) {
            close(ends[0]);
            serve(ends[1], pictures);
        }
        close(ends[1]);
        fcntl(ends[0], F_SETFL, O_NONBLOCK);
    }
    Window program = window(display, 0, 64, 48), panel = second ? window(display, 64, width, height) : 0;
    GLXContext context = glXCreateContext(display, visual, NULL, True);
    glXMakeCurrent(display, program, context);
    GLuint texture, framebuffer;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_BGRA, GL_UNSIGNED_BYTE, NULL);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    void (*interval)(Display *, GLXDrawable, int) =
        (void (*)(Display *, GLXDrawable, int))glXGetProcAddress((const GLubyte *)"glXSwapIntervalEXT");
    if (interval) {
        interval(display, program, 0);
        if (second) {
            glXMakeCurrent(display, panel, context);
            interval(display, panel, paced);
            glXMakeCurrent(display, program, context);
        }
    }
    static double times[MOST];
    for (int frame = 0; frame < frames; frame++) {
        double start = now();
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glViewport(0, 0, width, height);
        draw(frame);
        if (second) {
            glXMakeCurrent(display, panel, context);
            glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
            glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
            glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
            glXSwapBuffers(display, panel);
            glXMakeCurrent(display, program, context);
        }
        if (copies) {
            unsigned char slot, done;
            while (read(ends[0], &done, 1) == 1)
                free_slots[done] = 1;
            for (slot = 0; slot < SLOTS && !free_slots[slot]; slot++)
                ;
            if (slot < SLOTS) {
                glReadPixels(0, 0, width, height, GL_BGRA, GL_UNSIGNED_BYTE, pictures + slot * bytes);
                free_slots[slot] = 0;
                if (write(ends[0], &slot, 1) != 1)
                    return 2;
            }
        }
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glViewport(0, 0, 64, 48);
        draw(frame);
        glXSwapBuffers(display, program);
        glFinish();
        times[frame] = now() - start;
    }
    qsort(times, (size_t)frames, sizeof *times, compare);
    printf("%.2f\n", times[frames / 2]);
    return 0;
}
