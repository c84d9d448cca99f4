#include "oracle/oracle.h"

#include <math.h>

#include "clshear/device/lens.h"

cs_f32 cs_oracle_shear(const cs_camera *camera, cs_f32 x, cs_f32 y, const cs_depth *depth,
                       cs_rule rule)
{
    cs_f32 z = INFINITY;
    if (rule == CS_RULE_FRONT && isfinite(depth->front_px)) return depth->front_px;
    if (rule == CS_RULE_FRONT) rule = CS_RULE_CENTRE;
    if (rule == CS_RULE_CENTRE || rule == CS_RULE_LENS)
        z = isfinite(depth->centre) ? depth->centre : depth->median;
    if (rule == CS_RULE_MEDIAN) z = depth->median;
    if (rule == CS_RULE_NEAR) z = depth->near;
    if (rule == CS_RULE_FAR) z = depth->far;
    return isfinite(z) ? cs_shear_at(*camera, x, y, z) : 0.0f;
}

int cs_rule_has_velocity(cs_rule rule)
{
    return rule != CS_RULE_NONE && rule != CS_RULE_LENS;
}

/* Raster coordinates of a point; 0 if it lies behind the camera. */
static int project(const cs_camera *camera, const float *point, double *raster_px)
{
    double right = 0.0, down = 0.0, depth = 0.0;
    for (int i = 0; i < 3; i++) {
        const double offset = (double)point[i] - (double)camera->eye[i];
        right += offset * (double)camera->right[i];
        down += offset * (double)camera->down[i];
        depth += offset * (double)camera->forward[i];
    }
    if (!(depth > 0.0)) return 0;
    const double scale = (double)camera->focal_distance / ((double)camera->pixel_width * depth);
    raster_px[0] = right * scale;
    raster_px[1] = down * scale;
    return 1;
}

/* Faster is no motion that a shear can follow. */
static const double fastest_px = 1e5;

cs_velocity cs_oracle_velocity(const cs_camera *open, const cs_camera *closed, const float *from,
                               const float *to)
{
    double first[2], last[2];
    const cs_velocity still = {0.0f, 0.0f};
    if (!project(open, from, first) || !project(closed, to, last)) return still;
    const double x = last[0] - first[0], y = last[1] - first[1];
    if (!(fabs(x) < fastest_px && fabs(y) < fastest_px)) return still;
    return (cs_velocity){(cs_f32)x, (cs_f32)y};
}

_Static_assert((int)CLSHEAR_ORACLE_CENTRE == CS_RULE_CENTRE, "cs_oracle_rule casts");
_Static_assert((int)CLSHEAR_ORACLE_MEDIAN == CS_RULE_MEDIAN, "cs_oracle_rule casts");
_Static_assert((int)CLSHEAR_ORACLE_NEAR == CS_RULE_NEAR, "cs_oracle_rule casts");
_Static_assert((int)CLSHEAR_ORACLE_FAR == CS_RULE_FAR, "cs_oracle_rule casts");

cs_rule cs_oracle_rule(clshear_oracle oracle, const cs_depth *depth)
{
    if (oracle == CLSHEAR_ORACLE_EDGE)
        return isfinite(depth->front_px) ? CS_RULE_FRONT : CS_RULE_CENTRE;
    return oracle == CLSHEAR_ORACLE_PILOT ? CS_RULE_CENTRE : (cs_rule)oracle;
}
