/* Integer hashing and keyed permutations: everything random in a sample comes from here. */
#ifndef CLSHEAR_DEVICE_HASH_H
#define CLSHEAR_DEVICE_HASH_H

#include "packet.h"

#include "fp_contract_off.h"

/* A bijective mixer of 32 bits with low bias: two rounds of xor-shift and odd multiplication, with
 * multipliers found by C. Wellons' search ("Prospecting for Hash Functions", 2018). */
#define CS_DEFINE_HASH(name, type)  \
    static inline type name(type x) \
    {                               \
        x ^= x >> 16;               \
        x *= 0x7feb352du;           \
        x ^= x >> 15;               \
        x *= 0x846ca68bu;           \
        x ^= x >> 16;               \
        return x;                   \
    }

CS_DEFINE_HASH(cs_hash, cs_u32)
CS_DEFINE_HASH(cs_hash_lanes, cs_vuint)

/* Key number `index` of the family `seed`, any 32 bits. Different indices give different keys. */
#define CS_DEFINE_KEY(name, type, seed_type, index_type, hash) \
    static inline type name(seed_type seed, index_type index)  \
    {                                                          \
        return hash(seed + 0x9e3779b9u * (index + 1u));        \
    }

/* Of one family; for an index in each lane; and of a family in each lane. */
CS_DEFINE_KEY(cs_key, cs_u32, cs_u32, cs_u32, cs_hash)
CS_DEFINE_KEY(cs_key_lanes, cs_vuint, cs_u32, cs_vuint, cs_hash_lanes)
CS_DEFINE_KEY(cs_key_families, cs_vuint, cs_vuint, cs_vuint, cs_hash_lanes)

/* A box [0, mask] of a power of two of integers, in which cs_permute works. */
typedef struct cs_domain {
    cs_u32 mask;  /* the largest integer of the box */
    cs_u32 shift; /* half the box's bits, 1 or more */
} cs_domain;

/* The smallest box that holds [0, size). `size` is 1 to 2^31. */
static inline cs_domain cs_domain_of(cs_u32 size)
{
    cs_domain domain;
    domain.mask = 0u;
    cs_u32 bits = 0u;
    while (domain.mask + 1u < size) {
        domain.mask = 2u * domain.mask + 1u;
        bits++;
    }
    domain.shift = (bits + 1u) / 2u;
    if (domain.shift == 0u) domain.shift = 1u;
    return domain;
}

/* One keyed bijection of the box [0, mask]. Six multiplications: with four, pairs of a permutation
 * of 64 were so unevenly likely that single frequencies of its spectrum had half more power than
 * they should (tests/test_analysis.c). */
static inline cs_vuint cs_permute_round(cs_vuint x, cs_domain domain, cs_vuint key, cs_vuint step)
{
    cs_vuint third = step * 0x85ebca6bu;
    third ^= third >> 13;
    x = (x + key) & domain.mask;
    x = (x * (key >> 7 | 1u)) & domain.mask;
    x ^= x >> domain.shift;
    x = (x * (step >> 3 | 1u) + (step >> 17)) & domain.mask;
    x ^= x >> domain.shift;
    x = (x * (step >> 11 | 1u) + (key >> 23)) & domain.mask;
    x ^= x >> domain.shift;
    x = (x * (key >> 15 | 1u) + (step >> 25)) & domain.mask;
    x ^= x >> domain.shift;
    x = (x * (third | 1u) + (third >> 20)) & domain.mask;
    x ^= x >> domain.shift;
    x = (x * (third >> 8 | 1u) + (third >> 14)) & domain.mask;
    return x ^ (x >> domain.shift);
}

/* Image of `index` under the permutation of [0, size) that `key`, a hash, chooses.
 *
 * In every lane, index must be below size and size at most domain.mask + 1. Otherwise the walk
 * below need not end, and the kernel hangs.
 *
 * Keyed addition, keyed odd multiplication and xor-shift are bijections of the power-of-two box;
 * walking the cycle until it is back inside [0, size) restricts them to it (Black & Rogaway 2002,
 * section 3; Kensler 2013 for sampling). The last rotation makes every image equally likely for
 * every index, which is what unbiased estimates need. */
static inline cs_vuint cs_permute(cs_vuint index, cs_vuint size, cs_domain domain, cs_vuint key)
{
    cs_vuint step = key * 0x9e3779b1u;
    cs_vuint x = cs_permute_round(index, domain, key, step);
    while (cs_any(x >= size)) {
        cs_vuint next = cs_permute_round(x, domain, key, step);
        x = x >= size ? next : x;
    }
    x += cs_mul_hi(step ^ (step >> 15), size);
    return x >= size ? x - size : x;
}

#include "fp_contract_restore.h"

#endif
