/* From places in a pixel's pattern to points of the pixel and the lens, a few packets at once.
 * Device only. */
#ifndef CS_DRAW_H
#define CS_DRAW_H

#include "frame.h"
#include "shear.h"

typedef struct cs_place {
    u32 x; /* raster coordinates in the whole image */
    u32 y;
    u32 key;   /* of the pixel's current pattern */
    f32 shear; /* of its tuples, pixels */
} cs_place;

/* Packets are drawn some ahead of their tracing. Their draws do not depend on each other and
 * overlap in the processor; one by one they wait on their own latency. One lane keeps to registers.
 */
#if CS_PACKET == 1
#define CS_AHEAD 1
#else
#define CS_AHEAD (CS_FLUSH_BLOCKS * CS_BLOCK / CS_PACKET)
#endif

/* A packet ready to be traced. */
typedef struct cs_drawn {
    vint active; /* lanes that are samples of the pattern */
    cs_film_lens point;
    cs_pair emitter;
} cs_drawn;

/* Draws the packet that begins at place `start` of the pixel's order, up to place `end`. */
static inline void cs_draw_packet(const cs_frame *frame, cs_rows rows, cs_optics_table table,
                                  const cs_place *place, u32 start, u32 end, cs_drawn *drawn)
{
    vfloat tuple[CS_DIMENSIONS];
    vuint position = start + CS_LANE_INDEX;
    vint inside = position < end;
    vuint index = cs_index_at(&frame->pattern, place->key, inside ? position : (vuint)(start));
    vint active = inside & (index < frame->pattern.grid.count);
    index = active ? index : (vuint)(0u);
    tuple[4] = (vfloat)(0.0f);
    tuple[5] = (vfloat)(0.0f);
    cs_draw(&frame->pattern, rows, place->key, index, frame->emitters > 0u ? 3u : 2u, tuple);
    drawn->active = active;
    drawn->point = cs_shear(tuple[0], tuple[1], tuple[2], tuple[3], frame->shear_mode,
                            &frame->camera.optics, table, place->shear);
    drawn->emitter.x = tuple[4];
    drawn->emitter.y = tuple[5];
}

#endif
