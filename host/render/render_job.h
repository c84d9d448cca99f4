/* One render, from checked settings to accumulated pixels. */
#ifndef CS_RENDER_RENDER_JOB_H
#define CS_RENDER_RENDER_JOB_H

#include "film/film.h"
#include "kernels/launch.h"
#include "optics/optics.h"
#include "render/adaptive.h"
#include "render/lighting.h"
#include "render/pass.h"

typedef struct cs_job {
    clshear_scene *scene;
    clshear_settings settings; /* the caller's, completed */
    const clshear_film *base;  /* the film that is continued; NULL: none */
    cs_u32 spp;
    cs_u32 replicates;
    cs_u32 seed;
    int width; /* of the whole image, px */
    int height;
    clshear_shear shear_kind;
    clshear_oracle oracle;
    cs_camera camera;
    cs_lighting lighting;
    cs_u32 features; /* CS_FEATURE_ bits that the render needs, but for its AOVs */
    cs_u32 planes;   /* of AOVs: a set of CS_PLANE_ numbers */
    cs_optics_tables optics;
    cs_buffer *optics_table;
    cs_pattern pattern;
    int window[4]; /* x0, x1, y0, y1 */
    size_t pixel_count;
    cs_depth *depth;
    float *shear_px;
    uint8_t *rule;   /* cs_rule of each pixel */
    cs_u32 *samples; /* in a pattern of each pixel; NULL: the same for all, or `adaptive` */
    cs_adaptive adaptive;
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

/* Copies and completes the settings (NULL: fallbacks), checks them, and makes window, lights,
 * optics and camera. Start from zeros. A failed job is freed as others are. */
clshear_status cs_job_begin(cs_job *job, clshear_scene *scene, const clshear_settings *settings,
                            const clshear_film *base, cs_error *error);

/* Resolves samples and replicates, and chooses the pattern of a replicate. */
clshear_status cs_job_choose_samples(cs_job *job, cs_error *error);

/* Depths, shears, batches and buffers. When it is cancelled, the job can still be resolved. */
clshear_status cs_job_plan(cs_job *job, cs_error *error);
void cs_job_free(cs_job *job);

/* A pass over the job's window with its camera, seed and shear. */
cs_pass cs_job_pass(const cs_job *job);

/* Runs all passes. Each launch takes a fraction of a second, so that progress, cancelling and GPU
 * watchdogs work; how the work is cut into launches does not change the result. */
clshear_status cs_job_run_passes(cs_job *job, cs_error *error);

/* Turns the accumulated pixels into a film with metadata. */
clshear_status cs_job_resolve(cs_job *job, clshear_film **film, cs_error *error);

#endif
