/* Fowler, Noll and Vo's hash FNV-1a of 64 bits: tells apart files and names, by chance alone. */
#ifndef CS_BASE_CHECKSUM_H
#define CS_BASE_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

/* The sum of no bytes. */
#define CS_CHECKSUM_OF_NOTHING 0xcbf29ce484222325u

/* The sum of some bytes and of `size` more. */
static inline uint64_t cs_checksum_add(uint64_t sum, const void *data, size_t size)
{
    const unsigned char *bytes = (const unsigned char *)data;
    for (size_t i = 0; i < size; i++)
        sum = (sum ^ bytes[i]) * 0x100000001b3u;
    return sum;
}

#endif
