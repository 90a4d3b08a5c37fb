/* The members of the crowd of crowd.c, and their places. */
#include <math.h>

enum { PAWNS = 140, LOW = 40, HIGH = 40, GEMS = 80, CROWD = PAWNS + LOW + HIGH + GEMS };
enum { PAWN, RING, GEM, SHADOW }; /* kinds, with the shader's numbers */
static const struct { int kind; GLuint from, count; } groups[] = {
    {PAWN, 0, PAWNS}, {RING, PAWNS, LOW}, {RING, PAWNS + LOW, HIGH}, {GEM, PAWNS + LOW + HIGH, GEMS}, {SHADOW, 0, CROWD}};
enum { GROUPS = sizeof groups / sizeof *groups };

struct one { GLfloat place[3], size[3]; GLubyte colour[4], unused[4]; }; /* two texels of four floats */

static double noise(unsigned n) { n = (n ^ 61u) * 2654435761u; n = (n ^ n >> 15) * 2246822519u; return (n >> 8) / 16777216.0; }

static void hue(GLubyte colour[4], double h, double middle, double swing)
{
    for (int k = 0; k < 3; k++)
        colour[k] = (GLubyte)(255.0 * (middle + swing * cos(2.0 * M_PI * (h + k / 3.0))));
    colour[3] = 255;
}

/* Moves everybody: pawns in circles, rings over them in two wreaths, gems in a spiral. */
static void move(struct one *o, double t)
{
    static const int circle[] = {12, 20, 28, 36, 44};
    unsigned n = 0;
    for (int c = 0; c < 5; c++)
        for (int k = 0; k < circle[c]; k++, n++, o++) {
            double way = c % 2 ? -1.0 : 1.0, a = 2.0 * M_PI * k / circle[c] + 0.22 * way * t + 0.3 * c, r = 1.35 + 1.13 * c;
            struct one pawn = {{(GLfloat)(r * cos(a)), 0.0f, (GLfloat)(r * sin(a))},
                               {(GLfloat)(0.62 + 0.2 * noise(n)), (GLfloat)(0.72 + 0.35 * noise(n + 300)), (GLfloat)a}, {0}, {0}};
            hue(pawn.colour, 0.17 * c + 0.12 * noise(n + 600) + 0.02, 0.57, 0.33);
            *o = pawn;
        }
    for (int k = 0; k < LOW + HIGH; k++, n++, o++) {
        double a = 2.0 * M_PI * k / LOW + (k < LOW ? 0.3 : -0.4) * t, r = k < LOW ? 4.7 : 2.6, up = k < LOW ? 1.35 : 1.9;
        struct one ring = {{(GLfloat)(r * cos(a)), (GLfloat)(up + 0.2 * sin(3.0 * a)), (GLfloat)(r * sin(a))},
                           {(GLfloat)(k < LOW ? 0.17 : 0.11), (GLfloat)(k < LOW ? 0.17 : 0.11), (GLfloat)a}, {0}, {0}};
        hue(ring.colour, k < LOW ? 0.93 : 0.05, 0.74, 0.2);
        *o = ring;
    }
    for (int k = 0; k < GEMS; k++, n++, o++) {
        double a = 0.47 * k + 0.5 * t, r = 0.35 + 0.045 * k;
        struct one gem = {{(GLfloat)(r * cos(a)), (GLfloat)(3.3 - 0.018 * k), (GLfloat)(r * sin(a))},
                          {0.085f, (GLfloat)(0.14 + 0.05 * noise(n)), 0.0f}, {0}, {0}};
        hue(gem.colour, 0.35 + 0.004 * k, 0.66, 0.33);
        *o = gem;
    }
}
