/* Display lists as in old programs: solids, nested figures, letters by glCallLists, a camera and a head-up display inside lists, lists that
 * push or change state for later commands, a list compiled again in every frame. */
#include "demo.h"
#include <math.h>
#include <string.h>

DEMO_NO_OPTIONS;

static GLuint letters, cube, arm, figure, view, floor_list, hud, sweep, paint, push, label;

/* 5 x 7 points, the lowest row first. */
static const struct { char letter; GLubyte rows[7]; } font[] = {
    {'A', {0x88, 0x88, 0xF8, 0x88, 0x88, 0x50, 0x20}}, {'D', {0xF0, 0x88, 0x88, 0x88, 0x88, 0x88, 0xF0}},
    {'E', {0xF8, 0x80, 0x80, 0xF0, 0x80, 0x80, 0xF8}}, {'I', {0x70, 0x20, 0x20, 0x20, 0x20, 0x20, 0x70}},
    {'L', {0xF8, 0x80, 0x80, 0x80, 0x80, 0x80, 0x80}}, {'R', {0x88, 0x90, 0xA0, 0xF0, 0x88, 0x88, 0xF0}},
    {'S', {0xF0, 0x08, 0x08, 0x70, 0x80, 0x80, 0x78}}, {'T', {0x20, 0x20, 0x20, 0x20, 0x20, 0x20, 0xF8}},
};

static void text(const char *s)
{
    glPushAttrib(GL_LIST_BIT);
    glListBase(letters);
    glCallLists((GLsizei)strlen(s), GL_UNSIGNED_BYTE, s);
    glPopAttrib();
}

static void make_letters(void)
{
    static const GLubyte nothing;
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    letters = glGenLists(128);
    for (size_t i = 0; i < sizeof font / sizeof *font; i++) {
        glNewList(letters + (GLuint)font[i].letter, GL_COMPILE);
        glBitmap(5, 7, 0.0f, 0.0f, 7.0f, 0.0f, font[i].rows);
        glEndList();
    }
    glNewList(letters + ' ', GL_COMPILE);
    glBitmap(1, 1, 0.0f, 0.0f, 4.0f, 0.0f, &nothing);
    glEndList();
}

static void make_solids(void)
{
    cube = glGenLists(1);
    glNewList(cube, GL_COMPILE);
    demo_box(0.5, 0.5, 0.5);
    glEndList();

    arm = glGenLists(1);
    glNewList(arm, GL_COMPILE); /* ends at the joint of the next part */
    glPushMatrix();
    glScaled(0.3, 1.0, 0.3);
    glCallList(cube);
    glPopMatrix();
    glTranslated(0.0, 1.1, 0.0);
    glEndList();

    figure = glGenLists(1);
    glNewList(figure, GL_COMPILE);
    glPushAttrib(GL_CURRENT_BIT | GL_LIGHTING_BIT);
    glPushMatrix();
    for (int i = 0; i < 4; i++) {
        glColor3d(0.91 - 0.17 * i, 0.29, 0.23 + 0.15 * i);
        glRotated(25.0, 0.2, 0.1, 1.0);
        glCallList(arm);
    }
    glPopMatrix();
    glPopAttrib();
    glEndList();

    floor_list = glGenLists(1);
    glNewList(floor_list, GL_COMPILE);
    glDisable(GL_LIGHTING);
    glBegin(GL_QUADS);
    for (int i = -3; i < 3; i++)
        for (int j = -3; j < 3; j++) {
            double c = (i + j) & 1 ? 0.13 : 0.27;
            glColor3d(c, c, 1.5 * c);
            glVertex3d(i, -1.3, j);
            glVertex3d(i, -1.3, j + 1);
            glVertex3d(i + 1, -1.3, j + 1);
            glVertex3d(i + 1, -1.3, j);
        }
    glEnd();
    glEnable(GL_LIGHTING);
    glEndList();
}

void demo_setup(void)
{
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_LIGHTING);
    glEnable(GL_LIGHT0);
    glEnable(GL_NORMALIZE);
    glEnable(GL_COLOR_MATERIAL);
    make_letters();
    make_solids();

    sweep = glGenLists(1);
    glNewList(sweep, GL_COMPILE);
    glClearColor(0.10f, 0.12f, 0.17f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glEndList();

    paint = glGenLists(1);
    glNewList(paint, GL_COMPILE); /* sets state for later commands */
    glColor3d(0.93, 0.77, 0.19);
    glEndList();

    push = glGenLists(1);
    glNewList(push, GL_COMPILE); /* is popped outside the list */
    glPushMatrix();
    glTranslated(1.6, 0.1, 1.2);
    glEndList();

    label = glGenLists(1);
    glNewList(label, GL_COMPILE);
    glDisable(GL_LIGHTING);
    glColor3d(0.77, 0.91, 0.61);
    glRasterPos3d(-1.9, 1.3, -1.1);
    text("LISTS");
    glEnable(GL_LIGHTING);
    glEndList();

    view = glGenLists(1);
    hud = glGenLists(1);
}

static void make_view(void)
{ /* the camera; its projection is known only outside the list */
    GLfloat projection[16];
    demo_perspective(45.0, (double)demo_width / demo_height, 1.5, 40.0);
    glGetFloatv(GL_PROJECTION_MATRIX, projection);
    glLoadIdentity();
    glNewList(view, GL_COMPILE);
    glMatrixMode(GL_PROJECTION);
    glLoadMatrixf(projection);
    glMatrixMode(GL_MODELVIEW);
    glTranslated(0.0, 0.0, -8.0);
    glRotated(15.0, 1.0, 0.0, 0.0);
    glCallList(floor_list);
    glEndList();
}

static void make_hud(int frame)
{
    glNewList(hud, GL_COMPILE_AND_EXECUTE);
    glPushAttrib(GL_ENABLE_BIT | GL_CURRENT_BIT);
    glDisable(GL_LIGHTING);
    glDisable(GL_DEPTH_TEST);
    glMatrixMode(GL_PROJECTION);
    glPushMatrix();
    glLoadIdentity();
    glOrtho(0.0, demo_width, 0.0, demo_height, -1.0, 1.0);
    glMatrixMode(GL_MODELVIEW);
    glPushMatrix();
    glLoadIdentity();
    glColor3d(0.23, 0.07, 0.11);
    glRectd(6.0, 6.0, 80.0 + frame, 20.0);
    glColor3d(0.97, 0.91, 0.83);
    glRasterPos2d(10.25, 10.25);
    text("A LIST");
    glPopMatrix();
    glMatrixMode(GL_PROJECTION);
    glPopMatrix();
    glMatrixMode(GL_MODELVIEW);
    glPopAttrib();
    glEndList();
}

void demo_frame(int frame)
{
    static const GLfloat light[4] = {1.5f, 2.5f, 2.0f, 0.0f};
    double t = demo_time(frame);

    demo_viewport(0, 0, demo_width, demo_height);
    make_view();
    glCallList(sweep);
    glLightfv(GL_LIGHT0, GL_POSITION, light);
    glCallList(view);
    glPushMatrix();
    glRotated(40.0 * t, 0.0, 1.0, 0.0);
    glTranslated(-1.0, -0.8, 0.0);
    glCallList(figure);
    glPopMatrix();
    glCallList(push);
    glCallList(paint);
    glRotated(60.0 * t + 10.0, 0.3, 1.0, 0.1);
    glCallList(cube);
    glPopMatrix();
    glCallList(label);
    glRasterPos3d(1.3, -0.9, 2.0);
    text("RIDE ");
    text("AT");
    make_hud(frame);
}
