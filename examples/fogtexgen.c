/* Fog in its three modes (they change every frame), generated texture coordinates (object and eye
 * linear, sphere map, reflection into a cube map, normal map) and texture matrices. */
#include "demo.h"
#include <math.h>

DEMO_NO_OPTIONS;

static GLuint stripes, environment, cube;
static const GLfloat sky[4] = {0.62f, 0.70f, 0.80f, 1.0f};

static void make_environment(void)
{
    enum { SIZE = 128 };
    static GLubyte texels[SIZE][SIZE][3];
    for (int y = 0; y < SIZE; y++) /* the environment of a mirror ball: sky, a sun, ground */
        for (int x = 0; x < SIZE; x++) {
            double u = x / 63.5 - 1.0, v = y / 63.5 - 1.0, sun = exp(-12.0 * ((u - 0.3) * (u - 0.3) + (v - 0.4) * (v - 0.4)));
            int ring = ((int)((u + 1.0) * 10.0) + (int)((v + 1.0) * 10.0)) & 1;
            texels[y][x][0] = (GLubyte)(v > 0 ? 90 + 160 * sun : 100 + 60 * ring);
            texels[y][x][1] = (GLubyte)(v > 0 ? 120 + 130 * sun : 80 + 40 * ring);
            texels[y][x][2] = (GLubyte)(v > 0 ? 200 : 50);
        }
    glGenTextures(1, &environment);
    glBindTexture(GL_TEXTURE_2D, environment);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, SIZE, SIZE, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
}

static void make_cube(void)
{
    enum { SIZE = 32 };
    static GLubyte texels[SIZE][SIZE][3];
    glGenTextures(1, &cube);
    glBindTexture(GL_TEXTURE_CUBE_MAP, cube);
    for (int face = 0; face < 6; face++) {
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++)
                for (int c = 0; c < 3; c++)
                    texels[y][x][c] = (GLubyte)(((face + 1) >> c & 1 ? 230 : 50) - ((x / 4 + y / 4) & 1 ? 40 : 0));
        glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + (GLenum)face, 0, GL_RGB, SIZE, SIZE, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
    }
    glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void demo_setup(void)
{
    static const GLubyte a[3] = {240, 200, 90}, b[3] = {60, 90, 150};
    static const GLfloat light[4] = {3.0f, 6.0f, 4.0f, 0.0f};
    stripes = demo_checker(64, 4, a, b);
    make_environment();
    make_cube();
    glClearColor(sky[0], sky[1], sky[2], 1.0f);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_LIGHTING);
    glEnable(GL_LIGHT0);
    glEnable(GL_COLOR_MATERIAL);
    glEnable(GL_NORMALIZE);
    glEnable(GL_FOG);
    glFogfv(GL_FOG_COLOR, sky);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glLightfv(GL_LIGHT0, GL_POSITION, light);
}

static void fog(int frame)
{
    static const GLint modes[3] = {GL_LINEAR, GL_EXP, GL_EXP2};
    glFogi(GL_FOG_MODE, modes[frame % 3]);
    glFogf(GL_FOG_START, 5.0f);
    glFogf(GL_FOG_END, 20.0f);
    glFogf(GL_FOG_DENSITY, frame % 3 == 1 ? 0.07f : 0.08f);
    glHint(GL_FOG_HINT, frame / 3 % 2 ? GL_NICEST : GL_FASTEST);
}

static void texgen(GLenum coordinates, GLint mode) /* for the first `coordinates` of s, t, r */
{
    for (GLenum c = 0; c < 3; c++)
        if (c < coordinates) {
            glTexGeni(GL_S + c, GL_TEXTURE_GEN_MODE, mode);
            glEnable(GL_TEXTURE_GEN_S + c);
        } else {
            glDisable(GL_TEXTURE_GEN_S + c);
        }
}

static void planes(GLenum which, double scale)
{
    GLdouble s[4] = {scale, 0.0, scale * 0.25, 0.0}, t[4] = {0.0, scale, scale, 0.25};
    glTexGendv(GL_S, which, s);
    glTexGendv(GL_T, which, t);
}

static void texture_matrix(double angle, double scale)
{
    glMatrixMode(GL_TEXTURE);
    glLoadIdentity();
    glRotated(angle, 0.0, 0.0, 1.0);
    glScaled(scale, scale, 1.0);
    glMatrixMode(GL_MODELVIEW);
}

static void at(double x, double y, double z, double turn)
{
    glPopMatrix();
    glPushMatrix();
    glTranslated(x, y, z);
    glRotated(turn, 0.3, 1.0, 0.1);
}

void demo_frame(int frame)
{
    double t = demo_time(frame), turn = 45.0 * t;
    demo_viewport(0, 0, demo_width, demo_height);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    demo_perspective(45.0, (double)demo_width / demo_height, 1.5, 60.0);
    fog(frame);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslated(0.0, -0.2, -7.4);
    glRotated(14.0, 1.0, 0.0, 0.0);
    glColor3f(1.0f, 1.0f, 1.0f);
    glPushMatrix();

    /* The ground: object linear, with a turning texture matrix. */
    glEnable(GL_TEXTURE_2D);
    glBindTexture(GL_TEXTURE_2D, stripes);
    texgen(2, GL_OBJECT_LINEAR);
    planes(GL_OBJECT_PLANE, 0.2);
    texture_matrix(10.0 * t, 1.0);
    at(0.0, -1.6, -6.0, 0.0);
    demo_box(14.0, 0.1, 14.0);

    /* A row of pillars receding into the fog: eye linear, with planes fixed to the camera. */
    texgen(2, GL_EYE_LINEAR);
    glPushMatrix();
    glLoadIdentity();
    planes(GL_EYE_PLANE, 0.4);
    glPopMatrix();
    texture_matrix(0.0, 1.0);
    for (int i = 0; i < 6; i++) {
        glColor3d(1.0, 0.6 + 0.08 * i, 0.51);
        at(-3.2 - 0.25 * i, 0.2, 0.5 - 2.6 * i, 0.0);
        demo_box(0.4, 1.8, 0.4);
        at(3.2 + 0.25 * i, 0.2, 0.5 - 2.6 * i, turn);
        demo_box(0.4, 1.8, 0.4);
    }
    glColor3f(1.0f, 1.0f, 1.0f);

    /* Sphere map on a torus and a ball. */
    glBindTexture(GL_TEXTURE_2D, environment);
    texgen(2, GL_SPHERE_MAP);
    at(-1.4, 0.4, 0.2, turn);
    demo_torus(0.8, 0.32, 40, 20);
    at(-0.6, -0.6, 2.4, turn);
    demo_sphere(0.5, 32, 16);

    /* Object linear, so the stripes move with the object. */
    glBindTexture(GL_TEXTURE_2D, stripes);
    texgen(2, GL_OBJECT_LINEAR);
    planes(GL_OBJECT_PLANE, 1.0);
    at(0.4, 1.2, -5.0, turn);
    demo_sphere(1.1, 32, 16);
    glDisable(GL_TEXTURE_2D);

    /* Cube map by reflection and by normal. */
    glEnable(GL_TEXTURE_CUBE_MAP);
    texgen(3, GL_REFLECTION_MAP);
    at(1.4, 0.3, 1.0, turn);
    demo_sphere(0.9, 40, 20);
    texgen(3, GL_NORMAL_MAP);
    texture_matrix(60.0 * t, 1.0);
    at(1.0, -0.9, 2.8, -turn);
    demo_torus(0.4, 0.18, 32, 16);
    texture_matrix(0.0, 1.0);
    texgen(0, GL_OBJECT_LINEAR);
    glDisable(GL_TEXTURE_CUBE_MAP);
    glPopMatrix();
}
