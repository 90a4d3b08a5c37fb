/* A program without any GL. Status 0 when dlsym finds no GL function, 1 when it does. With arguments it starts them as another program after a
 * fork, and its status is theirs. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

int main(int argc, char **argv)
{
    static const char *const names[] = {"glDrawArrays", "glXSwapBuffers", "eglSwapBuffers", "OSMesaMakeCurrent", "glXGetProcAddressARB"};
    int found = 0, status;
    for (unsigned i = 0; i < sizeof names / sizeof *names; i++)
        if (dlsym(RTLD_DEFAULT, names[i]) || dlsym(RTLD_NEXT, names[i])) {
            fprintf(stderr, "%s is there\n", names[i]);
            found = 1;
        }
    if (!dlsym(RTLD_DEFAULT, "puts")) {
        fprintf(stderr, "puts is not there\n");
        found = 1;
    }
    if (argc < 2)
        return found;
    pid_t child = fork();
    if (!child) {
        execv(argv[1], argv + 1);
        _exit(127);
    }
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) | found : 128;
}
