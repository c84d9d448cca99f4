/* Sums of the planes over the samples of a pixel. Device only. Without the feature AOVS nothing. */
#ifndef CS_KERNELS_AOV_SUMS_H
#define CS_KERNELS_AOV_SUMS_H

#include "clshear/device/stats.h"
#include "kernels/found.h"
#include "kernels/launch.h"

#if CS_HAS(AOVS)
typedef struct cs_aov_sums {
    cs_vfloat plane[CS_PLANES];
} cs_aov_sums;

static inline void cs_aov_sums_add(cs_aov_sums *sums, const cs_radiance *found, cs_vint active,
                                   int first)
{
    for (int p = 0; p < CS_PLANES; p++) {
        cs_vfloat value = active ? found->plane[p] : (cs_vfloat)(0.0f);
        sums->plane[p] = first ? value : sums->plane[p] + value;
    }
}

/* Adds the planes of launch.planes to those of the pixel that is number `state`, and only they
 * have a place there. */
static inline void cs_aov_sums_merge(const cs_launch *launch, const cs_aov_sums *sums, cs_u32 state,
                                     CS_GLOBAL cs_exact_sum *totals)
{
    CS_GLOBAL cs_exact_sum *total = totals + (size_t)state * popcount(launch->planes);
    for (int p = 0; p < CS_PLANES; p++) {
        if (!(launch->planes >> p & 1u)) continue;
        *total = cs_exact_add(*total, cs_reduce_add(sums->plane[p]));
        total++;
    }
}
#endif

#endif
