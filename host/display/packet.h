/* Messages of the protocol of the picture viewer tev, which HDRView understands too: a picture with
 * named channels is made, and rectangles of it are filled. All numbers are little-endian. A message
 * is its length in bytes as 32 bits, which counts these four, its kind as 8 bits, and what the kind
 * has. Texts end with a zero. */
#ifndef CS_DISPLAY_PACKET_H
#define CS_DISPLAY_PACKET_H

#include <stddef.h>
#include <stdint.h>

/* A message as it goes over the wire. Initialise to zero; it may be filled again and again. */
typedef struct cs_packet {
    unsigned char *bytes; /* owned */
    size_t size;
    size_t capacity;
    int is_good; /* 0: out of memory */
} cs_packet;

/* Names of channels, in the order of their planes. */
typedef struct cs_channel_names {
    const char *const *names;
    size_t count;
} cs_channel_names;

/* A rectangle of pixels, from its upper left corner. */
typedef struct cs_rectangle {
    int x;
    int y;
    int width;
    int height;
} cs_rectangle;

/* The functions fill the packet. `picture` is the name under which the viewer has it. */

/* Removes a picture; viewers that do not have it do nothing. */
void cs_packet_close(cs_packet *packet, const char *picture);

/* Makes a black picture of `width` x `height` pixels and shows it. */
void cs_packet_create(cs_packet *packet, const char *picture, int width, int height,
                      const cs_channel_names *channels);

/* Gives a rectangle of a picture its values. planes: of each channel, rows of `stride` floats, of
 * which the first is the rectangle's upper left corner. */
void cs_packet_update(cs_packet *packet, const char *picture, const cs_channel_names *channels,
                      const cs_rectangle *where, const float *const *planes, size_t stride);

void cs_packet_free(cs_packet *packet);

#endif
