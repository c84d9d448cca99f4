/* Keys of a fixed size, numbered in the order in which they first come. */
#ifndef CS_IMPORT_INDEX_MAP_H
#define CS_IMPORT_INDEX_MAP_H

#include <stdint.h>

#include "base/array.h"

typedef struct cs_index_map {
    cs_array keys;   /* in the order of their numbers; item_size is set by cs_index_map_init */
    uint32_t *slots; /* number + 1; 0: free */
    size_t slot_count;
} cs_index_map;

/* Keys are compared byte by byte. */
void cs_index_map_init(cs_index_map *map, size_t key_size);
void cs_index_map_free(cs_index_map *map);

/* The number of a key, which is added where it is new; UINT32_MAX without memory. */
uint32_t cs_index_map_add(cs_index_map *map, const void *key);

/* The number of a key; UINT32_MAX where it is not there. */
uint32_t cs_index_map_find(const cs_index_map *map, const void *key);

#endif
