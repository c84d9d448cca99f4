/* What one launch of the render kernel is told. Shared. */
#ifndef CS_KERNELS_LAUNCH_H
#define CS_KERNELS_LAUNCH_H

#include "clshear/device/camera.h"
#include "clshear/device/sampler/sampler.h"
#include "clshear/device/shutter.h"
#include "kernels/features.h"

enum {
    /* Floats that the points kernel writes for each sample: the tuple, then x, y, u, v, time. */
    CS_POINT_VALUES = CS_DIMENSIONS + CS_MAIN_DIMENSIONS + 1,
    /* Floats of a point at which the radiance kernel evaluates: a tuple and the time. */
    CS_EVALUATED = CS_DIMENSIONS + 1,
    /* Samples whose paths a work-item follows together, in updates of CS_FLUSH_BLOCKS blocks of
     * samples each. With packets of one lane it is one update. */
    CS_POOL_FLUSHES = 4
};

/* How the camera moves while the shutter is open: eye, line of sight and up direction change
 * linearly, the rest of the camera does not. */
typedef struct cs_camera_motion {
    cs_f32 eye_step[3]; /* from open to closed, units of the scene */
    cs_f32 sight[3];    /* from eye to target where it opens; any length */
    cs_f32 sight_step[3];
    cs_f32 up[3];
    cs_f32 up_step[3];
} cs_camera_motion;
CS_SHARED_WORDS(cs_camera_motion, 15);

typedef struct cs_launch {
    cs_camera camera;        /* where the shutter opens */
    cs_camera_motion motion; /* with the feature MOTION */
    cs_shutter shutter;      /* likewise */
    cs_pattern pattern;
    cs_u32 seed;
    cs_u32 replicate;
    cs_u32 first_block; /* blocks of the pattern that this launch draws; a multiple of */
    cs_u32 last_block;  /* CS_FLUSH_BLOCKS, or the pattern's end */
    cs_u32 image_width; /* numbers pixels independently of the crop */
    cs_u32 crop_x;
    cs_u32 crop_y;
    cs_u32 crop_width;
    cs_u32 crop_height;
    cs_u32 first_pixel; /* place in the order in which pixels are drawn */
    cs_u32 pixel_count;
    cs_u32 pixels_each; /* that a work-item draws together, see cs_pixels_together */
    cs_u32 compact;     /* whether the buffer of pixels has them in that order, not row by row */
    cs_u32 page_first;  /* number, in the buffer's order, of the pixel that it begins with */
    cs_u32 shear_mode;  /* CS_SHEAR_ */
    cs_u32 lights;
    cs_u32 area_lights; /* lights that are sampled by a pair of the tuple, or only by rays */
    cs_u32 only_rays;   /* whether some surfaces shine that only rays are sure to find */
    cs_u32 dark;        /* whether no surface shines on others: lights alone do */
    cs_u32 bounces;     /* surfaces after the first one that scatter light */
    cs_u32 see_through; /* whether some surfaces let rays pass: alpha */
    cs_f32 clamp;       /* most that a bounce adds to a channel; 0: no limit */
    cs_u32 planes;      /* of AOVs that are kept: a set of CS_PLANE_ numbers */
    cs_u32 goes_on;     /* 1: more samples follow the pattern's last, so it is not finished */
} cs_launch;
CS_SHARED_WORDS(cs_launch, 96);

/* Whether tuples have a pair for the first surface's light: the place on area lights, and opposite
 * in the unit square, the direction that goes on. */
static inline int cs_has_light_pair(const cs_launch *launch)
{
    return launch->area_lights > 0u || launch->bounces > 0u;
}

/* Of how many pixels the samples make an update, CS_FLUSH_BLOCKS blocks, if that is whole packets
 * of each: of every one `samples` are drawn. 0: one pixel has more. packet: lanes. */
static inline cs_u32 cs_pixels_of_update(cs_u32 samples, cs_u32 packet)
{
    cs_u32 together = packet > 1u ? (cs_u32)(CS_FLUSH_BLOCKS * CS_BLOCK) / packet : 1u;
    cs_u32 packets = (samples + packet - 1u) / packet;
    return packets > 0u ? together / packets : 0u;
}

/* The number of pixels that one work-item draws: as many as have the samples of one update, or of
 * CS_POOL_FLUSHES updates if it may follow paths of several pixels together. blocks: of samples of
 * each pixel in the launch. packet: lanes. pools: whether it may. */
static inline cs_u32 cs_pixels_together(cs_u32 blocks, cs_u32 packet, int pools)
{
    cs_u32 pixels = cs_pixels_of_update(blocks * (cs_u32)CS_BLOCK, packet);
    if (packet == 1u || pixels == 0u) return 1u;
    return pixels * (pools ? (cs_u32)CS_POOL_FLUSHES : 1u);
}

/* Raster index (row by row) of the pixel that is number `order` in a walk through tiles of 8 x 8
 * pixels: neighbours in time are neighbours in both directions, and find their nodes in the cache.
 * Tiles at the right and lower edge are narrower. */
static inline cs_u32 cs_tiled_pixel(cs_u32 order, cs_u32 width, cs_u32 height)
{
    const cs_u32 side = 8u;
    cs_u32 band = order / (side * width);
    cs_u32 rows = height - band * side < side ? height - band * side : side;
    cs_u32 within_band = order - band * side * width;
    cs_u32 tile = within_band / (side * rows);
    cs_u32 columns = width - tile * side < side ? width - tile * side : side;
    cs_u32 within_tile = within_band - tile * side * rows;
    cs_u32 row = band * side + within_tile / columns;
    return row * width + tile * side + within_tile % columns;
}

#endif
