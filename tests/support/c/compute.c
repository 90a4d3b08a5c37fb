/* Draws a scene into a framebuffer, from which a compute shader makes the picture of the window; another one writes its input to a buffer. */
#include "shaders.h"
#include "surface.h"

/* The locations that the shaders declare. */
enum { PLACE = 0 };

static const char *const vertex = "#version 430\nuniform mat4 camera; uniform float depth; layout(location = 0) in vec2 place;\n"
                                  "void main() { gl_Position = camera * vec4(place * 0.25 * depth, -depth, 1.0); }\n";
static const char *const fragment = "#version 430\nout vec4 colour; void main() { colour = vec4(0.0, 1.0, 0.0, 1.0); }";
static const char *const whole = "#version 430\nlayout(location = 0) in vec2 place; out vec2 at; void main() { at = place * 0.5 + 0.5; gl_Position = vec4(place, 0.0, 1.0); }";
static const char *const picture = "#version 430\nuniform sampler2D image; in vec2 at; out vec4 colour; void main() { colour = texture(image, at); }";
/* Reads from a sampler or an image, writes to an image. */
static const char *const turned[] = {
    "#version 430\nlayout(local_size_x = 8, local_size_y = 8) in; uniform sampler2D from; layout(rgba8, binding = 1) writeonly uniform image2D to;\n"
    "void main() { ivec2 p = ivec2(gl_GlobalInvocationID.xy); imageStore(to, p, vec4(texelFetch(from, p, 0).brg, 1.0)); }\n",
    "#version 430\nlayout(local_size_x = 8, local_size_y = 8) in; layout(rgba8, binding = 0) readonly uniform image2D from; layout(rgba8, binding = 1) writeonly uniform image2D to;\n"
    "void main() { ivec2 p = ivec2(gl_GlobalInvocationID.xy); imageStore(to, p, vec4(imageLoad(from, p).brg, 1.0)); }\n",
};
static const char *const counted = "#version 430\nlayout(local_size_x = 8, local_size_y = 8) in; uniform sampler2D from; layout(std430, binding = 0) buffer Sum { uint sum; };\n"
                                   "void main() { ivec2 p = ivec2(gl_GlobalInvocationID.xy); if (texelFetch(from, p, 0).g > 0.5) atomicAdd(sum, uint(p.x)); }\n";

static GLuint computing(const char *text)
{
    GLuint program = glCreateProgram();
    attached(program, GL_COMPUTE_SHADER, text);
    glLinkProgram(program);
    return program;
}

int main(void)
{
    const GLfloat camera[16] = {1.5f, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.04f, -1, 0, 0, -2.04f, 0};
    GLuint textures[2], framebuffer, buffer, scene, shown, count, computed[2], sum = 0;
    unsigned char pixel[4], all[WIDTH * HEIGHT * 4];
    if (!open_surface() || !new_context(EGL_NO_CONTEXT))
        return 2;
    scene = linked(vertex, fragment, PLACE), shown = linked(whole, picture, PLACE), count = computing(counted);
    for (int i = 0; i < 2; i++)
        computed[i] = computing(turned[i]);
    glGenTextures(2, textures);
    for (int i = 0; i < 2; i++) {
        glBindTexture(GL_TEXTURE_2D, textures[i]);
        glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, WIDTH, HEIGHT);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    glGenFramebuffers(1, &framebuffer);
    glGenBuffers(1, &buffer);
    for (int frame = 0; frame < 2; frame++) {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, textures[0], 0);
        glClearColor(0, 0, 0, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        glUseProgram(scene);
        glUniformMatrix4fv(glGetUniformLocation(scene, "camera"), 1, GL_FALSE, camera);
        glUniform1f(glGetUniformLocation(scene, "depth"), 2.0f);
        quad(PLACE);
        glBindTexture(GL_TEXTURE_2D, textures[0]);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
        glBufferData(GL_SHADER_STORAGE_BUFFER, sizeof sum, NULL, GL_DYNAMIC_READ);
        sum = 0;
        glBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof sum, &sum);
        glUseProgram(count);
        glDispatchCompute(WIDTH / 8, HEIGHT / 8, 1);
        glMemoryBarrier(GL_ALL_BARRIER_BITS);
        glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof sum, &sum);
        glUseProgram(computed[frame]);
        glBindImageTexture(0, textures[0], 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA8);
        glBindImageTexture(1, textures[1], 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA8);
        glDispatchCompute(WIDTH / 8, HEIGHT / 8, 1);
        glMemoryBarrier(GL_ALL_BARRIER_BITS);
        glBindTexture(GL_TEXTURE_2D, textures[1]);
        glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, all);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glUseProgram(shown);
        quad(PLACE);
        glReadPixels(WIDTH / 2, HEIGHT / 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
        const unsigned char *middle = all + 4 * (WIDTH * HEIGHT / 2 + WIDTH / 2);
        printf("sum %u, computed %d %d %d, shown %d %d %d, error 0x%x\n", sum, middle[0], middle[1], middle[2], pixel[0], pixel[1], pixel[2], glGetError());
        eglSwapBuffers(display, surface);
    }
    return 0;
}
