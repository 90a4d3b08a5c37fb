/* Draws a scene by fixed function into a framebuffer of its own and then shows it: by begin/end, a display list, a list that is executed while
 * it is compiled, or arrays and a list (the argument). The picture is the same. */
#include "surface.h"
#include <string.h>

static void triangle(float x, float z)
{
    glBegin(GL_TRIANGLES);
    glVertex3f(x - 1, -1, z);
    glVertex3f(x + 1, -1, z);
    glVertex3f(x, 1, z);
    glEnd();
}

int main(int count, char **arguments)
{
    static const GLfloat far[] = {-1, -1, -12, 3, -1, -12, 1, 1, -12}, corners[] = {-1, -1, 0, 0, 1, -1, 1, 0, 1, 1, 1, 1, -1, 1, 0, 1};
    const char *way = count > 1 ? arguments[1] : "";
    GLuint target, texture, depth;
    if (!open_surface() || !new_context(EGL_NO_CONTEXT))
        return 2;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, WIDTH, HEIGHT, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glGenRenderbuffers(1, &depth);
    glBindRenderbuffer(GL_RENDERBUFFER, depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, WIDTH, HEIGHT);
    glGenFramebuffers(1, &target);
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    glNewList(7, GL_COMPILE);
    triangle(0, -3);
    glEndList();
    for (int frame = 0; frame < 2; frame++) {
        glBindFramebuffer(GL_FRAMEBUFFER, target);
        glEnable(GL_DEPTH_TEST);
        glDisable(GL_TEXTURE_2D);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glMatrixMode(GL_PROJECTION);
        glLoadIdentity();
        glFrustum(-0.8, 0.8, -0.6, 0.6, 1, 100);
        glColor3f(0, 1, 0);
        if (!strcmp(way, "mixed")) {
            glEnableClientState(GL_VERTEX_ARRAY);
            glVertexPointer(3, GL_FLOAT, 0, far);
            glDrawArrays(GL_TRIANGLES, 0, 3);
        } else {
            glBegin(GL_TRIANGLES);
            for (int i = 0; i < 9; i += 3)
                glVertex3fv(far + i);
            glEnd();
        }
        glColor3f(1, 0, 0);
        if (!strcmp(way, "executed")) {
            glNewList(8, GL_COMPILE_AND_EXECUTE);
            triangle(0, -3);
            glEndList();
        } else if (!strcmp(way, "list") || !strcmp(way, "mixed")) {
            glCallList(7);
        } else {
            triangle(0, -3);
        }
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glLoadIdentity();
        glDisable(GL_DEPTH_TEST);
        glEnable(GL_TEXTURE_2D);
        glColor3f(1, 1, 1);
        glBegin(GL_TRIANGLE_FAN);
        for (int i = 0; i < 16; i += 4) {
            glTexCoord2f(corners[i + 2], corners[i + 3]);
            glVertex2f(corners[i], corners[i + 1]);
        }
        glEnd();
        eglSwapBuffers(display, surface);
    }
    return glGetError() ? 3 : 0;
}
