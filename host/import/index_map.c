#include "import/index_map.h"

#include <stdlib.h>
#include <string.h>

void cs_index_map_init(cs_index_map *map, size_t key_size)
{
    *map = (cs_index_map){.keys.item_size = key_size};
}

void cs_index_map_free(cs_index_map *map)
{
    cs_array_free(&map->keys);
    free(map->slots);
    map->slots = NULL;
    map->slot_count = 0;
}

/* FNV-1a over words, then mixed: neighbouring indices must not fall together. */
static size_t hash(const unsigned char *key, size_t size)
{
    uint64_t sum = 0xcbf29ce484222325u;
    for (; size >= 4; key += 4, size -= 4) {
        uint32_t word;
        memcpy(&word, key, sizeof word);
        sum = (sum ^ word) * 0x9e3779b97f4a7c15u;
        sum ^= sum >> 29;
    }
    for (; size > 0; key++, size--)
        sum = (sum ^ *key) * 0x100000001b3u;
    return (size_t)(sum ^ sum >> 32);
}

/* The slot of a key, or the free one where it belongs. */
static size_t slot_of(const cs_index_map *map, const void *key)
{
    const size_t size = map->keys.item_size;
    const char *keys = map->keys.items;
    size_t slot = hash(key, size) & (map->slot_count - 1);
    while (map->slots[slot] != 0 && memcmp(keys + (map->slots[slot] - 1) * size, key, size) != 0)
        slot = (slot + 1) & (map->slot_count - 1);
    return slot;
}

static int grow(cs_index_map *map)
{
    const size_t count = map->slot_count > 0 ? 2 * map->slot_count : 64;
    const char *keys = map->keys.items;
    uint32_t *slots = calloc(count, sizeof *slots);
    if (slots == NULL) return 0;
    free(map->slots);
    map->slots = slots;
    map->slot_count = count;
    for (size_t i = 0; i < map->keys.count; i++)
        slots[slot_of(map, keys + i * map->keys.item_size)] = (uint32_t)i + 1;
    return 1;
}

uint32_t cs_index_map_add(cs_index_map *map, const void *key)
{
    if (2 * map->keys.count >= map->slot_count && !grow(map)) return UINT32_MAX;
    const size_t slot = slot_of(map, key);
    if (map->slots[slot] == 0) {
        void *added = cs_array_extend(&map->keys, 1);
        if (added == NULL) return UINT32_MAX;
        memcpy(added, key, map->keys.item_size);
        map->slots[slot] = (uint32_t)map->keys.count;
    }
    return map->slots[slot] - 1;
}

uint32_t cs_index_map_find(const cs_index_map *map, const void *key)
{
    if (map->slot_count == 0) return UINT32_MAX;
    return map->slots[slot_of(map, key)] - 1; /* 0 - 1: not there */
}
