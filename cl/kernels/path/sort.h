/* Which paths are followed together. Device only.
 *
 * Behind the first surface, paths of a packet end, and those that go on diverge. So before each
 * surface the paths that are left fill packets anew, those of one octant of directions beside each
 * other: a packet walks the hierarchy once for each octant that it has (traverse.h). What a path
 * finds does not depend on its lane. */
#ifndef CS_PATH_SORT_H
#define CS_PATH_SORT_H

#include "kernels/path/state.h"

#if CS_PACKET > 1

enum {
    CS_PATH_WORDS = sizeof(cs_path) / sizeof(cs_vint),
    CS_NUMBER_WORDS = sizeof(cs_numbers) / sizeof(cs_vint)
};

/* A packet's lanes one by one, whatever they hold. */
typedef union cs_path_words {
    cs_path path;
    cs_int_lanes word[CS_PATH_WORDS];
} cs_path_words;

typedef union cs_number_words {
    cs_numbers numbers;
    cs_int_lanes word[CS_NUMBER_WORDS];
} cs_number_words;

/* Writes the places, CS_PACKET times packet and lane, of the living paths by octant; returns how
 * many there are. */
static inline int cs_order_paths(const cs_paths *paths, int *order)
{
    cs_int_lanes octants[CS_TOGETHER];
    int next[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0}, total = 0;
    for (int p = 0; p < paths->count; p++) {
        const cs_path *path = paths->path + p;
        octants[p].all = path->alive ? cs_octants(path->ray.direction) : (cs_vint)(8);
        for (int lane = 0; lane < CS_PACKET; lane++)
            next[octants[p].lane[lane]]++;
    }
    for (int octant = 0; octant < 8; octant++) {
        int begin = total;
        total += next[octant];
        next[octant] = begin;
    }
    next[8] = total;
    for (int p = 0; p < paths->count; p++)
        for (int lane = 0; lane < CS_PACKET; lane++)
            order[next[octants[p].lane[lane]]++] = p * CS_PACKET + lane;
    return total;
}

/* Fills packets anew. */
static inline void cs_sort_paths(cs_paths *paths)
{
    int order[CS_TOGETHER * CS_PACKET];
    cs_path_words before[CS_TOGETHER], after;
    int total = cs_order_paths(paths, order);
    for (int p = 0; p < paths->count; p++)
        before[p].path = paths->path[p];
    paths->count = (total + CS_PACKET - 1) / CS_PACKET;
    paths->sorted = 1;
    for (int p = 0; p < paths->count; p++) {
        for (int lane = 0; lane < CS_PACKET; lane++) {
            int from = order[p * CS_PACKET + lane];
            const cs_path_words *packet = before + from / CS_PACKET;
            for (int w = 0; w < CS_PATH_WORDS; w++)
                after.word[w].lane[lane] = packet->word[w].lane[from % CS_PACKET];
        }
        paths->path[p] = after.path;
    }
}

/* The numbers of the paths in their lanes. */
static inline cs_numbers cs_sorted_numbers(const cs_paths *paths, const cs_path *path)
{
    cs_number_words words;
    cs_int_lanes home;
    home.all = path->home;
    for (int lane = 0; lane < CS_PACKET; lane++) {
        int from = home.lane[lane];
        const cs_number_words *drawn =
            (const cs_number_words *)(paths->numbers + from / CS_PACKET);
        for (int w = 0; w < CS_NUMBER_WORDS; w++)
            words.word[w].lane[lane] = drawn->word[w].lane[from % CS_PACKET];
    }
    return words.numbers;
}

#endif

#endif
