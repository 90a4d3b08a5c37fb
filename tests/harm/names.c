/* Names of display lists in the places where the layer's own lists could be in the way.
 *
 *   names compile LIST   asks for names in a list of GL_COMPILE; names below it are free
 *   names execute LIST   the same in a list of GL_COMPILE_AND_EXECUTE
 *   names empty LIST     the same in a list of GL_COMPILE that has nothing in it yet
 *   names high LIST      uses a name near the highest one and then asks for names
 *   names taken LIST     uses names from LIST upwards that it has not asked for, and calls the lists that it compiled before
 *
 * Prints each name, the lists that exist, and pixels. */
#include "../hosts/scene.h"
#include "../hosts/window.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void square(float x, float red, float green)
{
    glColor3f(red, green, 0);
    glBegin(GL_QUADS);
    glVertex2f(x, -1);
    glVertex2f(x + 1, -1);
    glVertex2f(x + 1, 1);
    glVertex2f(x, 1);
    glEnd();
}

static void pixel(const char *what, int x)
{
    unsigned char p[4];
    glReadPixels(x, HEIGHT / 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, p);
    printf("%s: %d %d %d\n", what, p[0], p[1], p[2]);
}

static void exist(GLuint first, GLuint last)
{
    printf("lists:");
    for (GLuint list = first; list < last; list++)
        if (glIsList(list))
            printf(" %x", list);
    printf("\n");
}

static void asks(GLuint list, const char *way)
{
    printf("eight: %u\n", glGenLists(8));
    /* The layer keeps several lists of its own for this one, which lie above all names of the program. */
    glNewList(1, GL_COMPILE);
    square(-1, 1, 1);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    square(0, 1, 1);
    glEndList();
    glDeleteLists(3, 4);
    glNewList(list, strcmp(way, "execute") ? GL_COMPILE : GL_COMPILE_AND_EXECUTE);
    if (strcmp(way, "empty"))
        square(-1, 1, 0);
    printf("two: %u\n", glGenLists(2));
    printf("four: %u\n", glGenLists(4));
    printf("none: %u\n", glGenLists(0));
    printf("wrong: %u\n", glGenLists(-1));
    glDeleteLists(7, 1);
    exist(1, 24);
    square(0, 0, 1);
    GLint open = 0;
    glGetIntegerv(GL_LIST_INDEX, &open);
    printf("open: %d\n", open);
    glEndList();
    exist(1, 24);
    pixel("compiled", WIDTH / 4);
    glCallList(list);
    pixel("called, left", WIDTH / 4);
    pixel("called, right", 3 * WIDTH / 4);
    printf("one: %u\n", glGenLists(1));
}

static void high(GLuint list)
{
    glNewList(list, GL_COMPILE);
    square(-1, 1, 0);
    glEndList();
    printf("one: %x\n", glGenLists(1));
    printf("three: %x\n", glGenLists(3));
    glNewList(list, GL_COMPILE);
    square(-1, 0, 1);
    printf("in a list: %x\n", glGenLists(3));
    glEndList();
    exist(1, 24);
    exist(0xfffffff0, 0xffffffff);
    glCallList(list);
    pixel("called", WIDTH / 4);
}

static void taken(GLuint list)
{
    for (GLuint own = 1; own < 4; own++) {
        glNewList(own, GL_COMPILE);
        square(-1, (float)own / 3, 0);
        glEndList();
    }
    for (GLuint other = list; other < list + 4; other++) {
        printf("is %x: %d\n", other, glIsList(other));
        glNewList(other, GL_COMPILE);
        square(-1, 0, (float)(other - list + 1) / 4);
        glEndList();
    }
    exist(list, list + 4);
    for (GLuint own = 1; own < 4; own++) {
        glCallList(own);
        pixel("own", WIDTH / 4);
        glCallList(list + own);
        pixel("other", WIDTH / 4);
    }
    glDeleteLists(list, 4);
    glCallList(1);
    pixel("own again", WIDTH / 4);
}

int main(int count, char **arguments)
{
    if (count < 3)
        return 1;
    const char *way = arguments[1];
    GLuint list = (GLuint)strtoul(arguments[2], NULL, 0);
    struct window w = open_window();
    make_current(&w);
    glClear(GL_COLOR_BUFFER_BIT);
    if (!strcmp(way, "high"))
        high(list);
    else if (!strcmp(way, "taken"))
        taken(list);
    else
        asks(list, way);
    printf("error: %x\n", glGetError());
    glXSwapBuffers(w.display, w.window);
    close_window(&w);
    return 0;
}
