/* A vertex shader of Direct3D 8 and 9, put together by hand: a compiler of shaders is not there on every system. */
#include "scene.h"

static DWORD code[128];
static int length;

static void put(DWORD word) { code[length++] = word; }

static DWORD register_of(DWORD type, DWORD number) { return 0x80000000u | (type & 7) << 28 | (type & 0x18) << 8 | number; }

enum { R_TEMP = 0, R_INPUT = 1, R_CONST = 2, R_ADDRESS = 3, R_RASTER = 4, R_COLOUR = 5 };
enum { ALL = 0xf, NO_SWIZZLE = 0xe4 };

static DWORD to(DWORD type, DWORD number, DWORD mask) { return register_of(type, number) | mask << 16; }

static DWORD from(DWORD type, DWORD number, DWORD swizzle) { return register_of(type, number) | swizzle << 16; }

/* op: 1 mov, 2 add, 4 mad, 5 mul, 9 dp4 */
static void instruction(DWORD op, DWORD target, int sources, const DWORD *source)
{
    put(op);
    put(target);
    for (int i = 0; i < sources; i++)
        put(source[i]);
}

/* vs_1_1. declares: its inputs are declared in it, as Direct3D 9 has it. */
static const DWORD *assemble(int declares)
{
    DWORD position = from(R_INPUT, 0, NO_SWIZZLE);
    put(0xfffe0101);
    if (declares) {
        /* dcl_position v0, dcl_color v1, dcl_texcoord v2 */
        put(31), put(0x80000000), put(to(R_INPUT, 0, ALL));
        put(31), put(0x8000000a), put(to(R_INPUT, 1, ALL));
        put(31), put(0x80000005), put(to(R_INPUT, 2, ALL));
    }
    if (!strcmp(shader, "indexed")) {
        /* mov a0.x, v2.x; r0.xyz by three rows from c[a0.x + 20] on; r0.w = 1 */
        instruction(1, to(R_ADDRESS, 0, 1), 1, (DWORD[]){from(R_INPUT, 2, 0)});
        for (int i = 0; i < 3; i++)
            instruction(9, to(R_TEMP, 0, 1u << i), 2, (DWORD[]){position, from(R_CONST, 20 + i, NO_SWIZZLE) | 0x2000});
        instruction(1, to(R_TEMP, 0, 8), 1, (DWORD[]){from(R_INPUT, 0, 0xff)});
        position = from(R_TEMP, 0, NO_SWIZZLE);
    }
    if (!strcmp(shader, "columns")) {
        /* r1 = x c0 + y c1 + z c2 + c3 */
        instruction(5, to(R_TEMP, 1, ALL), 2, (DWORD[]){from(R_INPUT, 0, 0x00), from(R_CONST, offset, NO_SWIZZLE)});
        instruction(4, to(R_TEMP, 1, ALL), 3, (DWORD[]){from(R_INPUT, 0, 0x55), from(R_CONST, offset + 1, NO_SWIZZLE), from(R_TEMP, 1, NO_SWIZZLE)});
        instruction(4, to(R_TEMP, 1, ALL), 3, (DWORD[]){from(R_INPUT, 0, 0xaa), from(R_CONST, offset + 2, NO_SWIZZLE), from(R_TEMP, 1, NO_SWIZZLE)});
        instruction(2, to(R_RASTER, 0, ALL), 2, (DWORD[]){from(R_TEMP, 1, NO_SWIZZLE), from(R_CONST, offset + 3, NO_SWIZZLE)});
    } else
        for (int i = 0; i < 4; i++)
            instruction(9, to(R_RASTER, 0, 1u << i), 2, (DWORD[]){position, from(R_CONST, offset + i, NO_SWIZZLE)});
    instruction(1, to(R_COLOUR, 0, ALL), 1, (DWORD[]){from(R_INPUT, 1, NO_SWIZZLE)});
    put(0xffff);
    return code;
}
