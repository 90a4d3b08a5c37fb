/* A window grows, or a larger one is drawn to, and the memory for all of its views cannot be had (refuses.c): every window of the process
 * shows what the program draws all the same.
 *
 *   grows          the window grows while another window is there, whose context then draws on
 *   grows-buffer   the same, drawn to the front buffer
 *   grows-texture  the same with a picture in a texture, drawn before
 *   grows-bound    the same with a framebuffer of the program's bound
 *   grows-thread   the same while another thread draws to the other window
 *   grows-back     the window shrinks again
 *   larger         a context goes to a larger window, and back
 *   small          a window that is small enough, after a larger one
 *   at-once        the first window is too large
 *
 * Other images that the layer needs on the way, one of which is refused:
 *
 *   beyond         a read that reaches beyond the window
 *   apart          a picture in a texture, shown by a blit
 *   front-refused  a picture in the front buffer */
#include "drawables.h"
#include <pthread.h>
#include <stdio.h>

enum { LARGE = 4 * SIZE };

static Window a, b;
static GLXContext first, second;

static void picture(int width, int outside, int inside)
{
    glViewport(0, 0, width, SIZE);
    clear(outside);
    middle(inside);
}

static void frame(const char *what, Window window, int width, int outside, int inside)
{
    picture(width, outside, inside);
    pixels(what);
    glXSwapBuffers(display, window);
    shown(what, window);
}

static void open_windows(void)
{
    open_display(0);
    a = open_window(0);
    b = open_window(1);
    first = open_context(NULL);
    second = open_context(NULL);
    use(b, b, second);
    frame("second", b, SIZE, RED, WHITE);
    use(a, a, first);
    frame("first", a, SIZE, BLUE, GREEN);
}

static void resize(Window window, unsigned width)
{
    XResizeWindow(display, window, width, SIZE);
    XSync(display, False);
    /* Drivers follow with the next frame. */
    glClear(GL_COLOR_BUFFER_BIT);
    glXSwapBuffers(display, window);
}

static void grows(int back)
{
    open_windows();
    XMoveWindow(display, b, 0, 2 * SIZE);
    resize(a, LARGE);
    frame("grown", a, LARGE, RED, GREEN);
    if (back)
        resize(a, SIZE);
    frame("first", a, back ? SIZE : LARGE, WHITE, BLUE);
    use(b, b, second);
    frame("second", b, SIZE, GREEN, RED);
    frame("second", b, SIZE, BLUE, WHITE);
}

static void grows_buffer(void)
{
    open_windows();
    XMoveWindow(display, b, 0, 2 * SIZE);
    use(b, b, second);
    glDrawBuffer(GL_FRONT);
    picture(SIZE, GREEN, BLUE);
    glFlush();
    use(a, a, first);
    resize(a, LARGE);
    use(b, b, second);
    picture(SIZE, RED, WHITE);
    glFlush();
    shown("front", b);
    glDrawBuffer(GL_BACK);
    frame("second", b, SIZE, WHITE, GREEN);
}

/* A texture with a picture that is not the same in all views, in a framebuffer of the program's. */
static GLuint beside(void)
{
    GLuint texture, framebuffer;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, SIZE, SIZE, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    glViewport(0, 0, SIZE, SIZE);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-1, 1, -1, 1, 1, 10);
    clear(RED);
    glColor3ub(255, 255, 255);
    glBegin(GL_TRIANGLES);
    glVertex3f(-2, -2, -2);
    glVertex3f(6, -2, -4);
    glVertex3f(-2, 6, -3);
    glEnd();
    glLoadIdentity();
    return framebuffer;
}

static void grows_texture(int bound)
{
    open_windows();
    GLuint framebuffer = beside();
    if (!bound)
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
    resize(a, LARGE);
    if (bound) {
        pixels("framebuffer");
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    } else {
        frame("grown", a, LARGE, RED, GREEN);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
        pixels("framebuffer");
    }
    glBlitFramebuffer(0, 0, SIZE, SIZE, 0, 0, SIZE, SIZE, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glXSwapBuffers(display, a);
    shown("window", a);
}

static pthread_barrier_t turn;

static void *draw_on(void *unused)
{
    pthread_barrier_wait(&turn);
    use(b, b, second);
    picture(SIZE, GREEN, RED);
    pthread_barrier_wait(&turn);
    pthread_barrier_wait(&turn);
    glXSwapBuffers(display, b);
    shown("second", b);
    frame("second", b, SIZE, BLUE, WHITE);
    use(None, None, NULL);
    return unused;
}

static void grows_thread(void)
{
    pthread_t other;
    open_windows();
    XMoveWindow(display, b, 0, 2 * SIZE);
    pthread_barrier_init(&turn, NULL, 2);
    pthread_create(&other, NULL, draw_on, NULL);
    pthread_barrier_wait(&turn);
    pthread_barrier_wait(&turn);
    resize(a, LARGE);
    frame("grown", a, LARGE, RED, GREEN);
    pthread_barrier_wait(&turn);
    pthread_join(other, NULL);
}

static void larger(void)
{
    open_windows();
    Window large = open_wide_window(2, LARGE);
    for (int turn = 0; turn < 2; turn++) {
        use(large, large, first);
        frame("large", large, LARGE, turn ? BLUE : RED, GREEN);
        use(a, a, first);
        frame("first", a, SIZE, turn ? RED : WHITE, BLUE);
    }
}

static void at_once(int small)
{
    open_display(0);
    a = open_wide_window(0, LARGE);
    first = open_context(NULL);
    use(a, a, first);
    frame("large", a, LARGE, RED, GREEN);
    if (small) {
        b = open_window(3);
        second = open_context(NULL);
        use(b, b, second);
        frame("small", b, SIZE, BLUE, WHITE);
        use(a, a, first);
    }
    frame("large", a, LARGE, GREEN, BLUE);
}

static void beyond(void)
{
    static unsigned char row[SIZE][4];
    open_display(0);
    a = open_window(0);
    use(a, a, open_context(NULL));
    picture(SIZE, RED, WHITE);
    glReadPixels(SIZE / 2, SIZE / 2, SIZE, 1, GL_RGBA, GL_UNSIGNED_BYTE, row);
    printf("inside: %02x%02x%02x, %02x%02x%02x, error 0x%x\n", row[0][0], row[0][1], row[0][2], row[SIZE / 2 - 1][0], row[SIZE / 2 - 1][1],
           row[SIZE / 2 - 1][2], glGetError());
    glXSwapBuffers(display, a);
    shown("window", a);
}

static void apart(void)
{
    open_display(0);
    a = open_window(0);
    use(a, a, open_context(NULL));
    beside();
    pixels("framebuffer");
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBlitFramebuffer(0, 0, SIZE, SIZE, 0, 0, SIZE, SIZE, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glXSwapBuffers(display, a);
    shown("window", a);
}

static void front_refused(void)
{
    open_display(0);
    a = open_window(0);
    use(a, a, open_context(NULL));
    glDrawBuffer(GL_FRONT);
    picture(SIZE, RED, WHITE);
    glFlush();
    shown("front", a);
    glDrawBuffer(GL_BACK);
    frame("back", a, SIZE, BLUE, GREEN);
}

int growths(const char *mode)
{
    if (is(mode, "grows") || is(mode, "grows-back"))
        grows(is(mode, "grows-back"));
    else if (is(mode, "grows-buffer"))
        grows_buffer();
    else if (is(mode, "grows-texture") || is(mode, "grows-bound"))
        grows_texture(is(mode, "grows-bound"));
    else if (is(mode, "grows-thread"))
        grows_thread();
    else if (is(mode, "larger"))
        larger();
    else if (is(mode, "at-once") || is(mode, "small"))
        at_once(is(mode, "small"));
    else if (is(mode, "beyond"))
        beyond();
    else if (is(mode, "apart"))
        apart();
    else if (is(mode, "front-refused"))
        front_refused();
    else
        return 0;
    return 1;
}
