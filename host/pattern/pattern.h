/* Samplers by name: their sample counts, patterns and sample tables. */
#ifndef CS_PATTERN_PATTERN_H
#define CS_PATTERN_PATTERN_H

#include "base/array.h"
#include "base/status.h"
#include "clshear/device/sampler/pattern.h"

/* Finds the CS_SAMPLER_ number of a name; NULL is the default. The error message lists all
 * names. */
clshear_status cs_sampler_find(const char *name, cs_u32 *sampler, cs_error *error);
const char *cs_sampler_name(cs_u32 sampler);
const char *cs_sampler_about(cs_u32 sampler);
cs_u32 cs_sampler_default(void);

/* Returns 1 if the first samples of a pattern are independent of its length, else 0. */
int cs_sampler_is_progressive(cs_u32 sampler);

/* Whether kernels that draw nets alone (CS_NETS_ONLY) draw it. */
int cs_sampler_is_net(cs_u32 sampler);

/* The smallest sample count of the construction that is `wanted` or more. `wanted` is 1 or more.
 * Returns 0 if there is none. */
cs_u32 cs_sampler_count(cs_u32 sampler, cs_u32 wanted);

/* The largest sample count of a pattern, CS_MAX_PATTERN or less. */
cs_u32 cs_sampler_most(cs_u32 sampler);

/* The constants of the pattern of elements `first` ... `first` + `count` - 1. `count` must be a
 * sample count of the sampler; `first` must be 0 unless the sampler is progressive. */
cs_pattern cs_pattern_of(cs_u32 sampler, cs_u32 first, cs_u32 count);

/* Number of parts of a pattern's sample table: the sets of a pool of planar sets, 64 for up to 4096
 * points and fewer for more, otherwise 1. */
cs_u32 cs_pattern_parts(const cs_pattern *pattern);

/* Lets a pattern of planar sets have its own ones, made from `seed`, instead of the shared ones
 * that are kept on disk. Leaves other patterns as they are. */
void cs_pattern_refresh(cs_pattern *pattern, cs_u32 seed);

/* A pattern of the next sample count from `count` on, with the sampler and the pool of `like`.
 * There must be such a count. */
cs_pattern cs_pattern_of_length(const cs_pattern *like, cs_u32 count);

/* Order of a table's rows: blocks of neighbours, as the renderer draws them, or the sampler's
 * sequence. */
typedef enum cs_sample_order {
    CS_ORDER_COHERENT,
    CS_ORDER_SEQUENCE
} cs_sample_order;

/* Fills `table_words`, an array of cs_u32, with the sample table of a pattern. Samplers without a
 * table leave it empty. */
clshear_status cs_sample_table_make(const cs_pattern *pattern, cs_sample_order order,
                                    cs_array *table_words, cs_error *error);

#endif
