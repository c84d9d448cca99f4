/* Planar point sets on disk, so that each is made only once. */
#ifndef CS_PATTERN_SET_CACHE_H
#define CS_PATTERN_SET_CACHE_H

#include "clshear/device/dialect.h"

/* Names a set: the sampler's name, the number of points, and the number of the set. */
typedef struct cs_set_name {
    const char *sampler;
    cs_u32 count;
    cs_u32 number;
} cs_set_name;

/* Reads the set's 2 count words, all x and then all y. Returns 0 if there is no whole file of this
 * version; `words` are then undefined. */
int cs_set_cache_read(const cs_set_name *name, cs_u32 *words);

/* Keeps a set. Does nothing where that is not possible: it will be made again. */
void cs_set_cache_write(const cs_set_name *name, const cs_u32 *words);

#endif
