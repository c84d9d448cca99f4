#include "oracle/oracle.h"

#include <math.h>

#include "lens.h"

void cs_oracle_centre(const cs_camera *camera, const float *depth, size_t count, float *shear_px)
{
    for (size_t i = 0; i < count; i++)
        shear_px[i] = isfinite(depth[i]) ? cs_shear_of_depth(*camera, depth[i]) : 0.0f;
}
