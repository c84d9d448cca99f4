/* The way of a sample: tuple -> shear -> ray -> hit -> radiance -> mean and variance. */
#include "kernels/features.h"
#if !CS_HAS(SAMPLERS)
#define CS_NETS_ONLY
#endif

#include "accumulator.h"
#include "aov_sums.h"
#include "clshear/device/lens.h"
#include "kernels/draw.h"
#include "kernels/kernel.h"
#include "kernels/path.h"
#include "kernels/radiance.h"

/* A packet's camera: at rest, or where it is at the lanes' times. */
static inline cs_eye cs_eye_of(const cs_launch *launch, const cs_drawn *drawn, int packet)
{
#if CS_HAS(MOTION)
    return cs_eye_at(launch, drawn->time[packet]);
#else
    (void)drawn;
    (void)packet;
    return launch->camera;
#endif
}

static inline cs_ray cs_camera_ray(const cs_launch *launch, const cs_eye *eye,
                                   const cs_place *place, cs_camera_sample point)
{
#if CS_HAS(MOTION)
    return cs_eye_ray(launch, eye, point.x + (cs_f32)place->x, point.y + (cs_f32)place->y, point.u,
                      point.v);
#else
    (void)eye;
    return cs_lens_ray(launch->camera, point.x + (cs_f32)place->x, point.y + (cs_f32)place->y,
                       point.u, point.v);
#endif
}

/* Updates of pixels whose samples are traced together. */
#if CS_HAS(PATHS)
#define CS_UPDATES CS_FLUSHES
#else
#define CS_UPDATES 1
#endif

#if CS_HAS(PATHS)
/* Traces the packets of up to CS_UPDATES updates, of one pixel or of several. Their paths are
 * followed together, or pixel by pixel where samplers do not know several. radiance: of each
 * packet, CS_TOGETHER for each update. */
static inline void cs_trace_packets(const cs_launch *launch, const cs_scene_buffers *scene,
                                    cs_sample_table sample_table, const cs_place *places,
                                    const cs_drawn *drawn, int flushes, cs_radiance *radiance)
{
    cs_paths paths;
    cs_radiance *wanted[CS_POOL];
    int count = 0, pools = cs_pads_lanes(launch->pattern.sampler);
    paths.launch = launch;
    paths.paired = cs_has_light_pair(launch);
    for (int f = 0; f < flushes; f++)
        for (int packet = 0; packet < drawn[f].count; packet++) {
            const cs_place *place = places + drawn[f].place[packet];
            cs_draws draws = {&launch->pattern, sample_table, (cs_vuint)(place->key),
                              drawn[f].index[packet]};
            const cs_eye eye = cs_eye_of(launch, drawn + f, packet);
            cs_ray ray = cs_camera_ray(launch, &eye, place, drawn[f].point[packet]);
            cs_path_begin(&paths, count, &ray, drawn[f].light[packet], &draws,
                          drawn[f].active[packet]);
#if CS_HAS(MOVING)
            paths.path[count].time = drawn[f].time[packet];
#endif
            wanted[count++] = radiance + f * CS_TOGETHER + packet;
            int is_last = packet + 1 < drawn[f].count
                              ? !pools && drawn[f].place[packet + 1] != drawn[f].place[packet]
                              : f + 1 == flushes;
            if (!is_last) continue;
            cs_follow_paths(scene, &paths, count);
            for (int i = 0; i < count; i++)
                *wanted[i] = paths.found[i];
            count = 0;
        }
}
#else
static inline void cs_trace_packets(const cs_launch *launch, const cs_scene_buffers *scene,
                                    cs_sample_table sample_table, const cs_place *places,
                                    const cs_drawn *drawn, int flushes, cs_radiance *radiance)
{
    (void)sample_table;
    (void)flushes;
    for (int packet = 0; packet < drawn->count; packet++) {
        const cs_eye eye = cs_eye_of(launch, drawn, packet);
        cs_ray ray =
            cs_camera_ray(launch, &eye, places + drawn->place[packet], drawn->point[packet]);
        cs_scene_buffers at = *scene;
#if CS_HAS(MOVING)
        at.time = drawn->time[packet];
#endif
        radiance[packet] = cs_radiance_along(&at, launch->lights, &ray, drawn->light[packet],
                                             drawn->active[packet]);
    }
}
#endif

/* What was gathered since the pixel's last update. */
typedef struct cs_gathered {
    cs_accumulator accumulator;
#if CS_HAS(AOVS)
    cs_aov_sums sums;
#endif
    int first; /* whether that is nothing yet */
} cs_gathered;

/* Gathers what packets that were drawn together found, and merges it into the pixels. goes_on:
 * whether more packets are part of the update. */
static inline void cs_gather_packets(const cs_launch *launch, const cs_place *places,
                                     const cs_drawn *drawn, cs_radiance *radiance, int goes_on,
                                     cs_gathered *gathered, CS_GLOBAL cs_pixel *pixels,
                                     CS_GLOBAL cs_exact_sum *aovs)
{
    for (int packet = 0; packet < drawn->count; packet++) {
        const cs_place *place = places + drawn->place[packet];
        cs_radiance *found = radiance + packet;
        const cs_eye eye = cs_eye_of(launch, drawn, packet);
        cs_note_depth(&eye, found);
        cs_accumulator_add(&gathered->accumulator, found->channel, found->shadow_rays,
                           drawn->active[packet], gathered->first);
#if CS_HAS(AOVS)
        cs_aov_sums_add(&gathered->sums, found, drawn->active[packet], gathered->first);
#else
        (void)aovs;
#endif
        gathered->first =
            packet + 1 < drawn->count ? drawn->place[packet + 1] != drawn->place[packet] : !goes_on;
        if (!gathered->first) continue;
        cs_accumulator_merge(pixels + place->state, &gathered->accumulator);
#if CS_HAS(AOVS)
        cs_aov_sums_merge(launch, &gathered->sums, place->state, aovs);
#endif
    }
}

/* Samples at places `start` to `end` of the order of a few pixels, gathered and merged into them:
 * of one pixel any number, of several no more than an update has. */
static inline void cs_sample(const cs_launch *launch, const cs_scene_buffers *scene,
                             cs_sample_table sample_table, cs_optics_table lens_table,
                             const cs_place *places, int count, cs_u32 start, cs_u32 end,
                             CS_GLOBAL cs_pixel *pixels, CS_GLOBAL cs_exact_sum *aovs)
{
    const cs_u32 step = (cs_u32)(CS_TOGETHER * CS_PACKET);
    cs_drawn drawn[CS_UPDATES];
    cs_radiance radiance[CS_UPDATES * CS_TOGETHER];
    cs_gathered gathered;
    int first = 0, each = (int)max(cs_pixels_of_update(end - start, (cs_u32)CS_PACKET), (cs_u32)1);
    gathered.first = 1;
    while (start < end) {
        int draws = 0;
        while (draws < CS_UPDATES && start < end) {
            int last = first + each < count ? first + each : count;
            cs_draw_packets(launch, sample_table, lens_table, places, first, last, start, end,
                            drawn + draws++);
            first = last < count ? last : 0;
            start += first == 0 ? step : 0u;
        }
        cs_trace_packets(launch, scene, sample_table, places, drawn, draws, radiance);
        /* An update is what is drawn together, but with one lane: there it is all. */
        int goes_on = CS_PACKET == 1 && count == 1 && start < end;
        for (int d = 0; d < draws; d++)
            cs_gather_packets(launch, places, drawn + d, radiance + d * CS_TOGETHER, goes_on,
                              &gathered, pixels, aovs);
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
    cs_place places[CS_UPDATES * CS_TOGETHER];
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
    const cs_u32 step = (cs_u32)(CS_UPDATES * CS_FLUSH_BLOCKS);
    for (cs_u32 block = launch.first_block; block < launch.last_block; block += step) {
        cs_u32 end = min(block + step, launch.last_block) * (cs_u32)CS_BLOCK;
        cs_sample(&launch, &scene, sample_table, lens_table, places, count,
                  block * (cs_u32)CS_BLOCK, end, pixels, aovs);
    }
    if (launch.last_block != launch.pattern.blocks || launch.goes_on != 0u) return;
    for (int i = 0; i < count; i++)
        cs_finish_pattern(pixels + places[i].state);
}
