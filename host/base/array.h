/* Growing arrays of any element type. CS_ARRAY_PADDING bytes beyond the last item are readable,
 * because Embree reads 3 floats as 4. */
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
    size_t item_size; /* bytes, above 0; set before the first call */
} cs_array;

/* Appends `count` zeroed items and returns the first of them. Returns NULL when out of memory. */
void *cs_array_extend(cs_array *array, size_t count);

/* Frees the unused capacity. */
void cs_array_trim(cs_array *array);
void cs_array_free(cs_array *array);

#endif
