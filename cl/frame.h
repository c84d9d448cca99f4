/* What one launch of the render kernel is told. Shared. */
#ifndef CS_FRAME_H
#define CS_FRAME_H

#include "sampler/sampler.h"
#include "shared.h"

typedef struct cs_frame {
    cs_camera camera;
    cs_grid grid;
    u32 seed;
    u32 replicate;
    u32 first_block; /* blocks of the pattern that this launch draws; a multiple of */
    u32 last_block;  /* CS_FLUSH_BLOCKS, or the pattern's end */
    u32 image_width; /* numbers pixels independently of the crop */
    u32 crop_x;
    u32 crop_y;
    u32 crop_width;
    u32 first_pixel; /* of the crop, row by row */
    u32 pixel_count;
    u32 shear_mode; /* CS_SHEAR_ */
    u32 lights;
    u32 emitters;
} cs_frame;
CS_SHARED_WORDS(cs_frame, 48);

#endif
