/* State with an index: draw buffers have their own blending and masks, viewports their own scissor rectangles and depth ranges. */
#include "random.h"

/* Of draw buffers or viewports; at times one that does not exist. */
static GLuint buffer(void) { return below(chance(95) ? 8 : 9); }
static GLuint viewport(void) { return below(chance(70) ? 2 : chance(95) ? 16 : 17); }

static GLenum factor(void) { return ENUM(GL_ONE, GL_ZERO, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_DST_COLOR); }
static GLboolean flag(void) { return (GLboolean)below(2); }

static void indexed(void)
{
    switch (below(13)) {
    case 0: CALL(glEnablei, GL_BLEND, buffer()); break;
    case 1: CALL(glDisablei, GL_BLEND, buffer()); break;
    case 2: CALL(glColorMaski, buffer(), flag(), flag(), flag(), flag()); break;
    case 3: CALL(glBlendFunci, buffer(), factor(), factor()); break;
    case 4: CALL(glBlendFuncSeparatei, buffer(), factor(), factor(), factor(), factor()); break;
    case 5: CALL(glBlendEquationi, buffer(), ENUM(GL_FUNC_ADD, GL_FUNC_SUBTRACT, GL_MIN, GL_MAX)); break;
    case 6: CALL(glEnablei, GL_SCISSOR_TEST, viewport()); break;
    case 7: CALL(glDisablei, GL_SCISSOR_TEST, viewport()); break;
    case 8: CALL(glScissorIndexed, viewport(), (int)below(20), (int)below(20), chance(97) ? 20 + (int)below(44) : -1, 20 + (int)below(28)); break;
    case 9: CALL(glViewportIndexedf, viewport(), within(-4, 4), within(-4, 4), chance(97) ? within(32, 70) : -1.0f, within(24, 60)); break;
    case 10: CALL(glViewportArrayv, viewport(), 1, floats(4, 0, 64)); break;
    case 11: CALL(glDepthRangeIndexed, viewport(), (double)within(0, 0.5f), (double)within(0.5f, 1)); break;
    default: {
        float f[4] = {0};
        GLuint index = viewport();
        GLenum what = ENUM(GL_VIEWPORT, GL_SCISSOR_BOX, GL_DEPTH_RANGE);
        tell(&R->answers, "%d.%d enabled %d", R->step, R->part, CALL(glIsEnabledi, GL_SCISSOR_TEST, index));
        CALL(glGetFloati_v, what, index, f);
        tell(&R->answers, "%d.%d of viewports 0x%x %a %a %a %a", R->step, R->part, what, f[0], f[1], f[2], f[3]);
    }
    }
}

const struct generator indexed_calls[] = {{"indexed", INDEXED, 80, indexed}, {0}};
