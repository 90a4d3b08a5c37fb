/* The scene by Direct3D 3, or by the execute buffers of the first Direct3D: fixed function, or vertices that the program transforms itself; in a window, or full. */
#define COBJMACROS
#include "surfaces.h"

enum { VERTICES = 6 * 36 + 6, ROOM = VERTICES * sizeof(D3DTLVERTEX) + 8192 };

static IDirect3DDevice3 *device;
static IDirect3DViewport3 *viewport;
/* What --execute has. */
static IDirect3DDevice *first;
static IDirect3DExecuteBuffer *buffer;
static D3DMATRIXHANDLE worlds[6], camera_of_all;

static void box(const matrix place, const matrix camera, int number)
{
    struct fixed_vertex {
        float x, y, z;
        DWORD colour;
    } fixed[36];
    if (software) {
        D3DTLVERTEX all[36];
        transformed(all, place, camera, number);
        IDirect3DDevice3_DrawPrimitive(device, D3DPT_TRIANGLELIST, D3DFVF_TLVERTEX, all, 36, 0);
        return;
    }
    D3DMATRIX world;
    memcpy(&world, place, sizeof world);
    for (int i = 0; i < 36; i++) {
        corner(i, &fixed[i].x);
        fixed[i].colour = colour_of(number, i);
    }
    IDirect3DDevice3_SetTransform(device, D3DTRANSFORMSTATE_WORLD, &world);
    IDirect3DDevice3_DrawPrimitive(device, D3DPT_TRIANGLELIST, D3DFVF_XYZ | D3DFVF_DIFFUSE, fixed, 36, 0);
}

static void frame(int number)
{
    matrix p, place;
    D3DMATRIX m;
    check(IDirect3DDevice3_BeginScene(device), "BeginScene");
    projection(p);
    memcpy(&m, p, sizeof m);
    if (!software)
        IDirect3DDevice3_SetTransform(device, D3DTRANSFORMSTATE_PROJECTION, &m);
    IDirect3DDevice3_SetRenderState(device, D3DRENDERSTATE_CULLMODE, D3DCULL_NONE);
    IDirect3DDevice3_SetRenderState(device, D3DRENDERSTATE_ZENABLE, D3DZB_TRUE);
    for (int i = 0; i < 6; i++) {
        place_of(place, number, i);
        box(place, p, i);
    }
    IDirect3DDevice3_SetRenderState(device, D3DRENDERSTATE_ZENABLE, D3DZB_FALSE);
    IDirect3DDevice3_DrawPrimitive(device, D3DPT_TRIANGLELIST, D3DFVF_XYZRHW | D3DFVF_DIFFUSE, (void *)sign, 6, 0);
    IDirect3DDevice3_EndScene(device);
}

/* Where the next instruction goes. */
static BYTE *next;

static void *instruction(D3DOPCODE op, BYTE size, WORD count)
{
    D3DINSTRUCTION header = {op, size, count};
    BYTE *operands = next + sizeof header;
    memcpy(next, &header, sizeof header);
    next = operands + size * count;
    return operands;
}

static void state(D3DOPCODE op, DWORD which, DWORD value)
{
    D3DSTATE *operand = instruction(op, sizeof(D3DSTATE), 1);
    operand->drstRenderStateType = which;
    operand->dwArg[0] = value;
}

/* Puts the vertices from start on through the matrices, or copies them, and draws them. */
static void triangles(DWORD how, int start, int count)
{
    D3DPROCESSVERTICES *process = instruction(D3DOP_PROCESSVERTICES, sizeof *process, 1);
    memset(process, 0, sizeof *process);
    process->dwFlags = how;
    process->wStart = process->wDest = start;
    process->dwCount = count;
    D3DTRIANGLE *all = instruction(D3DOP_TRIANGLE, sizeof *all, count / 3);
    for (int i = 0; i < count / 3; i++) {
        all[i].v1 = start + 3 * i;
        all[i].v2 = start + 3 * i + 1;
        all[i].v3 = start + 3 * i + 2;
        all[i].wFlags = D3DTRIFLAG_EDGEENABLETRIANGLE;
    }
}

static void executed_frame(int number)
{
    matrix p, place;
    D3DMATRIX m;
    D3DEXECUTEBUFFERDESC about = {.dwSize = sizeof about};
    D3DEXECUTEDATA data = {.dwSize = sizeof data};
    projection(p);
    memcpy(&m, p, sizeof m);
    IDirect3DDevice_SetMatrix(first, camera_of_all, &m);
    check(IDirect3DExecuteBuffer_Lock(buffer, &about), "Lock");
    D3DTLVERTEX *vertices = about.lpData;
    BYTE *start = next = (BYTE *)(vertices + VERTICES);
    if (!software)
        state(D3DOP_STATETRANSFORM, D3DTRANSFORMSTATE_PROJECTION, camera_of_all);
    state(D3DOP_STATERENDER, D3DRENDERSTATE_CULLMODE, D3DCULL_NONE);
    state(D3DOP_STATERENDER, D3DRENDERSTATE_ZENABLE, TRUE);
    for (int i = 0; i < 6; i++) {
        place_of(place, number, i);
        if (software) {
            transformed(vertices + 36 * i, place, p, i);
            triangles(D3DPROCESSVERTICES_COPY, 36 * i, 36);
            continue;
        }
        D3DLVERTEX *lit = (D3DLVERTEX *)vertices + 36 * i;
        memset(lit, 0, 36 * sizeof *lit);
        for (int k = 0; k < 36; k++) {
            corner(k, &lit[k].x);
            lit[k].color = colour_of(i, k);
        }
        memcpy(&m, place, sizeof m);
        IDirect3DDevice_SetMatrix(first, worlds[i], &m);
        state(D3DOP_STATETRANSFORM, D3DTRANSFORMSTATE_WORLD, worlds[i]);
        triangles(D3DPROCESSVERTICES_TRANSFORM, 36 * i, 36);
    }
    state(D3DOP_STATERENDER, D3DRENDERSTATE_ZENABLE, FALSE);
    sign_of(vertices + 6 * 36);
    triangles(D3DPROCESSVERTICES_COPY, 6 * 36, 6);
    instruction(D3DOP_EXIT, 0, 0);
    IDirect3DExecuteBuffer_Unlock(buffer);
    data.dwVertexCount = VERTICES;
    data.dwInstructionOffset = VERTICES * sizeof(D3DTLVERTEX);
    data.dwInstructionLength = next - start;
    check(IDirect3DExecuteBuffer_SetExecuteData(buffer, &data), "SetExecuteData");
    check(IDirect3DDevice_BeginScene(first), "BeginScene");
    check(IDirect3DDevice_Execute(first, buffer, (IDirect3DViewport *)viewport, D3DEXECUTE_CLIPPED), "Execute");
    IDirect3DDevice_EndScene(first);
}

/* The device of --execute, its buffer and its matrices. */
static void make_first(IDirectDrawSurface4 *back)
{
    IDirectDrawSurface *target;
    D3DEXECUTEBUFFERDESC about = {.dwSize = sizeof about, .dwFlags = D3DDEB_BUFSIZE, .dwBufferSize = ROOM};
    check(IDirectDrawSurface4_QueryInterface(back, &IID_IDirectDrawSurface, (void **)&target), "the first surface");
    check(IDirectDrawSurface_QueryInterface(target, &IID_IDirect3DHALDevice, (void **)&first), "the first device");
    IDirectDrawSurface_Release(target);
    check(IDirect3DDevice_CreateExecuteBuffer(first, &about, &buffer, NULL), "CreateExecuteBuffer");
    check(IDirect3DDevice_CreateMatrix(first, &camera_of_all), "CreateMatrix");
    for (int i = 0; i < 6; i++)
        check(IDirect3DDevice_CreateMatrix(first, &worlds[i]), "CreateMatrix");
    check(IDirect3DDevice_AddViewport(first, (IDirect3DViewport *)viewport), "AddViewport");
}

int main(int count, char **words)
{
    HWND window = begin(count, words);
    IDirectDraw *oldest;
    IDirectDraw4 *draw;
    IDirect3D3 *d3d;
    IDirectDrawSurface4 *front, *back, *depth;
    DDSURFACEDESC2 about;
    DDPIXELFORMAT format = {0};
    check(DirectDrawCreate(NULL, &oldest, NULL), "DirectDrawCreate");
    check(IDirectDraw_QueryInterface(oldest, &IID_IDirectDraw4, (void **)&draw), "no DirectDraw 4");
    check(IDirectDraw4_QueryInterface(draw, &IID_IDirect3D3, (void **)&d3d), "no Direct3D 3");
    check(IDirectDraw4_SetCooperativeLevel(draw, window, full ? DDSCL_EXCLUSIVE | DDSCL_FULLSCREEN : DDSCL_NORMAL), "SetCooperativeLevel");
    if (full)
        check(IDirectDraw4_SetDisplayMode(draw, WIDTH, HEIGHT, 32, 0, 0), "SetDisplayMode");
    describe_front(&about);
    check(IDirectDraw4_CreateSurface(draw, &about, &front, NULL), "the front");
    if (full) {
        DDSCAPS2 behind = {.dwCaps = DDSCAPS_BACKBUFFER};
        check(IDirectDrawSurface4_GetAttachedSurface(front, &behind, &back), "the back");
    } else {
        IDirectDrawClipper *clipper;
        check(IDirectDraw4_CreateClipper(draw, 0, &clipper, NULL), "CreateClipper");
        IDirectDrawClipper_SetHWnd(clipper, 0, window);
        IDirectDrawSurface4_SetClipper(front, clipper);
        describe(&about, DDSCAPS_OFFSCREENPLAIN | DDSCAPS_3DDEVICE | DDSCAPS_VIDEOMEMORY);
        check(IDirectDraw4_CreateSurface(draw, &about, &back, NULL), "the back");
    }
    IDirect3D3_EnumZBufferFormats(d3d, &IID_IDirect3DHALDevice, choose, &format);
    describe(&about, DDSCAPS_ZBUFFER | DDSCAPS_VIDEOMEMORY);
    about.dwFlags |= DDSD_PIXELFORMAT;
    about.ddpfPixelFormat = format;
    check(IDirectDraw4_CreateSurface(draw, &about, &depth, NULL), "the depth");
    check(IDirectDrawSurface4_AddAttachedSurface(back, depth), "AddAttachedSurface");
    check(IDirect3D3_CreateViewport(d3d, &viewport, NULL), "CreateViewport");
    if (execute)
        make_first(back);
    else {
        check(IDirect3D3_CreateDevice(d3d, &IID_IDirect3DHALDevice, back, &device, NULL), "CreateDevice");
        check(IDirect3DDevice3_AddViewport(device, viewport), "AddViewport");
        check(IDirect3DDevice3_SetCurrentViewport(device, viewport), "SetCurrentViewport");
    }
    /* x and y from -1 to 1. */
    D3DVIEWPORT2 area = {sizeof area, 0, 0, WIDTH, HEIGHT, -1.0f, 1.0f, 2.0f, 2.0f, 0.0f, 1.0f};
    check(IDirect3DViewport3_SetViewport2(viewport, &area), "SetViewport2");
    for (int i = 0; i < frames; i++) {
        RECT whole = {0, 0, WIDTH, HEIGHT};
        D3DRECT all = {{0}, {0}, {WIDTH}, {HEIGHT}};
        answer();
        check(IDirect3DViewport3_Clear2(viewport, 1, &all, D3DCLEAR_TARGET | D3DCLEAR_ZBUFFER, 0xff101828, 1.0f, 0), "Clear2");
        if (execute)
            executed_frame(i);
        else
            frame(i);
        if (full)
            check(IDirectDrawSurface4_Flip(front, NULL, DDFLIP_WAIT), "Flip");
        else
            check(IDirectDrawSurface4_Blt(front, &whole, back, &whole, DDBLT_WAIT, NULL), "Blt");
    }
    /* Wine draws in a thread of its own, and ends it here with all frames drawn. */
    IDirect3DViewport3_Release(viewport);
    if (execute) {
        IDirect3DExecuteBuffer_Release(buffer);
        IDirect3DDevice_Release(first);
    } else
        IDirect3DDevice3_Release(device);
    IDirectDrawSurface4_Release(depth);
    IDirectDrawSurface4_Release(back);
    IDirectDrawSurface4_Release(front);
    IDirect3D3_Release(d3d);
    IDirectDraw4_Release(draw);
    IDirectDraw_Release(oldest);
    return 0;
}
