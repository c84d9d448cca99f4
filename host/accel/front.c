#include "accel/front.h"

#include <math.h>

#include "clshear/device/lens.h"

/* Found by trial on twenty scenes (docs/notes/oracle.md). */
static const cs_f32 least_gap_px = 0.05f, least_part = 0.25f;

cs_f32 cs_front_shear(const cs_camera *camera, cs_f32 x, cs_f32 y, const cs_f32 *depths,
                      cs_u32 count)
{
    cs_f32 sum = 0.0f;
    if (count == 0 || !isfinite(depths[0])) return INFINITY;
    cs_f32 shear = cs_shear_at(*camera, x, y, depths[0]);
    for (cs_u32 i = 1; i < count; i++) {
        const cs_f32 next = cs_shear_at(*camera, x, y, depths[i]);
        sum += shear;
        if (fabsf(shear - next) > fmaxf(least_gap_px, least_part * fabsf(shear)))
            return sum / (cs_f32)i;
        shear = next;
    }
    return INFINITY;
}
