/* A camera in a uniform block, which zooms in at the third frame of five. The block gets the other matrix by
 *
 *   data subdata named   glBufferData, glBufferSubData, glNamedBufferSubData
 *   orphaned             glBufferData without data, and a mapping
 *   mapped flushed       glMapBufferRange; with explicit flushes
 *   persistent coherent  a mapping that stays, with a flush or without any call
 *   before               the same by a buffer that is mapped and written before it is bound to a block
 *   copied               glCopyBufferSubData
 *   range base           glBindBufferRange at another offset, glBindBufferBase with another buffer
 *   multi                glBindBuffersRange
 *   binding              glUniformBlockBinding
 *   compute              a compute shader writes it
 *   feedback             transform feedback writes it
 *   pixels               glReadPixels writes it
 *   cleared              glClearBufferSubData writes the two numbers that change
 *
 * or the block has
 *
 *   weapon     in each frame one camera for the scene and one for the nearest bar
 *   flat       in each frame a camera for the scene and a flat projection for the nearest bar
 *   level      in the first two frames a flat projection, as in a menu
 *   menu       the other way round
 *   element    an array of cameras, of which a uniform chooses one
 *   rows       row_major matrices
 *   storage    no matrix: it is in a storage buffer
 *
 * With "uniform" before subdata, weapon, flat, level or menu, the matrix is a plain uniform.
 *
 *   blocks MODE VIEW FRAME [FILE]
 *
 * VIEW: 0 to 2, the view that the program draws itself, by the equation; 1 is its own. Prints pixels of each frame and errors. FILE: the
 * picture of one frame as PPM. SPACING and FOCAL in this file are those of the test. */
#define SURFACE_SIZE
enum { WIDTH = 128, HEIGHT = 96 };
#include "../support/c/shaders.h"
#include "../support/c/surface.h"
#include <stdlib.h>
#include <string.h>

enum { PLACE = 0, FRAMES = 5, CHANGE = 3, MATRIX = 16 * sizeof(GLfloat), OFFSET = 256, SIZE = 4 * OFFSET };
static const float SPACING = 0.4f, FOCAL = 4;

static const char *mode;
static int view, plain;
static GLuint program, buffers[2];
static void *mapping;

static int is(const char *name)
{
    return !strcmp(mode, name);
}

/* Column-major; the camera of a view: row0(P_i) = row0(P) + sep·row3(P) − sep·conv·(0,0,0,1). */
static void camera(GLfloat *m, float zoom)
{
    const GLfloat p[16] = {zoom, 0, 0, 0, 0, zoom * WIDTH / HEIGHT, 0, 0, 0, 0, -1.04f, -1, 0, 0, -2.04f, 0};
    float separation = zoom * (float)(view - 1) * SPACING / FOCAL;
    memcpy(m, p, sizeof p);
    for (int column = 0; column < 4; column++)
        m[4 * column] += separation * p[4 * column + 3];
    m[12] -= separation * FOCAL;
}

static void flat(GLfloat *m)
{
    const GLfloat p[16] = {0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, -0.1f, 0, 0, 0, 0, 1};
    memcpy(m, p, sizeof p);
}

static void transpose(GLfloat *m)
{
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < row; column++) {
            GLfloat other = m[4 * row + column];
            m[4 * row + column] = m[4 * column + row];
            m[4 * column + row] = other;
        }
}

static const char *vertex(void)
{
#define REST "uniform vec3 at; uniform float wide; layout(location = 0) in vec2 place;\n" \
             "void main() { gl_Position = "
#define TIMES " * vec4(at.x + place.x * wide, at.y + place.y * wide * 4.0, at.z, 1.0); }"
    if (plain)
        return "#version 430\nuniform mat4 camera;\n" REST "camera" TIMES;
    if (is("element"))
        return "#version 430\nuniform int which; layout(std140, binding = 0) uniform Cameras { mat4 cameras[2]; };\n" REST "cameras[which]" TIMES;
    if (is("rows"))
        return "#version 430\nlayout(std140, row_major, binding = 0) uniform Cameras { mat4 camera; };\n" REST "camera" TIMES;
    if (is("storage"))
        return "#version 430\nlayout(std430, binding = 0) readonly buffer Cameras { mat4 camera; };\n" REST "camera" TIMES;
    return "#version 430\nlayout(std140, binding = 0) uniform Cameras { mat4 camera; };\n" REST "camera" TIMES;
}

static const char *const fragment = "#version 430\nuniform vec3 colour; out vec4 shown; void main() { shown = vec4(colour, 1.0); }";

static GLenum target(void)
{
    return is("storage") ? GL_SHADER_STORAGE_BUFFER : GL_UNIFORM_BUFFER;
}

/* Gives the block another matrix. */
static void put(const GLfloat *m)
{
    if (plain)
        glProgramUniformMatrix4fv(program, glGetUniformLocation(program, "camera"), 1, GL_FALSE, m);
    else
        glBufferSubData(target(), 0, MATRIX, m);
}

static void start(void)
{
    GLfloat all[SIZE / sizeof(GLfloat)] = {0};
    const int coherent = is("coherent") || is("before");
    const GLenum first = is("before") ? GL_ARRAY_BUFFER : target();
    const GLbitfield bits = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | (coherent ? GL_MAP_COHERENT_BIT : 0);
    program = linked(vertex(), fragment, PLACE);
    glGenBuffers(2, buffers);
    for (int i = 0; i < 2; i++) {
        camera(all, i ? 2 : 1);
        camera(all + (is("element") ? MATRIX : OFFSET) / sizeof *all, 2);
        if (is("level") && !i)
            flat(all);
        if (is("rows"))
            transpose(all);
        glBindBuffer(first, buffers[i]);
        if (is("persistent") || coherent) {
            glBufferStorage(first, SIZE, is("before") ? NULL : all, bits);
            if (!i)
                mapping = glMapBufferRange(first, 0, SIZE, bits | (coherent ? 0 : GL_MAP_FLUSH_EXPLICIT_BIT));
            if (!i && is("before"))
                memcpy(mapping, all, SIZE);
        } else {
            glBufferData(first, SIZE, all, GL_DYNAMIC_DRAW);
        }
    }
    if (plain) {
        if (is("level"))
            flat(all);
        else
            camera(all, 1);
        put(all);
    }
    glBindBufferRange(target(), 0, buffers[0], 0, is("element") ? 2 * MATRIX : MATRIX);
    glBindBufferRange(target(), 1, buffers[1], 0, MATRIX);
}

static void map(const GLfloat *m, GLbitfield more)
{
    GLfloat *p = glMapBufferRange(GL_UNIFORM_BUFFER, 0, MATRIX, GL_MAP_WRITE_BIT | more);
    memcpy(p, m, MATRIX);
    if (more & GL_MAP_FLUSH_EXPLICIT_BIT)
        glFlushMappedBufferRange(GL_UNIFORM_BUFFER, 0, MATRIX);
    glUnmapBuffer(GL_UNIFORM_BUFFER);
}

static void compute(const GLfloat *m)
{
    static const char *const text = "#version 430\nlayout(local_size_x = 1) in; uniform mat4 from; layout(std430, binding = 2) buffer To { mat4 to; };\n"
                                    "void main() { to = from; }";
    GLuint computes = glCreateProgram();
    attached(computes, GL_COMPUTE_SHADER, text);
    glLinkProgram(computes);
    glUseProgram(computes);
    glUniformMatrix4fv(glGetUniformLocation(computes, "from"), 1, GL_FALSE, m);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, buffers[0]);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

static void feed_back(const GLfloat *m)
{
    static const char *const text = "#version 430\nuniform mat4 from; out vec4 fed; void main() { fed = from[gl_VertexID]; gl_Position = vec4(0.0); }";
    const char *const name = "fed";
    GLuint feeds = glCreateProgram();
    attached(feeds, GL_VERTEX_SHADER, text);
    glTransformFeedbackVaryings(feeds, 1, &name, GL_INTERLEAVED_ATTRIBS);
    glLinkProgram(feeds);
    glUseProgram(feeds);
    glUniformMatrix4fv(glGetUniformLocation(feeds, "from"), 1, GL_FALSE, m);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffers[0]);
    glEnable(GL_RASTERIZER_DISCARD);
    glBeginTransformFeedback(GL_POINTS);
    glDrawArrays(GL_POINTS, 0, 4);
    glEndTransformFeedback();
    glDisable(GL_RASTERIZER_DISCARD);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
}

static void read_pixels(const GLfloat *m)
{
    GLuint texture, framebuffer;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, 4, 1, 0, GL_RGBA, GL_FLOAT, m);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, buffers[0]);
    glReadPixels(0, 0, 4, 1, GL_RGBA, GL_FLOAT, NULL);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
}

static void zoom(void)
{
    static const GLsizeiptr length = MATRIX;
    static const GLintptr offset = OFFSET;
    GLfloat m[16];
    camera(m, 2);
    glBindBuffer(GL_UNIFORM_BUFFER, buffers[0]);
    if (is("data")) {
        glBufferData(GL_UNIFORM_BUFFER, MATRIX, m, GL_DYNAMIC_DRAW);
    } else if (is("subdata") || is("level")) {
        put(m);
    } else if (is("menu")) {
        flat(m);
        put(m);
    } else if (is("named")) {
        glNamedBufferSubData(buffers[0], 0, MATRIX, m);
    } else if (is("orphaned")) {
        glBufferData(GL_UNIFORM_BUFFER, MATRIX, NULL, GL_STREAM_DRAW);
        map(m, GL_MAP_UNSYNCHRONIZED_BIT);
    } else if (is("mapped") || is("flushed")) {
        map(m, is("flushed") ? GL_MAP_FLUSH_EXPLICIT_BIT : 0);
    } else if (is("persistent") || is("coherent") || is("before")) {
        memcpy(mapping, m, sizeof m);
        if (is("persistent"))
            glFlushMappedBufferRange(GL_UNIFORM_BUFFER, 0, MATRIX);
    } else if (is("copied")) {
        glBindBuffer(GL_COPY_READ_BUFFER, buffers[1]);
        glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_UNIFORM_BUFFER, 0, 0, MATRIX);
    } else if (is("range")) {
        glBindBufferRange(GL_UNIFORM_BUFFER, 0, buffers[0], OFFSET, MATRIX);
    } else if (is("base")) {
        glBindBufferBase(GL_UNIFORM_BUFFER, 0, buffers[1]);
    } else if (is("multi")) {
        glBindBuffersRange(GL_UNIFORM_BUFFER, 0, 1, buffers, &offset, &length);
    } else if (is("binding")) {
        glUniformBlockBinding(program, 0, 1);
    } else if (is("compute")) {
        compute(m);
    } else if (is("feedback")) {
        feed_back(m);
    } else if (is("pixels")) {
        read_pixels(m);
    } else if (is("cleared")) {
        glClearBufferSubData(GL_UNIFORM_BUFFER, GL_R32F, 0, sizeof *m, GL_RED, GL_FLOAT, &m[0]);
        glClearBufferSubData(GL_UNIFORM_BUFFER, GL_R32F, 5 * sizeof *m, sizeof *m, GL_RED, GL_FLOAT, &m[5]);
        glClearBufferSubData(GL_UNIFORM_BUFFER, GL_R32F, 8 * sizeof *m, sizeof *m, GL_RED, GL_FLOAT, &m[8]);
        glClearBufferSubData(GL_UNIFORM_BUFFER, GL_R32F, 12 * sizeof *m, sizeof *m, GL_RED, GL_FLOAT, &m[12]);
    } else if (is("rows") || is("storage")) {
        if (is("rows"))
            transpose(m);
        glBindBuffer(target(), buffers[0]);
        put(m);
    }
}

/* A bar at a depth, in a colour of its own. */
static void bar(float x, float y, float depth, int red, int green, int blue)
{
    glUniform3f(glGetUniformLocation(program, "at"), x * depth, y * depth, -depth);
    glUniform1f(glGetUniformLocation(program, "wide"), 0.03f * depth);
    glUniform3f(glGetUniformLocation(program, "colour"), (GLfloat)red, (GLfloat)green, (GLfloat)blue);
    quad(PLACE);
}

static void scene(int frame)
{
    const int other = is("weapon") || is("flat");
    GLfloat m[16];
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glUseProgram(program);
    if (is("element"))
        glUniform1i(glGetUniformLocation(program, "which"), frame >= CHANGE);
    if (other) {
        camera(m, 1);
        put(m);
    }
    bar(0, 0, 4, 0, 1, 0);
    bar(0.25f, 0, 8, 0, 0, 1);
    if (is("weapon"))
        camera(m, 2);
    else if (is("flat"))
        flat(m);
    if (other)
        put(m);
    bar(-0.25f, 0, 2, 1, 0, 0);
}

/* A letter for each run of a colour in the middle row, with its first column. */
static void tell(int frame)
{
    static unsigned char row[WIDTH][4];
    char last = 0;
    glReadPixels(0, HEIGHT / 2, WIDTH, 1, GL_RGBA, GL_UNSIGNED_BYTE, row);
    printf("frame %d:", frame);
    for (int x = 0; x < WIDTH; x++) {
        char now = row[x][0] ? 'r' : row[x][1] ? 'g' : row[x][2] ? 'b' : '-';
        if (now != last)
            printf(" %c%d", now, x);
        last = now;
    }
    printf(", error 0x%x\n", glGetError());
}

static void write_picture(const char *path)
{
    static unsigned char pixels[HEIGHT][WIDTH][4];
    FILE *file = fopen(path, "wb");
    if (!file)
        exit(4);
    glReadPixels(0, 0, WIDTH, HEIGHT, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    fprintf(file, "P6\n%d %d\n255\n", WIDTH, HEIGHT);
    for (int y = HEIGHT - 1; y >= 0; y--)
        for (int x = 0; x < WIDTH; x++)
            fwrite(pixels[y][x], 1, 3, file);
    fclose(file);
}

int main(int argc, char **argv)
{
    if (argc < 4 || !open_surface() || !new_context(EGL_NO_CONTEXT))
        return 2;
    plain = !strncmp(argv[1], "uniform", 7);
    mode = argv[1] + 7 * plain, view = atoi(argv[2]);
    start();
    glEnable(GL_DEPTH_TEST);
    for (int frame = 1; frame <= FRAMES; frame++) {
        if (frame == CHANGE)
            zoom();
        scene(frame);
        tell(frame);
        if (argc > 4 && frame == atoi(argv[3]))
            write_picture(argv[4]);
        eglSwapBuffers(display, surface);
    }
    return 0;
}
