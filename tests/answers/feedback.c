/* Transform feedback: draws of which the vertices are written to a buffer, and which make a picture as well.
 *
 *   feedback MODE SHADER
 *
 *   active     two draws are fed back, and a third is not
 *   paused     the second of three draws is made while feedback is paused
 *   swap       a frame ends while feedback is active
 *   pausedswap a frame ends while feedback is paused
 *   program    another program draws while feedback is paused
 *   object     another feedback object is bound while the first one is paused
 *   discard    the first draw makes no picture
 *   again      the vertices that were fed back are drawn by glDrawTransformFeedback
 *   clear      the picture is cleared while feedback is active
 *   copy       the picture is read, copied and blitted while feedback is active
 *   offscreen  the draws go to a framebuffer of the program's, which is then shown
 *   told       GL_FEEDBACK tells the corners of the second draw, in place of its picture
 *   wrong      calls that are not allowed while feedback is active
 *   failed     feedback that has not begun, since its mode is wrong
 *
 * SHADER: "flat" moves nothing, "camera" multiplies by a perspective, at a depth of 4. Prints three pixels, the corners that were fed back,
 * queries, state and errors. */
#include "../support/c/shaders.h"
#include "../support/c/surface.h"
#include <string.h>

enum { PLACE = 0, CORNERS = 6, MOST = 64 };

static const char *const flat = "#version 150\nin vec2 place; uniform float at; out vec4 fed;\n"
                                "void main() { fed = vec4(place * vec2(0.2, 0.8) + vec2(at, 0.0), 0.0, 1.0); gl_Position = fed; }\n";
static const char *const camera = "#version 150\nin vec2 place; uniform float at; uniform mat4 camera; out vec4 fed;\n"
                                  "void main() { fed = vec4(place * vec2(0.2, 0.8) + vec2(at, 0.0), 0.0, 1.0);\n"
                                  "    gl_Position = camera * vec4(fed.xy * 4.0, -4.0, 1.0); }\n";
static const char *const fragment = "#version 150\nuniform vec3 colour; out vec4 shown; void main() { shown = vec4(colour, 1.0); }";

static GLuint feeding, other, buffers[2], queries[2];
static const char *mode;

static int is(const char *name)
{
    return !strcmp(mode, name);
}

static GLuint made(const char *vertex, int feeds)
{
    const GLfloat matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.04f, -1, 0, 0, -2.04f, 0};
    const char *const name = "fed";
    GLuint program = glCreateProgram();
    attached(program, GL_VERTEX_SHADER, vertex);
    attached(program, GL_FRAGMENT_SHADER, fragment);
    glBindAttribLocation(program, PLACE, "place");
    if (feeds)
        glTransformFeedbackVaryings(program, 1, &name, GL_INTERLEAVED_ATTRIBS);
    glLinkProgram(program);
    glUseProgram(program);
    if (vertex == camera)
        glUniformMatrix4fv(glGetUniformLocation(program, "camera"), 1, GL_FALSE, matrix);
    return program;
}

/* Draws the upright bar of this number, 0 to 2, each in a colour of its own. */
static void bar(GLuint program, int number)
{
    static const GLfloat corners[] = {-1, -1, 1, -1, 1, 1, -1, -1, 1, 1, -1, 1};
    glUniform1f(glGetUniformLocation(program, "at"), -0.6f + 0.6f * (float)number);
    glUniform3f(glGetUniformLocation(program, "colour"), number == 0, number == 1, number == 2);
    glEnableVertexAttribArray(PLACE);
    glVertexAttribPointer(PLACE, 2, GL_FLOAT, GL_FALSE, 0, corners);
    glDrawArrays(GL_TRIANGLES, 0, CORNERS);
}

static void clear(void)
{
    glClearColor(1, 1, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

static void begin(void)
{
    glBeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, queries[0]);
    glBeginQuery(GL_PRIMITIVES_GENERATED, queries[1]);
    glBeginTransformFeedback(is("failed") ? GL_TRIANGLE_FAN : GL_TRIANGLES);
    if (is("failed"))
        printf("begun: 0x%x\n", glGetError());
}

static void end(void)
{
    if (!is("failed"))
        glEndTransformFeedback();
    glEndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
    glEndQuery(GL_PRIMITIVES_GENERATED);
}

static void pixels(const char *what)
{
    unsigned char p[3][4];
    for (int i = 0; i < 3; i++)
        glReadPixels(13 + 19 * i, HEIGHT / 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, p[i]);
    printf("%s:", what);
    for (int i = 0; i < 3; i++)
        printf(" %d %d %d%s", p[i][0], p[i][1], p[i][2], i < 2 ? "," : "");
    printf(", error 0x%x\n", glGetError());
}

static void state(const char *what)
{
    GLint active = 0, paused = 0, program = 0;
    glGetIntegerv(GL_TRANSFORM_FEEDBACK_ACTIVE, &active);
    glGetIntegerv(GL_TRANSFORM_FEEDBACK_PAUSED, &paused);
    glGetIntegerv(GL_CURRENT_PROGRAM, &program);
    printf("%s: active %d, paused %d, the feeding program %d, error 0x%x\n", what, active, paused, (GLuint)program == feeding, glGetError());
}

static void results(void)
{
    static GLfloat fed[MOST][4];
    GLuint counts[2];
    for (int i = 0; i < 2; i++)
        glGetQueryObjectuiv(queries[i], GL_QUERY_RESULT, &counts[i]);
    printf("written %u, generated %u\n", counts[0], counts[1]);
    for (int b = 0; b < 2; b++) {
        glBindBuffer(GL_COPY_READ_BUFFER, buffers[b]);
        glGetBufferSubData(GL_COPY_READ_BUFFER, 0, sizeof fed, fed);
        printf("fed back:");
        for (int i = 0; i < MOST && fed[i][3] == 1; i += 3)
            printf(" %.2f %.2f", (double)fed[i][0], (double)fed[i][1]);
        printf(", error 0x%x\n", glGetError());
    }
}

static void show_copies(void)
{
    GLuint texture, framebuffer;
    unsigned char p[4] = {0};
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 0, 0, WIDTH, HEIGHT, 0);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    glReadPixels(13, HEIGHT / 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, p);
    printf("copied: %d %d %d, error 0x%x\n", p[0], p[1], p[2], glGetError());
    /* The first bar comes to the place of the third. */
    glBlitFramebuffer(0, 0, 26, HEIGHT, 38, 0, WIDTH, HEIGHT, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
}

static GLuint offscreen(void)
{
    GLuint texture, framebuffer;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, WIDTH, HEIGHT, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    clear();
    return framebuffer;
}

static void swap(const char *what)
{
    state(what);
    eglSwapBuffers(display, surface);
    state("after the swap");
    clear();
}

static void wrong(void)
{
    glUseProgram(other);
    printf("another program: 0x%x\n", glGetError());
    glDrawArrays(GL_LINES, 0, 2);
    printf("lines: 0x%x\n", glGetError());
    glBeginTransformFeedback(GL_TRIANGLES);
    printf("begun twice: 0x%x\n", glGetError());
    glLinkProgram(feeding);
    printf("linked: 0x%x\n", glGetError());
    glResumeTransformFeedback();
    printf("resumed: 0x%x\n", glGetError());
    state("unchanged");
}

/* What is between the first and the last bar, while feedback is active. */
static void between(GLuint *objects)
{
    int pauses = is("paused") || is("pausedswap") || is("program") || is("object");
    if (pauses)
        glPauseTransformFeedback();
    if (is("swap") || is("pausedswap")) {
        swap("before the swap");
    } else if (is("program")) {
        glUseProgram(other);
        bar(other, 1);
        glUseProgram(feeding);
    } else if (is("object")) {
        glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, objects[1]);
        glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffers[1]);
        glBeginTransformFeedback(GL_TRIANGLES);
        bar(feeding, 1);
        glEndTransformFeedback();
        glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, objects[0]);
    } else if (is("clear")) {
        clear();
    } else if (is("copy")) {
        pixels("read");
        show_copies();
    } else if (is("told")) {
        GLfloat told[256] = {0};
        glFeedbackBuffer(256, GL_2D, told);
        glRenderMode(GL_FEEDBACK);
        bar(feeding, 1);
        printf("told: %d\n", glRenderMode(GL_RENDER));
    } else if (is("wrong")) {
        wrong();
    } else {
        bar(feeding, 1);
    }
    state("between");
    if (pauses)
        glResumeTransformFeedback();
}

int main(int argc, char **argv)
{
    GLuint objects[2], framebuffer = 0;
    if (argc < 3 || !open_surface() || !new_context(EGL_NO_CONTEXT))
        return 2;
    mode = argv[1];
    const char *vertex = strcmp(argv[2], "camera") ? flat : camera;
    other = made(vertex, 0), feeding = made(vertex, 1);
    glGenQueries(2, queries);
    glGenBuffers(2, buffers);
    static const GLfloat nothing[MOST][4];
    for (int i = 0; i < 2; i++) {
        glBindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, buffers[i]);
        glBufferData(GL_TRANSFORM_FEEDBACK_BUFFER, sizeof nothing, nothing, GL_STATIC_READ);
    }
    glGenTransformFeedbacks(2, objects);
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, objects[0]);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffers[0]);
    clear();
    if (is("offscreen"))
        framebuffer = offscreen();
    begin();
    if (is("discard"))
        glEnable(GL_RASTERIZER_DISCARD);
    bar(feeding, 0);
    glDisable(GL_RASTERIZER_DISCARD);
    between(objects);
    if (is("active")) {
        end();
        bar(feeding, 2);
    } else {
        if (!is("copy"))
            bar(feeding, 2);
        end();
    }
    if (is("again")) {
        clear();
        /* What was fed back lies where it was drawn: it is drawn smaller. */
        glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
        glUniform1f(glGetUniformLocation(feeding, "at"), 0);
        glVertexAttribPointer(PLACE, 2, GL_FLOAT, GL_FALSE, 16, NULL);
        glDrawTransformFeedback(GL_TRIANGLES, objects[0]);
        glBindBuffer(GL_ARRAY_BUFFER, 0);
    }
    if (framebuffer) {
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
        glBlitFramebuffer(0, 0, WIDTH, HEIGHT, 0, 0, WIDTH, HEIGHT, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
    }
    pixels("picture");
    state("ended");
    results();
    eglSwapBuffers(display, surface);
    printf("the end: error 0x%x\n", glGetError());
    return 0;
}
