/* Launches of the render kernel: patterns of one kind for some pixels, in pieces. */
#ifndef CS_RENDER_PASS_H
#define CS_RENDER_PASS_H

#include "kernels/launch.h"
#include "render/lighting.h"
#include "render/pixels.h"
#include "settings/settings.h"

/* Pixels that draw patterns of the same size. */
typedef struct cs_batch {
    cs_pattern pattern;
    cs_buffer *rows;  /* the pattern's sample table; retained */
    cs_buffer *order; /* cs_u32: the pixels, numbered in the window row by row; owned */
    size_t pixel_count;
    int compact;       /* whether states lie in this order, not in that of the window */
    size_t *page_ends; /* of each page of pixels: where in the order the next begins; owned */
} cs_batch;

/* How far a replicate is: batch by batch, part by part. All zero: at its beginning. */
typedef struct cs_place {
    double part;    /* of every batch's pattern that is drawn */
    double next;    /* part after the step in progress; not above `part`: no step is in progress */
    uint64_t batch; /* that the step is at */
    uint64_t pixel; /* and the pixel in it, in its order */
} cs_place;

/* What all launches of a render have in common, and how far it is. */
typedef struct cs_pass {
    clshear_scene *scene;
    cs_launch launch;            /* camera, seed, window, shear mode, lights */
    const cs_buffer *optics;     /* their table */
    const cs_buffer *shears;     /* of every pixel of the window */
    const cs_buffer *velocities; /* likewise; NULL where nothing moves */
    const cs_pixels *pixels;
    const cs_lighting *lighting;
    cs_u32 features;                  /* CS_FEATURE_ bits of the variant that renders it */
    const clshear_settings *settings; /* whose progress callback is called; NULL: no calls */
    /* Called after each launch, before the progress callback, with `user`; NULL: no calls. */
    clshear_status (*between)(void *user, cs_error *error);
    void *user;
    cs_place place;
    double noise;       /* of the picture, for the progress callback; 0: unknown */
    double noise_pixel; /* likewise, of its pixels */
    int is_open;        /* whether a promise may end the render, and nobody knows yet when */
    double start_s;
    double rate;  /* samples per second of the last launches */
    double done;  /* samples */
    double total; /* samples; 0: unknown */
    double kernel_s;
} cs_pass;

/* A batch of the pixels listed in `pixels`, row by row or in a walk through tiles; all `count` of a
 * window of this width where that is NULL. compact: their states are in the order of the list. */
clshear_status cs_batch_create(clshear_context *context, const cs_pattern *pattern,
                               const cs_u32 *pixels, size_t count, cs_u32 width, int compact,
                               cs_batch *batch, cs_error *error);
/* Gives a batch another pattern. */
clshear_status cs_batch_set_pattern(clshear_context *context, const cs_pattern *pattern,
                                    cs_batch *batch, cs_error *error);
void cs_batch_free(cs_batch *batch);

/* Whether the next replicate of the pass starts from its beginning. */
int cs_pass_is_fresh(const cs_pass *pass);

/* Draws one replicate of every batch's patterns from pass->place on: of all of them a part, then
 * the next part, so that an interrupted picture is even. How the work is cut does not change a bit
 * of the result. At the end the place is that of a new beginning. */
clshear_status cs_pass_replicate(cs_pass *pass, const cs_batch *batches, size_t batch_count,
                                 cs_u32 replicate, cs_error *error);

/* Tells the progress callback of `settings` that work without a measure goes on, and fails with
 * CS_CANCELLED where it asks to stop. */
clshear_status cs_pass_ask(const clshear_settings *settings, cs_error *error);

/* Drivers finish compiling a kernel when it is first launched. Launches it without pixels, so that
 * those whose time is taken do not wait for that. */
clshear_status cs_pass_warm_up(cs_device *device, cs_u32 features, cs_error *error);

#endif
