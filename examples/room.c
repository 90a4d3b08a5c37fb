/* A room of textured quads by glBegin/glEnd, seen in perspective, and over it a flat display: panels
 * and text as blended textured quads, numbers drawn with GL_LINES, no depth test. */
#include "demo.h"
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

DEMO_NO_OPTIONS;

/* 3 by 5 pixels for each letter, the top row first, three bits a row. */
static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789:.%-";
static const char *const glyphs[] = {
    "25755", "65656", "34443", "65556", "74647", "74644", "34553", "55755", "72227", "11152", "55655", "44447",
    "57755", "57775", "25552", "65644", "25573", "65655", "34216", "72222", "55557", "55552", "55775", "55255",
    "55222", "71247", "75557", "26227", "61247", "61216", "55711", "74616", "34656", "71222", "25252", "35316",
    "02020", "00002", "51245", "00700"};
/* The seven strokes of a digit (x0 y0 x1 y1), and those that each digit has. */
static const int stroke[7][4] = {{0, 2, 1, 2}, {1, 2, 1, 1}, {1, 1, 1, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}, {0, 1, 0, 2}, {0, 1, 1, 1}};
static const int digit_strokes[10] = {63, 6, 91, 79, 102, 109, 125, 7, 127, 111};

static GLuint font, brick, tiles, panel_wood;

static void make_font(void)
{
    static GLubyte texels[8][256]; /* one letter every 4 columns, in rows 1 to 5 */
    for (int l = 0; letters[l]; l++)
        for (int y = 0; y < 5; y++)
            for (int x = 0; x < 3; x++)
                if ((glyphs[l][y] - '0') >> (2 - x) & 1)
                    texels[6 - y - 1][4 * l + x] = 255;
    glGenTextures(1, &font);
    glBindTexture(GL_TEXTURE_2D, font);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_ALPHA8, 256, 8, 0, GL_ALPHA, GL_UNSIGNED_BYTE, texels);
}

static void text(double x, double y, double size, const char *s)
{
    glBindTexture(GL_TEXTURE_2D, font);
    glBegin(GL_QUADS);
    for (; *s; s++, x += 4 * size) {
        const char *l = strchr(letters, toupper((unsigned char)*s));
        if (!l)
            continue;
        double u = 4.0 * (double)(l - letters);
        for (int c = 0; c < 4; c++) {
            int right = c == 1 || c == 2, top = c >= 2;
            glTexCoord2d((u + 3 * right) / 256.0, (1 + 5 * top) / 8.0);
            glVertex2d(x + 3 * size * right, y + 5 * size * top);
        }
    }
    glEnd();
}

static void line_number(double x, double y, double size, const char *digits)
{
    glBegin(GL_LINES);
    for (; *digits; digits++, x += 1.7 * size)
        for (int s = 0; s < 7; s++)
            if (isdigit((unsigned char)*digits) && digit_strokes[*digits - '0'] >> s & 1)
                for (int e = 0; e < 2; e++)
                    glVertex2d(x + size * stroke[s][2 * e], y + size * stroke[s][2 * e + 1]);
    glEnd();
}

/* A wall from corner o along the vectors a and b, with a repeated texture; subdivided for the lamp's light. */
static void wall(const double *o, const double *a, const double *b, double repeat_a, double repeat_b)
{
    enum { CUTS = 8 };
    double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    glNormal3dv(n);
    glBegin(GL_QUADS);
    for (int j = 0; j < CUTS; j++)
        for (int i = 0; i < CUTS; i++)
            for (int c = 0; c < 4; c++) {
                double s = (i + (c == 1 || c == 2)) / (double)CUTS, t = (j + (c >= 2)) / (double)CUTS;
                glTexCoord2d(repeat_a * s, repeat_b * t);
                glVertex3d(o[0] + s * a[0] + t * b[0], o[1] + s * a[1] + t * b[1], o[2] + s * a[2] + t * b[2]);
            }
    glEnd();
}

static void scene(double t)
{
    static const double x8[3] = {8, 0, 0}, y5[3] = {0, 5, 0}, z14[3] = {0, 0, 14}, minus_x8[3] = {-8, 0, 0}, minus_z14[3] = {0, 0, -14},
                        floor_o[3] = {-4, -2.5, 4}, back[3] = {-4, -2.5, -10}, right[3] = {4, -2.5, 4}, ceiling[3] = {4, 2.5, 4};
    static const GLfloat lamp[4] = {0.0f, 2.0f, -2.0f, 1.0f};
    glLightfv(GL_LIGHT0, GL_POSITION, lamp);
    glColor3f(1.0f, 1.0f, 1.0f);
    glBindTexture(GL_TEXTURE_2D, tiles);
    wall(floor_o, x8, minus_z14, 2, 3.5);
    glColor3f(0.71f, 0.75f, 0.8f);
    wall(ceiling, minus_x8, minus_z14, 1, 2);
    glBindTexture(GL_TEXTURE_2D, brick);
    glColor3f(1.0f, 0.95f, 0.91f);
    wall(back, x8, y5, 2, 1.25);
    wall(back, y5, z14, 1.25, 3.5);
    glColor3f(0.71f, 0.91f, 1.0f);
    wall(right, y5, minus_z14, 1.25, 3.5);

    glBindTexture(GL_TEXTURE_2D, panel_wood);
    for (int i = 0; i < 5; i++) { /* crates, from near to far */
        glPushMatrix();
        glTranslated(i % 2 ? 1.9 : -1.7, -1.7 + 0.2 * (i % 3), 1.4 - 2.4 * i);
        glRotated(20.0 * i + 50.0 * t, 0.0, 1.0, 0.0);
        glColor3d(1.0, 1.0 - 0.11 * i, 0.6 + 0.11 * i);
        demo_box(0.7, 0.7, 0.7);
        glPopMatrix();
    }
    /* A pane of glass in the middle, blended over the things behind it. */
    glDisable(GL_TEXTURE_2D);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glColor4f(0.2f, 0.91f, 0.6f, 0.35f);
    glBegin(GL_QUADS);
    glNormal3d(0.0, 0.0, 1.0);
    glVertex3d(-1.2, -1.8, -0.5);
    glVertex3d(1.4, -1.8, -1.5);
    glVertex3d(1.4, 1.2, -1.5);
    glVertex3d(-1.2, 1.2, -0.5);
    glEnd();
    glEnable(GL_TEXTURE_2D);
    glDisable(GL_BLEND);
}

static void display(int frame)
{
    char s[32];
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glOrtho(0.0, 512.0, 0.0, 384.0, -1.0, 1.0); /* always 512x384 units, whatever the size */
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_LIGHTING);
    glEnable(GL_BLEND);
    glDisable(GL_TEXTURE_2D);
    glColor4f(0.0f, 0.05f, 0.11f, 0.55f);
    glRecti(8, 8, 200, 70);
    glRectd(400.0, 330.0, 504.0, 376.0);
    glEnable(GL_TEXTURE_2D);
    glColor4f(1.0f, 0.85f, 0.2f, 1.0f);
    snprintf(s, sizeof s, "FRAME %d", frame);
    text(18, 44, 4, s);
    glColor4f(0.6f, 1.0f, 0.71f, 0.91f);
    text(18, 20, 3, "QUIET ROOM: 62%");
    glDisable(GL_TEXTURE_2D);
    glColor4f(1.0f, 0.31f, 0.31f, 1.0f);
    snprintf(s, sizeof s, "%04d", 100 * frame / 6);
    line_number(415.0, 340.5, 12.0, s);
    glColor4f(1.0f, 1.0f, 1.0f, 0.8f);
    glBegin(GL_LINES); /* cross-hair */
    glVertex2d(246.5, 192.5); glVertex2d(266.5, 192.5);
    glVertex2d(256.5, 182.5); glVertex2d(256.5, 202.5);
    glEnd();
    glDisable(GL_BLEND);
    glEnable(GL_TEXTURE_2D);
    glEnable(GL_LIGHTING);
    glEnable(GL_DEPTH_TEST);
}

void demo_setup(void)
{
    static const GLubyte red[3] = {190, 90, 70}, mortar[3] = {200, 190, 175}, black[3] = {60, 65, 70},
                         white[3] = {225, 225, 220}, oak[3] = {190, 140, 80}, pale[3] = {225, 190, 130};
    make_font();
    brick = demo_checker(64, 4, red, mortar);
    tiles = demo_checker(64, 2, black, white);
    panel_wood = demo_checker(64, 8, oak, pale);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_TEXTURE_2D);
    glEnable(GL_LIGHTING);
    glEnable(GL_LIGHT0);
    glEnable(GL_NORMALIZE);
    glLightf(GL_LIGHT0, GL_LINEAR_ATTENUATION, 0.06f);
    glEnable(GL_COLOR_MATERIAL);
}

void demo_frame(int frame)
{
    double t = demo_time(frame);
    demo_viewport(0, 0, demo_width, demo_height);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    demo_perspective(50.0, (double)demo_width / demo_height, 1.0, 50.0);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslated(0.0, 0.0, -7.0);
    glRotated(8.0 * sin(t) + 6.0, 0.0, 1.0, 0.0);
    scene(t);
    display(frame);
}
