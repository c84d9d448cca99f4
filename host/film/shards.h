/* Which shards of a render a film holds: "3/7", or after a merge "1-3,5/7". */
#ifndef CS_FILM_SHARDS_H
#define CS_FILM_SHARDS_H

#include "base/status.h"

enum {
    CS_MOST_SHARDS = 65536
};

typedef struct cs_shards {
    unsigned char *has; /* of shards 1 to count: 1 or 0; owned */
    int count;          /* of the whole render; 0: nothing was read */
    int held;
    int first; /* lowest one that is held, from 1 */
} cs_shards;

/* Reads a text. Fails, with nothing to free, if it is none of shards, or when out of memory. */
clshear_status cs_shards_read(const char *text, cs_shards *shards, cs_error *error);
void cs_shards_free(cs_shards *shards);

/* Adds those of `more`, of the same render. Returns 0, or the first that both hold. */
int cs_shards_add(cs_shards *shards, const cs_shards *more);

/* Prints those that are held, or with `held` 0 those that are not, as the text says them; what is
 * too long ends in "...". */
void cs_shards_print(const cs_shards *shards, int held, char *text, size_t size);

#endif
