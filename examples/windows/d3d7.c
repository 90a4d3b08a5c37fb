/* The scene by Direct3D 7: fixed function, or vertices that the program transforms itself; in a window, or full. */
#define COBJMACROS
#include "surfaces.h"

static IDirect3DDevice7 *device;

static void box(const matrix place, const matrix camera, int number)
{
    struct fixed_vertex {
        float x, y, z;
        DWORD colour;
    } fixed[36];
    if (software) {
        D3DTLVERTEX all[36];
        transformed(all, place, camera, number);
        IDirect3DDevice7_DrawPrimitive(device, D3DPT_TRIANGLELIST, D3DFVF_TLVERTEX, all, 36, 0);
        return;
    }
    D3DMATRIX world;
    memcpy(&world, place, sizeof world);
    for (int i = 0; i < 36; i++) {
        corner(i, &fixed[i].x);
        fixed[i].colour = colour_of(number, i);
    }
    IDirect3DDevice7_SetTransform(device, D3DTRANSFORMSTATE_WORLD, &world);
    IDirect3DDevice7_DrawPrimitive(device, D3DPT_TRIANGLELIST, D3DFVF_XYZ | D3DFVF_DIFFUSE, fixed, 36, 0);
}

static void frame(int number)
{
    matrix p, place;
    D3DMATRIX m;
    IDirect3DDevice7_Clear(device, 0, NULL, D3DCLEAR_TARGET | D3DCLEAR_ZBUFFER, 0xff101828, 1.0f, 0);
    check(IDirect3DDevice7_BeginScene(device), "BeginScene");
    projection(p);
    memcpy(&m, p, sizeof m);
    if (!software)
        IDirect3DDevice7_SetTransform(device, D3DTRANSFORMSTATE_PROJECTION, &m);
    IDirect3DDevice7_SetRenderState(device, D3DRENDERSTATE_ZENABLE, D3DZB_TRUE);
    for (int i = 0; i < 6; i++) {
        place_of(place, number, i);
        box(place, p, i);
    }
    IDirect3DDevice7_SetRenderState(device, D3DRENDERSTATE_ZENABLE, D3DZB_FALSE);
    IDirect3DDevice7_DrawPrimitive(device, D3DPT_TRIANGLELIST, D3DFVF_XYZRHW | D3DFVF_DIFFUSE, (void *)sign, 6, 0);
    IDirect3DDevice7_EndScene(device);
}

int main(int count, char **words)
{
    HWND window = begin(count, words);
    IDirectDraw7 *draw;
    IDirect3D7 *d3d;
    IDirectDrawSurface7 *front, *back, *depth;
    DDSURFACEDESC2 about;
    DDPIXELFORMAT format = {0};
    check(DirectDrawCreateEx(NULL, (void **)&draw, &IID_IDirectDraw7, NULL), "DirectDrawCreateEx");
    check(IDirectDraw7_QueryInterface(draw, &IID_IDirect3D7, (void **)&d3d), "no Direct3D 7");
    check(IDirectDraw7_SetCooperativeLevel(draw, window, full ? DDSCL_EXCLUSIVE | DDSCL_FULLSCREEN : DDSCL_NORMAL), "SetCooperativeLevel");
    if (full)
        check(IDirectDraw7_SetDisplayMode(draw, WIDTH, HEIGHT, 32, 0, 0), "SetDisplayMode");
    describe_front(&about);
    check(IDirectDraw7_CreateSurface(draw, &about, &front, NULL), "the front");
    if (full) {
        DDSCAPS2 behind = {.dwCaps = DDSCAPS_BACKBUFFER};
        check(IDirectDrawSurface7_GetAttachedSurface(front, &behind, &back), "the back");
    } else {
        IDirectDrawClipper *clipper;
        check(IDirectDraw7_CreateClipper(draw, 0, &clipper, NULL), "CreateClipper");
        IDirectDrawClipper_SetHWnd(clipper, 0, window);
        IDirectDrawSurface7_SetClipper(front, clipper);
        describe(&about, DDSCAPS_OFFSCREENPLAIN | DDSCAPS_3DDEVICE | DDSCAPS_VIDEOMEMORY);
        check(IDirectDraw7_CreateSurface(draw, &about, &back, NULL), "the back");
    }
    IDirect3D7_EnumZBufferFormats(d3d, &IID_IDirect3DHALDevice, choose, &format);
    describe(&about, DDSCAPS_ZBUFFER | DDSCAPS_VIDEOMEMORY);
    about.dwFlags |= DDSD_PIXELFORMAT;
    about.ddpfPixelFormat = format;
    check(IDirectDraw7_CreateSurface(draw, &about, &depth, NULL), "the depth");
    check(IDirectDrawSurface7_AddAttachedSurface(back, depth), "AddAttachedSurface");
    check(IDirect3D7_CreateDevice(d3d, &IID_IDirect3DHALDevice, back, &device), "CreateDevice");
    D3DVIEWPORT7 area = {0, 0, WIDTH, HEIGHT, 0.0f, 1.0f};
    IDirect3DDevice7_SetViewport(device, &area);
    IDirect3DDevice7_SetRenderState(device, D3DRENDERSTATE_LIGHTING, FALSE);
    IDirect3DDevice7_SetRenderState(device, D3DRENDERSTATE_CULLMODE, D3DCULL_NONE);
    for (int i = 0; i < frames; i++) {
        RECT whole = {0, 0, WIDTH, HEIGHT};
        answer();
        frame(i);
        if (full)
            check(IDirectDrawSurface7_Flip(front, NULL, DDFLIP_WAIT), "Flip");
        else
            check(IDirectDrawSurface7_Blt(front, &whole, back, &whole, DDBLT_WAIT, NULL), "Blt");
    }
    /* Wine draws in a thread of its own, and ends it here with all frames drawn. */
    IDirect3DDevice7_Release(device);
    IDirectDrawSurface7_Release(depth);
    IDirectDrawSurface7_Release(back);
    IDirectDrawSurface7_Release(front);
    IDirect3D7_Release(d3d);
    IDirectDraw7_Release(draw);
    return 0;
}
