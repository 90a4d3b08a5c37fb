/* ffcheck: draws a mesh twice, with fixed function and with a generated program, and compares the pixels.
 *
 *   ffcheck DIRECTORY COUNT
 *
 * reads DIRECTORY/0000.case, 0001.case, … (COUNT of them), each with 0000.vert and, where there are,
 * 0000.geom and 0000.frag, and prints one line per case:
 *
 *   0000 worst=1 over1=0 over8=0 differ=3 coverage=0 covered=8123 pixels=65536 squares=12
 *
 * A case is text, one `verb=arguments` per line: the verbs are in run_line(), arguments are numbers or GL_ names.
 * Fixed function draws every view by itself, with the projection matrix of that view and a viewport on its tile; the
 * program draws all views at once. This file shares nothing with the generator but that format. It needs EGL without
 * a window system (EGL_MESA_platform_surfaceless) and a compatibility context. Exit status: 0 if every case was drawn.
 */
#define GL_GLEXT_PROTOTYPES 1
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TILE = 96, MAX_VIEWS = 6, UNITS = 8, MAX_ARGS = 32, MAX_VERTICES = 8192, MAX_PARTS = 512 };
enum { MAX_SPACING = 16 };
enum { COLORS = 1, SECONDARY = 2, FOG = 4, NORMALS = 8, COORDS = 16 };

/* ---- names ---- */

static const struct { const char *name; double value; } names[] = {
#define N(x) { #x, x }
    N(GL_LIGHTING), N(GL_LIGHT0), N(GL_LIGHT1), N(GL_LIGHT2), N(GL_LIGHT3), N(GL_LIGHT4), N(GL_LIGHT5), N(GL_LIGHT6),
    N(GL_LIGHT7), N(GL_NORMALIZE), N(GL_RESCALE_NORMAL), N(GL_FOG), N(GL_COLOR_SUM), N(GL_COLOR_MATERIAL),
    N(GL_CLIP_PLANE0), N(GL_CLIP_PLANE1), N(GL_CLIP_PLANE2), N(GL_CLIP_PLANE3), N(GL_CLIP_PLANE4), N(GL_CLIP_PLANE5),
    N(GL_CULL_FACE), N(GL_POINT_SPRITE), N(GL_AMBIENT), N(GL_DIFFUSE), N(GL_SPECULAR), N(GL_EMISSION),
    N(GL_SHININESS), N(GL_AMBIENT_AND_DIFFUSE), N(GL_POSITION), N(GL_SPOT_DIRECTION), N(GL_SPOT_CUTOFF),
    N(GL_SPOT_EXPONENT), N(GL_CONSTANT_ATTENUATION), N(GL_LINEAR_ATTENUATION), N(GL_QUADRATIC_ATTENUATION),
    N(GL_LIGHT_MODEL_AMBIENT), N(GL_LIGHT_MODEL_LOCAL_VIEWER), N(GL_LIGHT_MODEL_TWO_SIDE),
    N(GL_LIGHT_MODEL_COLOR_CONTROL), N(GL_SEPARATE_SPECULAR_COLOR), N(GL_SINGLE_COLOR), N(GL_FRONT), N(GL_BACK),
    N(GL_FRONT_AND_BACK), N(GL_FOG_MODE), N(GL_FOG_START), N(GL_FOG_END), N(GL_FOG_DENSITY), N(GL_FOG_COLOR),
    N(GL_FOG_COORD_SRC), N(GL_FOG_COORD), N(GL_FRAGMENT_DEPTH), N(GL_FOG_DISTANCE_MODE_NV), N(GL_EYE_RADIAL_NV),
    N(GL_EYE_PLANE), N(GL_EYE_PLANE_ABSOLUTE_NV), N(GL_LINEAR), N(GL_EXP), N(GL_EXP2), N(GL_S), N(GL_T), N(GL_R),
    N(GL_Q), N(GL_OBJECT_LINEAR), N(GL_EYE_LINEAR), N(GL_SPHERE_MAP), N(GL_REFLECTION_MAP), N(GL_NORMAL_MAP),
    N(GL_OBJECT_PLANE), N(GL_TEXTURE_2D), N(GL_TEXTURE_3D), N(GL_TEXTURE_CUBE_MAP), N(GL_POINT_SIZE_MIN),
    N(GL_POINT_SIZE_MAX), N(GL_POINT_DISTANCE_ATTENUATION), N(GL_POINTS), N(GL_LINES), N(GL_LINE_STRIP),
    N(GL_LINE_LOOP), N(GL_TRIANGLES), N(GL_TRIANGLE_STRIP), N(GL_TRIANGLE_FAN), N(GL_QUADS), N(GL_QUAD_STRIP),
    N(GL_POLYGON), N(GL_LINES_ADJACENCY), N(GL_FLAT), N(GL_SMOOTH), N(GL_FIRST_VERTEX_CONVENTION),
    N(GL_LAST_VERTEX_CONVENTION), N(GL_TRUE), N(GL_FALSE), N(GL_FIXED_ONLY), N(GL_TEXTURE_1D), N(GL_TEXTURE_RECTANGLE),
    N(GL_ALPHA), N(GL_LUMINANCE), N(GL_LUMINANCE_ALPHA), N(GL_INTENSITY), N(GL_RED), N(GL_RG), N(GL_RGB), N(GL_RGBA),
    N(GL_NEAREST), N(GL_NEAREST_MIPMAP_NEAREST), N(GL_LINEAR_MIPMAP_NEAREST), N(GL_NEAREST_MIPMAP_LINEAR),
    N(GL_LINEAR_MIPMAP_LINEAR), N(GL_TEXTURE_ENV_MODE), N(GL_TEXTURE_ENV_COLOR), N(GL_REPLACE), N(GL_MODULATE),
    N(GL_DECAL), N(GL_BLEND), N(GL_ADD), N(GL_COMBINE), N(GL_COMBINE_RGB), N(GL_COMBINE_ALPHA), N(GL_ADD_SIGNED),
    N(GL_INTERPOLATE), N(GL_SUBTRACT), N(GL_DOT3_RGB), N(GL_DOT3_RGBA), N(GL_SRC0_RGB), N(GL_SRC1_RGB), N(GL_SRC2_RGB),
    N(GL_SRC0_ALPHA), N(GL_SRC1_ALPHA), N(GL_SRC2_ALPHA), N(GL_OPERAND0_RGB), N(GL_OPERAND1_RGB), N(GL_OPERAND2_RGB),
    N(GL_OPERAND0_ALPHA), N(GL_OPERAND1_ALPHA), N(GL_OPERAND2_ALPHA), N(GL_SRC_COLOR), N(GL_ONE_MINUS_SRC_COLOR),
    N(GL_SRC_ALPHA), N(GL_ONE_MINUS_SRC_ALPHA), N(GL_TEXTURE), N(GL_CONSTANT), N(GL_PRIMARY_COLOR), N(GL_PREVIOUS),
    N(GL_TEXTURE0), N(GL_TEXTURE1), N(GL_TEXTURE2), N(GL_TEXTURE3), N(GL_RGB_SCALE), N(GL_ALPHA_SCALE),
#undef N
};

static void die(const char *what, const char *detail)
{
    fprintf(stderr, "ffcheck: %s%s%s\n", what, *detail ? ": " : "", detail);
    exit(2);
}

static double number(const char *token)
{
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (!strcmp(names[i].name, token))
            return names[i].value;
    char *end;
    double value = strtod(token, &end);
    if (*end || end == token)
        die("neither a name nor a number", token);
    return value;
}

/* ---- one case ---- */

static struct {
    int views, columns, layers, instanced, immediate, homogeneous;
    int cut; /* quads by fixed function: 0 as quads, 13 and 2 as triangles cut from 1 to 3 or from 0 to 2 */
    GLenum mode, program_mode;
    unsigned arrays;
    double sep, conv;
    float projection[16];
    int viewport[4]; /* in the tile */
    int spacing, offset; /* the program draws every `spacing`th column of a window, from column `offset` on */
    double floor;        /* above 0: a floor that ends there, with its texture repeated as often */
    int color_sum, two_side, point_size, last_vertex_convention;
    unsigned clip_distances;
} c;

static void to_floats(const double *from, int count, float *to)
{
    for (int i = 0; i < count; i++)
        to[i] = (float)from[i];
}

/* Textures of the case, which are deleted after it. */
static GLuint images[UNITS];
static int image_count;

/* UNIT TARGET FORMAT SIZE MINFILTER LEVELS BIAS: makes and binds a smooth texture, each level in a tint of its own. With fewer levels than a
 * filter with mipmaps needs it is incomplete. */
static void make_image(const double *a)
{
    enum { S = 256 };
    static float texels[S * S][4];
    GLenum target = (GLenum)a[1];
    int size = (int)a[3], levels = target == GL_TEXTURE_RECTANGLE ? 1 : (int)a[5], deep = target == GL_TEXTURE_3D;
    glActiveTexture(GL_TEXTURE0 + (GLenum)a[0]);
    glEnable(target);
    glGenTextures(1, images + image_count);
    glBindTexture(target, images[image_count++]);
    glTexParameteri(target, GL_TEXTURE_MIN_FILTER, (GLint)a[4]);
    glTexParameterf(target, GL_TEXTURE_LOD_BIAS, (float)a[6]);
    for (int level = 0; level < levels && size >> level; level++) {
        int n = size >> level, high = target == GL_TEXTURE_1D ? 1 : n, slices = deep ? n : 1;
        for (int i = 0; i < n * high * slices; i++) {
            double k = 6.283185307179586 / n * (1 + (int)a[0] % 3), x = k * (i % n), y = k * (i / n % high), z = k * (i / n / n);
            texels[i][0] = (float)(0.5 + 0.4 * sin(x + z + level));
            texels[i][1] = (float)(0.5 + 0.4 * sin(y + 2 * level + 1));
            texels[i][2] = (float)(0.5 + 0.4 * sin(x + y + 3 * level));
            texels[i][3] = (float)(0.6 + 0.3 * sin(x - y - level));
        }
        if (target == GL_TEXTURE_1D)
            glTexImage1D(target, level, (GLint)a[2], n, 0, GL_RGBA, GL_FLOAT, texels);
        else if (deep)
            glTexImage3D(target, level, (GLint)a[2], n, n, n, 0, GL_RGBA, GL_FLOAT, texels);
        else
            for (GLenum face = 0; face < (target == GL_TEXTURE_CUBE_MAP ? 6 : 1); face++)
                glTexImage2D(target == GL_TEXTURE_CUBE_MAP ? GL_TEXTURE_CUBE_MAP_POSITIVE_X + face : target, level,
                             (GLint)a[2], n, n, 0, GL_RGBA, GL_FLOAT, texels);
    }
}

/* Runs one verb. GL state is set at once; the state of the draw is kept in `c`. */
static void run_line(const char *verb, const double *a, int n)
{
    float f[MAX_ARGS];
    to_floats(a, n, f);
#define IS(x) (!strcmp(verb, x))
    if (IS("views")) c.views = (int)a[0];
    else if (IS("columns")) c.columns = (int)a[0];
    else if (IS("layers")) c.layers = (int)a[0];
    else if (IS("instanced")) c.instanced = (int)a[0];
    else if (IS("immediate")) c.immediate = (int)a[0];
    else if (IS("homogeneous")) c.homogeneous = (int)a[0];
    else if (IS("draw")) c.mode = (GLenum)a[0];
    else if (IS("program_draw")) c.program_mode = (GLenum)a[0];
    else if (IS("arrays")) c.arrays = (unsigned)a[0];
    else if (IS("spacing")) c.spacing = (int)a[0], c.offset = (int)a[1];
    else if (IS("floor")) c.floor = a[0];
    else if (IS("image")) make_image(a);
    else if (IS("env")) { glActiveTexture(GL_TEXTURE0 + (GLenum)a[0]); glTexEnvfv(GL_TEXTURE_ENV, (GLenum)a[1], f + 2); }
    else if (IS("bias")) {
        glActiveTexture(GL_TEXTURE0 + (GLenum)a[0]);
        glTexEnvf(GL_TEXTURE_FILTER_CONTROL, GL_TEXTURE_LOD_BIAS, f[1]);
    } else if (IS("cut")) c.cut = (int)a[0];
    else if (IS("sep")) c.sep = a[0];
    else if (IS("conv")) c.conv = a[0];
    else if (IS("viewport")) for (int i = 0; i < 4; i++) c.viewport[i] = (int)a[i];
    else if (IS("patch_color_sum")) c.color_sum = (int)a[0];
    else if (IS("patch_two_side")) c.two_side = (int)a[0];
    else if (IS("patch_point_size")) c.point_size = (int)a[0];
    else if (IS("patch_last_vertex_convention")) c.last_vertex_convention = (int)a[0];
    else if (IS("patch_clip_distances")) c.clip_distances = (unsigned)a[0];
    else if (IS("projection")) memcpy(c.projection, f, sizeof c.projection);
    else if (IS("modelview")) { glMatrixMode(GL_MODELVIEW); glLoadMatrixf(f); }
    else if (IS("enable")) glEnable((GLenum)a[0]);
    else if (IS("shade")) glShadeModel((GLenum)a[0]);
    else if (IS("provoking")) glProvokingVertex((GLenum)a[0]);
    else if (IS("clamp_colors")) glClampColor(GL_CLAMP_VERTEX_COLOR, (GLenum)a[0]);
    else if (IS("light")) glLightfv(GL_LIGHT0 + (GLenum)a[0], (GLenum)a[1], f + 2);
    else if (IS("light_model")) glLightModelfv((GLenum)a[0], f + 1);
    else if (IS("material")) glMaterialfv((GLenum)a[0], (GLenum)a[1], f + 2);
    else if (IS("color_material")) glColorMaterial((GLenum)a[0], (GLenum)a[1]);
    else if (IS("fog")) glFogfv((GLenum)a[0], f + 1);
    else if (IS("point_size")) glPointSize(f[0]);
    else if (IS("point")) glPointParameterfv((GLenum)a[0], f + 1);
    else if (IS("clip_plane")) glClipPlane(GL_CLIP_PLANE0 + (GLenum)a[0], a + 1);
    else if (IS("texture")) { glActiveTexture(GL_TEXTURE0 + (GLenum)a[0]); glEnable((GLenum)a[1]); }
    else if (IS("coord_replace")) {
        glActiveTexture(GL_TEXTURE0 + (GLenum)a[0]);
        glTexEnvi(GL_POINT_SPRITE, GL_COORD_REPLACE, GL_TRUE);
    } else if (IS("texgen")) {
        glActiveTexture(GL_TEXTURE0 + (GLenum)a[0]);
        glTexGeni((GLenum)a[1], GL_TEXTURE_GEN_MODE, (GLint)a[2]);
        glEnable(GL_TEXTURE_GEN_S + (GLenum)a[1] - GL_S);
    } else if (IS("texgen_plane")) {
        glActiveTexture(GL_TEXTURE0 + (GLenum)a[0]);
        glTexGenfv((GLenum)a[1], (GLenum)a[2], f + 3);
    } else if (IS("texture_matrix")) {
        glActiveTexture(GL_TEXTURE0 + (GLenum)a[0]);
        glMatrixMode(GL_TEXTURE);
        glLoadMatrixf(f + 1);
    } else die("unknown verb", verb);
#undef IS
}

static char *read_file(const char *path, int optional)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        if (optional)
            return NULL;
        die("cannot open", path);
    }
    fseek(file, 0, SEEK_END);
    long size = ftell(file);
    rewind(file);
    char *text = malloc((size_t)size + 1);
    if (!text || fread(text, 1, (size_t)size, file) != (size_t)size)
        die("cannot read", path);
    text[size] = 0;
    fclose(file);
    return text;
}

static void run_case(char *text)
{
    char *line_end, *word_end;
    for (char *line = strtok_r(text, "\n", &line_end); line; line = strtok_r(NULL, "\n", &line_end)) {
        double args[MAX_ARGS];
        int count = 0;
        char *equals = strchr(line, '=');
        if (!equals)
            die("no '=' in", line);
        *equals = 0;
        for (char *word = strtok_r(equals + 1, " ", &word_end); word; word = strtok_r(NULL, " ", &word_end))
            if (count < MAX_ARGS)
                args[count++] = number(word);
        run_line(line, args, count);
    }
}

/* Restores the state of a new context, as far as the verbs change it and glPushAttrib does not save it. */
static void begin_case(void)
{
    memset(&c, 0, sizeof c);
    c.views = c.columns = 1;
    glPushAttrib(GL_ALL_ATTRIB_BITS);
}

static void end_case(void)
{
    /* Mesa 22.3.6 keeps the fragment stage of the colour sum when glPopAttrib alone switches it. */
    glDisable(GL_COLOR_SUM);
    glDisable(GL_LIGHTING);
    glDisable(GL_FOG);
    glPopAttrib();
    glDeleteTextures(image_count, images);
    image_count = 0;
    for (int unit = 0; unit < UNITS; unit++) {
        glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
        glMatrixMode(GL_TEXTURE);
        glLoadIdentity();
        glTexEnvi(GL_POINT_SPRITE, GL_COORD_REPLACE, GL_FALSE);
    }
    glActiveTexture(GL_TEXTURE0);
    glProvokingVertex(GL_LAST_VERTEX_CONVENTION);
    glClampColor(GL_CLAMP_VERTEX_COLOR, GL_TRUE);
    glFogi(GL_FOG_DISTANCE_MODE_NV, GL_EYE_PLANE_ABSOLUTE_NV);
    while (glGetError())
        ;
}

/* ---- the mesh: a bumpy torus ---- */

typedef struct {
    float position[4], normal[3], color[4], secondary[3], fog, coord[UNITS][4];
} Vertex;

enum { AROUND = 22, ACROSS = 13 };
static Vertex mesh[MAX_VERTICES];
static int mesh_size, part_first[MAX_PARTS], part_count[MAX_PARTS], parts;

static float noise(unsigned a, unsigned b)
{
    unsigned h = a * 0x9E3779B1u ^ (b + 0x7F4A7C15u) * 0x85EBCA77u;
    h ^= h >> 15;
    h *= 0x2C1B3C6Du;
    h ^= h >> 13;
    return (float)(h & 0xFFFFFF) / 16777216.0f;
}

static Vertex at(double u, double v, unsigned id)
{
    const double tau = 6.283185307179586;
    double a = u * tau, b = v * tau, r = 0.55 + 0.05 * sin(5 * a);
    Vertex x;
    x.position[0] = (float)((1.1 + r * cos(b)) * cos(a));
    x.position[1] = (float)((1.1 + r * cos(b)) * sin(a));
    x.position[2] = (float)(r * sin(b));
    x.position[3] = 1;
    x.normal[0] = (float)(cos(b) * cos(a));
    x.normal[1] = (float)(cos(b) * sin(a));
    x.normal[2] = (float)sin(b);
    for (int i = 0; i < 4; i++)
        x.color[i] = 0.1f + 1.0f * noise(id, (unsigned)i); /* up to 1.1, so that clamping shows */
    for (int i = 0; i < 3; i++)
        x.secondary[i] = 0.5f * noise(id, 10 + (unsigned)i);
    x.fog = 6 * noise(id, 20) - 1;
    for (int unit = 0; unit < UNITS; unit++) {
        x.coord[unit][0] = (float)(u * (1 + unit % 3)) + 0.1f * noise(id, 30 + (unsigned)unit);
        x.coord[unit][1] = (float)(v * (1 + unit % 2)) + 0.1f * noise(id, 40 + (unsigned)unit);
        x.coord[unit][2] = (float)(u + v) - 0.5f;
        x.coord[unit][3] = 0.9f + 0.2f * noise(id, 50 + (unsigned)unit);
    }
    if (c.homogeneous) {
        float w = 0.6f + 0.8f * noise(id, 60);
        for (int i = 0; i < 4; i++)
            x.position[i] *= w;
    }
    return x;
}

static void push(Vertex vertex)
{
    if (mesh_size == MAX_VERTICES)
        die("mesh too large", "");
    mesh[mesh_size++] = vertex;
}

static void push_grid(int i, int j)
{
    i %= AROUND;
    j %= ACROSS;
    push(at((double)i / AROUND, (double)j / ACROSS, (unsigned)(i * ACROSS + j)));
}

static void end_part(int first)
{
    if (parts == MAX_PARTS)
        die("too many parts", "");
    part_first[parts] = first;
    part_count[parts++] = mesh_size - first;
}

/* A flat hexagon that touches the torus. */
static void push_hexagon(int i, int j)
{
    Vertex center = at((i + 0.5) / AROUND, (j + 0.5) / ACROSS, (unsigned)(i * 64 + j));
    const float *n = center.normal;
    float t[3] = { -n[1], n[0] + 1e-3f, 0 }, length = sqrtf(t[0] * t[0] + t[1] * t[1]);
    float s[3], w = center.position[3];
    for (int k = 0; k < 3; k++)
        t[k] /= length;
    s[0] = n[1] * t[2] - n[2] * t[1];
    s[1] = n[2] * t[0] - n[0] * t[2];
    s[2] = n[0] * t[1] - n[1] * t[0];
    for (int corner = 0; corner < 6; corner++) {
        Vertex v = at((i + 0.1 * corner) / AROUND, (double)j / ACROSS, (unsigned)(i * 777 + j * 7 + corner));
        double angle = corner * 1.0471975512;
        for (int k = 0; k < 3; k++)
            v.position[k] = center.position[k] + w * 0.3f * (float)(cos(angle) * t[k] + sin(angle) * s[k]);
        v.position[3] = w;
        push(v);
    }
}

static void push_quads(const int *corners, int count)
{
    static const int offset[4][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
    for (int i = 0; i < AROUND; i++)
        for (int j = 0; j < ACROSS; j++)
            for (int k = 0; k < count; k++)
                push_grid(i + offset[corners[k]][0], j + offset[corners[k]][1]);
    end_part(0);
}

/* Two large triangles below the eye, from near to far. */
static void push_floor(void)
{
    static const int corner[6][2] = { { -1, 0 }, { 1, 0 }, { 1, 1 }, { -1, 0 }, { 1, 1 }, { -1, 1 } };
    for (int i = 0; i < 6; i++) {
        Vertex v = at(0, 0, 1);
        v.position[0] = (float)(corner[i][0] * c.floor);
        v.position[1] = -1;
        v.position[2] = (float)(-1.01 - corner[i][1] * c.floor);
        v.position[3] = 1;
        for (int unit = 0; unit < UNITS; unit++) {
            v.coord[unit][0] = v.position[0] * 0.7f + v.position[2] * 0.2f;
            v.coord[unit][1] = v.position[2] * 0.7f;
            v.coord[unit][2] = v.position[0] * 0.3f;
            v.coord[unit][3] = 1;
        }
        push(v);
    }
    end_part(0);
}

/* Builds vertices and parts (one glBegin each) for a mode. `reindexed`: quad strips as lists of four. `cut`: as in the case. */
static void build(GLenum mode, int reindexed, int cut)
{
    static const int whole[] = { 0, 1, 2, 3 }, cut13[] = { 0, 1, 3, 1, 2, 3 }, cut02[] = { 0, 1, 2, 0, 2, 3 };
    mesh_size = parts = 0;
    int first = 0;
    if (c.floor > 0) {
        push_floor();
        return;
    }
    switch (mode) {
    case GL_POINTS: case GL_LINES:
        for (int i = 0; i < AROUND; i++)
            for (int j = 0; j < ACROSS; j++) {
                push_grid(i, j);
                if (mode == GL_LINES)
                    push_grid(i + 1, j + 1);
            }
        end_part(0);
        break;
    case GL_LINE_STRIP: case GL_LINE_LOOP:
        for (int i = 0; i < AROUND; i++, first = mesh_size) {
            for (int j = 0; j < ACROSS; j++)
                push_grid(i + j / 4, j);
            end_part(first);
        }
        break;
    case GL_TRIANGLES:
        push_quads(cut02, 6);
        break;
    case GL_QUADS:
        push_quads(cut == 13 ? cut13 : cut == 2 ? cut02 : whole, cut ? 6 : 4);
        break;
    case GL_TRIANGLE_STRIP: case GL_QUAD_STRIP:
        if (reindexed) {
            push_quads(whole, 4);
            break;
        }
        for (int i = 0; i < AROUND; i++, first = mesh_size) {
            for (int j = 0; j <= ACROSS; j++)
                push_grid(i, j), push_grid(i + 1, j);
            end_part(first);
        }
        break;
    case GL_TRIANGLE_FAN: case GL_POLYGON:
        for (int i = 0; i < AROUND; i++)
            for (int j = 0; j < ACROSS; j++, first = mesh_size) {
                push_hexagon(i, j);
                end_part(first);
            }
        break;
    default: die("no mesh for this mode", "");
    }
}

static void set_constants(void)
{
    glColor4f(0.8f, 0.6f, 0.4f, 0.9f);
    glSecondaryColor3f(0.1f, 0.3f, 0.2f);
    glFogCoordf(2.5f);
    glNormal3f(0.36f, 0.48f, 0.8f);
    for (int unit = 0; unit < UNITS; unit++)
        glMultiTexCoord4f(GL_TEXTURE0 + (GLenum)unit, 0.3f, 0.6f, 0.2f, 1.0f);
}

static void set_array(GLenum array, int on)
{
    (on ? glEnableClientState : glDisableClientState)(array);
}

static void draw(GLenum mode, int instances)
{
    set_constants();
    if (c.immediate) {
        for (int part = 0; part < parts; part++) {
            glBegin(mode);
            for (int i = part_first[part]; i < part_first[part] + part_count[part]; i++) {
                const Vertex *v = mesh + i;
                if (c.arrays & COLORS) glColor4fv(v->color);
                if (c.arrays & SECONDARY) glSecondaryColor3fv(v->secondary);
                if (c.arrays & FOG) glFogCoordf(v->fog);
                if (c.arrays & NORMALS) glNormal3fv(v->normal);
                for (int unit = 0; unit < UNITS && c.arrays & COORDS; unit++)
                    glMultiTexCoord4fv(GL_TEXTURE0 + (GLenum)unit, v->coord[unit]);
                glVertex4fv(v->position);
            }
            glEnd();
        }
        return;
    }
    GLsizei stride = sizeof(Vertex);
    set_array(GL_VERTEX_ARRAY, 1);
    glVertexPointer(4, GL_FLOAT, stride, mesh->position);
    set_array(GL_COLOR_ARRAY, c.arrays & COLORS);
    glColorPointer(4, GL_FLOAT, stride, mesh->color);
    set_array(GL_SECONDARY_COLOR_ARRAY, c.arrays & SECONDARY);
    glSecondaryColorPointer(3, GL_FLOAT, stride, mesh->secondary);
    set_array(GL_FOG_COORD_ARRAY, c.arrays & FOG);
    glFogCoordPointer(GL_FLOAT, stride, &mesh->fog);
    set_array(GL_NORMAL_ARRAY, c.arrays & NORMALS);
    glNormalPointer(GL_FLOAT, stride, mesh->normal);
    for (int unit = 0; unit < UNITS; unit++) {
        glClientActiveTexture(GL_TEXTURE0 + (GLenum)unit);
        set_array(GL_TEXTURE_COORD_ARRAY, c.arrays & COORDS);
        glTexCoordPointer(4, GL_FLOAT, stride, mesh->coord[unit]);
    }
    for (int part = 0; part < parts; part++)
        if (instances)
            glDrawArraysInstanced(mode, part_first[part], part_count[part], instances);
        else
            glDrawArrays(mode, part_first[part], part_count[part]);
}

/* ---- targets ---- */

static GLuint tiles_fbo, layers_fbo, layer_fbo, tiles_color, tiles_depth, layers_color, layers_depth;

static void make_targets(void)
{
    glGenFramebuffers(1, &tiles_fbo);
    glGenFramebuffers(1, &layers_fbo);
    glGenFramebuffers(1, &layer_fbo);
    glGenTextures(1, &tiles_color);
    glGenTextures(1, &tiles_depth);
    glGenTextures(1, &layers_color);
    glGenTextures(1, &layers_depth);
    glBindTexture(GL_TEXTURE_2D_ARRAY, layers_color);
    glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA8, TILE, TILE, MAX_VIEWS, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    glBindTexture(GL_TEXTURE_2D_ARRAY, layers_depth);
    glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_DEPTH_COMPONENT24, TILE, TILE, MAX_VIEWS, 0, GL_DEPTH_COMPONENT,
                 GL_FLOAT, NULL);
    glBindTexture(GL_TEXTURE_2D_ARRAY, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, layers_fbo);
    glFramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, layers_color, 0);
    glFramebufferTexture(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, layers_depth, 0);
}

static void size_tiles(int width, int height)
{
    glBindTexture(GL_TEXTURE_2D, tiles_color);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    glBindTexture(GL_TEXTURE_2D, tiles_depth);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, width, height, 0, GL_DEPTH_COMPONENT, GL_FLOAT, NULL);
    glBindTexture(GL_TEXTURE_2D, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, tiles_fbo);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, tiles_color, 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, tiles_depth, 0);
}

static void attach_layer(int layer)
{
    glBindFramebuffer(GL_FRAMEBUFFER, layer_fbo);
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, layers_color, 0, layer);
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, layers_depth, 0, layer);
}

typedef struct {
    unsigned char color[MAX_VIEWS][TILE][TILE][4];
    float depth[MAX_VIEWS][TILE][TILE];
} Picture;
static Picture fixed_picture, program_picture;
static unsigned char window[TILE * TILE * MAX_SPACING][4];
static float window_depth[TILE * TILE * MAX_SPACING];

static int tile_x(int view) { return c.layers ? 0 : view % c.columns * TILE; }
static int tile_y(int view) { return c.layers ? 0 : view / c.columns * TILE; }

static void read_views(Picture *picture)
{
    for (int view = 0; view < c.views; view++) {
        if (c.layers)
            attach_layer(view);
        else
            glBindFramebuffer(GL_FRAMEBUFFER, tiles_fbo);
        glReadPixels(tile_x(view), tile_y(view), TILE, TILE, GL_RGBA, GL_UNSIGNED_BYTE, picture->color[view]);
        glReadPixels(tile_x(view), tile_y(view), TILE, TILE, GL_DEPTH_COMPONENT, GL_FLOAT, picture->depth[view]);
    }
}

static double view_sep(int view) { return c.sep * (view - 0.5 * (c.views - 1)); }

/* row 0 += sep * row 3 - sep * conv * (0, 0, 0, 1), matrices by columns */
static void load_projection(double sep)
{
    float m[16];
    for (int column = 0; column < 4; column++) {
        memcpy(m + 4 * column, c.projection + 4 * column, 4 * sizeof *m);
        m[4 * column] = (float)(c.projection[4 * column] + sep * c.projection[4 * column + 3]);
    }
    m[12] = (float)(c.projection[12] + sep * c.projection[15] - sep * c.conv);
    glMatrixMode(GL_PROJECTION);
    glLoadMatrixf(m);
}

static void clear(void)
{
    glDisable(GL_SCISSOR_TEST);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

/* Draws a window, every `spacing`th column of which is copied to the picture. */
static void draw_window(void)
{
    glBindFramebuffer(GL_FRAMEBUFFER, tiles_fbo);
    clear();
    load_projection(0);
    glViewport(0, 0, TILE * c.spacing, TILE);
    draw(c.mode, 0);
    glReadPixels(0, 0, TILE * c.spacing, TILE, GL_RGBA, GL_UNSIGNED_BYTE, window);
    glReadPixels(0, 0, TILE * c.spacing, TILE, GL_DEPTH_COMPONENT, GL_FLOAT, window_depth);
    for (int y = 0; y < TILE; y++)
        for (int x = 0; x < TILE; x++) {
            int from = y * TILE * c.spacing + c.spacing * x + c.offset;
            memcpy(fixed_picture.color[0][y][x], window[from], 4);
            fixed_picture.depth[0][y][x] = window_depth[from];
        }
}

static void draw_fixed(void)
{
    build(c.mode, 0, c.cut);
    if (c.spacing) {
        draw_window();
        return;
    }
    if (!c.layers)
        glBindFramebuffer(GL_FRAMEBUFFER, tiles_fbo), clear();
    for (int view = 0; view < c.views; view++) {
        if (c.layers)
            attach_layer(view), clear();
        load_projection(view_sep(view));
        glViewport(tile_x(view) + c.viewport[0], tile_y(view) + c.viewport[1], c.viewport[2], c.viewport[3]);
        glScissor(tile_x(view), tile_y(view), TILE, TILE);
        glEnable(GL_SCISSOR_TEST);
        draw(c.cut ? GL_TRIANGLES : c.mode, 0);
    }
    glDisable(GL_SCISSOR_TEST);
    read_views(&fixed_picture);
}

static GLuint compile(GLenum stage, const char *text, const char *name)
{
    GLuint shader = glCreateShader(stage);
    GLint good;
    char log[4000];
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    glGetShaderInfoLog(shader, sizeof log, NULL, log);
    if (!good) {
        fprintf(stderr, "%s\n%s\n", text, log);
        die("does not compile", name);
    }
    return shader;
}

static GLuint make_program(const char *vertex, const char *geometry, const char *fragment, const char *name)
{
    GLuint program = glCreateProgram();
    GLint good;
    char log[4000];
    GLuint vertex_shader = compile(GL_VERTEX_SHADER, vertex, name);
    glAttachShader(program, vertex_shader);
    glDeleteShader(vertex_shader);
    if (geometry) {
        GLuint geometry_shader = compile(GL_GEOMETRY_SHADER, geometry, name);
        glAttachShader(program, geometry_shader);
        glDeleteShader(geometry_shader);
    }
    if (fragment) {
        GLuint fragment_shader = compile(GL_FRAGMENT_SHADER, fragment, name);
        glAttachShader(program, fragment_shader);
        glDeleteShader(fragment_shader);
    }
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    glGetProgramInfoLog(program, sizeof log, NULL, log);
    if (!good) {
        fprintf(stderr, "%s\n%s\n%s\n", vertex, geometry ? geometry : "", log);
        die("does not link", name);
    }
    return program;
}

static void set(GLenum capability, int on)
{
    (on ? glEnable : glDisable)(capability);
}

static float edge(double pixel, int origin, int size)
{
    double ndc = 2 * (pixel - origin) / size - 1;
    return (float)(ndc < -1 ? -1 : ndc > 1 ? 1 : ndc);
}

static void draw_program(GLuint program)
{
    int rows = (c.views + c.columns - 1) / c.columns;
    int width = c.layers ? TILE : c.columns * TILE * (c.spacing ? c.spacing : 1), height = c.layers ? TILE : rows * TILE;
    const int *p = c.viewport;
    float first_rows[MAX_VIEWS][4], places[MAX_VIEWS][4];
    build(c.mode, c.mode == GL_QUAD_STRIP && c.program_mode == GL_LINES_ADJACENCY, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, c.layers ? layers_fbo : tiles_fbo);
    clear();
    for (int view = 0; view < c.views; view++) {
        float q[16], m[16];
        load_projection(view_sep(view));
        glGetFloatv(GL_PROJECTION_MATRIX, q);
        glGetFloatv(GL_MODELVIEW_MATRIX, m);
        for (int k = 0; k < 4; k++)
            first_rows[view][k] = q[0] * m[4 * k] + q[4] * m[4 * k + 1] + q[8] * m[4 * k + 2] + q[12] * m[4 * k + 3];
        /* The centre of column i is that of the window's column spacing * i + offset. */
        double shift = c.spacing ? 0.5 - (c.offset + 0.5) / c.spacing : 0;
        places[view][0] = (float)((2.0 * (tile_x(view) + p[0] + shift) + p[2]) / width - 1);
        places[view][1] = (float)((2.0 * (tile_y(view) + p[1]) + p[3]) / height - 1);
        places[view][2] = (float)(c.layers ? view : tile_x(view));
        places[view][3] = (float)(tile_x(view) + TILE);
    }
    load_projection(0);
    glUseProgram(program);
    glUniform4fv(glGetUniformLocation(program, "mv_view"), c.views, &first_rows[0][0]);
    glUniform4fv(glGetUniformLocation(program, "mv_tile"), c.views, &places[0][0]);
    glUniform4f(glGetUniformLocation(program, "mv_map"), (float)p[2] / (float)width, (float)p[3] / (float)height, 0, 0);
    glUniform4f(glGetUniformLocation(program, "mv_clip"), edge(0, p[0], p[2]), edge(TILE, p[0], p[2]),
                edge(0, p[1], p[3]), edge(TILE, p[1], p[3]));
    glUniform1i(glGetUniformLocation(program, "mv_first"), 0);
    glUniform4f(glGetUniformLocation(program, "mv_grid"), c.spacing ? 1.0f / (float)c.spacing : 1, 0, 0, 1);
    for (int unit = 0; unit < UNITS; unit++) {
        char sampler[] = "mv_texture0";
        sampler[sizeof sampler - 2] = (char)('0' + unit);
        glUniform1i(glGetUniformLocation(program, sampler), unit);
    }
    set(GL_COLOR_SUM, c.color_sum);
    set(GL_VERTEX_PROGRAM_TWO_SIDE, c.two_side);
    set(GL_PROGRAM_POINT_SIZE, c.point_size);
    if (c.last_vertex_convention)
        glProvokingVertex(GL_LAST_VERTEX_CONVENTION);
    for (unsigned i = 0; i < 8; i++)
        set(GL_CLIP_DISTANCE0 + i, c.clip_distances >> i & 1);
    if (c.layers) {
        glViewport(p[0], p[1], p[2], p[3]);
        glScissor(0, 0, TILE, TILE);
        glEnable(GL_SCISSOR_TEST);
    } else
        glViewport(0, 0, width, height);
    draw(c.program_mode, c.instanced ? c.views : 0);
    glUseProgram(0);
    read_views(&program_picture);
}

/* ---- textures: smooth, so that rounding of coordinates does not show ---- */

static void make_textures(void)
{
    enum { S = 32 };
    static unsigned char texels[S][S][S][3];
    GLuint ids[3];
    static const GLenum faces[] = { GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP };
    for (int z = 0; z < S; z++)
        for (int y = 0; y < S; y++)
            for (int x = 0; x < S; x++) {
                double k = 6.283185307179586 / S;
                texels[z][y][x][0] = (unsigned char)(128 + 110 * sin(k * x));
                texels[z][y][x][1] = (unsigned char)(128 + 110 * sin(k * y + 1));
                texels[z][y][x][2] = (unsigned char)(128 + 110 * sin(k * z + k * x));
            }
    glGenTextures(3, ids);
    for (int unit = 0; unit < UNITS; unit++) {
        glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
        for (int i = 0; i < 3; i++) {
            glBindTexture(faces[i], ids[i]);
            glTexParameteri(faces[i], GL_TEXTURE_MIN_FILTER, GL_LINEAR);
            if (unit)
                continue;
            if (i == 0)
                glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, S, S, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
            else if (i == 1)
                glTexImage3D(GL_TEXTURE_3D, 0, GL_RGB8, S, S, S, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
            else
                for (int face = 0; face < 6; face++)
                    glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + (GLenum)face, 0, GL_RGB8, S, S, 0, GL_RGB,
                                 GL_UNSIGNED_BYTE, texels[4 * face]);
        }
        /* The first unit multiplies and the others mix, so that every unit stays visible. */
        static const float part[4] = { 0.35f, 0.35f, 0.35f, 0.35f };
        if (unit) {
            glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_COMBINE);
            glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, GL_INTERPOLATE);
            glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE2_RGB, GL_CONSTANT);
            glTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, part);
        }
    }
    glActiveTexture(GL_TEXTURE0);
}

/* ---- comparison ---- */

static void compare(const char *name)
{
    long squares = 0;
    int worst = 0, over1 = 0, over8 = 0, differ = 0, coverage = 0, covered = 0;
    for (int view = 0; view < c.views; view++)
        for (int y = 0; y < TILE; y++)
            for (int x = 0; x < TILE; x++) {
                int most = 0;
                for (int i = 0; i < 4; i++) {
                    int difference = abs(fixed_picture.color[view][y][x][i] - program_picture.color[view][y][x][i]);
                    most = difference > most ? difference : most;
                    squares += i < 3 ? difference * difference : 0;
                }
                int a = fixed_picture.depth[view][y][x] < 1, b = program_picture.depth[view][y][x] < 1;
                worst = most > worst ? most : worst;
                over1 += most > 1;
                over8 += most > 8;
                differ += most > 0;
                coverage += a != b;
                covered += a;
            }
    printf("%s worst=%d over1=%d over8=%d differ=%d coverage=%d covered=%d pixels=%d squares=%ld\n", name, worst, over1, over8,
           differ, coverage, covered, c.views * TILE * TILE, squares);
}

static void save(const char *directory, const char *name, const char *which, const Picture *picture)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s.%s.ppm", directory, name, which);
    FILE *file = fopen(path, "wb");
    if (!file)
        return;
    fprintf(file, "P6 %d %d 255\n", TILE, TILE * c.views);
    for (int i = 0; i < c.views * TILE * TILE; i++)
        fwrite((const unsigned char *)picture->color + 4 * i, 1, 3, file);
    fclose(file);
}

static void make_context(void)
{
    PFNEGLGETPLATFORMDISPLAYEXTPROC get_display =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    EGLDisplay display = get_display ? get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL) : NULL;
    static const EGLint attributes[] = { EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                         EGL_NONE };
    EGLConfig config;
    EGLint count = 0;
    if (!display || !eglInitialize(display, NULL, NULL))
        die("no EGL display without a window system", "");
    if (!eglBindAPI(EGL_OPENGL_API) || !eglChooseConfig(display, attributes, &config, 1, &count) || !count)
        die("no EGL configuration for OpenGL", "");
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, NULL);
    if (!context || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
        die("no OpenGL context", "");
}

int main(int argc, char **argv)
{
    if (argc != 3)
        die("usage", "ffcheck DIRECTORY COUNT");
    make_context();
    GLint convention, follow;
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &convention);
    if (!(convention & GL_CONTEXT_COMPATIBILITY_PROFILE_BIT))
        die("not a compatibility context", "");
    glGetIntegerv(GL_QUADS_FOLLOW_PROVOKING_VERTEX_CONVENTION, &follow);
    fprintf(stderr, "ffcheck: %s, %s, quads follow the provoking vertex: %d\n", glGetString(GL_RENDERER),
            glGetString(GL_VERSION), follow);
    make_targets();
    make_textures();
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glEnable(GL_DEPTH_TEST);
    glClearColor(0.2f, 0.3f, 0.4f, 0.5f);
    glLineWidth(1);
    for (int i = 0; i < atoi(argv[2]); i++) {
        char name[16], path[4096];
        snprintf(name, sizeof name, "%04d", i);
        begin_case();
        snprintf(path, sizeof path, "%s/%s.case", argv[1], name);
        char *text = read_file(path, 0);
        run_case(text);
        glActiveTexture(GL_TEXTURE0);
        snprintf(path, sizeof path, "%s/%s.vert", argv[1], name);
        char *vertex = read_file(path, 0);
        snprintf(path, sizeof path, "%s/%s.geom", argv[1], name);
        char *geometry = read_file(path, 1);
        snprintf(path, sizeof path, "%s/%s.frag", argv[1], name);
        char *fragment = read_file(path, 1);
        if (!c.layers) {
            /* Bindings of texture 2D belong to the case's units: keep unit 0's. */
            GLint bound;
            glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
            size_tiles(c.columns * TILE * (c.spacing ? c.spacing : 1), (c.views + c.columns - 1) / c.columns * TILE);
            glBindTexture(GL_TEXTURE_2D, (GLuint)bound);
        }
        draw_fixed();
        GLenum error = glGetError();
        if (error)
            printf("%s fixed function raised 0x%x\n", name, error);
        GLuint program = make_program(vertex, geometry, fragment, name);
        draw_program(program);
        error = glGetError();
        if (error)
            printf("%s program raised 0x%x\n", name, error);
        compare(name);
        if (getenv("FFCHECK_SAVE")) {
            save(argv[1], name, "fixed", &fixed_picture);
            save(argv[1], name, "program", &program_picture);
        }
        glDeleteProgram(program);
        free(text);
        free(vertex);
        free(geometry);
        free(fragment);
        end_case();
    }
    return 0;
}
