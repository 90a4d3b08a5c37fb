/* Three walls at distances of 4 + frame/2, 10 and 40 units from the camera, in frames 1 to 10 of a surface without a window system.
 *
 * depths plain|reversed|inverted|overlay|weapon|cleared|nodepth|shader|block|reversed-shader
 *
 * reversed: glClipControl with depths from 1 (near) to 0 (infinitely far); inverted: glDepthRange(1, 0); overlay: a flat picture that
 * writes depths over everything at the end; weapon: a surface at 1.5 in a depth range of its own; cleared: the same after a clear of the
 * depths; nodepth: no depth test; shader, block: shaders, with the projection in a uniform or a uniform block. */
#include "shaders.h"
#include "surface.h"

#include <string.h>

enum { FRAMES = 10 };

static void wall(double x, double distance, double half)
{
    glBegin(GL_QUADS);
    glVertex3d(x - half, -half, -distance);
    glVertex3d(x + half, -half, -distance);
    glVertex3d(x + half, half, -distance);
    glVertex3d(x - half, half, -distance);
    glEnd();
}

static void scene(int frame)
{
    const double nearest = 4 + frame * 0.5;
    glColor3d(0.8, 0.2, 0.2);
    wall(-nearest * 0.6, nearest, nearest * 0.2);
    glColor3d(0.2, 0.8, 0.2);
    wall(0, 10, 2);
    glColor3d(0.2, 0.2, 0.8);
    wall(40 * 0.6, 40, 8);
}

/* A program that uses the current projection. */
static void shaders(int block)
{
    static const char *const vertex[] = {
        "#version 120\nuniform mat4 camera; void main() { gl_Position = camera * gl_Vertex; gl_FrontColor = gl_Color; }",
        "#version 150 compatibility\nlayout(std140) uniform View { mat4 camera; }; void main() { gl_Position = camera * gl_Vertex; gl_FrontColor = gl_Color; }",
    };
    static const char *const fragment = "void main() { gl_FragColor = gl_Color; }";
    GLuint program = glCreateProgram(), buffer;
    GLfloat camera[16];
    attached(program, GL_VERTEX_SHADER, vertex[block]);
    attached(program, GL_FRAGMENT_SHADER, fragment);
    glLinkProgram(program);
    glUseProgram(program);
    glGetFloatv(GL_PROJECTION_MATRIX, camera);
    if (block) {
        glGenBuffers(1, &buffer);
        glBindBufferBase(GL_UNIFORM_BUFFER, 0, buffer);
        glBufferData(GL_UNIFORM_BUFFER, sizeof camera, camera, GL_STATIC_DRAW);
    } else
        glUniformMatrix4fv(glGetUniformLocation(program, "camera"), 1, GL_FALSE, camera);
    glLoadIdentity();
}

int main(int count, char **arguments)
{
    const char *how = count > 1 ? arguments[1] : "plain";
    const int block = !strcmp(how, "block"), shader = block || strstr(how, "shader") != NULL;
    const int reversed = !strncmp(how, "reversed", 8), inverted = !strcmp(how, "inverted");
    PFNGLCLIPCONTROLPROC clip_control = (PFNGLCLIPCONTROLPROC)eglGetProcAddress("glClipControl");
    if (!open_surface() || !new_context(EGL_NO_CONTEXT))
        return 77;
    for (int frame = 1; frame <= FRAMES; frame++) {
        glViewport(0, 0, WIDTH, HEIGHT);
        glMatrixMode(GL_PROJECTION);
        if (reversed) {
            /* Near plane at 1; z = near, w = distance. */
            const double infinite[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0};
            clip_control(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
            glLoadMatrixd(infinite);
        } else {
            glLoadIdentity();
            glFrustum(-1, 1, -1, 1, 1, 100);
        }
        if (shader && frame == 1)
            shaders(block);
        if (inverted)
            glDepthRange(1, 0);
        glClearDepth(reversed || inverted ? 0 : 1);
        glDepthFunc(reversed || inverted ? GL_GREATER : GL_LESS);
        if (strcmp(how, "nodepth"))
            glEnable(GL_DEPTH_TEST);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        scene(frame);
        if (!strcmp(how, "overlay")) {
            glLoadIdentity();
            glDepthFunc(GL_ALWAYS);
            glColor3d(1, 1, 1);
            glRectd(-1, -1, 1, -0.5);
            glRectd(-1, 0.1, 1, 1);
        }
        if (!strcmp(how, "cleared"))
            glClear(GL_DEPTH_BUFFER_BIT);
        if (!strcmp(how, "weapon"))
            glDepthRange(0, 0.3);
        if (!strcmp(how, "weapon") || !strcmp(how, "cleared")) {
            glColor3d(1, 1, 0);
            wall(0, 1.5, 0.2);
        }
        glDepthRange(0, 1);
        eglSwapBuffers(display, surface);
    }
    return 0;
}
