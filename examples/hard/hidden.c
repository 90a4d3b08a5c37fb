/* Cases of disocclusion: surfaces that one view sees and another does not, hard for views that are synthesised from one view and its depths. */
#include "hard.h"

static void box(double left, double right, double low, double high, double z, unsigned light, unsigned dark)
{
    const double corner[4][3] = {{left, low, -z}, {right, low, -z}, {left, high, -z}, {right, high, -z}};
    const unsigned rgb[2] = {light, dark};
    patch(corner, 2, 4, rgb);
}

/* A wall that extends beyond the picture, and bars in front of it: broad ones, thin ones close to each other, and one cut by each edge. */
static void bars(void)
{
    static const unsigned wall_rgb[2] = {0x7080a0, 0x506080};
    static const double wall[4][3] = {{-30, -20, -26}, {30, -20, -20}, {-30, 20, -26}, {30, 20, -20}};
    patch(wall, 24, 12, wall_rgb);
    for (int k = 0; k < 9; k++)
        box(-5.2 + 0.35 * k, -5 + 0.35 * k, -3, 3, 7, 0xe0a040, 0xc08020);
    box(-0.9, 0.6, -2, 2.5, 6, 0x60c060, 0x40a040);
    box(1.4, 1.5, -4, 4, 6.5, 0xe06060, 0xc04040);
    box(4.6, 9, -1, 4, 7.5, 0xb060e0, 0x9040c0);
    box(-9, -5.4, -4, -3.2, 7, 0xb060e0, 0x9040c0);
}

static void draw_gaps(int frame)
{
    (void)frame;
    usual_frustum(1, 100);
    glEnable(GL_DEPTH_TEST);
    bars();
    glDisable(GL_DEPTH_TEST);
}

/* Draws over the scene: added lights, a weapon after a clear of the depths, and a flat display. */
static void draw_layered(int frame)
{
    (void)frame;
    usual_frustum(1, 100);
    glEnable(GL_DEPTH_TEST);
    bars();
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glDepthMask(GL_FALSE);
    for (int k = 0; k < 5; k++)
        box(-6 + 2.5 * k, -4.5 + 2.5 * k, -1.5, 0.2 * k, 4.5 + 2 * k, 0x302818, 0x201810);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glClear(GL_DEPTH_BUFFER_BIT);
    box(0.2, 1.1, -1.4, -0.5, 1.9, 0xd0d0d0, 0x909090);
    glDisable(GL_DEPTH_TEST);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(0, demo_width, 0, demo_height, -1, 1);
    demo_flat_done();
    glMatrixMode(GL_MODELVIEW);
    box(20, 140, 12, 28, 0, 0xffff60, 0xff60ff);
}

const struct hard_case hidden_cases[] = {
    {"gaps", "bars before a wall, thin gaps, edges of the picture", NULL, draw_gaps},
    {"layered", "then lights, something in the hand, a flat display", NULL, draw_layered},
    {0}};
