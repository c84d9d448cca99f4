#include "scene/parts.h"

#include <stdlib.h>
#include <string.h>

static const uint32_t nothing = UINT32_MAX;

/* The representative of a vertex; halves the way to it (Tarjan and van Leeuwen, "Worst-case
 * Analysis of Set Union Algorithms", 1984). */
static uint32_t find(uint32_t *parent, uint32_t vertex)
{
    while (parent[vertex] != vertex) {
        parent[vertex] = parent[parent[vertex]];
        vertex = parent[vertex];
    }
    return vertex;
}

static size_t hash_position(const float *position)
{
    uint32_t hash = 0, bits;
    for (int i = 0; i < 3; i++) {
        memcpy(&bits, &position[i], sizeof bits);
        hash = (hash ^ bits) * 0x2c1b3c6du;
        hash ^= hash >> 15;
    }
    return hash;
}

static int is_same(const float *a, const float *b)
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* Makes the first vertex at each position the parent of the others there. `slots` is an open hash
 * table of vertices, all `nothing`. */
static void join_positions(const cs_scene *scene, uint32_t *parent, uint32_t *slots, size_t count)
{
    const float(*positions)[3] = scene->positions.items;
    for (uint32_t i = 0; i < scene->positions.count; i++) {
        size_t slot = hash_position(positions[i]) % count;
        while (slots[slot] != nothing && !is_same(positions[slots[slot]], positions[i]))
            slot = (slot + 1) % count;
        if (slots[slot] == nothing) slots[slot] = i;
        parent[i] = slots[slot];
    }
}

clshear_status cs_scene_parts(const cs_scene *scene, cs_array *parts, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const uint32_t(*triangles)[3] = scene->indices.items;
    const size_t count = 2 * scene->positions.count + 1;
    uint32_t *parent = cs_array_extend(parts, scene->positions.count);
    uint32_t *slots = malloc(count * sizeof *slots);
    CS_REQUIRE(parent != NULL && slots != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    memset(slots, 0xff, count * sizeof *slots);
    join_positions(scene, parent, slots, count);
    for (size_t i = 0; i < scene->indices.count; i++)
        for (int k = 1; k < 3; k++)
            parent[find(parent, triangles[i][k])] = find(parent, triangles[i][0]);
    for (uint32_t i = 0; i < scene->positions.count; i++)
        parent[i] = find(parent, i);
done:
    free(slots);
    return status;
}
