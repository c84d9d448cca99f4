/* One render, from checked settings to accumulated pixels. */
#ifndef CS_RENDER_RENDER_JOB_H
#define CS_RENDER_RENDER_JOB_H

#include "film/film.h"
#include "kernels/launch.h"
#include "optics/optics.h"
#include "oracle/oracle.h"
#include "render/adaptive.h"
#include "render/lighting.h"
#include "render/pass.h"
#include "render/stop.h"

/* Sums of the samples that a pixel has of a pattern that is not finished. */
typedef struct cs_open_pattern {
    cs_f32 sum[3];
    cs_f32 carry[3];
    cs_u32 pending;
} cs_open_pattern;

/* Rounds of a render that may end early: see rounds.h. */
typedef struct cs_rounds {
    cs_open_pattern *open; /* of each replicate, pixel by pixel; NULL: draws no such rounds */
    cs_pattern whole[CS_MOST_BATCHES]; /* of the batches, if nothing ends the render early */
    cs_u32 from;                       /* samples of the job's pattern in all replicates, ... */
    cs_u32 to;                         /* ... and after the round in progress. Or replicates */
    cs_u32 replicate;                  /* of the round in progress */
} cs_rounds;

/* What a render holds at its fullest, bytes: see memory.h. */
typedef struct cs_memory {
    double host;
    double device;
    double both; /* at once: at most the sum, as the two need not be fullest at the same time */
} cs_memory;

struct cs_viewer;

/* Who sees the picture while it is rendered: see live.h. */
typedef struct cs_live {
    struct cs_viewer *viewer; /* NULL: none, or lost */
    clshear_film *film;       /* on its way to the viewer; owned; NULL: none is */
    double shown_s;           /* when the viewer's last film was made, ... */
    double cost_s;            /* ... and how long that took */
    double kept_s;            /* when the file was written */
    int file_fails;           /* whether that failed */
} cs_live;

typedef struct cs_job {
    clshear_scene *scene;
    clshear_settings settings; /* the caller's, completed */
    const clshear_film *base;  /* the film that is continued; NULL: none */
    cs_u32 spp;
    cs_u32 replicates;
    cs_u32 shard;     /* the job draws replicates shard, shard + shards, ... */
    cs_u32 shards;    /* 1: all of them */
    cs_u32 pilot_spp; /* that pilots are a part of */
    cs_stop stop;
    cs_rounds rounds;
    cs_live live;
    cs_u32 seed;
    int width; /* of the whole image, px */
    int height;
    clshear_shear shear_kind;
    clshear_oracle oracle;
    cs_camera camera; /* where the shutter opens */
    cs_shutter_cameras cameras;
    cs_camera_motion motion;
    int moves; /* whether anything does while the shutter is open */
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
    float *gain; /* NULL: not asked for */
    double pilot_samples;
    cs_batch batches[CS_MOST_BATCHES];
    size_t batch_count;
    cs_pixels pixels;
    int is_over; /* no more passes: resolving may give the pixels back */
    cs_buffer *shears;
    cs_velocity *velocities_px; /* NULL where nothing moves, as `velocities` */
    cs_buffer *velocities;      /* of the chosen rules */
    /* For extensions, else NULL: means of finished patterns, a plane for each replicate and colour;
     * and the sums they are taken from, three for each pixel. */
    float *pattern_means;
    double *pattern_sums;
    uint32_t patterns_kept;
    uint32_t replicates_begun;
    int resumes;      /* whether the job goes on from a checkpoint */
    int save_fails;   /* whether the last checkpoint could not be written */
    double saved_s;   /* when the last checkpoint was written */
    double start_s;   /* when the render began */
    cs_memory memory; /* without the scene */
    double prepass_s;
    double pilot_s;
    double kernel_s;
    double drawn; /* samples of the passes */
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

/* The oracle's shear by a rule for pixel `index` of the window, row by row, whose depths are known.
 */
cs_f32 cs_job_shear(const cs_job *job, size_t index, cs_rule rule);

/* How many of the lights are sampled by a pair of the tuple; those that only rays are sure to find
 * count as one. */
cs_u32 cs_area_lights(const cs_job *job);

/* A pass over the job's window with its camera, seed and shear. */
cs_pass cs_job_pass(const cs_job *job);

/* Runs all passes. Each launch takes a fraction of a second, so that progress, cancelling and GPU
 * watchdogs work; how the work is cut into launches does not change the result. */
clshear_status cs_job_run_passes(cs_job *job, cs_error *error);

/* Patterns that the job draws for a pixel: its shard of the replicates. */
cs_u32 cs_job_patterns(const cs_job *job);

/* Turns the accumulated pixels into a film with metadata. */
clshear_status cs_job_resolve(cs_job *job, clshear_film **film, cs_error *error);

/* Bytes of a pixel in that film. */
size_t cs_film_bytes(const cs_job *job);

#endif
