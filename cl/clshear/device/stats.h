/* Running moments: count, mean and sum of squared deviations. */
#ifndef CLSHEAR_DEVICE_STATS_H
#define CLSHEAR_DEVICE_STATS_H

#include "dialect.h"

#include "fp_contract_off.h"

typedef struct cs_moments {
    cs_f32 count; /* number of values; starts at 0 */
    cs_f32 mean;  /* of the values; starts at 0 */
    cs_f32 m2;    /* sum of squared deviations from the mean; starts at 0 */
} cs_moments;

/* Moments of the union of two disjoint sets (Chan, Golub & LeVeque 1979, eq. 2.1). Either may be
 * empty. */
static inline cs_moments cs_moments_merge(cs_moments a, cs_moments b)
{
    cs_moments both;
    both.count = a.count + b.count;
    if (both.count == 0.0f) return a;
    cs_f32 delta = b.mean - a.mean;
    cs_f32 share = b.count / both.count;
    both.mean = a.mean + delta * share;
    both.m2 = a.m2 + b.m2 + delta * delta * a.count * share;
    return both;
}

/* Moments with one more value (Welford 1962): the merge with a set of one. */
static inline cs_moments cs_moments_add(cs_moments a, cs_f32 value)
{
    cs_moments one;
    one.count = 1.0f;
    one.mean = value;
    one.m2 = 0.0f;
    return cs_moments_merge(a, one);
}

/* A sum of about 48 bits: its value is `sum` + `carry`. */
typedef struct cs_exact_sum {
    cs_f32 sum;   /* the value rounded to a float */
    cs_f32 carry; /* what rounding has lost */
} cs_exact_sum;

/* Adds by Knuth's two-sum (TAOCP 2, 4.2.2), exact for any order of magnitudes, and renormalises so
 * that the carry stays below half an ulp of the sum. */
static inline cs_exact_sum cs_exact_add(cs_exact_sum total, cs_f32 value)
{
    cs_f32 sum = total.sum + value;
    cs_f32 shadow = sum - total.sum;
    cs_f32 carry = total.carry + ((total.sum - (sum - shadow)) + (value - shadow));
    cs_exact_sum next;
    next.sum = sum + carry;
    next.carry = carry - (next.sum - sum);
    return next;
}

#include "fp_contract_restore.h"

#endif
