/* Programs with shaders: prints their state and errors, with draws in between. The first frame is drawn by a program with a camera, linked
 * twice; the second by one without, while errors are made. */
#include "shaders.h"
#include "surface.h"
#include <GL/glext.h>
#include <string.h>

enum { PLACE = 3 };

/* Links a program, then detaches and deletes its shaders. */
static GLuint made(GLuint program, const char *fragment, int flat)
{
    const char *vertex = flat ? "#version 120\nattribute vec2 place; void main() { gl_Position = vec4(place, 0.0, 1.0); }\n"
                              : "#version 120\nuniform mat4 camera; uniform float depth; attribute vec2 place;\n"
                                "void main() { gl_Position = camera * vec4(place * depth * 0.4, -depth, 1.0); }\n";
    GLuint shaders[2] = {attached(program, GL_VERTEX_SHADER, vertex), attached(program, GL_FRAGMENT_SHADER, fragment)};
    glBindAttribLocation(program, PLACE, "place");
    glLinkProgram(program);
    for (int i = 0; i < 2; i++) {
        glDetachShader(program, shaders[i]);
        glDeleteShader(shaders[i]);
    }
    return program;
}

static void tell(const char *what)
{
    GLint count[3], program;
    glGetIntegerv(GL_CURRENT_PROGRAM, &program);
    printf("%s: a program: %d, error 0x%x\n", what, program > 0, glGetError());
    if (program <= 0)
        return;
    glGetProgramiv((GLuint)program, GL_ACTIVE_UNIFORMS, &count[0]);
    glGetProgramiv((GLuint)program, GL_ACTIVE_ATTRIBUTES, &count[1]);
    glGetProgramiv((GLuint)program, GL_ATTACHED_SHADERS, &count[2]);
    printf("  %d uniforms, %d attributes, %d shaders\n", count[0], count[1], count[2]);
    for (GLint i = 0; i < count[0]; i++) {
        char name[40];
        GLfloat value[16] = {0};
        GLint size;
        GLenum kind;
        glGetActiveUniform((GLuint)program, (GLuint)i, sizeof name, NULL, &size, &kind, name);
        glGetUniformfv((GLuint)program, glGetUniformLocation((GLuint)program, name), value);
        printf("  %s at %d: %g\n", name, glGetUniformLocation((GLuint)program, name), value[0]);
    }
    unsigned char pixel[4];
    glReadPixels(32, 24, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
    printf("  pixel %d %d %d, error 0x%x\n", pixel[0], pixel[1], pixel[2], glGetError());
}

int main(void)
{
    const GLfloat camera[16] = {1.5f, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.04f, -1, 0, 0, -2.04f, 0};
    if (!open_surface() || !new_context(EGL_NO_CONTEXT))
        return 2;
    glEnable(GL_DEPTH_TEST);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    GLuint seen = made(glCreateProgram(), "void main() { gl_FragColor = vec4(1.0, 0.0, 0.0, 1.0); }", 0);
    glUseProgram(seen);
    glUniformMatrix4fv(glGetUniformLocation(seen, "camera"), 1, 0, camera);
    glUniform1f(glGetUniformLocation(seen, "depth"), 20.0f);
    quad(PLACE);
    tell("a far quad");
    made(seen, "uniform float green; void main() { gl_FragColor = vec4(0.0, green, 0.0, 1.0); }", 0);
    glUniformMatrix4fv(glGetUniformLocation(seen, "camera"), 1, 0, camera);
    glUniform1f(glGetUniformLocation(seen, "depth"), 20.0f);
    glUniform1f(glGetUniformLocation(seen, "green"), 0.25f);
    glClear(GL_DEPTH_BUFFER_BIT);
    quad(PLACE);
    tell("linked anew");
    glDeleteProgram(seen);
    glUniform1f(glGetUniformLocation(seen, "depth"), 2.0f);
    glUniform1f(glGetUniformLocation(seen, "green"), 1.0f);
    quad(PLACE);
    tell("deleted, and nearer");
    GLint gone[2];
    glGetProgramiv(seen, GL_DELETE_STATUS, &gone[0]);
    eglSwapBuffers(display, surface);

    GLuint plain = made(glCreateProgram(), "void main() { gl_FragColor = vec4(0.0, 0.0, 1.0, 1.0); }", 1);
    glUseProgram(plain);
    glGetProgramiv(plain, GL_DELETE_STATUS, &gone[1]);
    printf("deleted: %d %d, there: %d %d\n", gone[0], gone[1], glIsProgram(seen), glIsProgram(plain));
    for (int i = 0; i < 3; i++) {
        glEnable(GL_TEXTURE_2D + 0x7000);
        quad(PLACE);
        printf("an error before a draw: 0x%x\n", glGetError());
    }
    tell("without a camera");
    glUseProgram(0);
    tell("none");
    eglSwapBuffers(display, surface);
    return 0;
}
