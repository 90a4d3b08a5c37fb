/* The shaders of Direct3D 10 and 11, which the system's compiler makes. The camera lies in vec4 constants of a buffer. */
#include "scene.h"
#include <d3dcompiler.h>

enum { BOXES = 6, ALL_VERTICES = BOXES * 36 + 6 };

struct vertex {
    float x, y, z;
    float colour[4];
};

/* The camera begins at OFFSET of COUNT constants. The compiler of Wine 8 has neither calls of functions nor indices that are no constants. */
static const char source[] =
    "cbuffer constants : register(b0) { float4 c[COUNT]; };\n"
    "struct vertex { float4 position : SV_Position; float4 colour : COLOUR; };\n"
    "vertex rows(float3 position : POSITION, float4 colour : COLOUR)\n"
    "{\n"
    "    vertex v;\n"
    "    float4 p = float4(position, 1.0);\n"
    "    v.position = float4(dot(p, c[OFFSET]), dot(p, c[OFFSET + 1]), dot(p, c[OFFSET + 2]), dot(p, c[OFFSET + 3]));\n"
    "    v.colour = colour;\n"
    "    return v;\n"
    "}\n"
    "vertex columns(float3 position : POSITION, float4 colour : COLOUR)\n"
    "{\n"
    "    vertex v;\n"
    "    v.position = position.x * c[OFFSET] + position.y * c[OFFSET + 1] + position.z * c[OFFSET + 2] + c[OFFSET + 3];\n"
    "    v.colour = colour;\n"
    "    return v;\n"
    "}\n"
    "vertex still(float3 position : POSITION, float4 colour : COLOUR)\n"
    "{\n"
    "    vertex v;\n"
    "    v.position = float4(position, 1.0);\n"
    "    v.colour = colour;\n"
    "    return v;\n"
    "}\n"
    "float4 pixel(vertex v) : SV_Target { return v.colour; }\n";

/* A compiled shader. */
static ID3DBlob *compiled(const char *entry, const char *target)
{
    char from[16], count[16];
    snprintf(from, sizeof from, "%d", offset);
    snprintf(count, sizeof count, "%d", offset + 4);
    const D3D_SHADER_MACRO macros[] = {{"OFFSET", from}, {"COUNT", count}, {NULL, NULL}};
    ID3DBlob *code = NULL, *messages = NULL;
    HRESULT result = D3DCompile(source, sizeof source - 1, NULL, macros, NULL, entry, target, 0, 0, &code, &messages);
    if (messages)
        fprintf(stderr, "%s\n", (char *)ID3D10Blob_GetBufferPointer(messages));
    check(result, entry);
    return code;
}

static void put_colour(struct vertex *v, DWORD argb)
{
    for (int i = 0; i < 4; i++)
        v->colour[i] = (float)(argb >> (i < 3 ? 16 - 8 * i : 24) & 255) / 255.0f;
}

/* The corners of all boxes, and the sign in clip space. */
static void vertices_of(struct vertex *all)
{
    for (int i = 0; i < BOXES * 36; i++) {
        corner(i % 36, &all[i].x);
        put_colour(&all[i], colour_of(i / 36, i % 36));
    }
    for (int i = 0; i < 6; i++) {
        struct vertex *v = &all[BOXES * 36 + i];
        v->x = 2.0f * sign[i].x / WIDTH - 1.0f;
        v->y = 1.0f - 2.0f * sign[i].y / HEIGHT;
        v->z = 0.0f;
        put_colour(v, sign[i].colour);
    }
}
