/* Matrices, enables, fixed-function parameters, attribute stacks, render modes, errors. */
#include "random.h"

static void matrix_mode(void)
{
    CALL(glMatrixMode, ENUM(GL_MODELVIEW, GL_MODELVIEW, GL_MODELVIEW, GL_PROJECTION, GL_PROJECTION, GL_TEXTURE, GL_COLOR));
}

static void matrix(void)
{
    float aspect = (float)WIDTH / HEIGHT;
    switch (below(14)) {
    case 0: CALL0(glLoadIdentity); break;
    case 1: CALL0(glPushMatrix); break;
    case 2: CALL0(glPopMatrix); break;
    case 3: CALL(glTranslatef, within(-1, 1), within(-1, 1), within(-2, 1)); break;
    case 4: CALL(glRotatef, within(-180, 180), within(-1, 1), within(-1, 1), within(0.1f, 1)); break;
    case 5: CALL(glScalef, within(0.5f, 1.5f), within(0.5f, 1.5f), within(-1.5f, 1.5f)); break;
    case 6: CALL(glMultMatrixf, floats(16, -1, 1)); break;
    case 7: CALL(glLoadMatrixd, doubles(16, -1, 1)); break;
    case 8: CALL(glFrustum, (double)-aspect / within(1, 3), (double)aspect / 2, -0.5, (double)within(0.2f, 1), (double)within(0.5f, 1), 20.0); break;
    case 9: CALL(glOrtho, -2.0, 2.0, (double)within(-2, -1), 1.5, -5.0, (double)within(4, 9)); break;
    case 10: CALL(glMultTransposeMatrixf, floats(16, -1, 1)); break;
    case 11: CALL(glTranslated, (double)within(-1, 1), (double)within(-1, 1), (double)within(-1, 1)); break;
    case 12: CALL(glLoadTransposeMatrixd, doubles(16, -1, 1)); break;
    default: CALL(glFrustum, 1.0, chance(50) ? 1.0 : 2.0, -1.0, 1.0, chance(70) ? -1.0 : 1.0, 5.0); break;
    }
}

/* A whole new projection, as programs set it; the matrix mode ends as model view. */
static void projection(void)
{
    CALL(glMatrixMode, GL_PROJECTION);
    CALL0(glLoadIdentity);
    if (chance(75))
        CALL(glFrustum, (double)within(-1, -0.3f), (double)within(0.3f, 1), -0.5, 0.5, (double)within(0.5f, 1.5f), 20.0);
    else
        CALL(glOrtho, -1.5, 1.5, -1.0, 1.0, -10.0, 10.0);
    CALL(glMatrixMode, GL_MODELVIEW);
    if (chance(60)) {
        CALL0(glLoadIdentity);
        CALL(glTranslatef, 0.0f, 0.0f, within(-4, -1.5f));
    }
}

static GLenum capability(void)
{
    return ENUM(GL_ALPHA_TEST, GL_BLEND, GL_CLIP_PLANE0, GL_CLIP_PLANE1, GL_CLIP_PLANE5, GL_COLOR_LOGIC_OP,
                GL_COLOR_MATERIAL, GL_COLOR_SUM, GL_CULL_FACE, GL_DEPTH_TEST, GL_DEPTH_TEST, GL_DITHER, GL_FOG, GL_LIGHT0,
                GL_LIGHT1, GL_LIGHT7, GL_LIGHTING, GL_LIGHTING, GL_LINE_SMOOTH, GL_LINE_STIPPLE, GL_MAP1_VERTEX_3,
                GL_MAP2_VERTEX_3, GL_MAP2_VERTEX_4, GL_MULTISAMPLE, GL_NORMALIZE,
                GL_POINT_SMOOTH, GL_POINT_SPRITE, GL_POLYGON_OFFSET_FILL, GL_POLYGON_OFFSET_LINE, GL_POLYGON_SMOOTH,
                GL_POLYGON_STIPPLE, GL_RESCALE_NORMAL, GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_TEXTURE_1D, GL_TEXTURE_2D,
                GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP, GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_T, GL_TEXTURE_GEN_Q,
                GL_INDEX_LOGIC_OP, GL_VERTEX_PROGRAM_TWO_SIDE, GL_SAMPLE_ALPHA_TO_COVERAGE,
                W->windows ? GL_FRAMEBUFFER_SRGB : GL_DITHER); /* Mesa 22.3 converts nothing in pbuffers that claim to be sRGB */
}

static void enable(void) { CALL(glEnable, capability()); }
static void disable(void) { CALL(glDisable, capability()); }

static void client_state(void)
{
    GLenum array = ENUM(GL_VERTEX_ARRAY, GL_VERTEX_ARRAY, GL_NORMAL_ARRAY, GL_COLOR_ARRAY, GL_TEXTURE_COORD_ARRAY,
                        GL_EDGE_FLAG_ARRAY, GL_FOG_COORD_ARRAY, GL_SECONDARY_COLOR_ARRAY);
    if (chance(65))
        CALL(glEnableClientState, array);
    else
        CALL(glDisableClientState, array);
}

static void raster_state(void)
{
    switch (below(16)) {
    case 0: CALL(glViewport, (int)below(20) - 4, (int)below(16) - 4, (int)below(80), (int)below(60)); break;
    case 1: CALL(glScissor, (int)below(30) - 4, (int)below(24) - 4, (int)below(64), (int)below(48)); break;
    case 2: CALL(glViewport, 0, 0, chance(90) ? WIDTH : -1, HEIGHT); break;
    case 3: CALL(glScissor, 0, 0, WIDTH, chance(90) ? HEIGHT : -1); break;
    case 4: CALL(glDepthRange, (double)within(0, 1), (double)within(0, 1)); break;
    case 5: CALL(glPolygonMode, ENUM(GL_FRONT, GL_BACK, GL_FRONT_AND_BACK), ENUM(GL_FILL, GL_FILL, GL_LINE, GL_POINT)); break;
    case 6: CALL(glPolygonOffset, within(-2, 2), within(-4, 4)); break;
    case 7: CALL(glCullFace, ENUM(GL_FRONT, GL_BACK, GL_FRONT_AND_BACK)); break;
    case 8: CALL(glFrontFace, ENUM(GL_CW, GL_CCW)); break;
    case 9: CALL(glLineWidth, within(chance(90) ? 0.5f : -1, 5)); break;
    case 10: CALL(glPointSize, within(chance(90) ? 0.5f : -1, 6)); break;
    case 11: CALL(glLineStipple, (int)below(5), (GLushort)below(65536)); break;
    case 12: {
        GLubyte stipple[128];
        for (int i = 0; i < 128; i++)
            stipple[i] = (GLubyte)below(256);
        GLint bound = 0;
        if (!R->begin)
            glGetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &bound);
        begin_bits_with_a_byte();
        /* Pixel storage applies, so the source has to be long enough for it. */
        CALL(glPolygonStipple, bound || chance(50) ? (const GLubyte *)pixel_source() : stipple);
        break;
    }
    case 13: CALL(glShadeModel, ENUM(GL_FLAT, GL_SMOOTH)); break;
    case 14: CALL(glProvokingVertex, ENUM(GL_FIRST_VERTEX_CONVENTION, GL_LAST_VERTEX_CONVENTION)); break;
    default: CALL(glPointParameterfv, ENUM(GL_POINT_DISTANCE_ATTENUATION, GL_POINT_SIZE_MIN, GL_POINT_SIZE_MAX), floats(3, 0.1f, 3)); break;
    }
}

static GLenum comparison(void)
{
    return ENUM(GL_NEVER, GL_LESS, GL_LESS, GL_EQUAL, GL_LEQUAL, GL_LEQUAL, GL_GREATER, GL_NOTEQUAL, GL_GEQUAL, GL_ALWAYS);
}

static void fragment_state(void)
{
    switch (below(14)) {
    case 0: CALL(glAlphaFunc, comparison(), within(0, 1)); break;
    case 1: CALL(glBlendFunc, ENUM(GL_ONE, GL_SRC_ALPHA, GL_DST_COLOR, GL_ZERO, GL_CONSTANT_COLOR),
                 ENUM(GL_ZERO, GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_SRC_COLOR)); break;
    case 2: CALL(glBlendEquation, ENUM(GL_FUNC_ADD, GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT, GL_MIN, GL_MAX)); break;
    case 3: CALL(glBlendColor, within(0, 1), within(0, 1), within(0, 1), within(0, 1)); break;
    case 4: CALL(glDepthFunc, comparison()); break;
    case 5: CALL(glStencilFunc, comparison(), (int)below(8), below(256)); break;
    case 6: CALL(glStencilOp, ENUM(GL_KEEP, GL_ZERO, GL_REPLACE, GL_INCR), ENUM(GL_KEEP, GL_INVERT, GL_DECR, GL_INCR_WRAP),
                 ENUM(GL_KEEP, GL_REPLACE, GL_INCR, GL_DECR_WRAP)); break;
    case 7: CALL(glStencilFuncSeparate, ENUM(GL_FRONT, GL_BACK, GL_FRONT_AND_BACK), comparison(), (int)below(4), 255u); break;
    case 8: CALL(glLogicOp, ENUM(GL_COPY, GL_XOR, GL_INVERT, GL_AND, GL_NOOP, GL_EQUIV, GL_SET)); break;
    case 9: CALL(glColorMask, chance(80), chance(80), chance(80), chance(80)); break;
    case 10: CALL(glDepthMask, chance(80)); break;
    case 11: CALL(glStencilMask, chance(70) ? 255u : below(256)); break;
    case 12: CALL(glHint, ENUM(GL_FOG_HINT, GL_PERSPECTIVE_CORRECTION_HINT, GL_LINE_SMOOTH_HINT),
                  ENUM(GL_FASTEST, GL_NICEST, GL_DONT_CARE)); break;
    default: CALL(glSampleCoverage, within(0, 1), chance(50)); break;
    }
}

static void lighting(void)
{
    GLenum light = ENUM(GL_LIGHT0, GL_LIGHT1, GL_LIGHT7);
    switch (below(10)) {
    case 0: CALL(glLightfv, light, ENUM(GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR), floats(4, 0, 1)); break;
    case 1: CALL(glLightfv, light, ENUM(GL_POSITION, GL_SPOT_DIRECTION), floats(4, -2, 2)); break;
    case 2: CALL(glLightf, light, ENUM(GL_SPOT_EXPONENT, GL_SPOT_CUTOFF), within(0, chance(80) ? 90 : 180)); break;
    case 3: CALL(glLightf, light, ENUM(GL_CONSTANT_ATTENUATION, GL_LINEAR_ATTENUATION), within(0.1f, 1)); break;
    case 4: CALL(glLightModelfv, GL_LIGHT_MODEL_AMBIENT, floats(4, 0, 1)); break;
    case 5: CALL(glLightModeli, ENUM(GL_LIGHT_MODEL_TWO_SIDE, GL_LIGHT_MODEL_LOCAL_VIEWER), (int)below(2)); break;
    case 6: CALL(glLightModeli, GL_LIGHT_MODEL_COLOR_CONTROL, (int)ENUM(GL_SINGLE_COLOR, GL_SEPARATE_SPECULAR_COLOR)); break;
    case 7: CALL(glMaterialfv, ENUM(GL_FRONT, GL_BACK, GL_FRONT_AND_BACK),
                 ENUM(GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_EMISSION, GL_AMBIENT_AND_DIFFUSE), floats(4, 0, 1)); break;
    case 8: CALL(glMaterialf, ENUM(GL_FRONT, GL_FRONT_AND_BACK), ENUM(GL_SHININESS), within(0, 128)); break;
    default: CALL(glColorMaterial, ENUM(GL_FRONT, GL_BACK, GL_FRONT_AND_BACK),
                  ENUM(GL_AMBIENT, GL_DIFFUSE, GL_AMBIENT_AND_DIFFUSE, GL_EMISSION)); break;
    }
}

static void fog_and_planes(void)
{
    switch (below(9)) {
    case 0: CALL(glFogi, GL_FOG_MODE, (int)ENUM(GL_LINEAR, GL_EXP, GL_EXP2)); break;
    case 1: CALL(glFogf, ENUM(GL_FOG_START, GL_FOG_END, GL_FOG_DENSITY), within(chance(90) ? 0 : -1, 6)); break;
    case 2: CALL(glFogfv, GL_FOG_COLOR, floats(4, 0, 1)); break;
    case 3: CALL(glFogi, GL_FOG_COORD_SRC, (int)ENUM(GL_FOG_COORD, GL_FRAGMENT_DEPTH)); break;
    case 4: CALL(glClipPlane, ENUM(GL_CLIP_PLANE0, GL_CLIP_PLANE1, GL_CLIP_PLANE5), doubles(4, -1, 1)); break;
    case 5: CALL(glTexGeni, ENUM(GL_S, GL_T, GL_Q), GL_TEXTURE_GEN_MODE,
                 (int)ENUM(GL_OBJECT_LINEAR, GL_EYE_LINEAR, GL_SPHERE_MAP, GL_REFLECTION_MAP)); break;
    case 6: CALL(glTexGenfv, ENUM(GL_S, GL_T, GL_R), ENUM(GL_OBJECT_PLANE, GL_EYE_PLANE), floats(4, -1, 1)); break;
    case 7: CALL(glTexEnvi, GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, (int)ENUM(GL_MODULATE, GL_DECAL, GL_REPLACE, GL_BLEND, GL_ADD)); break;
    default: CALL(glTexEnvfv, GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, floats(4, 0, 1)); break;
    }
}

static void current_values(void) { vertex_calls(-1); }

/* Within another level everything is pushed: at glPopAttrib Mesa 22.3 forgets changes since the outer glPushAttrib, and does not restore there
 * what the inner one did not save. Buffer state is left out, because another framebuffer may be bound at glPopAttrib: Mesa restores it, or
 * reports an error, only where it believes that buffer state has changed in between. */
GLbitfield whole_mask(void)
{
    return R->list || framebuffer_bound() ? GL_ALL_ATTRIB_BITS & ~(GLbitfield)(GL_COLOR_BUFFER_BIT | GL_PIXEL_MODE_BIT) : GL_ALL_ATTRIB_BITS;
}

/* At an inner glPushAttrib Mesa 22.3 forgets changes of current values that no draw or query has flushed, so that the outer glPopAttrib does
 * not restore them: a query comes first. */
static void before_push(void)
{
    float color[4];
    if (!R->begin)
        glGetFloatv(GL_CURRENT_COLOR, color);
}

static void push_attrib(void)
{
    before_push();
    if (chance(50))
        CALL(glPushAttrib, chance(30) || R->list || bound(GL_ATTRIB_STACK_DEPTH) || framebuffer_bound() ? whole_mask()
                           : PICK(GL_CURRENT_BIT, GL_COLOR_BUFFER_BIT, GL_TRANSFORM_BIT, GL_VIEWPORT_BIT, GL_SCISSOR_BIT,
                                  GL_ENABLE_BIT, GL_LIGHTING_BIT, GL_TEXTURE_BIT, GL_PIXEL_MODE_BIT, GL_LIST_BIT,
                                  GL_POLYGON_BIT | GL_FOG_BIT, GL_COLOR_BUFFER_BIT | GL_TRANSFORM_BIT));
    else
        CALL0(glPopAttrib);
}

static void push_client(void)
{
    if (chance(50))
        CALL(glPushClientAttrib, PICK(GL_CLIENT_ALL_ATTRIB_BITS, GL_CLIENT_PIXEL_STORE_BIT, GL_CLIENT_VERTEX_ARRAY_BIT));
    else
        CALL0(glPopClientAttrib);
}

/* Many levels at once, up to the full stack. */
static void deep_attrib(void)
{
    before_push();
    for (uint32_t n = 1 + below(20); n; n--)
        CALL(glPushAttrib, whole_mask());
}

static void render_mode(void)
{
    struct context *c = R->now;
    switch (below(8)) {
    case 0: CALL(glFeedbackBuffer, (int)below(VALUES), ENUM(GL_2D, GL_3D, GL_3D_COLOR, GL_3D_COLOR_TEXTURE, GL_4D_COLOR_TEXTURE), c->feedback); break;
    case 1: CALL(glSelectBuffer, (int)below(VALUES), c->selection); break;
    case 2: CALL(glPassThrough, within(0, 9)); break;
    case 3: CALL0(glInitNames); break;
    case 4: CALL(glPushName, below(100)); break;
    case 5: chance(60) ? CALL(glLoadName, below(100)) : CALL0(glPopName); break;
    default: {
        GLenum mode = ENUM(GL_RENDER, GL_RENDER, GL_SELECT, GL_FEEDBACK);
        tell(&R->answers, "%d.%d hits %d", R->step, R->part, CALL(glRenderMode, mode));
    }
    }
}

static void get_error(void) { tell(&R->answers, "%d.%d error 0x%x", R->step, R->part, CALL0(glGetError)); }

static void get_value(void)
{
    float f[16] = {0};
    GLenum name = ENUM(GL_VIEWPORT, GL_SCISSOR_BOX, GL_DRAW_BUFFER, GL_READ_BUFFER, GL_PROJECTION_MATRIX, GL_MATRIX_MODE,
                       GL_MODELVIEW_MATRIX, GL_CURRENT_COLOR, GL_CURRENT_RASTER_POSITION, GL_LIST_INDEX, GL_LIST_MODE,
                       GL_LIST_BASE, GL_RENDER_MODE, GL_ATTRIB_STACK_DEPTH, GL_CURRENT_NORMAL, GL_ACTIVE_TEXTURE,
                       GL_DOUBLEBUFFER, GL_RED_BITS, GL_DEPTH_BITS, O.without >> ACCUM & 1 ? GL_RED_BITS : GL_ACCUM_RED_BITS, GL_SAMPLES, GL_PROJECTION_STACK_DEPTH);
    CALL(glGetFloatv, name, f);
    tell(&R->answers, "%d.%d get 0x%x %a %a %a %a hash %llx", R->step, R->part, name, f[0], f[1], f[2], f[3],
         (unsigned long long)hash(f, sizeof f));
    tell(&R->answers, "%d.%d enabled %d", R->step, R->part, CALL(glIsEnabled, capability()));
}

/* Calls that are errors in every state. */
static void wrong(void)
{
    switch (below(9)) {
    case 0: CALL(glEnable, 0xdeadu); break;
    case 1: CALL(glMatrixMode, GL_LIGHT0); break;
    case 2: CALL0(glEnd); break;
    case 3: CALL0(glEndList); break;
    case 4: CALL(glClear, 0x80000000u); break;
    case 5: CALL(glNewList, 0u, GL_COMPILE); break;
    case 6: CALL(glRenderMode, 5u); break;
    case 7: CALL(glBindFramebuffer, GL_TEXTURE_2D, 0u); break;
    default: CALL(glDrawArrays, GL_POINTS, 0, -1); break;
    }
}

const struct generator state_calls[] = {
    {"matrix_mode", MATRICES, 20, matrix_mode}, {"matrix", MATRICES, 45, matrix}, {"projection", MATRICES, 30, projection},
    {"enable", STATE, 60, enable}, {"disable", STATE, 40, disable}, {"client_state", ARRAYS, 25, client_state},
    {"raster_state", STATE, 50, raster_state}, {"fragment_state", STATE, 50, fragment_state},
    {"lighting", STATE, 30, lighting}, {"fog_and_planes", STATE, 30, fog_and_planes},
    {"current_values", STATE, 20, current_values}, {"push_attrib", ATTRIBS, 40, push_attrib},
    {"push_client", ATTRIBS, 15, push_client}, {"deep_attrib", ATTRIBS, 3, deep_attrib},
    {"render_mode", MODES, 20, render_mode}, {"get_error", READS, 20, get_error}, {"get_value", READS, 15, get_value},
    {"wrong", ERRORS, 10, wrong}, {0},
};
