/* Drawables of GLX and EGL: `drawables MODE`. presents.c, swaps.c, reads.c, surfaces.c and growths.c list the modes. */
#include "drawables.h"
#include <stdio.h>

int main(int count, char **arguments)
{
    const char *mode = count > 1 ? arguments[1] : "";
    setvbuf(stdout, NULL, _IOLBF, 0);
    return presents(mode) || swaps(mode) || reads(mode) || surfaces(mode) || growths(mode) ? 0 : 2;
}
