/* Vector operations of the walk of single rays over a node's sixteen children or a leaf's four
 * triangles. Device only.
 *
 * OpenCL C cannot turn a comparison into an integer mask, or permute a vector by another, in one
 * instruction. Processors with AVX-512 use compiler built-ins for both; others use loops. */
#ifndef CS_KERNELS_WIDE_LANES_H
#define CS_KERNELS_WIDE_LANES_H

#include "kernels/lanes.h"
#include "kernels/traverse.h"

#if CS_WALKS_WIDE

typedef CS_VECTOR(uchar) __attribute__((aligned(1))) cs_loose_bytes;

/* Bytes as floats. */
static inline cs_vfloat cs_bytes_at(CS_GLOBAL const uchar *bytes)
{
    return CS_OVER_LANES(convert_float)(*(CS_GLOBAL const cs_loose_bytes *)bytes);
}

/* The truth of comparisons, a bit each. */
static inline cs_u32 cs_mask_of_four(int4 mask)
{
#if defined(CS_NATIVE) && defined(__SSE__)
    return (cs_u32)__builtin_ia32_movmskps(as_float4(mask));
#else
    int4 bits = mask & (int4)(1, 2, 4, 8);
    return (cs_u32)(bits.x | bits.y | bits.z | bits.w);
#endif
}

#if CS_PACKET == 16 && defined(CS_NATIVE) && defined(__AVX512F__) && defined(__AVX512DQ__)

/* Writes references and distances of the children whose distance `enter` is below `limit` to the
 * top of a stack, and returns the number of children. The nearest child, or with `far_first` the
 * farthest, comes last, so that the walk takes it first. The order is the node's own for directions
 * of `octant`. Both arrays need room for CS_WIDE entries: entries after the last child are
 * overwritten with anything. With `far_first` the distances need not be written. */
CS_INLINED int cs_push_children(CS_GLOBAL const cs_wide_node *node, int octant, const int far_first,
                                const cs_float_lanes *enter, cs_f32 limit, cs_u32 *references,
                                cs_f32 *enters)
{
    CS_GLOBAL const cs_u32 *words = node->order[far_first ? 7 - octant : octant];
    cs_u32 even = words[0], odd = words[1];
    cs_vuint order = (cs_vuint)(even, odd, even, odd, even, odd, even, odd, even, odd, even, odd,
                                even, odd, even, odd) >>
                     (cs_vuint)(0, 0, 4, 4, 8, 8, 12, 12, 16, 16, 20, 20, 24, 24, 28, 28);
    cs_vfloat ordered = __builtin_ia32_permvarsf512(enter->all, as_int16(order));
    cs_vint child =
        __builtin_ia32_permvarsi512(*(CS_GLOBAL const cs_loose_int *)node->child, as_int16(order));
    ushort mask = __builtin_ia32_cvtd2mask512(ordered < limit);
    if (!far_first)
        *(cs_loose_float *)enters = __builtin_ia32_compresssf512_mask(ordered, ordered, mask);
    *(cs_loose_uint *)references = as_uint16(__builtin_ia32_compresssi512_mask(child, child, mask));
    return popcount((int)mask);
}

#else

static inline cs_u32 cs_mask_of_eight(int8 mask)
{
#if defined(CS_NATIVE) && defined(__AVX__)
    return (cs_u32)__builtin_ia32_movmskps256(as_float8(mask));
#else
    return cs_mask_of_four(mask.lo) | cs_mask_of_four(mask.hi) << 4;
#endif
}

static inline cs_u32 cs_mask_of_children(const cs_float_lanes *enter, cs_f32 limit)
{
#if CS_PACKET == 16
    cs_vint below = enter->all < limit;
    return cs_mask_of_eight(below.lo) | cs_mask_of_eight(below.hi) << 8;
#else
    return cs_mask_of_eight(enter[0].all < limit) | cs_mask_of_eight(enter[1].all < limit) << 8;
#endif
}

#define CS_FIRST_CHILDREN 4 /* that are ordered without a branch; mostly there are no more */

/* Puts the larger of two keys first. */
static inline void cs_order_keys(ulong *first, ulong *second)
{
    ulong larger = max(*first, *second);
    *second = min(*first, *second);
    *first = larger;
}

/* A child's distance, whose bits have its order since it is not negative, above its reference.
 * flip: ~0u reverses the order. */
static inline ulong cs_child_key(CS_GLOBAL const cs_wide_node *node, const cs_float_lanes *enter,
                                 int slot, cs_u32 flip)
{
    cs_u32 distance = as_uint(enter[slot / CS_PACKET].lane[slot % CS_PACKET]);
    return (ulong)(distance ^ flip) << 32 | node->child[slot];
}

/* Puts a child to its place among `count` others. */
static inline void cs_insert_child(ulong key, cs_u32 flip, int count, cs_u32 *references,
                                   cs_f32 *enters)
{
    cs_u32 distance = (cs_u32)(key >> 32);
    int place = count;
    for (; place > 0 && (as_uint(enters[place - 1]) ^ flip) < distance; place--) {
        enters[place] = enters[place - 1];
        references[place] = references[place - 1];
    }
    enters[place] = as_float(distance ^ flip);
    references[place] = (cs_u32)key;
}

/* As above, but the order is that of the distances, and `octant` is not used. */
CS_INLINED int cs_push_children(CS_GLOBAL const cs_wide_node *node, int octant, const int far_first,
                                const cs_float_lanes *enter, cs_f32 limit, cs_u32 *references,
                                cs_f32 *enters)
{
    const cs_u32 flip = far_first ? ~0u : 0u;
    ulong key[CS_FIRST_CHILDREN];
    cs_u32 left = cs_mask_of_children(enter, limit);
    int pushed = popcount(left);
    (void)octant;
    for (int i = 0; i < CS_FIRST_CHILDREN; i++, left &= left - 1u) {
        int slot = popcount((left & -left) - 1u) & (CS_WIDE - 1);
        key[i] = left != 0u ? cs_child_key(node, enter, slot, flip) : 0u;
    }
    cs_order_keys(&key[0], &key[1]);
    cs_order_keys(&key[2], &key[3]);
    cs_order_keys(&key[0], &key[2]);
    cs_order_keys(&key[1], &key[3]);
    cs_order_keys(&key[1], &key[2]);
    for (int i = 0; i < CS_FIRST_CHILDREN; i++) {
        references[i] = (cs_u32)key[i];
        enters[i] = as_float((cs_u32)(key[i] >> 32) ^ flip);
    }
    for (int end = CS_FIRST_CHILDREN; left != 0u; left &= left - 1u, end++) {
        ulong its = cs_child_key(node, enter, popcount((left & -left) - 1u), flip);
        cs_insert_child(its, flip, end, references, enters);
    }
    return pushed;
}

#endif

#endif

#endif
