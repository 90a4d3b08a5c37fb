/* Conditional rendering on queries that count several draws; prints the pixels, and every error. */
#include "surface.h"

/* Samples behind the wall do not count. */
static void quad(float depth, float red)
{
    glColor3f(red, 0, 0);
    glBegin(GL_QUADS);
    glVertex3f(-1, -1, depth);
    glVertex3f(1, -1, depth);
    glVertex3f(1, 1, depth);
    glVertex3f(-1, 1, depth);
    glEnd();
}

static void tell(const char *what)
{
    unsigned char pixel[4];
    glReadPixels(32, 24, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
    printf("%s: red %d, error 0x%x\n", what, pixel[0], glGetError());
}

static void wall(void)
{
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    quad(0, 0);
}

int main(void)
{
    if (!open_surface())
        return 2;
    if (!new_context(EGL_NO_CONTEXT))
        return 2;
    glEnable(GL_DEPTH_TEST);
    GLuint query;
    glGenQueries(1, &query);
    static const struct { GLenum target, mode; const char *name; } kinds[] = {
        {GL_SAMPLES_PASSED, GL_QUERY_WAIT, "samples"},
        {GL_SAMPLES_PASSED, GL_QUERY_BY_REGION_NO_WAIT, "samples, no wait"},
        {GL_SAMPLES_PASSED, GL_QUERY_WAIT_INVERTED, "samples, inverted"},
    };
    for (unsigned k = 0; k < sizeof kinds / sizeof *kinds; k++)
        for (unsigned seen = 0; seen < 8; seen++) {
            wall();
            glDepthMask(GL_FALSE);
            glColorMask(0, 0, 0, 0);
            glBeginQuery(kinds[k].target, query);
            for (unsigned draw = 0; draw < 3; draw++)
                quad(seen >> draw & 1 ? -0.5f : 0.5f, 1);
            glEndQuery(kinds[k].target);
            glColorMask(1, 1, 1, 1);
            GLuint result;
            glGetQueryObjectuiv(query, GL_QUERY_RESULT, &result); /* waits, so that "no wait" finds the result */
            glBeginConditionalRender(query, kinds[k].mode);
            quad(-0.6f, 1);
            glEndConditionalRender();
            char text[80];
            snprintf(text, sizeof text, "%s, seen %u, counted %u", kinds[k].name, seen, result);
            tell(text);
            glDepthMask(GL_TRUE);
        }
    /* A frame that ends under a condition is shown all the same. */
    glClearColor(1, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glBeginQuery(GL_SAMPLES_PASSED, query);
    glEndQuery(GL_SAMPLES_PASSED);
    glBeginConditionalRender(query, GL_QUERY_WAIT);
    eglSwapBuffers(display, surface);
    glBeginConditionalRender(query, GL_QUERY_WAIT);
    tell("one in the other");
    glClear(GL_DEPTH_BUFFER_BIT);
    glEndConditionalRender();
    tell("ended");
    glEndConditionalRender();
    tell("not begun");
    glBeginConditionalRender(query + 100, GL_QUERY_WAIT);
    tell("no query");
    glBeginConditionalRender(query, GL_RED);
    tell("no mode");
    glBeginQuery(GL_SAMPLES_PASSED, query);
    quad(-0.7f, 1);
    quad(-0.8f, 1);
    glBeginConditionalRender(query, GL_QUERY_WAIT);
    tell("while it counts");
    glEndQuery(GL_SAMPLES_PASSED);
    eglSwapBuffers(display, surface);
    return 0;
}
