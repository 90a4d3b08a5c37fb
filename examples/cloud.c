/* Clouds of points around and between surfaces: one from arrays, one by indices, and with fixed function one by glBegin. Some points are on the near plane, behind
 * the eye, far outside, or not numbers. --glsl 0: fixed function; 120, 330: shaders. --attenuate: smaller with the distance; --sprites: as GL_POINT_SPRITE, with
 * shaders round by gl_PointCoord; --lit: by a light, and fog; --blend: half transparent; --clip: by a plane; --texture: points with a texel each. --framebuffer N: drawn to a framebuffer with N samples,
 * which is then copied to the window. --disks: shaders draw each point as a disk that closes the gap to its neighbours. */
#include "demo.h"
#include <math.h>
#include <stdlib.h>

static int version, attenuate, sprites, lit, blend, clip, texture, smooth, upper_left, inset, framebuffer, disks, count = 20000, size = 3;
const struct demo_option demo_options[] = {
    {"--glsl", "0, 120 or 330 (default 0)", &version, DEMO_NUMBER},
    {"--count", "number of points (default 20000)", &count, DEMO_NUMBER},
    {"--point-size", "in pixels (default 3)", &size, DEMO_NUMBER},
    {"--attenuate", "smaller with the distance", &attenuate, DEMO_NOTHING},
    {"--sprites", "squares about their centre, with coordinates", &sprites, DEMO_NOTHING},
    {"--lit", "a light and fog", &lit, DEMO_NOTHING},
    {"--blend", "half transparent", &blend, DEMO_NOTHING},
    {"--clip", "behind a plane", &clip, DEMO_NOTHING},
    {"--texture", "a texel for each point", &texture, DEMO_NOTHING},
    {"--smooth", "by GL_POINT_SMOOTH", &smooth, DEMO_NOTHING},
    {"--upper-left", "with the origin of the clip volume at the upper left (OpenGL 4.5)", &upper_left, DEMO_NOTHING},
    {"--inset", "in a part of the window, of which a scissor cuts a part", &inset, DEMO_NOTHING},
    {"--disks", "with shaders: as large as the gaps between neighbours", &disks, DEMO_NOTHING},
    {"--framebuffer", "1: by a framebuffer of its own; 2 to 4: with so many samples", &framebuffer, DEMO_NUMBER},
    {0}};

static const char *const vertex_120 =
    "#version 120\n"
    "attribute vec3 position, normal;\n"
    "attribute float radius;\n"
    "uniform mat4 projection, modelview;\n"
    "uniform float size, attenuate, disks;\n"
    "varying vec4 shade;\n"
    "void main()\n"
    "{\n"
    "    vec4 eye = modelview * vec4(position, 1.0);\n"
    "    shade = vec4(0.5 + 0.5 * normal, 1.0);\n"
    "    gl_FrontColor = vec4(shade.bgr, 0.6);\n"
    "    gl_PointSize = attenuate > 0.0 ? size * 8.0 / max(-eye.z, 0.1) : size;\n"
    "    gl_Position = projection * eye;\n"
    "    if (disks > 0.0) gl_PointSize = max(radius * disks / gl_Position.w, 1.0);\n"
    "}\n";
static const char *const fragment_120 =
    "#version 120\n"
    "uniform float around;\n"
    "varying vec4 shade;\n"
    "void main()\n"
    "{\n"
    "    vec2 at = 2.0 * gl_PointCoord - 1.0;\n"
    "    if (around > 0.0 && dot(at, at) > 1.0) discard;\n"
    "    vec4 colour = around > 0.75 ? vec4(shade.rg, 0.5 + 0.5 * at.y, 1.0) : shade;\n"
    "    gl_FragColor = vec4(mix(colour.rgb, gl_Color.rgb, 0.5), gl_Color.a);\n"
    "}\n";
static const char *const plain_120 =
    "#version 120\n"
    "varying vec4 shade;\n"
    "void main()\n"
    "{\n"
    "    gl_FragColor = vec4(mix(shade.rgb, gl_Color.rgb, 0.5), gl_Color.a);\n"
    "}\n";
static const char *const vertex_330 =
    "#version 330 core\n"
    "layout(location = 0) in vec3 position;\n"
    "layout(location = 1) in vec3 normal;\n"
    "layout(location = 2) in float radius;\n"
    "uniform mat4 projection, modelview;\n"
    "uniform float size, attenuate, disks;\n"
    "flat out vec4 shade;\n"
    "out float far, height;\n"
    "flat out ivec2 parts;\n"
    "void main()\n"
    "{\n"
    "    vec4 eye = modelview * vec4(position, 1.0);\n"
    "    shade = vec4(0.5 + 0.5 * normal, 0.6);\n"
    "    far = clamp(-eye.z / 16.0, 0.0, 1.0);\n"
    "    height = position.y;\n"
    "    parts = ivec2(gl_VertexID % 7, gl_VertexID % 3);\n"
    "    gl_PointSize = attenuate > 0.0 ? size * 8.0 / max(-eye.z, 0.1) : size;\n"
    "    gl_Position = projection * eye;\n"
    "    if (disks > 0.0) gl_PointSize = max(radius * disks / gl_Position.w, 1.0);\n"
    "}\n";
static const char *const fragment_330 =
    "#version 330 core\n"
    "uniform float around;\n"
    "flat in vec4 shade;\n"
    "in float far, height;\n"
    "flat in ivec2 parts;\n"
    "out vec4 colour;\n"
    "void main()\n"
    "{\n"
    "    vec2 at = 2.0 * gl_PointCoord - 1.0;\n"
    "    if (around > 0.0 && dot(at, at) > 1.0) discard;\n"
    "    float net = mod(floor(gl_FragCoord.x) + floor(gl_FragCoord.y), 2.0);\n"
    "    colour = vec4(mix(shade.rgb, vec3(0.1, 0.2, 0.3), far) * (0.8 + 0.05 * float(parts.x)) + 0.1 * net * float(parts.y), shade.a);\n"
    "}\n";

static const char *const plain_330 =
    "#version 330 core\n"
    "flat in vec4 shade;\n"
    "in float far, height;\n"
    "flat in ivec2 parts;\n"
    "out vec4 colour;\n"
    "void main()\n"
    "{\n"
    "    float net = mod(floor(gl_FragCoord.x) + floor(gl_FragCoord.y), 2.0);\n"
    "    colour = vec4(mix(shade.rgb, vec3(0.1, 0.2, 0.3), far) * (0.8 + 0.05 * float(parts.x)) + 0.1 * net * float(parts.y), shade.a);\n"
    "}\n";

static GLfloat *places, *normals, *radii;
static GLubyte *colours;
static GLuint program, buffers[4], arrays, inside, image, stores[2];
static unsigned seed = 2026;

static double chance(void)
{
    seed = seed * 1664525u + 1013904223u;
    return (seed >> 8) / 16777216.0;
}

/* The distance of the sixth nearest of some points. */
static GLfloat distance(int point, int first, int end)
{
    GLfloat nearest[6];
    int found = 0;
    for (int i = first; i < end; i++) {
        GLfloat squared = 0.0f;
        int at = found < 6 ? found : 5;
        for (int k = 0; k < 3; k++)
            squared += (places[3 * i + k] - places[3 * point + k]) * (places[3 * i + k] - places[3 * point + k]);
        if (i == point || !isfinite(squared) || squared == 0.0f || (found == 6 && squared >= nearest[5]))
            continue;
        for (; at > 0 && nearest[at - 1] > squared; at--)
            nearest[at] = nearest[at - 1];
        nearest[at] = squared;
        found += found < 6;
    }
    return found ? sqrtf(nearest[found - 1]) : 0.0f;
}

static int by_size(const void *a, const void *b)
{
    GLfloat x = *(const GLfloat *)a, y = *(const GLfloat *)b;
    return (x > y) - (x < y);
}

/* Disks of some points that reach a little beyond the middle of the way to the sixth nearest; those far from all others have thrice the median at most. */
static void find_radii(int first, int end)
{
    GLfloat *sorted = malloc(sizeof *sorted * (size_t)(end - first)), most;
    int found = 0;
    for (int i = first; i < end; i++) {
        radii[i] = distance(i, first, end);
        if (radii[i] > 0.0f)
            sorted[found++] = radii[i];
    }
    qsort(sorted, (size_t)found, sizeof *sorted, by_size);
    most = 3.0f * sorted[found / 2];
    for (int i = first; i < end; i++)
        radii[i] = 1.1f * (radii[i] < most ? radii[i] : most);
    free(sorted);
}

void demo_setup(void)
{
    static const GLfloat strange[8][3] = {
        {0.0f, 0.0f, 6.5f},  {0.1f, 0.0f, 9.0f},    {1e30f, 0.0f, 0.0f},        {-40.0f, 0.1f, 0.0f},
        {NAN, 0.0f, 0.0f},   {0.0f, INFINITY, 0.0f}, {0.0f, 0.0f, 7.5f},         {0.0f, -3.0f, -60.0f}};
    GLuint *numbers = malloc(sizeof *numbers * (size_t)count);
    places = malloc(sizeof *places * 3 * (size_t)count);
    normals = malloc(sizeof *normals * 3 * (size_t)count);
    colours = malloc(4 * (size_t)count);
    for (int i = 0; i < count; i++) {
        double z = 2.0 * chance() - 1.0, a = 2.0 * M_PI * chance(), r = sqrt(1.0 - z * z), far = 1.0 + 1.2 * pow(chance(), 4.0);
        double n[3] = {r * cos(a), r * sin(a), z};
        for (int k = 0; k < 3; k++) {
            places[3 * i + k] = (GLfloat)(n[k] * far * 1.6);
            normals[3 * i + k] = (GLfloat)n[k];
            colours[4 * i + k] = (GLubyte)(128 + 120 * n[k]);
        }
        colours[4 * i + 3] = 150;
        for (int k = 0; k < 3 && i < 8; k++)
            places[3 * i + k] = strange[i][k];
        numbers[i] = (GLuint)(count - 1 - i);
    }
    radii = calloc((size_t)count, sizeof *radii);
    if (disks) {
        find_radii(0, count / 2);
        find_radii(count - count / 2, count);
    }
    if (version) {
        const char *round = disks || sprites ? (version == 330 ? fragment_330 : fragment_120) : (version == 330 ? plain_330 : plain_120);
        int core = version == 330;
        if (core) {
            glGenVertexArrays(1, &arrays);
            glBindVertexArray(arrays);
        }
        program = demo_program(core ? vertex_330 : vertex_120, round);
        buffers[0] = demo_buffer(GL_ARRAY_BUFFER, places, sizeof *places * 3 * (size_t)count);
        glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, 0);
        buffers[1] = demo_buffer(GL_ARRAY_BUFFER, normals, sizeof *normals * 3 * (size_t)count);
        glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, 0, 0);
        buffers[3] = demo_buffer(GL_ARRAY_BUFFER, radii, sizeof *radii * (size_t)count);
        glVertexAttribPointer(2, 1, GL_FLOAT, GL_FALSE, 0, 0);
        glBindBuffer(GL_ARRAY_BUFFER, 0);
        glEnable(GL_PROGRAM_POINT_SIZE);
    }
    buffers[2] = demo_buffer(GL_ELEMENT_ARRAY_BUFFER, numbers, sizeof *numbers * (size_t)count);
    free(numbers);
    if (framebuffer) {
        static const GLenum formats[2] = {GL_RGBA8, GL_DEPTH_COMPONENT24}, points[2] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT};
        glGenFramebuffers(1, &inside);
        glBindFramebuffer(GL_FRAMEBUFFER, inside);
        glGenRenderbuffers(2, stores);
        for (int i = 0; i < 2; i++) {
            glBindRenderbuffer(GL_RENDERBUFFER, stores[i]);
            glRenderbufferStorageMultisample(GL_RENDERBUFFER, framebuffer > 1 ? framebuffer : 0, formats[i], demo_width, demo_height);
            glFramebufferRenderbuffer(GL_FRAMEBUFFER, points[i], GL_RENDERBUFFER, stores[i]);
        }
        if (framebuffer == 1) {
            /* A format without sizes, as many programs have. */
            glGenTextures(1, &image);
            glBindTexture(GL_TEXTURE_2D, image);
            glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, demo_width, demo_height, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
            /* It stays bound, but is not enabled. */
            glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
            glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, image, 0);
        }
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
    }
    glClearColor(0.05f, 0.06f, 0.11f, 1.0f);
    glEnable(GL_DEPTH_TEST);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    if (smooth)
        glEnable(GL_POINT_SMOOTH);
    if (upper_left)
        ((void (*)(GLenum, GLenum))demo_proc("glClipControl"))(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    if (texture && !version) {
        static const GLubyte a[3] = {250, 220, 90}, b[3] = {90, 160, 250};
        demo_checker(32, 8, a, b);
    }
}

static void box(double x, double y, double z, double side)
{
    glPushMatrix();
    glTranslated(x, y, z);
    demo_box(side, side, side);
    glPopMatrix();
}

/* Half of the cloud, from its array or by its indices. */
static void half(int second)
{
    if (second)
        glDrawElements(GL_POINTS, count / 2, GL_UNSIGNED_INT, (void *)0);
    else
        glDrawArrays(GL_POINTS, 0, count / 2);
}

static void by_shaders(double t, const demo_matrix projection)
{
    demo_matrix m;
    if ((sprites || disks) && version < 330)
        glEnable(GL_POINT_SPRITE);
    if (clip && version < 330) {
        static const GLdouble plane[4] = {0.0, 1.0, 0.0, 0.4};
        glMatrixMode(GL_MODELVIEW);
        glPushMatrix();
        glLoadIdentity();
        glClipPlane(GL_CLIP_PLANE2, plane);
        glPopMatrix();
        glEnable(GL_CLIP_PLANE2);
    }
    glUseProgram(program);
    glEnableVertexAttribArray(0);
    glEnableVertexAttribArray(1);
    glEnableVertexAttribArray(2);
    glUniformMatrix4fv(glGetUniformLocation(program, "projection"), 1, 0, projection);
    glUniform1f(glGetUniformLocation(program, "size"), (GLfloat)size);
    glUniform1f(glGetUniformLocation(program, "attenuate"), (GLfloat)attenuate);
    glUniform1f(glGetUniformLocation(program, "around"), disks ? 0.5f : (GLfloat)sprites);
    glUniform1f(glGetUniformLocation(program, "disks"), disks ? projection[0] * (GLfloat)demo_width : 0.0f);
    for (int k = 0; k < 2; k++) {
        demo_turned(m, t + k, 0.0, 1.0, 0.8 - 1.6 * k, 0.2 * k, -8.0);
        glUniformMatrix4fv(glGetUniformLocation(program, "modelview"), 1, 0, m);
        half(k);
    }
    glDisableVertexAttribArray(0);
    glDisableVertexAttribArray(1);
    glDisableVertexAttribArray(2);
    glUseProgram(0);
    if (version < 330) {
        glDisable(GL_POINT_SPRITE);
        glDisable(GL_CLIP_PLANE2);
    }
}

static void by_fixed_function(double t)
{
    static const GLfloat fades[3] = {0.0f, 0.0f, 0.015f}, constant[3] = {1.0f, 0.0f, 0.0f};
    static const GLdouble plane[4] = {0.3, 1.0, 0.0, 0.4};
    glPointSize((GLfloat)size);
    glPointParameterfv(GL_POINT_DISTANCE_ATTENUATION, attenuate ? fades : constant);
    glVertexPointer(3, GL_FLOAT, 0, places);
    glNormalPointer(GL_FLOAT, 0, normals);
    glColorPointer(4, GL_UNSIGNED_BYTE, 0, colours);
    glTexCoordPointer(3, GL_FLOAT, 0, normals);
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_NORMAL_ARRAY);
    glEnableClientState(GL_COLOR_ARRAY);
    if (texture) {
        glEnableClientState(GL_TEXTURE_COORD_ARRAY);
        glEnable(GL_TEXTURE_2D);
    }
    if (lit) {
        glEnable(GL_LIGHTING);
        glEnable(GL_LIGHT0);
        glEnable(GL_COLOR_MATERIAL);
        glEnable(GL_FOG);
        glFogf(GL_FOG_DENSITY, 0.06f);
    }
    if (clip) {
        glClipPlane(GL_CLIP_PLANE2, plane);
        glEnable(GL_CLIP_PLANE2);
    }
    if (sprites)
        glEnable(GL_POINT_SPRITE);
    for (int k = 0; k < 2; k++) {
        glPushMatrix();
        glTranslated(0.8 - 1.6 * k, 0.2 * k, 0.0);
        glRotated(60.0 * t + 50.0 * k, 0.0, 1.0, 0.0);
        half(k);
        glPopMatrix();
    }
    glBegin(GL_POINTS);
    for (int i = 8; i < 200 && i < count; i++) {
        glColor4ubv(colours + 4 * i);
        glVertex3f(places[3 * i] * 1.5f, places[3 * i + 1] * 1.5f, places[3 * i + 2] * 1.5f);
    }
    glEnd();
    glDisable(GL_POINT_SPRITE);
    glDisable(GL_CLIP_PLANE2);
    glDisable(GL_LIGHTING);
    glDisable(GL_FOG);
    glDisable(GL_TEXTURE_2D);
    glDisableClientState(GL_VERTEX_ARRAY);
    glDisableClientState(GL_NORMAL_ARRAY);
    glDisableClientState(GL_COLOR_ARRAY);
    glDisableClientState(GL_TEXTURE_COORD_ARRAY);
}

static void scene(int frame)
{
    double t = demo_time(frame);
    demo_matrix projection;
    demo_viewport(0, 0, demo_width, demo_height);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    if (inset) {
        demo_viewport(21, 17, demo_width - 50, demo_height - 40);
        demo_scissor(90, 60, demo_width - 170, demo_height - 130);
    }
    demo_frustum(projection, 42.0, (double)demo_width / demo_height, 1.5, 40.0);
    demo_view(projection);
    if (version == 330) {
        by_shaders(t, projection);
        return;
    }
    demo_perspective(42.0, (double)demo_width / demo_height, 1.5, 40.0);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslated(0.0, 0.0, -8.0);
    glColor3f(0.7f, 0.4f, 0.2f);
    box(1.4, 0.6, 0.8, 0.5);
    if (blend)
        glEnable(GL_BLEND);
    if (version)
        by_shaders(t, projection);
    else
        by_fixed_function(t);
    glDisable(GL_BLEND);
    glColor3f(0.2f, 0.6f, 0.4f);
    box(-1.2, -0.5, 1.4, 0.6);
    glEnable(GL_BLEND);
    glColor4f(0.9f, 0.9f, 0.3f, 0.4f);
    box(0.0, 0.9, 1.9, 0.4);
    glDisable(GL_BLEND);
    glPointSize(7.0f);
    glBegin(GL_POINTS);
    for (int i = 0; i < 40; i++) {
        glColor3f(1.0f, 0.02f * (GLfloat)i, 0.3f);
        glVertex3f(0.08f * (GLfloat)(i - 20), -0.9f + 0.01f * (GLfloat)i, 2.2f);
    }
    glEnd();
}

void demo_frame(int frame)
{
    if (!framebuffer) {
        scene(frame);
        demo_scissor_off();
        return;
    }
    glBindFramebuffer(GL_FRAMEBUFFER, inside);
    scene(frame);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, inside);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBlitFramebuffer(0, 0, demo_width, demo_height, demo_x, demo_y, demo_x + demo_width, demo_y + demo_height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}
