/* Three walls at distances of 4 + frame/2, 10 and 40 units from the camera, in frames 1 to 10 of a surface without a window system.
 *
 * depths plain|reversed|inverted|overlay|weapon|cleared|covering|nodepth|nodepth-later|shader|block|apart|reversed-shader|pass-16|pass-24|pass-24-8|pass-32f|
 *        pass-unsized|pass-samples|part|pass-part|isometric|isometric-reversed|isometric-front|cut|cut-moving|cut-shader|cut-view
 *
 * reversed: glClipControl with depths from 1 (near) to 0 (infinitely far); inverted: glDepthRange(1, 0); overlay: a flat picture that
 * writes depths over everything at the end; weapon: a surface at 1.5 in a depth range of its own; cleared: the same after a clear of the
 * depths; covering: that at 12, behind the nearest wall; nodepth: no depth test; nodepth-later: none from frame 2 on; shader, block: shaders, with the projection in a uniform or a uniform block; apart: in the numbers of a vector, so that there is no matrix; pass: to a framebuffer of
 * twice the window's size, with depths in a renderbuffer (16, samples) or a texture (the others), whose picture is then drawn over the
 * window; part: the lowest quarter has the nearest depths and is not drawn to, by the viewport
 * or the scissor test of a pass, as under a status bar; isometric: without perspective, 68 units wide and from 1 to 100 deep, with other
 * walls and a piece of floor that is seen from an oblique direction; isometric-reversed: the same with depths from 1 (near) to 0 (far), isometric-front:
 * without the floor;
 * cut: from frame 6 on the camera looks the other way, where walls are at 1.5, 10 and 40; cut-moving: it also moves to and fro, by 0.9 near planes; by shaders with one matrix (shader) or two (view). */
#include "shaders.h"
#include "surface.h"

#include <string.h>

enum { FRAMES = 10 };

static void wall(double x, double distance, double half)
{
    glBegin(GL_QUADS);
    glVertex3d(x - half, -half, -distance);
    glVertex3d(x + half, -half, -distance);
    glVertex3d(x + half, half, -distance);
    glVertex3d(x - half, half, -distance);
    glEnd();
}

static void scene(int frame)
{
    const double nearest = 4 + frame * 0.5;
    glColor3d(0.8, 0.2, 0.2);
    wall(-nearest * 0.6, nearest, nearest * 0.2);
    glColor3d(0.2, 0.8, 0.2);
    wall(0, 10, 2);
    glColor3d(0.2, 0.2, 0.8);
    wall(40 * 0.6, 40, 8);
}

static void isometric_scene(const char *how, int frame)
{
    glMatrixMode(GL_MODELVIEW);
    glPushMatrix();
    glTranslated(0, -25, -20);
    glRotated(-60, 1, 0, 0);
    glColor3d(0.5, 0.5, 0.5);
    if (strcmp(how, "isometric-front"))
        wall(0, 0, 6);
    glPopMatrix();
    glColor3d(1, 0, 0);
    wall(-20, 4 + frame * 0.5, 6);
    glColor3d(0, 1, 0);
    wall(0, 10, 6);
    glColor3d(0, 0, 1);
    wall(20, 40, 6);
}

/* The same without a matrix. */
static void apart(void)
{
    GLuint program = glCreateProgram();
    GLfloat p[16];
    attached(program, GL_VERTEX_SHADER,
             "#version 120\nuniform vec4 lens; void main() { vec3 e = gl_Vertex.xyz; gl_Position = vec4(lens.x * e.x, lens.y * e.y, lens.z * e.z + lens.w, -e.z); gl_FrontColor = gl_Color; }");
    attached(program, GL_FRAGMENT_SHADER, "void main() { gl_FragColor = gl_Color; }");
    glLinkProgram(program);
    glUseProgram(program);
    glGetFloatv(GL_PROJECTION_MATRIX, p);
    glUniform4f(glGetUniformLocation(program, "lens"), p[0], p[5], p[10], p[14]);
    glLoadIdentity();
}

/* A program that uses the current projection. */
static void shaders(int block)
{
    static const char *const vertex[] = {
        "#version 120\nuniform mat4 camera; void main() { gl_Position = camera * gl_Vertex; gl_FrontColor = gl_Color; }",
        "#version 150 compatibility\nlayout(std140) uniform View { mat4 camera; }; void main() { gl_Position = camera * gl_Vertex; gl_FrontColor = gl_Color; }",
    };
    static const char *const fragment = "void main() { gl_FragColor = gl_Color; }";
    GLuint program = glCreateProgram(), buffer;
    GLfloat camera[16];
    attached(program, GL_VERTEX_SHADER, vertex[block]);
    attached(program, GL_FRAGMENT_SHADER, fragment);
    glLinkProgram(program);
    glUseProgram(program);
    glGetFloatv(GL_PROJECTION_MATRIX, camera);
    if (block) {
        glGenBuffers(1, &buffer);
        glBindBufferBase(GL_UNIFORM_BUFFER, 0, buffer);
        glBufferData(GL_UNIFORM_BUFFER, sizeof camera, camera, GL_STATIC_DRAW);
    } else
        glUniformMatrix4fv(glGetUniformLocation(program, "camera"), 1, GL_FALSE, camera);
    glLoadIdentity();
}

static void both_sides(void)
{
    const double nearest[2] = {6, 1.5};
    for (int side = 0; side < 2; side++) {
        const double sign = side ? -1 : 1;
        glColor3d(0.8, 0.2, 0.2);
        wall(-nearest[side] * 0.6, sign * nearest[side], nearest[side] * 0.2);
        glColor3d(0.2, 0.8, 0.2);
        wall(0, sign * 10, 2);
        glColor3d(0.2, 0.2, 0.8);
        wall(40 * 0.6, sign * 40, 8);
    }
}

/* A program with the uniforms `projection` and `view`; the projection is the current one. */
static GLuint cut_program(void)
{
    GLuint program = glCreateProgram();
    attached(program, GL_VERTEX_SHADER, "#version 120\nuniform mat4 projection, view; void main() { gl_Position = projection * view * gl_Vertex; gl_FrontColor = gl_Color; }");
    attached(program, GL_FRAGMENT_SHADER, "void main() { gl_FragColor = gl_Color; }");
    glLinkProgram(program);
    glUseProgram(program);
    return program;
}

static void cut_scene(const char *how, int frame)
{
    static GLuint program;
    const GLfloat turn = frame > 5 ? -1 : 1, view[16] = {turn, 0, 0, 0, 0, 1, 0, 0, 0, 0, turn, 0, 0, 0, 0, 1};
    GLfloat projection[16];
    glGetFloatv(GL_PROJECTION_MATRIX, projection);
    if (!strcmp(how, "cut-shader")) {
        if (frame == 1)
            shaders(0);
        glGetIntegerv(GL_CURRENT_PROGRAM, (GLint *)&program);
        glLoadMatrixf(projection);
        glMultMatrixf(view);
        glGetFloatv(GL_PROJECTION_MATRIX, projection);
        glUniformMatrix4fv(glGetUniformLocation(program, "camera"), 1, GL_FALSE, projection);
        glLoadIdentity();
    } else if (!strcmp(how, "cut-view")) {
        if (frame == 1)
            program = cut_program();
        glUniformMatrix4fv(glGetUniformLocation(program, "projection"), 1, GL_FALSE, projection);
        glUniformMatrix4fv(glGetUniformLocation(program, "view"), 1, GL_FALSE, view);
        glLoadIdentity();
    } else {
        glMatrixMode(GL_MODELVIEW);
        glLoadMatrixf(view);
        if (!strcmp(how, "cut-moving"))
            glTranslated(frame % 2 ? 0.45 : -0.45, 0, 0);
    }
    both_sides();
}

/* The framebuffer of a pass, and with samples the one that its picture is copied to; 0 where there is none. */
static GLuint pass, resolved;

/* A framebuffer with these depths: 0 samples and a texture, or a renderbuffer. Its colours are a texture where it has no samples. */
static GLuint framebuffer(GLenum format, int texture, int samples)
{
    GLuint names[2], name;
    glGenFramebuffers(1, &name);
    glBindFramebuffer(GL_FRAMEBUFFER, name);
    glGenTextures(2, names);
    if (samples) {
        GLuint colours;
        glGenRenderbuffers(1, &colours);
        glBindRenderbuffer(GL_RENDERBUFFER, colours);
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_RGBA8, 2 * WIDTH, 2 * HEIGHT);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colours);
    } else {
        glBindTexture(GL_TEXTURE_2D, names[0]);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 2 * WIDTH, 2 * HEIGHT, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, names[0], 0);
    }
    if (texture) {
        const int stencil = format == GL_DEPTH24_STENCIL8;
        glBindTexture(GL_TEXTURE_2D, names[1]);
        glTexImage2D(GL_TEXTURE_2D, 0, (GLint)format, 2 * WIDTH, 2 * HEIGHT, 0, stencil ? GL_DEPTH_STENCIL : GL_DEPTH_COMPONENT,
                     stencil ? GL_UNSIGNED_INT_24_8 : GL_UNSIGNED_INT, NULL);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glFramebufferTexture2D(GL_FRAMEBUFFER, stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, names[1], 0);
    } else {
        GLuint depths;
        glGenRenderbuffers(1, &depths);
        glBindRenderbuffer(GL_RENDERBUFFER, depths);
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, 2 * WIDTH, 2 * HEIGHT);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depths);
    }
    glBindTexture(GL_TEXTURE_2D, names[0]);
    return name;
}

static void make_pass(const char *how)
{
    const int samples = !strcmp(how, "pass-samples") ? 4 : 0;
    const GLenum format = !strcmp(how, "pass-16") ? GL_DEPTH_COMPONENT16
        : !strcmp(how, "pass-24-8")               ? GL_DEPTH24_STENCIL8
        : !strcmp(how, "pass-32f")                ? GL_DEPTH_COMPONENT32F
        : !strcmp(how, "pass-unsized")            ? GL_DEPTH_COMPONENT
                                                  : GL_DEPTH_COMPONENT24;
    if (samples)
        resolved = framebuffer(GL_DEPTH_COMPONENT16, 1, 0);
    pass = framebuffer(format, !samples && strcmp(how, "pass-16"), samples);
    if (samples) {
        GLint colours;
        glBindFramebuffer(GL_FRAMEBUFFER, resolved);
        glGetFramebufferAttachmentParameteriv(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME, &colours);
        glBindTexture(GL_TEXTURE_2D, (GLuint)colours);
    }
}

/* Draws the picture of the pass over the window. */
static void show_pass(void)
{
    static const GLfloat corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    if (resolved) {
        glBindFramebuffer(GL_READ_FRAMEBUFFER, pass);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved);
        glBlitFramebuffer(0, 0, 2 * WIDTH, 2 * HEIGHT, 0, 0, 2 * WIDTH, 2 * HEIGHT, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, WIDTH, HEIGHT);
    glLoadIdentity();
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_TEXTURE_2D);
    glColor3d(1, 1, 1);
    glBegin(GL_QUADS);
    for (int i = 0; i < 4; i++) {
        glTexCoord2f(0.5f + 0.5f * corners[i][0], 0.5f + 0.5f * corners[i][1]);
        glVertex2fv(corners[i]);
    }
    glEnd();
    glDisable(GL_TEXTURE_2D);
}

int main(int count, char **arguments)
{
    const char *how = count > 1 ? arguments[1] : "plain";
    const int cut = !strncmp(how, "cut", 3), block = !strcmp(how, "block"), shader = !cut && (block || strstr(how, "shader"));
    const int isometric = !strncmp(how, "isometric", 9), turned = !strcmp(how, "isometric-reversed");
    const int reversed = !strncmp(how, "reversed", 8), inverted = !strcmp(how, "inverted");
    PFNGLCLIPCONTROLPROC clip_control = (PFNGLCLIPCONTROLPROC)eglGetProcAddress("glClipControl");
    if (!open_surface() || !new_context(EGL_NO_CONTEXT))
        return 77;
    for (int frame = 1; frame <= FRAMES; frame++) {
        if (!strncmp(how, "pass", 4) && !pass)
            make_pass(how);
        glBindFramebuffer(GL_FRAMEBUFFER, pass);
        glViewport(0, 0, pass ? 2 * WIDTH : WIDTH, pass ? 2 * HEIGHT : HEIGHT);
        glMatrixMode(GL_PROJECTION);
        if (reversed) {
            /* Near plane at 1; z = near, w = distance. */
            const double infinite[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0};
            clip_control(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
            glLoadMatrixd(infinite);
        } else if (isometric) {
            glLoadIdentity();
            glOrtho(-34, 34, -34, 34, turned ? 100 : 1, turned ? 1 : 100);
        } else {
            glLoadIdentity();
            glFrustum(-1, 1, -1, 1, 1, 100);
        }
        if (shader && frame == 1)
            shaders(block);
        if (!strcmp(how, "apart") && frame == 1)
            apart();
        if (inverted)
            glDepthRange(1, 0);
        glClearDepth(reversed || inverted || turned ? 0 : 1);
        glDepthFunc(reversed || inverted || turned ? GL_GREATER : GL_LESS);
        if (strcmp(how, "nodepth") && (strcmp(how, "nodepth-later") || frame == 1))
            glEnable(GL_DEPTH_TEST);
        else
            glDisable(GL_DEPTH_TEST);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        if (strstr(how, "part")) {
            GLint whole[4];
            glGetIntegerv(GL_VIEWPORT, whole);
            glEnable(GL_SCISSOR_TEST);
            glScissor(0, 0, whole[2], whole[3] / 4);
            glClearDepth(0);
            glClear(GL_DEPTH_BUFFER_BIT);
            glClearDepth(1);
            if (pass) {
                glScissor(0, whole[3] / 4, whole[2], whole[3]);
            } else {
                glDisable(GL_SCISSOR_TEST);
                glViewport(0, whole[3] / 4, whole[2], 3 * whole[3] / 4);
            }
        }
        if (cut)
            cut_scene(how, frame);
        else if (isometric)
            isometric_scene(how, frame);
        else
            scene(frame);
        glDisable(GL_SCISSOR_TEST);
        if (!strcmp(how, "overlay")) {
            glLoadIdentity();
            glDepthFunc(GL_ALWAYS);
            glColor3d(1, 1, 1);
            glRectd(-1, -1, 1, -0.5);
            glRectd(-1, 0.1, 1, 1);
        }
        const int covering = !strcmp(how, "covering");
        if (covering || !strcmp(how, "cleared"))
            glClear(GL_DEPTH_BUFFER_BIT);
        if (!strcmp(how, "weapon"))
            glDepthRange(0, 0.3);
        if (covering || !strcmp(how, "weapon") || !strcmp(how, "cleared")) {
            glColor3d(1, 1, 0);
            wall(0, covering ? 12 : 1.5, covering ? 1.6 : 0.2);
        }
        glDepthRange(0, 1);
        if (pass)
            show_pass();
        eglSwapBuffers(display, surface);
    }
    return 0;
}
