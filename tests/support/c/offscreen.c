/* Framebuffers of a program's own, with a scene in them: prints their state, their pixels and errors, while it attaches other images, gives
 * them new storage, reads, copies, blits, deletes. The frame shows the last one. */
#include "shaders.h"
#include "surface.h"

enum { PLACE = 3 };

static const char *const vertex = "#version 120\nuniform mat4 camera; uniform float depth; attribute vec2 place;\n"
                                  "void main() { gl_Position = camera * vec4(place * depth * 0.4, -depth, 1.0); }\n";
static const char *const fragment = "uniform vec4 colour; void main() { gl_FragColor = colour; }";
static const char *const whole = "attribute vec2 place; varying vec2 at; void main() { at = place * 0.5 + 0.5; gl_Position = vec4(place, 0.0, 1.0); }";
static const char *const picture = "uniform sampler2D image; varying vec2 at; void main() { gl_FragColor = texture2D(image, at); }";
static const char *const fetching = "#version 120\nuniform sampler2D image; varying vec4 told;\n"
                                    "void main() { told = texture2DLod(image, vec2(0.1), 0.0); gl_Position = vec4(0.0); }\n";
static GLuint scene, shown, target[2], depth, colours[2];

static void draw(GLuint program, float depth, float r, float g, float b)
{
    const GLfloat camera[16] = {1.5f, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.04f, -1, 0, 0, -2.04f, 0};
    glUseProgram(program);
    if (program == scene) {
        glUniformMatrix4fv(glGetUniformLocation(scene, "camera"), 1, 0, camera);
        glUniform1f(glGetUniformLocation(scene, "depth"), depth);
        glUniform4f(glGetUniformLocation(scene, "colour"), r, g, b, 1.0f);
    }
    quad(PLACE);
}

static GLuint texture(int width, int height)
{
    GLuint name;
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return name;
}

/* The layer shifts the names, so their order is printed. */
static int which(GLint name, const GLuint *among, int count)
{
    for (int i = 0; i < count; i++)
        if (name && (GLuint)name == among[i])
            return i + 1;
    return name ? -1 : 0;
}

static void tell(const char *what, int x, int y)
{
    GLint bound[3], of[3];
    unsigned char pixel[4];
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound[0]);
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &bound[1]);
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound[2]);
    glGetFramebufferAttachmentParameteriv(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &of[0]);
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &of[1]);
    glGetIntegerv(GL_RENDERBUFFER_BINDING, &of[2]);
    glReadPixels(x, y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
    printf("%s: bound %d %d, texture %d, renderbuffer %d, a 0x%x, width %d, status 0x%x, pixel %d %d %d, error 0x%x\n", what, which(bound[0], target, 2),
           which(bound[1], target, 2), which(bound[2], colours, 2), which(of[2], &depth, 1), of[0], of[1], glCheckFramebufferStatus(GL_FRAMEBUFFER), pixel[0], pixel[1], pixel[2], glGetError());
}

/* Prints the texels of the bound texture that a vertex shader reads. */
static void fed(void)
{
    static const char *const names[] = {"told"};
    GLfloat told[4] = {0};
    GLuint program = linked(fetching, fragment, PLACE), buffer;
    glTransformFeedbackVaryings(program, 1, names, GL_INTERLEAVED_ATTRIBS);
    glLinkProgram(program);
    glGenBuffers(1, &buffer);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
    glBufferData(GL_TRANSFORM_FEEDBACK_BUFFER, sizeof told, NULL, GL_STREAM_READ);
    glUseProgram(program);
    glBeginTransformFeedback(GL_POINTS);
    glDrawArrays(GL_POINTS, 0, 1);
    glEndTransformFeedback();
    glGetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0, sizeof told, told);
    printf("fed back: %g %g %g, error 0x%x\n", told[0], told[1], told[2], glGetError());
}

static void image(const char *what)
{
    unsigned char all[WIDTH * HEIGHT * 4];
    unsigned sum = 0;
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, all);
    for (int i = 0; i < WIDTH * HEIGHT * 4; i++)
        sum = sum * 31 + all[i];
    printf("%s: image %08x, error 0x%x\n", what, sum, glGetError());
}

int main(void)
{
    EGLContext context;
    if (!open_surface() || !(context = new_context(EGL_NO_CONTEXT)))
        return 2;
    scene = linked(vertex, fragment, PLACE), shown = linked(whole, picture, PLACE);
    glGenFramebuffers(2, target);
    glGenRenderbuffers(1, &depth);
    glBindRenderbuffer(GL_RENDERBUFFER, depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, WIDTH, HEIGHT);
    colours[0] = texture(WIDTH, HEIGHT), colours[1] = texture(WIDTH, HEIGHT);
    glEnable(GL_DEPTH_TEST);

    glBindFramebuffer(GL_FRAMEBUFFER, target[0]);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colours[0], 0);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw(scene, 20, 1, 0, 0);
    tell("a scene", 32, 24);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colours[1], 0);
    glClear(GL_COLOR_BUFFER_BIT);
    draw(scene, 10, 0, 1, 0);
    tell("another image", 32, 24);
    image("of the other");
    glDrawBuffer(GL_NONE);
    draw(scene, 5, 1, 1, 1);
    tell("no image", 32, 24);
    glDrawBuffer(GL_COLOR_ATTACHMENT0);
    glDrawBuffer(GL_COLOR_ATTACHMENT1 + 40);
    tell("no such image", 32, 24);

    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, WIDTH / 2, HEIGHT / 2);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, WIDTH / 2, HEIGHT / 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    glViewport(0, 0, WIDTH / 2, HEIGHT / 2);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw(scene, 3, 0, 0, 1);
    tell("half the size", 16, 12);

    glBindFramebuffer(GL_FRAMEBUFFER, target[1]);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colours[0], 0);
    tell("the first image again", 32, 24);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target[0]);
    glBlitFramebuffer(0, 0, WIDTH / 2, HEIGHT / 2, 0, 0, WIDTH, HEIGHT, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBlitFramebuffer(0, 0, 8, 8, 0, 0, 9, 9, GL_DEPTH_BUFFER_BIT, GL_LINEAR);
    tell("blitted", 16, 12);
    glBindTexture(GL_TEXTURE_2D, colours[0]);
    image("of what is blitted");
    glGenerateMipmap(GL_TEXTURE_2D);
    glGenerateMipmap(GL_TEXTURE_2D + 40);
    printf("levels: error 0x%x 0x%x\n", glGetError(), glGetError());
    glDeleteTextures(1, &colours[1]);
    glDeleteFramebuffers(1, &target[0]);
    glDeleteRenderbuffers(1, &depth);
    tell("deleted", 32, 24);
    printf("there: %d %d %d, %d %d\n", glIsFramebuffer(target[0]), glIsTexture(colours[1]), glIsRenderbuffer(depth), glIsFramebuffer(target[1] + 1),
           glIsTexture(colours[1] + 1));

    /* Mesa 22.3 goes on drawing to the image that the texture had before its levels were generated, until it is attached again. */
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colours[0], 0);
    glViewport(0, 0, WIDTH, HEIGHT);
    glClearColor(0, 1, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    draw(scene, 3, 0, 0, 1);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDisable(GL_DEPTH_TEST);
    fed();
    /* The texture's parameters count as well as its texels. */
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_R, GL_BLUE);
    glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_LOD_BIAS, 0.25f);
    draw(shown, 0, 0, 0, 0);
    tell("shown", 32, 24);
    eglSwapBuffers(display, surface);

    glBindFramebuffer(GL_FRAMEBUFFER, target[1]);
    draw(scene, 9, 1, 1, 0);
    /* A context without a surface has no window to show views in. */
    context = eglCreateContext(display, config, context, NULL);
    if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
        return 3;
    glBindTexture(GL_TEXTURE_2D, colours[0]);
    image("seen by another context");
    return 0;
}
