#include "oracle/oracle.h"

#include <math.h>

#include "clshear/device/lens.h"

cs_f32 cs_oracle_shear(const cs_camera *camera, cs_f32 x, cs_f32 y, const cs_depth *depth,
                       cs_rule rule)
{
    cs_f32 z = INFINITY;
    if (rule == CS_RULE_CENTRE) z = isfinite(depth->centre) ? depth->centre : depth->median;
    if (rule == CS_RULE_MEDIAN) z = depth->median;
    if (rule == CS_RULE_NEAR) z = depth->near;
    if (rule == CS_RULE_FAR) z = depth->far;
    return isfinite(z) ? cs_shear_at(*camera, x, y, z) : 0.0f;
}

_Static_assert((int)CLSHEAR_ORACLE_CENTRE == CS_RULE_CENTRE, "cs_rule_of casts");
_Static_assert((int)CLSHEAR_ORACLE_MEDIAN == CS_RULE_MEDIAN, "cs_rule_of casts");
_Static_assert((int)CLSHEAR_ORACLE_NEAR == CS_RULE_NEAR, "cs_rule_of casts");
_Static_assert((int)CLSHEAR_ORACLE_FAR == CS_RULE_FAR, "cs_rule_of casts");

cs_rule cs_rule_of(clshear_oracle oracle)
{
    return oracle == CLSHEAR_ORACLE_PILOT ? CS_RULE_CENTRE : (cs_rule)oracle;
}
