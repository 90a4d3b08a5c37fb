/* Draws a frame, forks, and lets the child draw until the file CHILD exists; then the parent draws until STOP exists.
 *   splits CHILD STOP
 * Both draw into memory, because two processes cannot share a connection to an X server. */
#include <GL/gl.h>
#include <GL/osmesa.h>
#include <sys/wait.h>
#include <unistd.h>

enum { WIDTH = 64, HEIGHT = 48, FRAMES = 20000 };

static unsigned char buffer[WIDTH * HEIGHT * 4];

static void until(const char *file)
{
    for (int i = 0; i < FRAMES && access(file, F_OK); i++) {
        glClear(GL_COLOR_BUFFER_BIT);
        glRectf(-0.5f, -0.5f, 0.5f, 0.5f);
        glFinish();
        usleep(2000);
    }
}

int main(int count, char **arguments)
{
    OSMesaContext context = OSMesaCreateContextExt(OSMESA_RGBA, 16, 0, 0, NULL);
    if (count < 3 || !OSMesaMakeCurrent(context, buffer, GL_UNSIGNED_BYTE, WIDTH, HEIGHT))
        return 2;
    glRectf(-0.5f, -0.5f, 0.5f, 0.5f);
    glFinish();
    pid_t child = fork();
    if (!child) {
        until(arguments[1]);
        OSMesaDestroyContext(context);
        _exit(0);
    }
    int status = 1;
    waitpid(child, &status, 0);
    until(arguments[2]);
    OSMesaDestroyContext(context);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}
