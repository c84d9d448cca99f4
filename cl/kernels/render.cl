/* The way of a sample: tuple -> shear -> ray -> hit -> radiance -> mean and variance. */
#include "accumulator.h"
#include "aov_sums.h"
#include "clshear/device/lens.h"
#include "kernels/draw.h"
#include "kernels/kernel.h"
#include "kernels/path.h"

static inline void cs_trace_packet(const cs_launch *launch, const cs_scene_buffers *scene,
                                   cs_sample_table sample_table, const cs_place *place,
                                   const cs_drawn *drawn, int packet, cs_radiance *radiance)
{
#if CS_HAS(MOVING)
    cs_scene_buffers moved = *scene;
    moved.time = drawn->time[packet];
    scene = &moved;
#endif
    cs_camera_sample point = drawn->point[packet];
#if CS_HAS(MOTION)
    const cs_eye eye = cs_eye_at(launch, drawn->time[packet]);
    cs_ray ray = cs_eye_ray(launch, &eye, point.x + (cs_f32)place->x, point.y + (cs_f32)place->y,
                            point.u, point.v);
#else
    const cs_eye eye = launch->camera;
    cs_ray ray = cs_lens_ray(launch->camera, point.x + (cs_f32)place->x, point.y + (cs_f32)place->y,
                             point.u, point.v);
#endif
#if CS_HAS(PATHS)
    cs_draws draws = {&launch->pattern, sample_table, place->key, drawn->index[packet]};
    *radiance =
        cs_path_along(scene, launch, &ray, drawn->light[packet], &draws, drawn->active[packet]);
#else
    (void)sample_table;
    *radiance =
        cs_radiance_along(scene, launch->lights, &ray, drawn->light[packet], drawn->active[packet]);
#endif
    cs_note_depth(&eye, radiance);
}

/* Samples at places `start` to `end` of the order of a few pixels, gathered and merged into them.
 * Of several pixels there are no more than are drawn together. */
static inline void cs_sample(const cs_launch *launch, const cs_scene_buffers *scene,
                             cs_sample_table sample_table, cs_optics_table lens_table,
                             const cs_place *places, int count, cs_u32 start, cs_u32 end,
                             CS_GLOBAL cs_pixel *pixels, CS_GLOBAL cs_exact_sum *aovs)
{
    cs_drawn drawn;
    cs_accumulator accumulator;
#if CS_HAS(AOVS)
    cs_aov_sums sums;
#else
    (void)aovs;
#endif
    int first = 1;
    for (; start < end; start += (cs_u32)(CS_TOGETHER * CS_PACKET)) {
        int more = count == 1 && start + (cs_u32)(CS_TOGETHER * CS_PACKET) < end;
        cs_draw_packets(launch, sample_table, lens_table, places, count, start, end, &drawn);
        for (int packet = 0; packet < drawn.count; packet++) {
            const cs_place *place = places + drawn.place[packet];
            cs_radiance radiance;
            cs_trace_packet(launch, scene, sample_table, place, &drawn, packet, &radiance);
            cs_accumulator_add(&accumulator, radiance.channel, radiance.shadow_rays,
                               drawn.active[packet], first);
#if CS_HAS(AOVS)
            cs_aov_sums_add(&sums, &radiance, drawn.active[packet], first);
#endif
            first =
                packet + 1 < drawn.count ? drawn.place[packet + 1] != drawn.place[packet] : !more;
            if (first) cs_accumulator_merge(pixels + place->state, &accumulator);
#if CS_HAS(AOVS)
            if (first) cs_aov_sums_merge(launch, &sums, place->state, aovs);
#endif
        }
    }
}

/* One work-item draws blocks [first_block, last_block) of the patterns of launch.pixels_each
 * pixels.
 *
 * Global size: at least launch.pixel_count / launch.pixels_each, rounded up; any local size.
 * pixels: one cs_pixel for each pixel of the crop from launch.page_first on, or each that is drawn,
 * zero at first. aovs: for each of them the sums of the planes in launch.planes; not used without
 * the feature AOVS. order: the crop's pixels (row by row) in the order in which they are drawn.
 * shears: the oracle's answer for each pixel of the crop, in pixels. velocities: two floats for
 * each, in pixels while the shutter is open; not used without the feature MOTION. sample_table: the
 * pattern's.
 * lens_table: the optics'. The others: the scene, see cs_scene_buffers. */
CS_KERNEL void cs_render(const cs_launch launch, __global cs_pixel *pixels,
                         __global cs_exact_sum *aovs, __global const uint *order,
                         __global const float *shears, __global const float *velocities,
                         __global const uint *sample_table,
                         __global const float *lens_table CS_SCENE_PARAMETERS)
{
    cs_u32 begin = (cs_u32)get_global_id(0) * launch.pixels_each;
    if (begin >= launch.pixel_count) return;
    const cs_scene_buffers scene = CS_SCENE_VALUES;
    cs_place places[CS_TOGETHER];
    int count = (int)min(launch.pixels_each, launch.pixel_count - begin);
    for (int i = 0; i < count; i++) {
        cs_u32 number = order[launch.first_pixel + begin + (cs_u32)i];
        places[i] = cs_place_of(&launch, begin + (cs_u32)i, number, shears[number]);
#if CS_HAS(MOTION)
        places[i].velocity.x = velocities[2u * (size_t)number];
        places[i].velocity.y = velocities[2u * (size_t)number + 1u];
#else
        (void)velocities;
#endif
    }
    for (cs_u32 block = launch.first_block; block < launch.last_block; block += CS_FLUSH_BLOCKS) {
        cs_u32 end = min(block + (cs_u32)CS_FLUSH_BLOCKS, launch.last_block) * (cs_u32)CS_BLOCK;
        cs_sample(&launch, &scene, sample_table, lens_table, places, count,
                  block * (cs_u32)CS_BLOCK, end, pixels, aovs);
    }
    if (launch.last_block != launch.pattern.blocks || launch.goes_on != 0u) return;
    for (int i = 0; i < count; i++)
        cs_finish_pattern(pixels + places[i].state);
}
