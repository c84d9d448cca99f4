/* What the walk of single rays does with sixteen children at once, one in each lane. Device only.
 *
 * OpenCL C has no masks as integers and no permutation by a vector that compilers make one
 * instruction of, so that processors with AVX-512 have their own. */
#ifndef CS_KERNELS_WIDE_LANES_H
#define CS_KERNELS_WIDE_LANES_H

#include "clshear/device/packet.h"
#include "kernels/scene.h"

/* Bytes as floats. */
static inline cs_vfloat cs_bytes_at(CS_GLOBAL const cs_u32 *bytes)
{
    return convert_float16(*(CS_GLOBAL const uchar16 *)bytes);
}

#if defined(CS_NATIVE) && defined(__AVX512F__)

/* Writes the references and the distances of the lanes whose `enter` is below `limit`, in an order
 * of theirs (cs_wide_node.order), one after another. Returns how many there are; up to CS_WIDE are
 * overwritten. */
static inline int cs_push_lanes(CS_GLOBAL const cs_wide_node *node, int octant, cs_vfloat enter,
                                cs_f32 limit, cs_u32 *references, cs_f32 *enters)
{
    cs_u32 even = node->order[octant][0], odd = node->order[octant][1];
    cs_vuint order = (cs_vuint)(even, odd, even, odd, even, odd, even, odd, even, odd, even, odd,
                                even, odd, even, odd) >>
                     (cs_vuint)(0, 0, 4, 4, 8, 8, 12, 12, 16, 16, 20, 20, 24, 24, 28, 28);
    cs_vint child = *(CS_GLOBAL const cs_vint *)node->child;
    enter = __builtin_ia32_permvarsf512(enter, as_int16(order));
    child = __builtin_ia32_permvarsi512(child, as_int16(order));
    ushort mask = __builtin_ia32_cvtd2mask512(enter < limit);
    cs_vfloat enters_packed = __builtin_ia32_compresssf512_mask(enter, enter, mask);
    cs_vint packed = __builtin_ia32_compresssi512_mask(child, child, mask);
    vstore16(as_uint16(packed), 0, references);
    vstore16(enters_packed, 0, enters);
    return popcount((int)mask);
}

#else

static inline int cs_push_lanes(CS_GLOBAL const cs_wide_node *node, int octant, cs_vfloat enter,
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
