/* Tuples and their sheared points without tracing: for tests and measurements. */
#include "kernels/draw.h"
#include "kernels/kernel.h"

/* One work-item writes CS_PACKET consecutive samples of the pattern of `pixel`,
 * CS_POINT_VALUES floats each: the CS_DIMENSIONS coordinates of the tuple, then x, y, u, v after
 * the shear, and the time: 0 without the feature MOTION, with which the tuple is that of a scene
 * without area lights. Global size: at least ceil(grid.count / CS_PACKET). */
CS_KERNEL void cs_points(const cs_launch launch, const uint pixel, const float shear,
                         const cs_velocity velocity, __global const uint *sample_table,
                         __global const float *lens_table, __global float *points)
{
    cs_u32 first = (cs_u32)get_global_id(0) * (cs_u32)CS_PACKET;
    if (first >= launch.pattern.grid.count) return;
    cs_vuint index = first + CS_LANE_INDEX;
    index = index < launch.pattern.grid.count ? index : (cs_vuint)(0u);
    cs_u32 key = cs_pattern_key(launch.seed, pixel, launch.replicate);
    cs_vfloat tuple[CS_DIMENSIONS];
    cs_draw_all(&launch.pattern, sample_table, key, index, tuple);
    cs_camera_sample point = {tuple[CS_AT_FILM], tuple[CS_END_FILM], tuple[CS_AT_LENS],
                              tuple[CS_END_LENS]};
#if CS_HAS(MOTION)
    const cs_vfloat drawn = cs_draw_time(&launch.pattern, sample_table, key, index, 0, &point);
    const cs_moving_sample moving = cs_shear_moving(
        point, drawn, launch.shear_mode, &launch.camera.optics, lens_table, shear, velocity);
    point = moving.point;
    const cs_vfloat time = moving.time;
#else
    (void)velocity;
    point = cs_shear(point.x, point.y, point.u, point.v, launch.shear_mode, &launch.camera.optics,
                     lens_table, shear);
    const cs_vfloat time = (cs_vfloat)(0.0f);
#endif
    cs_float_lanes value[CS_POINT_VALUES];
    for (cs_u32 d = 0u; d < (cs_u32)CS_DIMENSIONS; d++)
        value[d].all = tuple[d];
    value[CS_DIMENSIONS + CS_AT_FILM].all = point.x;
    value[CS_DIMENSIONS + CS_END_FILM].all = point.y;
    value[CS_DIMENSIONS + CS_AT_LENS].all = point.u;
    value[CS_DIMENSIONS + CS_END_LENS].all = point.v;
    value[CS_DIMENSIONS + CS_MAIN_DIMENSIONS].all = time;
    for (cs_u32 lane = 0u; lane < (cs_u32)CS_PACKET && first + lane < launch.pattern.grid.count;
         lane++)
        for (cs_u32 i = 0u; i < (cs_u32)CS_POINT_VALUES; i++)
            points[(size_t)(first + lane) * (cs_u32)CS_POINT_VALUES + i] = value[i].lane[lane];
}

/* Draws as the render kernel does and adds the coordinates up instead of tracing: what sampling
 * costs by itself. One work-item for each pixel; sums: one float each. */
CS_KERNEL void cs_draw_sum(const cs_launch launch, const float shear,
                           __global const uint *sample_table, __global const float *lens_table,
                           __global float *sums)
{
    cs_place place;
    if (get_global_id(0) >= launch.pixel_count) return;
    place.x = 0u;
    place.y = 0u;
    place.key = cs_pattern_key(launch.seed, (cs_u32)get_global_id(0), launch.replicate);
    place.shear = shear;
#if CS_HAS(MOTION)
    place.velocity.x = 0.0f;
    place.velocity.y = 0.0f;
#endif
    cs_vfloat sum = (cs_vfloat)(0.0f);
    cs_u32 end = launch.pattern.blocks * (cs_u32)CS_BLOCK;
    for (cs_u32 start = 0u; start < end; start += (cs_u32)(CS_TOGETHER * CS_PACKET)) {
        cs_drawn drawn;
        cs_draw_packets(&launch, sample_table, lens_table, &place, 0, 1, start, end, &drawn);
        for (int packet = 0; packet < drawn.count; packet++) {
            cs_camera_sample point = drawn.point[packet];
            sum += drawn.active[packet] ? point.x + point.y + point.u + point.v : (cs_vfloat)(0.0f);
        }
    }
    sums[get_global_id(0)] = cs_reduce_add(sum);
}
