/* The main program of every demo: options, window, views, picture files.
 * A demo defines demo_setup(), demo_frame() and demo_options[]; common/demo.c has main(). */
#ifndef DEMO_H
#define DEMO_H

#include <stddef.h>

#define GL_GLEXT_PROTOTYPES
#ifdef DEMO_DLOPEN
#include "dlgl.h"
#else
#include <GL/gl.h>
#include <GL/glext.h>
#endif

/* ---- defined by a demo ---- */
struct demo_option {
    const char *name; /* such as "--vbo"; the list ends with a null name */
    const char *help;
    void *value; /* an int, set to 1 or to the number after the option; or a const char *, the word after it */
    enum { DEMO_NOTHING, DEMO_NUMBER, DEMO_WORD } takes;
};
extern const struct demo_option demo_options[];
#define DEMO_NO_OPTIONS const struct demo_option demo_options[] = {{0}}

/* 1: the window has to have an accumulation buffer; 2: only where windows can have one. Other demos leave it out. */
extern int demo_accumulation;
void demo_setup(void);          /* once, with the context current */
void demo_frame(int frame);     /* draws frame number 0, 1, 2, ...; the same number gives the same picture */

/* ---- used by a demo ---- */
extern int demo_width, demo_height; /* size of the picture (--size) */
extern int demo_x, demo_y;          /* where it begins in the window (--offset) */
extern int demo_es;                 /* 2 or 3 in a context of OpenGL ES (--profile es2, es3), else 0 */

double demo_time(int frame);        /* animation time: 0.02 s a frame */

/* Like glViewport and glScissor (whose test it also enables), relative to the corner of the picture. */
void demo_viewport(int x, int y, int width, int height);
void demo_scissor(int x, int y, int width, int height);
void demo_scissor_off(void);

/* Has to follow every change of a perspective GL_PROJECTION matrix: with --view it replaces the matrix by that of the view. Orthographic
 * matrices stay as they are. */
void demo_projection_done(void);
/* The same for a column-major projection for shaders: with --view it becomes that of the view. */
void demo_view(GLfloat projection[16]);
/* The same for a sky, which is infinitely far in every view. */
void demo_view_sky(GLfloat projection[16]);
/* The same for an orthographic projection of a scene with depths, without a camera in it. */
void demo_view_slanted(GLfloat projection[16]);
/* Has to follow an orthographic GL_PROJECTION matrix of a scene with depths, while GL_PROJECTION is the matrix mode. */
void demo_slanted_done(void);
/* Loads a perspective projection and calls demo_projection_done(). fovy in degrees. */
void demo_perspective(double fovy, double aspect, double z_near, double z_far);
/* The same for a sky, which is infinitely far in every view. */
void demo_perspective_sky(double fovy, double aspect, double z_near, double z_far);
/* Has to follow an orthographic GL_PROJECTION matrix of a flat display: --hud-depth shifts the display as a whole. */
void demo_flat_done(void);

typedef void (*demo_function)(void);
demo_function demo_proc(const char *name); /* glXGetProcAddressARB and its counterparts; fails if null */

_Noreturn void demo_fail(int status, const char *format, ...);

/* ---- shapes.c: solids by glBegin/glEnd, with normals and texture coordinates ---- */
void demo_sphere(double radius, int slices, int stacks);
void demo_torus(double radius, double tube, int slices, int stacks);
void demo_box(double x, double y, double z); /* half sizes, around the origin */
/* A square texture of two colours with mipmaps; returns its name and leaves it bound. */
GLuint demo_checker(int size, int squares, const GLubyte a[3], const GLubyte b[3]);

/* ---- shaders.c ---- */
/* A linked program; the attribute `position` is at 0, `normal` at 1. In OpenGL ES, shaders of GLSL 1.20 and 3.30 are compiled as 1.00 and 3.00
 * es. */
GLuint demo_program(const char *vertex, const char *fragment);
/* A linked program of any stages, null for those without: vertex, tessellation control and evaluation, geometry, fragment. */
GLuint demo_stages(const char *const texts[5]);
/* A new buffer, left bound; without data it is for frequent updates. */
GLuint demo_buffer(GLenum target, const void *data, size_t size);
/* Fails where the context is older than `version`; 42 is OpenGL 4.2. */
void demo_needs(int version);
typedef GLfloat demo_matrix[16]; /* column-major */
void demo_times(demo_matrix out, const demo_matrix a, const demo_matrix b);
void demo_inverse(demo_matrix out, const demo_matrix m); /* of an invertible matrix */
/* A perspective projection before demo_view(). fovy in degrees. */
void demo_frustum(demo_matrix out, double fovy, double aspect, double z_near, double z_far);
/* The matrix of a camera with y upwards, and its inverse. */
void demo_look(demo_matrix out, demo_matrix back, const double from[3], const double to[3]);
/* Rotated about the unit vector (u, v, 0), then translated. */
void demo_turned(demo_matrix out, double angle, double u, double v, double x, double y, double z);

/* ---- png.c ---- */
/* RGB rows, the lowest first. */
int demo_write_png(const char *path, int width, int height, const unsigned char *rgb);

/* ---- window systems (glx.c, egl.c, osmesa.c) ---- */
struct demo_window {
    int width, height; /* the canvas */
    int samples, srgb, accumulation;
    int core;          /* 1: --profile core, an OpenGL 3.3 core context */
    int es;            /* 2 or 3: OpenGL ES of that version */
    int pbuffer;       /* 1: --surface pbuffer, 0: --surface window, -1: not given */
    const char *title;
};
struct demo_api {
    const char *name;
    void (*open)(struct demo_window *);
    int (*frame_end)(void); /* swaps; non-zero if the user asks to quit */
    demo_function (*proc)(const char *name);
    void (*close)(void);
    void (*raise)(void); /* puts the window before all others; null without a window system */
};
extern const struct demo_api demo_glx, demo_egl, demo_osmesa;

/* ---- bench.c ---- */
void demo_bench(const struct demo_api *api); /* --bench; returns at the end of stdin */

#endif
