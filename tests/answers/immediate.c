/* Transform feedback of each kind of primitive is active while primitives of each mode begin and end, without vertices and with four.
 *
 *   immediate
 *
 * Prints errors and queries. */
#include "../support/c/shaders.h"
#include "../support/c/surface.h"

static const char *const vertex = "#version 120\nvarying vec4 fed; void main() { fed = gl_Vertex; gl_Position = gl_Vertex; }\n";

static GLuint feeding(void)
{
    static const char *const name = "fed";
    GLuint program = glCreateProgram();
    attached(program, GL_VERTEX_SHADER, vertex);
    glTransformFeedbackVaryings(program, 1, &name, GL_INTERLEAVED_ATTRIBS);
    glLinkProgram(program);
    return program;
}

static const GLfloat corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

/* One query counts primitives that change the colour after their first vertex, and others. */
static void counted(void)
{
    GLuint query, samples = 0;
    glGenQueries(1, &query);
    glBeginQuery(GL_SAMPLES_PASSED, query);
    glBeginTransformFeedback(GL_TRIANGLES);
    for (int primitive = 0; primitive < 4; primitive++) {
        glBegin(GL_TRIANGLES);
        for (int i = 0; i < 3; i++) {
            glVertex2f(corners[i][0] / (float)(primitive + 1), corners[i][1]);
            if (primitive % 2 == 0)
                glColor3f(1, 0, 0.25f * (float)i);
        }
        glEnd();
    }
    glEndTransformFeedback();
    glEndQuery(GL_SAMPLES_PASSED);
    glGetQueryObjectuiv(query, GL_QUERY_RESULT, &samples);
    printf("%u samples, error 0x%x\n", samples, glGetError());
}

static void fed(void)
{
    static const GLenum kinds[] = {GL_POINTS, GL_LINES, GL_TRIANGLES};
    GLuint buffer, queries[2], written = 99, generated = 99, program = feeding();
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, buffer);
    glBufferData(GL_TRANSFORM_FEEDBACK_BUFFER, 4096, NULL, GL_DYNAMIC_COPY);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
    glGenQueries(2, queries);
    glUseProgram(program);
    for (int k = 0; k < 3; k++) {
        glBeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, queries[0]);
        glBeginQuery(GL_PRIMITIVES_GENERATED, queries[1]);
        glBeginTransformFeedback(kinds[k]);
        for (GLenum mode = GL_POINTS; mode <= GL_POLYGON; mode++) {
            glBegin(mode);
            glEnd();
            printf("%u, mode %u, empty: error 0x%x\n", kinds[k], mode, glGetError());
            /* Not allowed within a primitive; a mode of another kind has not begun one. */
            GLfloat raster[4];
            glBegin(mode);
            glWindowPos2f((float)(10 * k) + (float)mode, 1);
            glEnd();
            glGetFloatv(GL_CURRENT_RASTER_POSITION, raster);
            printf("  raster position %g, error 0x%x\n", (double)raster[0], glGetError());
        }
        /* Mesa 22.3 loses a primitive of the mode of an empty one before it. */
        glFlush();
        for (GLenum mode = GL_POINTS; mode <= GL_POLYGON; mode++) {
            glBegin(mode);
            for (int i = 0; i < 4; i++)
                glVertex2fv(corners[i]);
            glEnd();
            glFlush();
            printf("%u, mode %u: error 0x%x\n", kinds[k], mode, glGetError());
        }
        glEndTransformFeedback();
        glEndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
        glEndQuery(GL_PRIMITIVES_GENERATED);
        glGetQueryObjectuiv(queries[0], GL_QUERY_RESULT, &written);
        glGetQueryObjectuiv(queries[1], GL_QUERY_RESULT, &generated);
        printf("%u: %u written, %u generated, error 0x%x\n", kinds[k], written, generated, glGetError());
    }
    counted();
    glUseProgram(0);
}

int main(void)
{
    if (!open_surface() || !new_context(EGL_NO_CONTEXT))
        return 1;
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    fed();
    eglSwapBuffers(display, surface);
    return 0;
}
