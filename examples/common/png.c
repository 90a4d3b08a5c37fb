/* An RGB picture as a PNG file, row 0 on top. */
#include "demo.h"
#include <png.h>
#include <string.h>

int demo_write_png(const char *path, int width, int height, const unsigned char *rgb)
{
    png_image image;
    memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.width = (png_uint_32)width;
    image.height = (png_uint_32)height;
    image.format = PNG_FORMAT_RGB;
    /* A negative stride: GL's first row is the lowest. */
    return !png_image_write_to_file(&image, path, 0, rgb, -3 * width, NULL);
}
