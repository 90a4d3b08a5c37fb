/* A program that frees the end of its heap and gets it again: prints how many pages the system had to give it the second time. */
#define _GNU_SOURCE
#include "surface.h"
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

enum { COUNT = 512, SIZE = 65536 };

static void use(void)
{
    static char *blocks[COUNT];
    for (int i = 0; i < COUNT; i++) {
        blocks[i] = malloc(SIZE);
        memset(blocks[i], 1, SIZE);
    }
    for (int i = 0; i < COUNT; i++)
        free(blocks[i]);
}

int main(void)
{
    if (!open_surface() || !new_context(EGL_NO_CONTEXT))
        return 77;
    struct rusage before, after;
    use();
    getrusage(RUSAGE_THREAD, &before);
    use();
    getrusage(RUSAGE_THREAD, &after);
    printf("%ld\n", after.ru_minflt - before.ru_minflt);
    return 0;
}
