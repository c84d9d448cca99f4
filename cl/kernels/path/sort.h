/* Which rays are followed together. Device only.
 *
 * Behind the first surface, paths of a packet end, and those that go on diverge. So before each
 * surface the paths that are left fill packets anew, those of one octant of directions beside each
 * other: a packet walks the hierarchy once for each octant that it has (traverse.h). So do rays to
 * lights. What a ray finds does not depend on its lane. */
#ifndef CS_PATH_SORT_H
#define CS_PATH_SORT_H

#include "kernels/path/state.h"

#if CS_PACKET > 1

enum {
    CS_PATH_WORDS = sizeof(cs_path) / sizeof(cs_vint),
    CS_SHADOW_WORDS = sizeof(cs_shadow) / sizeof(cs_vint),
    CS_CLASSES = 8 * CS_SHADOWS /* octants of the rays to each light; then lanes without a ray */
};

/* Packets as words, whatever they hold. */
typedef union cs_path_words {
    cs_path all;
    cs_vfloat word[CS_PATH_WORDS];
} cs_path_words;

typedef union cs_shadow_words {
    cs_shadow all;
    cs_vfloat word[CS_SHADOW_WORDS];
} cs_shadow_words;

/* Fills a packet of `words` words with the lanes at the places `from`, CS_PACKET times packet and
 * lane, of `packets`. */
static inline void cs_fill_packet(const cs_vfloat *packets, int words, const cs_int_lanes *from,
                                  cs_vfloat *after)
{
    int first = from->lane[0];
    const cs_f32 *word = (const cs_f32 *)(packets + first / CS_PACKET * words);
    cs_int_lanes place;
    if (first % CS_PACKET == 0 && !cs_any(from->all - first != cs_as_vint(CS_LANE_INDEX))) {
        for (int w = 0; w < words; w++)
            after[w] = packets[first / CS_PACKET * words + w];
        return;
    }
    word = (const cs_f32 *)packets;
    place.all = from->all / CS_PACKET * (words * CS_PACKET) + from->all % CS_PACKET;
    for (int w = 0; w < words; w++, word += CS_PACKET) {
#define CS_ONE(i) word[place.lane[i]]
        after[w] = CS_EACH_LANE(CS_ONE);
#undef CS_ONE
    }
}

/* Gives each lane of packet `p` the next number of its class. Writes the lane's place, CS_PACKET
 * times packet and lane, to `order` at that number; without `order` it only counts. next: the next
 * number of each class. */
static inline void cs_order_packet(const cs_int_lanes *classes, int p, int *next,
                                   cs_int_lanes *order)
{
    int *places = (int *)order, first = classes->lane[0];
    if (!cs_any(classes->all != first)) {
        for (int lane = 0; order && lane < CS_PACKET; lane++)
            places[next[first] + lane] = p * CS_PACKET + lane;
        next[first] += CS_PACKET;
        return;
    }
    for (int lane = 0; lane < CS_PACKET; lane++) {
        int place = next[classes->lane[lane]]++;
        if (order) places[place] = p * CS_PACKET + lane;
    }
}

/* Writes the places of lanes by class, as they come within one; returns how many have a ray. */
static inline int cs_order_lanes(const cs_int_lanes *classes, int count, cs_int_lanes *order)
{
    int next[CS_CLASSES + 1], total = 0;
    for (int i = 0; i <= CS_CLASSES; i++)
        next[i] = 0;
    for (int p = 0; p < count; p++)
        cs_order_packet(classes + p, p, next, 0);
    for (int i = 0; i <= CS_CLASSES; i++) {
        int own = next[i];
        next[i] = total;
        total += own;
    }
    total = next[CS_CLASSES];
    if (total == 0) return 0;
    for (int p = 0; p < count; p++)
        cs_order_packet(classes + p, p, next, order);
    return total;
}

static inline void cs_sort_paths(cs_paths *paths)
{
    cs_int_lanes classes[CS_POOL], order[CS_POOL];
    cs_path_words after[CS_POOL];
    for (int p = 0; p < paths->count; p++) {
        const cs_path *path = paths->path + p;
        classes[p].all = path->alive ? cs_octants(path->ray.direction) : (cs_vint)(CS_CLASSES);
    }
    int total = cs_order_lanes(classes, paths->count, order);
    paths->count = (total + CS_PACKET - 1) / CS_PACKET;
    for (int p = 0; p < paths->count; p++)
        cs_fill_packet((const cs_vfloat *)paths->path, CS_PATH_WORDS, order + p, after[p].word);
    for (int p = 0; p < paths->count; p++)
        paths->path[p] = after[p].all;
}

/* By light, then by octant: so the light of each sample is added in one order, whichever rays
 * happen to wait together. */
static inline void cs_sort_shadows(cs_paths *paths)
{
    cs_int_lanes classes[CS_SHADOWS], order[CS_SHADOWS];
    cs_shadow_words after[CS_SHADOWS];
    for (int p = 0; p < paths->shadows; p++) {
        const cs_shadow *shadow = paths->shadow + p;
        int lights_before = 0;
        for (int k = 0; k < paths->shadows; k++)
            lights_before += paths->shadow_light[k] < paths->shadow_light[p];
        classes[p].all = shadow->reach > 0.0f
                             ? 8 * lights_before + cs_octants(shadow->ray.direction)
                             : (cs_vint)(CS_CLASSES);
    }
    int total = cs_order_lanes(classes, paths->shadows, order);
    paths->shadows = (total + CS_PACKET - 1) / CS_PACKET;
    for (int p = 0; p < paths->shadows; p++)
        cs_fill_packet((const cs_vfloat *)paths->shadow, CS_SHADOW_WORDS, order + p, after[p].word);
    for (int p = 0; p < paths->shadows; p++)
        paths->shadow[p] = after[p].all;
}

#endif

#endif
