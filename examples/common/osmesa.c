/* Draws into memory, without any window system. A frame ends with glFinish. */
#include "demo.h"
#include <GL/osmesa.h>
#include <stdlib.h>

static OSMesaContext context;
static unsigned char *pixels;

static void open_buffer(struct demo_window *w)
{
    const int core[] = {OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 24, OSMESA_STENCIL_BITS, 8, OSMESA_PROFILE, OSMESA_CORE_PROFILE,
                        OSMESA_CONTEXT_MAJOR_VERSION, 3, OSMESA_CONTEXT_MINOR_VERSION, 3, 0};
    context = w->core ? OSMesaCreateContextAttribs(core, NULL)
                      : OSMesaCreateContextExt(OSMESA_RGBA, 24, 8, w->accumulation ? 16 : 0, NULL);
    pixels = calloc((size_t)w->width * (size_t)w->height, 4);
    if (!context || !pixels || !OSMesaMakeCurrent(context, pixels, GL_UNSIGNED_BYTE, w->width, w->height))
        demo_fail(1, "no OSMesa context");
}

static int frame_end(void)
{
    glFinish();
    return 0;
}

static demo_function proc(const char *name) { return (demo_function)OSMesaGetProcAddress(name); }

static void close_buffer(void)
{
    OSMesaDestroyContext(context);
    free(pixels);
}

const struct demo_api demo_osmesa = {"osmesa", open_buffer, frame_end, proc, close_buffer, NULL};
