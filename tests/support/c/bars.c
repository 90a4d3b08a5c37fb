/* The wall and the bars of `hard --case gaps`, by shaders or in fixed function; prints after each of four frames all state that a program can
 * read back, and a sum over its pixels. The argument says how it is drawn:
 *   matrix     GLSL 1.10 with the matrices of fixed function, in small triangles
 *   begin      the same, between glBegin and glEnd
 *   old        GLSL 1.20, the camera in a uniform, the wall in larger triangles
 *   coord      the same, the wall's colours from gl_FragCoord
 *   new        GLSL 3.30 in a core context, with a name like one of the layer's, and a texture and a sampler in the unit that the layer uses
 *   instanced  the same, by glDrawArraysInstanced
 *   strips     fixed function, a strip for each column of the wall, as large as its squares; fans, polygons, quads: likewise
 *   indexed    the same, by indices of the program's own
 *   cyan       the same as strips, without writing red
 *   list       fixed function, in a display list
 *   several    GLSL 1.20, with two colour outputs
 *   geometry   GLSL 1.50, with a geometry shader
 *   es         GLSL ES 3.00 in a context of OpenGL ES */
#define SURFACE_SIZE
enum { WIDTH = 400, HEIGHT = 300 };
#include "shaders.h"
#include "surface.h"
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 24, ROWS = 12, CUT = 12, BARS = 13, MOST = 6 * (COLUMNS * ROWS * CUT * CUT + BARS * 8), UNIT = 31 };
struct corner { GLfloat place[3], colour[3]; };
static struct corner corners[MOST];
static GLsizei count, wall_count;
static const char *way;

static GLushort places[MOST]; /* elements of indexed strips */

static int is(const char *name) { return !strcmp(way, name); }

static void add(double x, double y, double z, unsigned rgb)
{
    struct corner c = {{(GLfloat)x, (GLfloat)y, (GLfloat)z},
                       {(GLfloat)(rgb >> 16) / 255.0f, (GLfloat)(rgb >> 8 & 255) / 255.0f, (GLfloat)(rgb & 255) / 255.0f}};
    corners[count++] = c;
}

/* Two-coloured squares between two sides at their own distances, each square subdivided into cut x cut. */
static void patch(double left, double right, double low, double high, double near_left, double near_right, int columns, int rows,
                  int cut, unsigned light, unsigned dark)
{
    for (int i = 0; i < columns * cut; i++)
        for (int j = 0; j < rows * cut; j++)
            for (int k = 0; k < 6; k++) {
                static const int across[6] = {0, 1, 1, 0, 1, 0}, up[6] = {0, 0, 1, 0, 1, 1};
                double u = (double)(i + across[k]) / (columns * cut), v = (double)(j + up[k]) / (rows * cut);
                add(left + (right - left) * u, low + (high - low) * v, -(near_left + (near_right - near_left) * u),
                    (i / cut + j / cut) % 2 ? dark : light);
            }
}

/* The wall in large squares: a strip per column, with each corner once per colour, or a fan per square. */
static GLsizei column;
static void squares(void)
{
    int fan = is("fans") || is("polygons");
    column = fan ? 4 : 4 * ROWS;
    for (int i = 0; i < COLUMNS; i++)
        for (int j = 0; j < ROWS; j++)
            for (int k = 0; k < 4; k++) {
                int right = fan ? k == 1 || k == 2 : k % 2;
                double u = (double)(i + right) / COLUMNS, v = (double)(j + k / 2) / ROWS;
                places[count] = (GLushort)count;
                add(-30 + 60 * u, -20 + 40 * v, -(26 - 6 * u), (i + j) % 2 ? 0x506080 : 0x7080a0);
            }
}

static void draw_squares(GLsizei number)
{
    GLenum mode = is("fans") ? GL_TRIANGLE_FAN : is("polygons") ? GL_POLYGON : is("quads") ? GL_QUAD_STRIP : GL_TRIANGLE_STRIP;
    for (GLsizei i = 0; i < number; i += column) {
        if (is("indexed"))
            glDrawElements(mode, column, GL_UNSIGNED_SHORT, places + i);
        else
            glDrawArrays(mode, i, column);
    }
}

static int in_squares(void) { return is("strips") || is("cyan") || is("fans") || is("polygons") || is("quads") || is("indexed"); }

static void box(double left, double right, double low, double high, double z, unsigned light, unsigned dark)
{
    patch(left, right, low, high, z, z, 2, 4, 1, light, dark);
}

static const char *const matrix_vertex =
    "varying vec3 colour;\n"
    "void main() { colour = gl_Color.rgb; gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex; }\n";
static const char *const matrix_fragment = "varying vec3 colour;\nvoid main() { gl_FragColor = vec4(colour, 1.0); }\n";
static const char *const old_vertex =
    "#version 120\nuniform mat4 camera;\nattribute vec3 place, paint;\nvarying vec3 colour;\n"
    "void main() { colour = paint; gl_Position = camera * vec4(place, 1.0); }\n";
static const char *const old_fragment = "#version 120\nvarying vec3 colour;\nvoid main() { gl_FragColor = vec4(colour, 1.0); }\n";
/* Colours the wall where the ray of a pixel meets it outside of bars; the bars are of a plain red, green or blue. */
static const char *const coord_fragment =
    "#version 120\nvarying vec3 colour;\n"
    "void main()\n"
    "{\n"
    "    vec2 ray = vec2((gl_FragCoord.x / 200.0 - 1.0) * 0.8, (gl_FragCoord.y / 150.0 - 1.0) * 0.6);\n"
    "    float w = 23.0 / (1.0 + ray.x / 10.0);\n"
    "    vec2 square = floor((ray * w + vec2(30.0, 20.0)) * vec2(0.4, 0.3));\n"
    "    float light = 1.0 - mod(square.x + square.y, 2.0);\n"
    "    bool wall = colour.b > colour.g && colour.g > colour.r;\n"
    "    gl_FragColor = vec4(wall ? mix(vec3(80.0, 96.0, 128.0), vec3(112.0, 128.0, 160.0), light) / 255.0 : colour, 1.0);\n"
    "}\n";
static const char *const new_vertex =
    "#version 330 core\nuniform mat4 camera;\nin vec3 place, paint;\nout vec3 mv_displacement;\n"
    "void main() { mv_displacement = paint; gl_Position = camera * vec4(place, 1.0); }\n";
static const char *const new_fragment =
    "#version 330 core\nin vec3 mv_displacement;\nout vec4 shown;\nvoid main() { shown = vec4(mv_displacement, 1.0); }\n";
static const char *const es_vertex =
    "#version 300 es\nuniform mat4 camera;\nin vec3 place, paint;\nout vec3 colour;\n"
    "void main() { colour = paint; gl_Position = camera * vec4(place, 1.0); }\n";
static const char *const es_fragment =
    "#version 300 es\nprecision highp float;\nin vec3 colour;\nout vec4 shown;\nvoid main() { shown = vec4(colour, 1.0); }\n";
static const char *const several_fragment =
    "#version 120\nvarying vec3 colour;\nvoid main() { gl_FragData[0] = vec4(colour, 1.0); gl_FragData[1] = vec4(1.0); }\n";
static const char *const geometry_vertex =
    "#version 150\nuniform mat4 camera;\nin vec3 place, paint;\nout vec3 passed;\n"
    "void main() { passed = paint; gl_Position = camera * vec4(place, 1.0); }\n";
static const char *const geometry_between =
    "#version 150\nlayout(triangles) in; layout(triangle_strip, max_vertices = 3) out;\nin vec3 passed[]; out vec3 colour;\n"
    "void main()\n"
    "{\n"
    "    for (int i = 0; i < 3; i++) { colour = passed[i]; gl_Position = gl_in[i].gl_Position; EmitVertex(); }\n"
    "    EndPrimitive();\n"
    "}\n";
static const char *const geometry_fragment =
    "#version 150\nin vec3 colour;\nout vec4 shown;\nvoid main() { shown = vec4(colour, 1.0); }\n";

static GLuint made(int core)
{
    GLuint program = glCreateProgram();
    int matrix = is("matrix") || is("begin"), geometry = is("geometry");
    attached(program, GL_VERTEX_SHADER, is("es") ? es_vertex : core ? new_vertex : matrix ? matrix_vertex : geometry ? geometry_vertex : old_vertex);
    if (geometry)
        attached(program, GL_GEOMETRY_SHADER, geometry_between);
    attached(program, GL_FRAGMENT_SHADER,
             is("es") ? es_fragment : core ? new_fragment : matrix ? matrix_fragment : geometry ? geometry_fragment : is("several") ? several_fragment
             : is("coord") ? coord_fragment : old_fragment);
    glBindAttribLocation(program, 0, "place");
    glBindAttribLocation(program, 3, "paint");
    glLinkProgram(program);
    return program;
}

static int listed;
static void draw(GLint first, GLsizei number)
{
    if (is("list") && listed) {
        if (!first)
            glCallList(1);
        return;
    }
    if (in_squares() && !first) {
        draw_squares(number);
    } else if (is("begin") || (is("list") && !listed)) {
        glBegin(GL_TRIANGLES);
        for (GLint i = first; i < first + number; i++) {
            glColor3fv(corners[i].colour);
            glVertex3fv(corners[i].place);
        }
        glEnd();
    } else if (is("instanced")) {
        glDrawArraysInstanced(GL_TRIANGLES, first, number, 1);
    } else {
        glDrawArrays(GL_TRIANGLES, first, number);
    }
}

static void tell(int frame, GLuint program, const GLuint *unit)
{
    static const GLenum names[] = {GL_ACTIVE_TEXTURE, GL_DRAW_FRAMEBUFFER_BINDING, GL_ARRAY_BUFFER_BINDING, GL_VIEWPORT};
    static unsigned char pixels[WIDTH * HEIGHT * 4];
    GLint value[4];
    glGetIntegerv(GL_CURRENT_PROGRAM, value);
    printf("frame %d: %s program,", frame, (GLuint)value[0] == program ? "its" : "another");
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        glGetIntegerv(names[i], value);
        printf(" %d", value[0]);
    }
    glActiveTexture(GL_TEXTURE0 + UNIT);
    glGetIntegerv(GL_TEXTURE_BINDING_2D_ARRAY, &value[0]);
    glGetIntegerv(GL_SAMPLER_BINDING, &value[1]);
    glActiveTexture(GL_TEXTURE0);
    int same = (GLuint)value[0] == unit[0] && (GLuint)value[1] == unit[1];
    GLboolean written[4];
    glGetBooleani_v(GL_COLOR_WRITEMASK, 1, written);
    printf(", unit %d: %s, blend %d, red %d", UNIT, same ? "its" : "another's", glIsEnabledi(GL_BLEND, 1), written[0]);
    glReadPixels(0, 0, WIDTH, HEIGHT, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    unsigned sum = 0;
    for (size_t i = 0; i < sizeof pixels; i++)
        sum = sum * 31 + pixels[i];
    printf(", pixels %u, error 0x%x\n", sum, glGetError());
}

int main(int argc, char **argv)
{
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3, EGL_NONE};
    const EGLint es_attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
    const GLfloat camera[16] = {1 / 0.8f, 0, 0, 0, 0, 1 / 0.6f, 0, 0, 0, 0, -101.0f / 99.0f, -1, 0, 0, -200.0f / 99.0f, 0};
    way = argc > 1 ? argv[1] : "";
    int core = is("new") || is("instanced");
    if (!open_surface() || (is("es") && !eglBindAPI(EGL_OPENGL_ES_API)))
        return 2;
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, core ? attributes : is("es") ? es_attributes : NULL);
    if (!context || !eglMakeCurrent(display, surface, surface, context))
        return 2;
    if (in_squares())
        squares();
    else
        patch(-30, 30, -20, 20, 26, 20, COLUMNS, ROWS, is("old") ? CUT / 3 : CUT, 0x7080a0, 0x506080);
    wall_count = count;
    for (int k = 0; k < 9; k++)
        box(-5.2 + 0.35 * k, -5 + 0.35 * k, -3, 3, 7, 0xe0a040, 0xc08020);
    box(-0.9, 0.6, -2, 2.5, 6, 0x60c060, 0x40a040);
    box(1.4, 1.5, -4, 4, 6.5, 0xe06060, 0xc04040);
    box(4.6, 9, -1, 4, 7.5, 0xb060e0, 0x9040c0);
    box(-9, -5.4, -4, -3.2, 7, 0xb060e0, 0x9040c0);
    GLuint names[4] = {0};
    if (core) {
        glGenVertexArrays(1, &names[0]);
        glBindVertexArray(names[0]);
        glGenTextures(1, &names[1]);
        glGenSamplers(1, &names[2]);
        glActiveTexture(GL_TEXTURE0 + UNIT);
        glBindTexture(GL_TEXTURE_2D_ARRAY, names[1]);
        glBindSampler(UNIT, names[2]);
        glActiveTexture(GL_TEXTURE0);
    }
    glGenBuffers(1, &names[3]);
    glBindBuffer(GL_ARRAY_BUFFER, names[3]);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)sizeof corners, corners, GL_STATIC_DRAW);
    if (is("matrix") || in_squares()) {
        glEnableClientState(GL_VERTEX_ARRAY);
        glEnableClientState(GL_COLOR_ARRAY);
        glVertexPointer(3, GL_FLOAT, sizeof *corners, (void *)0);
        glColorPointer(3, GL_FLOAT, sizeof *corners, (void *)12);
    } else if (!is("begin") && !is("list")) {
        glEnableVertexAttribArray(0);
        glEnableVertexAttribArray(3);
        glVertexAttribPointer(0, 3, GL_FLOAT, 0, sizeof *corners, (void *)0);
        glVertexAttribPointer(3, 3, GL_FLOAT, 0, sizeof *corners, (void *)12);
    }
    int fixed = in_squares() || is("list");
    GLuint program = fixed ? 0 : made(core);
    glUseProgram(program);
    if (is("matrix") || is("begin") || fixed) {
        glMatrixMode(GL_PROJECTION);
        glLoadMatrixf(camera);
        glMatrixMode(GL_MODELVIEW);
    } else {
        glUniformMatrix4fv(glGetUniformLocation(program, "camera"), 1, 0, camera);
    }
    if (is("list")) {
        glNewList(1, GL_COMPILE);
        draw(0, wall_count);
        draw(wall_count, count - wall_count);
        glEndList();
        listed = 1;
    }
    glEnable(GL_DEPTH_TEST);
    glColorMask(!is("cyan"), GL_TRUE, GL_TRUE, GL_TRUE);
    for (int frame = 1; frame <= 4; frame++) {
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        draw(0, wall_count);
        draw(wall_count, count - wall_count);
        tell(frame, program, names + 1);
        eglSwapBuffers(display, surface);
    }
    return 0;
}
