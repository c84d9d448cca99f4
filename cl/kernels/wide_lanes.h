/* Vector operations of the walk of single rays over a node's sixteen children or a leaf's four
 * triangles. Device only.
 *
 * OpenCL C cannot turn a comparison into an integer mask, or permute a vector by another, in one
 * instruction. Processors with AVX-512 use compiler built-ins for both; others use loops. */
#ifndef CS_KERNELS_WIDE_LANES_H
#define CS_KERNELS_WIDE_LANES_H

#include "kernels/traverse.h"

#if CS_WALKS_WIDE

/* Packets at any place of 4 bytes. */
typedef cs_vfloat __attribute__((aligned(4))) cs_loose_float;
typedef cs_vuint __attribute__((aligned(4))) cs_loose_uint;

/* Bytes as floats. */
static inline cs_vfloat cs_bytes_at(CS_GLOBAL const uchar *bytes)
{
    return convert_float16(*(CS_GLOBAL const uchar16 *)bytes);
}

#if defined(CS_NATIVE) && defined(__AVX512F__) && defined(__AVX512DQ__)

/* The truth of four comparisons, a bit each. */
static inline cs_u32 cs_mask_of_four(int4 mask)
{
    return (cs_u32)__builtin_ia32_movmskps(as_float4(mask));
}

/* Writes references and distances of the children whose `enter` is below `limit`, from far to near,
 * and returns their number. Both arrays need room for CS_WIDE entries: entries after the last child
 * are overwritten with anything. */
static inline int cs_push_children(CS_GLOBAL const cs_wide_node *node, int octant, cs_vfloat enter,
                                   cs_f32 limit, cs_u32 *references, cs_f32 *enters)
{
    cs_u32 even = node->order[octant][0], odd = node->order[octant][1];
    cs_vuint order = (cs_vuint)(even, odd, even, odd, even, odd, even, odd, even, odd, even, odd,
                                even, odd, even, odd) >>
                     (cs_vuint)(0, 0, 4, 4, 8, 8, 12, 12, 16, 16, 20, 20, 24, 24, 28, 28);
    enter = __builtin_ia32_permvarsf512(enter, as_int16(order));
    cs_vint child =
        __builtin_ia32_permvarsi512(*(CS_GLOBAL const cs_vint *)node->child, as_int16(order));
    ushort mask = __builtin_ia32_cvtd2mask512(enter < limit);
    *(cs_loose_float *)enters = __builtin_ia32_compresssf512_mask(enter, enter, mask);
    *(cs_loose_uint *)references = as_uint16(__builtin_ia32_compresssi512_mask(child, child, mask));
    return popcount((int)mask);
}

#else

static inline cs_u32 cs_mask_of_four(int4 mask)
{
    int4 bits = mask & (int4)(1, 2, 4, 8);
    return (cs_u32)(bits.x | bits.y | bits.z | bits.w);
}

static inline int cs_push_children(CS_GLOBAL const cs_wide_node *node, int octant, cs_vfloat enter,
                                   cs_f32 limit, cs_u32 *references, cs_f32 *enters)
{
    cs_float_lanes lanes;
    int pushed = 0;
    lanes.all = enter;
    for (int i = 0; i < CS_WIDE; i++) {
        cs_u32 slot = node->order[octant][i & 1] >> (i >> 1) * 4 & 15u;
        if (!(lanes.lane[slot] < limit)) continue;
        references[pushed] = node->child[slot];
        enters[pushed++] = lanes.lane[slot];
    }
    return pushed;
}

#endif

#endif

#endif
