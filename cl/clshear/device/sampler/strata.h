/* Equal strata of [0, 1), and random places in them.
 *
 * Coordinates are multiples of 2^-24, the spacing of floats just below 1: whatever the number of
 * strata, every one of them is reached. */
#ifndef CLSHEAR_DEVICE_SAMPLER_STRATA_H
#define CLSHEAR_DEVICE_SAMPLER_STRATA_H

#include "../packet.h"

#include "../fp_contract_off.h"

/* A division of [0, 1) into `count` strata. */
typedef struct cs_strata {
    cs_u32 count; /* 1 to CS_MAX_PATTERN */
    cs_u32 whole; /* 2^24 / count, rounded down */
    cs_f32 part;  /* what rounding took off `whole`, 0 to 1 */
} cs_strata;
CS_SHARED_WORDS(cs_strata, 3);

/* 2^24 modulo the number of strata. */
static inline cs_u32 cs_strata_rest(const cs_strata *strata)
{
    return 0x1000000u - strata->whole * strata->count;
}

static inline cs_strata cs_strata_of(cs_u32 count)
{
    cs_strata strata;
    strata.count = count;
    strata.whole = 0x1000000u / count;
    strata.part = (cs_f32)cs_strata_rest(&strata) / (cs_f32)count;
    return strata;
}

/* A place in stratum number `stratum`, chosen by 32 random `bits`: one of the multiples of 2^-24 in
 * [stratum / count, (stratum + 1) / count).
 *
 * stratum * 2^24 / count is stratum * whole + below + left / count. The estimate of `below` by
 * floats is off by one at most, because stratum * part is below 2^20. Products of integers may
 * wrap, `left` does not. */
static inline cs_vfloat cs_in_stratum(const cs_strata *strata, cs_vuint stratum, cs_vuint bits)
{
    cs_vuint first = stratum * strata->whole;
    cs_vuint width = (cs_vuint)(strata->whole);
    cs_u32 rest = cs_strata_rest(strata);
    if (rest != 0u) {
        cs_i32 count = (cs_i32)strata->count;
        cs_vuint none = (cs_vuint)(0u), one = (cs_vuint)(1u);
        cs_vuint below = cs_to_vuint(cs_to_vfloat(stratum) * strata->part);
        cs_vint left = cs_as_vint(stratum * rest - below * strata->count);
        below = left < 0 ? below - 1u : below;
        left = left < 0 ? left + count : left;
        below = left >= count ? below + 1u : below;
        left = left >= count ? left - count : left;
        cs_vint after = left + (cs_i32)rest; /* the same of the next stratum */
        cs_vuint carry = after >= count ? one : none;
        after = after >= count ? after - count : after;
        cs_vuint up = left > 0 ? one : none; /* the stratum begins between two multiples */
        first += below + up;
        width += carry - up + (after > 0 ? one : none);
    }
    return cs_to_vfloat(first + cs_mul_hi(bits, width)) * 0x1p-24f;
}

#include "../fp_contract_restore.h"

#endif
