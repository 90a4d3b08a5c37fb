/* A drawable to draw to, and another one to read from: a window and a pbuffer, or two windows.
 *
 *   pixels         glReadPixels, also of depths
 *   pixels-small   the same from a pbuffer that is smaller than the window
 *   then           the context has the drawable current for both first, and then another one to read from
 *   blit           glBlitFramebuffer of colours and of depths
 *   blit-scaled    the same with other sizes
 *   copy-texture   glCopyTexImage2D and glCopyTexSubImage2D
 *   copy-pixels    glCopyPixels
 *   framebuffer    from the drawable to a framebuffer of the program's, and back to the window
 *   read-buffer    glReadBuffer, and what glGet says of it
 *   swap           the drawable that is read from is swapped
 *   other          what another context has drawn is read */
#include "drawables.h"
#include <stdio.h>

static Window a, b;
static GLXWindow draws_a, draws_b;
static GLXPbuffer aside;
static GLXContext context;

/* The window has a red picture, the pbuffer a green one with depths of 0.25. */
static void open_both(int width, int height)
{
    open_display(0);
    a = open_window(0);
    b = open_window(1);
    draws_a = drawn(a);
    draws_b = drawn(b);
    aside = open_pbuffer(width, height);
    context = open_context(NULL);
    use(aside, aside, context);
    glViewport(0, 0, width, height);
    glClearDepth(0.25);
    clear(GREEN);
    middle(BLUE);
    use(draws_a, draws_a, context);
    glViewport(0, 0, SIZE, SIZE);
    glClearDepth(1);
    clear(RED);
    middle(WHITE);
}

static void depth(void)
{
    float depths[2] = {-1, -1};
    glReadPixels(2, 2, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, depths);
    glReadPixels(SIZE / 2, SIZE / 2, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, depths + 1);
    printf("depths: corner %.2f, middle %.2f, error 0x%x\n", depths[0], depths[1], glGetError());
}

static void read_pixels(int width, int height)
{
    open_both(width, height);
    use(draws_a, aside, context);
    pixels("pbuffer");
    depth();
    use(aside, draws_a, context);
    pixels("window");
    depth();
    use(draws_a, draws_a, context);
    glXSwapBuffers(display, draws_a);
    shown("window", a);
}

static void then(void)
{
    open_both(SIZE, SIZE);
    use(draws_a, draws_a, context);
    pixels("window");
    use(draws_a, aside, context);
    pixels("pbuffer");
    use(draws_a, draws_a, context);
    pixels("window");
}

static void blit(int scaled)
{
    open_both(SIZE, SIZE);
    use(draws_a, aside, context);
    glBlitFramebuffer(0, 0, SIZE, SIZE, 0, 0, SIZE, scaled ? SIZE / 2 + 8 : SIZE, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    if (!scaled)
        glBlitFramebuffer(0, 0, SIZE, SIZE, 0, 0, SIZE, SIZE, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
    printf("error 0x%x\n", glGetError());
    glXSwapBuffers(display, draws_a);
    shown("window", a);
    pixels("pbuffer");
    use(draws_a, draws_a, context);
    depth();
}

static void textured(const char *what)
{
    static unsigned char texels[SIZE * SIZE * 4];
    const unsigned char *corner = texels + 4 * (2 * SIZE + 2), *centre = texels + 4 * (SIZE / 2 * SIZE + SIZE / 2);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    printf("%s: corner %02x%02x%02x, middle %02x%02x%02x, error 0x%x\n", what, corner[0], corner[1], corner[2], centre[0], centre[1],
           centre[2], glGetError());
}

static void copy_texture(void)
{
    GLuint name;
    open_both(SIZE, SIZE);
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    use(draws_a, aside, context);
    glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 0, 0, SIZE, SIZE, 0);
    textured("pbuffer");
    use(draws_a, draws_a, context);
    glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, SIZE, SIZE / 2);
    textured("window below");
    use(draws_a, aside, context);
    glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, SIZE, SIZE / 2);
    textured("pbuffer again");
}

static void copy_pixels(void)
{
    open_both(SIZE, SIZE);
    use(draws_a, aside, context);
    glWindowPos2i(0, 0);
    glCopyPixels(0, 0, SIZE, SIZE / 2, GL_COLOR);
    glXSwapBuffers(display, draws_a);
    shown("window", a);
}

static void framebuffer(void)
{
    GLuint name, colours;
    open_both(SIZE, SIZE);
    glGenFramebuffers(1, &name);
    glGenRenderbuffers(1, &colours);
    use(draws_a, aside, context);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, name);
    glBindRenderbuffer(GL_RENDERBUFFER, colours);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, SIZE, SIZE);
    glFramebufferRenderbuffer(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colours);
    glBlitFramebuffer(0, 0, SIZE, SIZE, 0, 0, SIZE, SIZE, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, name);
    pixels("framebuffer");
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBlitFramebuffer(0, 0, SIZE, SIZE, 0, 0, SIZE, SIZE, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    pixels("pbuffer");
    glXSwapBuffers(display, draws_a);
    shown("window", a);
}

static void tell_buffers(const char *when)
{
    GLint draw, read;
    glGetIntegerv(GL_DRAW_BUFFER, &draw);
    glGetIntegerv(GL_READ_BUFFER, &read);
    printf("%s: draw buffer 0x%x, read buffer 0x%x, error 0x%x\n", when, (unsigned)draw, (unsigned)read, glGetError());
}

static void read_buffer(void)
{
    open_both(SIZE, SIZE);
    use(draws_a, aside, context);
    tell_buffers("at first");
    glReadBuffer(GL_NONE);
    tell_buffers("none");
    glReadBuffer(GL_BACK_LEFT);
    tell_buffers("back left");
    pixels("pbuffer");
    glDrawBuffer(GL_NONE);
    clear(BLUE);
    glDrawBuffer(GL_BACK);
    glReadBuffer(GL_BACK);
    tell_buffers("back");
    glXSwapBuffers(display, draws_a);
    shown("window", a);
}

static void swap(void)
{
    open_both(SIZE, SIZE);
    use(draws_b, draws_a, context);
    clear(BLUE);
    glXSwapBuffers(display, draws_a);
    shown("first", a);
    shown("second", b);
    glXSwapBuffers(display, draws_b);
    shown("first", a);
    shown("second", b);
}

static void other(void)
{
    open_both(SIZE, SIZE);
    use(draws_b, aside, open_context(NULL));
    clear(BLUE);
    pixels("pbuffer");
    glBlitFramebuffer(0, 0, SIZE, SIZE, 0, 0, SIZE, SIZE / 2, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glXSwapBuffers(display, draws_b);
    shown("second", b);
}

int reads(const char *mode)
{
    if (is(mode, "pixels"))
        read_pixels(SIZE, SIZE);
    else if (is(mode, "pixels-small"))
        read_pixels(SIZE / 2 + 2, SIZE);
    else if (is(mode, "then"))
        then();
    else if (is(mode, "blit") || is(mode, "blit-scaled"))
        blit(is(mode, "blit-scaled"));
    else if (is(mode, "copy-texture"))
        copy_texture();
    else if (is(mode, "copy-pixels"))
        copy_pixels();
    else if (is(mode, "framebuffer"))
        framebuffer();
    else if (is(mode, "read-buffer"))
        read_buffer();
    else if (is(mode, "swap"))
        swap();
    else if (is(mode, "other"))
        other();
    else
        return 0;
    return 1;
}
