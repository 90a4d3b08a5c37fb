/* main() of every demo: options, the frame loop, the view matrix, dumps, timing. */
#include "demo.h"
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

int demo_width = 512, demo_height = 384, demo_x, demo_y, demo_es;

__attribute__((weak)) int demo_accumulation;

static const char *program = "demo", *api_name, *dump;
static const struct demo_api *api;
static struct demo_window window = {.pbuffer = -1};
static int frames = -1, view_index, view_count = 1, tiled, check, timing, unread, bench;
static double eye_spacing = 0.3, focal_depth = 8.0, hud_depth;

_Noreturn void demo_fail(int status, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    fprintf(stderr, "%s: ", program);
    vfprintf(stderr, format, args);
    fputc('\n', stderr);
    va_end(args);
    exit(status);
}

double demo_time(int frame) { return frame * 0.02; }

demo_function demo_proc(const char *name)
{
    demo_function f = api->proc(name);
    if (!f)
        demo_fail(1, "no function %s", name);
    return f;
}

/* ---- viewport, scissor and projection ---- */

void demo_viewport(int x, int y, int width, int height)
{
    glViewport(demo_x + x, demo_y + y, width, height);
}

void demo_scissor(int x, int y, int width, int height)
{
    int x1 = x + width, y1 = y + height;
    if (tiled) { /* keeps it inside the picture */
        x = x < 0 ? 0 : x;
        y = y < 0 ? 0 : y;
        x1 = x1 > demo_width ? demo_width : x1;
        y1 = y1 > demo_height ? demo_height : y1;
        width = x1 > x ? x1 - x : 0;
        height = y1 > y ? y1 - y : 0;
    }
    glScissor(demo_x + x, demo_y + y, width, height);
    glEnable(GL_SCISSOR_TEST);
}

void demo_scissor_off(void)
{
    if (tiled)
        demo_scissor(0, 0, demo_width, demo_height);
    else
        glDisable(GL_SCISSOR_TEST);
}

/* View i of N: the camera moves by e along its x axis, with the frustum sheared so that depth X keeps its place: row0' = row0 + sep * row3 -
 * sep * conv * (0,0,0,1), sep = A e / X, conv = X, A = P[0][0]. Without the last term everything is infinitely far. */
static double last_separation; /* of the last perspective projection, per unit of clip-space w */

/* Moves a column-major projection (row r, column c is p[4 * c + r]); returns 0 where it stays the same. */
static int move_view(GLfloat p[16], int infinitely_far)
{
    double e = (view_index - (view_count - 1) / 2.0) * eye_spacing;
    if (e == 0.0)
        return 0;
    if (p[3] == 0.0f && p[7] == 0.0f && p[11] == 0.0f)
        return 0; /* orthographic, so flat */
    /* A is the part of row 0 at a right angle to the viewing direction (row 3), per unit of row 3: P[0][0] of a plain frustum, and the same
     * number where the camera is multiplied onto the projection. */
    double w2 = (double)p[3] * p[3] + (double)p[7] * p[7] + (double)p[11] * p[11], a = p[0];
    if (p[3] != 0.0f || p[7] != 0.0f) {
        double along = ((double)p[0] * p[3] + (double)p[4] * p[7] + (double)p[8] * p[11]) / w2;
        double x = p[0] - along * p[3], y = p[4] - along * p[7], z = p[8] - along * p[11];
        a = sqrt(x * x + y * y + z * z);
    }
    double sep = a / sqrt(w2) * e / focal_depth, conv = infinitely_far ? 0.0 : focal_depth * sqrt(w2);
    last_separation = sep;
    for (int c = 0; c < 4; c++)
        p[4 * c] = (GLfloat)(p[4 * c] + sep * p[4 * c + 3] - (c == 3 ? sep * conv : 0.0));
    return 1;
}

void demo_view(GLfloat p[16]) { move_view(p, 0); }

void demo_view_sky(GLfloat p[16]) { move_view(p, 1); }

/* The same where the eye is infinitely far away and the cameras differ by an angle: row0' = row0 + sep * row2 - sep * conv * row3. Row 2 grows
 * by `deeper` for each unit of depth, and conv is z at depth X. */
static int move_slanted(GLfloat p[16])
{
    double e = (view_index - (view_count - 1) / 2.0) * eye_spacing;
    if (e == 0.0)
        return 0;
    double wide = sqrt((double)p[0] * p[0] + (double)p[4] * p[4] + (double)p[8] * p[8]);
    double deeper = sqrt((double)p[2] * p[2] + (double)p[6] * p[6] + (double)p[10] * p[10]);
    double sep = wide / deeper * e / focal_depth, conv = p[14] + deeper * focal_depth;
    for (int c = 0; c < 4; c++)
        p[4 * c] = (GLfloat)(p[4 * c] + sep * p[4 * c + 2] - sep * conv * p[4 * c + 3]);
    return 1;
}

void demo_view_slanted(GLfloat p[16]) { move_slanted(p); }

void demo_slanted_done(void)
{
    GLfloat p[16];
    glGetFloatv(GL_PROJECTION_MATRIX, p);
    if (move_slanted(p))
        glLoadMatrixf(p);
}

static void load_view(int infinitely_far)
{
    GLfloat p[16];
    GLint mode;
    glGetFloatv(GL_PROJECTION_MATRIX, p);
    if (!move_view(p, infinitely_far))
        return;
    glGetIntegerv(GL_MATRIX_MODE, &mode);
    glMatrixMode(GL_PROJECTION);
    glLoadMatrixf(p);
    glMatrixMode((GLenum)mode);
}

void demo_projection_done(void) { load_view(0); }

void demo_flat_done(void)
{
    GLfloat p[16];
    GLint mode;
    double sep = hud_depth * last_separation;
    if (sep == 0.0)
        return;
    glGetFloatv(GL_PROJECTION_MATRIX, p);
    for (int c = 0; c < 4; c++)
        p[4 * c] = (GLfloat)(p[4 * c] + sep * p[4 * c + 3]);
    glGetIntegerv(GL_MATRIX_MODE, &mode);
    glMatrixMode(GL_PROJECTION);
    glLoadMatrixf(p);
    glMatrixMode((GLenum)mode);
}

static void perspective(double fovy, double aspect, double z_near, double z_far, int infinitely_far)
{
    double h = z_near * tan(fovy * M_PI / 360.0), w = h * aspect;
    GLint mode;
    glGetIntegerv(GL_MATRIX_MODE, &mode);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-w, w, -h, h, z_near, z_far);
    load_view(infinitely_far);
    glMatrixMode((GLenum)mode);
}

void demo_perspective(double fovy, double aspect, double z_near, double z_far) { perspective(fovy, aspect, z_near, z_far, 0); }

void demo_perspective_sky(double fovy, double aspect, double z_near, double z_far) { perspective(fovy, aspect, z_near, z_far, 1); }

/* ---- options ---- */

static void usage(void)
{
    printf("usage: %s [options]\n"
           "  --api glx|egl|osmesa   window system (default %s)\n"
           "  --surface window|pbuffer  egl only; default: window where there is a DISPLAY\n"
           "  --frames N             stop after N frames (default: never in a window without --dump, else 60)\n"
           "  --size WxH             size of the picture (default 512x384)\n"
           "  --view i/N             draw view i of N, 0 the leftmost\n"
           "  --eye-spacing K        distance of neighbouring cameras (default 0.3)\n"
           "  --focal-depth X        depth that keeps its place in all views (default 8)\n"
           "  --hud-depth D          flat displays: 0 on the screen (default), 1 infinitely far, below 0 nearer\n"
           "  --canvas WxH           size of the window (default: that of the picture)\n"
           "  --offset X,Y           lower left corner of the picture in the window (default 0,0)\n"
           "  --dump FILE.png        write the last frame; with %%d in the name, every frame\n"
           "  --samples S            multisampled (glx, egl)\n"
           "  --srgb                 sRGB-capable surface, with GL_FRAMEBUFFER_SRGB on (glx, egl)\n"
           "  --check                fail with status 3 after a frame that raised a GL error\n"
           "  --profile core|compatibility|es2|es3  of the context: OpenGL 3.3 core, the default one, OpenGL ES (egl) (default\n"
           "                         compatibility)\n"
           "  --unread               frames end with glReadBuffer(GL_NONE) (glx, egl)\n"
           "  --time                 print the median milliseconds per frame on stderr\n"
           "  --bench                read numbers of frames from stdin, draw so many, print the times of each\n",
           program, api->name);
    for (const struct demo_option *o = demo_options; o->name; o++) {
        const char *value = (const char *[]){"", " N", " NAME"}[o->takes];
        printf("  %s%s%*s%s\n", o->name, value, (int)(23 - strlen(o->name) - strlen(value)), "", o->help);
    }
    exit(0);
}

static double number(const char *option, const char *text)
{
    char *end;
    double v = strtod(text, &end);
    if (end == text || *end || !isfinite(v))
        demo_fail(2, "%s: not a number: %s", option, text);
    return v;
}

static int integer(const char *option, const char *text, int least)
{
    char *end;
    errno = 0;
    long v = strtol(text, &end, 10);
    if (end == text || *end || errno || v < least || v > INT_MAX)
        demo_fail(2, "%s: not a whole number of at least %d: %s", option, least, text);
    return (int)v;
}

static void pair(const char *option, const char *text, char separator, int *a, int *b)
{
    char used, rest;
    if (sscanf(text, "%d%c%d%c", a, &used, b, &rest) != 3 || used != separator)
        demo_fail(2, "%s: not of the form A%cB: %s", option, separator, text);
}

static int own_option(const char *name, const char *value)
{
    for (const struct demo_option *o = demo_options; o->name; o++) {
        if (strcmp(o->name, name))
            continue;
        if (o->takes && !value)
            demo_fail(2, "%s needs a value", name);
        if (o->takes == DEMO_WORD)
            *(const char **)o->value = value;
        else
            *(int *)o->value = o->takes ? integer(name, value, 1) : 1;
        return o->takes ? 2 : 1;
    }
    return 0;
}

static void parse(int argc, char **argv)
{
    int canvas = 0, help = 0;
    for (int i = 1; i < argc; i++) {
        const char *o = argv[i], *v = i + 1 < argc ? argv[i + 1] : NULL;
        int own = own_option(o, v);
        if (own) { i += own - 1; continue; }
        if (!strcmp(o, "--srgb")) { window.srgb = 1; continue; }
        if (!strcmp(o, "--check")) { check = 1; continue; }
        if (!strcmp(o, "--unread")) { unread = 1; continue; }
        if (!strcmp(o, "--time")) { timing = 1; continue; }
        if (!strcmp(o, "--bench")) { bench = 1; continue; }
        if (!strcmp(o, "--help")) { help = 1; continue; }
        static const char *valued[] = {"--api", "--surface", "--frames", "--size", "--view", "--eye-spacing",
            "--focal-depth", "--hud-depth", "--canvas", "--offset", "--dump", "--samples", "--profile", NULL};
        int known = 0;
        for (const char **k = valued; *k; k++)
            known |= !strcmp(o, *k);
        if (!known)
            demo_fail(2, "unknown option %s (see --help)", o);
        if (!v)
            demo_fail(2, "%s needs a value", o);
        i++;
        if (!strcmp(o, "--api")) {
            api_name = v;
        } else if (!strcmp(o, "--surface")) {
            if (strcmp(v, "window") && strcmp(v, "pbuffer"))
                demo_fail(2, "--surface: window or pbuffer, not %s", v);
            window.pbuffer = !strcmp(v, "pbuffer");
        } else if (!strcmp(o, "--frames")) {
            frames = integer(o, v, 1);
        } else if (!strcmp(o, "--size")) {
            pair(o, v, 'x', &demo_width, &demo_height);
        } else if (!strcmp(o, "--view")) {
            pair(o, v, '/', &view_index, &view_count);
        } else if (!strcmp(o, "--eye-spacing")) {
            eye_spacing = number(o, v);
        } else if (!strcmp(o, "--focal-depth")) {
            focal_depth = number(o, v);
        } else if (!strcmp(o, "--hud-depth")) {
            hud_depth = number(o, v);
        } else if (!strcmp(o, "--canvas")) {
            pair(o, v, 'x', &window.width, &window.height);
            canvas = 1;
        } else if (!strcmp(o, "--offset")) {
            pair(o, v, ',', &demo_x, &demo_y);
        } else if (!strcmp(o, "--dump")) {
            dump = v;
        } else if (!strcmp(o, "--profile")) {
            int es = !strcmp(v, "es2") ? 2 : !strcmp(v, "es3") ? 3 : 0;
            if (!es && strcmp(v, "core") && strcmp(v, "compatibility"))
                demo_fail(2, "--profile: core, compatibility, es2 or es3, not %s", v);
            window.core = !strcmp(v, "core");
            window.es = demo_es = es;
        } else {
            window.samples = integer(o, v, 0);
        }
    }
    if (!canvas) {
        window.width = demo_width;
        window.height = demo_height;
    }
    if (demo_width < 1 || demo_height < 1)
        demo_fail(2, "--size: must be at least 1x1");
    if (view_count < 1 || view_index < 0 || view_index >= view_count)
        demo_fail(2, "--view: i/N with 0 <= i < N");
    if (!(focal_depth > 0.0))
        demo_fail(2, "--focal-depth: must be above 0");
    if (demo_x < 0 || demo_y < 0 || demo_x > window.width - demo_width || demo_y > window.height - demo_height)
        demo_fail(2, "the picture does not fit into the canvas");
    tiled = demo_x || demo_y || window.width != demo_width || window.height != demo_height;
#ifdef DEMO_OSMESA
    api = &demo_osmesa;
    if (api_name && strcmp(api_name, "osmesa"))
        demo_fail(2, "this build draws with OSMesa only");
    if (window.samples)
        demo_fail(2, "--samples: OSMesa has no multisampling");
#else
    api = &demo_glx;
    if (api_name && !strcmp(api_name, "osmesa")) { /* OSMesa is another libGL, so it is another program */
        char path[PATH_MAX + 16];
        ssize_t n = readlink("/proc/self/exe", path, PATH_MAX);
        if (n > 0) {
            strcpy(path + n, ".osmesa");
            execv(path, argv);
        }
        demo_fail(1, "cannot start %s.osmesa: %s", program, strerror(errno));
    }
#ifndef DEMO_DLOPEN
    if (api_name && !strcmp(api_name, "egl"))
        api = &demo_egl;
#endif
    if (api_name && strcmp(api_name, api->name))
        demo_fail(2, "--api: unknown: %s", api_name);
#endif
    if (window.pbuffer >= 0 && strcmp(api->name, "egl"))
        demo_fail(2, "--surface: for --api egl only");
    if (demo_es && strcmp(api->name, "egl"))
        demo_fail(2, "--profile: OpenGL ES is for --api egl only");
    if (help)
        usage();
}

/* ---- the frame loop ---- */

static void write_dump(int frame)
{
    char path[PATH_MAX];
    const char *d = strstr(dump, "%d");
    if (d)
        snprintf(path, sizeof path, "%.*s%d%s", (int)(d - dump), dump, frame, d + 2);
    else
        snprintf(path, sizeof path, "%s", dump);
    size_t pixels = (size_t)demo_width * (size_t)demo_height;
    unsigned char *rgb = malloc(pixels * 4);
    if (!rgb)
        demo_fail(1, "out of memory");
    GLint alignment; /* saved here, since core contexts have no glPushClientAttrib */
    glGetIntegerv(GL_PACK_ALIGNMENT, &alignment);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(demo_x, demo_y, demo_width, demo_height, demo_es ? GL_RGBA : GL_RGB, GL_UNSIGNED_BYTE, rgb);
    for (size_t k = 0; demo_es && k < pixels; k++) /* OpenGL ES reads four components */
        memmove(rgb + 3 * k, rgb + 4 * k, 3);
    glPixelStorei(GL_PACK_ALIGNMENT, alignment);
    if (demo_write_png(path, demo_width, demo_height, rgb))
        demo_fail(1, "cannot write %s", path);
    free(rgb);
}

static double now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(int argc, char **argv)
{
    const char *slash = strrchr(argv[0], '/');
    program = slash ? slash + 1 : argv[0];
    parse(argc, argv);
    window.title = program;
    window.accumulation = demo_accumulation;
    api->open(&window);
    if (frames < 0)
        frames = dump || window.pbuffer == 1 || !strcmp(api->name, "osmesa") ? 60 : INT_MAX;

    enum { KEPT = 100000 };
    double *times = timing ? malloc(KEPT * sizeof *times) : NULL;
    int timed = 0, quit = 0;
    if (window.srgb)
        glEnable(GL_FRAMEBUFFER_SRGB);
    demo_scissor_off();
    demo_setup();
    if (bench) {
        demo_bench(api);
        api->close();
        return 0;
    }
    double last = now_ms();
    for (int frame = 0; frame < frames && !quit; frame++) {
        demo_frame(frame);
        GLenum error;
        int bad = 0;
        while (check && (error = glGetError()) && ++bad < 10)
            fprintf(stderr, "%s: GL error 0x%04x in frame %d\n", program, error, frame);
        if (bad)
            exit(3);
        if (dump && (strstr(dump, "%d") || frame == frames - 1))
            write_dump(frame);
        if (unread)
            glReadBuffer(GL_NONE);
        quit = api->frame_end();
        if (unread)
            glReadBuffer(GL_BACK);
        double now = now_ms();
        if (times && frame && timed < KEPT) /* the first frame compiles shaders and does not count */
            times[timed++] = now - last;
        last = now;
    }
    if (timed) {
        qsort(times, (size_t)timed, sizeof *times, ascending);
        fprintf(stderr, "ms_per_frame median %.3f\n", times[timed / 2]);
    }
    free(times);
    api->close();
    return 0;
}
