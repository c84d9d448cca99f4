#include "receiver.h"

#include <arpa/inet.h>
#include <poll.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

/* What is left of the message that is read. */
typedef struct message {
    receiver *r;
    const unsigned char *at;
    size_t left;
} message;

static void complain(receiver *r, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void complain(receiver *r, const char *format, ...)
{
    va_list arguments;
    if (*r->wrong != '\0') return;
    va_start(arguments, format);
    vsnprintf(r->wrong, sizeof r->wrong, format, arguments);
    va_end(arguments);
}

static uint64_t number(message *m, size_t size)
{
    uint64_t value = 0;
    if (m->left < size) {
        complain(m->r, "the message ends in a number");
        m->left = 0;
        return 0;
    }
    for (size_t i = 0; i < size; i++)
        value |= (uint64_t)m->at[i] << (8 * i);
    m->at += size;
    m->left -= size;
    return value;
}

static int integer(message *m, int low, int high, const char *what)
{
    const int32_t value = (int32_t)(uint32_t)number(m, 4);
    if (value < low || value > high)
        complain(m->r, "%s %d is not in %d ... %d", what, (int)value, low, high);
    return value < low ? low : value > high ? high : value;
}

static void text(message *m, char *target, size_t size)
{
    const unsigned char *end = memchr(m->at, 0, m->left);
    const size_t length = end != NULL ? (size_t)(end - m->at) : 0;
    *target = '\0';
    if (end == NULL || length == 0 || length >= size) {
        complain(m->r, "a text of %zu bytes", length);
        m->left = 0;
        return;
    }
    memcpy(target, m->at, length + 1);
    m->at = end + 1;
    m->left -= length + 1;
}

static void flag(message *m)
{
    if (number(m, 1) > 1) complain(m->r, "the byte that grabs the focus is neither 0 nor 1");
}

static void name_of_picture(message *m)
{
    char name[sizeof m->r->name];
    text(m, name, sizeof name);
    if (strcmp(name, m->r->name) != 0) complain(m->r, "%s: an unknown picture", name);
}

static void close_picture(message *m)
{
    char name[256];
    text(m, name, sizeof name);
    m->r->closes++;
    if (m->r->channel_count > 0 && strcmp(name, m->r->name) != 0)
        complain(m->r, "%s: closes another picture", name);
    receiver_free(m->r);
}

static void create_picture(message *m)
{
    receiver *r = m->r;
    if (r->channel_count > 0) complain(r, "a second picture");
    r->creates++;
    flag(m);
    text(m, r->name, sizeof r->name);
    r->width = integer(m, 1, 65536, "width");
    r->height = integer(m, 1, 65536, "height");
    const int count = integer(m, 1, MOST_CHANNELS, "number of channels");
    for (int c = 0; c < count; c++) {
        text(m, r->channels[c].name, sizeof r->channels[c].name);
        if (receiver_pixels(r, r->channels[c].name) != NULL)
            complain(r, "%s: twice", r->channels[c].name);
        r->channels[c].pixels = calloc((size_t)r->width * (size_t)r->height, sizeof(float));
        r->channel_count = c + 1;
    }
}

static float *pixels_of(receiver *r, const char *name)
{
    for (int c = 0; c < r->channel_count; c++)
        if (strcmp(r->channels[c].name, name) == 0) return r->channels[c].pixels;
    return NULL;
}

const float *receiver_pixels(const receiver *r, const char *channel)
{
    for (int c = 0; c < r->channel_count; c++)
        if (strcmp(r->channels[c].name, channel) == 0) return r->channels[c].pixels;
    return NULL;
}

static float float_at(const unsigned char *bytes)
{
    const uint32_t word = (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
                          (uint32_t)bytes[3] << 24;
    float value;
    memcpy(&value, &word, sizeof value);
    return value;
}

static void update_picture(message *m)
{
    receiver *r = m->r;
    float *planes[MOST_CHANNELS];
    uint64_t offsets[MOST_CHANNELS], strides[MOST_CHANNELS], most = 0;
    char name[64];
    flag(m);
    name_of_picture(m);
    const int count = integer(m, 1, MOST_CHANNELS, "number of channels");
    for (int c = 0; c < count; c++) {
        text(m, name, sizeof name);
        planes[c] = pixels_of(r, name);
        if (planes[c] == NULL) complain(r, "%s: an unknown channel", name);
    }
    const int x0 = integer(m, 0, r->width - 1, "x"), y0 = integer(m, 0, r->height - 1, "y");
    const int width = integer(m, 1, r->width - x0, "width of the tile");
    const int height = integer(m, 1, r->height - y0, "height of the tile");
    const uint64_t pixels = (uint64_t)width * (uint64_t)height;
    for (int c = 0; c < count; c++)
        offsets[c] = number(m, 8);
    for (int c = 0; c < count; c++)
        strides[c] = number(m, 8);
    for (int c = 0; c < count && *r->wrong == '\0'; c++) {
        const uint64_t end = offsets[c] + (pixels - 1) * strides[c] + 1;
        most = end > most ? end : most;
    }
    if (*r->wrong == '\0' && m->left != 4 * most)
        complain(r, "%zu bytes of pixels, not %llu", m->left, (unsigned long long)(4 * most));
    for (int c = 0; c < count && *r->wrong == '\0'; c++)
        for (uint64_t i = 0; i < pixels; i++)
            planes[c][(size_t)(y0 + (int)(i / (uint64_t)width)) * (size_t)r->width + (size_t)x0 +
                      (size_t)(i % (uint64_t)width)] =
                float_at(m->at + 4 * (offsets[c] + i * strides[c]));
    m->left = 0;
    r->updates++;
}

static void take_message(receiver *r, const unsigned char *bytes, size_t size)
{
    message m = {r, bytes, size};
    const int kind = (int)number(&m, 1);
    if (kind == 2)
        close_picture(&m);
    else if (kind == 4)
        create_picture(&m);
    else if (kind == 6)
        update_picture(&m);
    else
        complain(r, "message of kind %d", kind);
    if (m.left > 0) complain(r, "%zu bytes too many in a message of kind %d", m.left, kind);
    r->messages++;
}

/* Reads `size` bytes. Returns 0 at the end of the connection; it must not be within a message. */
static int read_bytes(receiver *r, int file, unsigned char *bytes, size_t size, int is_first)
{
    for (size_t got = 0; got < size;) {
        const ssize_t count = recv(file, bytes + got, size - got, 0);
        if (count <= 0) {
            if (got > 0 || !is_first) complain(r, "the connection ends within a message");
            return 0;
        }
        got += (size_t)count;
    }
    return 1;
}

static void serve(receiver *r, int file)
{
    unsigned char head[4];
    while (*r->wrong == '\0' && read_bytes(r, file, head, 4, 1)) {
        const size_t size =
            (size_t)head[0] | (size_t)head[1] << 8 | (size_t)head[2] << 16 | (size_t)head[3] << 24;
        if (size < 6 || size > 1 << 26) {
            complain(r, "a message of %zu bytes", size);
            return;
        }
        unsigned char *rest = malloc(size - 4);
        if (read_bytes(r, file, rest, size - 4, 0)) take_message(r, rest, size - 4);
        free(rest);
        if (r->hangs_up_after > 0 && r->messages >= r->hangs_up_after) return;
    }
}

static void *run(void *user)
{
    receiver *r = user;
    struct pollfd wish = {.fd = r->listener, .events = POLLIN};
    while (!r->ends) {
        if (poll(&wish, 1, 50) <= 0) continue;
        const int file = accept(r->listener, NULL, NULL);
        if (file < 0) continue;
        r->connections++;
        if (!r->never_reads) serve(r, file);
        while (r->never_reads && !r->ends)
            poll(NULL, 0, 50);
        close(file);
        r->has_left = 1;
    }
    return NULL;
}

void receiver_start(receiver *r)
{
    struct sockaddr_in place = {.sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    socklen_t size = sizeof place;
    const int small = 4096;
    r->listener = socket(AF_INET, SOCK_STREAM, 0);
    if (r->never_reads) setsockopt(r->listener, SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
    if (r->listener < 0 || bind(r->listener, (struct sockaddr *)&place, sizeof place) != 0 ||
        listen(r->listener, 5) != 0 ||
        getsockname(r->listener, (struct sockaddr *)&place, &size) != 0 ||
        pthread_create(&r->thread, NULL, run, r) != 0)
        abort();
    r->port = ntohs(place.sin_port);
}

void receiver_stop(receiver *r)
{
    r->ends = 1;
    pthread_join(r->thread, NULL);
    close(r->listener);
}

void receiver_free(receiver *r)
{
    for (int c = 0; c < r->channel_count; c++) {
        free(r->channels[c].pixels);
        r->channels[c] = (receiver_channel){0};
    }
    r->channel_count = 0;
}
