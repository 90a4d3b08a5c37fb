/* Sends a line to a socket and prints the answer.
 *   speaks SOCKET LINE */
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

int main(int count, char **arguments)
{
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    int s = socket(AF_UNIX, SOCK_STREAM, 0);
    if (count < 3 || s < 0)
        return 2;
    strncpy(address.sun_path, arguments[1], sizeof address.sun_path - 1);
    if (connect(s, (struct sockaddr *)&address, sizeof address))
        return 3;
    char line[4096];
    int length = snprintf(line, sizeof line, "%s\n", arguments[2]);
    /* The server may refuse a client before the line is sent. */
    (void)!send(s, line, (size_t)length, MSG_NOSIGNAL);
    ssize_t got = recv(s, line, sizeof line, 0);
    if (got > 0)
        fwrite(line, 1, (size_t)got, stdout);
    return 0;
}
