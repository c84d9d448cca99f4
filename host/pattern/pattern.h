/* Samplers by name: which counts they have, and the patterns and tables that the kernels draw from.
 */
#ifndef CS_PATTERN_PATTERN_H
#define CS_PATTERN_PATTERN_H

#include "base/array.h"
#include "base/status.h"
#include "clshear/device/sampler/pattern.h"

/* CS_SAMPLER_ number of a name; NULL is the default. Fails with the list of names. */
clshear_status cs_sampler_find(const char *name, cs_u32 *sampler, cs_error *error);
const char *cs_sampler_name(cs_u32 sampler);
const char *cs_sampler_about(cs_u32 sampler);
cs_u32 cs_sampler_default(void);

/* Whether a pattern's first samples do not depend on how many follow. */
int cs_sampler_is_progressive(cs_u32 sampler);

/* The least number of samples >= `wanted` (at least 1) that the construction has, or 0 if that is
 * more than its maximum. */
cs_u32 cs_sampler_count(cs_u32 sampler, cs_u32 wanted);

/* The most samples in a pattern, CS_MAX_PATTERN or less. */
cs_u32 cs_sampler_most(cs_u32 sampler);

/* The constants of the pattern of elements `first` ... `first` + `count` - 1. `count` must be one
 * that the sampler has; `first` must be 0 unless it is progressive. */
cs_pattern cs_pattern_of(cs_u32 sampler, cs_u32 first, cs_u32 count);

/* Order of a table's rows: as the renderer draws them, blocks of neighbours; or as they follow each
 * other in the sequence. */
typedef enum cs_sample_order {
    CS_ORDER_COHERENT,
    CS_ORDER_SEQUENCE
} cs_sample_order;

/* Fills `rows`, an array of cs_u32, with the table of a pattern; leaves it empty where there is
 * none.
 */
clshear_status cs_sample_table_make(const cs_pattern *pattern, cs_sample_order order,
                                    cs_array *rows, cs_error *error);

#endif
