/* A small scene, and a hash of its pixels. Compiled into the host and into its plugin. */
#include "scene.h"
#include <GL/gl.h>
#include <stdio.h>

void scene(const char *who, int frame, int width, int height)
{
    static unsigned char pixels[WIDTH * HEIGHT * 4];
    unsigned long long hash = 0xcbf29ce484222325u;
    glViewport(0, 0, width, height);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-0.7, 0.7, -0.5, 0.5, 1, 20);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslatef(0, 0, -4);
    glRotatef(20.0f * (float)frame, 0.2f, 1, 0);
    glEnable(GL_DEPTH_TEST);
    glClearColor(0.1f, 0.2f, 0.3f, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glBegin(GL_TRIANGLES);
    for (int i = 0; i < 6; i++) {
        glColor3f((float)i / 6, 1 - (float)i / 6, 0.3f);
        glVertex3f((float)(i % 3) - 1, (float)(i % 2) - 0.5f, (float)i / 6 - 0.4f);
    }
    glEnd();
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    for (int i = 0; i < width * height * 4; i++)
        hash = (hash ^ pixels[i]) * 0x100000001b3u;
    printf("%s frame %d %dx%d %016llx error %x\n", who, frame, width, height, hash, glGetError());
    fflush(stdout);
}
