/* Several drawables and contexts. A drawable has its own picture, whoever draws to it or shows it, and whatever is current:
 *
 *   one           one context draws to a window and to another one, and swaps the first, which is not current any more, and the second
 *   one-wide      the same with windows of different sizes
 *   two           a context for each window, likewise
 *   two-wide      the same with windows of different sizes
 *   plain         as "two", where the windows are their own drawables, and each is swapped while it is current
 *   plain-one     the same with one context and windows of different sizes
 *   back          one context goes from window to window and back: pictures and depths are as it left them
 *   both          two contexts draw to one window
 *   both-sharing  the same, and the contexts share objects
 *   none          a window is swapped while no context is current
 *   thread        a window is swapped by a thread that has another one current, while its own context is current in its own thread
 *   thread-none   the same by a thread that has no context current
 *   thread-both   two threads have a window current, each with a context of its own
 *   pbuffer       a pbuffer in between, of another size
 *   pbuffer-other a pbuffer that one context has drawn is read by another one
 *   buffers       the draw buffer belongs to the context, which goes to another window
 *   again         a window is destroyed, and the context draws to a new one
 *   destroyed     a window is destroyed while it is current, and the context draws on and then goes to another window
 *   destroyed-own the same with a window that is its own drawable
 *   scenes        one context draws a scene in each of two windows, a part of the one and a part of the other in turn, and a flat menu
 *                 in the second one
 *   scenes-apart  the same pictures, drawn one after the other by two contexts */
#include "drawables.h"
#include <pthread.h>
#include <stdio.h>

static Window a, b;
static GLXWindow draws_a, draws_b;

static void open_windows(unsigned width)
{
    open_display(0);
    a = open_window(0);
    b = open_wide_window(1, width);
    draws_a = drawn(a);
    draws_b = drawn(b);
}

static void show_both(void)
{
    glXSwapBuffers(display, draws_a);
    shown("first", a);
    shown("second", b);
    glXSwapBuffers(display, draws_b);
    shown("first", a);
    shown("second", b);
}

static void picture(int outside, int inside)
{
    glViewport(0, 0, SIZE, SIZE);
    clear(outside);
    middle(inside);
}

static void in_turn(int contexts, unsigned width)
{
    open_windows(width);
    GLXContext first = open_context(NULL), second = contexts == 2 ? open_context(NULL) : first;
    use(draws_a, draws_a, first);
    picture(RED, WHITE);
    use(draws_b, draws_b, second);
    picture(BLUE, GREEN);
    show_both();
    picture(GREEN, RED);
    show_both();
    use(draws_a, draws_a, first);
    picture(WHITE, BLUE);
    show_both();
}

static void plain(int contexts, unsigned width)
{
    open_windows(width);
    GLXContext first = open_context(NULL), second = contexts == 2 ? open_context(NULL) : first;
    for (int frame = 0; frame < 2; frame++) {
        use(a, a, first);
        picture(RED, frame ? BLUE : WHITE);
        glXSwapBuffers(display, a);
        use(b, b, second);
        picture(BLUE, frame ? RED : GREEN);
        glXSwapBuffers(display, b);
        shown("first", a);
        shown("second", b);
    }
}

/* A rectangle over all of the window. */
static void whole(int colour, float depth)
{
    glColor3ub((GLubyte)(colour >> 16), (GLubyte)(colour >> 8), (GLubyte)colour);
    glBegin(GL_QUADS);
    glVertex3f(-1, -1, depth);
    glVertex3f(1, -1, depth);
    glVertex3f(1, 1, depth);
    glVertex3f(-1, 1, depth);
    glEnd();
}

static void back(void)
{
    open_windows(SIZE);
    GLXContext context = open_context(NULL);
    use(draws_a, draws_a, context);
    glEnable(GL_DEPTH_TEST);
    clear(RED);
    middle(WHITE);
    use(draws_b, draws_b, context);
    clear(BLUE);
    whole(GREEN, -0.5f);
    use(draws_a, draws_a, context);
    pixels("first again");
    whole(BLUE, 0.5f);
    pixels("drawn behind");
    glXSwapBuffers(display, draws_a);
    shown("first", a);
    use(draws_b, draws_b, context);
    whole(RED, -0.4f);
    pixels("second again");
    glXSwapBuffers(display, draws_b);
    shown("second", b);
}

static void both(int sharing)
{
    open_windows(SIZE);
    GLXContext first = open_context(NULL), second = open_context(sharing ? first : NULL);
    for (int frame = 0; frame < 2; frame++) {
        use(draws_a, draws_a, first);
        clear(frame ? RED : BLUE);
        use(draws_a, draws_a, second);
        pixels("of the other context");
        middle(frame ? GREEN : WHITE);
        glXSwapBuffers(display, draws_a);
        shown("window", a);
    }
}

static void none(void)
{
    open_windows(SIZE);
    GLXContext context = open_context(NULL);
    use(draws_a, draws_a, context);
    picture(RED, WHITE);
    glXSwapBuffers(display, draws_a);
    picture(BLUE, GREEN);
    use(None, None, NULL);
    glXSwapBuffers(display, draws_a);
    shown("window", a);
    use(draws_a, draws_a, context);
    pixels("again");
}

static pthread_barrier_t reached;

static void *draw(void *unused)
{
    use(draws_a, draws_a, open_context(NULL));
    picture(RED, WHITE);
    glFinish();
    pthread_barrier_wait(&reached);
    pthread_barrier_wait(&reached);
    picture(BLUE, RED);
    glXSwapBuffers(display, draws_a);
    shown("by its own thread", a);
    use(None, None, NULL);
    return unused;
}

static void thread(int current)
{
    pthread_t other;
    open_windows(SIZE);
    if (current) {
        use(draws_b, draws_b, open_context(NULL));
        picture(GREEN, BLUE);
    }
    pthread_barrier_init(&reached, NULL, 2);
    pthread_create(&other, NULL, draw, NULL);
    pthread_barrier_wait(&reached);
    glXSwapBuffers(display, draws_a);
    shown("by another thread", a);
    pthread_barrier_wait(&reached);
    pthread_join(other, NULL);
}

static void thread_both(void)
{
    pthread_t other;
    open_windows(SIZE);
    pthread_barrier_init(&reached, NULL, 2);
    pthread_create(&other, NULL, draw, NULL);
    pthread_barrier_wait(&reached);
    use(draws_a, draws_a, open_context(NULL));
    pixels("of the other thread");
    middle(GREEN);
    glXSwapBuffers(display, draws_a);
    shown("by this thread", a);
    pthread_barrier_wait(&reached);
    pthread_join(other, NULL);
}

static void pbuffer(void)
{
    open_windows(SIZE);
    GLXPbuffer aside = open_pbuffer(2 * SIZE, SIZE / 2 + 2);
    GLXContext context = open_context(NULL);
    use(draws_a, draws_a, context);
    clear(RED);
    middle(WHITE);
    use(aside, aside, context);
    clear(GREEN);
    pixels("pbuffer");
    use(draws_a, draws_a, context);
    pixels("window");
    glXSwapBuffers(display, draws_a);
    shown("window", a);
    use(aside, aside, context);
    pixels("pbuffer again");
}

static void pbuffer_other(void)
{
    open_windows(SIZE);
    GLXPbuffer aside = open_pbuffer(SIZE, SIZE);
    GLXContext first = open_context(NULL), second = open_context(NULL);
    use(aside, aside, first);
    clear(RED);
    middle(GREEN);
    use(aside, aside, second);
    pixels("pbuffer");
    middle(BLUE);
    use(aside, aside, first);
    pixels("pbuffer again");
}

static void buffers(void)
{
    GLint buffer;
    open_windows(SIZE);
    GLXContext context = open_context(NULL);
    use(draws_a, draws_a, context);
    glDrawBuffer(GL_FRONT);
    use(draws_b, draws_b, context);
    glGetIntegerv(GL_DRAW_BUFFER, &buffer);
    printf("draw buffer 0x%x\n", (unsigned)buffer);
    clear(RED);
    glFlush();
    shown("second", b);
    glDrawBuffer(GL_BACK);
    clear(BLUE);
    use(draws_a, draws_a, context);
    glGetIntegerv(GL_DRAW_BUFFER, &buffer);
    printf("draw buffer 0x%x\n", (unsigned)buffer);
    clear(GREEN);
    glXSwapBuffers(display, draws_a);
    shown("first", a);
    shown("second", b);
}

static void again(void)
{
    open_windows(SIZE);
    GLXContext context = open_context(NULL);
    for (int frame = 0; frame < 3; frame++) {
        use(draws_a, draws_a, context);
        picture(RED, frame ? BLUE : WHITE);
        glXSwapBuffers(display, draws_a);
        shown("window", a);
        picture(GREEN, GREEN);
        use(None, None, NULL);
        glXDestroyWindow(display, draws_a);
        XDestroyWindow(display, a);
        a = open_window(frame % 2 ? 0 : 2);
        draws_a = drawn(a);
    }
}

static void destroyed(int own)
{
    open_windows(SIZE);
    if (own)
        a = open_window(2);
    GLXDrawable drawable = own ? a : draws_a;
    GLXContext context = open_context(NULL);
    use(drawable, drawable, context);
    clear(RED);
    if (!own)
        glXDestroyWindow(display, draws_a);
    XDestroyWindow(display, a);
    XSync(display, False);
    picture(GREEN, BLUE);
    printf("error 0x%x\n", glGetError());
    use(draws_b, draws_b, context);
    picture(BLUE, RED);
    glXSwapBuffers(display, draws_b);
    shown("second", b);
}

static void look(void)
{
    glViewport(0, 0, SIZE, SIZE);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-0.5, 0.5, -0.5, 0.5, 1, 20);
    glMatrixMode(GL_MODELVIEW);
    glEnable(GL_DEPTH_TEST);
}

/* Quads that cut each other, before and behind the panel. */
static void part(int number)
{
    static const int colours[] = {RED, GREEN, BLUE, WHITE};
    for (int i = 0; i < 3; i++) {
        int colour = colours[(number + i) % 4];
        float x = (float)i - 1.2f + 0.3f * (float)number, near = -1.5f - (float)i, far = -9 + (float)(number + i);
        glColor3ub((GLubyte)(colour >> 16), (GLubyte)(colour >> 8), (GLubyte)colour);
        glBegin(GL_QUADS);
        glVertex3f(x, -1, near);
        glVertex3f(x + 1, -1, far);
        glVertex3f(x + 1, 1, far);
        glVertex3f(x, 1, near);
        glEnd();
    }
}

/* A flat menu beside the scene. */
static void menu(int number)
{
    int colour = number % 2 ? WHITE : GREEN;
    glMatrixMode(GL_PROJECTION);
    glPushMatrix();
    glLoadIdentity();
    glOrtho(0, SIZE, 0, SIZE, -1, 1);
    glDisable(GL_DEPTH_TEST);
    glColor3ub((GLubyte)(colour >> 16), (GLubyte)(colour >> 8), (GLubyte)colour);
    glRecti(SIZE / 2 + 8, 4, SIZE - 4, SIZE / 2 + number);
    glEnable(GL_DEPTH_TEST);
    glPopMatrix();
    glMatrixMode(GL_MODELVIEW);
}

/* All pixels of a window in one number (FNV-1a). */
static void sum(const char *what, Drawable drawable)
{
    XSync(display, False);
    XImage *image = XGetImage(display, drawable, 0, 0, SIZE, SIZE, AllPlanes, ZPixmap);
    unsigned long sum = 2166136261u;
    for (int y = 0; image && y < SIZE; y++)
        for (int x = 0; x < SIZE; x++)
            sum = ((sum ^ (XGetPixel(image, x, y) & WHITE)) * 16777619) & 0xffffffff;
    printf("%s: %08lx\n", what, sum);
    if (image)
        XDestroyImage(image);
}

static void scenes(int apart)
{
    open_windows(SIZE);
    GLXContext first = open_context(NULL), second = apart ? open_context(NULL) : first;
    for (int frame = 0; frame < 6; frame++) {
        use(draws_a, draws_a, first);
        look();
        clear(GREY);
        part(frame);
        if (apart) {
            part(frame + 1);
            glXSwapBuffers(display, draws_a);
        }
        use(draws_b, draws_b, second);
        look();
        clear(BLUE);
        part(frame + 2);
        if (!apart) {
            use(draws_a, draws_a, first);
            part(frame + 1);
            use(draws_b, draws_b, second);
        }
        part(frame + 3);
        menu(frame);
        if (!apart)
            glXSwapBuffers(display, draws_a);
        glXSwapBuffers(display, draws_b);
        sum("first", a);
        sum("second", b);
    }
}

int swaps(const char *mode)
{
    if (is(mode, "one") || is(mode, "one-wide"))
        in_turn(1, is(mode, "one") ? SIZE : 2 * SIZE);
    else if (is(mode, "two") || is(mode, "two-wide"))
        in_turn(2, is(mode, "two") ? SIZE : 2 * SIZE);
    else if (is(mode, "plain"))
        plain(2, SIZE);
    else if (is(mode, "plain-one"))
        plain(1, 2 * SIZE);
    else if (is(mode, "back"))
        back();
    else if (is(mode, "both") || is(mode, "both-sharing"))
        both(is(mode, "both-sharing"));
    else if (is(mode, "none"))
        none();
    else if (is(mode, "thread") || is(mode, "thread-none"))
        thread(is(mode, "thread"));
    else if (is(mode, "thread-both"))
        thread_both();
    else if (is(mode, "pbuffer"))
        pbuffer();
    else if (is(mode, "pbuffer-other"))
        pbuffer_other();
    else if (is(mode, "buffers"))
        buffers();
    else if (is(mode, "again"))
        again();
    else if (is(mode, "destroyed") || is(mode, "destroyed-own"))
        destroyed(is(mode, "destroyed-own"));
    else if (is(mode, "scenes") || is(mode, "scenes-apart"))
        scenes(is(mode, "scenes-apart"));
    else
        return 0;
    return 1;
}
