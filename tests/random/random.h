/* Random sequences of GL calls: declarations that the files share. main.c describes the program. */
#ifndef RANDOM_H
#define RANDOM_H

#define GL_GLEXT_PROTOTYPES 1
#include <GL/gl.h>
#include <GL/glext.h>
#include <stdint.h>
#include <stdio.h>

enum { WIDTH = 64, HEIGHT = 48, CONTEXTS = 3, TEXTURES = 6, FRAMES = 2, VALUES = 2048, VERTICES = 64 };
/* Drawables of a context beside its first one. */
enum { OTHERS = 2 };
enum { MEMORY = 1 << 20, BUFFER = 8192 };

/* Kinds of calls that can be left out (--without). The order is that of class_names in main.c. */
enum class {
    STATE, MATRICES, IMMEDIATE, IN_BEGIN, ARRAYS, EVALUATORS, LISTS, PIXELS, ACCUM, CLEARS, TEXTURES_, ATTRIBS, MODES,
    READS, FRAMEBUFFERS, BUFFERS, QUERIES, SWAPS, CONTEXTS_, THREADS, ERRORS, FRONT, COPIES, DRAWABLES,
    /* From here on: in SOME_SEEDS of 100 sequences, so that the others are what they were before there were these. */
    CAPTURES, INDEXED, COUNTERS, WORKERS, CLASSES
};
enum { SOME_SEEDS = 40 };

/* One context of a sequence, and its state as far as the sequence tracks it. */
struct context {
    void *handle;
    int drawable; /* its first one */
    int draw, read; /* those that are current with it */
    int others; /* the first of its other drawables; 0 where it has none */
    struct context *share;
    GLuint textures[TEXTURES], framebuffers[FRAMES], renderbuffer;
    GLfloat feedback[VALUES];
    GLuint selection[VALUES];
    int query; /* its name, between glBeginQuery and glEndQuery */
    GLenum counted; /* what it counts */
    int conditional; /* between glBeginConditionalRender and its end */
    unsigned asked; /* bits of occlusion queries that have ended */
    GLuint program, captured; /* transform feedback; 0 before its first call */
    GLenum fed; /* the kind of primitives that it takes, if it is active */
    struct worker *worker; /* the thread that it is current on; null: the sequence's */
};

/* One thread of a sequence. */
struct run {
    uint64_t seed, random;
    unsigned without; /* bits of classes that the sequence leaves out */
    int step, part;
    int thread; /* 0 or 1 */
    int begin, list; /* between glBegin and glEnd; the list that is being compiled */
    int loop;        /* between glBegin(GL_LINE_LOOP) and glEnd */
    int executes;    /* the list is compiled with GL_COMPILE_AND_EXECUTE */
    struct context contexts[CONTEXTS], *now;
    int context_count, sharing; /* whether the next context shares with the first one */
    FILE *out;
    unsigned calls; /* of the sequence; what prints the results calls more */
    uint64_t answers, state, pixels;
    unsigned char *memory; /* memory that GL writes to */
};
extern __thread struct run *R;

struct options {
    int trace, verbose, rows, disturb, apart, steps;
    unsigned without; /* bits of classes */
    const char *drop; /* ",3,5.2,": steps and parts of steps that are left out */
};
extern struct options O;

/* ---- main.c ---- */
int dropped(void);                        /* whether the current step or part is left out */
void part(void);                          /* the next part of a step: random numbers of its own */
uint32_t below(uint32_t n);               /* 0 to n - 1 */
float within(float a, float b);
int chance(int percent);
_Noreturn void fail(const char *format, ...) __attribute__((format(printf, 1, 2)));
/* Prints a line about a result and hashes it into `where`: one of &R->answers, &R->state, &R->pixels. */
void tell(uint64_t *where, const char *format, ...) __attribute__((format(printf, 2, 3)));
uint64_t hash(const void *data, size_t bytes);

#define PICK(...) ((const GLenum[]){__VA_ARGS__}[below(sizeof((const GLenum[]){__VA_ARGS__}) / sizeof(GLenum))])
/* Like PICK, but sometimes a value that is illegal here. */
#define ENUM(...) odd(PICK(__VA_ARGS__))
GLenum odd(GLenum value);

/* ---- calls, which --trace prints: CALL(glEnable, cap) ---- */
void print_int(int v);
void print_unsigned(unsigned v);
void print_double(double v);
void print_pointer(const void *v);
void trace_name(const char *name);
void trace_end(void);
#define PRINT(x) _Generic((x), char: print_int, signed char: print_int, short: print_int, int: print_int, \
    long: print_int, unsigned char: print_unsigned, unsigned short: print_unsigned, unsigned: print_unsigned, \
    unsigned long: print_unsigned, float: print_double, double: print_double, default: print_pointer)(x)
#define V1(a) __auto_type a_ = (a);
#define V2(a, b) V1(a) __auto_type b_ = (b);
#define V3(a, b, c) V2(a, b) __auto_type c_ = (c);
#define V4(a, b, c, d) V3(a, b, c) __auto_type d_ = (d);
#define V5(a, b, c, d, e) V4(a, b, c, d) __auto_type e_ = (e);
#define V6(a, b, c, d, e, f) V5(a, b, c, d, e) __auto_type f_ = (f);
#define V7(a, b, c, d, e, f, g) V6(a, b, c, d, e, f) __auto_type g_ = (g);
#define V8(a, b, c, d, e, f, g, h) V7(a, b, c, d, e, f, g) __auto_type h_ = (h);
#define V9(a, b, c, d, e, f, g, h, i) V8(a, b, c, d, e, f, g, h) __auto_type i_ = (i);
#define V10(a, b, c, d, e, f, g, h, i, j) V9(a, b, c, d, e, f, g, h, i) __auto_type j_ = (j);
#define P1 PRINT(a_);
#define P2 P1 PRINT(b_);
#define P3 P2 PRINT(c_);
#define P4 P3 PRINT(d_);
#define P5 P4 PRINT(e_);
#define P6 P5 PRINT(f_);
#define P7 P6 PRINT(g_);
#define P8 P7 PRINT(h_);
#define P9 P8 PRINT(i_);
#define P10 P9 PRINT(j_);
#define A1 a_
#define A2 A1, b_
#define A3 A2, c_
#define A4 A3, d_
#define A5 A4, e_
#define A6 A5, f_
#define A7 A6, g_
#define A8 A7, h_
#define A9 A8, i_
#define A10 A9, j_
#define COUNT_(a, b, c, d, e, f, g, h, i, j, n, ...) n
#define COUNT(...) COUNT_(__VA_ARGS__, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1)
#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)
/* Arguments are evaluated once, from left to right, so that a seed means the same with every compiler. */
#define CALL(f, ...) __extension__({ \
    JOIN(V, COUNT(__VA_ARGS__))(__VA_ARGS__) \
    R->calls++; \
    if (O.trace) { trace_name(#f); JOIN(P, COUNT(__VA_ARGS__)) trace_end(); } \
    f(JOIN(A, COUNT(__VA_ARGS__))); })
#define CALL0(f) __extension__({ R->calls++; if (O.trace) { trace_name(#f); trace_end(); } f(); })
/* An array of random numbers, which --trace prints. */
const float *floats(int n, float a, float b);
const double *doubles(int n, float a, float b);
const int *ints(int n, int bound);

/* ---- generators: calls_*.c ---- */
struct generator {
    const char *name;
    enum class class;
    int weight;
    void (*call)(void);
};
extern const struct generator state_calls[], draw_calls[], pixel_calls[], object_calls[], query_calls[], swap_calls[], list_calls[],
    indexed_calls[], capture_calls[];
void any_call(void);        /* a call from any table (main.c) */
int is_refused(GLenum mode); /* whether transform feedback refuses glBegin (calls_captures.c) */
void vertex_calls(int n);   /* legal calls between glBegin and glEnd (calls_draw.c) */
void disturb(void);
void after_primitive(void); /* flushes the primitive in a list (calls_draw.c) */
GLbitfield whole_mask(void); /* the groups that an inner glPushAttrib saves (calls_state.c) */
int bound(GLenum name);     /* glGetIntegerv; 0 between glBegin and glEnd */
int framebuffer_bound(void);
void array_pointers(void);  /* points every array at readable memory (calls_draw.c) */
void prepare_data(void);    /* once per process (calls_draw.c) */
void prepare_pixels(void);  /* once per process (calls_pixels.c) */
void begin_bits_with_a_byte(void); /* before bits that the driver may copy (calls_pixels.c) */
const void *pixel_source(void);
void *pixel_target(void);

int has(enum class class);  /* whether the sequence has a class of calls (main.c) */
void end_queries(void);     /* ends the query and the conditional rendering of the context (calls_queries.c) */
void end_capture(void);     /* ends transform feedback, and tells what it wrote (calls_captures.c) */

/* ---- worker.c ---- */
struct worker *worker_start(void);
void worker_run(struct worker *worker, void (*work)(void)); /* runs work there with the same R, and waits for it; here if null */
void worker_stop(struct worker *worker);                    /* no context is current there afterwards */

/* ---- dump.c ---- */
void dump_context(void);
void dump_drawable(int number); /* after dump_context, the drawable being current */

/* ---- window_*.c ---- */
struct window_api {
    const char *name;
    void (*open)(int drawables);
    void *(*create)(void *share);
    void (*current)(void *handle, int draw, int read); /* null: none */
    void (*destroy)(void *handle);
    void (*swap)(int drawable);
    int windows; /* 0: pbuffers */
    int several; /* 0: a context cannot go to another drawable */
};
extern const struct window_api window_egl, window_glx, window_osmesa;
extern const struct window_api *W;

#endif
