/* The frame is copied to textures and drawn over itself: a trail of earlier frames by glCopyTexImage2D, water that mirrors the picture so far
 * by glCopyTexSubImage2D, and an inset by glCopyPixels. Nothing is copied to a texture without texels, as games do at start. With --listed, display lists copy to the textures. */
#include "demo.h"
#include <stddef.h>

static int listed;
const struct demo_option demo_options[] = {{"--listed", "display lists copy to the textures", &listed, 0}, {0}};

static GLuint nothing, trail, water, copies; /* copies: a list for each texture */
static int size_w, size_h; /* powers of two that hold the picture */

void demo_setup(void)
{
    glClearColor(0.11f, 0.13f, 0.19f, 1.0f);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_LIGHT0);
    glEnable(GL_NORMALIZE);
    glEnable(GL_COLOR_MATERIAL);
    for (size_w = 1; size_w < demo_width;)
        size_w *= 2;
    for (size_h = 1; size_h < demo_height;)
        size_h *= 2;
    glGenTextures(1, &nothing);
    glBindTexture(GL_TEXTURE_2D, nothing);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 0, 0, 0, GL_RGB, GL_UNSIGNED_BYTE, NULL);
    glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, 0, 0);
    glGenTextures(1, &trail);
    glGenTextures(1, &water);
    glBindTexture(GL_TEXTURE_2D, water);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, size_w, size_h, 0, GL_RGB, GL_UNSIGNED_BYTE, NULL);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

static void flat(void)
{
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(0.0, demo_width, 0.0, demo_height, -1.0, 1.0);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_LIGHTING);
    glEnable(GL_TEXTURE_2D);
}

/* A rectangle of the window, textured with the part of a copy between two heights. */
static void rect(int x0, int y0, int x1, int y1, double from, double to)
{
    double l = (double)x0 / size_w, r = (double)x1 / size_w, b = from / size_h, t = to / size_h;
    glBegin(GL_QUADS);
    glTexCoord2d(l, b), glVertex2i(x0, y0);
    glTexCoord2d(r, b), glVertex2i(x1, y0);
    glTexCoord2d(r, t), glVertex2i(x1, y1);
    glTexCoord2d(l, t), glVertex2i(x0, y1);
    glEnd();
}

static void scene(double t)
{
    static const GLfloat light[4] = {1.5f, 2.5f, 2.0f, 0.0f};
    demo_perspective(42.0, (double)demo_width / demo_height, 1.5, 40.0);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_LIGHTING);
    glDisable(GL_TEXTURE_2D);
    glLightfv(GL_LIGHT0, GL_POSITION, light);
    for (int i = 0; i < 3; i++) {
        glLoadIdentity();
        glTranslated(-2.0 + 2.0 * i + 4.0 * t, 0.9, -6.0 - 2.5 * i);
        glRotated(30.0 + 90.0 * t, 0.3, 1.0, 0.2);
        glColor3d(0.87 - 0.21 * i, 0.33, 0.23 + 0.19 * i);
        demo_box(0.6, 0.5, 0.5);
    }
}

static void copy_trail(void)
{
    glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, demo_x, demo_y, size_w, size_h, 0);
}

static void copy_water(void)
{
    glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, demo_x, demo_y, demo_width, demo_height);
}

static void compile(void)
{
    copies = glGenLists(2);
    glNewList(copies, GL_COMPILE);
    copy_trail();
    glEndList();
    glNewList(copies + 1, GL_COMPILE);
    copy_water();
    glEndList();
}

void demo_frame(int frame)
{
    int w = demo_width, h = demo_height;
    demo_viewport(0, 0, w, h);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    scene(demo_time(frame));
    flat();
    if (frame > 0) { /* the earlier frames, fainter */
        glBindTexture(GL_TEXTURE_2D, trail);
        glEnable(GL_BLEND);
        glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
        glColor4d(1.0, 1.0, 1.0, 0.41);
        rect(0, h / 3, w, h, h / 3, h);
        glDisable(GL_BLEND);
    }
    glBindTexture(GL_TEXTURE_2D, trail);
    if (listed && !copies)
        compile();
    if (listed)
        glCallList(copies);
    else
        copy_trail();
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);

    glBindTexture(GL_TEXTURE_2D, water);
    if (listed)
        glCallList(copies + 1);
    else
        copy_water();
    glColor4d(0.47, 0.63, 0.83, 1.0);
    rect(0, 0, w, h / 3, h / 3 + h / 3, h / 3);
    glDisable(GL_TEXTURE_2D);

    glRasterPos2d(7.25, 5.25);
    glCopyPixels(demo_x + w / 2, demo_y + h / 2, 60, 40, GL_COLOR);
    glEnable(GL_DEPTH_TEST);
}
