/* From places in a pixel's pattern to points of the pixel and the lens, a few packets at once.
 * Device only. */
#ifndef CS_DRAW_H
#define CS_DRAW_H

#include "frame.h"
#include "shear.h"

typedef struct cs_place {
    u32 x; /* raster coordinates in the whole image */
    u32 y;
    u32 state; /* index in the buffer of pixels */
    u32 key;   /* of the pixel's current pattern */
    f32 shear; /* of its tuples, pixels */
} cs_place;

/* Pixel `number` of the crop, row by row, which is the launch's pixel `index`. */
static inline cs_place cs_place_of(const cs_frame *frame, u32 index, u32 number, f32 shear)
{
    cs_place place;
    place.x = frame->crop_x + number % frame->crop_width;
    place.y = frame->crop_y + number / frame->crop_width;
    place.state = (frame->compact ? frame->first_pixel + index : number) - frame->page_first;
    place.key =
        cs_pattern_key(frame->seed, place.y * frame->image_width + place.x, frame->replicate);
    place.shear = shear;
    return place;
}

/* Packets that are drawn before any of them is traced. Their draws do not depend on each other and
 * overlap in the processor; one by one they wait on their own latency. */
typedef struct cs_drawn {
    int count;              /* packets, at most CS_TOGETHER */
    int place[CS_TOGETHER]; /* whose samples they are */
    f32 shear[CS_TOGETHER];
    vint active[CS_TOGETHER]; /* lanes that are samples of the pattern */
    cs_film_lens point[CS_TOGETHER];
    cs_pair emitter[CS_TOGETHER];
} cs_drawn;

/* One packet of them, which begins at place `start` of the pixel's order, up to `end`. */
static inline void cs_draw_packet(const cs_frame *frame, cs_rows rows, cs_optics_table table,
                                  const cs_place *places, int number, u32 start, u32 end,
                                  cs_drawn *drawn)
{
    const cs_place *place = places + number;
    int k = drawn->count++;
    vfloat tuple[CS_DIMENSIONS];
    vuint position = start + CS_LANE_INDEX;
    vint inside = position < end;
    vuint index = cs_index_at(&frame->pattern, place->key, inside ? position : (vuint)(start));
    vint active = inside & (index < frame->pattern.grid.count);
    index = active ? index : (vuint)(0u);
    tuple[4] = (vfloat)(0.0f);
    tuple[5] = (vfloat)(0.0f);
    cs_draw(&frame->pattern, rows, place->key, index, frame->emitters > 0u ? 3u : 2u, tuple);
    cs_film_lens point = {tuple[0], tuple[1], tuple[2], tuple[3]};
    drawn->place[k] = number;
    drawn->shear[k] = place->shear;
    drawn->active[k] = active;
    drawn->point[k] =
        cs_shear_alone(point, frame->shear_mode, &frame->camera.optics, table, place->shear);
    drawn->emitter[k].x = tuple[4];
    drawn->emitter[k].y = tuple[5];
}

/* Draws the next packets of a few pixels from place `start` of their order on, up to `end`: of one
 * pixel as many as fit, of several all that there are. */
static inline void cs_draw_packets(const cs_frame *frame, cs_rows rows, cs_optics_table table,
                                   const cs_place *places, int count, u32 start, u32 end,
                                   cs_drawn *drawn)
{
    drawn->count = 0;
    for (int number = 0; number < count; number++)
        for (u32 at = start; drawn->count < CS_TOGETHER && at < end; at += (u32)CS_PACKET)
            cs_draw_packet(frame, rows, table, places, number, at, end, drawn);
    cs_shear_together(drawn->point, drawn->shear, drawn->count, frame->shear_mode,
                      &frame->camera.optics);
}

#endif
