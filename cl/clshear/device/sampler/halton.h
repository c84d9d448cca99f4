/* The scrambled Halton sequence. */
#ifndef CLSHEAR_DEVICE_SAMPLER_HALTON_H
#define CLSHEAR_DEVICE_SAMPLER_HALTON_H

#include "net.h"

#include "../fp_contract_off.h"

enum {
    CS_HALTON_DIGITS3 = 13, /* digits in base 3 that number CS_MAX_PATTERN elements */
    CS_HALTON_DIGITS5 = 9,  /* digits in base 5 that number as many */
    CS_HALTON_DIGITS7 = 8,  /* digits in base 7 that number as many */
    CS_HALTON_BITS3 = 2,    /* bits of a word for each digit in base 3 */
    CS_HALTON_BITS5 = 3,    /* bits of a word for each digit in base 5 */
    CS_HALTON_BITS7 = 3     /* bits of a word for each digit in base 7 */
};

/* One coordinate: the digits d of a word, first ones lowest, become a d + c modulo the base, with a
 * and c chosen for each place. An affine map of a prime field takes two different digits to every
 * pair of different digits equally often, which is all that variance sees of a random permutation.
 * The digits from `used` on are zero in every element of the pattern and are permuted alike. */
static inline cs_vfloat cs_halton_axis(cs_vuint digits, cs_u32 key, cs_u32 base, cs_u32 bits,
                                       cs_u32 used, cs_u32 all)
{
    const cs_u32 mask = (1u << bits) - 1u;
    const cs_u32 inverse = (255u + base) / base; /* exact quotients up to (base - 1) * base */
    cs_vuint value = (cs_vuint)(0u);
    cs_u32 tail = 0u, scale = 1u, full = 1u;
    for (cs_u32 place = 0u; place < all; place++) {
        cs_u32 random = cs_key(key, place);
        cs_u32 shift = ((random >> 16) * base) >> 16;
        full *= base;
        if (place >= used) {
            tail = tail * base + shift;
            scale *= base;
            continue;
        }
        cs_u32 factor = 1u + (((random & 0xffffu) * (base - 1u)) >> 16);
        cs_vuint digit = ((digits >> (bits * place)) & mask) * factor + shift;
        digit -= base * ((digit * inverse) >> 8);
        value = value * base + digit;
    }
    return (cs_to_vfloat(value * scale + tail) + 0.5f) * (1.0f / (cs_f32)full);
}

/* Film by bases 2 and 3, lens by 5 and 7. Word 0 of the table is the element number, words 1 to 3
 * its digits in bases 3, 5 and 7. pattern->shape holds how many digits of each base are in use. */
static inline void cs_draw_halton(const cs_pattern *pattern, cs_sample_table table, cs_u32 key,
                                  cs_vuint index, cs_vfloat *tuple)
{
    const cs_u32 *used = pattern->shape;
    tuple[0] = cs_scrambled(cs_sample_word(pattern, table, 0u, index), key, 0u);
    tuple[1] =
        cs_halton_axis(cs_sample_word(pattern, table, 1u, index), cs_key(key, CS_KEY_DIMENSION + 1),
                       3u, CS_HALTON_BITS3, used[1], CS_HALTON_DIGITS3);
    tuple[2] =
        cs_halton_axis(cs_sample_word(pattern, table, 2u, index), cs_key(key, CS_KEY_DIMENSION + 2),
                       5u, CS_HALTON_BITS5, used[2], CS_HALTON_DIGITS5);
    tuple[3] =
        cs_halton_axis(cs_sample_word(pattern, table, 3u, index), cs_key(key, CS_KEY_DIMENSION + 3),
                       7u, CS_HALTON_BITS7, used[3], CS_HALTON_DIGITS7);
}

#include "../fp_contract_restore.h"

#endif
