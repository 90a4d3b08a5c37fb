/* A scene as a toolkit draws it in a widget: in a context of its own, current on an invisible surface, into a framebuffer whose image another
 * context shows in the window. The first frame shows it by a texture, the second, larger one by a blit.
 *
 * widget [FILE]: two frames, or frames until the file exists. */
#include "shaders.h"
#include "surface.h"

#include <unistd.h>

enum { PLACE = 0 };

static const char *const vertex = "#version 120\nuniform mat4 camera; uniform float depth; attribute vec2 place;\n"
                                  "void main() { gl_Position = camera * vec4(place * 0.25 * depth, -depth, 1.0); }\n";
static const char *const fragment = "void main() { gl_FragColor = vec4(0.0, 1.0, 0.0, 1.0); }";
static const char *const whole = "attribute vec2 place; varying vec2 at; void main() { at = place * 0.5 + 0.5; gl_Position = vec4(place, 0.0, 1.0); }";
static const char *const picture = "uniform sampler2D image; varying vec2 at; void main() { gl_FragColor = texture2D(image, at); }";

static void tell(const char *what, int x, int y)
{
    unsigned char pixel[4];
    glReadPixels(x, y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
    printf("%s: pixel %d %d %d, error 0x%x\n", what, pixel[0], pixel[1], pixel[2], glGetError());
}

int main(int count, char **arguments)
{
    static const EGLint one[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    GLuint texture, depth, framebuffer, shown, scene, reader;
    EGLContext window, widget;
    EGLSurface unseen;
    if (!open_surface() || !(window = new_context(EGL_NO_CONTEXT)))
        return 2;
    shown = linked(whole, picture, PLACE);
    glGenFramebuffers(1, &reader);
    unseen = eglCreatePbufferSurface(display, config, one);
    widget = eglCreateContext(display, config, window, NULL);
    if (!eglMakeCurrent(display, unseen, unseen, widget))
        return 3;
    scene = linked(vertex, fragment, PLACE);
    glGenTextures(1, &texture);
    glGenRenderbuffers(1, &depth);
    glGenFramebuffers(1, &framebuffer);
    for (int frame = 0; count > 1 ? access(arguments[1], F_OK) : frame < 2; frame++) {
        int size = frame % 2 ? 2 : 1;
        /* Narrower than the window: the widget has another aspect ratio. */
        int w = WIDTH * size / 2, h = HEIGHT * size;
        const float a = (float)h / (float)w;
        const GLfloat camera[] = {a, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.01f, -1, 0, 0, -1.005f, 0};
        eglMakeCurrent(display, unseen, unseen, widget);
        glBindTexture(GL_TEXTURE_2D, texture);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, w, h, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glBindRenderbuffer(GL_RENDERBUFFER, depth);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, w, h);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, depth);
        glViewport(0, 0, w, h);
        glEnable(GL_DEPTH_TEST);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glUseProgram(scene);
        glUniformMatrix4fv(glGetUniformLocation(scene, "camera"), 1, GL_FALSE, camera);
        /* w is 1 for the scene here, as it is for draws without depth. */
        glUniform1f(glGetUniformLocation(scene, "depth"), 1.0f);
        quad(PLACE);
        tell("in the widget", w / 2, h / 2);
        glFlush();

        eglMakeCurrent(display, surface, surface, window);
        glViewport(0, 0, WIDTH, HEIGHT);
        glClearColor(0, 0, 1, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        if (frame % 2 == 0) {
            glBindTexture(GL_TEXTURE_2D, texture);
            glUseProgram(shown);
            glDisable(GL_DEPTH_TEST);
            quad(PLACE);
        } else {
            glBindFramebuffer(GL_FRAMEBUFFER, reader);
            glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
            glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
            glBlitFramebuffer(0, 0, w, h, 0, 0, WIDTH, HEIGHT, GL_COLOR_BUFFER_BIT, GL_NEAREST);
            glBindFramebuffer(GL_FRAMEBUFFER, 0);
        }
        tell("in the window", WIDTH / 2, HEIGHT / 2);
        eglSwapBuffers(display, surface);
    }
    /* The window's context works on after the widget's is destroyed. */
    eglDestroyContext(display, widget);
    glBindTexture(GL_TEXTURE_2D, texture);
    glUseProgram(shown);
    glClear(GL_COLOR_BUFFER_BIT);
    quad(PLACE);
    tell("of a context that is gone", WIDTH / 2, HEIGHT / 2);
    glDeleteTextures(1, &texture);
    eglSwapBuffers(display, surface);
    return 0;
}
