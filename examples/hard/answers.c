/* Cases of answers to a program's queries, and of the identity of vertices and instances. */
#include "hard.h"
#include <stdio.h>

static void things(void)
{
    static const unsigned a[2] = {0xd04040, 0xe06060}, b[2] = {0x40d040, 0x60e060};
    static const double front[4][3] = {{-2, -1.5, -4}, {1, -1.5, -4.5}, {-2, 1.5, -4}, {1, 1.5, -4.5}};
    static const double behind[4][3] = {{-1, -2, -9}, {6, -2, -7}, {-1, 3, -9}, {6, 3, -7}};
    glLoadName(1);
    patch(front, 2, 2, a);
    glLoadName(2);
    patch(behind, 3, 3, b);
    glLoadName(3);
    send_immediate(1);
    patch(front, 1, 1, b);
    send_immediate(0);
}

/* Occlusion queries, selection, feedback, pixels read back: every answer is about the program's own view. */
static void draw_answers(int frame)
{
    static GLfloat returned[4096];
    static GLuint hits[256];
    PFNGLGENQUERIESPROC gen = (PFNGLGENQUERIESPROC)demo_proc("glGenQueries");
    PFNGLBEGINQUERYPROC begin = (PFNGLBEGINQUERYPROC)demo_proc("glBeginQuery");
    PFNGLENDQUERYPROC end = (PFNGLENDQUERYPROC)demo_proc("glEndQuery");
    PFNGLGETQUERYOBJECTUIVPROC get = (PFNGLGETQUERYOBJECTUIVPROC)demo_proc("glGetQueryObjectuiv");
    GLuint query, samples, sum = 0;
    (void)frame;
    usual_frustum(1, 100);
    glEnable(GL_DEPTH_TEST);
    gen(1, &query);
    begin(GL_SAMPLES_PASSED, query);
    things();
    end(GL_SAMPLES_PASSED);
    get(query, GL_QUERY_RESULT, &samples);
    printf("samples = %u\n", samples);

    glFeedbackBuffer(4096, GL_4D_COLOR_TEXTURE, returned);
    glRenderMode(GL_FEEDBACK);
    things();
    int count = glRenderMode(GL_RENDER);
    printf("feedback = %d\n", count);
    for (int k = 0; k < count && k < 4096; k++)
        printf("feedback[%d] = %.9g\n", k, (double)returned[k]);

    glSelectBuffer(256, hits);
    glRenderMode(GL_SELECT);
    glInitNames();
    glPushName(0);
    things();
    count = glRenderMode(GL_RENDER);
    printf("hits = %d\n", count);
    for (int k = 0; k < 4 * count && k < 256; k++)
        printf("hits[%d] = %u\n", k, hits[k]);

    unsigned char *rgb = (unsigned char *)returned;
    for (int y = 10; y < demo_height; y += 20) {
        glReadPixels(demo_x, demo_y + y, 256 < demo_width ? 256 : demo_width, 1, GL_RGBA, GL_UNSIGNED_BYTE, rgb);
        for (int k = 0; k < 1024; k++)
            sum = sum * 31 + rgb[k];
        GLfloat depth;
        glReadPixels(demo_x + 5 * y / 4, demo_y + y, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
        printf("row %d = %08x %.9g\n", y, sum, (double)depth);
    }
    glDisable(GL_DEPTH_TEST);
}

/* ---- ids as colours ---- */

static unsigned id_colour(unsigned id) { return (id * 97 + 40) % 200 + 50 + ((id * 57) % 256 << 8) + ((255 - id * 31 % 256) << 16); }

/* Closed lines, indices with a restart, ranges, several draws in one call, a base vertex: flat, each vertex of its own colour. */
static void draw_ids(int frame)
{
    enum { N = 24, RESTART = 0xffff };
    static GLfloat place[2 * N][3];
    static GLubyte shade[2 * N][4];
    (void)frame;
    for (int k = 0; k < 2 * N; k++) {
        int n = k % N;
        place[k][0] = -4 + 0.34f * (GLfloat)(n / 2) * 2;
        place[k][1] = n & 1 ? 0.9f : 0.1f;
        place[k][2] = k < N ? -7 : -6;
        unsigned rgb = id_colour((unsigned)k);
        shade[k][0] = (GLubyte)(rgb >> 16), shade[k][1] = (GLubyte)(rgb >> 8), shade[k][2] = (GLubyte)rgb, shade[k][3] = 255;
    }
    usual_frustum(1, 100);
    glShadeModel(GL_FLAT);
    glPushClientAttrib(GL_CLIENT_VERTEX_ARRAY_BIT);
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_COLOR_ARRAY);
    glVertexPointer(3, GL_FLOAT, 0, place);
    glColorPointer(4, GL_UNSIGNED_BYTE, 0, shade);

    static const GLushort strips[] = {0, 1, 2, 3, 4, 5, RESTART, 8, 9, 10, 11, RESTART, 14, 15, 16, 17, 18, 19, 20};
    PFNGLPRIMITIVERESTARTINDEXPROC restart = (PFNGLPRIMITIVERESTARTINDEXPROC)demo_proc("glPrimitiveRestartIndex");
    glTranslated(0, -4, 0);
    glEnable(GL_PRIMITIVE_RESTART);
    restart(RESTART);
    glDrawElements(GL_TRIANGLE_STRIP, sizeof strips / sizeof *strips, GL_UNSIGNED_SHORT, strips);
    glDisable(GL_PRIMITIVE_RESTART);

    glTranslated(0, 1.3, 0);
    PFNGLDRAWELEMENTSBASEVERTEXPROC base = (PFNGLDRAWELEMENTSBASEVERTEXPROC)demo_proc("glDrawElementsBaseVertex");
    base(GL_TRIANGLES, 6, GL_UNSIGNED_SHORT, strips, N);
    static const GLubyte few[] = {10, 11, 12, 13, 14, 15};
    PFNGLDRAWRANGEELEMENTSPROC range = (PFNGLDRAWRANGEELEMENTSPROC)demo_proc("glDrawRangeElements");
    range(GL_TRIANGLES, 10, 15, 6, GL_UNSIGNED_BYTE, few);

    glTranslated(0, 1.3, 0);
    static const GLint first[3] = {0, 7, 16};
    static const GLsizei count[3] = {5, 6, 7};
    PFNGLMULTIDRAWARRAYSPROC multi = (PFNGLMULTIDRAWARRAYSPROC)demo_proc("glMultiDrawArrays");
    multi(GL_TRIANGLE_STRIP, first, count, 3);

    glTranslated(0, 1.3, 0);
    PFNGLDRAWARRAYSINSTANCEDPROC instanced = (PFNGLDRAWARRAYSINSTANCEDPROC)demo_proc("glDrawArraysInstanced");
    instanced(GL_TRIANGLES, 3, 12, 4);

    glTranslated(0, 1.3, 0);
    for (int k = 0; k < 3; k++)
        glDrawArrays(GL_LINE_LOOP, 8 * k, 5 + k);
    glPopClientAttrib();
    glShadeModel(GL_SMOOTH);
}

/* ---- instances, divisors and primitive numbers in a shader ---- */

static GLuint program;

static void setup_instances(void)
{
    PFNGLCREATESHADERPROC create = (PFNGLCREATESHADERPROC)demo_proc("glCreateShader");
    PFNGLSHADERSOURCEPROC source = (PFNGLSHADERSOURCEPROC)demo_proc("glShaderSource");
    PFNGLCOMPILESHADERPROC compile = (PFNGLCOMPILESHADERPROC)demo_proc("glCompileShader");
    PFNGLCREATEPROGRAMPROC make = (PFNGLCREATEPROGRAMPROC)demo_proc("glCreateProgram");
    PFNGLATTACHSHADERPROC attach = (PFNGLATTACHSHADERPROC)demo_proc("glAttachShader");
    PFNGLBINDATTRIBLOCATIONPROC bind = (PFNGLBINDATTRIBLOCATIONPROC)demo_proc("glBindAttribLocation");
    PFNGLLINKPROGRAMPROC link = (PFNGLLINKPROGRAMPROC)demo_proc("glLinkProgram");
    static const char *const text[2] = {
        "#version 150 compatibility\nin vec2 place; flat out int instance;\n"
        "void main() { instance = gl_InstanceID;\n"
        " gl_Position = gl_ModelViewProjectionMatrix * (gl_Vertex + vec4(place, 0.1 * float(gl_InstanceID), 0.0)); }",
        "#version 150 compatibility\nflat in int instance;\n"
        "void main() { gl_FragColor = vec4(float(instance * 20), float(gl_PrimitiveID * 40), 128.0, 255.0) / 255.0; }"};
    program = make();
    for (int k = 0; k < 2; k++) {
        GLuint shader = create(k ? GL_FRAGMENT_SHADER : GL_VERTEX_SHADER);
        source(shader, 1, &text[k], NULL);
        compile(shader);
        attach(program, shader);
    }
    bind(program, 1, "place");
    link(program);
}

static void draw_instances(int frame)
{
    PFNGLUSEPROGRAMPROC use = (PFNGLUSEPROGRAMPROC)demo_proc("glUseProgram");
    PFNGLVERTEXATTRIBPOINTERPROC pointer = (PFNGLVERTEXATTRIBPOINTERPROC)demo_proc("glVertexAttribPointer");
    PFNGLVERTEXATTRIBDIVISORPROC divisor = (PFNGLVERTEXATTRIBDIVISORPROC)demo_proc("glVertexAttribDivisor");
    PFNGLENABLEVERTEXATTRIBARRAYPROC enable = (PFNGLENABLEVERTEXATTRIBARRAYPROC)demo_proc("glEnableVertexAttribArray");
    PFNGLDISABLEVERTEXATTRIBARRAYPROC disable = (PFNGLDISABLEVERTEXATTRIBARRAYPROC)demo_proc("glDisableVertexAttribArray");
    PFNGLDRAWARRAYSINSTANCEDPROC draw = (PFNGLDRAWARRAYSINSTANCEDPROC)demo_proc("glDrawArraysInstanced");
    static const GLfloat fan[6][3] = {{0, 0, -7}, {0.9f, 0.1f, -7}, {0.8f, 0.9f, -7}, {0.4f, 1.1f, -7}, {0, 0.8f, -7}, {-0.1f, 0.3f, -7}};
    static const GLfloat places[6][2] = {{-4, -3}, {-1, -3}, {2, -3}, {-4, 0.4f}, {-1, 0.4f}, {2, 0.4f}};
    (void)frame;
    usual_frustum(1, 100);
    use(program);
    glPushClientAttrib(GL_CLIENT_VERTEX_ARRAY_BIT);
    glEnableClientState(GL_VERTEX_ARRAY);
    glVertexPointer(3, GL_FLOAT, 0, fan);
    enable(1);
    pointer(1, 2, GL_FLOAT, 0, 0, places);
    divisor(1, 2); /* two instances for each value */
    draw(GL_TRIANGLE_FAN, 0, 6, 12);
    divisor(1, 0);
    disable(1);
    glPopClientAttrib();
    use(0);
}

const struct hard_case answers_cases[] = {
    {"answers", "queries, selection, feedback, pixels read", NULL, draw_answers},
    {"ids", "closed lines, restarts, ranges, base vertices, several draws, instances", NULL, draw_ids},
    {"instances", "gl_InstanceID, divisors and gl_PrimitiveID in a shader", setup_instances, draw_instances},
    {0}};
