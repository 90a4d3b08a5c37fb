/* The scene of moves.c and stays.c. */
#include <GL/gl.h>

enum { WIDTH = 96, HEIGHT = 64 };

static inline void bars(void)
{
    glClearColor(0.1f, 0.2f, 0.3f, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-0.6, 0.6, -0.4, 0.4, 1, 50);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    /* Bars at several depths, each with its own colour. No component is half way between two steps of 255: windows and textures round those
     * differently. */
    for (int i = 0; i < 12; i++) {
        float x = -3 + 0.55f * i, z = -3 - 2.3f * (float)((i * 5) % 12);
        glColor3f((float)(i % 3) / 3, (float)(i % 5) / 5, 1 - (float)(i % 7) / 7);
        glBegin(GL_TRIANGLES);
        glVertex3f(x, -2, z);
        glVertex3f(x + 0.8f, -2, z);
        glVertex3f(x + 0.3f, 3, z - 1);
        glEnd();
    }
}
