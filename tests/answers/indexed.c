/* State by index: prints viewports, scissor rectangles, scissor tests and depth ranges after each step, and what three viewports show. A geometry
 * shader draws the same quad to viewport 0 in red, to 1 in green and to 2 in blue.
 *
 *   indexed viewport   viewports by glViewportIndexedf
 *   indexed array      the same by glViewportArrayv
 *   indexed fraction   the first viewport begins between two pixels
 *   indexed all        all are the same, by glViewport and glScissor
 *   indexed scissor    scissor rectangles by index, and tests of the second and the third
 *   indexed first      the same, and the test of the first alone
 *   indexed copied     the same, and the picture is copied, and drawn over in a framebuffer of the program's
 *   indexed list       viewports by index in a display list
 *   indexed range      depth ranges by index */
#define SURFACE_SIZE
enum { WIDTH = 96, HEIGHT = 48 };
#include "../support/c/shaders.h"
#include "../support/c/surface.h"
#include <string.h>

enum { PLACE = 0, COUNT = 3 };

static const char *const vertex = "#version 410\nlayout(location = 0) in vec2 place; void main() { gl_Position = vec4(place, 0.0, 1.0); }\n";
static const char *const geometry =
    "#version 410\nlayout(triangles, invocations = 3) in; layout(triangle_strip, max_vertices = 3) out; flat out vec3 colour;\n"
    "void main() { for (int i = 0; i < 3; i++) { gl_ViewportIndex = gl_InvocationID; colour = vec3(equal(ivec3(gl_InvocationID), ivec3(0, 1, 2)));\n"
    "gl_Position = gl_in[i].gl_Position; EmitVertex(); } EndPrimitive(); }\n";
static const char *const fragment = "#version 410\nflat in vec3 colour; out vec4 shown; void main() { shown = vec4(colour, 1.0); }\n";

/* Not constant: glViewportArrayv of Mesa 22.3 clamps them where they are. */
static GLfloat viewports[COUNT][4] = {{0, 0, 32, 48}, {31.75f, 0.25f, 32.5f, 48}, {64, 12, 31.5f, 24.5f}};
static const GLint scissors[COUNT][4] = {{8, 0, 80, 24}, {40, 12, 16, 24}, {72, 0, 8, 48}};
static const GLdouble ranges[COUNT][2] = {{0.25, 0.5}, {0, 1}, {1, 0.125}};

static void tell(const char *step)
{
    GLint first[4];
    printf("%s:\n", step);
    for (GLuint i = 0; i < COUNT; i++) {
        GLfloat v[4];
        GLint s[4];
        GLdouble r[2];
        glGetFloati_v(GL_VIEWPORT, i, v);
        glGetIntegeri_v(GL_SCISSOR_BOX, i, s);
        glGetDoublei_v(GL_DEPTH_RANGE, i, r);
        printf("  %u: viewport %g %g %g %g, scissor %d %d %d %d, tests %d, range %g %g\n", i, v[0], v[1], v[2], v[3], s[0], s[1], s[2], s[3],
               glIsEnabledi(GL_SCISSOR_TEST, i), r[0], r[1]);
    }
    glGetIntegerv(GL_VIEWPORT, first);
    printf("  the first viewport %d %d %d %d, error 0x%x\n", first[0], first[1], first[2], first[3], glGetError());
}

static void picture(void)
{
    static unsigned char all[HEIGHT][WIDTH][4];
    glReadPixels(0, 0, WIDTH, HEIGHT, GL_RGBA, GL_UNSIGNED_BYTE, all);
    for (int y = HEIGHT - 6; y >= 0; y -= 12) {
        printf("  ");
        for (int x = 4; x < WIDTH; x += 8) {
            const unsigned char *p = all[y][x];
            putchar(p[0] ? 'r' : p[1] ? 'g' : p[2] ? 'b' : '.');
        }
        puts("");
    }
}

static void set(const char *mode)
{
    glViewport(0, 0, WIDTH, HEIGHT);
    if (!strcmp(mode, "fraction"))
        glViewportIndexedf(0, 0.5f, 0.25f, 31.5f, 47.25f);
    else if (!strcmp(mode, "all")) {
        glViewport(8, 4, 80, 40);
        glScissor(16, 8, 64, 32);
    } else if (!strcmp(mode, "array"))
        glViewportArrayv(0, COUNT, viewports[0]);
    else
        for (GLuint i = 0; i < COUNT; i++)
            glViewportIndexedfv(i, viewports[i]);
    if (!strcmp(mode, "scissor") || !strcmp(mode, "first") || !strcmp(mode, "copied")) {
        glScissorArrayv(0, COUNT, scissors[0]);
        if (strcmp(mode, "scissor"))
            glEnablei(GL_SCISSOR_TEST, 0);
        else {
            glEnable(GL_SCISSOR_TEST);
            glDisablei(GL_SCISSOR_TEST, 0);
        }
    }
    if (!strcmp(mode, "range"))
        glDepthRangeArrayv(0, COUNT, ranges[0]);
}

static void copied(void)
{
    GLuint texture, framebuffer;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 0, 0, WIDTH, HEIGHT, 0);
    tell("copied");
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    quad(PLACE);
    tell("drawn over");
    glClear(GL_COLOR_BUFFER_BIT);
    tell("cleared again");
    picture();
    glBlitFramebuffer(0, 0, 8, 8, 16, 16, 24, 24, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(1, &texture);
    tell("deleted");
}

int main(int argc, char **argv)
{
    const char *mode = argc > 1 ? argv[1] : "";
    if (!open_surface() || !new_context(EGL_NO_CONTEXT))
        return 77;
    GLuint program = glCreateProgram(), list = glGenLists(1);
    attached(program, GL_VERTEX_SHADER, vertex);
    attached(program, GL_GEOMETRY_SHADER, geometry);
    attached(program, GL_FRAGMENT_SHADER, fragment);
    glLinkProgram(program);
    glNewList(list, GL_COMPILE);
    glColor3f(1, 1, 1);
    set(strcmp(mode, "list") ? "all" : mode);
    glEndList();
    for (int frame = 0; frame < 2; frame++) {
        printf("frame %d\n", frame);
        if (strcmp(mode, "list"))
            set(mode);
        else
            glCallList(list);
        tell("set");
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        tell("cleared");
        glUseProgram(program);
        quad(PLACE);
        tell("drawn");
        picture();
        tell("read");
        if (!strcmp(mode, "copied"))
            copied();
        eglSwapBuffers(display, surface);
        tell("swapped");
    }
    return 0;
}
