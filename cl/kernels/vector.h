/* Products of vectors of lanes. Shared. */
#ifndef CS_KERNELS_VECTOR_H
#define CS_KERNELS_VECTOR_H

#include "clshear/device/packet.h"

#ifdef CS_DEVICE
#define cs_fma(a, b, c) fma(a, b, c)
#else
#define cs_fma(a, b, c) fmaf(a, b, c)
#endif

static inline cs_vfloat cs_dot(const cs_vfloat *a, const cs_vfloat *b)
{
    return cs_fma(a[0], b[0], cs_fma(a[1], b[1], a[2] * b[2]));
}

/* Of a linear Rec.709 colour. */
static inline cs_vfloat cs_luminance(const cs_vfloat *colour)
{
    return 0.2126f * colour[0] + 0.7152f * colour[1] + 0.0722f * colour[2];
}

#endif
