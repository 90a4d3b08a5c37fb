/* Stands between the runtime of a sanitizer and the layer. The runtime asks for functions before it is ready, and the layer's dlsym, which a
 * sanitizer watches, must not answer then. It also has what runtimes of threads of older compilers lack. x86-64 alone: the jump keeps the caller's address, by which the layer tells who asks. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stddef.h>
#include <string.h>

void __asan_init(void) __attribute__((weak));
void __tsan_init(void) __attribute__((weak));

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
    if (__tsan_init)
        __tsan_init();
    answers = (dlsym_t *)early(RTLD_NEXT, "dlsym");
}

/* Copies of memory in the layer, as the runtime of threads would see them. */
void __tsan_read_range(const void *from, size_t bytes) __attribute__((weak));
void __tsan_write_range(void *to, size_t bytes) __attribute__((weak));

void *__tsan_memmove(void *to, const void *from, size_t bytes)
{
    __tsan_read_range(from, bytes);
    __tsan_write_range(to, bytes);
    return memmove(to, from, bytes);
}

void *__tsan_memcpy(void *to, const void *from, size_t bytes)
{
    return __tsan_memmove(to, from, bytes);
}

void *__tsan_memset(void *to, int value, size_t bytes)
{
    __tsan_write_range(to, bytes);
    return memset(to, value, bytes);
}
