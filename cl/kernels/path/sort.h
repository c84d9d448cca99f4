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

/* Packets as lanes, whatever they hold. */
typedef union cs_path_words {
    cs_path all;
    cs_int_lanes word[CS_PATH_WORDS];
} cs_path_words;

typedef union cs_shadow_words {
    cs_shadow all;
    cs_int_lanes word[CS_SHADOW_WORDS];
} cs_shadow_words;

/* The lane at place `from`, CS_PACKET times packet and lane, of packets of `words` words becomes a
 * lane of `after`. */
static inline void cs_move_lane(const cs_int_lanes *packets, int words, int from, int lane,
                                cs_int_lanes *after)
{
    const cs_int_lanes *packet = packets + from / CS_PACKET * words;
    for (int w = 0; w < words; w++)
        after[w].lane[lane] = packet[w].lane[from % CS_PACKET];
}

/* Fills a packet with the lanes at 16 places, or however many lanes there are. */
static inline void cs_fill_packet(const cs_int_lanes *packets, int words, const int *from,
                                  cs_int_lanes *after)
{
    int whole = from[0] % CS_PACKET == 0;
    for (int lane = 1; lane < CS_PACKET; lane++)
        whole &= from[lane] == from[0] + lane;
    if (whole) {
        for (int w = 0; w < words; w++)
            after[w] = packets[from[0] / CS_PACKET * words + w];
        return;
    }
    for (int lane = 0; lane < CS_PACKET; lane++)
        cs_move_lane(packets, words, from[lane], lane, after);
}

/* Writes the places of lanes by class, as they come within one; returns how many have a ray. */
static inline int cs_order_lanes(const cs_int_lanes *classes, int count, int *order)
{
    int next[CS_CLASSES + 1], total = 0;
    for (int i = 0; i <= CS_CLASSES; i++)
        next[i] = 0;
    for (int p = 0; p < count; p++)
        for (int lane = 0; lane < CS_PACKET; lane++)
            next[classes[p].lane[lane]]++;
    for (int i = 0; i <= CS_CLASSES; i++) {
        int own = next[i];
        next[i] = total;
        total += own;
    }
    total = next[CS_CLASSES];
    for (int p = 0; p < count; p++)
        for (int lane = 0; lane < CS_PACKET; lane++)
            order[next[classes[p].lane[lane]]++] = p * CS_PACKET + lane;
    return total;
}

static inline void cs_sort_paths(cs_paths *paths)
{
    int order[CS_POOL * CS_PACKET];
    cs_int_lanes classes[CS_POOL];
    cs_path_words before[CS_POOL], after;
    for (int p = 0; p < paths->count; p++) {
        before[p].all = paths->path[p];
        classes[p].all =
            before[p].all.alive ? cs_octants(before[p].all.ray.direction) : (cs_vint)(CS_CLASSES);
    }
    int total = cs_order_lanes(classes, paths->count, order);
    paths->count = (total + CS_PACKET - 1) / CS_PACKET;
    for (int p = 0; p < paths->count; p++) {
        cs_fill_packet((const cs_int_lanes *)before, CS_PATH_WORDS, order + p * CS_PACKET,
                       after.word);
        paths->path[p] = after.all;
    }
}

/* By light, then by octant: so the light of each sample is added in one order, whichever rays
 * happen to wait together. */
static inline void cs_sort_shadows(cs_paths *paths)
{
    int order[CS_SHADOWS * CS_PACKET];
    cs_int_lanes classes[CS_SHADOWS];
    cs_shadow_words before[CS_SHADOWS], after;
    for (int p = 0; p < paths->shadows; p++) {
        int lights_before = 0;
        for (int k = 0; k < paths->shadows; k++)
            lights_before += paths->shadow_light[k] < paths->shadow_light[p];
        before[p].all = paths->shadow[p];
        classes[p].all = before[p].all.reach > 0.0f
                             ? 8 * lights_before + cs_octants(before[p].all.ray.direction)
                             : (cs_vint)(CS_CLASSES);
    }
    int total = cs_order_lanes(classes, paths->shadows, order);
    paths->shadows = (total + CS_PACKET - 1) / CS_PACKET;
    for (int p = 0; p < paths->shadows; p++) {
        cs_fill_packet((const cs_int_lanes *)before, CS_SHADOW_WORDS, order + p * CS_PACKET,
                       after.word);
        paths->shadow[p] = after.all;
    }
}

#endif

#endif
