#include "display/connection.h"

#include <errno.h>
#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

clshear_status cs_address_read(const char *text, cs_address *address, cs_error *error)
{
    const char *colon = strrchr(text, ':');
    const char *host = text;
    size_t length = colon != NULL ? (size_t)(colon - text) : 0;
    if (length > 0 && host[0] == '[') {
        length = host[length - 1] == ']' ? length - 2 : 0;
        host++;
    } else if (memchr(host, ':', length) != NULL) {
        length = 0; /* an IPv6 address, and no brackets to say which colon is the port's */
    }
    const size_t digits = colon != NULL ? strspn(colon + 1, "0123456789") : 0;
    const long port = digits > 0 && digits < sizeof address->port ? atol(colon + 1) : 0;
    if (length == 0 || length >= sizeof address->host || colon[1 + digits] != '\0' || port < 1 ||
        port > 65535)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "display: \"%s\" is not HOST:PORT; tev listens at 127.0.0.1:14158", text);
    memcpy(address->host, host, length);
    address->host[length] = '\0';
    memcpy(address->port, colon + 1, digits + 1);
    return CLSHEAR_OK;
}

int cs_wait_to_send(int file, double patience_s)
{
    struct pollfd wish = {.fd = file, .events = POLLOUT};
    const double until_s = cs_now_s() + patience_s;
    for (;;) {
        const double left_s = until_s - cs_now_s();
        const int found = poll(&wish, 1, left_s > 0.0 ? (int)(1e3 * left_s) + 1 : 0);
        if (found >= 0 || errno != EINTR) return found > 0;
        if (left_s <= 0.0) return 0;
    }
}

/* Connects to one of a host's addresses. Returns the descriptor, or -1 with errno. */
static int connect_to(const struct addrinfo *place, double patience_s)
{
    int reason = 0;
    socklen_t size = sizeof reason;
    const int file = socket(place->ai_family, place->ai_socktype, place->ai_protocol);
    if (file < 0) return -1;
    if (fcntl(file, F_SETFD, FD_CLOEXEC) != 0 || fcntl(file, F_SETFL, O_NONBLOCK) != 0)
        reason = errno;
    else if (connect(file, place->ai_addr, place->ai_addrlen) == 0)
        return file;
    else if (errno != EINPROGRESS)
        reason = errno;
    else if (!cs_wait_to_send(file, patience_s))
        reason = ETIMEDOUT;
    else if (getsockopt(file, SOL_SOCKET, SO_ERROR, &reason, &size) != 0)
        reason = errno;
    if (reason == 0) return file;
    close(file);
    errno = reason;
    return -1;
}

clshear_status cs_connect(const cs_address *address, double patience_s, int *file, cs_error *error)
{
    const struct addrinfo wish = {.ai_family = AF_UNSPEC, .ai_socktype = SOCK_STREAM};
    struct addrinfo *places = NULL;
    int made = -1;
    const int unknown = getaddrinfo(address->host, address->port, &wish, &places);
    if (unknown != 0)
        return cs_fail(error, CLSHEAR_BAD_FILE, "display %s:%s: %s", address->host, address->port,
                       gai_strerror(unknown));
    for (const struct addrinfo *place = places; place != NULL && made < 0; place = place->ai_next)
        made = connect_to(place, patience_s);
    const int reason = errno;
    freeaddrinfo(places);
    if (made < 0)
        return cs_fail(error, CLSHEAR_BAD_FILE, "display %s:%s: no viewer: %s", address->host,
                       address->port, strerror(reason));
    *file = made;
    return CLSHEAR_OK;
}

long cs_send_some(int file, const void *bytes, size_t size)
{
    for (;;) {
        const ssize_t sent = send(file, bytes, size, MSG_NOSIGNAL);
        if (sent >= 0) return (long)sent;
        if (errno == EAGAIN || errno == EWOULDBLOCK) return 0;
        if (errno != EINTR) return -1;
    }
}
