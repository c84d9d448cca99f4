/* What one launch of the render kernel is told. Shared. */
#ifndef CS_FRAME_H
#define CS_FRAME_H

#include "sampler/sampler.h"
#include "shared.h"

enum {
    CS_POINT_VALUES = CS_DIMENSIONS + 4 /* that the points kernel writes for each sample */
};

typedef struct cs_frame {
    cs_camera camera;
    cs_pattern pattern;
    u32 seed;
    u32 replicate;
    u32 first_block; /* blocks of the pattern that this launch draws; a multiple of */
    u32 last_block;  /* CS_FLUSH_BLOCKS, or the pattern's end */
    u32 image_width; /* numbers pixels independently of the crop */
    u32 crop_x;
    u32 crop_y;
    u32 crop_width;
    u32 crop_height;
    u32 first_pixel; /* place in the order in which pixels are drawn */
    u32 pixel_count;
    u32 pixels_each; /* that a work-item draws together, see cs_pixels_together */
    u32 compact;     /* whether the buffer of pixels has them in that order, not row by row */
    u32 page_first;  /* number, in the buffer's order, of the pixel that it begins with */
    u32 shear_mode;  /* CS_SHEAR_ */
    u32 lights;
    u32 emitters;
} cs_frame;
CS_SHARED_WORDS(cs_frame, 69);

/* How many pixels a work-item draws, so that their packets make CS_TOGETHER.
 * blocks: of a pixel's pattern in the launch. packet: lanes. */
static inline u32 cs_pixels_together(u32 blocks, u32 packet)
{
    u32 together = packet > 1u ? (u32)(CS_FLUSH_BLOCKS * CS_BLOCK) / packet : 1u;
    u32 packets = (blocks * (u32)CS_BLOCK + packet - 1u) / packet;
    return packets > 0u && packets < together ? together / packets : 1u;
}

/* Raster index (row by row) of the pixel that is number `order` in a walk through tiles of 8 x 8
 * pixels: neighbours in time are neighbours in both directions, and find their nodes in the cache.
 * Tiles at the right and lower edge are narrower. */
static inline u32 cs_tiled_pixel(u32 order, u32 width, u32 height)
{
    const u32 side = 8u;
    u32 band = order / (side * width);
    u32 rows = height - band * side < side ? height - band * side : side;
    u32 within_band = order - band * side * width;
    u32 tile = within_band / (side * rows);
    u32 columns = width - tile * side < side ? width - tile * side : side;
    u32 within_tile = within_band - tile * side * rows;
    u32 row = band * side + within_tile / columns;
    return row * width + tile * side + within_tile % columns;
}

#endif
