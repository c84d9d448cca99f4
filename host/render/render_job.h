/* One render, from checked options to gathered pixels. */
#ifndef CS_RENDER_JOB_H
#define CS_RENDER_JOB_H

#include "film/film.h"
#include "kernels/launch.h"
#include "optics/optics.h"
#include "render/pass.h"

enum {
    CS_MOST_BATCHES = 24
};

typedef struct cs_job {
    clshear_scene *scene;
    clshear_options options;
    clshear_camera lens; /* as the caller gave it */
    cs_camera camera;
    cs_optics_tables optics;
    cs_buffer *optics_table;
    cs_pattern pattern;
    int window[4]; /* x0, x1, y0, y1 */
    size_t pixel_count;
    cs_depth *depth;
    float *shear_px;
    uint8_t *rule;   /* cs_rule of each pixel */
    cs_u32 *samples; /* in a pattern of each pixel; NULL: the same for all */
    float *gain;     /* NULL: not asked for */
    double pilot_samples;
    cs_batch batches[CS_MOST_BATCHES];
    size_t batch_count;
    cs_pixels pixels;
    cs_buffer *shears;
    /* For extensions, else NULL: means of finished patterns, a plane for each replicate and colour;
     * and the sums they are taken from, three for each pixel. */
    float *pattern_means;
    double *pattern_sums;
    uint32_t patterns_kept;
    uint32_t replicates_begun;
    double prepass_s;
    double pilot_s;
    double kernel_s;
} cs_job;

/* Checks the options and the lens, chooses window and pattern, and makes the optics and the frame.
 */
clshear_status cs_job_check(cs_job *job, cs_error *error);

/* Depths, shears, batches and buffers. When it is cancelled, the job can still be resolved. */
clshear_status cs_job_plan(cs_job *job, cs_error *error);
void cs_job_free(cs_job *job);

/* A pass over the job's window with its camera, seed and shear. */
cs_pass cs_job_pass(const cs_job *job);

/* Runs all passes. Each launch takes a fraction of a second, so that progress, cancelling and GPU
 * watchdogs work; how the work is cut into launches does not change the result. */
clshear_status cs_job_run_passes(cs_job *job, cs_error *error);

/* Turns the gathered pixels into a film with metadata. */
clshear_status cs_job_resolve(cs_job *job, clshear_film **film, cs_error *error);

#endif
