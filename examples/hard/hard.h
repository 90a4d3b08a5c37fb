/* Scenes that are hard to draw in several views; src/bench/hard/cases.rs says what is measured of each. A process draws one case, so none
 * depends on state of another. */
#ifndef HARD_H
#define HARD_H

#include "demo.h"
#include <stddef.h>

struct hard_case {
    const char *name, *about;
    void (*setup)(void); /* null if there is nothing to prepare */
    void (*draw)(int frame);
};
extern const struct hard_case places_cases[], depths_cases[], surfaces_cases[], answers_cases[], hidden_cases[];

/* The camera of most scenes: a picture 1.6 wide and 1.2 high at depth 1. */
void usual_frustum(double z_near, double z_far);

/* ---- vertices: collected and drawn by glDrawArrays, or by glBegin between send_immediate(1) and send_immediate(0) ---- */
void send_immediate(int immediate);
void start(GLenum mode);
void colour(unsigned rgb);
void normal(double x, double y, double z);
void texture(double s, double t);
void at(double x, double y, double z);
void at4(double x, double y, double z, double w);
void finish(void);
/* A patch of columns x rows cells between four corners, in strip order: the first two form one side. */
void patch(const double corner[4][3], int columns, int rows, const unsigned rgb[2]);

/* ---- markers: parallelograms whose centre can be measured in a picture to 0.01 pixels ----
 * Their edges lean by 10 pixels over 149 rows, so that the rows together resolve 1/149 of a pixel. */
enum { MARKER_ROWS = 149, MARKER_LEAN = 10 };
/* Corners of the marker whose centre is at the pixel column x: pixels, the lowest row first. */
void marker_corners(double x, double corner[4][2]);
/* Prints what to measure: colour, column in the program's own picture, depth (may be INFINITY). */
void tell_marker(unsigned rgb, double x, double depth);
/* Prints P[0][0] of the camera over the length of row 3. */
void tell_lens(double a);
/* Draws a marker at `depth` under a frustum |x| <= 1/a, |y| <= 1/b at depth 1, with its vertices multiplied by w. */
void marker(unsigned rgb, double x, double depth, double w, double a, double b);

#endif
