/* random: makes seeded sequences of legal and illegal GL calls and prints all that a program can read back after each.
 *
 *   random [--api egl|glx|osmesa] [--seed S] [--count N] [--steps K] [--without CLASS,…] [--drop 3,5.2,…]
 *          [--verbose] [--rows] [--trace] [--disturb] [--apart] [--list-classes]
 *
 * prints one line per sequence and thread: hashes of the answers in between, of the state and of the pixels. Two runs, one of
 * them under a layer that must not be noticed, are compared line by line. For one seed: --verbose prints what was hashed,
 * --rows each row of pixels as well, --trace the calls, and --drop leaves out steps (3) or parts of steps (5.2; 5.2.0 is not
 * needed), each of which has random numbers of its own, so that the rest stays as it is. --disturb adds a glFlush and a culled
 * triangle after each step, --apart compiles lists in pieces: what differs by that is Mesa's doing. tests/random/reduce.py reduces a seed with these.
 *
 * Every sequence has contexts of its own. It avoids undefined behaviour of GL: no reads outside the framebuffer or of
 * textures without content, no invalid memory, no infinite lists, no other context on the same drawable.
 */
#include "random.h"
#include <pthread.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

__thread struct run *R;
struct options O = {.steps = 40};
#ifdef RANDOM_OSMESA
const struct window_api *W = &window_osmesa;
#else
const struct window_api *W = &window_egl;
#endif

static const char *const class_names[CLASSES] = {
    "state", "matrices", "immediate", "in-begin", "arrays", "evaluators", "lists", "pixels", "accum", "clears",
    "textures", "attribs", "modes", "reads", "framebuffers", "buffers", "queries", "swaps", "contexts", "threads", "errors",
    "front", "copies", "drawables", "captures", "indexed", "counters", "workers",
};

void fail(const char *format, ...)
{
    va_list list;
    va_start(list, format);
    vfprintf(stderr, format, list);
    va_end(list);
    fputc('\n', stderr);
    exit(2);
}

/* ---- random numbers ---- */

static uint64_t mix(uint64_t x) /* splitmix64: Steele, Lea and Flood, Fast splittable pseudorandom number generators, 2014 */
{
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
}

static void begin_part(void)
{
    R->random = mix(mix(mix(R->seed * 2 + (uint64_t)R->thread) + (uint64_t)R->step * 4096) + (uint64_t)R->part);
}

void part(void)
{
    R->part++;
    begin_part();
}

uint32_t below(uint32_t n)
{
    R->random += 0x9e3779b97f4a7c15u;
    return (uint32_t)((mix(R->random) >> 32) * n >> 32);
}

float within(float a, float b) { return a + (b - a) * (float)below(4097) / 4096; }
int chance(int percent) { return (int)below(100) < percent; }

GLenum odd(GLenum value)
{
    if (O.without >> ERRORS & 1 || below(60))
        return value;
    return PICK(0, 1, 7, 0xffff, GL_TEXTURE_2D, GL_FLOAT, GL_FRONT, GL_LIGHT0, GL_RGBA, GL_DEPTH_TEST, 0x8fff);
}

int dropped(void)
{
    char step[16], name[32];
    if (!O.drop)
        return 0;
    snprintf(step, sizeof step, ",%d,", R->step);
    snprintf(name, sizeof name, ",%d.%d,", R->step, R->part);
    return strstr(O.drop, step) || strstr(O.drop, name);
}

/* ---- what is printed ---- */

void print_int(int v) { fprintf(R->out, " %d", v); }
void print_unsigned(unsigned v) { fprintf(R->out, v < 256 ? " %u" : " 0x%x", v); }
void print_double(double v) { fprintf(R->out, " %.9g", v); }
void print_pointer(const void *v) { fputs((uintptr_t)v < 65536 ? " offset" : " pointer", R->out); }
void trace_name(const char *name) { fprintf(R->out, "%d.%d %s", R->step, R->part, name); }
void trace_end(void)
{
    fputc('\n', R->out);
    fflush(R->out);
}

uint64_t hash(const void *data, size_t bytes)
{
    uint64_t h = 0xcbf29ce484222325u;
    for (const unsigned char *p = data, *end = p + bytes; p < end; p++)
        h = (h ^ *p) * 0x100000001b3u;
    return mix(h);
}

void tell(uint64_t *where, const char *format, ...)
{
    char line[1024];
    va_list list;
    va_start(list, format);
    int n = vsnprintf(line, sizeof line, format, list);
    va_end(list);
    *where = mix(*where) ^ hash(line, (size_t)(n < (int)sizeof line ? n : (int)sizeof line - 1));
    if (O.verbose)
        fprintf(R->out, "%s\n", line);
}

static const void *values(void *to, int n, int what, float a, float b)
{
    if (O.trace)
        fprintf(R->out, "%d.%d  values", R->step, R->part);
    for (int i = 0; i < n; i++) {
        float v = what == 2 ? (float)((int)below(2 * (uint32_t)b + 1) - (int)b) : within(a, b);
        if (what == 0) ((float *)to)[i] = v;
        else if (what == 1) ((double *)to)[i] = v;
        else ((int *)to)[i] = (int)v;
        if (O.trace)
            print_double(v);
    }
    if (O.trace)
        trace_end();
    return to;
}

static __thread float float_values[64];
static __thread double double_values[64];
static __thread int int_values[64];
const float *floats(int n, float a, float b) { return (const float *)values(float_values, n, 0, a, b); }
const double *doubles(int n, float a, float b) { return (const double *)values(double_values, n, 1, a, b); }
const int *ints(int n, int bound) { return (const int *)values(int_values, n, 2, 0, (float)bound); }

/* ---- one sequence ---- */

static const struct generator *const tables[] = {state_calls, draw_calls, pixel_calls, object_calls, query_calls, swap_calls, list_calls,
                                                 indexed_calls, capture_calls};

int has(enum class class) { return !(R->without >> class & 1); }

void any_call(void)
{
    uint32_t sum = 0;
    for (int pass = 0; pass < 2; pass++) {
        uint32_t at = pass ? below(sum) : 0;
        for (size_t t = 0; t < sizeof tables / sizeof *tables; t++)
            for (const struct generator *g = tables[t]; g->call; g++) {
                if (!has(g->class))
                    continue;
                if (!pass) {
                    sum += (uint32_t)g->weight;
                } else if (at < (uint32_t)g->weight) {
                    g->call();
                    return;
                } else {
                    at -= (uint32_t)g->weight;
                }
            }
    }
}

static void switch_context(struct context *to)
{
    R->now = to;
    if (!to->worker)
        W->current(to->handle, to->draw, to->read);
}

/* Draws to a drawable of the context and reads from one; 0 is its first one. What was pushed comes back before: Mesa 22.3 has a read buffer for
 * each drawable and another one on the stack. */
static void switch_drawables(struct context *to, int draw, int read)
{
    for (GLint depth = to->others && to == R->now ? bound(GL_ATTRIB_STACK_DEPTH) : 0; depth > 0; depth--)
        glPopAttrib();
    to->draw = draw ? to->others + draw - 1 : to->drawable;
    to->read = read ? to->others + read - 1 : to->drawable;
    R->now = to;
    W->current(to->handle, to->draw, to->read);
}

/* Transform feedback and queries of primitives notice it. */
static void culled_triangle(void)
{
    GLint face = 0;
    GLboolean culled = glIsEnabled(GL_CULL_FACE);
    glGetIntegerv(GL_CULL_FACE_MODE, &face);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT_AND_BACK);
    glBegin(GL_TRIANGLES);
    glVertex2f(0, 0);
    glVertex2f(0.1f, 0);
    glVertex2f(0, 0.1f);
    glEnd();
    glCullFace((GLenum)face);
    if (!culled)
        glDisable(GL_CULL_FACE);
}

/* Changes that no program could notice: a flush, each attribute group and the current colour touched, a culled triangle. */
void disturb(void)
{
    static const GLenum caps[] = {GL_DITHER, GL_DEPTH_TEST, GL_MAP1_INDEX, GL_FOG, GL_LIGHTING, GL_LINE_STIPPLE, GL_POINT_SMOOTH,
                                  GL_POLYGON_STIPPLE, GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_TEXTURE_GEN_Q, GL_NORMALIZE,
                                  GL_MULTISAMPLE};
    GLfloat colour[4];
    glFlush();
    for (size_t i = 0; i < sizeof caps / sizeof *caps; i++) {
        if (caps[i] == GL_SCISSOR_TEST && has(INDEXED))
            continue; /* each viewport may have another */
        GLboolean on = glIsEnabled(caps[i]);
        (on ? glDisable : glEnable)(caps[i]);
        (on ? glEnable : glDisable)(caps[i]);
    }
    GLint base = 0, hint = 0;
    GLfloat zoom[2];
    glGetFloatv(GL_ZOOM_X, &zoom[0]);
    glGetFloatv(GL_ZOOM_Y, &zoom[1]);
    glPixelZoom(zoom[0] + 1, zoom[1]);
    glPixelZoom(zoom[0], zoom[1]);
    glGetIntegerv(GL_LIST_BASE, &base);
    glListBase((GLuint)base + 1);
    glListBase((GLuint)base);
    glGetIntegerv(GL_FOG_HINT, &hint);
    glHint(GL_FOG_HINT, hint == GL_NICEST ? GL_FASTEST : GL_NICEST);
    glHint(GL_FOG_HINT, (GLenum)hint);
    if (!bound(GL_TRANSFORM_FEEDBACK_BUFFER_ACTIVE) && (!R->now->query || R->now->counted == GL_SAMPLES_PASSED))
        culled_triangle();
    glGetFloatv(GL_CURRENT_COLOR, colour);
    glColor4fv(colour);
}

static void take_context(struct context *c, int number, struct context *share)
{
    c->share = share;
    c->drawable = c->draw = c->read = R->thread ? CONTEXTS : number;
    /* Not by chance(), so that a seed means the same with and without drawables up to here. */
    if (W->several && has(DRAWABLES) && mix(R->seed + 77) % 100 < 30)
        c->others = CONTEXTS + 1 + OTHERS * c->drawable;
    c->handle = W->create(share ? share->handle : NULL);
    if (!c->handle)
        fail("no context");
    for (int i = c->others ? OTHERS : 0; i >= 0; i--) {
        switch_drawables(c, i, i);
        glClearColor(0, 0, 0, 0);
        if (W->windows && has(FRONT)) { /* an earlier sequence has drawn to it */
            glDrawBuffer(GL_FRONT);
            glClear(GL_COLOR_BUFFER_BIT);
            glDrawBuffer(GL_BACK);
        }
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT | GL_ACCUM_BUFFER_BIT);
    }
    array_pointers();
    /* Names are the program's own or GL's choice, the same within a share group. */
    if (share) {
        memcpy(c->textures, share->textures, sizeof c->textures);
    } else if (R->seed % 2 || (R->context_count > 1 && !has(WORKERS))) {
        glGenTextures(TEXTURES, c->textures);
    } else {
        for (int i = 0; i < TEXTURES; i++)
            c->textures[i] = (GLuint)i + 1;
    }
    glFeedbackBuffer(VALUES, GL_3D_COLOR, c->feedback);
    glSelectBuffer(VALUES, c->selection);
    GLfloat aspect = (GLfloat)WIDTH / HEIGHT;
    if (R->seed % 4) { /* else all matrices are identities */
        glMatrixMode(GL_PROJECTION);
        glFrustum(-aspect / 2, aspect / 2, -0.5, 0.5, 1, 20);
        glMatrixMode(GL_MODELVIEW);
        glTranslatef(0, 0, -3);
    }
}

static void one_step(void)
{
    if (R->now->others && !R->begin && chance(15)) {
        int draw = (int)below(OTHERS + 1), read = chance(50) ? draw : (int)below(OTHERS + 1);
        if (O.trace)
            fprintf(R->out, "%d.0 (draws to %d, reads from %d)\n", R->step, draw, read);
        switch_drawables(R->now, draw, read);
    } else {
        any_call();
        if (O.disturb && !R->begin && !R->list)
            disturb();
    }
}

/* Another context goes on, on its own thread where it has one. */
static void go_on_with(struct context *to)
{
    if (R->now->worker)
        worker_run(R->now->worker, glFinish);
    switch_context(to);
}

static void take_next(void) { take_context(R->now, (int)(R->now - R->contexts), R->sharing ? &R->contexts[0] : NULL); }

static void print_context(void)
{
    if (O.verbose)
        fprintf(R->out, "context %d\n", (int)(R->now - R->contexts));
    switch_drawables(R->now, 0, 0);
    dump_context();
    for (int k = 1; R->now->others && k <= OTHERS; k++) {
        switch_drawables(R->now, k, k);
        dump_drawable(k);
    }
}

static void sequence(void)
{
    R->step = -1, R->part = 0;
    begin_part();
    R->answers = R->state = R->pixels = 0;
    R->calls = 0;
    int several = has(CONTEXTS_) && !R->thread && chance(25);
    R->context_count = several ? 2 + (int)below(CONTEXTS - 1) : 1;
    for (int i = 0; i < R->context_count; i++) {
        struct context *c = R->now = &R->contexts[i];
        R->sharing = i && chance(60);
        memset(c, 0, sizeof *c);
        c->worker = several && has(WORKERS) && mix(R->seed + 79) % 2 ? worker_start() : NULL;
        worker_run(c->worker, take_next);
    }
    if (several)
        go_on_with(&R->contexts[0]);
    for (R->step = 0; R->step < O.steps; R->step++) {
        R->part = 0;
        begin_part();
        if (dropped())
            continue;
        if (several && chance(10)) {
            int to = (int)below((uint32_t)R->context_count);
            if (O.trace)
                fprintf(R->out, "%d.0 (context %d)\n", R->step, to);
            go_on_with(&R->contexts[to]);
        } else {
            worker_run(R->now->worker, one_step);
        }
    }
    for (int i = 0; i < R->context_count; i++) {
        go_on_with(&R->contexts[i]);
        worker_run(R->now->worker, print_context);
    }
    for (int i = 0; i < R->context_count; i++)
        worker_stop(R->contexts[i].worker);
    W->current(NULL, 0, 0);
    for (int i = R->context_count - 1; i >= 0; i--)
        W->destroy(R->contexts[i].handle);
    fprintf(R->out, "seed %llu thread %d calls %u answers %016llx state %016llx pixels %016llx\n", (unsigned long long)R->seed,
            R->thread, R->calls, (unsigned long long)R->answers, (unsigned long long)R->state, (unsigned long long)R->pixels);
    fflush(R->out);
}

static void *second_thread(void *run)
{
    R = run;
    sequence();
    return NULL;
}

static void seed(uint64_t number)
{
    static struct run runs[2];
    static unsigned char memory[2][MEMORY];
    unsigned without = O.without;
    /* Not by chance(), as for drawables. */
    for (int class = CAPTURES; mix(number + 78) % 100 >= SOME_SEEDS && class < CLASSES; class++)
        without |= 1u << class;
    for (int i = 0; i < 2; i++)
        runs[i] = (struct run){.seed = number, .without = without, .thread = i, .out = stdout, .memory = memory[i]};
    memset(memory, 0, sizeof memory);
    R = &runs[0];
    R->step = -2;
    begin_part();
    pthread_t other;
    char *text = NULL;
    size_t length;
    int two = has(THREADS) && chance(15);
    if (two) {
        runs[1].out = open_memstream(&text, &length);
        if (!runs[1].out || pthread_create(&other, NULL, second_thread, &runs[1]))
            fail("no thread");
    }
    sequence();
    if (two) {
        pthread_join(other, NULL);
        fclose(runs[1].out);
        fputs(text, stdout);
        free(text);
    }
}

static unsigned classes(const char *text)
{
    unsigned bits = 0;
    for (int i = 0; i < CLASSES; i++) {
        const char *at = strstr(text, class_names[i]);
        size_t n = strlen(class_names[i]);
        if (at && (at == text || at[-1] == ',') && (!at[n] || at[n] == ','))
            bits |= 1u << i;
    }
    return bits;
}

int main(int argc, char **argv)
{
    uint64_t first = 0, count = 1;
    for (int i = 1; i < argc; i++) {
        const char *a = argv[i], *v = i + 1 < argc ? argv[i + 1] : "";
#define IS(x) (!strcmp(a, x))
        if (IS("--verbose")) O.verbose = 1;
        else if (IS("--rows")) O.verbose = O.rows = 1;
        else if (IS("--trace")) O.trace = 1;
        else if (IS("--disturb")) O.disturb = 1;
        else if (IS("--apart")) O.apart = 1;
        else if (IS("--list-classes")) {
            for (int k = 0; k < CLASSES; k++)
                puts(class_names[k]);
            return 0;
        } else if (i++, IS("--seed")) first = strtoull(v, NULL, 10);
        else if (IS("--count")) count = strtoull(v, NULL, 10);
        else if (IS("--steps")) O.steps = atoi(v);
        else if (IS("--without")) O.without |= classes(v);
        else if (IS("--only")) O.without |= ~classes(v);
        else if (IS("--drop")) {
            size_t size = strlen(v) + 3;
            char *text = malloc(size);
            snprintf(text, size, ",%s,", v);
            O.drop = text;
        } else if (IS("--api")) {
#ifndef RANDOM_OSMESA
            W = !strcmp(v, "glx") ? &window_glx : &window_egl;
#endif
        } else fail("what is %s? See the head of main.c", a);
    }
    prepare_data();
    prepare_pixels();
    W->open((CONTEXTS + 1) * (1 + OTHERS));
    for (uint64_t s = first; s < first + count; s++)
        seed(s);
    return 0;
}
