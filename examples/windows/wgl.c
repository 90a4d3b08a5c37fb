/* The scene by OpenGL through WGL, in immediate mode. */
#include "scene.h"
#include <GL/gl.h>

static void colour(DWORD argb)
{
    glColor4ub(argb >> 16 & 255, argb >> 8 & 255, argb & 255, argb >> 24);
}

static void frame(int number)
{
    static const float sign[4][2] = {{10, 10}, {60, 10}, {60, 30}, {10, 30}};
    matrix m;
    glClearColor(16 / 255.0f, 24 / 255.0f, 40 / 255.0f, 0.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    projection(m);
    /* From z between 0 and w to z between -w and w. */
    m[10] = 2.0f * m[10] - m[11];
    m[14] = 2.0f * m[14];
    glMatrixMode(GL_PROJECTION);
    glLoadMatrixf(m);
    glMatrixMode(GL_MODELVIEW);
    for (int i = 0; i < 6; i++) {
        place_of(m, number, i);
        glLoadMatrixf(m);
        glBegin(GL_TRIANGLES);
        for (int k = 0; k < 36; k++) {
            float p[3];
            corner(k, p);
            colour(colour_of(i, k));
            glVertex3fv(p);
        }
        glEnd();
    }
    glDisable(GL_DEPTH_TEST);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(0.0, WIDTH, HEIGHT, 0.0, -1.0, 1.0);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glBegin(GL_TRIANGLE_FAN);
    for (int i = 0; i < 4; i++) {
        colour(i == 2 ? 0xff808080 : 0xffffffff);
        glVertex2fv(sign[i]);
    }
    glEnd();
}

int main(int count, char **words)
{
    HDC context = GetDC(begin(count, words));
    PIXELFORMATDESCRIPTOR how = {0};
    how.nSize = sizeof how;
    how.nVersion = 1;
    how.dwFlags = PFD_DRAW_TO_WINDOW | PFD_SUPPORT_OPENGL | PFD_DOUBLEBUFFER;
    how.cColorBits = 24;
    how.cDepthBits = 24;
    if (!SetPixelFormat(context, ChoosePixelFormat(context, &how), &how) || !wglMakeCurrent(context, wglCreateContext(context)))
        return fprintf(stderr, "no context of OpenGL\n"), 1;
    for (int i = 0; i < frames; i++) {
        answer();
        frame(i);
        SwapBuffers(context);
    }
    return 0;
}
