#include "display/packet.h"

#include <stdlib.h>
#include <string.h>

/* Kinds of messages. */
enum {
    CLOSE = 2,
    CREATE = 4,
    UPDATE = 6 /* its third version: several channels, with offsets and strides */
};

static void put(cs_packet *packet, const void *bytes, size_t size)
{
    if (!packet->is_good) return;
    if (packet->size + size > packet->capacity) {
        const size_t capacity = 2 * (packet->size + size);
        unsigned char *grown = realloc(packet->bytes, capacity);
        packet->is_good = grown != NULL;
        if (grown == NULL) return;
        packet->bytes = grown;
        packet->capacity = capacity;
    }
    memcpy(packet->bytes + packet->size, bytes, size);
    packet->size += size;
}

/* A number of `size` bytes, at most 8. */
static void put_number(cs_packet *packet, uint64_t number, size_t size)
{
    unsigned char bytes[8];
    for (size_t i = 0; i < size; i++)
        bytes[i] = (unsigned char)(number >> (8 * i));
    put(packet, bytes, size);
}

static void put_integer(cs_packet *packet, int number)
{
    put_number(packet, (uint32_t)number, 4);
}

static void put_float(cs_packet *packet, float number)
{
    uint32_t word;
    memcpy(&word, &number, sizeof word);
    put_number(packet, word, 4);
}

static void put_text(cs_packet *packet, const char *text)
{
    put(packet, text, strlen(text) + 1);
}

static void put_channels(cs_packet *packet, const cs_channel_names *channels)
{
    put_integer(packet, (int)channels->count);
    for (size_t c = 0; c < channels->count; c++)
        put_text(packet, channels->names[c]);
}

static void begin(cs_packet *packet, int kind)
{
    packet->size = 0;
    packet->is_good = 1;
    put_number(packet, 0, 4); /* the length, which end() knows */
    put_number(packet, (unsigned)kind, 1);
}

static void end(cs_packet *packet)
{
    const size_t size = packet->size;
    packet->size = 0;
    put_number(packet, size, 4);
    packet->size = size;
}

void cs_packet_close(cs_packet *packet, const char *picture)
{
    begin(packet, CLOSE);
    put_text(packet, picture);
    end(packet);
}

void cs_packet_create(cs_packet *packet, const char *picture, int width, int height,
                      const cs_channel_names *channels)
{
    begin(packet, CREATE);
    put_number(packet, 1, 1); /* the viewer turns to it */
    put_text(packet, picture);
    put_integer(packet, width);
    put_integer(packet, height);
    put_channels(packet, channels);
    end(packet);
}

void cs_packet_update(cs_packet *packet, const char *picture, const cs_channel_names *channels,
                      const cs_rectangle *where, const float *const *planes, size_t stride)
{
    const uint64_t pixels = (uint64_t)where->width * (uint64_t)where->height;
    begin(packet, UPDATE);
    put_number(packet, 0, 1); /* the viewer stays with what it shows */
    put_text(packet, picture);
    put_channels(packet, channels);
    put_integer(packet, where->x);
    put_integer(packet, where->y);
    put_integer(packet, where->width);
    put_integer(packet, where->height);
    for (size_t c = 0; c < channels->count; c++)
        put_number(packet, c * pixels,
                   8); /* plane after plane: where each begins, in floats, ... */
    for (size_t c = 0; c < channels->count; c++)
        put_number(packet, 1, 8); /* ... and how far its pixels are apart */
    for (size_t c = 0; c < channels->count; c++)
        for (int y = 0; y < where->height; y++)
            for (int x = 0; x < where->width; x++)
                put_float(packet, planes[c][(size_t)y * stride + (size_t)x]);
    end(packet);
}

void cs_packet_free(cs_packet *packet)
{
    free(packet->bytes);
    *packet = (cs_packet){0};
}
