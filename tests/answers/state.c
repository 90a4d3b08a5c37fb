/* All state that a program can ask for: prints what differs from before after a clear, a draw, a list, a read, a copy and a swap. So it prints no
 * more than the names of the steps.
 *
 *   state default      nothing has been set
 *   state set          most state has another value than its default one
 *   state program      the same, with a program whose shaders have a camera
 *   state pipeline     the same, with a program pipeline
 *   state framebuffer  the same, with a framebuffer of the program's */
#include "../support/c/shaders.h"
#include "../support/c/surface.h"
#include <stdlib.h>
#include <string.h>

enum { PLACE = 3, MOST = 16, VALUES = 6000, UNITS = 32, ATTRIBUTES = 16, BINDINGS = 12 };

static const GLenum names[] = {
    GL_ACTIVE_TEXTURE, GL_ARRAY_BUFFER_BINDING, GL_ATOMIC_COUNTER_BUFFER_BINDING, GL_ATTRIB_STACK_DEPTH, GL_ACCUM_CLEAR_VALUE, GL_ALPHA_BITS,
    GL_ALPHA_TEST_FUNC, GL_ALPHA_TEST_REF, GL_BLEND_COLOR, GL_CLAMP_READ_COLOR, GL_CLIENT_ACTIVE_TEXTURE, GL_CLIENT_ATTRIB_STACK_DEPTH,
    GL_CLIP_DEPTH_MODE, GL_CLIP_ORIGIN, GL_COLOR_CLEAR_VALUE, GL_COLOR_MATERIAL_FACE, GL_COLOR_MATERIAL_PARAMETER, GL_COLOR_WRITEMASK,
    GL_COPY_READ_BUFFER_BINDING, GL_COPY_WRITE_BUFFER_BINDING, GL_CULL_FACE_MODE, GL_CURRENT_COLOR, GL_CURRENT_FOG_COORD, GL_CURRENT_INDEX,
    GL_CURRENT_NORMAL, GL_CURRENT_PROGRAM, GL_CURRENT_RASTER_COLOR, GL_CURRENT_RASTER_DISTANCE, GL_CURRENT_RASTER_POSITION,
    GL_CURRENT_RASTER_POSITION_VALID, GL_CURRENT_RASTER_TEXTURE_COORDS, GL_CURRENT_SECONDARY_COLOR, GL_CURRENT_TEXTURE_COORDS, GL_DEPTH_BITS,
    GL_DEPTH_CLEAR_VALUE, GL_DEPTH_FUNC, GL_DEPTH_RANGE, GL_DEPTH_WRITEMASK, GL_DISPATCH_INDIRECT_BUFFER_BINDING, GL_DRAW_BUFFER, GL_DRAW_BUFFER1,
    GL_DRAW_FRAMEBUFFER_BINDING, GL_DRAW_INDIRECT_BUFFER_BINDING, GL_EDGE_FLAG, GL_ELEMENT_ARRAY_BUFFER_BINDING, GL_FOG_COLOR, GL_FOG_DENSITY,
    GL_FOG_END, GL_FOG_HINT, GL_FOG_MODE, GL_FOG_START, GL_FRAGMENT_SHADER_DERIVATIVE_HINT, GL_FRONT_FACE, GL_GENERATE_MIPMAP_HINT,
    GL_INDEX_CLEAR_VALUE, GL_LIGHT_MODEL_AMBIENT, GL_LIGHT_MODEL_COLOR_CONTROL, GL_LIGHT_MODEL_LOCAL_VIEWER, GL_LIGHT_MODEL_TWO_SIDE,
    GL_LINE_SMOOTH_HINT, GL_LINE_STIPPLE_PATTERN, GL_LINE_STIPPLE_REPEAT, GL_LINE_WIDTH, GL_LIST_BASE, GL_LIST_INDEX, GL_LIST_MODE,
    GL_LOGIC_OP_MODE, GL_MAP1_GRID_DOMAIN, GL_MATRIX_MODE, GL_MIN_SAMPLE_SHADING_VALUE, GL_MODELVIEW_MATRIX, GL_MODELVIEW_STACK_DEPTH,
    GL_NAME_STACK_DEPTH, GL_NUM_EXTENSIONS, GL_PACK_ALIGNMENT, GL_PACK_IMAGE_HEIGHT, GL_PACK_LSB_FIRST, GL_PACK_ROW_LENGTH, GL_PACK_SKIP_IMAGES,
    GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_ROWS, GL_PACK_SWAP_BYTES, GL_PATCH_DEFAULT_INNER_LEVEL, GL_PATCH_DEFAULT_OUTER_LEVEL, GL_PATCH_VERTICES,
    GL_PIXEL_PACK_BUFFER_BINDING, GL_PIXEL_UNPACK_BUFFER_BINDING, GL_POINT_DISTANCE_ATTENUATION, GL_POINT_FADE_THRESHOLD_SIZE, GL_POINT_SIZE,
    GL_POINT_SPRITE_COORD_ORIGIN, GL_POLYGON_MODE, GL_POLYGON_OFFSET_FACTOR, GL_POLYGON_OFFSET_UNITS, GL_PRIMITIVE_RESTART_INDEX,
    GL_PROGRAM_PIPELINE_BINDING, GL_PROJECTION_MATRIX, GL_PROJECTION_STACK_DEPTH, GL_PROVOKING_VERTEX, GL_QUERY_BUFFER_BINDING, GL_READ_BUFFER,
    GL_READ_FRAMEBUFFER_BINDING, GL_RED_BIAS, GL_RED_SCALE, GL_MAP_COLOR, GL_RENDERBUFFER_BINDING, GL_RENDER_MODE, GL_SAMPLES, GL_SAMPLE_BUFFERS,
    GL_SAMPLE_COVERAGE_INVERT, GL_SAMPLE_COVERAGE_VALUE, GL_SCISSOR_BOX, GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADE_MODEL, GL_STENCIL_BITS,
    GL_STENCIL_BACK_FAIL, GL_STENCIL_BACK_FUNC, GL_STENCIL_BACK_REF, GL_STENCIL_BACK_WRITEMASK, GL_STENCIL_CLEAR_VALUE, GL_STENCIL_FAIL,
    GL_STENCIL_FUNC, GL_STENCIL_REF, GL_STENCIL_VALUE_MASK, GL_STENCIL_WRITEMASK, GL_TEXTURE_BUFFER_BINDING, GL_TEXTURE_COMPRESSION_HINT,
    GL_TEXTURE_MATRIX, GL_TEXTURE_STACK_DEPTH, GL_TRANSFORM_FEEDBACK_BINDING, GL_TRANSFORM_FEEDBACK_BUFFER_BINDING, GL_UNIFORM_BUFFER_BINDING,
    GL_UNPACK_ALIGNMENT, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_IMAGES, GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_ROWS,
    GL_VERTEX_ARRAY_BINDING, GL_VIEWPORT, GL_ZOOM_X, GL_ZOOM_Y};

static const GLenum switches[] = {
    GL_ALPHA_TEST, GL_AUTO_NORMAL, GL_BLEND, GL_CLIP_PLANE0, GL_CLIP_PLANE1, GL_CLIP_PLANE5, GL_COLOR_LOGIC_OP, GL_COLOR_MATERIAL, GL_COLOR_SUM, GL_CULL_FACE,
    GL_DEBUG_OUTPUT, GL_DEPTH_CLAMP, GL_DEPTH_TEST, GL_DITHER, GL_FOG, GL_FRAMEBUFFER_SRGB, GL_INDEX_LOGIC_OP, GL_LIGHT0, GL_LIGHT7, GL_LIGHTING, GL_LINE_SMOOTH,
    GL_LINE_STIPPLE, GL_MAP1_COLOR_4, GL_MULTISAMPLE, GL_NORMALIZE, GL_POINT_SMOOTH, GL_POINT_SPRITE, GL_POLYGON_OFFSET_FILL,
    GL_POLYGON_OFFSET_LINE, GL_POLYGON_SMOOTH, GL_POLYGON_STIPPLE, GL_PRIMITIVE_RESTART, GL_PRIMITIVE_RESTART_FIXED_INDEX, GL_PROGRAM_POINT_SIZE,
    GL_RASTERIZER_DISCARD, GL_RESCALE_NORMAL, GL_SAMPLE_ALPHA_TO_COVERAGE, GL_SAMPLE_ALPHA_TO_ONE, GL_SAMPLE_COVERAGE, GL_SAMPLE_MASK,
    GL_SAMPLE_SHADING, GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP,
    GL_TEXTURE_CUBE_MAP_SEAMLESS, GL_TEXTURE_GEN_S, GL_VERTEX_PROGRAM_TWO_SIDE, GL_VERTEX_ARRAY, GL_NORMAL_ARRAY, GL_COLOR_ARRAY,
    GL_TEXTURE_COORD_ARRAY};

static const GLenum by_unit[] = {GL_TEXTURE_BINDING_1D, GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_3D, GL_TEXTURE_BINDING_CUBE_MAP,
                                 GL_TEXTURE_BINDING_1D_ARRAY, GL_TEXTURE_BINDING_2D_ARRAY, GL_TEXTURE_BINDING_CUBE_MAP_ARRAY,
                                 GL_TEXTURE_BINDING_RECTANGLE, GL_TEXTURE_BINDING_BUFFER, GL_TEXTURE_BINDING_2D_MULTISAMPLE,
                                 GL_TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY, GL_SAMPLER_BINDING};

static const GLenum by_binding[] = {GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE, GL_SHADER_STORAGE_BUFFER_BINDING,
                                    GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE};

static const GLenum by_image[] = {GL_IMAGE_BINDING_NAME, GL_IMAGE_BINDING_LEVEL, GL_IMAGE_BINDING_LAYERED, GL_IMAGE_BINDING_LAYER, GL_IMAGE_BINDING_ACCESS,
                                  GL_IMAGE_BINDING_FORMAT};

static const GLenum by_viewport[] = {GL_VIEWPORT, GL_SCISSOR_BOX, GL_DEPTH_RANGE};

static const GLenum by_buffer[] = {GL_COLOR_WRITEMASK, GL_BLEND_SRC_RGB, GL_BLEND_SRC_ALPHA, GL_BLEND_DST_RGB, GL_BLEND_DST_ALPHA, GL_BLEND_EQUATION_RGB,
                                   GL_BLEND_EQUATION_ALPHA};

#define COUNT(array) (sizeof(array) / sizeof *(array))

struct value {
    char name[48];
    GLdouble is[MOST];
};

static struct value before[VALUES], now[VALUES];
static int count;

static struct value *next(const char *kind, GLenum name, GLuint at)
{
    struct value *v = &now[count++];
    if (count > VALUES)
        exit(3);
    memset(v, 0, sizeof *v);
    snprintf(v->name, sizeof v->name, "%s 0x%x of %u", kind, name, at);
    return v;
}

static void ask_indexed(const char *kind, const GLenum *all, size_t length, GLuint indices)
{
    for (size_t i = 0; i < length; i++)
        for (GLuint at = 0; at < indices; at++)
            glGetDoublei_v(all[i], at, next(kind, all[i], at)->is);
}

static void ask_units(void)
{
    GLint active;
    glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
    for (GLuint unit = 0; unit < UNITS; unit++) {
        glActiveTexture(GL_TEXTURE0 + unit);
        for (size_t i = 0; i < COUNT(by_unit); i++)
            glGetDoublev(by_unit[i], next("unit", by_unit[i], unit)->is);
    }
    glActiveTexture((GLenum)active);
}

static void ask_attributes(void)
{
    static const GLenum all[] = {GL_VERTEX_ATTRIB_ARRAY_ENABLED, GL_VERTEX_ATTRIB_ARRAY_SIZE, GL_VERTEX_ATTRIB_ARRAY_STRIDE, GL_VERTEX_ATTRIB_ARRAY_TYPE,
                                 GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING, GL_VERTEX_ATTRIB_ARRAY_DIVISOR};
    for (GLuint at = 0; at < ATTRIBUTES; at++) {
        for (size_t i = 0; i < COUNT(all); i++)
            glGetVertexAttribdv(at, all[i], next("attribute", all[i], at)->is);
        if (at)
            glGetVertexAttribdv(at, GL_CURRENT_VERTEX_ATTRIB, next("attribute", GL_CURRENT_VERTEX_ATTRIB, at)->is);
    }
}

static void ask_fixed(void)
{
    GLfloat v[4] = {0};
    for (GLenum light = GL_LIGHT0; light <= GL_LIGHT7; light += 7)
        for (GLenum name = GL_AMBIENT; name <= GL_QUADRATIC_ATTENUATION; name++) {
            struct value *to = next("light", name, light);
            glGetLightfv(light, name, v);
            for (int i = 0; i < 4; i++)
                to->is[i] = (GLdouble)v[i];
        }
    for (GLenum plane = 0; plane < 6; plane++)
        glGetClipPlane(GL_CLIP_PLANE0 + plane, next("plane", plane, 0)->is);
}

static void ask(void)
{
    count = 0;
    for (size_t i = 0; i < COUNT(names); i++)
        glGetDoublev(names[i], next("value", names[i], 0)->is);
    for (size_t i = 0; i < COUNT(switches); i++)
        next("switch", switches[i], 0)->is[0] = glIsEnabled(switches[i]);
    ask_units();
    ask_indexed("binding", by_binding, COUNT(by_binding), BINDINGS);
    ask_indexed("image", by_image, COUNT(by_image), 4);
    ask_indexed("viewport", by_viewport, COUNT(by_viewport), MOST);
    ask_indexed("buffer", by_buffer, COUNT(by_buffer), 4);
    for (GLuint at = 0; at < 4; at++)
        next("blends", GL_BLEND, at)->is[0] = glIsEnabledi(GL_BLEND, at);
    for (GLuint at = 0; at < MOST; at++)
        next("scissors", GL_SCISSOR_TEST, at)->is[0] = glIsEnabledi(GL_SCISSOR_TEST, at);
    ask_attributes();
    ask_fixed();
}

static void tell(const char *what)
{
    GLenum error = glGetError();
    ask();
    printf("%s: error 0x%x\n", what, error);
    for (int i = 0; i < count; i++) {
        if (!memcmp(now[i].is, before[i].is, sizeof now[i].is))
            continue;
        printf("  %s:", now[i].name);
        for (int k = 0; k < 4; k++)
            printf(" %g", before[i].is[k]);
        printf(" became");
        for (int k = 0; k < 4; k++)
            printf(" %g", now[i].is[k]);
        printf("\n");
    }
    while (glGetError())
        continue;
    memcpy(before, now, sizeof before);
}

static void set_objects(void)
{
    static const GLenum targets[] = {GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP, GL_TEXTURE_1D_ARRAY, GL_TEXTURE_2D_ARRAY,
                                     GL_TEXTURE_CUBE_MAP_ARRAY, GL_TEXTURE_RECTANGLE, GL_TEXTURE_BUFFER, GL_TEXTURE_2D_MULTISAMPLE,
                                     GL_TEXTURE_2D_MULTISAMPLE_ARRAY};
    static const GLenum buffers[] = {GL_ARRAY_BUFFER, GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, GL_DISPATCH_INDIRECT_BUFFER, GL_DRAW_INDIRECT_BUFFER,
                                     GL_QUERY_BUFFER, GL_TEXTURE_BUFFER, GL_UNIFORM_BUFFER, GL_SHADER_STORAGE_BUFFER, GL_ATOMIC_COUNTER_BUFFER};
    GLuint name;
    for (GLuint unit = 0; unit < UNITS; unit++) {
        glActiveTexture(GL_TEXTURE0 + unit);
        for (size_t i = 0; i < COUNT(targets); i++) {
            glGenTextures(1, &name);
            glBindTexture(targets[i], name);
        }
        glGenSamplers(1, &name);
        glBindSampler(unit, name);
    }
    glActiveTexture(GL_TEXTURE5);
    for (size_t i = 0; i < COUNT(buffers); i++) {
        glGenBuffers(1, &name);
        glBindBuffer(buffers[i], name);
        glBufferData(buffers[i], 4096, NULL, GL_STATIC_DRAW);
    }
    for (GLuint at = 0; at < BINDINGS; at++) {
        glGenBuffers(1, &name);
        glBindBuffer(GL_UNIFORM_BUFFER, name);
        glBufferData(GL_UNIFORM_BUFFER, 4096, NULL, GL_STATIC_DRAW);
        glBindBufferRange(GL_UNIFORM_BUFFER, at, name, 256, 512);
        glBindBufferRange(GL_SHADER_STORAGE_BUFFER, at, name, 256, 512);
    }
    glGenRenderbuffers(1, &name);
    glBindRenderbuffer(GL_RENDERBUFFER, name);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

static void set_values(void)
{
    static const GLenum off[] = {GL_RASTERIZER_DISCARD, GL_SCISSOR_TEST, GL_DEBUG_OUTPUT, GL_PRIMITIVE_RESTART, GL_MAP1_COLOR_4, GL_VERTEX_ARRAY,
                                 GL_NORMAL_ARRAY, GL_COLOR_ARRAY, GL_TEXTURE_COORD_ARRAY, GL_INDEX_LOGIC_OP};
    for (size_t i = 0; i < COUNT(switches); i++)
        glEnable(switches[i]);
    for (size_t i = 0; i < COUNT(off); i++)
        glDisable(off[i]);
    glDisable(GL_DITHER);
    glDisable(GL_MULTISAMPLE);
    glAlphaFunc(GL_GREATER, 0.25f);
    glBlendColor(0.25f, 0.5f, 0.75f, 1);
    glBlendFuncSeparate(GL_ONE, GL_SRC_ALPHA, GL_DST_COLOR, GL_ZERO);
    glBlendEquationSeparate(GL_MAX, GL_FUNC_REVERSE_SUBTRACT);
    glClearColor(0.25f, 0.5f, 0.75f, 0.5f);
    glClearDepth(0.75);
    glClearStencil(3);
    glClearAccum(0.5f, 0.25f, 0.5f, 0.25f);
    glColorMask(1, 0, 1, 0);
    glColorMaski(1, 0, 1, 0, 1);
    glCullFace(GL_FRONT_AND_BACK);
    glFrontFace(GL_CW);
    glDepthFunc(GL_GEQUAL);
    glDepthMask(GL_FALSE);
    glDepthRange(0.25, 0.75);
    glLogicOp(GL_XOR);
    glLineWidth(2);
    glPointSize(3);
    glPolygonMode(GL_FRONT, GL_LINE);
    glPolygonMode(GL_BACK, GL_POINT);
    glPolygonOffset(1, 2);
    glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
    glPrimitiveRestartIndex(77);
    glPatchParameteri(GL_PATCH_VERTICES, 5);
    glMinSampleShading(0.5f);
    glSampleCoverage(0.5f, GL_TRUE);
    glSampleMaski(0, 0x5555);
    glShadeModel(GL_FLAT);
    glStencilFuncSeparate(GL_FRONT, GL_LEQUAL, 1, 7);
    glStencilFuncSeparate(GL_BACK, GL_GREATER, 2, 5);
    glStencilOpSeparate(GL_FRONT, GL_INCR, GL_DECR, GL_INVERT);
    glStencilMaskSeparate(GL_BACK, 9);
    glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
    glPixelStorei(GL_UNPACK_SKIP_ROWS, 3);
    glPixelStorei(GL_PACK_ROW_LENGTH, 200);
    glPixelTransferf(GL_RED_SCALE, 0.5f);
    glPixelTransferf(GL_RED_BIAS, 0.25f);
    glPixelZoom(2, -1);
    glHint(GL_FOG_HINT, GL_NICEST);
    glListBase(5);
    glColor4f(0.25f, 0.5f, 0.75f, 1);
    glSecondaryColor3f(0.5f, 0.5f, 0.25f);
    glNormal3f(0, 1, 0);
    glTexCoord4f(1, 2, 3, 4);
    glFogCoordf(2);
    glEdgeFlag(GL_FALSE);
    for (GLuint at = 1; at < ATTRIBUTES; at++)
        if (at != PLACE)
            glVertexAttrib4f(at, (GLfloat)at, 2, 3, 4);
    glMatrixMode(GL_PROJECTION);
    glFrustum(-1, 1, -1, 1, 1, 10);
    glMatrixMode(GL_MODELVIEW);
    glTranslatef(0, 0, -4);
    glPushMatrix();
    glRotatef(30, 0, 1, 0);
    glMatrixMode(GL_TEXTURE);
    glScalef(2, 2, 2);
    glRasterPos3f(0.1f, 0.2f, 0.3f);
    glViewport(3, 4, 50, 40);
    glScissor(1, 2, 40, 30);
}

static GLuint separable(GLenum kind, const char *text)
{
    return glCreateShaderProgramv(kind, 1, &text);
}

static void set_shaders(const char *mode)
{
    const char *vertex = "#version 150\nin vec2 place; uniform mat4 camera; void main() { gl_Position = camera * vec4(place, -2.0, 1.0); }";
    const char *fragment = "#version 150\nout vec4 shown; void main() { shown = vec4(1.0); }";
    const GLfloat camera[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.04f, -1, 0, 0, -2.04f, 0};
    GLuint name;
    if (!strcmp(mode, "program")) {
        name = linked(vertex, fragment, PLACE);
        glUseProgram(name);
        glUniformMatrix4fv(glGetUniformLocation(name, "camera"), 1, GL_FALSE, camera);
    } else if (!strcmp(mode, "pipeline")) {
        glGenProgramPipelines(1, &name);
        glUseProgramStages(name, GL_VERTEX_SHADER_BIT,
                           separable(GL_VERTEX_SHADER, "#version 410\nlayout(location = 3) in vec2 place; out gl_PerVertex { vec4 gl_Position; };\n"
                                                       "void main() { gl_Position = vec4(place, 0.0, 1.0); }"));
        glUseProgramStages(name, GL_FRAGMENT_SHADER_BIT, separable(GL_FRAGMENT_SHADER, fragment));
        glBindProgramPipeline(name);
    }
}

static void set_framebuffer(void)
{
    GLuint texture, framebuffer;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, WIDTH, HEIGHT, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
}

int main(int argc, char **argv)
{
    static unsigned char pixels[300 * 300 * 4];
    if (argc < 2 || !open_surface() || !new_context(EGL_NO_CONTEXT))
        return 2;
    if (strcmp(argv[1], "default")) {
        set_objects();
        set_values();
        set_shaders(argv[1]);
    }
    if (!strcmp(argv[1], "framebuffer"))
        set_framebuffer();
    printf("set: error 0x%x\n", glGetError());
    ask();
    memcpy(before, now, sizeof before);
    while (glGetError())
        continue;
    for (int frame = 0; frame < 2; frame++) {
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
        tell("cleared");
        glDrawArrays(GL_TRIANGLES, 0, 3);
        tell("drawn");
        glBegin(GL_TRIANGLES);
        for (int i = 0; i < 3; i++)
            glVertex2f((GLfloat)i, (GLfloat)(i % 2));
        glEnd();
        tell("drawn between glBegin and glEnd");
        glNewList(1, GL_COMPILE);
        glRecti(0, 0, 1, 1);
        glEndList();
        glCallList(1);
        tell("a list called");
        glReadPixels(0, 0, WIDTH, HEIGHT, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
        tell("read");
        glBlitFramebuffer(0, 0, 20, 20, 30, 0, 50, 20, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        tell("blitted");
        glBitmap(0, 0, 0, 0, 0, 0, NULL);
        tell("a bitmap");
        glFinish();
        tell("finished");
        eglSwapBuffers(display, surface);
        tell("swapped");
    }
    return 0;
}
