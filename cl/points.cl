/* Tuples and their sheared points, written out: for tests, point sets and analysis. */
#include "frame.h"
#include "shear.h"

/* One work-item writes CS_PACKET consecutive samples of the pattern of `pixel`,
 * CS_POINT_VALUES floats each: the six coordinates of the tuple, then x, y, u, v after the shear.
 * Global size: at least ceil(grid.count / CS_PACKET). */
__kernel void cs_points(const cs_frame frame, const uint pixel, const float shear,
                        __global const uint *rows, __global float *points)
{
    u32 first = (u32)get_global_id(0) * (u32)CS_PACKET;
    if (first >= frame.pattern.grid.count) return;
    vuint index = first + CS_LANE_INDEX;
    index = index < frame.pattern.grid.count ? index : (vuint)(0u);
    u32 key = cs_pattern_key(frame.seed, pixel, frame.replicate);
    vfloat tuple[CS_DIMENSIONS];
    cs_draw(&frame.pattern, rows, key, index, 3u, tuple);
    cs_film_lens point = cs_shear(tuple[0], tuple[1], tuple[2], tuple[3], frame.shear_mode,
                                  frame.camera.aperture, shear);
    cs_float_lanes value[CS_POINT_VALUES];
    for (u32 d = 0u; d < (u32)CS_DIMENSIONS; d++)
        value[d].all = tuple[d];
    value[6].all = point.x;
    value[7].all = point.y;
    value[8].all = point.u;
    value[9].all = point.v;
    for (u32 lane = 0u; lane < (u32)CS_PACKET && first + lane < frame.pattern.grid.count; lane++)
        for (u32 i = 0u; i < (u32)CS_POINT_VALUES; i++)
            points[(size_t)(first + lane) * (u32)CS_POINT_VALUES + i] = value[i].lane[lane];
}
