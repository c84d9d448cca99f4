/* A viewer for tests: it listens, reads the protocol of tev byte by byte, and keeps the pictures.
 * What is not in the protocol ends the connection, with a line that says why. */
#ifndef CS_TESTS_RECEIVER_H
#define CS_TESTS_RECEIVER_H

#include <pthread.h>
#include <stdatomic.h>
#include <stddef.h>

enum {
    MOST_CHANNELS = 64
};

typedef struct receiver_channel {
    char name[64];
    float *pixels; /* width * height */
} receiver_channel;

typedef struct receiver {
    int listener;
    int port;
    pthread_t thread;
    int hangs_up_after;  /* messages after which it closes the connection; 0: never */
    int never_reads;     /* it takes the connection, and no byte */
    atomic_int updates;  /* messages that filled tiles */
    atomic_int ends;     /* set by receiver_stop */
    atomic_int has_left; /* whether a connection has ended */
    atomic_int messages; /* of all kinds */
    int connections;
    int closes;
    int creates;
    char name[256]; /* of the picture */
    int width;
    int height;
    int channel_count;
    receiver_channel channels[MOST_CHANNELS];
    char wrong[256]; /* what was not in the protocol; "": nothing */
} receiver;

/* Listens at a free port of 127.0.0.1 in a thread of its own. The fields above may be set before.
 */
void receiver_start(receiver *r);

/* Waits until the connection ends, and closes everything but the picture. */
void receiver_stop(receiver *r);

/* The pixels of a channel; NULL: there is none of that name. */
const float *receiver_pixels(const receiver *r, const char *channel);
void receiver_free(receiver *r);

#endif
