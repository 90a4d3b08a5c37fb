/* A program that numbers its textures itself, in two contexts that share objects. Both have drawn before it does, so that the layers of both
 * have textures.
 *
 *   shares bind      binds names that it has not asked for
 *   shares delete    deletes them before
 *   shares late      makes the second context only then
 *
 * Prints which textures exist, their contents, and what the windows show. */
#include "shown.h"
#include <string.h>

enum { NAMES = 24 };

static GLXContext sharing(const struct window *w, GLXContext with)
{
    int wanted[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 8, GLX_DEPTH_SIZE, 24, None};
    XVisualInfo *visual = glXChooseVisual(w->display, DefaultScreen(w->display), wanted);
    return glXCreateContext(w->display, visual, with, True);
}

static void frame(const struct window *w, const char *what, int number)
{
    halves(number);
    shown(w, what, number);
    glXSwapBuffers(w->display, w->window);
    shown(w, what, number);
}

/* A texel of each texture, drawn over the window from left to right. */
static void textures(const struct window *w, const char *what)
{
    glClear(GL_COLOR_BUFFER_BIT);
    glColor3f(1, 1, 1);
    glEnable(GL_TEXTURE_2D);
    for (GLuint name = 1; name <= NAMES; name++) {
        unsigned char texel[4] = {0};
        if (!glIsTexture(name)) {
            printf("%s: no %u\n", what, name);
            continue;
        }
        glBindTexture(GL_TEXTURE_2D, name);
        glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, texel);
        printf("%s %u: %d %d %d\n", what, name, texel[0], texel[1], texel[2]);
        float x = -1 + 2.0f * (float)(name - 1) / NAMES;
        glRectf(x, -1, x + 2.0f / NAMES, 1);
    }
    glBindTexture(GL_TEXTURE_2D, 0);
    glDisable(GL_TEXTURE_2D);
    glXSwapBuffers(w->display, w->window);
    shown(w, what, 0);
}

int main(int count, char **arguments)
{
    const char *way = count > 1 ? arguments[1] : "";
    struct window first = open_window();
    make_current(&first);
    frame(&first, "first", 0);
    /* Only windows of one connection share objects. */
    struct window second = open_window(), other = second;
    if (strcmp(way, "late")) {
        other.display = first.display;
        other.context = sharing(&first, first.context);
        glXMakeCurrent(other.display, other.window, other.context);
        frame(&other, "second", 1);
        make_current(&first);
        frame(&first, "first", 2);
    }
    for (GLuint name = 1; name <= NAMES; name++) {
        unsigned char texel[4] = {(unsigned char)(name * 10), 255, (unsigned char)(255 - name * 10), 255};
        printf("is %u: %d\n", name, glIsTexture(name));
        if (!strcmp(way, "delete"))
            glDeleteTextures(1, &name);
        glBindTexture(GL_TEXTURE_2D, name);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, texel);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    }
    glBindTexture(GL_TEXTURE_2D, 0);
    if (!strcmp(way, "late")) {
        other.display = first.display;
        other.context = sharing(&first, first.context);
    }
    textures(&first, "first's textures");
    glXMakeCurrent(other.display, other.window, other.context);
    shown(&other, "second", 1);
    frame(&other, "second", 3);
    textures(&other, "second's textures");
    make_current(&first);
    frame(&first, "first", 4);
    textures(&first, "first's textures");
    printf("error: %x\n", glGetError());
    glXMakeCurrent(first.display, None, NULL);
    glXDestroyContext(first.display, other.context);
    close_window(&second);
    close_window(&first);
    return 0;
}
