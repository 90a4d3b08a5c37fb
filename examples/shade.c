/* Programs with shaders of their own, in buffers: light in each pixel, or steps of it (--toon), and a flat display by the same
 * program. --glsl 120: attributes and varyings, matrices as uniforms; 330: the camera in a uniform block, the model in a uniform. */
#include "demo.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static int version = 120, toon, combined;
const struct demo_option demo_options[] = {
    {"--glsl", "120 or 330 (default 120)", &version, 1},
    {"--toon", "steps of light and dark outlines", &toon, 0},
    {"--combined", "one matrix for projection, camera and model (120)", &combined, 0},
    {0}};

static const char *const vertex_120 =
    "#version 120\n"
    "attribute vec3 position, normal;\n"
    "uniform mat4 projection, modelview;\n"
    "uniform float size;\n"
    "varying vec3 eye, n;\n"
    "void main(void)\n"
    "{\n"
    "    vec4 e = modelview * vec4(position * size, 1.0);\n"
    "    eye = e.xyz;\n"
    "    n = mat3(modelview[0].xyz, modelview[1].xyz, modelview[2].xyz) * normal;\n"
    "    gl_Position = projection * e;\n"
    "}\n";
static const char *const vertex_combined =
    "#version 120\n"
    "attribute vec3 position, normal;\n"
    "uniform mat4 modelview, everything;\n"
    "uniform float size;\n"
    "varying vec3 eye, n;\n"
    "void main()\n"
    "{\n"
    "    eye = (modelview * vec4(position * size, 1.0)).xyz;\n"
    "    n = mat3(modelview[0].xyz, modelview[1].xyz, modelview[2].xyz) * normal;\n"
    "    gl_Position = everything * vec4(position * size, 1.0);\n"
    "}\n";
static const char *const fragment_120 =
    "#version 120\n"
    "uniform vec4 colour;\n"
    "uniform float steps, unlit;\n"
    "varying vec3 eye, n;\n"
    "void main()\n"
    "{\n"
    "    vec3 d = normalize(n), l = normalize(vec3(3.0, 6.0, 2.0) - eye);\n"
    "    float light = max(dot(d, l), 0.0), edge = abs(dot(d, normalize(eye)));\n"
    "    light = steps > 0.0 ? floor(light * steps + 0.5) / steps * step(0.25, edge) : light + pow(light, 30.0) * 0.4;\n"
    "    float net = mod(floor(gl_FragCoord.x) + floor(gl_FragCoord.y), 2.0);\n"
    "    gl_FragColor = vec4(colour.rgb * mix(0.17 + 0.8 * light, 0.8 + 0.2 * net, unlit), colour.a);\n"
    "}\n";
static const char *const vertex_330 =
    "#version 330 core\n"
    "layout(std140) uniform Camera { vec4 sun; mat4 projection; mat4 view; } camera;\n"
    "uniform mat4 model;\n"
    "uniform float size;\n"
    "layout(location = 0) in vec3 position;\n"
    "layout(location = 1) in vec3 normal;\n"
    "out vec3 eye, n;\n"
    "void main()\n"
    "{\n"
    "    vec4 e = camera.view * model * vec4(position * size, 1.0);\n"
    "    eye = e.xyz;\n"
    "    n = mat3(camera.view) * mat3(model) * normal;\n"
    "    gl_Position = camera.projection * e;\n"
    "}\n";
static const char *const fragment_330 =
    "#version 330 core\n"
    "layout(std140) uniform Camera { vec4 sun; mat4 projection; mat4 view; } camera;\n"
    "uniform vec4 colour;\n"
    "uniform float steps, unlit;\n"
    "in vec3 eye, n;\n"
    "out vec4 shown;\n"
    "void main()\n"
    "{\n"
    "    vec3 d = normalize(n), l = normalize(camera.sun.xyz - eye);\n"
    "    float light = max(dot(d, l), 0.0), edge = abs(dot(d, normalize(eye)));\n"
    "    light = steps > 0.0 ? floor(light * steps + 0.5) / steps * step(0.25, edge) : light + pow(light, 30.0) * 0.4;\n"
    "    float net = mod(floor(gl_FragCoord.x) + floor(gl_FragCoord.y), 2.0);\n"
    "    shown = vec4(colour.rgb * mix(0.17 + 0.8 * light, 0.8 + 0.2 * net, unlit), colour.a);\n"
    "}\n";

enum { SLICES = 48, STACKS = 24, QUAD = 4 };
static GLuint program, buffer, indices, block;
static GLsizei count;

static GLuint shader(GLenum kind, const char *text)
{
    GLuint s = glCreateShader(kind);
    GLint ok;
    glShaderSource(s, 1, &text, NULL);
    glCompileShader(s);
    glGetShaderiv(s, GL_COMPILE_STATUS, &ok);
    if (!ok) {
        char log[1000];
        glGetShaderInfoLog(s, sizeof log, NULL, log);
        demo_fail(1, "a shader does not compile: %s", log);
    }
    return s;
}

void demo_setup(void)
{
    GLfloat(*v)[6] = malloc(sizeof *v * (SLICES + 1) * (STACKS + 1) + sizeof *v * QUAD);
    GLushort *i = malloc(sizeof *i * 6 * SLICES * STACKS), *o = i;
    GLint ok;
    if (!v || !i)
        demo_fail(1, "out of memory");
    if (version != 120 && version != 330)
        demo_fail(2, "--glsl: 120 or 330");
    for (int s = 0; s <= SLICES; s++)
        for (int t = 0; t <= STACKS; t++) {
            double a = 2.0 * M_PI * (s % SLICES) / SLICES, b = 2.0 * M_PI * (t % STACKS) / STACKS;
            double x = cos(b) * cos(a), y = cos(b) * sin(a), z = sin(b);
            GLfloat *p = v[s * (STACKS + 1) + t];
            p[0] = (GLfloat)(cos(a) + 0.4 * x), p[1] = (GLfloat)(sin(a) + 0.4 * y), p[2] = (GLfloat)(0.4 * z);
            p[3] = (GLfloat)x, p[4] = (GLfloat)y, p[5] = (GLfloat)z;
        }
    for (int s = 0; s < SLICES; s++)
        for (int t = 0; t < STACKS; t++) {
            GLushort a = (GLushort)(s * (STACKS + 1) + t), b = (GLushort)(a + STACKS + 1);
            GLushort six[6] = {a, b, (GLushort)(b + 1), a, (GLushort)(b + 1), (GLushort)(a + 1)};
            memcpy(o, six, sizeof six);
            o += 6;
        }
    count = (GLsizei)(o - i);
    for (int c = 0; c < QUAD; c++) {
        GLfloat *p = v[(SLICES + 1) * (STACKS + 1) + c];
        p[0] = c == 1 || c == 2 ? 1.0f : -1.0f, p[1] = c >= 2 ? 1.0f : -1.0f, p[2] = 0.0f;
        p[3] = p[4] = 0.0f, p[5] = 1.0f;
    }
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(sizeof *v * ((SLICES + 1) * (STACKS + 1) + QUAD)), v, GL_STATIC_DRAW);
    glGenBuffers(1, &indices);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)sizeof *i * count, i, GL_STATIC_DRAW);
    free(v);
    free(i);
    GLuint vs = shader(GL_VERTEX_SHADER, version == 330 ? vertex_330 : combined ? vertex_combined : vertex_120);
    GLuint fs = shader(GL_FRAGMENT_SHADER, version == 330 ? fragment_330 : fragment_120);
    program = glCreateProgram();
    glAttachShader(program, vs);
    glAttachShader(program, fs);
    glBindAttribLocation(program, 0, "position");
    glBindAttribLocation(program, 1, "normal");
    glLinkProgram(program);
    /* As programs do that keep no more than they need. */
    glDetachShader(program, vs);
    glDetachShader(program, fs);
    glDeleteShader(vs);
    glDeleteShader(fs);
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    if (!ok)
        demo_fail(1, "the program does not link");
    if (version == 330) {
        glGenBuffers(1, &block);
        glUniformBlockBinding(program, glGetUniformBlockIndex(program, "Camera"), 3);
        glBindBufferBase(GL_UNIFORM_BUFFER, 3, block);
    }
    glEnableVertexAttribArray(0);
    glEnableVertexAttribArray(1);
    glVertexAttribPointer(0, 3, GL_FLOAT, 0, 24, (void *)0);
    glVertexAttribPointer(1, 3, GL_FLOAT, 0, 24, (void *)12);
    glClearColor(0.12f, 0.13f, 0.2f, 1.0f);
}

typedef GLfloat matrix[16]; /* column-major */

static void times(matrix out, const matrix a, const matrix b)
{
    matrix p;
    for (int c = 0; c < 4; c++)
        for (int r = 0; r < 4; r++) {
            double sum = 0.0;
            for (int k = 0; k < 4; k++)
                sum += (double)a[4 * k + r] * b[4 * c + k];
            p[4 * c + r] = (GLfloat)sum;
        }
    memcpy(out, p, sizeof p);
}

static GLint at(const char *name) { return glGetUniformLocation(program, name); }

/* What the shaders see of a projection, a camera and a place. */
static void load(const matrix projection, const matrix view, const matrix model)
{
    matrix mv, all;
    if (version == 330) {
        GLfloat camera[36] = {3.0f, 6.0f, 2.0f, 1.0f};
        memcpy(camera + 4, projection, sizeof(matrix));
        memcpy(camera + 20, view, sizeof(matrix));
        glBindBuffer(GL_UNIFORM_BUFFER, block);
        glBufferData(GL_UNIFORM_BUFFER, sizeof camera, camera, GL_STREAM_DRAW);
        glUniformMatrix4fv(at("model"), 1, 0, model);
        return;
    }
    times(mv, view, model);
    times(all, projection, mv);
    glUniformMatrix4fv(at("modelview"), 1, 0, mv);
    glUniformMatrix4fv(at(combined ? "everything" : "projection"), 1, 0, combined ? all : projection);
}

static void place(matrix m, double angle, double x, double y, double z)
{ /* turned about (0.6, 0.8, 0), then moved */
    double c = cos(angle), s = sin(angle), u = 0.6, v = 0.8;
    matrix p = {(GLfloat)(u * u + (1 - u * u) * c), (GLfloat)(u * v * (1 - c)), (GLfloat)(-v * s), 0.0f,
                (GLfloat)(u * v * (1 - c)), (GLfloat)(v * v + (1 - v * v) * c), (GLfloat)(u * s), 0.0f,
                (GLfloat)(v * s), (GLfloat)(-u * s), (GLfloat)c, 0.0f,
                (GLfloat)x, (GLfloat)y, (GLfloat)z, 1.0f};
    memcpy(m, p, sizeof p);
}

void demo_frame(int frame)
{
    double t = demo_time(frame), n = 1.0, f = 50.0, h = 1.0 / tan(20.0 * M_PI / 180.0);
    matrix projection = {(GLfloat)(h * demo_height / demo_width), 0, 0, 0, 0, (GLfloat)h, 0, 0,
                         0, 0, (GLfloat)(-(f + n) / (f - n)), -1, 0, 0, (GLfloat)(-2.0 * f * n / (f - n)), 0};
    matrix plain = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, view, model;
    demo_viewport(0, 0, demo_width, demo_height);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glUseProgram(program);
    demo_view(projection);
    glUniform1f(at("steps"), toon ? 3.0f : 0.0f);
    glUniform1f(at("unlit"), 0.0f);
    glUniform1f(at("size"), 1.0f);
    place(view, 0.15, 0.0, -0.3, -8.5);
    for (int k = 0; k < 5; k++) {
        place(model, t + 1.3 * k, 1.9 * (k - 2), 0.9 * sin(1.9 * k), -2.5 * (k % 3) + 2.0);
        load(projection, view, model);
        glUniform4f(at("colour"), (GLfloat)(0.55 + 0.4 * sin(1.1 * k)), (GLfloat)(0.55 + 0.4 * sin(1.1 * k + 2.0)), 0.7f, 1.0f);
        glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_SHORT, (void *)0);
    }
    /* The display: no depth, no perspective. */
    glDisable(GL_DEPTH_TEST);
    glUniform1f(at("unlit"), 1.0f);
    glUniform1f(at("size"), 0.1f);
    for (int k = 0; k < 4; k++) {
        memcpy(model, plain, sizeof model);
        model[12] = (GLfloat)(-0.75 + 0.5 * k);
        model[13] = -0.82f;
        load(plain, plain, model);
        glUniform4f(at("colour"), 0.9f, (GLfloat)(0.3 + 0.15 * k), 0.25f, 1.0f);
        glDrawArrays(GL_TRIANGLE_FAN, (SLICES + 1) * (STACKS + 1), QUAD);
    }
    glUseProgram(0);
}
