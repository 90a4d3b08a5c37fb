/* Queries: of samples in every sequence, of every kind in those that have counters; conditional rendering. */
#include "random.h"

static const GLenum kinds[] = {
    GL_SAMPLES_PASSED, GL_ANY_SAMPLES_PASSED, GL_ANY_SAMPLES_PASSED_CONSERVATIVE, GL_PRIMITIVES_GENERATED,
    GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, GL_TIME_ELAPSED, GL_VERTICES_SUBMITTED, GL_PRIMITIVES_SUBMITTED, GL_VERTEX_SHADER_INVOCATIONS,
    GL_CLIPPING_INPUT_PRIMITIVES, GL_CLIPPING_OUTPUT_PRIMITIVES, GL_FRAGMENT_SHADER_INVOCATIONS,
};

/* Occlusion queries say whether something is to be drawn. */
static int is_occlusion(GLenum kind) { return kind == kinds[0] || kind == kinds[1] || kind == kinds[2]; }

/* How long a draw takes is never the same, and a driver may count more in the pipeline than the primitives need. */
static int is_exact(GLenum kind)
{
    return is_occlusion(kind) || kind == GL_PRIMITIVES_GENERATED || kind == GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN;
}

static void query_ends(struct context *c)
{
    GLuint passed = 12345, name = (GLuint)c->query;
    CALL(glEndQuery, c->counted);
    CALL(glGetQueryObjectuiv, name, GL_QUERY_RESULT, &passed);
    tell(&R->answers, "%d.%d samples %u", R->step, R->part, is_exact(c->counted) ? passed : 0);
    if (is_occlusion(c->counted))
        c->asked |= 1u << name % 10;
    c->query = 0;
}

void end_queries(void)
{
    struct context *c = R->now;
    if (c->conditional)
        glEndConditionalRender();
    if (c->query)
        glEndQuery(c->counted);
    c->conditional = c->query = 0;
}

static void query(void)
{
    struct context *c = R->now;
    if (c->query) {
        query_ends(c);
    } else if (!R->begin && !R->list) {
        GLuint name = 1 + below(3) + 10 * (GLuint)(c - R->contexts);
        GLint begun = 0;
        c->counted = GL_SAMPLES_PASSED;
        if (has(COUNTERS)) {
            c->counted = kinds[below(sizeof kinds / sizeof *kinds)];
            if (!is_occlusion(c->counted) && chance(90))
                name += 3; /* else the name may belong to another kind: an error */
        }
        CALL(glBeginQuery, c->counted, name);
        glGetQueryiv(c->counted, GL_CURRENT_QUERY, &begun);
        c->query = begun == (GLint)name ? begun : 0;
    }
}

static void counters(void)
{
    struct context *c = R->now;
    GLint value = -1;
    if (R->begin || R->list)
        return;
    GLenum kind = kinds[below(sizeof kinds / sizeof *kinds)];
    switch (below(4)) {
    case 0:
        CALL(glGetQueryiv, kind, ENUM(GL_CURRENT_QUERY, GL_QUERY_COUNTER_BITS), &value);
        tell(&R->answers, "%d.%d of queries %d", R->step, R->part, value);
        break;
    case 1:
        CALL(glGetQueryIndexediv, GL_PRIMITIVES_GENERATED, below(5), GL_CURRENT_QUERY, &value);
        tell(&R->answers, "%d.%d of indexed queries %d", R->step, R->part, value);
        break;
    default:
        if (c->conditional) {
            CALL0(glEndConditionalRender);
            c->conditional = 0;
        } else if (!c->query) {
            GLuint digit = 1 + below(3);
            if (!(c->asked >> digit & 1))
                break;
            CALL(glBeginConditionalRender, digit + 10 * (GLuint)(c - R->contexts), PICK(GL_QUERY_WAIT, GL_QUERY_BY_REGION_WAIT, GL_QUERY_WAIT_INVERTED));
            c->conditional = 1;
        }
    }
}

const struct generator query_calls[] = {{"query", QUERIES, 15, query}, {"counters", COUNTERS, 15, counters}, {0}};
