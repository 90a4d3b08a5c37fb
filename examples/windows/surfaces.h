/* What the programs for DirectDraw share: the boxes in screen coordinates, and the formats of surfaces. */
#include "scene.h"
#include <ddraw.h>
#include <d3d.h>

/* A box whose vertices the program transforms itself. */
static void transformed(D3DTLVERTEX *all, const matrix place, const matrix camera, int number)
{
    matrix m;
    product(m, place, camera);
    for (int i = 0; i < 36; i++) {
        float p[3], clip[4];
        corner(i, p);
        for (int j = 0; j < 4; j++)
            clip[j] = p[0] * m[j] + p[1] * m[4 + j] + p[2] * m[8 + j] + m[12 + j];
        memset(&all[i], 0, sizeof all[i]);
        all[i].sx = (0.5f + 0.5f * clip[0] / clip[3]) * WIDTH;
        all[i].sy = (0.5f - 0.5f * clip[1] / clip[3]) * HEIGHT;
        all[i].sz = clip[2] / clip[3];
        all[i].rhw = 1.0f / clip[3];
        all[i].color = colour_of(number, i);
    }
}

/* The sign as vertices of Direct3D 3 and older. */
__attribute__((unused)) static void sign_of(D3DTLVERTEX *all)
{
    for (int i = 0; i < 6; i++) {
        memset(&all[i], 0, sizeof all[i]);
        memcpy(&all[i].sx, &sign[i].x, 4 * sizeof(float));
        all[i].color = sign[i].colour;
    }
}

/* The front of the screen, alone or, full, with a surface behind it to flip to. */
static void describe_front(DDSURFACEDESC2 *about)
{
    memset(about, 0, sizeof *about);
    about->dwSize = sizeof *about;
    about->dwFlags = DDSD_CAPS;
    about->ddsCaps.dwCaps = DDSCAPS_PRIMARYSURFACE;
    if (full) {
        about->dwFlags |= DDSD_BACKBUFFERCOUNT;
        about->ddsCaps.dwCaps |= DDSCAPS_FLIP | DDSCAPS_COMPLEX | DDSCAPS_3DDEVICE;
        about->dwBackBufferCount = 1;
    }
}

/* A surface of the window's size. */
static void describe(DDSURFACEDESC2 *about, DWORD what)
{
    memset(about, 0, sizeof *about);
    about->dwSize = sizeof *about;
    about->dwFlags = DDSD_CAPS | DDSD_WIDTH | DDSD_HEIGHT;
    about->ddsCaps.dwCaps = what;
    about->dwWidth = WIDTH;
    about->dwHeight = HEIGHT;
}

/* Takes the first format of depth that has 24 bits. */
static HRESULT WINAPI choose(DDPIXELFORMAT *format, void *chosen)
{
    if (format->dwZBitMask != 0x00ffffff && format->dwZBitMask != 0xffffff00)
        return DDENUMRET_OK;
    memcpy(chosen, format, sizeof *format);
    return DDENUMRET_CANCEL;
}
