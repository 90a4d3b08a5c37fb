/* --bench: frames on request, so that several programs can be kept alive and drawn in turns.
 *
 * First come three lines: `renderer NAME`, `version TEXT`, `ready`. Then each line of stdin is a number N; N frames are
 * drawn, and one line answers `wall T1 ... TN cpu T1 ... TN` in ns: from before the drawing to after the swap and a
 * glFinish, by CLOCK_MONOTONIC; and what this thread has computed in between. Where the driver is hardware with timer
 * queries, ` gpu T1 ... TN` follows: from the first to the last command of the frame by GL_TIMESTAMP. The end of stdin
 * is the end. */
#include "demo.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST = 10000 };

static PFNGLQUERYCOUNTERPROC query_counter;
static PFNGLGETQUERYOBJECTUI64VPROC query_result;
static GLuint queries[2];

static long long clock_ns(clockid_t which)
{
    struct timespec t;
    clock_gettime(which, &t);
    return (long long)t.tv_sec * 1000000000 + t.tv_nsec;
}

/* Drivers that draw on the CPU answer timer queries as well, but not with GPU times. */
static int is_software(const char *renderer)
{
    static const char *const names[] = {"llvmpipe", "softpipe", "swrast", "Software", "SWR", NULL};
    for (const char *const *n = names; *n; n++)
        if (strstr(renderer, *n))
            return 1;
    return 0;
}

static void find_gpu_clock(const char *renderer)
{
    /* Timer queries are part of OpenGL 3.3, whose core contexts have no such string. */
    int part = atof((const char *)glGetString(GL_VERSION)) >= 3.3;
    const char *extensions = part ? NULL : (const char *)glGetString(GL_EXTENSIONS);
    GLint bits = 0;
    if (is_software(renderer) || !(part || (extensions && strstr(extensions, "GL_ARB_timer_query"))))
        return;
    ((PFNGLGETQUERYIVPROC)demo_proc("glGetQueryiv"))(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
    if (!bits)
        return;
    query_counter = (PFNGLQUERYCOUNTERPROC)demo_proc("glQueryCounter");
    query_result = (PFNGLGETQUERYOBJECTUI64VPROC)demo_proc("glGetQueryObjectui64v");
    ((PFNGLGENQUERIESPROC)demo_proc("glGenQueries"))(2, queries);
}

static void list(const char *name, const long long *times, int count)
{
    printf("%s", name);
    for (int i = 0; i < count; i++)
        printf(" %lld", times[i]);
}

void demo_bench(const struct demo_api *api)
{
    static long long wall[MOST], cpu[MOST], gpu[MOST];
    const char *renderer = (const char *)glGetString(GL_RENDERER);
    char line[64], *end;
    int frame = 0;
    find_gpu_clock(renderer);
    glFinish();
    printf("renderer %s\nversion %s\nready\n", renderer, (const char *)glGetString(GL_VERSION));
    fflush(stdout);
    while (fgets(line, sizeof line, stdin)) {
        errno = 0;
        long count = strtol(line, &end, 10);
        if (end == line || *end != '\n' || errno || count < 1 || count > MOST)
            demo_fail(2, "--bench: not a number of frames from 1 to %d: %s", MOST, line);
        if (api->raise)
            api->raise();
        for (int i = 0; i < count; i++) {
            long long cpu_start = clock_ns(CLOCK_THREAD_CPUTIME_ID), start = clock_ns(CLOCK_MONOTONIC);
            if (query_counter)
                query_counter(queries[0], GL_TIMESTAMP);
            demo_frame(frame++);
            api->frame_end();
            if (query_counter)
                query_counter(queries[1], GL_TIMESTAMP);
            glFinish();
            wall[i] = clock_ns(CLOCK_MONOTONIC) - start;
            cpu[i] = clock_ns(CLOCK_THREAD_CPUTIME_ID) - cpu_start;
            if (query_counter) {
                GLuint64 from, to;
                query_result(queries[0], GL_QUERY_RESULT, &from);
                query_result(queries[1], GL_QUERY_RESULT, &to);
                gpu[i] = (long long)(to - from);
            }
        }
        list("wall", wall, (int)count);
        list(" cpu", cpu, (int)count);
        if (query_counter)
            list(" gpu", gpu, (int)count);
        putchar('\n');
        fflush(stdout);
    }
}
