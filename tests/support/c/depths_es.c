/* Three walls as in depths.c, in frames 1 to 10 of a surface of OpenGL ES 3 without a window system.
 *
 * depths_es window-24|window-32|pass-16|pass-24|pass-24-8|pass-32f|pass-32f-8
 *
 * window: depths of so many bits; pass: to a framebuffer of twice the window's size, with depths in a renderbuffer, whose picture is then drawn over
 * the window. Ends with 1 at the first error of OpenGL, with 3 where there is no such surface. */
#define GL_GLEXT_PROTOTYPES 1
static int depth_bits = 24;
#define DEPTH_BITS depth_bits
#define SURFACE_ES
#include "shaders.h"
#include "surface.h"

#include <string.h>

enum { FRAMES = 10 };

static const char *const scene_vertex =
    "#version 300 es\nin vec3 place; uniform mat4 camera; void main() { gl_Position = camera * vec4(place, 1.0); }";
static const char *const over_vertex =
    "#version 300 es\nin vec2 place; out vec2 at; void main() { at = 0.5 * place + 0.5; gl_Position = vec4(place, 0.0, 1.0); }";
static const char *const scene_fragment =
    "#version 300 es\nprecision highp float; uniform vec3 colour; out vec4 result; void main() { result = vec4(colour, 1.0); }";
static const char *const over_fragment =
    "#version 300 es\nprecision highp float; uniform sampler2D picture; in vec2 at; out vec4 result; void main() { result = texture(picture, at); }";

static void wall(GLuint program, const float *colour, float x, float distance, float half)
{
    const float corners[12] = {x - half, -half, -distance, x + half, -half, -distance,
                               x - half, half,  -distance, x + half, half,  -distance};
    glUniform3fv(glGetUniformLocation(program, "colour"), 1, colour);
    glBufferData(GL_ARRAY_BUFFER, sizeof corners, corners, GL_STREAM_DRAW);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, NULL);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

int main(int count, char **arguments)
{
    static const float colours[3][3] = {{0.8f, 0.2f, 0.2f}, {0.2f, 0.8f, 0.2f}, {0.2f, 0.2f, 0.8f}};
    /* A frustum of 4 to 3, from 1 to 100, as in surface.h. */
    const float camera[16] = {1 / 0.8f, 0, 0, 0, 0, 1 / 0.6f, 0, 0, 0, 0, -101 / 99.0f, -1, 0, 0, -200 / 99.0f, 0};
    const float corners[8] = {-1, -1, 1, -1, -1, 1, 1, 1};
    static const struct {
        const char *how;
        GLenum format, point;
    } passes[] = {
        {"pass-16", GL_DEPTH_COMPONENT16, GL_DEPTH_ATTACHMENT},
        {"pass-24", GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT},
        {"pass-24-8", GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL_ATTACHMENT},
        {"pass-32f", GL_DEPTH_COMPONENT32F, GL_DEPTH_ATTACHMENT},
        {"pass-32f-8", GL_DEPTH32F_STENCIL8, GL_DEPTH_STENCIL_ATTACHMENT},
    };
    const char *how = count > 1 ? arguments[1] : "window-24";
    GLuint scene, over, buffer, framebuffer = 0, picture, depths;
    if (!strcmp(how, "window-32"))
        depth_bits = 32;
    if (!open_surface() || !new_context(EGL_NO_CONTEXT))
        return 3;
    scene = linked(scene_vertex, scene_fragment, 0);
    over = linked(over_vertex, over_fragment, 0);
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glEnableVertexAttribArray(0);
    for (unsigned i = 0; i < sizeof passes / sizeof *passes; i++) {
        if (strcmp(how, passes[i].how))
            continue;
        glGenFramebuffers(1, &framebuffer);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glGenTextures(1, &picture);
        glBindTexture(GL_TEXTURE_2D, picture);
        glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, 2 * WIDTH, 2 * HEIGHT);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture, 0);
        glGenRenderbuffers(1, &depths);
        glBindRenderbuffer(GL_RENDERBUFFER, depths);
        glRenderbufferStorage(GL_RENDERBUFFER, passes[i].format, 2 * WIDTH, 2 * HEIGHT);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, passes[i].point, GL_RENDERBUFFER, depths);
    }
    for (int frame = 1; frame <= FRAMES; frame++) {
        const float nearest = 4 + frame * 0.5f;
        GLenum error;
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        if (framebuffer)
            glViewport(0, 0, 2 * WIDTH, 2 * HEIGHT);
        glEnable(GL_DEPTH_TEST);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glUseProgram(scene);
        glUniformMatrix4fv(glGetUniformLocation(scene, "camera"), 1, GL_FALSE, camera);
        wall(scene, colours[0], -nearest * 0.6f, nearest, nearest * 0.2f);
        wall(scene, colours[1], 0, 10, 2);
        wall(scene, colours[2], 40 * 0.6f, 40, 8);
        if (framebuffer) {
            glBindFramebuffer(GL_FRAMEBUFFER, 0);
            glViewport(0, 0, WIDTH, HEIGHT);
            glDisable(GL_DEPTH_TEST);
            glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
            glUseProgram(over);
            glBufferData(GL_ARRAY_BUFFER, sizeof corners, corners, GL_STREAM_DRAW);
            glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, NULL);
            glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
        }
        eglSwapBuffers(display, surface);
        error = glGetError();
        if (error) {
            fprintf(stderr, "frame %d: error 0x%x\n", frame, error);
            return 1;
        }
    }
    return 0;
}
