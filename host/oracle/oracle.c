#include "oracle/oracle.h"

#include <math.h>

#include "clshear/device/lens.h"

cs_f32 cs_oracle_shear(const cs_camera *camera, const cs_depth *depth, cs_rule rule)
{
    cs_f32 z = INFINITY;
    if (rule == CS_RULE_CENTRE) z = isfinite(depth->centre) ? depth->centre : depth->median;
    if (rule == CS_RULE_MEDIAN) z = depth->median;
    if (rule == CS_RULE_NEAR) z = depth->near;
    if (rule == CS_RULE_FAR) z = depth->far;
    return isfinite(z) ? cs_shear_of_depth(*camera, z) : 0.0f;
}
