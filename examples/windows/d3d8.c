/* The scene by Direct3D 8: fixed function, or a vertex shader whose camera lies in vec4 constants. */
#define COBJMACROS
#include "shader.h"
#include <d3d8.h>

struct vertex {
    float x, y, z;
    float bone;
    DWORD colour;
};

static IDirect3DDevice8 *device;
/* The vertex shader. */
static DWORD kind;

static void box(const matrix place, const matrix camera, int number)
{
    struct vertex all[36];
    struct fixed_vertex {
        float x, y, z;
        DWORD colour;
    } fixed[36];
    float bone[12], constants[16];
    for (int i = 0; i < 36; i++) {
        corner(i, &all[i].x);
        corner(i, &fixed[i].x);
        all[i].bone = (float)(3 * (number % BONES));
        all[i].colour = fixed[i].colour = colour_of(number, i);
    }
    if (!*shader) {
        D3DMATRIX world;
        memcpy(&world, place, sizeof world);
        IDirect3DDevice8_SetTransform(device, D3DTS_WORLD, &world);
        IDirect3DDevice8_SetVertexShader(device, D3DFVF_XYZ | D3DFVF_DIFFUSE);
        IDirect3DDevice8_DrawPrimitiveUP(device, D3DPT_TRIANGLELIST, 12, fixed, sizeof fixed[0]);
        return;
    }
    constants_of(place, camera, bone, constants);
    IDirect3DDevice8_SetVertexShader(device, kind);
    if (!strcmp(shader, "indexed"))
        IDirect3DDevice8_SetVertexShaderConstant(device, 20 + 3 * (number % BONES), bone, 3);
    IDirect3DDevice8_SetVertexShaderConstant(device, offset, constants, 4);
    IDirect3DDevice8_DrawPrimitiveUP(device, D3DPT_TRIANGLELIST, 12, all, sizeof all[0]);
}

static void frame(int number)
{
    matrix p, place;
    IDirect3DDevice8_Clear(device, 0, NULL, D3DCLEAR_TARGET | D3DCLEAR_ZBUFFER, 0xff101828, 1.0f, 0);
    check(IDirect3DDevice8_BeginScene(device), "BeginScene");
    projection(p);
    if (!*shader) {
        D3DMATRIX m;
        memcpy(&m, p, sizeof m);
        IDirect3DDevice8_SetTransform(device, D3DTS_PROJECTION, &m);
    }
    IDirect3DDevice8_SetRenderState(device, D3DRS_ZENABLE, D3DZB_TRUE);
    for (int i = 0; i < 6; i++) {
        place_of(place, number, i);
        box(place, p, i);
    }
    IDirect3DDevice8_SetRenderState(device, D3DRS_ZENABLE, D3DZB_FALSE);
    IDirect3DDevice8_SetVertexShader(device, D3DFVF_XYZRHW | D3DFVF_DIFFUSE);
    IDirect3DDevice8_DrawPrimitiveUP(device, D3DPT_TRIANGLELIST, 2, sign, sizeof sign[0]);
    IDirect3DDevice8_EndScene(device);
    check(IDirect3DDevice8_Present(device, NULL, NULL, NULL, NULL), "Present");
}

int main(int count, char **words)
{
    HWND window = begin(count, words);
    /* There is no library to link for 64 bits. */
    HMODULE library = LoadLibraryA("d3d8.dll");
    IDirect3D8 *(WINAPI *create)(UINT) = library ? (void *)GetProcAddress(library, "Direct3DCreate8") : NULL;
    IDirect3D8 *d3d = create ? create(D3D_SDK_VERSION) : NULL;
    if (!d3d)
        return fprintf(stderr, "no Direct3D 8\n"), 1;
    D3DPRESENT_PARAMETERS how = {0};
    how.Windowed = TRUE;
    how.SwapEffect = D3DSWAPEFFECT_DISCARD;
    how.hDeviceWindow = window;
    how.BackBufferFormat = D3DFMT_X8R8G8B8;
    how.BackBufferWidth = WIDTH;
    how.BackBufferHeight = HEIGHT;
    how.EnableAutoDepthStencil = TRUE;
    how.AutoDepthStencilFormat = D3DFMT_D24S8;
    check(IDirect3D8_CreateDevice(d3d, D3DADAPTER_DEFAULT, D3DDEVTYPE_HAL, window, D3DCREATE_HARDWARE_VERTEXPROCESSING, &how, &device), "CreateDevice");
    IDirect3DDevice8_SetRenderState(device, D3DRS_LIGHTING, FALSE);
    IDirect3DDevice8_SetRenderState(device, D3DRS_CULLMODE, D3DCULL_NONE);
    if (*shader) {
        const DWORD declaration[] = {D3DVSD_STREAM(0), D3DVSD_REG(0, D3DVSDT_FLOAT3), D3DVSD_REG(2, D3DVSDT_FLOAT1), D3DVSD_REG(1, D3DVSDT_D3DCOLOR), D3DVSD_END()};
        check(IDirect3DDevice8_CreateVertexShader(device, declaration, assemble(0), &kind, 0), "CreateVertexShader");
    }
    for (int i = 0; i < frames; i++) {
        answer();
        frame(i);
    }
    return 0;
}
