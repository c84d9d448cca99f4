/* Growing arrays of any element type. CS_ARRAY_PADDING bytes behind the last item can be read:
 * Embree fetches 3 floats as 4. */
#ifndef CS_BASE_ARRAY_H
#define CS_BASE_ARRAY_H

#include <stddef.h>

enum {
    CS_ARRAY_PADDING = 16
};

typedef struct cs_array {
    void *items;
    size_t count;
    size_t capacity;
    size_t item_size; /* set before use */
} cs_array;

/* Room for `count` more items at the end, zeroed and counted; NULL when out of memory. */
void *cs_array_extend(cs_array *array, size_t count);

/* Gives back the capacity that is not used. */
void cs_array_trim(cs_array *array);
void cs_array_free(cs_array *array);

#endif
