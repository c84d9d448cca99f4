/* From places in a pixel's pattern to points of the pixel and the lens, a few packets at once.
 * Device only. */
#ifndef CS_KERNELS_DRAW_H
#define CS_KERNELS_DRAW_H

#include "clshear/device/shear.h"
#include "kernels/motion.h"
#include "launch.h"

typedef struct cs_place {
    cs_u32 x; /* raster coordinates in the whole image */
    cs_u32 y;
    cs_u32 state; /* index in the buffer of pixels */
    cs_u32 key;   /* of the pixel's current pattern */
    cs_f32 shear; /* of its tuples, pixels */
#if CS_HAS(MOTION)
    cs_velocity velocity; /* of what it sees on the film */
#endif
} cs_place;

/* Pixel `number` of the crop, row by row, which is the launch's pixel `index`. */
static inline cs_place cs_place_of(const cs_launch *launch, cs_u32 index, cs_u32 number,
                                   cs_f32 shear)
{
    cs_place place;
    place.x = launch->crop_x + number % launch->crop_width;
    place.y = launch->crop_y + number / launch->crop_width;
    place.state = (launch->compact ? launch->first_pixel + index : number) - launch->page_first;
    place.key =
        cs_pattern_key(launch->seed, place.y * launch->image_width + place.x, launch->replicate);
    place.shear = shear;
    return place;
}

/* Packets that are drawn before any of them is traced. Their draws do not depend on each other and
 * overlap in the processor; one by one they wait on their own latency. */
typedef struct cs_drawn {
    int count;              /* packets, at most CS_TOGETHER */
    int place[CS_TOGETHER]; /* whose samples they are */
    cs_f32 shear[CS_TOGETHER];
    cs_vint active[CS_TOGETHER]; /* lanes that are samples of the pattern */
    cs_camera_sample point[CS_TOGETHER];
#if CS_HAS(MOTION)
    cs_vfloat time[CS_TOGETHER]; /* of the shutter, 0 to 1 */
#endif
    cs_pair light[CS_TOGETHER]; /* the tuple's slot, if cs_has_light_pair */
#if CS_HAS(PATHS)
    cs_vuint index[CS_TOGETHER]; /* in the pattern */
#endif
} cs_drawn;

/* Whether the light gets the lens's pair of a tuple: where the equal-area shear makes that pair
 * move along fibres only, and with a pinhole, which has no use for it. A shear of exactly 0 is
 * none: that of a pixel whose rule is not to shear. */
static inline int cs_exchanges_pairs(const cs_launch *launch, cs_f32 shear)
{
    return launch->shear_mode == (cs_u32)CS_SHEAR_EQUAL_AREA &&
           (shear != 0.0f || launch->camera.aperture_width == 0.0f);
}

/* The pair of samples `index` for the first surface's light. Where cs_exchanges_pairs, the light
 * takes the lens's pair out of the tuple `point`, and the lens gets the pair of the light's slot.
 * The pixel's pair decides what a sample sees. The light's pair decides whether that is lit. The
 * sampler stratifies these two together. The lens's pair moves along the fibre only. */
static inline cs_pair cs_draw_light(const cs_launch *launch, cs_sample_table sample_table,
                                    cs_u32 key, cs_vuint index, cs_f32 shear,
                                    cs_camera_sample *point)
{
    cs_pair light = cs_draw_extra(&launch->pattern, sample_table, key, index, CS_SLOT_LIGHT);
    if (!cs_exchanges_pairs(launch, shear)) return light;
    cs_pair lens = light;
    light.x = point->u;
    light.y = point->v;
    point->u = lens.x;
    point->v = lens.y;
    return light;
}

/* One packet of them, which begins at place `start` of the pixel's order, up to `end`. */
static inline void cs_draw_packet(const cs_launch *launch, cs_sample_table sample_table,
                                  cs_optics_table lens_table, const cs_place *places, int number,
                                  cs_u32 start, cs_u32 end, cs_drawn *drawn)
{
    const cs_place *place = places + number;
    int k = drawn->count++;
    cs_vfloat tuple[CS_MAIN_DIMENSIONS];
    cs_vuint position = start + CS_LANE_INDEX;
    cs_vint inside = position < end;
    cs_vuint index =
        cs_index_at(&launch->pattern, place->key, inside ? position : (cs_vuint)(start));
    cs_vint active = inside & (index < launch->pattern.grid.count);
    index = active ? index : (cs_vuint)(0u);
    cs_draw(&launch->pattern, sample_table, place->key, index, tuple);
    cs_camera_sample point = {tuple[CS_AT_FILM], tuple[CS_END_FILM], tuple[CS_AT_LENS],
                              tuple[CS_END_LENS]};
    drawn->light[k].x = (cs_vfloat)(0.0f);
    drawn->light[k].y = (cs_vfloat)(0.0f);
    if (cs_has_light_pair(launch))
        drawn->light[k] =
            cs_draw_light(launch, sample_table, place->key, index, place->shear, &point);
    drawn->place[k] = number;
    drawn->shear[k] = place->shear;
    drawn->active[k] = active;
#if CS_HAS(MOTION)
    cs_vfloat time = cs_draw_time(&launch->pattern, sample_table, place->key, index,
                                  cs_has_light_pair(launch), &point);
    cs_moving_sample moving =
        cs_shear_moving(point, time, launch->shear_mode, &launch->camera.optics, lens_table,
                        place->shear, place->velocity);
    drawn->point[k] = moving.point;
    drawn->time[k] = cs_shutter_time(moving.time, launch->shutter);
#else
    drawn->point[k] =
        cs_shear_alone(point, launch->shear_mode, &launch->camera.optics, lens_table, place->shear);
#endif
#if CS_HAS(PATHS)
    drawn->index[k] = index;
#endif
}

/* Draws the next packets of pixels `first` to `last` - 1 from place `start` of their order on, up
 * to `end`: of one pixel as many as fit, of several all that there are. */
static inline void cs_draw_packets(const cs_launch *launch, cs_sample_table sample_table,
                                   cs_optics_table lens_table, const cs_place *places, int first,
                                   int last, cs_u32 start, cs_u32 end, cs_drawn *drawn)
{
    drawn->count = 0;
    for (int number = first; number < last; number++)
        for (cs_u32 at = start; drawn->count < CS_TOGETHER && at < end; at += (cs_u32)CS_PACKET)
            cs_draw_packet(launch, sample_table, lens_table, places, number, at, end, drawn);
#if !CS_HAS(MOTION)
    cs_shear_together(drawn->point, drawn->shear, drawn->count, launch->shear_mode,
                      &launch->camera.optics);
#endif
}

#endif
