/* Tuples and their sheared points, written out: for tests, point sets and analysis. */
#include "frame.h"
#include "shear.h"

/* One work-item writes CS_PACKET consecutive samples of the pattern of `pixel`, 8 floats each: the
 * four coordinates of the tuple, then x, y, u, v after the shear. Global size: at least
 * ceil(grid.count / CS_PACKET). */
__kernel void cs_points(const cs_frame frame, const uint pixel, const float shear,
                        __global float *points)
{
    u32 first = (u32)get_global_id(0) * (u32)CS_PACKET;
    if (first >= frame.grid.count) return;
    vuint index = first + CS_LANE_INDEX;
    index = index < frame.grid.count ? index : (vuint)(0u);
    u32 key = cs_pattern_key(frame.seed, pixel, frame.replicate);
    cs_pair film = cs_draw_pair(&frame.grid, key, CS_PAIR_FIBRE, index);
    cs_pair lens = cs_draw_pair(&frame.grid, key, CS_PAIR_LENS, index);
    cs_film_lens point =
        cs_shear(film.x, film.y, lens.x, lens.y, frame.shear_mode, frame.camera.aperture, shear);
    cs_float_lanes value[8];
    value[0].all = film.x;
    value[1].all = film.y;
    value[2].all = lens.x;
    value[3].all = lens.y;
    value[4].all = point.x;
    value[5].all = point.y;
    value[6].all = point.u;
    value[7].all = point.v;
    for (u32 lane = 0u; lane < (u32)CS_PACKET && first + lane < frame.grid.count; lane++)
        for (u32 i = 0u; i < 8u; i++)
            points[(size_t)(first + lane) * 8u + i] = value[i].lane[lane];
}
