/* Single rays on the host. */
#include <math.h>

#include "accel/embree.h"

float cs_accel_distance(const cs_accel *accel, const float *origin, const float *direction,
                        float near, float far, float time, uint32_t *triangle)
{
    struct RTCIntersectContext context;
    struct RTCRayHit query = {.ray = {.org_x = origin[0],
                                      .org_y = origin[1],
                                      .org_z = origin[2],
                                      .tnear = near,
                                      .dir_x = direction[0],
                                      .dir_y = direction[1],
                                      .dir_z = direction[2],
                                      .tfar = far,
                                      .time = time,
                                      .mask = ~0u},
                              .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcInitIntersectContext(&context);
    rtcIntersect1(accel->traced, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return INFINITY;
    *triangle = query.hit.primID;
    return query.ray.tfar;
}
