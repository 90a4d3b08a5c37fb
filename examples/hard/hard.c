/* Picks the case, and has the functions that all cases draw with. */
#include "hard.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *name;
static int list;
const struct demo_option demo_options[] = {
    {"--case", "draw this scene", &name, DEMO_WORD},
    {"--list", "list the scenes and end", &list, DEMO_NOTHING},
    {0}};

static const struct hard_case *chosen;

void demo_setup(void)
{
    const struct hard_case *const all[] = {places_cases, depths_cases, surfaces_cases, answers_cases, hidden_cases};
    for (unsigned i = 0; i < sizeof all / sizeof *all; i++) {
        for (const struct hard_case *c = all[i]; c->name; c++) {
            if (list)
                printf("%-18s %s\n", c->name, c->about);
            else if (name && !strcmp(c->name, name))
                chosen = c;
        }
    }
    if (list)
        exit(0);
    if (!chosen)
        demo_fail(2, "--case: one of those of --list");
    glClearColor(0.2f, 0.2f, 0.3f, 1);
    if (chosen->setup)
        chosen->setup();
}

void demo_frame(int frame)
{
    demo_viewport(0, 0, demo_width, demo_height);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    chosen->draw(frame);
    fflush(stdout);
}

void usual_frustum(double z_near, double z_far)
{
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-0.8 * z_near, 0.8 * z_near, -0.6 * z_near, 0.6 * z_near, z_near, z_far);
    demo_projection_done();
    glMatrixMode(GL_MODELVIEW);
}

/* ---- vertices ---- */

struct vertex { GLfloat position[4], normal[3], texture[2]; GLubyte colour[4]; };
static struct vertex now = {{0, 0, 0, 1}, {0, 0, 1}, {0, 0}, {255, 255, 255, 255}}, *kept;
static int count, room, immediate;
static GLenum kind;

void send_immediate(int yes) { immediate = yes; }

void start(GLenum mode)
{
    kind = mode;
    count = 0;
}

void colour(unsigned rgb)
{
    now.colour[0] = (GLubyte)(rgb >> 16);
    now.colour[1] = (GLubyte)(rgb >> 8);
    now.colour[2] = (GLubyte)rgb;
}

void normal(double x, double y, double z)
{
    now.normal[0] = (GLfloat)x;
    now.normal[1] = (GLfloat)y;
    now.normal[2] = (GLfloat)z;
}

void texture(double s, double t)
{
    now.texture[0] = (GLfloat)s;
    now.texture[1] = (GLfloat)t;
}

void at(double x, double y, double z) { at4(x, y, z, 1); }

void at4(double x, double y, double z, double w)
{
    now.position[0] = (GLfloat)x;
    now.position[1] = (GLfloat)y;
    now.position[2] = (GLfloat)z;
    now.position[3] = (GLfloat)w;
    if (count == room) {
        room = room ? 2 * room : 256;
        kept = realloc(kept, (size_t)room * sizeof *kept);
        if (!kept)
            demo_fail(1, "out of memory");
    }
    kept[count++] = now;
}

void finish(void)
{
    if (immediate) {
        glBegin(kind);
        for (const struct vertex *v = kept; v < kept + count; v++) {
            glColor4ubv(v->colour);
            glNormal3fv(v->normal);
            glTexCoord2fv(v->texture);
            glVertex4fv(v->position);
        }
        glEnd();
        return;
    }
    glPushClientAttrib(GL_CLIENT_VERTEX_ARRAY_BIT);
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_NORMAL_ARRAY);
    glEnableClientState(GL_TEXTURE_COORD_ARRAY);
    glEnableClientState(GL_COLOR_ARRAY);
    glVertexPointer(4, GL_FLOAT, sizeof *kept, kept->position);
    glNormalPointer(GL_FLOAT, sizeof *kept, kept->normal);
    glTexCoordPointer(2, GL_FLOAT, sizeof *kept, kept->texture);
    glColorPointer(4, GL_UNSIGNED_BYTE, sizeof *kept, kept->colour);
    glDrawArrays(kind, 0, count);
    glPopClientAttrib();
}

void patch(const double corner[4][3], int columns, int rows, const unsigned rgb[2])
{
    start(GL_TRIANGLES);
    for (int row = 0; row < rows; row++) {
        for (int column = 0; column < columns; column++) {
            static const int around[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
            colour(rgb[(row + column) & 1]);
            for (int k = 0; k < 6; k++) {
                double s = (double)(column + around[k][0]) / columns, t = (double)(row + around[k][1]) / rows, p[3];
                for (int c = 0; c < 3; c++)
                    p[c] = (1 - t) * ((1 - s) * corner[0][c] + s * corner[1][c]) + t * ((1 - s) * corner[2][c] + s * corner[3][c]);
                texture(s, t);
                at(p[0], p[1], p[2]);
            }
        }
    }
    finish();
}

/* ---- markers ---- */

void marker_corners(double x, double corner[4][2])
{
    static const double across[4] = {-8, 8, 8, -8};
    double low = (demo_height - MARKER_ROWS) / 2;
    for (int k = 0; k < 4; k++) {
        int up = k >= 2;
        corner[k][0] = x + across[k] + (up ? 0.5 : -0.5) * MARKER_LEAN;
        corner[k][1] = low + (up ? MARKER_ROWS : 0);
    }
}

void tell_marker(unsigned rgb, double x, double depth) { printf("marker %06x %.17g %.17g\n", rgb, x, depth); }

void tell_lens(double a) { printf("lens %.17g\n", a); }

void marker(unsigned rgb, double x, double depth, double w, double a, double b)
{
    double corner[4][2];
    marker_corners(x, corner);
    tell_marker(rgb, x, depth);
    start(GL_TRIANGLE_FAN);
    colour(rgb);
    for (int k = 0; k < 4; k++) {
        double ndc_x = 2 * corner[k][0] / demo_width - 1, ndc_y = 2 * corner[k][1] / demo_height - 1;
        at4(w * ndc_x * depth / a, w * ndc_y * depth / b, -w * depth, w);
    }
    finish();
}
