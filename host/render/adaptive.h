/* Renders that share samples out between pixels by need, and keep all of them.
 *
 * Two replicates begin with the same samples in every pixel, but for those that show the background
 * alone, which have a few and no more. How many a pixel has in one is decided by its samples in the
 * beginning of the other. Then each pattern is drawn to its end, its beginning a part of it. Pixels
 * that need no more than the beginning are not drawn again.
 *
 * Unbiased: the size of a pattern is a function of another replicate's samples, which are
 * independent of its own; so, given its size, its mean has the expected value of every pattern of
 * that size, which is the pixel's. Samples of other pixels are independent of it too, and both
 * beginnings of the neighbours may be looked at. The pixel is the mean of both with equal
 * weights: weights by size would depend on the samples that they weigh. */
#ifndef CS_RENDER_ADAPTIVE_H
#define CS_RENDER_ADAPTIVE_H

#include "clshear/device/stats.h"
#include "kernels/pixel.h"
#include "render/pass.h"

struct cs_job;

enum {
    CS_MOST_BATCHES = 24,
    CS_BEGINNINGS = 2,         /* replicates */
    CS_LEAST_TO_SHARE_OUT = 8, /* samples in a pattern */
    /* ... and without being asked: patterns of fewer than two packets leave lanes idle where
     * samples are shared out, and at equal time more samples for all pixels are better. */
    CS_LEAST_TO_SHARE_OUT_UNASKED = 32,
};

/* One of the replicates. */
typedef struct cs_share {
    cs_u32 *samples;         /* in a pattern of each pixel; at first: in its beginning */
    cs_exact_sum *beginning; /* sums of three colours of each pixel */
    cs_exact_sum *aovs;      /* likewise, of the planes of each pixel; NULL: none */
    cs_batch batches[CS_MOST_BATCHES];
    size_t batch_count;
} cs_share;

/* Start from zeros. */
typedef struct cs_adaptive {
    int is_unasked;   /* whether sharing out is this module's choice, which a pilot may revoke */
    cs_u32 begin;     /* samples of a beginning; 0: the job does not share out in this way */
    cs_u32 few;       /* samples of a beginning in a certain pixel */
    cs_u32 drawn;     /* beginnings that are complete */
    cs_u32 begun;     /* replicates that went on from their beginning */
    cs_u32 closed;    /* replicates that are complete */
    uint8_t *certain; /* of each pixel: whether it shows the background alone */
    cs_share shares[CS_BEGINNINGS];
    double *aov_means; /* sums over the closed replicates of the means of their planes */
} cs_adaptive;

/* Samples of a pixel's beginning. */
cs_u32 cs_adaptive_begun_with(const cs_adaptive *adaptive, size_t index);

/* Where the settings do not say whether samples are shared out, sets that they are if this way can
 * be taken and pays: with a progressive sampler, two replicates of CS_LEAST_TO_SHARE_OUT_UNASKED
 * samples or more, and nothing that is or will be continued, has a stop rule, is a shard or has a
 * checkpoint. The
 * job must have its samples and its pattern. */
clshear_status cs_adaptive_complete(struct cs_job *job, cs_error *error);

/* Whether the job shares its samples out in this way. Needs its settings and its pattern. */
int cs_adaptive_shares(const struct cs_job *job);

/* Bytes a pixel on the host: what a job that shares out keeps until its end, and what the first
 * patterns of its pixels take besides while they are drawn. */
size_t cs_adaptive_bytes(const struct cs_job *job);
size_t cs_adaptive_begin_bytes(void);

/* Reserves the host memory of sharing out; does nothing for a job with even samples. Where nobody
 * asked and it promises little, the setting becomes that of even samples. */
clshear_status cs_adaptive_plan(struct cs_job *job, cs_error *error);
void cs_adaptive_free(cs_adaptive *adaptive);

/* Draws the replicates of the job. */
clshear_status cs_adaptive_run(struct cs_job *job, cs_pass *pass, cs_error *error);

/* The mean of a colour of a pixel, of whatever is drawn. */
double cs_adaptive_mean(const struct cs_job *job, const cs_pixel *pixel, size_t index, int colour);

/* The AOVs of a job that has some; of others these do nothing. Reserves memory; takes the sums of a
 * beginning off the device; puts them back; takes those of a complete replicate off it; and, in the
 * end, puts there what resolves to the mean of whatever is drawn. */
clshear_status cs_adaptive_reserve_aovs(struct cs_job *job, cs_error *error);
clshear_status cs_adaptive_take_aovs(struct cs_job *job, cs_u32 replicate, cs_error *error);
clshear_status cs_adaptive_put_aovs(struct cs_job *job, cs_u32 replicate, cs_error *error);
clshear_status cs_adaptive_close_aovs(struct cs_job *job, cs_u32 replicate, cs_error *error);
clshear_status cs_adaptive_settle_aovs(struct cs_job *job, cs_error *error);

#endif
