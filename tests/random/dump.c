/* All queries of a context, as lines; then its pixels. */
#include "random.h"
#include <string.h>

#define N(x) {#x, x}
static const struct { const char *name; GLenum value; } gets[] = {
    N(GL_CURRENT_COLOR), N(GL_CURRENT_INDEX), N(GL_CURRENT_NORMAL), N(GL_CURRENT_RASTER_POSITION), N(GL_CURRENT_RASTER_DISTANCE),
    N(GL_CURRENT_RASTER_COLOR), N(GL_CURRENT_RASTER_SECONDARY_COLOR), N(GL_CURRENT_RASTER_INDEX), N(GL_CURRENT_RASTER_POSITION_VALID),
    N(GL_CURRENT_SECONDARY_COLOR), N(GL_CURRENT_FOG_COORD), N(GL_EDGE_FLAG), N(GL_CLIENT_ACTIVE_TEXTURE), N(GL_VERTEX_ARRAY),
    N(GL_VERTEX_ARRAY_SIZE), N(GL_VERTEX_ARRAY_TYPE), N(GL_VERTEX_ARRAY_STRIDE), N(GL_NORMAL_ARRAY), N(GL_NORMAL_ARRAY_TYPE),
    N(GL_NORMAL_ARRAY_STRIDE), N(GL_FOG_COORD_ARRAY), N(GL_FOG_COORD_ARRAY_TYPE), N(GL_COLOR_ARRAY), N(GL_COLOR_ARRAY_SIZE),
    N(GL_COLOR_ARRAY_TYPE), N(GL_SECONDARY_COLOR_ARRAY), N(GL_SECONDARY_COLOR_ARRAY_SIZE), N(GL_INDEX_ARRAY), N(GL_EDGE_FLAG_ARRAY),
    N(GL_ARRAY_BUFFER_BINDING), N(GL_VERTEX_ARRAY_BUFFER_BINDING), N(GL_NORMAL_ARRAY_BUFFER_BINDING), N(GL_COLOR_ARRAY_BUFFER_BINDING),
    N(GL_ELEMENT_ARRAY_BUFFER_BINDING), N(GL_TEXTURE_COORD_ARRAY_BUFFER_BINDING), N(GL_PIXEL_PACK_BUFFER_BINDING),
    N(GL_PIXEL_UNPACK_BUFFER_BINDING), N(GL_UNIFORM_BUFFER_BINDING), N(GL_VERTEX_ARRAY_BINDING), N(GL_COLOR_MATRIX), N(GL_MODELVIEW_MATRIX),
    N(GL_PROJECTION_MATRIX), N(GL_VIEWPORT), N(GL_DEPTH_RANGE), N(GL_COLOR_MATRIX_STACK_DEPTH), N(GL_MODELVIEW_STACK_DEPTH),
    N(GL_PROJECTION_STACK_DEPTH), N(GL_MATRIX_MODE), N(GL_NORMALIZE), N(GL_RESCALE_NORMAL), N(GL_CLIP_PLANE0), N(GL_CLIP_PLANE1),
    N(GL_CLIP_PLANE2), N(GL_CLIP_PLANE5), N(GL_FOG_COLOR), N(GL_FOG_INDEX), N(GL_FOG_DENSITY), N(GL_FOG_START), N(GL_FOG_END),
    N(GL_FOG_MODE), N(GL_FOG), N(GL_FOG_COORD_SRC), N(GL_COLOR_SUM), N(GL_SHADE_MODEL), N(GL_LIGHTING), N(GL_COLOR_MATERIAL),
    N(GL_COLOR_MATERIAL_PARAMETER), N(GL_COLOR_MATERIAL_FACE), N(GL_LIGHT_MODEL_AMBIENT), N(GL_LIGHT_MODEL_LOCAL_VIEWER),
    N(GL_LIGHT_MODEL_TWO_SIDE), N(GL_LIGHT_MODEL_COLOR_CONTROL), N(GL_LIGHT0), N(GL_LIGHT1), N(GL_LIGHT7), N(GL_POINT_SIZE),
    N(GL_POINT_SMOOTH), N(GL_POINT_SPRITE), N(GL_POINT_SIZE_MIN), N(GL_POINT_SIZE_MAX), N(GL_POINT_FADE_THRESHOLD_SIZE),
    N(GL_POINT_DISTANCE_ATTENUATION), N(GL_POINT_SPRITE_COORD_ORIGIN), N(GL_LINE_WIDTH), N(GL_LINE_SMOOTH), N(GL_LINE_STIPPLE_PATTERN),
    N(GL_LINE_STIPPLE_REPEAT), N(GL_LINE_STIPPLE), N(GL_CULL_FACE), N(GL_CULL_FACE_MODE), N(GL_FRONT_FACE), N(GL_POLYGON_SMOOTH),
    N(GL_POLYGON_MODE), N(GL_POLYGON_OFFSET_FACTOR), N(GL_POLYGON_OFFSET_UNITS), N(GL_POLYGON_OFFSET_POINT), N(GL_POLYGON_OFFSET_LINE),
    N(GL_POLYGON_OFFSET_FILL), N(GL_POLYGON_STIPPLE), N(GL_MULTISAMPLE), N(GL_SAMPLE_ALPHA_TO_COVERAGE), N(GL_SAMPLE_ALPHA_TO_ONE),
    N(GL_SAMPLE_COVERAGE), N(GL_SAMPLE_COVERAGE_VALUE), N(GL_SAMPLE_COVERAGE_INVERT), N(GL_SCISSOR_TEST), N(GL_SCISSOR_BOX),
    N(GL_ALPHA_TEST), N(GL_ALPHA_TEST_FUNC), N(GL_ALPHA_TEST_REF), N(GL_STENCIL_TEST), N(GL_STENCIL_FUNC), N(GL_STENCIL_VALUE_MASK),
    N(GL_STENCIL_REF), N(GL_STENCIL_FAIL), N(GL_STENCIL_PASS_DEPTH_FAIL), N(GL_STENCIL_PASS_DEPTH_PASS), N(GL_STENCIL_BACK_FUNC),
    N(GL_STENCIL_BACK_VALUE_MASK), N(GL_STENCIL_BACK_REF), N(GL_STENCIL_BACK_FAIL), N(GL_DEPTH_TEST), N(GL_DEPTH_FUNC), N(GL_BLEND),
    N(GL_BLEND_SRC_RGB), N(GL_BLEND_SRC_ALPHA), N(GL_BLEND_DST_RGB), N(GL_BLEND_DST_ALPHA), N(GL_BLEND_EQUATION_RGB),
    N(GL_BLEND_EQUATION_ALPHA), N(GL_BLEND_COLOR), N(GL_DITHER), N(GL_INDEX_LOGIC_OP), N(GL_COLOR_LOGIC_OP), N(GL_LOGIC_OP_MODE),
    N(GL_FRAMEBUFFER_SRGB), N(GL_DRAW_BUFFER), N(GL_DRAW_BUFFER0), N(GL_DRAW_BUFFER1), N(GL_INDEX_WRITEMASK), N(GL_COLOR_WRITEMASK),
    N(GL_DEPTH_WRITEMASK), N(GL_STENCIL_WRITEMASK), N(GL_STENCIL_BACK_WRITEMASK), N(GL_COLOR_CLEAR_VALUE), N(GL_INDEX_CLEAR_VALUE),
    N(GL_DEPTH_CLEAR_VALUE), N(GL_STENCIL_CLEAR_VALUE), N(GL_ACCUM_CLEAR_VALUE), N(GL_UNPACK_SWAP_BYTES), N(GL_UNPACK_LSB_FIRST),
    N(GL_UNPACK_IMAGE_HEIGHT), N(GL_UNPACK_SKIP_IMAGES), N(GL_UNPACK_ROW_LENGTH), N(GL_UNPACK_SKIP_ROWS), N(GL_UNPACK_SKIP_PIXELS),
    N(GL_UNPACK_ALIGNMENT), N(GL_PACK_SWAP_BYTES), N(GL_PACK_LSB_FIRST), N(GL_PACK_ROW_LENGTH), N(GL_PACK_SKIP_ROWS),
    N(GL_PACK_SKIP_PIXELS), N(GL_PACK_ALIGNMENT), N(GL_MAP_COLOR), N(GL_MAP_STENCIL), N(GL_INDEX_SHIFT), N(GL_INDEX_OFFSET),
    N(GL_RED_SCALE), N(GL_GREEN_SCALE), N(GL_ALPHA_SCALE), N(GL_DEPTH_SCALE), N(GL_RED_BIAS), N(GL_GREEN_BIAS), N(GL_DEPTH_BIAS),
    N(GL_ZOOM_X), N(GL_ZOOM_Y), N(GL_PIXEL_MAP_R_TO_R_SIZE), N(GL_PIXEL_MAP_S_TO_S_SIZE), N(GL_READ_BUFFER), N(GL_MAP1_VERTEX_3),
    N(GL_MAP2_VERTEX_3), N(GL_MAP2_VERTEX_4), N(GL_MAP1_GRID_DOMAIN), N(GL_MAP2_GRID_DOMAIN), N(GL_MAP1_GRID_SEGMENTS),
    N(GL_MAP2_GRID_SEGMENTS), N(GL_AUTO_NORMAL), N(GL_PERSPECTIVE_CORRECTION_HINT), N(GL_POINT_SMOOTH_HINT), N(GL_LINE_SMOOTH_HINT),
    N(GL_POLYGON_SMOOTH_HINT), N(GL_FOG_HINT), N(GL_GENERATE_MIPMAP_HINT), N(GL_MAX_TEXTURE_SIZE), N(GL_MAX_VIEWPORT_DIMS),
    N(GL_MAX_ATTRIB_STACK_DEPTH), N(GL_MAX_MODELVIEW_STACK_DEPTH), N(GL_MAX_LIGHTS), N(GL_MAX_CLIP_PLANES), N(GL_MAX_DRAW_BUFFERS),
    N(GL_MAX_SAMPLES), N(GL_SUBPIXEL_BITS), N(GL_AUX_BUFFERS), N(GL_RGBA_MODE), N(GL_INDEX_MODE), N(GL_DOUBLEBUFFER), N(GL_STEREO),
    N(GL_RED_BITS), N(GL_GREEN_BITS), N(GL_BLUE_BITS), N(GL_ALPHA_BITS), N(GL_INDEX_BITS), N(GL_DEPTH_BITS), N(GL_STENCIL_BITS),
    N(GL_ACCUM_RED_BITS), N(GL_ACCUM_ALPHA_BITS), N(GL_SAMPLES), N(GL_SAMPLE_BUFFERS), N(GL_LIST_BASE), N(GL_LIST_INDEX), N(GL_LIST_MODE),
    N(GL_ATTRIB_STACK_DEPTH), N(GL_CLIENT_ATTRIB_STACK_DEPTH), N(GL_NAME_STACK_DEPTH), N(GL_RENDER_MODE), N(GL_SELECTION_BUFFER_SIZE),
    N(GL_FEEDBACK_BUFFER_SIZE), N(GL_FEEDBACK_BUFFER_TYPE), N(GL_CURRENT_PROGRAM), N(GL_RENDERBUFFER_BINDING), N(GL_ACTIVE_TEXTURE),
    N(GL_VERTEX_PROGRAM_TWO_SIDE), N(GL_PROVOKING_VERTEX), N(GL_CLAMP_VERTEX_COLOR), N(GL_CLAMP_FRAGMENT_COLOR), N(GL_CLAMP_READ_COLOR),
    N(GL_IMPLEMENTATION_COLOR_READ_FORMAT), N(GL_IMPLEMENTATION_COLOR_READ_TYPE), N(GL_PRIMITIVE_RESTART), N(GL_RASTERIZER_DISCARD),
    N(GL_MAJOR_VERSION), N(GL_CONTEXT_FLAGS), N(GL_NUM_EXTENSIONS), N(GL_TEXTURE_1D), N(GL_TEXTURE_2D), N(GL_TEXTURE_3D),
    N(GL_TEXTURE_CUBE_MAP), N(GL_SAMPLER_BINDING),
};

static const GLenum per_unit[] = {GL_CURRENT_TEXTURE_COORDS, GL_CURRENT_RASTER_TEXTURE_COORDS, GL_TEXTURE_MATRIX, GL_TEXTURE_STACK_DEPTH,
                                  GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_T, GL_TEXTURE_GEN_R,
                                  GL_TEXTURE_GEN_Q, GL_TEXTURE_COORD_ARRAY, GL_TEXTURE_COORD_ARRAY_SIZE};

static void get(const char *where, const char *name, GLenum what)
{
    GLint i[16];
    GLfloat f[16];
    GLdouble d[16];
    GLboolean b[16];
    memset(i, 0x55, sizeof i);
    memset(f, 0x55, sizeof f);
    memset(d, 0x55, sizeof d);
    memset(b, 0x55, sizeof b);
    glGetIntegerv(what, i);
    glGetFloatv(what, f);
    glGetDoublev(what, d);
    glGetBooleanv(what, b);
    GLenum error = glGetError();
    while (glGetError());
    tell(&R->state, "%s%s 0x%x: %d %d %d %d; %.9g %.9g %.9g %.9g; all %llx", where, name, error, i[0], i[1], i[2], i[3], f[0], f[1], f[2],
         f[3], (unsigned long long)(hash(i, sizeof i) ^ hash(f, sizeof f) ^ 3 * hash(d, sizeof d) ^ 5 * hash(b, sizeof b)));
}

static void line(const char *what, GLenum a, GLenum b, const float *f)
{
    tell(&R->state, "%s 0x%x 0x%x: %.9g %.9g %.9g %.9g", what, a, b, f[0], f[1], f[2], f[3]);
}

/* Names that GL chose, as the program's own numbers. */
static int number(const GLuint *names, int n, GLuint name)
{
    for (int i = 0; i < n; i++)
        if (names[i] == name && name)
            return i + 1;
    return name ? -1 : 0;
}

static void tables(void)
{
    float f[16] = {0};
    static const GLenum of_light[] = {GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_POSITION, GL_SPOT_DIRECTION, GL_SPOT_EXPONENT, GL_SPOT_CUTOFF,
                                      GL_CONSTANT_ATTENUATION, GL_LINEAR_ATTENUATION};
    for (int k = 0; k < 3; k++)
        for (size_t i = 0; i < sizeof of_light / sizeof *of_light; i++) {
            GLenum light = GL_LIGHT0 + (GLenum)(k == 2 ? 7 : k);
            memset(f, 0, sizeof f);
            glGetLightfv(light, of_light[i], f);
            line("light", light, of_light[i], f);
        }
    static const GLenum of_material[] = {GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_EMISSION, GL_SHININESS};
    for (int k = 0; k < 10; k++) {
        memset(f, 0, sizeof f);
        GLenum face = k < 5 ? GL_FRONT : GL_BACK;
        glGetMaterialfv(face, of_material[k % 5], f);
        line("material", face, of_material[k % 5], f);
    }
    for (int k = 0; k < 6; k++) {
        double d[4];
        glGetClipPlane(GL_CLIP_PLANE0 + (GLenum)k, d);
        tell(&R->state, "plane %d %.9g %.9g %.9g %.9g", k, d[0], d[1], d[2], d[3]);
    }
    for (GLenum k = GL_PIXEL_MAP_I_TO_I; k <= GL_PIXEL_MAP_A_TO_A; k++) {
        memset(f, 0, sizeof f);
        glGetPixelMapfv(k, f);
        tell(&R->state, "pixel map 0x%x %llx", k, (unsigned long long)hash(f, sizeof f));
    }
    float points[256] = {0};
    GLint order[2];
    for (GLenum k = GL_MAP1_COLOR_4; k <= GL_MAP2_VERTEX_4; k++) {
        if (k > GL_MAP1_VERTEX_4 && k < GL_MAP2_COLOR_4)
            continue;
        memset(points, 0, sizeof points);
        glGetMapfv(k, GL_COEFF, points);
        glGetMapiv(k, GL_ORDER, order);
        tell(&R->state, "map 0x%x %d %llx", k, order[0], (unsigned long long)hash(points, sizeof points));
    }
    for (GLuint k = 1; k < 16; k++) {
        glGetVertexAttribfv(k, GL_CURRENT_VERTEX_ATTRIB, f);
        line("attribute", k, 0, f);
    }
    for (GLuint k = 1; k < 120; k++)
        if (glIsList(k))
            tell(&R->state, "list %u", k);
    for (GLuint k = 1; k < 6; k++) {
        GLint size = -1;
        if (glIsBuffer(k))
            tell(&R->state, "buffer %u %d", k, size);
    }
}

static void units(void)
{
    GLint active;
    float f[16] = {0};
    char where[16];
    glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
    for (int unit = 0; unit < 4; unit++) {
        glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
        snprintf(where, sizeof where, "unit %d ", unit);
        for (size_t i = 0; i < sizeof per_unit / sizeof *per_unit; i++) {
            char name[16];
            snprintf(name, sizeof name, "0x%x", per_unit[i]);
            get(where, name, per_unit[i]);
        }
        static const GLenum bindings[] = {GL_TEXTURE_BINDING_1D, GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_3D, GL_TEXTURE_BINDING_2D_ARRAY};
        for (int i = 0; i < 4; i++) {
            GLint name = 0;
            glGetIntegerv(bindings[i], &name);
            tell(&R->state, "%sbinding %d texture %d", where, i, name == 40 || name == 41 ? name : number(R->now->textures, TEXTURES, (GLuint)name));
        }
        for (GLenum coordinate = GL_S; coordinate <= GL_Q; coordinate++)
            for (int i = 0; i < 3; i++) {
                GLenum what = i == 0 ? GL_TEXTURE_GEN_MODE : i == 1 ? GL_OBJECT_PLANE : GL_EYE_PLANE;
                memset(f, 0, sizeof f);
                glGetTexGenfv(coordinate, what, f);
                line(where, coordinate, what, f);
            }
        static const GLenum environment[] = {GL_TEXTURE_ENV_MODE, GL_TEXTURE_ENV_COLOR, GL_COMBINE_RGB, GL_SRC0_RGB, GL_RGB_SCALE};
        for (int i = 0; i < 5; i++) {
            memset(f, 0, sizeof f);
            glGetTexEnvfv(GL_TEXTURE_ENV, environment[i], f);
            line(where, GL_TEXTURE_ENV, environment[i], f);
        }
    }
    glActiveTexture((GLenum)active);
}

/* What draw buffers and viewports have of their own. */
static void indexes(void)
{
    for (GLuint i = 0; i < 8; i++) {
        static const GLenum of_buffer[] = {GL_BLEND_SRC_RGB, GL_BLEND_DST_RGB, GL_BLEND_SRC_ALPHA, GL_BLEND_DST_ALPHA, GL_BLEND_EQUATION_RGB};
        GLint v[5] = {0}, mask[4] = {0};
        for (int k = 0; k < 5; k++)
            glGetIntegeri_v(of_buffer[k], i, &v[k]);
        glGetIntegeri_v(GL_COLOR_WRITEMASK, i, mask);
        tell(&R->state, "draw buffer %u %d %x %x %x %x %x %d%d%d%d", i, glIsEnabledi(GL_BLEND, i), v[0], v[1], v[2], v[3], v[4], mask[0],
             mask[1], mask[2], mask[3]);
    }
    for (GLuint i = 0; i < 16; i++) {
        GLfloat viewport[4] = {0};
        GLdouble range[2] = {0};
        GLint box[4] = {0};
        glGetFloati_v(GL_VIEWPORT, i, viewport);
        glGetDoublei_v(GL_DEPTH_RANGE, i, range);
        glGetIntegeri_v(GL_SCISSOR_BOX, i, box);
        tell(&R->state, "viewport %u %.9g %.9g %.9g %.9g %.9g %.9g %d %d %d %d %d", i, viewport[0], viewport[1], viewport[2], viewport[3],
             range[0], range[1], glIsEnabledi(GL_SCISSOR_TEST, i), box[0], box[1], box[2], box[3]);
    }
}

static void errors(const char *when)
{
    for (GLenum e; (e = glGetError());)
        tell(&R->answers, "error 0x%x at %s", e, when);
}

static void textures(void)
{
    for (int i = 0; i < TEXTURES; i++) {
        GLuint name = R->now->textures[i];
        GLenum target = i < 4 ? GL_TEXTURE_2D : i == 4 ? GL_TEXTURE_1D : GL_TEXTURE_3D;
        if (!glIsTexture(name))
            continue;
        glBindTexture(target, name);
        GLint v[6] = {0};
        glGetTexLevelParameteriv(target, 0, GL_TEXTURE_WIDTH, &v[0]);
        glGetTexLevelParameteriv(target, 0, GL_TEXTURE_HEIGHT, &v[1]);
        glGetTexLevelParameteriv(target, 0, GL_TEXTURE_INTERNAL_FORMAT, &v[2]);
        glGetTexParameteriv(target, GL_TEXTURE_MIN_FILTER, &v[3]);
        glGetTexParameteriv(target, GL_TEXTURE_WRAP_S, &v[4]);
        glGetTexParameteriv(target, GL_GENERATE_MIPMAP, &v[5]);
        memset(R->memory, 0, 65536);
        if (v[0] && v[0] <= 64 && v[1] <= 64)
            glGetTexImage(target, 0, GL_RGBA, GL_UNSIGNED_BYTE, R->memory);
        while (glGetError()); /* a name may be bound to another target */
        tell(&R->pixels, "texture %d %dx%d 0x%x %x %x %d image %llx", i, v[0], v[1], v[2], v[3], v[4], v[5],
             (unsigned long long)hash(R->memory, 65536));
    }
}

static void picture(const char *what, GLenum format, GLenum type, size_t bytes)
{
    memset(R->memory, 0x5a, WIDTH * HEIGHT * 4);
    glReadPixels(0, 0, WIDTH, HEIGHT, format, type, R->memory);
    tell(&R->pixels, "%s %llx error 0x%x", what, (unsigned long long)hash(R->memory, WIDTH * HEIGHT * bytes), glGetError());
    if (!O.rows)
        return;
    for (int y = 0; y < HEIGHT; y++) {
        fprintf(R->out, "%s row %d:", what, y);
        for (size_t i = 0; i < WIDTH * bytes; i++)
            fprintf(R->out, "%s%02x", i % bytes ? "" : " ", R->memory[(size_t)y * WIDTH * bytes + i]);
        fputc('\n', R->out);
    }
}

/* Whether a state belongs to a class of calls that is left out. */
static int left_out(GLenum what)
{
    return O.without >> ACCUM & 1 && what >= GL_ACCUM_RED_BITS && what <= GL_ACCUM_ALPHA_BITS;
}

static void stacks(void)
{
    static const GLenum modes[3] = {GL_MODELVIEW, GL_PROJECTION, GL_TEXTURE}, depths[3] = {GL_MODELVIEW_STACK_DEPTH, GL_PROJECTION_STACK_DEPTH, GL_TEXTURE_STACK_DEPTH};
    static const GLenum matrices[3] = {GL_MODELVIEW_MATRIX, GL_PROJECTION_MATRIX, GL_TEXTURE_MATRIX};
    for (int i = 0; i < 3; i++) {
        GLint depth = 1;
        GLfloat m[16];
        glMatrixMode(modes[i]);
        for (glGetIntegerv(depths[i], &depth); depth > 1; depth--) {
            glPopMatrix();
            glGetFloatv(matrices[i], m);
            tell(&R->state, "stack 0x%x %d %llx", modes[i], depth, (unsigned long long)hash(m, sizeof m));
        }
    }
    GLint depth = 0;
    for (glGetIntegerv(GL_ATTRIB_STACK_DEPTH, &depth); depth > 0; depth--) {
        glPopAttrib();
        for (size_t i = 0; i < sizeof gets / sizeof *gets; i += depth % 3 == 0 ? 1 : 7)
            if (!left_out(gets[i].value))
                get("popped ", gets[i].name, gets[i].value);
    }
}

void dump_drawable(int number)
{
    tell(&R->pixels, "drawable %d", number);
    picture("colour", GL_RGBA, GL_UNSIGNED_BYTE, 4);
    picture("depth", GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, 4);
    picture("stencil", GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, 1);
}

void dump_context(void)
{
    struct context *c = R->now;
    GLint name = 0;
    errors("the end");
    tell(&R->answers, "hits %d", glRenderMode(GL_RENDER));
    tell(&R->answers, "feedback %llx selection %llx", (unsigned long long)hash(c->feedback, sizeof c->feedback),
         (unsigned long long)hash(c->selection, sizeof c->selection));
    end_queries();
    end_capture();
    glUseProgram(0);
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &name);
    tell(&R->state, "draws to %d", number(c->framebuffers, FRAMES, (GLuint)name));
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &name);
    tell(&R->state, "reads from %d", number(c->framebuffers, FRAMES, (GLuint)name));
    for (size_t i = 0; i < sizeof gets / sizeof *gets; i++)
        if (gets[i].value != GL_RENDERBUFFER_BINDING && !left_out(gets[i].value))
            get("", gets[i].name, gets[i].value);
    tables();
    units();
    indexes();
    errors("the questions");
    stacks();
    errors("the stacks");
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    get("zero ", "GL_DRAW_BUFFER", GL_DRAW_BUFFER);
    get("zero ", "GL_READ_BUFFER", GL_READ_BUFFER);
    glPopClientAttrib();
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    for (GLenum p = GL_PACK_SWAP_BYTES; p <= GL_PACK_SKIP_PIXELS; p++)
        glPixelStorei(p, 0);
    glPixelTransferi(GL_MAP_COLOR, 0);
    glPixelTransferi(GL_MAP_STENCIL, 0);
    glPixelTransferi(GL_INDEX_SHIFT, 0);
    glPixelTransferi(GL_INDEX_OFFSET, 0);
    for (GLenum p = GL_RED_SCALE; p <= GL_DEPTH_BIAS; p++)
        if (p != GL_ZOOM_X && p != GL_ZOOM_Y)
            glPixelTransferf(p, p == GL_RED_SCALE || p == GL_GREEN_SCALE || p == GL_BLUE_SCALE || p == GL_ALPHA_SCALE || p == GL_DEPTH_SCALE);
    while (glGetError());
    dump_drawable(0);
    textures();
    errors("the pictures");
}
