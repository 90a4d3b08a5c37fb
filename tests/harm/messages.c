/* What a program is told of the calls that the driver gets: only of its own.
 *
 *   messages callback KIND   by its debug callback
 *   messages log KIND        by the log, which is read after each frame
 *   messages wrong KIND      by its debug callback, after calls of its own that are wrong
 *   messages state KIND      its debug callback as glGet has it
 *
 * KIND: "debug" or "plain" context. Prints the errors that are reported, the number of other messages, and what the window and the
 * program's own framebuffers hold. */
#define GL_GLEXT_PROTOTYPES
#include "shown.h"
#include <GL/glext.h>
#include <GL/glxext.h>
#include <stdlib.h>
#include <string.h>

static int errors, others;

static void count(GLenum type, const char *text)
{
    if (type == GL_DEBUG_TYPE_ERROR)
        printf("  %s\n", text);
    errors += type == GL_DEBUG_TYPE_ERROR;
    others += type != GL_DEBUG_TYPE_ERROR;
}

static void GLAPIENTRY message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length, const GLchar *text, const void *data)
{
    (void)source, (void)id, (void)severity, (void)length, (void)data;
    count(type, text);
}

static void tell(const char *when, int frame)
{
    printf("%s %d: %d errors reported, %d other messages; error %x\n", when, frame, errors, others, glGetError());
    errors = others = 0;
}

static void read_log(void)
{
    GLint left = 0;
    GLenum type;
    char text[1024];
    while (glGetDebugMessageLog(1, sizeof text, NULL, &type, NULL, NULL, NULL, text) == 1)
        count(type, text);
    glGetIntegerv(GL_DEBUG_LOGGED_MESSAGES, &left);
    printf("left in the log: %d\n", left);
}

static struct window open_with(int debug)
{
    int any[] = {GLX_DOUBLEBUFFER, True, GLX_DEPTH_SIZE, 16, None}, found = 0;
    int attribs[] = {GLX_CONTEXT_FLAGS_ARB, debug ? GLX_CONTEXT_DEBUG_BIT_ARB : 0, None};
    PFNGLXCREATECONTEXTATTRIBSARBPROC create =
        (PFNGLXCREATECONTEXTATTRIBSARBPROC)glXGetProcAddressARB((const GLubyte *)"glXCreateContextAttribsARB");
    struct window w = {.display = XOpenDisplay(NULL)};
    GLXFBConfig *configs = w.display ? glXChooseFBConfig(w.display, DefaultScreen(w.display), any, &found) : NULL;
    if (!found)
        exit(2);
    XVisualInfo *visual = glXGetVisualFromFBConfig(w.display, configs[0]);
    Window root = DefaultRootWindow(w.display);
    XSetWindowAttributes a = {.colormap = XCreateColormap(w.display, root, visual->visual, AllocNone)};
    w.window = XCreateWindow(w.display, root, 0, 0, WIDTH, HEIGHT, 0, visual->depth, InputOutput, visual->visual, CWColormap, &a);
    XMapWindow(w.display, w.window);
    w.context = create(w.display, configs[0], NULL, True, attribs);
    if (!w.context)
        exit(3);
    XSync(w.display, False);
    return w;
}

static GLuint linked(void)
{
    const char *text[] = {"#version 120\nuniform mat4 m; void main() { gl_Position = m * gl_Vertex; gl_FrontColor = gl_Color; }",
                          "#version 120\nvoid main() { gl_FragColor = gl_Color; }"};
    GLuint program = glCreateProgram();
    for (int i = 0; i < 2; i++) {
        GLuint shader = glCreateShader(i ? GL_FRAGMENT_SHADER : GL_VERTEX_SHADER);
        glShaderSource(shader, 1, &text[i], NULL);
        glCompileShader(shader);
        glAttachShader(program, shader);
    }
    glLinkProgram(program);
    return program;
}

/* Framebuffers of the program's own with textures of many kinds. The window shows the first texture afterwards. */
enum { OWN = 4 };
static const GLenum targets[OWN] = {GL_TEXTURE_2D, GL_TEXTURE_RECTANGLE, GL_TEXTURE_2D_ARRAY, GL_TEXTURE_CUBE_MAP};
static GLuint framebuffers[OWN], textures[OWN];

static void make_framebuffers(void)
{
    GLuint depth;
    glGenTextures(OWN, textures);
    glGenFramebuffers(OWN, framebuffers);
    glGenRenderbuffers(1, &depth);
    glBindRenderbuffer(GL_RENDERBUFFER, depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, WIDTH, HEIGHT);
    for (int i = 0; i < OWN; i++) {
        int cube = targets[i] == GL_TEXTURE_CUBE_MAP, layers = targets[i] == GL_TEXTURE_2D_ARRAY;
        GLenum plane = cube ? GL_TEXTURE_CUBE_MAP_POSITIVE_X : targets[i];
        glBindTexture(targets[i], textures[i]);
        for (int face = 0; face < (cube ? 6 : 1); face++) {
            if (layers)
                glTexImage3D(targets[i], 0, GL_RGBA8, WIDTH, HEIGHT, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
            else
                glTexImage2D(plane + (GLenum)face, 0, GL_RGBA8, WIDTH, cube ? WIDTH : HEIGHT, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
        }
        glTexParameteri(targets[i], GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffers[i]);
        if (layers)
            glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, textures[i], 0, 1);
        else
            glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, plane, textures[i], 0);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, depth);
        glBindTexture(targets[i], 0);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

static void perspective(void)
{
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-0.5, 0.5, -0.5, 0.5, 1, 10);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslatef(0, 0, -2);
}

static void flat(void)
{
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
}

static void draw(int frame, GLuint program)
{
    static const GLfloat m[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.2f, -1, 0, 0, -2.2f, 0};
    static const GLubyte dot[4] = {1, 2, 3, 4};
    perspective();
    for (int i = OWN - 1; i >= 0; i--) {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffers[i]);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        halves(frame);
        glUseProgram(program);
        glUniformMatrix4fv(glGetUniformLocation(program, "m"), 1, GL_FALSE, m);
        glRectf(-0.2f, -0.2f, 0.2f, 0.2f);
        glUseProgram(0);
    }
    glTextureParameteri(textures[1], GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTextureSubImage2D(textures[1], 0, 0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, dot);
    glTextureSubImage3D(textures[3], 0, 0, 0, 5, 1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, dot);
    glClearTexImage(textures[2], 0, GL_RGBA, GL_UNSIGNED_BYTE, dot);
    glCopyImageSubData(textures[0], targets[0], 0, 0, 0, 0, textures[1], targets[1], 0, 0, 0, 0, 8, 8, 1);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    flat();
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_TEXTURE_2D);
    glBindTexture(GL_TEXTURE_2D, textures[0]);
    glColor3f(1, 1, 1);
    glBegin(GL_QUADS);
    for (int i = 0; i < 4; i++) {
        glTexCoord2i((i + 1) / 2 % 2, i / 2);
        glVertex2i((i + 1) / 2 % 2 * 2 - 1, i / 2 * 2 - 1);
    }
    glEnd();
    glDisable(GL_TEXTURE_2D);
    glBindTexture(GL_TEXTURE_2D, 0);
    perspective();
    glPushMatrix();
    glTranslatef(0.1f, 0, 0);
    glRectf(-0.1f, -0.1f, 0.1f, 0.1f);
    glPopMatrix();
}

static void held(int frame)
{
    for (int i = 0; i < OWN; i++) {
        unsigned char p[3][4];
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffers[i]);
        for (int x = 0; x < 3; x++)
            glReadPixels(x * WIDTH / 3, x * HEIGHT / 3, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, p[x]);
        printf("framebuffer %d in frame %d:", i, frame);
        for (int x = 0; x < 3; x++)
            printf(" %d %d %d%s", p[x][0], p[x][1], p[x][2], x < 2 ? "," : "\n");
    }
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

/* Makes a call that is wrong, and prints its error after the messages. */
#define TRY(call) (call, printf("  %x\n", glGetError()))

static void wrong(void)
{
    static unsigned char byte[64];
    TRY(glDrawArrays(0x77, 0, 3));
    TRY(glDrawArrays(GL_TRIANGLES, 0, -3));
    TRY(glClear(1));
    TRY(glDrawPixels(1, 1, 0x77, GL_UNSIGNED_BYTE, byte));
    TRY(glReadPixels(0, 0, 1, 1, 0x77, GL_UNSIGNED_BYTE, byte));
    TRY(glReadPixels(0, 0, -1, 1, GL_RGBA, GL_UNSIGNED_BYTE, byte));
    TRY(glBlitFramebuffer(0, 0, 1, 1, 0, 0, 1, 1, 0x77, GL_NEAREST));
    TRY(glBindFramebuffer(0x77, 0));
    TRY(glDrawBuffer(0x77));
    TRY(glReadBuffer(0x77));
    TRY(glCopyPixels(0, 0, -1, 1, GL_COLOR));
    TRY(glAccum(0x77, 1));
    TRY(glBegin(0x77));
    TRY(glEnd());
    TRY(glPopAttrib());
    TRY(glCallList(0));
    TRY(glEndList());
    TRY(glBindTexture(0x77, 1));
    TRY(glPopMatrix());
    glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_MARKER, 1, GL_DEBUG_SEVERITY_HIGH, -1, "a mark");
}

static void state(void)
{
    void *function = NULL, *data = NULL;
    GLboolean on = 9, synchronous = 9;
    glGetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &function);
    glGetPointerv(GL_DEBUG_CALLBACK_USER_PARAM, &data);
    on = glIsEnabled(GL_DEBUG_OUTPUT);
    synchronous = glIsEnabled(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    printf("callback %s, data %s, on %d, synchronous %d\n", function == (void *)message ? "ours" : function ? "another" : "none",
           data == (void *)&errors ? "ours" : data ? "other" : "none", on, synchronous);
}

int main(int arguments, char **argument)
{
    if (arguments < 3)
        return 1;
    const char *mode = argument[1];
    struct window w = open_with(!strcmp(argument[2], "debug"));
    make_current(&w);
    GLint flags = 0;
    glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
    printf("flags %x error %x\n", flags, glGetError());
    state();
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    if (strcmp(mode, "log"))
        glDebugMessageCallback(message, &errors);
    GLuint program = linked();
    make_framebuffers();
    for (int frame = 0; frame < 3; frame++) {
        draw(frame, program);
        if (!strcmp(mode, "wrong"))
            wrong();
        if (!strcmp(mode, "state"))
            state();
        if (!strcmp(mode, "log"))
            read_log();
        tell("drawn", frame);
        glXSwapBuffers(w.display, w.window);
        if (!strcmp(mode, "log"))
            read_log();
        tell("swapped", frame);
        held(frame);
        shown(&w, "frame", frame);
    }
    close_window(&w);
    return 0;
}
