#include "base/array.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

void *cs_array_extend(cs_array *array, size_t count)
{
    size_t needed = array->count + count;
    if (needed > array->capacity || array->items == NULL) {
        size_t capacity = array->capacity + array->capacity / 2;
        if (capacity < needed) capacity = needed;
        if (capacity > (SIZE_MAX - CS_ARRAY_PADDING) / array->item_size) return NULL;
        void *items = realloc(array->items, capacity * array->item_size + CS_ARRAY_PADDING);
        if (items == NULL) return NULL;
        array->items = items;
        array->capacity = capacity;
    }
    unsigned char *end = (unsigned char *)array->items + array->count * array->item_size;
    memset(end, 0, count * array->item_size);
    array->count = needed;
    return end;
}

void cs_array_trim(cs_array *array)
{
    if (array->count == 0 || array->count == array->capacity) return;
    void *items = realloc(array->items, array->count * array->item_size + CS_ARRAY_PADDING);
    if (items == NULL) return;
    array->items = items;
    array->capacity = array->count;
}

void cs_array_free(cs_array *array)
{
    free(array->items);
    array->items = NULL;
    array->count = 0;
    array->capacity = 0;
}
