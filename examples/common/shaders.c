/* Shader programs and matrices, for demos that have shaders. */
#include "demo.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* The first line for OpenGL ES, in place of the text's own, which is skipped. */
static const char *first_line(const char **text)
{
    static const struct { const char *desktop, *es; } lines[] = {
        {"#version 120\n", "precision highp float;\n"},
        {"#version 330 core\n", "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2DShadow;\n"}};
    for (size_t k = 0; demo_es && k < sizeof lines / sizeof *lines; k++) {
        size_t n = strlen(lines[k].desktop);
        if (!strncmp(*text, lines[k].desktop, n)) {
            *text += n;
            return lines[k].es;
        }
    }
    return "";
}

static GLuint shader(GLenum kind, const char *text)
{
    GLuint s = glCreateShader(kind);
    GLint ok;
    const char *first = first_line(&text), *texts[2] = {first, text};
    glShaderSource(s, 2, texts, NULL);
    glCompileShader(s);
    glGetShaderiv(s, GL_COMPILE_STATUS, &ok);
    if (!ok) {
        char log[1000];
        glGetShaderInfoLog(s, sizeof log, NULL, log);
        demo_fail(1, "a shader does not compile: %s", log);
    }
    return s;
}

GLuint demo_stages(const char *const texts[5])
{
    static const GLenum kinds[5] = {GL_VERTEX_SHADER, GL_TESS_CONTROL_SHADER, GL_TESS_EVALUATION_SHADER, GL_GEOMETRY_SHADER,
                                    GL_FRAGMENT_SHADER};
    GLuint stages[5], program = glCreateProgram();
    GLint ok;
    for (int k = 0; k < 5; k++)
        if (texts[k]) {
            stages[k] = shader(kinds[k], texts[k]);
            glAttachShader(program, stages[k]);
        }
    glBindAttribLocation(program, 0, "position");
    glBindAttribLocation(program, 1, "normal");
    glLinkProgram(program);
    /* Detaches and deletes the shaders, as many programs do. */
    for (int k = 0; k < 5; k++)
        if (texts[k]) {
            glDetachShader(program, stages[k]);
            glDeleteShader(stages[k]);
        }
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    if (!ok) {
        char log[1000];
        glGetProgramInfoLog(program, sizeof log, NULL, log);
        demo_fail(1, "a program does not link: %s", log);
    }
    return program;
}

GLuint demo_program(const char *vertex, const char *fragment)
{
    return demo_stages((const char *const[5]){vertex, NULL, NULL, NULL, fragment});
}

GLuint demo_buffer(GLenum target, const void *data, size_t size)
{
    GLuint name;
    glGenBuffers(1, &name);
    glBindBuffer(target, name);
    glBufferData(target, (GLsizeiptr)size, data, data ? GL_STATIC_DRAW : GL_STREAM_DRAW);
    return name;
}

void demo_needs(int version)
{
    const char *text = (const char *)glGetString(GL_VERSION);
    int major = 0, minor = 0;
    if (!text || sscanf(text, "%d.%d", &major, &minor) != 2 || 10 * major + minor < version)
        demo_fail(1, "needs OpenGL %d.%d, here is %s", version / 10, version % 10, text ? text : "none");
}

void demo_times(demo_matrix out, const demo_matrix a, const demo_matrix b)
{
    demo_matrix p;
    for (int c = 0; c < 4; c++)
        for (int r = 0; r < 4; r++) {
            double sum = 0.0;
            for (int k = 0; k < 4; k++)
                sum += (double)a[4 * k + r] * b[4 * c + k];
            p[4 * c + r] = (GLfloat)sum;
        }
    memcpy(out, p, sizeof p);
}

void demo_inverse(demo_matrix out, const demo_matrix m)
{
    double rows[4][8];
    for (int r = 0; r < 4; r++)
        for (int c = 0; c < 8; c++)
            rows[r][c] = c < 4 ? (double)m[4 * c + r] : c == r + 4;
    for (int k = 0; k < 4; k++) {
        int best = k;
        for (int r = k + 1; r < 4; r++)
            best = fabs(rows[r][k]) > fabs(rows[best][k]) ? r : best;
        for (int c = 0; c < 8; c++) {
            double value = rows[best][c];
            rows[best][c] = rows[k][c], rows[k][c] = value;
        }
        for (int c = 7; c >= k; c--)
            rows[k][c] /= rows[k][k];
        for (int r = 0; r < 4; r++)
            for (int c = 7; r != k && c >= k; c--)
                rows[r][c] -= rows[r][k] * rows[k][c];
    }
    for (int r = 0; r < 4; r++)
        for (int c = 0; c < 4; c++)
            out[4 * c + r] = (GLfloat)rows[r][4 + c];
}

void demo_frustum(demo_matrix out, double fovy, double aspect, double n, double f)
{
    double h = 1.0 / tan(fovy * M_PI / 360.0);
    demo_matrix p = {(GLfloat)(h / aspect), 0, 0, 0, 0, (GLfloat)h, 0, 0,
                     0, 0, (GLfloat)(-(f + n) / (f - n)), -1, 0, 0, (GLfloat)(-2.0 * f * n / (f - n)), 0};
    memcpy(out, p, sizeof p);
}

void demo_turned(demo_matrix out, double angle, double u, double v, double x, double y, double z)
{
    double c = cos(angle), s = sin(angle);
    demo_matrix p = {(GLfloat)(u * u + (1 - u * u) * c), (GLfloat)(u * v * (1 - c)), (GLfloat)(-v * s), 0.0f,
                     (GLfloat)(u * v * (1 - c)), (GLfloat)(v * v + (1 - v * v) * c), (GLfloat)(u * s), 0.0f,
                     (GLfloat)(v * s), (GLfloat)(-u * s), (GLfloat)c, 0.0f,
                     (GLfloat)x, (GLfloat)y, (GLfloat)z, 1.0f};
    memcpy(out, p, sizeof p);
}

void demo_look(demo_matrix m, demo_matrix back, const double from[3], const double to[3])
{
    double z[3], x[3], y[3], far = 0.0;
    for (int k = 0; k < 3; k++)
        z[k] = from[k] - to[k], far += z[k] * z[k];
    for (int k = 0; k < 3; k++)
        z[k] /= sqrt(far);
    double across = sqrt(z[0] * z[0] + z[2] * z[2]);
    x[0] = z[2] / across, x[1] = 0.0, x[2] = -z[0] / across;
    y[0] = z[1] * x[2], y[1] = z[2] * x[0] - z[0] * x[2], y[2] = -z[1] * x[0];
    const double *rows[3] = {x, y, z};
    memset(m, 0, sizeof(demo_matrix));
    memset(back, 0, sizeof(demo_matrix));
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) {
            m[4 * c + r] = back[4 * r + c] = (GLfloat)rows[r][c];
            m[12 + r] = (GLfloat)(m[12 + r] - rows[r][c] * from[c]);
            back[12 + c] = (GLfloat)from[c];
        }
    m[15] = back[15] = 1.0f;
}
