/* The scene by Direct3D 9: fixed function, or a vertex shader whose camera lies in vec4 constants. */
#define COBJMACROS
#include "shader.h"
#include <d3d9.h>

struct vertex {
    float x, y, z;
    float bone;
    DWORD colour;
};
struct fixed_vertex {
    float x, y, z;
    DWORD colour;
};

static IDirect3DDevice9 *device;

static void box(const matrix place, const matrix camera, int number)
{
    if (!*shader) {
        struct fixed_vertex all[36];
        D3DMATRIX world;
        memcpy(&world, place, sizeof world);
        IDirect3DDevice9_SetTransform(device, D3DTS_WORLD, &world);
        for (int i = 0; i < 36; i++) {
            corner(i, &all[i].x);
            all[i].colour = colour_of(number, i);
        }
        IDirect3DDevice9_SetFVF(device, D3DFVF_XYZ | D3DFVF_DIFFUSE);
        IDirect3DDevice9_DrawPrimitiveUP(device, D3DPT_TRIANGLELIST, 12, all, sizeof all[0]);
        return;
    }
    struct vertex all[36];
    float bone[12], constants[16];
    for (int i = 0; i < 36; i++) {
        corner(i, &all[i].x);
        all[i].bone = (float)(3 * (number % BONES));
        all[i].colour = colour_of(number, i);
    }
    constants_of(place, camera, bone, constants);
    if (!strcmp(shader, "indexed"))
        IDirect3DDevice9_SetVertexShaderConstantF(device, 20 + 3 * (number % BONES), bone, 3);
    IDirect3DDevice9_SetVertexShaderConstantF(device, offset, constants, 4);
    IDirect3DDevice9_DrawPrimitiveUP(device, D3DPT_TRIANGLELIST, 12, all, sizeof all[0]);
}

static void frame(int number)
{
    matrix p, place;
    IDirect3DDevice9_Clear(device, 0, NULL, D3DCLEAR_TARGET | D3DCLEAR_ZBUFFER, 0xff101828, 1.0f, 0);
    check(IDirect3DDevice9_BeginScene(device), "BeginScene");
    projection(p);
    if (!*shader) {
        D3DMATRIX m;
        memcpy(&m, p, sizeof m);
        IDirect3DDevice9_SetTransform(device, D3DTS_PROJECTION, &m);
    }
    IDirect3DDevice9_SetRenderState(device, D3DRS_ZENABLE, D3DZB_TRUE);
    for (int i = 0; i < 6; i++) {
        place_of(place, number, i);
        box(place, p, i);
    }
    IDirect3DDevice9_SetRenderState(device, D3DRS_ZENABLE, D3DZB_FALSE);
    IDirect3DVertexShader9 *bound = NULL;
    IDirect3DVertexDeclaration9 *declared = NULL;
    if (*shader) {
        IDirect3DDevice9_GetVertexShader(device, &bound);
        IDirect3DDevice9_GetVertexDeclaration(device, &declared);
        IDirect3DDevice9_SetVertexShader(device, NULL);
    }
    IDirect3DDevice9_SetFVF(device, D3DFVF_XYZRHW | D3DFVF_DIFFUSE);
    IDirect3DDevice9_DrawPrimitiveUP(device, D3DPT_TRIANGLELIST, 2, sign, sizeof sign[0]);
    if (*shader) {
        IDirect3DDevice9_SetVertexShader(device, bound);
        IDirect3DDevice9_SetVertexDeclaration(device, declared);
        IDirect3DVertexShader9_Release(bound);
        IDirect3DVertexDeclaration9_Release(declared);
    }
    IDirect3DDevice9_EndScene(device);
    check(IDirect3DDevice9_Present(device, NULL, NULL, NULL, NULL), "Present");
}

int main(int count, char **words)
{
    HWND window = begin(count, words);
    IDirect3D9 *d3d = Direct3DCreate9(D3D_SDK_VERSION);
    if (!d3d)
        return fprintf(stderr, "no Direct3D 9\n"), 1;
    D3DPRESENT_PARAMETERS how = {0};
    how.Windowed = TRUE;
    how.SwapEffect = D3DSWAPEFFECT_DISCARD;
    how.hDeviceWindow = window;
    how.BackBufferWidth = WIDTH;
    how.BackBufferHeight = HEIGHT;
    how.EnableAutoDepthStencil = TRUE;
    how.AutoDepthStencilFormat = D3DFMT_D24S8;
    check(IDirect3D9_CreateDevice(d3d, D3DADAPTER_DEFAULT, D3DDEVTYPE_HAL, window, D3DCREATE_HARDWARE_VERTEXPROCESSING, &how, &device), "CreateDevice");
    IDirect3DDevice9_SetRenderState(device, D3DRS_LIGHTING, FALSE);
    IDirect3DDevice9_SetRenderState(device, D3DRS_CULLMODE, D3DCULL_NONE);
    if (*shader) {
        static const D3DVERTEXELEMENT9 elements[] = {
            {0, 0, D3DDECLTYPE_FLOAT3, 0, D3DDECLUSAGE_POSITION, 0}, {0, 12, D3DDECLTYPE_FLOAT1, 0, D3DDECLUSAGE_TEXCOORD, 0},
            {0, 16, D3DDECLTYPE_D3DCOLOR, 0, D3DDECLUSAGE_COLOR, 0}, D3DDECL_END()};
        IDirect3DVertexDeclaration9 *declaration;
        IDirect3DVertexShader9 *made;
        check(IDirect3DDevice9_CreateVertexDeclaration(device, elements, &declaration), "CreateVertexDeclaration");
        check(IDirect3DDevice9_CreateVertexShader(device, assemble(1), &made), "CreateVertexShader");
        IDirect3DDevice9_SetVertexDeclaration(device, declaration);
        IDirect3DDevice9_SetVertexShader(device, made);
    }
    for (int i = 0; i < frames; i++) {
        answer();
        frame(i);
    }
    return 0;
}
