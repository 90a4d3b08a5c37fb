/* Stands between the runtime of the sanitizer of addresses and the layer. The runtime asks for functions before it is ready, and the layer's dlsym, which a
 * sanitizer watches, must not answer then. x86-64 alone: the jump keeps the caller's address, by which the layer tells who asks. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stddef.h>

void __asan_init(void) __attribute__((weak));

typedef void *dlsym_t(void *, const char *);

static void *early(void *handle, const char *name)
{
    static dlsym_t *libc;
    if (!libc)
        libc = (dlsym_t *)dlvsym(RTLD_NEXT, "dlsym", "GLIBC_2.2.5");
    return libc(handle, name);
}

static dlsym_t *answers __attribute__((used)) = early;

__attribute__((naked)) void *dlsym(void *handle, const char *name)
{
    __asm__("jmp *answers(%rip)");
}

__attribute__((constructor)) static void ready(void)
{
    if (__asan_init)
        __asan_init();
    answers = (dlsym_t *)early(RTLD_NEXT, "dlsym");
}
