/* A few solids by glBegin and glEnd. */
#include "demo.h"
#include <math.h>
#include <stdlib.h>

static void sphere_vertex(double radius, int i, int slices, int j, int stacks)
{
    double a = 2.0 * M_PI * (i % slices) / slices, b = M_PI * (j / (double)stacks - 0.5);
    double x = cos(a) * cos(b), y = sin(b), z = -sin(a) * cos(b);
    glNormal3d(x, y, z);
    glTexCoord2d(2.0 * i / slices, (double)j / stacks);
    glVertex3d(radius * x, radius * y, radius * z);
}

void demo_sphere(double radius, int slices, int stacks)
{
    for (int j = 0; j < stacks; j++) {
        glBegin(GL_QUAD_STRIP);
        for (int i = 0; i <= slices; i++) {
            sphere_vertex(radius, i, slices, j + 1, stacks);
            sphere_vertex(radius, i, slices, j, stacks);
        }
        glEnd();
    }
}

static void torus_vertex(double radius, double tube, int i, int slices, int j, int stacks)
{
    double a = 2.0 * M_PI * (i % slices) / slices, b = 2.0 * M_PI * (j % stacks) / stacks;
    double x = cos(b) * cos(a), y = cos(b) * sin(a), z = sin(b);
    glNormal3d(x, y, z);
    glTexCoord2d(4.0 * i / slices, (double)j / stacks);
    glVertex3d(radius * cos(a) + tube * x, radius * sin(a) + tube * y, tube * z);
}

void demo_torus(double radius, double tube, int slices, int stacks)
{
    for (int j = 0; j < stacks; j++) {
        glBegin(GL_TRIANGLE_STRIP);
        for (int i = 0; i <= slices; i++) {
            torus_vertex(radius, tube, i, slices, j + 1, stacks);
            torus_vertex(radius, tube, i, slices, j, stacks);
        }
        glEnd();
    }
}

void demo_box(double x, double y, double z)
{
    static const int corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    double half[3] = {x, y, z};
    glBegin(GL_QUADS);
    for (int axis = 0; axis < 3; axis++)
        for (int side = -1; side <= 1; side += 2) {
            double n[3] = {0.0, 0.0, 0.0};
            n[axis] = side;
            glNormal3dv(n);
            for (int c = 0; c < 4; c++) {
                double v[3];
                v[axis] = side * half[axis];
                v[(axis + 1) % 3] = side * corner[c][0] * half[(axis + 1) % 3];
                v[(axis + 2) % 3] = corner[c][1] * half[(axis + 2) % 3];
                glTexCoord2d((corner[c][0] + 1) / 2.0, (corner[c][1] + 1) / 2.0);
                glVertex3dv(v);
            }
        }
    glEnd();
}

GLuint demo_checker(int size, int squares, const GLubyte a[3], const GLubyte b[3])
{
    GLuint name;
    GLubyte *texels = malloc((size_t)size * (size_t)size * 3);
    if (!texels)
        demo_fail(1, "out of memory");
    for (int y = 0; y < size; y++)
        for (int x = 0; x < size; x++)
            for (int c = 0; c < 3; c++) {
                int odd = (x * squares / size + y * squares / size) & 1;
                int grain = (x * 7 + y * 13 + (x ^ y) * 3) % 23;
                int v = (odd ? b[c] : a[c]) - grain;
                texels[(y * size + x) * 3 + c] = (GLubyte)(v < 0 ? 0 : v);
            }
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, size, size, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
    free(texels);
    return name;
}
