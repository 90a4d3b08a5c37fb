/* Little geometry and many fragments: large surfaces, one before the other, each over the whole picture. A surface is a row of upright stripes
 * of equal width in two colours, so that the views differ. Blended from back to front unless --opaque. */
#include "demo.h"
#include <math.h>

static int overdraw = 16, textured, opaque;
const struct demo_option demo_options[] = {
    {"--overdraw", "surfaces, so fragments for each pixel, 1 to 256 (default 16)", &overdraw, 1},
    {"--textured", "with a mipmapped texture", &textured, 0},
    {"--opaque", "without blending; all pass the depth test, being nearer than those before", &opaque, 0},
    {0}};

void demo_setup(void)
{
    static const GLubyte white[3] = {255, 255, 255}, grey[3] = {130, 140, 150};
    if (overdraw > 256)
        demo_fail(2, "--overdraw: 1 to 256");
    if (textured) {
        demo_checker(256, 16, white, grey);
        glEnable(GL_TEXTURE_2D);
    }
    glClearColor(0.05f, 0.06f, 0.08f, 1.0f);
    glEnable(GL_DEPTH_TEST);
    if (!opaque) {
        glEnable(GL_BLEND);
        glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    }
}

void demo_frame(int frame)
{
    double t = demo_time(frame), aspect = (double)demo_width / demo_height;
    demo_viewport(0, 0, demo_width, demo_height);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    demo_perspective(40.0, aspect, 1.0, 60.0);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    for (int s = 0; s < overdraw; s++) {
        /* From depth 24 to depth 5; half as wide again as the picture, so that no view sees past the ends. */
        double depth = 24.0 - 19.0 * s / overdraw, h = depth * tan(20.0 * M_PI / 180.0) * 1.1, w = 1.5 * h * aspect;
        double x = -w - 0.37 * (s % 3);
        glBegin(GL_QUADS);
        for (int i = 0; x < w; i++, x += 1.1) {
            double hue = 0.9 * s + 1.7 * (i % 2) + t;
            glColor4d(0.55 + 0.43 * sin(hue), 0.55 + 0.43 * sin(hue + 2.1), 0.55 + 0.43 * sin(hue + 4.2), i % 2 ? 0.13 : 0.37);
            for (int c = 0; c < 4; c++) {
                double cx = c == 1 || c == 2 ? x + 1.1 : x, cy = c >= 2 ? h : -h;
                glTexCoord2d(0.3 * (cx + s), 0.3 * cy);
                glVertex3d(cx, cy, -depth);
            }
        }
        glEnd();
    }
}
