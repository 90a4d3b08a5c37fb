/* Commands that few programs use: each does what a command does that many use.
 *
 *   arrays elements            draws whose count lies in a buffer (glMultiDraw*IndirectCountARB)
 *   modes modeelements         draws in several primitive modes (GL_IBM_multimode_draw_arrays)
 *   restart                    glPrimitiveRestartNV between glBegin and glEnd
 *   image subimage multi       a texture that was drawn to is written by its name or its unit (GL_EXT_direct_state_access)
 *   copied mipmap nvcopied     so it is by copies from the window, as mipmaps, by GL_NV_copy_image
 *   corecopied unitcopied      so it is by glCopyTextureSubImage2D, and by its unit
 *   bound boundcopied          so it is where it is bound
 *   filter                     a parameter of a texture that was drawn to is set; pushed: and restored by glPopAttrib
 *   (these with list, execute  by a display list, of GL_COMPILE or GL_COMPILE_AND_EXECUTE; within: in a primitive of a list)
 *   unitmipmap                 mipmaps by its unit
 *   esblock                    a fragment shader of OpenGL ES counts in a storage block
 *   attached renderbuffer      a framebuffer gets another image by its name (GL_EXT_direct_state_access)
 *   named                      framebuffer 0 by its name
 *   readbuffers                its read buffers, also by its name
 *   buffers                    glDrawBuffersNV in OpenGL ES
 *   windowpos                  glWindowPos4fMESA
 *   long double                uniforms of 64 bits, set by commands of extensions
 *   subroutine                 a subroutine is chosen for several draws and frames
 *   indexed statistics         queries by glBeginQueryIndexed; of GL_ARB_pipeline_statistics_query
 *   results resultsbound       results of queries in a buffer that is named, or bound
 *   resultsfixed               in one whose store only copies can change
 *
 * Draws are at the depth of zero parallax, so that all views show the same. Prints what is read back, and errors. */
#define SURFACE_SIZE
enum { WIDTH = 64, HEIGHT = 48 };
#include "../support/c/shaders.h"
#include "../support/c/surface.h"
#include <string.h>

enum { PLACE = 0 };

static const char *const vertex = "#version 150\nin vec2 place; uniform mat4 camera; uniform vec2 at; uniform vec2 size;\n"
                                  "void main() { gl_Position = camera * vec4((place * size + at) * 4.0, -4.0, 1.0); }\n";
static const char *const fragment = "#version 150\nuniform vec3 colour; out vec4 shown; void main() { shown = vec4(colour, 1.0); }";
static const char *const whole = "#version 150\nin vec2 place; out vec2 where; void main() { where = place * 0.5 + 0.5; gl_Position = vec4(place, 0.0, 1.0); }";
static const char *const picture = "#version 150\nuniform sampler2D image; uniform float level; in vec2 where; out vec4 shown;\n"
                                   "void main() { shown = textureLod(image, where, level); }";

static const char *mode;
/* How a display list is compiled that writes; 0 without one. */
static GLenum listed;
static int within;
static GLuint scene, shown;

static int is(const char *name)
{
    return !strcmp(mode, name);
}

#define CALL(type, name) ((type)eglGetProcAddress(name))

static void tell(const char *what)
{
    unsigned char p[3][4];
    for (int i = 0; i < 3; i++)
        glReadPixels(13 + 19 * i, HEIGHT / 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, p[i]);
    printf("%s: %d %d %d, %d %d %d, %d %d %d, error 0x%x\n", what, p[0][0], p[0][1], p[0][2], p[1][0], p[1][1], p[1][2], p[2][0], p[2][1], p[2][2], glGetError());
}

static GLuint in_use(const char *vertices, const char *fragments)
{
    const GLfloat camera[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.04f, -1, 0, 0, -2.04f, 0};
    GLuint program = linked(vertices, fragments, PLACE);
    glUseProgram(program);
    glUniformMatrix4fv(glGetUniformLocation(program, "camera"), 1, GL_FALSE, camera);
    glUniform2f(glGetUniformLocation(program, "size"), 1, 1);
    glUniform3f(glGetUniformLocation(program, "colour"), 1, 0, 0);
    return program;
}

/* The upright bar of this number, 0 to 2, in a colour of its own. */
static void bar(int number)
{
    glUseProgram(scene);
    glUniform2f(glGetUniformLocation(scene, "size"), 0.2f, 0.8f);
    glUniform2f(glGetUniformLocation(scene, "at"), -0.6f + 0.6f * (float)number, 0);
    glUniform3f(glGetUniformLocation(scene, "colour"), number == 0, number == 1, number == 2);
    quad(PLACE);
}

/* Three bars in one array: their indices begin at 0, 4 and 8. */
static void arrays(void)
{
    static const GLfloat corners[] = {-0.8f, -0.8f, -0.4f, -0.8f, -0.4f, 0.8f, -0.8f, 0.8f, -0.2f, -0.8f, 0.2f, -0.8f,
                                      0.2f,  0.8f,  -0.2f, 0.8f,  0.4f,  -0.8f, 0.8f, -0.8f, 0.8f, 0.8f,  0.4f,  0.8f};
    static const GLushort indices[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
    static const GLuint by_arrays[3][4] = {{4, 1, 0, 0}, {4, 1, 4, 0}, {4, 1, 8, 0}};
    static const GLuint by_elements[3][5] = {{4, 1, 0, 0, 0}, {4, 1, 4, 0, 0}, {4, 1, 8, 0, 0}};
    static const GLint first[] = {0, 4, 8};
    static const GLsizei count[] = {4, 4, 4};
    static const GLenum modes[] = {GL_TRIANGLE_FAN, GL_TRIANGLE_FAN, GL_LINE_LOOP};
    static const GLuint two = 2;
    const GLvoid *const starts[] = {0, (const GLvoid *)8, (const GLvoid *)16};
    GLuint buffers[4];
    glGenBuffers(4, buffers);
    glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    glBufferData(GL_ARRAY_BUFFER, sizeof corners, corners, GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof indices, indices, GL_STATIC_DRAW);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, buffers[2]);
    if (is("arrays"))
        glBufferData(GL_DRAW_INDIRECT_BUFFER, sizeof by_arrays, by_arrays, GL_STATIC_DRAW);
    else
        glBufferData(GL_DRAW_INDIRECT_BUFFER, sizeof by_elements, by_elements, GL_STATIC_DRAW);
    glBindBuffer(GL_PARAMETER_BUFFER, buffers[3]);
    glBufferData(GL_PARAMETER_BUFFER, sizeof two, &two, GL_STATIC_DRAW);
    glEnableVertexAttribArray(PLACE);
    glVertexAttribPointer(PLACE, 2, GL_FLOAT, GL_FALSE, 0, NULL);
    if (is("arrays"))
        CALL(PFNGLMULTIDRAWARRAYSINDIRECTCOUNTARBPROC, "glMultiDrawArraysIndirectCountARB")(GL_TRIANGLE_FAN, NULL, 0, 3, 0);
    else if (is("elements"))
        CALL(PFNGLMULTIDRAWELEMENTSINDIRECTCOUNTARBPROC, "glMultiDrawElementsIndirectCountARB")(GL_TRIANGLE_FAN, GL_UNSIGNED_SHORT, NULL, 0, 3, 0);
    else if (is("modes"))
        CALL(PFNGLMULTIMODEDRAWARRAYSIBMPROC, "glMultiModeDrawArraysIBM")(modes, first, count, 3, sizeof *modes);
    else
        CALL(PFNGLMULTIMODEDRAWELEMENTSIBMPROC, "glMultiModeDrawElementsIBM")(modes, count, GL_UNSIGNED_SHORT, starts, 3, sizeof *modes);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    tell("drawn");
}

static void restart(void)
{
    PFNGLPRIMITIVERESTARTNVPROC again = CALL(PFNGLPRIMITIVERESTARTNVPROC, "glPrimitiveRestartNV");
    glUseProgram(0);
    glEnableClientState(0x8558); /* GL_PRIMITIVE_RESTART_NV */
    glColor3f(1, 1, 0);
    glBegin(GL_TRIANGLE_STRIP);
    for (int i = 0; i < 3; i += 2) {
        GLfloat x = -0.8f + 0.6f * (GLfloat)i;
        glVertex2f(x, -0.8f);
        glVertex2f(x + 0.4f, -0.8f);
        glVertex2f(x, 0.8f);
        glVertex2f(x + 0.4f, 0.8f);
        again();
    }
    glEnd();
    tell("drawn");
}

static GLuint texture(void)
{
    GLuint name;
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    for (int level = 0; level < 3; level++)
        glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA8, WIDTH >> level, HEIGHT >> level, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 2);
    return name;
}

static GLuint framebuffer_of(GLuint texture)
{
    GLuint name;
    glGenFramebuffers(1, &name);
    glBindFramebuffer(GL_FRAMEBUFFER, name);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    return name;
}

static void clear(float red, float green, float blue)
{
    glClearColor(red, green, blue, 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

static void show(GLuint name, float level)
{
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glUseProgram(shown);
    glBindTexture(GL_TEXTURE_2D, name);
    glUniform1f(glGetUniformLocation(shown, "level"), level);
    quad(PLACE);
    tell("shown");
}

static unsigned char yellow[WIDTH * HEIGHT * 4];

/* A texture that the scene was drawn to, in each view, is written in another way. */
static void written(void)
{
    GLuint name = texture(), other = texture();
    GLuint framebuffer = framebuffer_of(name);
    int copies = is("copied") || is("corecopied") || is("unitcopied") || is("boundcopied");
    for (int i = 0; i < WIDTH * HEIGHT * 4; i++)
        yellow[i] = i % 4 == 2 ? 0 : 255;
    glBindTexture(GL_TEXTURE_2D, other);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, WIDTH, HEIGHT, GL_RGBA, GL_UNSIGNED_BYTE, yellow);
    glActiveTexture(GL_TEXTURE3);
    glBindTexture(GL_TEXTURE_2D, name);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, name);
    clear(0, 0, 0);
    bar(1);
    tell("the scene");
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    if (copies) {
        clear(0, 0, 0);
        bar(0);
    }
    if (listed)
        glNewList(1, listed);
    if (within)
        glBegin(GL_TRIANGLES);
    if (is("image"))
        CALL(PFNGLTEXTUREIMAGE2DEXTPROC, "glTextureImage2DEXT")(name, GL_TEXTURE_2D, 0, GL_RGBA8, WIDTH, HEIGHT, 0, GL_RGBA, GL_UNSIGNED_BYTE, yellow);
    else if (is("subimage"))
        CALL(PFNGLTEXTURESUBIMAGE2DEXTPROC, "glTextureSubImage2DEXT")(name, GL_TEXTURE_2D, 0, 0, 0, WIDTH, HEIGHT, GL_RGBA, GL_UNSIGNED_BYTE, yellow);
    else if (is("bound"))
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, WIDTH, HEIGHT, GL_RGBA, GL_UNSIGNED_BYTE, yellow);
    else if (is("multi"))
        CALL(PFNGLMULTITEXSUBIMAGE2DEXTPROC, "glMultiTexSubImage2DEXT")(GL_TEXTURE3, GL_TEXTURE_2D, 0, 0, 0, WIDTH, HEIGHT, GL_RGBA, GL_UNSIGNED_BYTE, yellow);
    else if (is("nvcopied"))
        CALL(PFNGLCOPYIMAGESUBDATANVPROC, "glCopyImageSubDataNV")(other, GL_TEXTURE_2D, 0, 0, 0, 0, name, GL_TEXTURE_2D, 0, 0, 0, 0, WIDTH, HEIGHT, 1);
    else if (is("mipmap"))
        CALL(PFNGLGENERATETEXTUREMIPMAPEXTPROC, "glGenerateTextureMipmapEXT")(name, GL_TEXTURE_2D);
    else if (is("unitmipmap"))
        CALL(PFNGLGENERATEMULTITEXMIPMAPEXTPROC, "glGenerateMultiTexMipmapEXT")(GL_TEXTURE3, GL_TEXTURE_2D);
    else if (is("boundcopied"))
        glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, WIDTH, HEIGHT);
    else if (is("corecopied"))
        glCopyTextureSubImage2D(name, 0, 0, 0, 0, 0, WIDTH, HEIGHT);
    else if (is("unitcopied"))
        CALL(PFNGLCOPYMULTITEXSUBIMAGE2DEXTPROC, "glCopyMultiTexSubImage2DEXT")(GL_TEXTURE3, GL_TEXTURE_2D, 0, 0, 0, 0, 0, WIDTH, HEIGHT);
    else
        CALL(PFNGLCOPYTEXTURESUBIMAGE2DEXTPROC, "glCopyTextureSubImage2DEXT")(name, GL_TEXTURE_2D, 0, 0, 0, 0, 0, WIDTH, HEIGHT);
    if (within)
        glEnd();
    if (listed) {
        GLint active;
        glEndList();
        if (listed == GL_COMPILE)
            glCallList(1);
        glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
        printf("unit %d\n", active - GL_TEXTURE0);
    }
    show(name, is("mipmap") || is("unitmipmap") ? 2 : 0);
    glDeleteFramebuffers(1, &framebuffer);
}

/* A parameter of a texture that the scene was drawn to, in each view, is set once the views have been drawn with it: whether small pictures
 * of it are shown. */
static void parameter(void)
{
    enum { SMALL = 2 };
    static unsigned char white[(WIDTH >> SMALL) * (HEIGHT >> SMALL) * 4];
    GLuint name = texture();
    GLuint framebuffer = framebuffer_of(name);
    memset(white, 255, sizeof white);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexSubImage2D(GL_TEXTURE_2D, SMALL, 0, 0, WIDTH >> SMALL, HEIGHT >> SMALL, GL_RGBA, GL_UNSIGNED_BYTE, white);
    clear(0, 0, 0);
    bar(1);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    show(name, SMALL);
    if (is("pushed"))
        glPushAttrib(GL_TEXTURE_BIT);
    if (listed)
        glNewList(1, listed);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
    if (listed)
        glEndList();
    if (listed == GL_COMPILE) {
        show(name, SMALL);
        glCallList(1);
    }
    show(name, SMALL);
    if (is("pushed")) {
        glPopAttrib();
        show(name, SMALL);
    }
    glDeleteFramebuffers(1, &framebuffer);
}

/* A framebuffer that the scene was drawn to gets another image. */
static void attaches(void)
{
    GLuint names[2] = {texture(), texture()}, framebuffer = framebuffer_of(names[0]), reads = framebuffer_of(names[1]), buffer;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    clear(0, 0, 0);
    bar(0);
    if (is("attached")) {
        CALL(PFNGLNAMEDFRAMEBUFFERTEXTURE2DEXTPROC, "glNamedFramebufferTexture2DEXT")(framebuffer, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, names[1], 0);
    } else {
        glGenRenderbuffers(1, &buffer);
        glBindRenderbuffer(GL_RENDERBUFFER, buffer);
        CALL(PFNGLNAMEDRENDERBUFFERSTORAGEEXTPROC, "glNamedRenderbufferStorageEXT")(buffer, GL_RGBA8, WIDTH, HEIGHT);
        CALL(PFNGLNAMEDFRAMEBUFFERRENDERBUFFEREXTPROC, "glNamedFramebufferRenderbufferEXT")(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffer);
    }
    clear(0, 0, 0);
    bar(2);
    tell("the other image");
    if (!is("attached")) {
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, reads);
        glBlitFramebuffer(0, 0, WIDTH, HEIGHT, 0, 0, WIDTH, HEIGHT, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
    show(names[1], 0);
}

/* Framebuffer 0 by its name. */
static void named(void)
{
    static const GLenum asked[] = {GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, GL_FRAMEBUFFER_ATTACHMENT_RED_SIZE, GL_FRAMEBUFFER_ATTACHMENT_ALPHA_SIZE};
    static const GLenum also[] = {GL_DOUBLEBUFFER, GL_STEREO, GL_SAMPLES};
    static const GLenum colour = GL_COLOR;
    bar(0);
    printf("status 0x%x\n", glCheckNamedFramebufferStatus(0, GL_FRAMEBUFFER));
    for (int i = 0; i < 3; i++) {
        GLint a = -1, b = -1;
        glGetNamedFramebufferAttachmentParameteriv(0, GL_BACK_LEFT, asked[i], &a);
        glGetNamedFramebufferParameteriv(0, also[i], &b);
        printf("0x%x: 0x%x, 0x%x: %d, error 0x%x\n", asked[i], (unsigned)a, also[i], b, glGetError());
    }
    glNamedFramebufferParameteri(0, GL_FRAMEBUFFER_DEFAULT_WIDTH, 8);
    printf("no width: 0x%x\n", glGetError());
    tell("drawn");
    glInvalidateNamedFramebufferData(0, 1, &colour);
    clear(0, 1, 0);
    tell("cleared");
}

static void read_buffers(void)
{
    static const GLenum all[] = {GL_FRONT, GL_LEFT, GL_FRONT_AND_BACK, GL_RIGHT, GL_NONE, GL_FRONT_AND_BACK, GL_BACK};
    PFNGLFRAMEBUFFERREADBUFFEREXTPROC by_name = CALL(PFNGLFRAMEBUFFERREADBUFFEREXTPROC, "glFramebufferReadBufferEXT");
    PFNGLGETFRAMEBUFFERPARAMETERIVEXTPROC get = CALL(PFNGLGETFRAMEBUFFERPARAMETERIVEXTPROC, "glGetFramebufferParameterivEXT");
    for (int way = 0; way < 3; way++)
        for (unsigned i = 0; i < sizeof all / sizeof *all; i++) {
            GLint bound = 0, named[2] = {0};
            if (way == 0)
                glReadBuffer(all[i]);
            else if (way == 1)
                glNamedFramebufferReadBuffer(0, all[i]);
            else
                by_name(0, all[i]);
            GLenum error = glGetError();
            glGetIntegerv(GL_READ_BUFFER, &bound);
            get(0, GL_READ_BUFFER, &named[0]);
            get(0, GL_DRAW_BUFFER, &named[1]);
            printf("0x%x: 0x%x 0x%x 0x%x, error 0x%x 0x%x\n", all[i], bound, named[0], named[1], error, glGetError());
        }
    bar(0);
    tell("drawn");
}

static void window_position(void)
{
    static const GLubyte pixels[4 * 4 * 4];
    glUseProgram(0);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-1, 1, -1, 1, 1, 40);
    glRasterPos3f(0, 0, -20);
    CALL(PFNGLWINDOWPOS4FMESAPROC, "glWindowPos4fMESA")(11, HEIGHT / 2 - 2, 0, 1);
    glDrawPixels(4, 4, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    tell("drawn");
}

static void numbers(void)
{
    static const char *const longs = "#version 400\n#extension GL_ARB_gpu_shader_int64 : require\nuniform int64_t number; uniform vec3 colour; out vec4 shown;\n"
                                     "void main() { shown = vec4(colour * float(number), 1.0); }";
    static const char *const doubles = "#version 400\nuniform double number; uniform vec3 colour; out vec4 shown;\n"
                                       "void main() { shown = vec4(colour * float(number), 1.0); }";
    GLuint program = in_use(vertex, is("long") ? longs : doubles);
    GLint at = glGetUniformLocation(program, "number");
    for (int value = 1; value >= 0; value--) {
        clear(0, 0, 1);
        if (is("long"))
            CALL(PFNGLUNIFORM1I64ARBPROC, "glUniform1i64ARB")(at, value);
        else
            CALL(PFNGLPROGRAMUNIFORM1DEXTPROC, "glProgramUniform1dEXT")(program, at, value);
        quad(PLACE);
        tell("drawn");
    }
}

static void subroutine(void)
{
    static const char *const either = "#version 430\nsubroutine vec3 Kind(); layout(location = 0) subroutine uniform Kind kind; out vec4 shown;\n"
                                      "layout(index = 0) subroutine(Kind) vec3 first() { return vec3(1.0, 0.0, 0.0); }\n"
                                      "layout(index = 1) subroutine(Kind) vec3 second() { return vec3(0.0, 1.0, 0.0); }\n"
                                      "void main() { shown = vec4(kind(), 1.0); }";
    static const GLuint second = 1;
    GLuint program = in_use(vertex, either), is_now;
    glUniformSubroutinesuiv(GL_FRAGMENT_SHADER, 1, &second);
    for (int i = 0; i < 2; i++) {
        quad(PLACE);
        glGetUniformSubroutineuiv(GL_FRAGMENT_SHADER, 0, &is_now);
        printf("the subroutine %u of the program %d\n", is_now, program > 0);
        tell("drawn");
        if (i == 0)
            eglSwapBuffers(display, surface);
    }
}

static GLuint result(GLuint query)
{
    GLuint count;
    glGetQueryObjectuiv(query, GL_QUERY_RESULT, &count);
    return count;
}

static void queries(void)
{
    static const GLenum kinds[] = {GL_VERTICES_SUBMITTED, GL_PRIMITIVES_SUBMITTED, GL_VERTEX_SHADER_INVOCATIONS, GL_CLIPPING_INPUT_PRIMITIVES,
                                   GL_FRAGMENT_SHADER_INVOCATIONS, GL_SAMPLES_PASSED, GL_PRIMITIVES_GENERATED, GL_ANY_SAMPLES_PASSED};
    enum { KINDS = sizeof kinds / sizeof *kinds };
    const int from = is("statistics") ? 0 : 5, to = is("statistics") ? 5 : KINDS;
    GLuint names[KINDS], buffer, values[KINDS * 2] = {0};
    glGenQueries(KINDS, names);
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_QUERY_BUFFER, buffer);
    if (is("resultsfixed"))
        glBufferStorage(GL_QUERY_BUFFER, sizeof values, values, 0);
    else
        glBufferData(GL_QUERY_BUFFER, sizeof values, values, GL_DYNAMIC_READ);
    glBindBuffer(GL_QUERY_BUFFER, 0);
    for (int i = from; i < to; i++) {
        GLint now[2] = {0};
        if (is("indexed"))
            glBeginQueryIndexed(kinds[i], 0, names[i]);
        else
            glBeginQuery(kinds[i], names[i]);
        for (int draw = 0; draw < 3; draw++)
            bar(draw);
        glGetQueryIndexediv(kinds[i], 0, GL_CURRENT_QUERY, &now[0]);
        glGetQueryiv(kinds[i], GL_CURRENT_QUERY, &now[1]);
        if (is("indexed"))
            glEndQueryIndexed(kinds[i], 0);
        else
            glEndQuery(kinds[i]);
        printf("0x%x: current %d %d, ", kinds[i], (GLuint)now[0] == names[i], (GLuint)now[1] == names[i]);
        if (is("results") || is("resultsfixed")) {
            glGetQueryBufferObjectuiv(names[i], buffer, GL_QUERY_RESULT, 8 * i);
            glGetQueryBufferObjectuiv(names[i], buffer, GL_QUERY_RESULT_AVAILABLE, 8 * i + 4);
        } else if (is("resultsbound")) {
            glBindBuffer(GL_QUERY_BUFFER, buffer);
            glGetQueryObjectuiv(names[i], GL_QUERY_RESULT, (GLuint *)0 + 2 * i);
            glGetQueryObjectuiv(names[i], GL_QUERY_RESULT_AVAILABLE, (GLuint *)0 + 2 * i + 1);
            glBindBuffer(GL_QUERY_BUFFER, 0);
        } else {
            printf("result %u, ", result(names[i]));
        }
        glBindBuffer(GL_COPY_READ_BUFFER, buffer);
        glGetBufferSubData(GL_COPY_READ_BUFFER, 0, sizeof values, values);
        printf("in the buffer %u %u, error 0x%x\n", values[2 * i], values[2 * i + 1], glGetError());
    }
}

/* A context of OpenGL ES 3. */
static int es(void)
{
    const EGLint version[] = {EGL_CONTEXT_CLIENT_VERSION, 3, EGL_NONE};
    EGLContext context = eglBindAPI(EGL_OPENGL_ES_API) ? eglCreateContext(display, config, EGL_NO_CONTEXT, version) : EGL_NO_CONTEXT;
    return context && eglMakeCurrent(display, surface, surface, context);
}

static void buffers(void)
{
    static const GLenum back = GL_BACK, none = GL_NONE;
    GLint now;
    CALL(PFNGLDRAWBUFFERSPROC, "glDrawBuffersNV")(1, &none);
    printf("none: error 0x%x\n", glGetError());
    clear(1, 0, 0);
    CALL(PFNGLDRAWBUFFERSPROC, "glDrawBuffersNV")(1, &back);
    printf("back: error 0x%x\n", glGetError());
    glGetIntegerv(GL_DRAW_BUFFER0, &now);
    printf("the buffer 0x%x\n", (unsigned)now);
    tell("drawn");
    clear(0, 1, 0);
    tell("cleared");
}

static void block(void)
{
    static const char *const places = "#version 310 es\nin vec2 place; void main() { gl_Position = vec4(place * 0.5, 0.0, 1.0); }";
    static const char *const counts = "#version 310 es\nprecision highp float; layout(std430, binding = 1) buffer Sum { uint sum; }; out vec4 shown;\n"
                                      "void main() { atomicAdd(sum, 1u); shown = vec4(1.0, 0.0, 0.0, 1.0); }";
    static const GLuint zero;
    GLuint buffer;
    glGenBuffers(1, &buffer);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffer);
    glBufferData(GL_SHADER_STORAGE_BUFFER, sizeof zero, &zero, GL_DYNAMIC_COPY);
    glUseProgram(linked(places, counts, PLACE));
    for (int draw = 0; draw < 2; draw++) {
        quad(PLACE);
        tell("drawn");
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        const GLuint *sum = glMapBufferRange(GL_SHADER_STORAGE_BUFFER, 0, sizeof zero, GL_MAP_READ_BIT);
        printf("sum %u, ", sum ? *sum : 0);
        glUnmapBuffer(GL_SHADER_STORAGE_BUFFER);
        printf("error 0x%x\n", glGetError());
    }
}

int main(int argc, char **argv)
{
    if (argc < 2 || !open_surface())
        return 2;
    mode = argv[1];
    if (argc > 2)
        listed = strcmp(argv[2], "execute") ? GL_COMPILE : GL_COMPILE_AND_EXECUTE;
    within = argc > 2 && !strcmp(argv[2], "within");
    if (is("buffers") || is("esblock") ? !es() : !new_context(EGL_NO_CONTEXT))
        return 2;
    clear(1, 1, 1);
    if (!is("buffers") && !is("esblock")) {
        scene = in_use(vertex, fragment);
        shown = in_use(whole, picture);
        glUseProgram(scene);
    }
    if (is("arrays") || is("elements") || is("modes") || is("modeelements"))
        arrays();
    else if (is("restart"))
        restart();
    else if (is("image") || is("subimage") || is("multi") || is("copied") || is("nvcopied") || is("mipmap") || is("corecopied") ||
             is("unitcopied") || is("unitmipmap") || is("bound") || is("boundcopied"))
        written();
    else if (is("filter") || is("pushed"))
        parameter();
    else if (is("attached") || is("renderbuffer"))
        attaches();
    else if (is("named"))
        named();
    else if (is("readbuffers"))
        read_buffers();
    else if (is("buffers"))
        buffers();
    else if (is("esblock"))
        block();
    else if (is("windowpos"))
        window_position();
    else if (is("long") || is("double"))
        numbers();
    else if (is("subroutine"))
        subroutine();
    else
        queries();
    eglSwapBuffers(display, surface);
    printf("swapped: error 0x%x\n", glGetError());
    return 0;
}
