/* Standard error that must not be written to, from the start of a program. The program sets it up, starts itself again and draws.
 *
 *   silent broken     a pipe that nobody reads any more: SIGPIPE
 *   silent full       a pipe that holds no more, and that nobody reads: a write never returns
 *   silent device     /dev/full
 *   silent limit      a file that has reached the limit of the process for files: SIGXFSZ
 *   silent terminal   a terminal that stops what writes to it from the background: SIGTTOU
 *   silent closed     closed
 *   silent number     closed, and then the number of a file of the program's own
 *
 * Prints what the window shows, and what the file holds. */
#define _GNU_SOURCE
#include "shown.h"
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

static int is(const char *a, const char *b)
{
    return !strcmp(a, b);
}

static void draw(const char *mode, const char *file)
{
    char held[64] = "";
    int own = is(mode, "number") ? open(file, O_RDWR | O_CREAT | O_TRUNC, 0600) : -1;
    struct window w = open_window();
    make_current(&w);
    for (int frame = 0; frame < 2; frame++) {
        halves(frame);
        glXSwapBuffers(w.display, w.window);
        shown(&w, "frame", frame);
    }
    close_window(&w);
    if (own >= 0) {
        ssize_t length = pread(own, held, sizeof held - 1, 0);
        printf("the file is number %d and holds %zd bytes: %s\n", own, length, held);
    }
}

/* The end of a pipe to write to. */
static int pipe_end(int full)
{
    int ends[2];
    if (pipe(ends))
        exit(5);
    if (full) {
        fcntl(ends[1], F_SETFL, O_NONBLOCK);
        while (write(ends[1], "x", 1) == 1)
            ;
        fcntl(ends[1], F_SETFL, 0);
    } else
        close(ends[0]);
    return ends[1];
}

static int limited(const char *file)
{
    struct rlimit one = {1, 1};
    int out = open(file, O_WRONLY | O_CREAT | O_APPEND, 0600);
    if (write(out, "x", 1) != 1 || setrlimit(RLIMIT_FSIZE, &one))
        exit(5);
    return out;
}

/* A terminal that controls a session; the caller goes on in a group that is not in its foreground. */
static int terminal(void)
{
    int master = posix_openpt(O_RDWR | O_NOCTTY), status;
    grantpt(master);
    unlockpt(master);
    pid_t session = fork();
    if (session > 0) {
        waitpid(session, &status, 0);
        exit(WIFEXITED(status) ? WEXITSTATUS(status) : 6);
    }
    setsid();
    int slave = open(ptsname(master), O_RDWR);
    struct termios how;
    ioctl(slave, TIOCSCTTY, 0);
    tcgetattr(slave, &how);
    how.c_lflag |= TOSTOP;
    tcsetattr(slave, TCSANOW, &how);
    pid_t background = fork();
    if (background > 0) {
        waitpid(background, &status, WUNTRACED);
        if (WIFSTOPPED(status)) {
            printf("stopped by signal %d\n", WSTOPSIG(status));
            fflush(stdout);
            kill(background, SIGKILL);
        }
        exit(WIFEXITED(status) ? WEXITSTATUS(status) : 6);
    }
    setpgid(0, 0);
    return slave;
}

int main(int count, char **arguments)
{
    if (count < 3)
        return 1;
    const char *mode = arguments[1], *file = arguments[2];
    if (count > 3) {
        draw(mode, file);
        return 0;
    }
    int to = is(mode, "broken")     ? pipe_end(0)
             : is(mode, "full")     ? pipe_end(1)
             : is(mode, "device")   ? open("/dev/full", O_WRONLY)
             : is(mode, "limit")    ? limited(file)
             : is(mode, "terminal") ? terminal()
                                    : -1;
    if (to >= 0)
        dup2(to, 2);
    else
        close(2);
    execl(arguments[0], arguments[0], mode, file, "draws", (char *)NULL);
    return 7;
}
