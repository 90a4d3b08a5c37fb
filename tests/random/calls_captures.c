/* Transform feedback of a vertex shader; its fragments are those of fixed function. */
#include "random.h"
#include <string.h>

enum { CAPTURED = 4096 };

/* The shader and the buffer, at the first call. */
static int prepare(struct context *c)
{
    /* It writes all that fragments of fixed function read. */
    static const char *const source =
        "#version 120\n"
        "varying vec4 told;\n"
        "void main() {\n"
        "    gl_Position = ftransform();\n"
        "    gl_FrontColor = gl_BackColor = gl_Color;\n"
        "    gl_FrontSecondaryColor = gl_BackSecondaryColor = gl_SecondaryColor;\n"
        "    gl_TexCoord[0] = gl_MultiTexCoord0; gl_TexCoord[1] = gl_MultiTexCoord1;\n"
        "    gl_TexCoord[2] = gl_MultiTexCoord2; gl_TexCoord[3] = gl_MultiTexCoord3;\n"
        "    gl_FogFragCoord = gl_FogCoord;\n"
        "    gl_PointSize = 3.0;\n"
        "    gl_ClipVertex = gl_ModelViewMatrix * gl_Vertex;\n"
        "    told = gl_Vertex.yxwz + gl_Color;\n"
        "}\n";
    static const char *const told[] = {"told"};
    if (c->program)
        return 1;
    GLuint shader = glCreateShader(GL_VERTEX_SHADER);
    glShaderSource(shader, 1, &source, NULL);
    glCompileShader(shader);
    c->program = glCreateProgram();
    glAttachShader(c->program, shader);
    glTransformFeedbackVaryings(c->program, 1, told, GL_INTERLEAVED_ATTRIBS);
    glLinkProgram(c->program);
    glDeleteShader(shader);
    static const unsigned char zeros[CAPTURED];
    c->captured = 50 + (GLuint)(c - R->contexts);
    glBindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, c->captured);
    glBufferData(GL_TRANSFORM_FEEDBACK_BUFFER, CAPTURED, zeros, GL_DYNAMIC_COPY);
    return c->program != 0;
}

void end_capture(void)
{
    struct context *c = R->now;
    unsigned char bytes[CAPTURED];
    if (!c->program)
        return;
    if (bound(GL_TRANSFORM_FEEDBACK_BUFFER_ACTIVE))
        CALL0(glEndTransformFeedback);
    GLint before = bound(GL_TRANSFORM_FEEDBACK_BUFFER_BINDING);
    glBindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, c->captured);
    memset(bytes, 0, sizeof bytes);
    glGetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0, CAPTURED, bytes);
    glBindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, (GLuint)before);
    tell(&R->answers, "%d.%d captured %llx", R->step, R->part, (unsigned long long)hash(bytes, sizeof bytes));
}

int is_refused(GLenum mode)
{
    struct context *c = R->now;
    GLenum kind = mode == GL_POINTS ? GL_POINTS : mode <= GL_LINE_STRIP ? GL_LINES : GL_TRIANGLES;
    return !R->list && c->program && bound(GL_TRANSFORM_FEEDBACK_BUFFER_ACTIVE) && !bound(GL_TRANSFORM_FEEDBACK_BUFFER_PAUSED) && kind != c->fed;
}

/* Begins to capture primitives of a kind, if nothing is captured yet. */
static void begin_capture(GLenum kind)
{
    int before = bound(GL_TRANSFORM_FEEDBACK_BUFFER_ACTIVE);
    CALL(glBeginTransformFeedback, kind);
    if (!before)
        R->now->fed = kind;
}

static void capture(void)
{
    struct context *c = R->now;
    GLint value = -1;
    if (R->begin || R->list || !prepare(c))
        return;
    switch (below(10)) {
    case 0: case 1: CALL(glUseProgram, c->program); break;
    case 2: CALL(glUseProgram, 0u); break;
    case 3: CALL(glBindBufferBase, ENUM(GL_TRANSFORM_FEEDBACK_BUFFER), chance(95) ? 0u : 99u, chance(90) ? c->captured : 0u); break;
    case 4: CALL(glBindBufferRange, GL_TRANSFORM_FEEDBACK_BUFFER, chance(80) ? 0u : 1u, c->captured,
                 (GLintptr)below(9) * (chance(90) ? 4 : 3), (GLsizeiptr)below(33) * 16); break;
    case 5: case 6:
        CALL(glUseProgram, c->program);
        CALL(glBindBufferBase, GL_TRANSFORM_FEEDBACK_BUFFER, 0u, c->captured);
        begin_capture(ENUM(GL_POINTS, GL_LINES, GL_TRIANGLES, GL_TRIANGLES));
        break;
    case 7: chance(50) ? CALL0(glPauseTransformFeedback) : CALL0(glResumeTransformFeedback); break;
    case 8:
        CALL(glGetIntegeri_v, ENUM(GL_TRANSFORM_FEEDBACK_BUFFER_START, GL_TRANSFORM_FEEDBACK_BUFFER_SIZE), 0u, &value);
        tell(&R->answers, "%d.%d of the capture %d active %d paused %d", R->step, R->part, value, bound(GL_TRANSFORM_FEEDBACK_BUFFER_ACTIVE),
             bound(GL_TRANSFORM_FEEDBACK_BUFFER_PAUSED));
        break;
    default: end_capture(); break;
    }
}

const struct generator capture_calls[] = {{"capture", CAPTURES, 60, capture}, {0}};
