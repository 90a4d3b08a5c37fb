/* What makes a picture visible, besides a swap:
 *
 *   sub            glXCopySubBufferMESA of a part of the window, which leaves the back buffer as it is
 *   sub-other      the same of a window that is not current any more
 *   front          glDrawBuffer(GL_FRONT) and glXWaitGL
 *   front-left     the same, and another context is made current
 *   front-both     glDrawBuffer(GL_FRONT_AND_BACK), glFlush and a swap
 *   single-wait    a window without a back buffer, and glXWaitGL
 *   single-left    the same, and no context is current any more
 *   single-next    the same, and the context is made current with another window
 *   single-swap    the same, and glXSwapBuffers
 *   single-ends    the same, and no context is current any more when the program has called exit
 *   single-blit    the same with a blit from a framebuffer of the program's alone, and glFlush
 *   pixmap         a pixmap, and glFlush
 *   pixmap-wait    the same, and glXWaitGL
 *   pixmap-left    the same, and no context is current any more
 *   texture        a pixmap that the context has drawn is bound as a texture (glXBindTexImageEXT) and drawn to a window
 *   texture-other  the same by another context */
#include "drawables.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void sub(int other)
{
    open_display(0);
    Window a = open_window(0), b = open_window(1);
    GLXWindow draws_a = drawn(a), draws_b = drawn(b);
    GLXContext context = open_context(NULL);
    use(draws_a, draws_a, context);
    clear(RED);
    middle(WHITE);
    if (other) {
        use(draws_b, draws_b, context);
        clear(BLUE);
    }
    glXCopySubBufferMESA(display, draws_a, 0, 0, SIZE, SIZE / 2 + 8);
    shown("lower part", a);
    pixels("back buffer");
    glXCopySubBufferMESA(display, draws_a, 0, 0, SIZE, SIZE);
    shown("all", a);
    clear(GREEN);
    glXSwapBuffers(display, other ? draws_b : draws_a);
    shown("swapped", other ? b : a);
}

static void front(int left)
{
    open_display(0);
    Window a = open_window(0), b = open_window(1);
    GLXContext first = open_context(NULL), second = open_context(NULL);
    use(a, a, first);
    glDrawBuffer(GL_FRONT);
    clear(RED);
    middle(WHITE);
    if (left)
        use(b, b, second);
    else
        glXWaitGL();
    shown("front", a);
}

static void front_both(void)
{
    open_display(0);
    Window a = open_window(0);
    GLXWindow draws_a = drawn(a);
    use(draws_a, draws_a, open_context(NULL));
    glDrawBuffer(GL_FRONT_AND_BACK);
    clear(RED);
    middle(WHITE);
    glReadBuffer(GL_FRONT);
    pixels("front buffer");
    glReadBuffer(GL_BACK);
    pixels("back buffer");
    glFlush();
    shown("flushed", a);
    glDrawBuffer(GL_BACK);
    middle(BLUE);
    pixels("back buffer alone");
    glReadBuffer(GL_FRONT);
    pixels("front buffer");
    glFlush();
    shown("flushed", a);
    glXSwapBuffers(display, draws_a);
    shown("swapped", a);
    glDrawBuffer(GL_FRONT_AND_BACK);
    clear(GREEN);
    middle(RED);
    glXSwapBuffers(display, draws_a);
    shown("swapped", a);
}

static void single_blit(void)
{
    open_display(1);
    Window a = open_window(0);
    use(a, a, open_context(NULL));
    use_framebuffer();
    clear(RED);
    middle(WHITE);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBlitFramebuffer(0, 0, SIZE, SIZE, 0, 0, SIZE, SIZE, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glFlush();
    shown("window", a);
}

static void end(void)
{
    use(None, None, NULL);
    puts("ended");
}

static void single(const char *how)
{
    open_display(1);
    Window a = open_window(0), b = open_window(1);
    GLXContext context = open_context(NULL);
    use(a, a, context);
    if (is(how, "single-ends"))
        atexit(end);
    clear(RED);
    middle(WHITE);
    if (is(how, "single-ends"))
        exit(0);
    if (is(how, "single-wait"))
        glXWaitGL();
    else if (is(how, "single-left"))
        use(None, None, NULL);
    else if (is(how, "single-next"))
        use(b, b, context);
    else
        glXSwapBuffers(display, a);
    shown("first", a);
    if (!is(how, "single-next"))
        return;
    clear(BLUE);
    glXWaitGL();
    shown("first", a);
    shown("second", b);
}

static void pixmap(const char *how)
{
    Pixmap behind;
    open_display(1);
    GLXPixmap drawable = open_pixmap(&behind);
    use(drawable, drawable, open_context(NULL));
    clear(RED);
    middle(WHITE);
    if (is(how, "pixmap"))
        glFlush();
    else if (is(how, "pixmap-wait"))
        glXWaitGL();
    else
        use(None, None, NULL);
    shown("pixmap", behind);
}

static void texture(int other)
{
    GLuint name;
    Pixmap behind;
    open_display(1);
    Window a = open_window(0);
    GLXPixmap drawable = open_pixmap(&behind);
    GLXContext first = open_context(NULL);
    use(drawable, drawable, first);
    clear(RED);
    middle(WHITE);
    use(a, a, other ? open_context(NULL) : first);
    clear(BLUE);
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glXBindTexImageEXT(display, drawable, GLX_FRONT_LEFT_EXT, NULL);
    glEnable(GL_TEXTURE_2D);
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
    glBegin(GL_QUADS);
    for (int i = 0; i < 4; i++) {
        int x = i == 1 || i == 2, y = i > 1;
        glTexCoord2i(x, y);
        glVertex2i(2 * x - 1, 2 * y - 1);
    }
    glEnd();
    pixels("textured");
    glFlush();
    shown("window", a);
}

int presents(const char *mode)
{
    if (is(mode, "sub") || is(mode, "sub-other"))
        sub(is(mode, "sub-other"));
    else if (is(mode, "front") || is(mode, "front-left"))
        front(is(mode, "front-left"));
    else if (is(mode, "front-both"))
        front_both();
    else if (is(mode, "single-blit"))
        single_blit();
    else if (!strncmp(mode, "single-", 7))
        single(mode);
    else if (!strncmp(mode, "pixmap", 6))
        pixmap(mode);
    else if (is(mode, "texture") || is(mode, "texture-other"))
        texture(is(mode, "texture-other"));
    else
        return 0;
    return 1;
}
