/* Tuples and their sheared points without tracing: for tests and measurements. */
#include "draw.h"

/* One work-item writes CS_PACKET consecutive samples of the pattern of `pixel`,
 * CS_POINT_VALUES floats each: the six coordinates of the tuple, then x, y, u, v after the shear.
 * Global size: at least ceil(grid.count / CS_PACKET). */
__kernel void cs_points(const cs_frame frame, const uint pixel, const float shear,
                        __global const uint *rows, __global const float *table,
                        __global float *points)
{
    u32 first = (u32)get_global_id(0) * (u32)CS_PACKET;
    if (first >= frame.pattern.grid.count) return;
    vuint index = first + CS_LANE_INDEX;
    index = index < frame.pattern.grid.count ? index : (vuint)(0u);
    u32 key = cs_pattern_key(frame.seed, pixel, frame.replicate);
    vfloat tuple[CS_DIMENSIONS];
    cs_draw(&frame.pattern, rows, key, index, 3u, tuple);
    cs_film_lens point = cs_shear(tuple[0], tuple[1], tuple[2], tuple[3], frame.shear_mode,
                                  &frame.camera.optics, table, shear);
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

/* Draws as the render kernel does and adds the coordinates up instead of tracing: what sampling
 * costs by itself. One work-item for each pixel; sums: one float each. */
__kernel void cs_draw_sum(const cs_frame frame, const float shear, __global const uint *rows,
                          __global const float *table, __global float *sums)
{
    cs_place place;
    if (get_global_id(0) >= frame.pixel_count) return;
    place.x = 0u;
    place.y = 0u;
    place.key = cs_pattern_key(frame.seed, (u32)get_global_id(0), frame.replicate);
    place.shear = shear;
    vfloat sum = (vfloat)(0.0f);
    u32 end = frame.pattern.blocks * (u32)CS_BLOCK;
    for (u32 start = 0u; start < end; start += (u32)(CS_TOGETHER * CS_PACKET)) {
        cs_drawn drawn;
        cs_draw_packets(&frame, rows, table, &place, 1, start, end, &drawn);
        for (int packet = 0; packet < drawn.count; packet++) {
            cs_film_lens point = drawn.point[packet];
            sum += drawn.active[packet] ? point.x + point.y + point.u + point.v : (vfloat)(0.0f);
        }
    }
    sums[get_global_id(0)] = cs_reduce_add(sum);
}
