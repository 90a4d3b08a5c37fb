/* Pixels: raster position, bitmaps, drawn and copied pixels, transfer, textures, reads. */
#include "random.h"

static _Alignas(16) unsigned char source[MEMORY];

void prepare_pixels(void)
{
    struct run run = {.random = 77};
    R = &run;
    float *f = (float *)source; /* floats, so that the values are of a plausible size in every type */
    for (size_t i = 0; i < MEMORY / sizeof *f; i++)
        f[i] = within(0.001f, 1);
    R = NULL;
}

const void *pixel_source(void)
{
    GLint bound = 0;
    if (!R->begin)
        glGetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &bound);
    return bound ? (const void *)(uintptr_t)(below(4) * 16) : source + below(4) * 16;
}

void *pixel_target(void)
{
    GLint bound = 0;
    if (!R->begin)
        glGetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &bound);
    return bound ? (void *)(uintptr_t)(below(4) * 16) : R->memory;
}

static GLenum color_format(void) { return ENUM(GL_RGBA, GL_RGBA, GL_RGB, GL_BGRA, GL_LUMINANCE, GL_ALPHA, GL_RED, GL_LUMINANCE_ALPHA); }
static GLenum pixel_type(void) { return ENUM(GL_UNSIGNED_BYTE, GL_UNSIGNED_BYTE, GL_FLOAT, GL_UNSIGNED_SHORT, GL_BYTE, GL_INT); }

static void raster_position(void)
{
    switch (below(6)) {
    case 0: CALL(glWindowPos2i, (int)below(70) - 3, (int)below(50) - 3); break;
    case 1: CALL(glWindowPos3f, within(0, 60), within(0, 40), within(0, 1)); break;
    case 2: CALL(glRasterPos2i, (int)below(3) - 1, (int)below(3) - 1); break;
    case 3: CALL(glRasterPos4f, within(-1, 1), within(-1, 1), within(-1, 1), within(0.5f, 1.5f)); break;
    default: CALL(glRasterPos3f, within(-1, 1), within(-1, 1), within(-1, 1)); break;
    }
}

/* Mesa 22.3 takes the texture coordinates of pictures from the last draw, or from uninitialised memory (--disturb): no textures. */
static void without_textures(void)
{
    static const GLenum units[3] = {GL_TEXTURE3, GL_TEXTURE1, GL_TEXTURE0};
    static const GLenum targets[4] = {GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP};
    if (R->begin)
        return;
    for (int i = 0; i < 3; i++) {
        CALL(glActiveTexture, units[i]);
        for (int k = 0; k < 4; k++)
            if (R->list || glIsEnabled(targets[k]))
                CALL(glDisable, targets[k]);
    }
}

/* Mesa 22.3 writes a byte beyond the copy that it makes of bits for a list or a stipple, if they begin within a byte: they begin with one. */
void begin_bits_with_a_byte(void)
{
    if (bound(GL_UNPACK_SKIP_PIXELS) % 8 != 0)
        CALL(glPixelStorei, GL_UNPACK_SKIP_PIXELS, 0);
}

static void drawn_pixels(void)
{
    without_textures();
    int width = (int)below(18), height = R->list || chance(97) ? (int)below(14) : -1; /* no negative height in lists, for Mesa 22.3 */
    switch (below(8)) {
    case 0: case 1:
        begin_bits_with_a_byte();
        CALL(glBitmap, width, height, within(-2, 4), within(-2, 4), within(-8, 8), within(-4, 4), (const GLubyte *)pixel_source());
        break;
    case 2: CALL(glBitmap, 0, 0, 0.0f, 0.0f, within(-8, 8), within(-4, 4), (const GLubyte *)pixel_source()); break;
    case 3: CALL(glDrawPixels, width, height, ENUM(GL_DEPTH_COMPONENT), ENUM(GL_FLOAT, GL_UNSIGNED_INT), pixel_source()); break;
    case 4: CALL(glDrawPixels, width, height, ENUM(GL_STENCIL_INDEX), ENUM(GL_UNSIGNED_BYTE), pixel_source()); break;
    default: CALL(glDrawPixels, width, height, color_format(), pixel_type(), pixel_source()); break;
    }
}

static void copied_pixels(void)
{
    /* Within the frame, and from its left part to its right one: Mesa's result is nondeterministic for overlaps. */
    int width = (int)below(16), height = (int)below(16);
    without_textures();
    if (chance(70)) {
        CALL(glPixelZoom, 1.0f, 1.0f);
        CALL(glWindowPos2i, 26 + (int)below(20), (int)below(40));
    } else {
        CALL(glPixelZoom, within(0.5f, 2), within(-1.5f, 2));
        CALL(glWindowPos2i, 26 + (int)below(10), 20);
    }
    CALL(glCopyPixels, (int)below(9), (int)below(30), width, height, ENUM(GL_COLOR, GL_COLOR, GL_DEPTH, GL_STENCIL));
}

static void pixel_state(void)
{
    switch (below(9)) {
    case 0: CALL(glPixelZoom, within(-2.5f, 2.5f), within(-2, 2)); break;
    case 1: CALL(glPixelZoom, 1.0f, 1.0f); break;
    case 2: CALL(glPixelTransferf, ENUM(GL_RED_SCALE, GL_GREEN_BIAS, GL_ALPHA_SCALE, GL_DEPTH_SCALE, GL_DEPTH_BIAS), within(-0.5f, 1.5f)); break;
    case 3: CALL(glPixelTransferi, ENUM(GL_MAP_COLOR, GL_MAP_STENCIL, GL_INDEX_SHIFT, GL_INDEX_OFFSET), (int)below(2)); break;
    case 4: CALL(glPixelMapfv, ENUM(GL_PIXEL_MAP_R_TO_R, GL_PIXEL_MAP_G_TO_G, GL_PIXEL_MAP_S_TO_S, GL_PIXEL_MAP_A_TO_A),
                 1 << below(4), floats(8, 0, 1)); break;
    case 5: CALL(glPixelStorei, ENUM(GL_UNPACK_ALIGNMENT, GL_PACK_ALIGNMENT), (int)PICK(1, 2, 4, 8, 3)); break;
    case 6: CALL(glPixelStorei, ENUM(GL_UNPACK_ROW_LENGTH, GL_PACK_ROW_LENGTH), (int)(chance(60) ? 0 : below(24))); break;
    case 7: CALL(glPixelStorei, ENUM(GL_UNPACK_SKIP_ROWS, GL_PACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS, GL_PACK_SKIP_PIXELS), (int)below(4)); break;
    default: CALL(glPixelStorei, ENUM(GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST, GL_PACK_SWAP_BYTES), (int)below(2)); break;
    }
}

/* ---- textures ---- */

static GLenum texture_target(void) { return ENUM(GL_TEXTURE_2D, GL_TEXTURE_2D, GL_TEXTURE_2D, GL_TEXTURE_1D); }

static void bind_texture(void)
{
    /* The first four are 2D, one is 1D, one 3D; some calls use a name with another target. */
    static const GLenum targets[TEXTURES] = {GL_TEXTURE_2D, GL_TEXTURE_2D, GL_TEXTURE_2D, GL_TEXTURE_2D, GL_TEXTURE_1D, GL_TEXTURE_3D};
    uint32_t i = below(TEXTURES);
    switch (below(6)) {
    case 0: CALL(glActiveTexture, ENUM(GL_TEXTURE0, GL_TEXTURE0, GL_TEXTURE1, GL_TEXTURE3)); break;
    case 1: CALL(glBindTexture, targets[i], 0u); break;
    default: CALL(glBindTexture, odd(targets[i]), R->now->textures[i]); break;
    }
}

static void image(void)
{
    GLint inside = (GLint)ENUM(GL_RGBA, GL_RGBA8, GL_RGB, GL_LUMINANCE, GL_ALPHA8, GL_INTENSITY, 3, 4);
    int size = 1 << below(5), level = chance(80) ? 0 : (int)below(4);
    switch (below(8)) {
    case 0: case 1: case 2:
        CALL(glTexImage2D, GL_TEXTURE_2D, level, inside, size, 8, 0, color_format(), pixel_type(), pixel_source());
        break;
    case 3: CALL(glTexImage1D, GL_TEXTURE_1D, level, inside, size, 0, color_format(), pixel_type(), pixel_source()); break;
    case 4: CALL(glTexImage3D, GL_TEXTURE_3D, 0, inside, 4, 4, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixel_source()); break;
    case 5: CALL(glTexSubImage2D, GL_TEXTURE_2D, level, (int)below(4), (int)below(4), (int)below(5), 3, color_format(), pixel_type(), pixel_source()); break;
    case 6: CALL(glTexImage2D, ENUM(GL_PROXY_TEXTURE_2D), 0, inside, chance(50) ? 1 << 20 : 8, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL); break;
    default: CALL(glGenerateMipmap, texture_target()); break;
    }
}

static void copied_image(void)
{
    int x = (int)below(32), y = (int)below(30), size = 1 << below(5);
    if (!bound(GL_READ_BUFFER)) /* Mesa 22.3 crashes */
        return;
    switch (below(5)) {
    case 0: CALL(glCopyTexImage1D, GL_TEXTURE_1D, 0, PICK(GL_RGBA, GL_RGB), x, y, size, 0); break;
    case 1: CALL(glCopyTexSubImage1D, GL_TEXTURE_1D, 0, 0, x, y, (int)below(4)); break;
    case 2: CALL(glCopyTexSubImage2D, GL_TEXTURE_2D, 0, (int)below(3), (int)below(3), x, y, (int)below(6), (int)below(6)); break;
    default: CALL(glCopyTexImage2D, ENUM(GL_TEXTURE_2D), chance(85) ? 0 : 1, PICK(GL_RGBA, GL_RGB, GL_LUMINANCE, GL_ALPHA), x, y, size, 16, 0); break;
    }
}

static void texture_state(void)
{
    GLenum target = texture_target();
    switch (below(7)) {
    case 0: CALL(glTexParameteri, target, GL_TEXTURE_MIN_FILTER, (int)ENUM(GL_NEAREST, GL_LINEAR, GL_NEAREST, GL_LINEAR_MIPMAP_LINEAR)); break;
    case 1: CALL(glTexParameteri, target, GL_TEXTURE_MAG_FILTER, (int)ENUM(GL_NEAREST, GL_LINEAR)); break;
    case 2: CALL(glTexParameteri, target, ENUM(GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T), (int)ENUM(GL_REPEAT, GL_CLAMP_TO_EDGE, GL_CLAMP, GL_MIRRORED_REPEAT)); break;
    case 3: CALL(glTexParameterfv, target, GL_TEXTURE_BORDER_COLOR, floats(4, 0, 1)); break;
    case 4: CALL(glTexParameteri, target, GL_GENERATE_MIPMAP, (int)below(2)); break;
    case 5: {
        GLuint name = R->now->textures[below(TEXTURES)];
        /* Other contexts may have it bound: their draws are then defined, the time of its deletion is not. */
        if (!R->now->share && R->context_count == 1 && chance(30))
            CALL(glDeleteTextures, 1, &name);
        else
            tell(&R->answers, "%d.%d texture %d", R->step, R->part, CALL(glIsTexture, name));
        break;
    }
    default: CALL(glTexEnvi, GL_TEXTURE_ENV, ENUM(GL_COMBINE_RGB, GL_SRC0_RGB, GL_RGB_SCALE), (int)ENUM(GL_ADD, GL_REPLACE, GL_PREVIOUS, GL_TEXTURE, 2)); break;
    }
}

/* A complete texture, as programs make them, so that draws are visible. */
static void whole_texture(void)
{
    CALL(glBindTexture, GL_TEXTURE_2D, R->now->textures[below(4)]);
    CALL(glTexParameteri, GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, (int)PICK(GL_NEAREST, GL_LINEAR));
    CALL(glTexImage2D, GL_TEXTURE_2D, 0, GL_RGBA, 8, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixel_source());
    CALL(glEnable, GL_TEXTURE_2D);
}

/* ---- reads, pixel buffers ---- */

static void read_pixels(void)
{
    int x = (int)below(40), y = (int)below(30), width = (int)below(24), height = (int)below(18);
    GLenum format = chance(70) ? color_format() : PICK(GL_DEPTH_COMPONENT, GL_STENCIL_INDEX), type = pixel_type();
    void *target = pixel_target();
    if (target == R->memory)
        for (int i = 0; i < 1 << 16; i++)
            R->memory[i] = 0xa5;
    CALL(glReadPixels, x, y, width, height, format, type, target);
    tell(&R->answers, "%d.%d pixels %llx", R->step, R->part, (unsigned long long)(target == R->memory ? hash(R->memory, 1 << 16) : 0));
}

static void pixel_buffer(void)
{
    if (chance(60))
        CALL(glBindBuffer, PICK(GL_PIXEL_UNPACK_BUFFER, GL_PIXEL_PACK_BUFFER), 0u);
    else if (chance(50)) {
        CALL(glBindBuffer, GL_PIXEL_UNPACK_BUFFER, 4u);
        if (!R->begin) {
            CALL(glBufferData, GL_PIXEL_UNPACK_BUFFER, (GLsizeiptr)65536, (const void *)source, GL_STREAM_DRAW);
        }
    } else {
        CALL(glBindBuffer, GL_PIXEL_PACK_BUFFER, 5u);
        if (!R->begin)
            CALL(glBufferData, GL_PIXEL_PACK_BUFFER, (GLsizeiptr)65536, (const void *)source, GL_STREAM_READ);
    }
}

const struct generator pixel_calls[] = {
    {"raster_position", PIXELS, 30, raster_position}, {"drawn_pixels", PIXELS, 45, drawn_pixels},
    {"copied_pixels", COPIES, 15, copied_pixels}, {"pixel_state", PIXELS, 25, pixel_state},
    {"bind_texture", TEXTURES_, 30, bind_texture}, {"image", TEXTURES_, 30, image}, {"copied_image", TEXTURES_, 15, copied_image},
    {"texture_state", TEXTURES_, 25, texture_state}, {"whole_texture", TEXTURES_, 20, whole_texture},
    {"read_pixels", READS, 15, read_pixels}, {"pixel_buffer", BUFFERS, 8, pixel_buffer}, {0},
};
