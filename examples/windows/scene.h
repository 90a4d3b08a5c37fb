/* What the programs for Windows draw: boxes that turn, and a sign that stands still.
 *
 * PROGRAM [--shader rows|columns|indexed] [--offset N] [--software] [--execute] [--full] [--frames N|--bench] [--view I/N] [--separation S] [--convergence C]
 *
 * --shader, where the program has shaders: rows, the camera is four dot products (m4x4); columns, four multiplications and additions; indexed, a bone of three rows,
 * chosen by an index of the vertex, before the camera's rows. --offset: the constant at which the camera begins. --software, where the program can: it transforms the
 * vertices itself. --execute, where the program can: it draws by execute buffers. --full, where the program can: it has the screen for itself and flips. --view I/N: draws
 * view I of N itself: x in clip space moves by S·place·(w - C), where place is I - (N - 1) / 2. --bench: frames on request, so that several programs can be kept
 * alive and drawn in turns: each line of stdin is a number of frames, and when these are drawn, a line answers how many ns they took. */
#include <windows.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 320, HEIGHT = 240, BONES = 8 };

typedef float matrix[16]; /* rows, for row vectors, as Direct3D has them */

static int frames = 5, view, views = 1, offset, software, execute, full, bench;
static const char *shader = "";
static double separation, convergence = 1.0;
static HWND scene;

__attribute__((unused)) static void product(matrix r, const matrix a, const matrix b)
{
    matrix m;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            m[4 * i + j] = 0.0f;
            for (int k = 0; k < 4; k++)
                m[4 * i + j] += a[4 * i + k] * b[4 * k + j];
        }
    memcpy(r, m, sizeof m);
}

/* z from 0 to w, and the camera of the view. */
static void projection(matrix m)
{
    float nearest = 1.0f, farthest = 50.0f, up = 1.0f / tanf(0.45f), across = up * HEIGHT / WIDTH;
    double place = view - (views - 1) / 2.0, by = separation * place;
    memset(m, 0, sizeof(matrix));
    m[0] = across;
    m[5] = up;
    m[10] = farthest / (farthest - nearest);
    m[11] = 1.0f;
    m[14] = -nearest * farthest / (farthest - nearest);
    /* x += by (w - convergence); the fourth component of a position is 1. */
    m[8] = (float)by;
    m[12] = (float)(-by * convergence);
}

static void placed(matrix m, float angle, float x, float y, float z)
{
    float c = cosf(angle), s = sinf(angle);
    matrix turned = {c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, x, y, z, 1};
    memcpy(m, turned, sizeof turned);
}

static const int corners[36] = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
static const DWORD colours[6] = {0xffd04040, 0xff40d040, 0xff4040d0, 0xffd0d040, 0xff40d0d0, 0xffd040d0};

static void corner(int i, float *p)
{
    int c = corners[i];
    p[0] = c & 1 ? 0.5f : -0.5f;
    p[1] = c & 2 ? 0.5f : -0.5f;
    p[2] = c & 4 ? 0.5f : -0.5f;
}

__attribute__((unused)) static void check(HRESULT result, const char *what)
{
    if (FAILED(result)) {
        fprintf(stderr, "%s: %08lx\n", what, (unsigned long)result);
        exit(1);
    }
}

/* The place of a box in a frame. */
static void place_of(matrix m, int frame, int box)
{
    placed(m, 0.1f * (float)frame + (float)box, 1.6f * (float)(box % 3 - 1), 1.1f * (float)(box / 3) - 0.6f, 3.0f + 1.1f * (float)box);
}

/* The colour of a corner of a box. */
static DWORD colour_of(int box, int corner)
{
    return colours[(corner / 6 + box) % 6];
}

/* The constants of a box: its bone, if it has one, and the camera. */
__attribute__((unused)) static void constants_of(const matrix place, const matrix camera, float bone[12], float rows[16])
{
    matrix m;
    if (!strcmp(shader, "indexed")) {
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 4; j++)
                bone[4 * i + j] = place[4 * j + i];
        memcpy(m, camera, sizeof m);
    } else
        product(m, place, camera);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            rows[4 * i + j] = strcmp(shader, "columns") ? m[4 * j + i] : m[4 * i + j];
}

/* The sign, in screen coordinates. */
__attribute__((unused)) static const struct flat_vertex {
    float x, y, z, rhw;
    DWORD colour;
} sign[6] = {
    {10, 10, 0, 1, 0xffffffff}, {60, 10, 0, 1, 0xffffffff}, {10, 30, 0, 1, 0xffffffff},
    {60, 10, 0, 1, 0xffffffff}, {60, 30, 0, 1, 0xff808080}, {10, 30, 0, 1, 0xffffffff}};

/* Reads the options and makes the window. */
static HWND begin(int count, char **words)
{
    WNDCLASSA kind = {0};
    for (int i = 1; i < count; i++) {
        const char *value = i + 1 < count ? words[i + 1] : "";
        if (!strcmp(words[i], "--software"))
            software = 1;
        else if (!strcmp(words[i], "--execute"))
            execute = 1;
        else if (!strcmp(words[i], "--full"))
            full = 1;
        else if (!strcmp(words[i], "--shader"))
            shader = value, i++;
        else if (!strcmp(words[i], "--offset"))
            offset = atoi(value), i++;
        else if (!strcmp(words[i], "--bench"))
            bench = 1, frames = 1 << 30;
        else if (!strcmp(words[i], "--frames"))
            frames = atoi(value), i++;
        else if (!strcmp(words[i], "--view"))
            sscanf(value, "%d/%d", &view, &views), i++;
        else if (!strcmp(words[i], "--separation"))
            separation = atof(value), i++;
        else if (!strcmp(words[i], "--convergence"))
            convergence = atof(value), i++;
        else
            fprintf(stderr, "%s is no option\n", words[i]), exit(2);
    }
    kind.lpfnWndProc = DefWindowProcA;
    kind.lpszClassName = "scene";
    RegisterClassA(&kind);
    return scene = CreateWindowA("scene", "scene", WS_POPUP | WS_VISIBLE, 0, 0, WIDTH, HEIGHT, NULL, NULL, NULL, NULL);
}

/* Waits for the next request where the last one is met. Its window comes to the top, for a hidden one costs less. */
static void take_turns(void)
{
    static LARGE_INTEGER start, now, second;
    static int left;
    char line[64];
    if (left-- > 0)
        return;
    QueryPerformanceCounter(&now);
    QueryPerformanceFrequency(&second);
    if (start.QuadPart)
        printf("%.0f\n", 1e9 * (double)(now.QuadPart - start.QuadPart) / (double)second.QuadPart);
    fflush(stdout);
    if (!fgets(line, sizeof line, stdin))
        exit(0);
    left = atoi(line) - 1;
    SetWindowPos(scene, HWND_TOP, 0, 0, 0, 0, SWP_NOMOVE | SWP_NOSIZE | SWP_NOACTIVATE);
    QueryPerformanceCounter(&start);
}

/* Answers what the window is told. */
static void answer(void)
{
    MSG message;
    if (bench)
        take_turns();
    while (PeekMessageA(&message, NULL, 0, 0, PM_REMOVE))
        DispatchMessageA(&message);
}
