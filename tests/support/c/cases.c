/* Small cases that once came out differently under the layer, most of them found by random calls; prints all that a program can read back.
 * Each case has a context of its own. */
#include "surface.h"
#include <stdint.h>

static const char *name;

static void error(void) { printf("%s: error 0x%x\n", name, glGetError()); }

static void colour(void)
{
    GLfloat v[4];
    glGetFloatv(GL_CURRENT_COLOR, v);
    printf("%s: colour %g %g %g %g\n", name, v[0], v[1], v[2], v[3]);
}

static void pixels(void)
{
    static uint32_t all[WIDTH * HEIGHT];
    uint64_t hash = 0xcbf29ce484222325u;
    int drawn = 0;
    glReadPixels(0, 0, WIDTH, HEIGHT, GL_RGBA, GL_UNSIGNED_BYTE, all);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        hash = (hash ^ all[i]) * 0x100000001b3u;
        drawn += all[i] != 0;
    }
    printf("%s: pixels %d %016llx\n", name, drawn, (unsigned long long)hash);
}

/* The colour after a list with another run after its primitive. */
static void list_colours(void)
{
    for (int vertices = 1; vertices < 4; vertices++) {
        glColor3f(1, 1, 1);
        glPushMatrix();
        glNewList(1, GL_COMPILE);
        glColor3f(0.25f, 0.25f, 0.25f);
        glBegin(GL_TRIANGLE_STRIP);
        glColor4f(0.75f, 0.75f, 0.75f, 0.5f);
        for (int i = 0; i < vertices; i++)
            glVertex2f(0.3f * (float)i, 0.1f * (float)(i * i));
        glEnd();
        glPopMatrix();
        glEndList();
        glCallList(1);
        colour();
    }
}

/* Only a list names these textures, above the names that the layer takes at the start; then the layer creates more of its own. */
static void list_textures(void)
{
    GLint bound;
    glNewList(1, GL_COMPILE);
    for (GLuint texture = 4; texture < 30; texture++)
        glBindTexture(GL_TEXTURE_2D, texture);
    glEndList();
    glWindowPos2i(4, 4);
    glCopyPixels(0, 0, 8, 8, GL_DEPTH);
    glCallList(1);
    error();
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    printf("%s: texture %d\n", name, bound);
}

/* Colour material follows the colour of a list that was compiled and executed. */
static void list_materials(void)
{
    glEnable(GL_COLOR_MATERIAL);
    glNewList(1, GL_COMPILE_AND_EXECUTE);
    glColor3f(0.58f, 0.7f, 0.52f);
    glBegin(GL_TRIANGLE_STRIP);
    glVertex3f(-0.6f, -0.2f, 0.1f);
    glEnd();
    glEndList();
    glEnable(GL_LIGHTING);
    glBegin(GL_LINES);
    glVertex2f(0.4f, 0.9f);
    glVertex2f(-0.16f, 0.17f);
    glColor4ub(94, 56, 52, 220);
    glEvalCoord1f(0.3f);
    glVertex2f(0.4f, -0.4f);
    glEnd();
    pixels();
}

/* An illegal glCallLists within a primitive. */
static void wrong_lists(void)
{
    const GLubyte lists[] = {1, 2};
    glBegin(GL_TRIANGLES);
    glCallLists(-1, GL_UNSIGNED_BYTE, lists);
    glVertex2f(0, 0);
    glEnd();
    error();
    glBegin(GL_TRIANGLES);
    glCallLists(2, GL_RGBA, lists);
    glEnd();
    error();
    glEnd();
    error();
}

/* Blits that enlarge a picture, with samples on the edges between pixels. */
static void scaled_blits(void)
{
    static const GLint to[][4] = {{17, 1, 40, 30}, {22, 13, 40, 30}, {19, 7, 40, 30}, {20, 47, 63, 10}, {50, 5, 20, 40}};
    for (unsigned i = 0; i < sizeof to / sizeof *to; i++)
        for (GLenum filter = GL_NEAREST; filter <= GL_LINEAR; filter++) {
            glClear(GL_COLOR_BUFFER_BIT);
            glBegin(GL_LINES);
            for (int x = 0; x < 12; x++) {
                glColor3f((float)x / 12, 1, 1 - (float)x / 12);
                glVertex2f(-1 + ((float)x + 0.5f) / 32, -1);
                glVertex2f(-1 + ((float)x + 0.5f) / 32, -1 + (float)x / 12);
            }
            glEnd();
            glBlitFramebuffer(0, 0, 8 + (GLint)i, 5 + (GLint)i, to[i][0], to[i][1], to[i][2], to[i][3], GL_COLOR_BUFFER_BIT, filter);
            pixels();
        }
    error();
}

int main(void)
{
    static const struct { const char *name; void (*run)(void); } all[] = {
        {"list colours", list_colours}, {"list textures", list_textures}, {"list materials", list_materials},
        {"wrong lists", wrong_lists}, {"scaled blits", scaled_blits},
    };
    if (!open_surface())
        return 2;
    for (unsigned i = 0; i < sizeof all / sizeof *all; i++) {
        EGLContext context = new_context(EGL_NO_CONTEXT);
        if (!context)
            return 2;
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        name = all[i].name;
        all[i].run();
        error();
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display, context);
    }
    return 0;
}
