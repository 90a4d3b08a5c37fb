/* The scene by Direct3D 10: a vertex shader whose camera lies in a constant buffer. */
#define COBJMACROS
#include "hlsl.h"
#include <d3d10.h>

static ID3D10Device *device;
static IDXGISwapChain *chain;
static ID3D10RenderTargetView *target;
static ID3D10DepthStencilView *depth;
static ID3D10DepthStencilState *tested, *untested;
static ID3D10VertexShader *camera_shader, *still_shader;
static ID3D10Buffer *constants;

static void frame(int number)
{
    static const float background[4] = {16 / 255.0f, 24 / 255.0f, 40 / 255.0f, 1.0f};
    matrix p, place;
    ID3D10Device_OMSetRenderTargets(device, 1, &target, depth);
    ID3D10Device_ClearRenderTargetView(device, target, background);
    ID3D10Device_ClearDepthStencilView(device, depth, D3D10_CLEAR_DEPTH, 1.0f, 0);
    projection(p);
    ID3D10Device_OMSetDepthStencilState(device, tested, 0);
    ID3D10Device_VSSetShader(device, camera_shader);
    for (int i = 0; i < BOXES; i++) {
        float all[4 * (offset + 4)];
        place_of(place, number, i);
        memset(all, 0, sizeof all);
        constants_of(place, p, NULL, all + 4 * offset);
        ID3D10Device_UpdateSubresource(device, (ID3D10Resource *)constants, 0, NULL, all, 0, 0);
        ID3D10Device_Draw(device, 36, 36 * i);
    }
    ID3D10Device_OMSetDepthStencilState(device, untested, 0);
    ID3D10Device_VSSetShader(device, still_shader);
    ID3D10Device_Draw(device, 6, BOXES * 36);
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
    check(D3D10CreateDeviceAndSwapChain(NULL, D3D10_DRIVER_TYPE_HARDWARE, NULL, 0, D3D10_SDK_VERSION, &how, &chain, &device), "no Direct3D 10");
    ID3D10Texture2D *colours, *depths;
    check(IDXGISwapChain_GetBuffer(chain, 0, &IID_ID3D10Texture2D, (void **)&colours), "GetBuffer");
    check(ID3D10Device_CreateRenderTargetView(device, (ID3D10Resource *)colours, NULL, &target), "CreateRenderTargetView");
    D3D10_TEXTURE2D_DESC about = {WIDTH, HEIGHT, 1, 1, DXGI_FORMAT_D24_UNORM_S8_UINT, {1, 0}, D3D10_USAGE_DEFAULT, D3D10_BIND_DEPTH_STENCIL, 0, 0};
    check(ID3D10Device_CreateTexture2D(device, &about, NULL, &depths), "CreateTexture2D");
    check(ID3D10Device_CreateDepthStencilView(device, (ID3D10Resource *)depths, NULL, &depth), "CreateDepthStencilView");
    D3D10_DEPTH_STENCIL_DESC tests = {0};
    check(ID3D10Device_CreateDepthStencilState(device, &tests, &untested), "CreateDepthStencilState");
    tests.DepthEnable = TRUE;
    tests.DepthWriteMask = D3D10_DEPTH_WRITE_MASK_ALL;
    tests.DepthFunc = D3D10_COMPARISON_LESS_EQUAL;
    check(ID3D10Device_CreateDepthStencilState(device, &tests, &tested), "CreateDepthStencilState");
    D3D10_RASTERIZER_DESC raster = {.FillMode = D3D10_FILL_SOLID, .CullMode = D3D10_CULL_NONE, .DepthClipEnable = TRUE};
    ID3D10RasterizerState *both_sides;
    check(ID3D10Device_CreateRasterizerState(device, &raster, &both_sides), "CreateRasterizerState");
    ID3D10Device_RSSetState(device, both_sides);
    D3D10_VIEWPORT area = {0, 0, WIDTH, HEIGHT, 0.0f, 1.0f};
    ID3D10Device_RSSetViewports(device, 1, &area);

    static const D3D10_INPUT_ELEMENT_DESC elements[] = {
        {"POSITION", 0, DXGI_FORMAT_R32G32B32_FLOAT, 0, 0, D3D10_INPUT_PER_VERTEX_DATA, 0}, {"COLOUR", 0, DXGI_FORMAT_R32G32B32A32_FLOAT, 0, 12, D3D10_INPUT_PER_VERTEX_DATA, 0}};
    ID3DBlob *code = compiled(*shader ? shader : "rows", "vs_4_0");
    ID3D10InputLayout *layout;
    check(ID3D10Device_CreateVertexShader(device, ID3D10Blob_GetBufferPointer(code), ID3D10Blob_GetBufferSize(code), &camera_shader), "CreateVertexShader");
    check(ID3D10Device_CreateInputLayout(device, elements, 2, ID3D10Blob_GetBufferPointer(code), ID3D10Blob_GetBufferSize(code), &layout), "CreateInputLayout");
    ID3D10Device_IASetInputLayout(device, layout);
    code = compiled("still", "vs_4_0");
    check(ID3D10Device_CreateVertexShader(device, ID3D10Blob_GetBufferPointer(code), ID3D10Blob_GetBufferSize(code), &still_shader), "CreateVertexShader");
    code = compiled("pixel", "ps_4_0");
    ID3D10PixelShader *pixel;
    check(ID3D10Device_CreatePixelShader(device, ID3D10Blob_GetBufferPointer(code), ID3D10Blob_GetBufferSize(code), &pixel), "CreatePixelShader");
    ID3D10Device_PSSetShader(device, pixel);

    static struct vertex all[ALL_VERTICES];
    vertices_of(all);
    D3D10_BUFFER_DESC kind = {.ByteWidth = sizeof all, .Usage = D3D10_USAGE_IMMUTABLE, .BindFlags = D3D10_BIND_VERTEX_BUFFER};
    D3D10_SUBRESOURCE_DATA data = {.pSysMem = all};
    ID3D10Buffer *vertices;
    UINT stride = sizeof all[0], from = 0;
    check(ID3D10Device_CreateBuffer(device, &kind, &data, &vertices), "CreateBuffer");
    ID3D10Device_IASetVertexBuffers(device, 0, 1, &vertices, &stride, &from);
    ID3D10Device_IASetPrimitiveTopology(device, D3D10_PRIMITIVE_TOPOLOGY_TRIANGLELIST);
    D3D10_BUFFER_DESC changing = {16 * (offset + 4), D3D10_USAGE_DEFAULT, D3D10_BIND_CONSTANT_BUFFER, 0, 0};
    check(ID3D10Device_CreateBuffer(device, &changing, NULL, &constants), "CreateBuffer");
    ID3D10Device_VSSetConstantBuffers(device, 0, 1, &constants);
    for (int i = 0; i < frames; i++) {
        answer();
        frame(i);
    }
    /* Wine draws in a thread of its own: wait until that has drawn all frames. */
    D3D10_QUERY_DESC event = {D3D10_QUERY_EVENT, 0};
    ID3D10Query *drawn;
    check(ID3D10Device_CreateQuery(device, &event, &drawn), "CreateQuery");
    ID3D10Query_End(drawn);
    while (ID3D10Query_GetData(drawn, NULL, 0, 0) == S_FALSE)
        Sleep(1);
    return 0;
}
