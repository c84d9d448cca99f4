/* What every BSDF answers for a packet of surface points. Shared. */
#ifndef CS_BSDF_VALUE_H
#define CS_BSDF_VALUE_H

#include "clshear/device/sampler/grid.h"
#include "kernels/bsdf/list.h"
#include "kernels/surface.h"

/* The BSDF's value of channel c is scale * colour[c]. The factors are apart because the order of
 * multiplications fixes the last bit of a picture. */
typedef struct cs_bsdf_value {
    cs_vfloat scale; /* per steradian */
    cs_vfloat colour[3];
} cs_bsdf_value;

/* A direction that was drawn from a density. */
typedef struct cs_bsdf_direction {
    cs_vfloat in[3];   /* unit vector, from the surface to where light comes from */
    cs_vfloat density; /* per steradian; 0: nothing was drawn */
    cs_bsdf_value value;
} cs_bsdf_direction;

#endif
