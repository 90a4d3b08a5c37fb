/* Programs with shaders, and a quad over the whole viewport. */
#define GL_GLEXT_PROTOTYPES 1
#include <GL/gl.h>
#include <GL/glext.h>
#include <stddef.h>

/* Compiles a shader and attaches it to a program. */
static inline GLuint attached(GLuint program, GLenum kind, const char *text)
{
    GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    glAttachShader(program, shader);
    return shader;
}

/* A linked program, whose shaders stay attached; the attribute `place` has the given location. */
static inline GLuint linked(const char *vertex, const char *fragment, GLuint place)
{
    GLuint program = glCreateProgram();
    attached(program, GL_VERTEX_SHADER, vertex);
    attached(program, GL_FRAGMENT_SHADER, fragment);
    glBindAttribLocation(program, place, "place");
    glLinkProgram(program);
    return program;
}

/* Draws corners at -1 and 1 in the attribute at this location. */
static inline void quad(GLuint place)
{
    static const GLfloat corners[] = {-1, -1, 1, -1, 1, 1, -1, 1};
    glEnableVertexAttribArray(place);
    glVertexAttribPointer(place, 2, GL_FLOAT, GL_FALSE, 0, corners);
    glDrawArrays(GL_TRIANGLE_FAN, 0, 4);
}
