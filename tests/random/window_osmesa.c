/* Draws into memory, with an accumulation buffer. A frame ends with glFinish. */
#include "random.h"
#include <GL/osmesa.h>

static unsigned char pixels[8][WIDTH * HEIGHT * 4];

static void memory_open(int drawables) { (void)drawables; }
static void *memory_create(void *share) { return OSMesaCreateContextExt(OSMESA_RGBA, 24, 8, 16, share); }

static void memory_current(void *handle, int draw, int read)
{
    (void)read;
    void *buffer = handle ? pixels[draw] : NULL;
    if (!OSMesaMakeCurrent(handle, buffer, GL_UNSIGNED_BYTE, handle ? WIDTH : 0, handle ? HEIGHT : 0) && handle)
        fail("OSMesaMakeCurrent failed");
}

static void memory_destroy(void *handle) { OSMesaDestroyContext(handle); }
static void memory_swap(int drawable) { (void)drawable; glFinish(); }

const struct window_api window_osmesa = {"osmesa", memory_open, memory_create, memory_current, memory_destroy, memory_swap, 0, 0};
