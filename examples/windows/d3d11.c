/* The scene by Direct3D 11: a vertex shader whose camera lies in a constant buffer. */
#define COBJMACROS
#include "hlsl.h"
#include <d3d11.h>

static ID3D11Device *device;
static ID3D11DeviceContext *context;
static IDXGISwapChain *chain;
static ID3D11RenderTargetView *target;
static ID3D11DepthStencilView *depth;
static ID3D11DepthStencilState *tested, *untested;
static ID3D11VertexShader *camera_shader, *still_shader;
static ID3D11Buffer *constants;

static void frame(int number)
{
    static const float background[4] = {16 / 255.0f, 24 / 255.0f, 40 / 255.0f, 1.0f};
    matrix p, place;
    ID3D11DeviceContext_OMSetRenderTargets(context, 1, &target, depth);
    ID3D11DeviceContext_ClearRenderTargetView(context, target, background);
    ID3D11DeviceContext_ClearDepthStencilView(context, depth, D3D11_CLEAR_DEPTH, 1.0f, 0);
    projection(p);
    ID3D11DeviceContext_OMSetDepthStencilState(context, tested, 0);
    ID3D11DeviceContext_VSSetShader(context, camera_shader, NULL, 0);
    for (int i = 0; i < BOXES; i++) {
        D3D11_MAPPED_SUBRESOURCE mapped;
        place_of(place, number, i);
        check(ID3D11DeviceContext_Map(context, (ID3D11Resource *)constants, 0, D3D11_MAP_WRITE_DISCARD, 0, &mapped), "Map");
        constants_of(place, p, NULL, (float *)mapped.pData + 4 * offset);
        ID3D11DeviceContext_Unmap(context, (ID3D11Resource *)constants, 0);
        ID3D11DeviceContext_Draw(context, 36, 36 * i);
    }
    ID3D11DeviceContext_OMSetDepthStencilState(context, untested, 0);
    ID3D11DeviceContext_VSSetShader(context, still_shader, NULL, 0);
    ID3D11DeviceContext_Draw(context, 6, BOXES * 36);
    check(IDXGISwapChain_Present(chain, 0, 0), "Present");
}

int main(int count, char **words)
{
    HWND window = begin(count, words);
    DXGI_SWAP_CHAIN_DESC how = {0};
    how.BufferDesc.Width = WIDTH;
    how.BufferDesc.Height = HEIGHT;
    how.BufferDesc.Format = DXGI_FORMAT_R8G8B8A8_UNORM;
    how.SampleDesc.Count = 1;
    how.BufferUsage = DXGI_USAGE_RENDER_TARGET_OUTPUT;
    how.BufferCount = 1;
    how.OutputWindow = window;
    how.Windowed = TRUE;
    check(D3D11CreateDeviceAndSwapChain(NULL, D3D_DRIVER_TYPE_HARDWARE, NULL, 0, NULL, 0, D3D11_SDK_VERSION, &how, &chain, &device, NULL, &context), "no Direct3D 11");
    ID3D11Texture2D *colours, *depths;
    check(IDXGISwapChain_GetBuffer(chain, 0, &IID_ID3D11Texture2D, (void **)&colours), "GetBuffer");
    check(ID3D11Device_CreateRenderTargetView(device, (ID3D11Resource *)colours, NULL, &target), "CreateRenderTargetView");
    D3D11_TEXTURE2D_DESC about = {WIDTH, HEIGHT, 1, 1, DXGI_FORMAT_D24_UNORM_S8_UINT, {1, 0}, D3D11_USAGE_DEFAULT, D3D11_BIND_DEPTH_STENCIL, 0, 0};
    check(ID3D11Device_CreateTexture2D(device, &about, NULL, &depths), "CreateTexture2D");
    check(ID3D11Device_CreateDepthStencilView(device, (ID3D11Resource *)depths, NULL, &depth), "CreateDepthStencilView");
    D3D11_DEPTH_STENCIL_DESC tests = {0};
    check(ID3D11Device_CreateDepthStencilState(device, &tests, &untested), "CreateDepthStencilState");
    tests.DepthEnable = TRUE;
    tests.DepthWriteMask = D3D11_DEPTH_WRITE_MASK_ALL;
    tests.DepthFunc = D3D11_COMPARISON_LESS_EQUAL;
    check(ID3D11Device_CreateDepthStencilState(device, &tests, &tested), "CreateDepthStencilState");
    D3D11_RASTERIZER_DESC raster = {.FillMode = D3D11_FILL_SOLID, .CullMode = D3D11_CULL_NONE, .DepthClipEnable = TRUE};
    ID3D11RasterizerState *both_sides;
    check(ID3D11Device_CreateRasterizerState(device, &raster, &both_sides), "CreateRasterizerState");
    ID3D11DeviceContext_RSSetState(context, both_sides);
    D3D11_VIEWPORT area = {0.0f, 0.0f, WIDTH, HEIGHT, 0.0f, 1.0f};
    ID3D11DeviceContext_RSSetViewports(context, 1, &area);

    static const D3D11_INPUT_ELEMENT_DESC elements[] = {
        {"POSITION", 0, DXGI_FORMAT_R32G32B32_FLOAT, 0, 0, D3D11_INPUT_PER_VERTEX_DATA, 0}, {"COLOUR", 0, DXGI_FORMAT_R32G32B32A32_FLOAT, 0, 12, D3D11_INPUT_PER_VERTEX_DATA, 0}};
    ID3DBlob *code = compiled(*shader ? shader : "rows", "vs_4_0");
    ID3D11InputLayout *layout;
    check(ID3D11Device_CreateVertexShader(device, ID3D10Blob_GetBufferPointer(code), ID3D10Blob_GetBufferSize(code), NULL, &camera_shader), "CreateVertexShader");
    check(ID3D11Device_CreateInputLayout(device, elements, 2, ID3D10Blob_GetBufferPointer(code), ID3D10Blob_GetBufferSize(code), &layout), "CreateInputLayout");
    ID3D11DeviceContext_IASetInputLayout(context, layout);
    code = compiled("still", "vs_4_0");
    check(ID3D11Device_CreateVertexShader(device, ID3D10Blob_GetBufferPointer(code), ID3D10Blob_GetBufferSize(code), NULL, &still_shader), "CreateVertexShader");
    code = compiled("pixel", "ps_4_0");
    ID3D11PixelShader *pixel;
    check(ID3D11Device_CreatePixelShader(device, ID3D10Blob_GetBufferPointer(code), ID3D10Blob_GetBufferSize(code), NULL, &pixel), "CreatePixelShader");
    ID3D11DeviceContext_PSSetShader(context, pixel, NULL, 0);

    static struct vertex all[ALL_VERTICES];
    vertices_of(all);
    D3D11_BUFFER_DESC kind = {.ByteWidth = sizeof all, .Usage = D3D11_USAGE_IMMUTABLE, .BindFlags = D3D11_BIND_VERTEX_BUFFER};
    D3D11_SUBRESOURCE_DATA data = {.pSysMem = all};
    ID3D11Buffer *vertices;
    UINT stride = sizeof all[0], from = 0;
    check(ID3D11Device_CreateBuffer(device, &kind, &data, &vertices), "CreateBuffer");
    ID3D11DeviceContext_IASetVertexBuffers(context, 0, 1, &vertices, &stride, &from);
    ID3D11DeviceContext_IASetPrimitiveTopology(context, D3D11_PRIMITIVE_TOPOLOGY_TRIANGLELIST);
    D3D11_BUFFER_DESC changing = {16 * (offset + 4), D3D11_USAGE_DYNAMIC, D3D11_BIND_CONSTANT_BUFFER, D3D11_CPU_ACCESS_WRITE, 0, 0};
    check(ID3D11Device_CreateBuffer(device, &changing, NULL, &constants), "CreateBuffer");
    ID3D11DeviceContext_VSSetConstantBuffers(context, 0, 1, &constants);
    for (int i = 0; i < frames; i++) {
        answer();
        frame(i);
    }
    /* Wine draws in a thread of its own: wait until that has drawn all frames. */
    D3D11_QUERY_DESC event = {D3D11_QUERY_EVENT, 0};
    ID3D11Query *drawn;
    check(ID3D11Device_CreateQuery(device, &event, &drawn), "CreateQuery");
    ID3D11DeviceContext_End(context, (ID3D11Asynchronous *)drawn);
    while (ID3D11DeviceContext_GetData(context, (ID3D11Asynchronous *)drawn, NULL, 0, 0) == S_FALSE)
        Sleep(1);
    return 0;
}
