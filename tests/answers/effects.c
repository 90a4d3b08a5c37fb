/* Shaders that write to memory: prints what they have written after each of two frames, and what is bound then. A quad at depth 2 is drawn by a
 * perspective camera; what is drawn last is green, over blue.
 *
 *   effects counter    an atomic counter of fragments, in a range of a buffer
 *   effects image      each fragment stores its place in an image, which a further draw shows
 *   effects level      so do they in level 1 of a texture with two levels, which is shown by its name alone
 *   effects nowhere    so do they in a framebuffer without attachments
 *   effects atomic     fragments add to a pixel of an image
 *   effects storage    fragments add to a storage block, whose old value tells their colour
 *   effects vertex     vertices add to a storage block
 *   effects rebound    the block is bound by glShaderStorageBlockBinding after the program was linked
 *   effects arrays     an array of blocks, of which one is written
 *   effects readonly   places of vertices come from a block that is not written, and another one is
 *   effects list       a draw in a display list
 *   effects executed   the same, executed while it is compiled
 *   effects pixels     the shader draws a rectangle of pixels
 *   effects pipeline   a program pipeline */
#include "../support/c/shaders.h"
#include "../support/c/surface.h"
#include <string.h>

enum { PLACE = 0, BYTES = 1024 };

static const char *const plain = "#version 430\nuniform mat4 camera; layout(location = 0) in vec2 place;\n"
                                 "void main() { gl_Position = camera * vec4(place * 0.5, -2.0, 1.0); }\n";
static const char *const writes_vertex =
    "#version 430\nuniform mat4 camera; layout(location = 0) in vec2 place; layout(std430, binding = 3) buffer Sum { uint sum[4]; };\n"
    "void main() { atomicAdd(sum[1], 1u); gl_Position = camera * vec4(place * 0.5, -2.0, 1.0); }\n";
static const char *const reads_vertex =
    "#version 430\nuniform mat4 camera; layout(location = 0) in vec2 place; layout(std430, binding = 1) buffer Places { vec2 places[]; };\n"
    "void main() { gl_Position = camera * vec4(places[gl_VertexID] * 0.5 + 0.0 * place, -2.0, 1.0); }\n";
static const char *const separate =
    "#version 430\nuniform mat4 camera; layout(location = 0) in vec2 place; out gl_PerVertex { vec4 gl_Position; };\n"
    "void main() { gl_Position = camera * vec4(place * 0.5, -2.0, 1.0); }\n";
static const char *const whole = "#version 430\nlayout(location = 0) in vec2 place; out vec2 at; void main() { at = place * 0.5 + 0.5; gl_Position = vec4(place, 0.0, 1.0); }";
static const char *const shows = "#version 430\nuniform sampler2D image; uniform float level; in vec2 at; out vec4 colour;\n"
                                 "void main() { colour = textureLod(image, at, level); }";
static const char *const green = "#version 430\nout vec4 colour; void main() { colour = vec4(0.0, 1.0, 0.0, 1.0); }";
static const char *const counts = "#version 430\nlayout(binding = 0, offset = 4) uniform atomic_uint n; out vec4 colour;\n"
                                  "void main() { atomicCounterIncrement(n); colour = vec4(0.0, 1.0, 0.0, 1.0); }\n";
static const char *const stores = "#version 430\nlayout(rgba8, binding = 2) writeonly uniform image2D image; out vec4 colour;\n"
                                  "void main() { imageStore(image, ivec2(gl_FragCoord.xy), vec4(0.0, 1.0, 0.0, 1.0)); discard; }\n";
static const char *const adds_pixel = "#version 430\nlayout(r32ui, binding = 2) uniform uimage2D image; out vec4 colour;\n"
                                      "void main() { imageAtomicAdd(image, ivec2(0), 1u); colour = vec4(0.0, 1.0, 0.0, 1.0); }\n";
/* In each view the first fragment finds what the frame before has left, so none of them is red but for those of a view that goes on with another's. */
static const char *const adds = "#version 430\nlayout(std430, binding = 3) buffer Sum { uint sum[4]; }; uniform uint limit; out vec4 colour;\n"
                                "void main() { uint old = atomicAdd(sum[1], 1u); sum[2] = limit; colour = old < limit ? vec4(0.0, 1.0, 0.0, 1.0) : vec4(1.0, 0.0, 0.0, 1.0); }\n";
static const char *const adds_to_one =
    "#version 430\nlayout(std430, binding = 3) buffer Sum { uint sum[4]; } all[2]; out vec4 colour;\n"
    "void main() { atomicAdd(all[1].sum[1], 1u); colour = vec4(0.0, 1.0, 0.0, 1.0); }\n";

static GLuint buffers[3], texture, program, shown, pipeline;
static const char *mode;

/* Whether fragments store to an image, which is shown. */
static int shows_image(void)
{
    return !strcmp(mode, "image") || !strcmp(mode, "level") || !strcmp(mode, "nowhere");
}

static int is(const char *other)
{
    return !strcmp(mode, other);
}

static void tell(int frame)
{
    static const GLenum by_index[] = {GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE,
                                      GL_ATOMIC_COUNTER_BUFFER_BINDING, GL_ATOMIC_COUNTER_BUFFER_START, GL_ATOMIC_COUNTER_BUFFER_SIZE};
    static const GLenum names[] = {GL_SHADER_STORAGE_BUFFER_BINDING, GL_ATOMIC_COUNTER_BUFFER_BINDING, GL_COPY_READ_BUFFER_BINDING,
                                   GL_COPY_WRITE_BUFFER_BINDING};
    GLuint sums[3][BYTES / 4], pixels[WIDTH * HEIGHT], stored = 0;
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    for (int i = 0; i < 3; i++)
        glGetNamedBufferSubData(buffers[i], 0, BYTES, sums[i]);
    glBindTexture(GL_TEXTURE_2D, texture);
    if (is("atomic"))
        glGetTexImage(GL_TEXTURE_2D, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, pixels);
    else
        glGetTexImage(GL_TEXTURE_2D, is("level"), GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        stored += pixels[i] != 0;
    printf("frame %d:", frame);
    for (int i = 0; i < 3; i++)
        printf(" %u %u %u %u", sums[i][1], sums[i][2], sums[i][65], sums[i][66]);
    printf(", image %u of %u\n bound", pixels[0], stored);
    for (unsigned i = 0; i < sizeof by_index / sizeof *by_index; i++)
        for (GLuint at = 0; at < (i < 3 ? 5 : 1); at++) {
            GLint64 value = -1;
            glGetInteger64i_v(by_index[i], at, &value);
            printf(" %d", (int)value);
        }
    for (unsigned i = 0; i < sizeof names / sizeof *names; i++) {
        GLint value = -1;
        glGetIntegerv(names[i], &value);
        printf(" %d", value);
    }
    GLint image = -1, used = -1;
    glGetIntegeri_v(GL_IMAGE_BINDING_NAME, 2, &image);
    glGetIntegerv(GL_CURRENT_PROGRAM, &used);
    printf(", image %d, program %d, error 0x%x\n", (GLuint)image == texture, (GLuint)used == (is("pipeline") ? 0 : shows_image() ? shown : program),
           glGetError());
}

static GLuint stage(GLenum kind, const char *text)
{
    GLuint shader = glCreateShader(kind), made = glCreateProgram();
    glProgramParameteri(made, GL_PROGRAM_SEPARABLE, GL_TRUE);
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    glAttachShader(made, shader);
    glLinkProgram(made);
    return made;
}

static void set_up(void)
{
    static const GLfloat places[] = {-1, -1, 1, -1, 1, 1, -1, 1};
    static const GLuint zeros[BYTES / 4] = {0};
    glGenBuffers(3, buffers);
    for (int i = 0; i < 3; i++) {
        glBindBuffer(GL_COPY_WRITE_BUFFER, buffers[i]);
        glBufferData(GL_COPY_WRITE_BUFFER, BYTES, zeros, GL_DYNAMIC_COPY);
    }
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexStorage2D(GL_TEXTURE_2D, 1 + is("level"), is("atomic") ? GL_R32UI : GL_RGBA8, WIDTH << is("level"), HEIGHT << is("level"));
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, is("level") ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glBindImageTexture(2, texture, is("level"), GL_FALSE, 0, is("atomic") ? GL_READ_WRITE : GL_WRITE_ONLY, is("atomic") ? GL_R32UI : GL_RGBA8);
    glBindBufferRange(GL_ATOMIC_COUNTER_BUFFER, 0, buffers[0], 256, 256);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, buffers[1]);
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, 4, buffers[2], 256, 256);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffers[2]);
    if (is("readonly"))
        glNamedBufferSubData(buffers[2], 0, sizeof places, places);
    glBindBuffer(GL_COPY_READ_BUFFER, buffers[2]);
    const char *vertex = is("vertex") ? writes_vertex : is("readonly") ? reads_vertex : plain;
    const char *fragment = is("counter") || is("pixels") ? counts : shows_image() ? stores : is("atomic") ? adds_pixel : is("vertex") ? green :
                           is("arrays") ? adds_to_one : adds;
    program = linked(vertex, fragment, PLACE), shown = linked(whole, shows, PLACE);
    if (is("rebound"))
        glShaderStorageBlockBinding(program, glGetProgramResourceIndex(program, GL_SHADER_STORAGE_BLOCK, "Sum"), 4);
    if (is("pipeline")) {
        GLuint vertices = stage(GL_VERTEX_SHADER, separate), fragments = stage(GL_FRAGMENT_SHADER, adds);
        glGenProgramPipelines(1, &pipeline);
        glUseProgramStages(pipeline, GL_VERTEX_SHADER_BIT, vertices);
        glUseProgramStages(pipeline, GL_FRAGMENT_SHADER_BIT, fragments);
        glProgramUniform1ui(fragments, glGetUniformLocation(fragments, "limit"), 1u << 20);
        program = vertices;
    }
}

int main(int argc, char **argv)
{
    static const GLfloat camera[16] = {1.5f, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.04f, -1, 0, 0, -2.04f, 0};
    static const unsigned char colours[8 * 8 * 4] = {0};
    mode = argc > 1 ? argv[1] : "";
    if (!open_surface() || !new_context(EGL_NO_CONTEXT))
        return 77;
    set_up();
    GLuint limit = 0, list = glGenLists(1), framebuffer;
    glGenFramebuffers(1, &framebuffer);
    for (int frame = 1; frame <= 2; frame++) {
        glClearColor(0, 0, 1, 1);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glProgramUniformMatrix4fv(program, glGetUniformLocation(program, "camera"), 1, GL_FALSE, camera);
        if (is("pipeline")) {
            glBindProgramPipeline(pipeline);
        } else {
            glUseProgram(program);
            /* A view that goes on with what the own one has written finds more than twice as many fragments. */
            limit += 24 * 24;
            glUniform1ui(glGetUniformLocation(program, "limit"), limit);
        }
        if (is("nowhere")) {
            glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
            glFramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_WIDTH, WIDTH);
            glFramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_HEIGHT, HEIGHT);
        }
        if (is("list") || is("executed")) {
            if (frame == 1) {
                glNewList(list, is("list") ? GL_COMPILE : GL_COMPILE_AND_EXECUTE);
                quad(PLACE);
                glEndList();
            }
            if (frame == 2 || is("list"))
                glCallList(list);
        } else if (is("pixels")) {
            glWindowPos2i(20, 20);
            glDrawPixels(8, 8, GL_RGBA, GL_UNSIGNED_BYTE, colours);
        } else {
            quad(PLACE);
        }
        if (shows_image()) {
            glMemoryBarrier(GL_ALL_BARRIER_BITS);
            glBindFramebuffer(GL_FRAMEBUFFER, 0);
            glUseProgram(shown);
            glUniform1f(glGetUniformLocation(shown, "level"), (float)is("level"));
            glBindTexture(GL_TEXTURE_2D, texture);
            quad(PLACE);
        }
        unsigned char pixel[4];
        glReadPixels(WIDTH / 2, HEIGHT / 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
        printf("pixel %d %d %d\n", pixel[0], pixel[1], pixel[2]);
        tell(frame);
        eglSwapBuffers(display, surface);
    }
    return 0;
}
