/* Prints what a program reads back of its framebuffer 0, one `name = value` a line: run it with and without a layer and compare by diff.
 * Pixels are printed as a hash. One frame is enough. */
#include "demo.h"
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

DEMO_NO_OPTIONS;
int demo_accumulation = 2;

static int version; /* such as 45 for OpenGL 4.5 */

static void say(const char *name, const char *detail, long long value)
{
    printf("%s%s%s = %lld\n", name, *detail ? " " : "", detail, value);
}

static void error(const char *after)
{
    GLenum e;
    do
        printf("error after %s = 0x%04x\n", after, e = glGetError());
    while (e);
}

static void hash_pixels(const char *name, GLenum format, GLenum type, int bytes)
{
    size_t size = (size_t)demo_width * (size_t)demo_height * (size_t)bytes;
    unsigned char *p = calloc(size, 1);
    uint64_t h = 14695981039346656037u;
    if (!p)
        demo_fail(1, "out of memory");
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(demo_x, demo_y, demo_width, demo_height, format, type, p);
    for (size_t i = 0; i < size; i++)
        h = (h ^ p[i]) * 1099511628211u;
    printf("%s = %016llx\n", name, (unsigned long long)h);
    free(p);
}

static void hash_all(const char *when)
{
    char name[80];
    snprintf(name, sizeof name, "%s colour", when);
    hash_pixels(name, GL_RGBA, GL_UNSIGNED_BYTE, 4);
    snprintf(name, sizeof name, "%s depth", when);
    hash_pixels(name, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, 4);
    snprintf(name, sizeof name, "%s stencil", when);
    hash_pixels(name, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, 1);
    error(when);
}

static void picture(void)
{
    static const GLubyte a[3] = {255, 200, 60}, b[3] = {40, 80, 180};
    static GLuint texture;
    if (!texture)
        texture = demo_checker(64, 8, a, b);
    glBindTexture(GL_TEXTURE_2D, texture);
    demo_viewport(0, 0, demo_width, demo_height);
    glClearColor(0.2f, 0.1f, 0.3f, 0.5f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    demo_perspective(45.0, (double)demo_width / demo_height, 1.0, 50.0);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslated(0.0, 0.0, -7.0);
    glRotated(30.0, 1.0, 1.0, 0.0);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_TEXTURE_2D);
    glEnable(GL_STENCIL_TEST);
    glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);
    demo_torus(1.8, 0.6, 40, 20);
    demo_box(0.9, 0.9, 0.9);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_TEXTURE_2D);
}

static void flat_square(void) /* draws the bound texture over the middle of the picture */
{
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_TEXTURE_2D);
    glColor3f(1.0f, 1.0f, 1.0f);
    glBegin(GL_QUADS);
    glTexCoord2i(0, 0); glVertex2f(-0.7f, -0.7f);
    glTexCoord2i(1, 0); glVertex2f(0.7f, -0.7f);
    glTexCoord2i(1, 1); glVertex2f(0.7f, 0.7f);
    glTexCoord2i(0, 1); glVertex2f(-0.7f, 0.7f);
    glEnd();
    glDisable(GL_TEXTURE_2D);
    glEnable(GL_DEPTH_TEST);
}

static void copies(void)
{
    GLuint t;
    GLint width = 0;
    glGenTextures(1, &t);
    glBindTexture(GL_TEXTURE_2D, t);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, demo_x, demo_y, demo_width, demo_height, 0);
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &width);
    say("glCopyTexImage2D width", "", width);
    flat_square();
    hash_all("glCopyTexImage2D");
    glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 7, 9, demo_x + 200, demo_y + 150, 100, 80);
    flat_square();
    hash_all("glCopyTexSubImage2D");
    glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, demo_x, demo_y, demo_width, demo_height, 0);
    flat_square();
    hash_all("glCopyTexImage2D of depth");
    glDeleteTextures(1, &t);
}

static void gets(const char *when)
{
#define NAME(x) {x, #x}
    static const struct { GLenum name; const char *text; } names[] = {
        NAME(GL_DRAW_FRAMEBUFFER_BINDING), NAME(GL_READ_FRAMEBUFFER_BINDING), NAME(GL_DRAW_BUFFER), NAME(GL_READ_BUFFER),
        NAME(GL_DRAW_BUFFER0), NAME(GL_DRAW_BUFFER1), NAME(GL_DOUBLEBUFFER), NAME(GL_STEREO), NAME(GL_SAMPLES),
        NAME(GL_SAMPLE_BUFFERS), NAME(GL_RED_BITS), NAME(GL_GREEN_BITS), NAME(GL_BLUE_BITS), NAME(GL_ALPHA_BITS),
        NAME(GL_DEPTH_BITS), NAME(GL_STENCIL_BITS), NAME(GL_ACCUM_RED_BITS), NAME(GL_AUX_BUFFERS), NAME(GL_RGBA_MODE),
        NAME(GL_IMPLEMENTATION_COLOR_READ_FORMAT), NAME(GL_IMPLEMENTATION_COLOR_READ_TYPE), NAME(GL_FRAMEBUFFER_SRGB),
        NAME(GL_MAX_DRAW_BUFFERS), NAME(GL_RENDERBUFFER_BINDING), NAME(GL_TEXTURE_BINDING_2D), NAME(GL_SCISSOR_TEST),
        NAME(GL_CURRENT_PROGRAM), NAME(GL_ARRAY_BUFFER_BINDING), NAME(GL_MAX_CLIP_PLANES), NAME(GL_MATRIX_MODE),
        NAME(GL_VIEWPORT), NAME(GL_SCISSOR_BOX), NAME(GL_COLOR_WRITEMASK)};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        GLenum n = names[i].name;
        int count = n == GL_VIEWPORT || n == GL_SCISSOR_BOX || n == GL_COLOR_WRITEMASK ? 4 : 1;
        GLint v[16] = {0};
        GLboolean b[16] = {0};
        GLfloat f[16] = {0};
        GLdouble d[16] = {0};
        GLint64 l[16] = {0};
        glGetIntegerv(n, v);
        glGetBooleanv(n, b);
        glGetFloatv(n, f);
        glGetDoublev(n, d);
        if (version >= 32)
            ((PFNGLGETINTEGER64VPROC)demo_proc("glGetInteger64v"))(n, l);
        for (int k = 0; k < count; k++)
            printf("%s %s[%d] = %d %d %g %g %lld\n", when, names[i].text, k, v[k], b[k], f[k], d[k], (long long)l[k]);
        GLenum e = glGetError();
        if (e)
            printf("%s %s error = 0x%04x\n", when, names[i].text, e);
    }
}

static void attachments(const char *when)
{
    static const GLenum points[] = {GL_BACK_LEFT, GL_FRONT_LEFT, GL_BACK_RIGHT, GL_DEPTH, GL_STENCIL, GL_COLOR_ATTACHMENT0};
    static const GLenum asked[] = {GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME,
        GL_FRAMEBUFFER_ATTACHMENT_RED_SIZE, GL_FRAMEBUFFER_ATTACHMENT_ALPHA_SIZE, GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE,
        GL_FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE, GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE, GL_FRAMEBUFFER_ATTACHMENT_COLOR_ENCODING};
    for (size_t i = 0; i < sizeof points / sizeof *points; i++)
        for (size_t k = 0; k < sizeof asked / sizeof *asked; k++) {
            GLint v = -1;
            glGetFramebufferAttachmentParameteriv(GL_FRAMEBUFFER, points[i], asked[k], &v);
            printf("%s attachment 0x%04x 0x%04x = %d error 0x%04x\n", when, points[i], asked[k], v, glGetError());
        }
    say(when, "glCheckFramebufferStatus", glCheckFramebufferStatus(GL_FRAMEBUFFER));
    say(when, "glIsFramebuffer(0)", glIsFramebuffer(0));
    error("attachments");
}

static void illegal(GLuint texture)
{
    static const GLenum bad[] = {GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, GL_AUX0, GL_BACK_RIGHT};
    GLenum list[2] = {GL_COLOR_ATTACHMENT0, GL_NONE};
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    error("glFramebufferTexture2D on 0");
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, 0);
    error("glFramebufferRenderbuffer on 0");
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        glDrawBuffer(bad[i]);
        error("glDrawBuffer of an illegal value");
        glReadBuffer(bad[i]);
        error("glReadBuffer of an illegal value");
    }
    glDrawBuffers(1, list);
    error("glDrawBuffers of an attachment");
    glBindFramebuffer(GL_FRAMEBUFFER, 4242);
    error("glBindFramebuffer of a foreign name");
    glBindFramebuffer(GL_TEXTURE_2D, 0);
    error("glBindFramebuffer of a wrong target");
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glEnable(0x1234); /* of two errors the first is kept */
    glBegin(GL_TRIANGLES);
    glEnd();
    glViewport(0, 0, -1, -1);
    error("two errors");
    glBegin(GL_POINTS);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glEnd();
    error("glBindFramebuffer in begin/end");
    glEnd();
    error("glEnd alone");
    glReadPixels(0, 0, 1, 1, 0x1234, GL_UNSIGNED_BYTE, list);
    error("glReadPixels of a wrong format");
    say("glGetError in begin/end", "", (glBegin(GL_POINTS), (long long)glGetError()));
    glEnd();
    error("glGetError in begin/end");
}

static void accumulation(void)
{
    GLint bits[4];
    GLuint fbo;
    GLfloat clear[4];
    static const GLenum names[4] = {GL_ACCUM_RED_BITS, GL_ACCUM_GREEN_BITS, GL_ACCUM_BLUE_BITS, GL_ACCUM_ALPHA_BITS};
    for (int i = 0; i < 4; i++) {
        glGetIntegerv(names[i], &bits[i]);
        say("accumulation bits", "", bits[i]);
    }
    error("accumulation bits");
    glAccum(GL_LOAD, 0.5f);
    error("glAccum(GL_LOAD)");
    glAccum(GL_DEPTH, 0.5f);
    error("glAccum(GL_DEPTH)");
    glClearAccum(0.3f, -0.2f, 2.0f, 0.1f);
    glGetFloatv(GL_ACCUM_CLEAR_VALUE, clear);
    printf("accumulation clear = %g %g %g %g\n", clear[0], clear[1], clear[2], clear[3]);
    glAccum(GL_RETURN, 1.9f);
    hash_all("accumulation loaded");
    glClear(GL_ACCUM_BUFFER_BIT | 0x80000);
    error("glClear of an unknown buffer");
    demo_scissor(7, 9, 60, 50);
    glClear(GL_ACCUM_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glAccum(GL_ADD, 0.1f);
    demo_scissor_off();
    glColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
    glAccum(GL_RETURN, 1.1f);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    hash_all("accumulation cleared in part");
    glAccum(GL_ACCUM, 0.37f);
    glAccum(GL_MULT, -0.83f);
    glAccum(GL_RETURN, -1.3f);
    hash_all("accumulation multiplied");
    glGetError();
    glReadBuffer(GL_NONE); /* nothing is read, without an error */
    glAccum(GL_LOAD, 0.9f);
    glReadBuffer(GL_BACK);
    glGetError();
    glRenderMode(GL_FEEDBACK); /* nothing is drawn */
    glAccum(GL_LOAD, 0.8f);
    glRenderMode(GL_RENDER);
    error("glAccum in feedback");
    glEnable(GL_RASTERIZER_DISCARD);
    glAccum(GL_LOAD, 0.7f);
    glDisable(GL_RASTERIZER_DISCARD);
    glAccum(GL_RETURN, -0.9f);
    hash_all("accumulation unchanged");
    glBegin(GL_POINTS);
    glAccum(GL_LOAD, 0.6f);
    glEnd();
    glGetError();
    glGenFramebuffers(1, &fbo);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, fbo);
    glAccum(GL_MULT, 0.5f);
    error("glAccum with an own framebuffer to read from");
    glBindFramebuffer(GL_FRAMEBUFFER, fbo);
    glAccum(GL_MULT, 0.5f);
    error("glAccum with an own framebuffer");
    glGetIntegerv(GL_ACCUM_RED_BITS, bits);
    say("accumulation bits of an own framebuffer", "", bits[0]);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDeleteFramebuffers(1, &fbo);
    glAccum(GL_RETURN, -1.0f);
    hash_all("accumulation at the end");
}

/* A framebuffer object of its own: draw into it, come back, and copy both ways. */
static void own_framebuffer(void)
{
    GLuint fbo, colour, depth;
    GLint draw, read;
    glGenFramebuffers(1, &fbo);
    say("first framebuffer name", "", fbo);
    glGenTextures(1, &colour);
    say("next texture name", "", colour);
    glBindTexture(GL_TEXTURE_2D, colour);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 128, 128, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    glGenRenderbuffers(1, &depth);
    say("first renderbuffer name", "", depth);
    glBindRenderbuffer(GL_RENDERBUFFER, depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, 128, 128);
    glGetIntegerv(GL_DRAW_BUFFER, &draw);
    glGetIntegerv(GL_READ_BUFFER, &read);
    glReadBuffer(GL_NONE); /* framebuffer 0 must keep this one */
    error("glReadBuffer(GL_NONE)");

    glBindFramebuffer(GL_FRAMEBUFFER, fbo);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour, 0);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, depth);
    gets("own");
    attachments("own");
    glDrawBuffer(GL_BACK);
    error("glDrawBuffer(GL_BACK) on an own framebuffer");
    glDisable(GL_SCISSOR_TEST);
    glViewport(0, 0, 128, 128);
    glClearColor(0.1f, 0.7f, 0.4f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    demo_perspective(45.0, 1.0, 1.0, 50.0);
    glLoadIdentity();
    glTranslated(0.0, 0.0, -5.0);
    demo_torus(1.0, 0.5, 20, 10);
    unsigned char middle[4];
    glReadPixels(90, 64, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, middle);
    printf("own pixel = %d %d %d %d\n", middle[0], middle[1], middle[2], middle[3]);

    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    gets("back at 0 with read buffer none");
    glReadBuffer((GLenum)read);
    demo_scissor_off();
    demo_viewport(0, 0, demo_width, demo_height);
    picture();
    glBindFramebuffer(GL_READ_FRAMEBUFFER, fbo);
    gets("read own, draw 0");
    glBlitFramebuffer(0, 0, 128, 128, demo_x + 10, demo_y + 10, demo_x + 138, demo_y + 138, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    error("blit to 0");
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    hash_all("blit to 0");
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, fbo);
    gets("read 0, draw own");
    /* copies of equal size, which are also legal from a multisampled framebuffer 0 */
    glBlitFramebuffer(demo_x + 150, demo_y + 100, demo_x + 250, demo_y + 200, 150, 100, 250, 200, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBlitFramebuffer(demo_x, demo_y, demo_x + 128, demo_y + 128, 0, 0, 128, 128, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    error("blit from 0");
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glBindTexture(GL_TEXTURE_2D, colour);
    flat_square();
    hash_all("blit from 0, drawn");

    if (version >= 45) { /* the named variants */
        GLint v = -1;
        PFNGLGETNAMEDFRAMEBUFFERPARAMETERIVPROC parameter =
            (PFNGLGETNAMEDFRAMEBUFFERPARAMETERIVPROC)demo_proc("glGetNamedFramebufferParameteriv");
        PFNGLGETNAMEDFRAMEBUFFERATTACHMENTPARAMETERIVPROC attachment =
            (PFNGLGETNAMEDFRAMEBUFFERATTACHMENTPARAMETERIVPROC)demo_proc("glGetNamedFramebufferAttachmentParameteriv");
        static const GLenum asked[] = {GL_DOUBLEBUFFER, GL_STEREO, GL_SAMPLES, GL_SAMPLE_BUFFERS,
                                       GL_IMPLEMENTATION_COLOR_READ_FORMAT, GL_FRAMEBUFFER_DEFAULT_WIDTH};
        for (size_t i = 0; i < sizeof asked / sizeof *asked; i++, v = -1) {
            parameter(0, asked[i], &v);
            printf("named 0 0x%04x = %d error 0x%04x\n", asked[i], v, glGetError());
        }
        attachment(0, GL_BACK_LEFT, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &v);
        printf("named 0 back left type = 0x%04x error 0x%04x\n", v, glGetError());
        say("named status 0", "", ((PFNGLCHECKNAMEDFRAMEBUFFERSTATUSPROC)demo_proc("glCheckNamedFramebufferStatus"))(0, GL_FRAMEBUFFER));
        ((PFNGLNAMEDFRAMEBUFFERDRAWBUFFERPROC)demo_proc("glNamedFramebufferDrawBuffer"))(0, GL_NONE);
        ((PFNGLNAMEDFRAMEBUFFERREADBUFFERPROC)demo_proc("glNamedFramebufferReadBuffer"))(0, GL_NONE);
        gets("named none");
        glClear(GL_COLOR_BUFFER_BIT); /* draws nothing */
        ((PFNGLNAMEDFRAMEBUFFERDRAWBUFFERPROC)demo_proc("glNamedFramebufferDrawBuffer"))(0, (GLenum)draw);
        ((PFNGLNAMEDFRAMEBUFFERREADBUFFERPROC)demo_proc("glNamedFramebufferReadBuffer"))(0, (GLenum)read);
        ((PFNGLNAMEDFRAMEBUFFERTEXTUREPROC)demo_proc("glNamedFramebufferTexture"))(0, GL_COLOR_ATTACHMENT0, colour, 0);
        error("glNamedFramebufferTexture on 0");
        ((PFNGLBLITNAMEDFRAMEBUFFERPROC)demo_proc("glBlitNamedFramebuffer"))(fbo, 0, 0, 0, 64, 64, demo_x + 200, demo_y + 100,
            demo_x + 264, demo_y + 164, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        hash_all("named blit");
        const GLfloat red[4] = {1, 0, 0, 1};
        ((PFNGLCLEARNAMEDFRAMEBUFFERFVPROC)demo_proc("glClearNamedFramebufferfv"))(0, GL_COLOR, 0, red);
        hash_all("named clear");
    }
    illegal(colour);
    glDeleteFramebuffers(1, &fbo);
    glDeleteRenderbuffers(1, &depth);
    glDeleteTextures(1, &colour);
}

void demo_setup(void)
{
    const char *v = (const char *)glGetString(GL_VERSION);
    version = (v[0] - '0') * 10 + (v[2] - '0');
    printf("GL_VERSION = %s\nGL_VENDOR = %s\nGL_RENDERER = %s\n", v, glGetString(GL_VENDOR), glGetString(GL_RENDERER));
    const char *e = (const char *)glGetString(GL_EXTENSIONS);
    uint64_t h = 14695981039346656037u;
    for (; e && *e; e++)
        h = (h ^ (unsigned char)*e) * 1099511628211u;
    printf("GL_EXTENSIONS = %016llx\n", (unsigned long long)h);
    if (version < 30)
        demo_fail(1, "needs OpenGL 3.0");
    gets("start");
    attachments("start");
    error("setup");
}

void demo_frame(int frame)
{
    say("frame", "", frame);
    picture();
    gets("drawn");
    hash_all("drawn");
    copies();
    own_framebuffer();
    picture();
    accumulation();
    picture();
    demo_viewport(3, 5, 77, 66);
    demo_scissor(9, 8, 70, 60);
    gets("viewport and scissor set");
    demo_scissor_off();
    hash_all("end");
    fflush(stdout);
}
