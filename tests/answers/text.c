/* Text of an X font, which glXUseXFont turns into display lists: frame counters of old programs are drawn so.
 *
 *   text generated   under names of glGenLists
 *   text numbered    under names of the program's own
 *   text again       in place of lists that the program has compiled before
 *   text nested      called by a list of the program's
 *   text executed    called while a list is compiled and executed
 *   text deleted     the lists are deleted and made once more
 *   text alone       one letter, by glCallList
 *
 * Each frame has another text. Prints how many pixels are lit, and between which corners: as they are read back, and in the window after
 * the swap; where the raster position is; the name of the next list; and errors. */
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 160, HEIGHT = 48, FIRST = '!', LETTERS = 94, OWN_NAME = 1, FRAMES = 3 };

static Display *display;
static Window window;
static const char *mode;

static void open_window(void)
{
    int wanted[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 8, GLX_DEPTH_SIZE, 16, None};
    XEvent event;
    display = XOpenDisplay(NULL);
    XVisualInfo *visual = display ? glXChooseVisual(display, DefaultScreen(display), wanted) : NULL;
    if (!visual)
        exit(2);
    Window root = DefaultRootWindow(display);
    XSetWindowAttributes a = {.colormap = XCreateColormap(display, root, visual->visual, AllocNone), .event_mask = ExposureMask};
    window = XCreateWindow(display, root, 0, 0, WIDTH, HEIGHT, 0, visual->depth, InputOutput, visual->visual, CWColormap | CWEventMask, &a);
    XMapWindow(display, window);
    do
        XNextEvent(display, &event);
    while (event.type != Expose);
    GLXContext context = glXCreateContext(display, visual, NULL, True);
    XFree(visual);
    if (!context || !glXMakeCurrent(display, window, context))
        exit(3);
}

struct lit {
    int count, left, right, bottom, top;
};

static void note(struct lit *lit, int x, int y)
{
    if (!lit->count++)
        *lit = (struct lit){1, x, x, y, y};
    lit->left = x < lit->left ? x : lit->left;
    lit->right = x > lit->right ? x : lit->right;
    lit->bottom = y < lit->bottom ? y : lit->bottom;
    lit->top = y > lit->top ? y : lit->top;
}

static void print(const char *where, struct lit lit)
{
    printf("%s: %d pixels, x %d to %d, y %d to %d\n", where, lit.count, lit.left, lit.right, lit.bottom, lit.top);
}

static void read_back(void)
{
    static unsigned char pixels[WIDTH * HEIGHT * 4];
    struct lit lit = {0};
    glReadPixels(0, 0, WIDTH, HEIGHT, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        if (pixels[4 * i] == 255)
            note(&lit, i % WIDTH, i / WIDTH);
    print("read", lit);
}

static void look(void)
{
    struct lit lit = {0};
    glFinish();
    XSync(display, False);
    XImage *image = XGetImage(display, window, 0, 0, WIDTH, HEIGHT, AllPlanes, ZPixmap);
    for (int y = 0; image && y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            if ((XGetPixel(image, x, y) & 0xff0000) == 0xff0000)
                note(&lit, x, HEIGHT - 1 - y);
    print("window", lit);
}

static int is(const char *name)
{
    return !strcmp(mode, name);
}

/* The name of the list of the letter '!'. */
static GLuint font(void)
{
    XFontStruct *fixed = XLoadQueryFont(display, "fixed");
    if (!fixed)
        exit(4);
    GLuint base = is("numbered") ? OWN_NAME : glGenLists(LETTERS);
    for (GLuint letter = 0; is("again") && letter < LETTERS; letter++) {
        glNewList(base + letter, GL_COMPILE);
        glRecti(0, 0, 1, 1);
        glEndList();
    }
    glXUseXFont(fixed->fid, FIRST, LETTERS, (int)base);
    if (is("deleted")) {
        glDeleteLists(base, LETTERS);
        base = glGenLists(LETTERS);
        glXUseXFont(fixed->fid, FIRST, LETTERS, (int)base);
    }
    return base;
}

static void write_text(GLuint base, GLuint outer, int frame)
{
    char text[16];
    int length = snprintf(text, sizeof text, "fps:%d", 57 + frame * 1000);
    if (is("alone")) {
        glCallList(base + 'A' - FIRST + (GLuint)frame);
        return;
    }
    glListBase(base - FIRST);
    if (is("nested") || is("executed"))
        glNewList(outer, is("nested") ? GL_COMPILE : GL_COMPILE_AND_EXECUTE);
    glCallLists(length, GL_UNSIGNED_BYTE, text);
    if (is("nested") || is("executed"))
        glEndList();
    if (is("nested"))
        glCallList(outer);
}

int main(int argc, char **argv)
{
    mode = argc > 1 ? argv[1] : "";
    open_window();
    GLuint base = font(), outer = glGenLists(1);
    printf("the next list: %u\n", outer);
    glOrtho(0, WIDTH, 0, HEIGHT, -1, 1);
    for (int frame = 0; frame < FRAMES; frame++) {
        GLfloat place[4];
        glClear(GL_COLOR_BUFFER_BIT);
        glColor3f(1, 1, 1);
        glRasterPos2i(10 + frame, 20);
        write_text(base, outer, frame);
        glGetFloatv(GL_CURRENT_RASTER_POSITION, place);
        read_back();
        glXSwapBuffers(display, window);
        look();
        printf("raster position %g %g, a list: %d, error 0x%x\n", (double)place[0], (double)place[1], glIsList(base + 'A' - FIRST), glGetError());
    }
    return 0;
}
