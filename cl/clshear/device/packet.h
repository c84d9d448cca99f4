/* Packets: cs_vfloat, cs_vint and cs_vuint hold a value in a lane for each of CS_PACKET samples.
 *
 * A comparison makes a cs_vint, a mask, in which a true lane is 1 if there is one lane and -1 if
 * there are several. Use masks for nothing but cs_any and the ternary operator. At width 1 this is
 * plain C. */
#ifndef CLSHEAR_DEVICE_PACKET_H
#define CLSHEAR_DEVICE_PACKET_H

#include "constants.h"
#include "dialect.h"

#include "fp_contract_off.h"

#ifdef CS_DEVICE

#if CS_PACKET == 1
#define CS_VECTOR(scalar) scalar
#define CS_LANE_INDEX ((cs_vuint)0u)
#elif CS_PACKET == 4
#define CS_VECTOR(scalar) scalar##4
#define CS_LANE_INDEX ((cs_vuint)(0u, 1u, 2u, 3u))
#elif CS_PACKET == 8
#define CS_VECTOR(scalar) scalar##8
#define CS_LANE_INDEX ((cs_vuint)(0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u))
#elif CS_PACKET == 16
#define CS_VECTOR(scalar) scalar##16
#define CS_LANE_INDEX \
    ((cs_vuint)(0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u, 9u, 10u, 11u, 12u, 13u, 14u, 15u))
#else
#error "CS_PACKET must be 1, 4, 8 or 16"
#endif

typedef CS_VECTOR(float) cs_vfloat;
typedef CS_VECTOR(int) cs_vint;
typedef CS_VECTOR(uint) cs_vuint;

#define CS_OVER_LANES(function) CS_VECTOR(function)
#define cs_as_vint(x) CS_OVER_LANES(as_int)(x)
#define cs_as_vuint(x) CS_OVER_LANES(as_uint)(x)
#define cs_as_vfloat(x) CS_OVER_LANES(as_float)(x)
/* Unsigned integers below 2^31 as floats: the signed conversion is one instruction on x86. */
#define cs_to_vfloat(x) CS_OVER_LANES(convert_float)(cs_as_vint(x))
/* Integer parts of floats in [0, 2^31). */
#define cs_to_vuint(x) cs_as_vuint(CS_OVER_LANES(convert_int)(x))
#define cs_mul_hi(a, b) mul_hi((cs_vuint)(a), (cs_vuint)(b))
#define cs_sqrt(x) sqrt(x)
#define cs_cbrt(x) cbrt(x)
#define cs_abs(x) fabs(x)
#define cs_floor(x) floor(x)

#else /* C or C++, one lane */

typedef cs_f32 cs_vfloat;
typedef cs_i32 cs_vint;
typedef cs_u32 cs_vuint;

#define CS_LANE_INDEX ((cs_vuint)0u)
/* The bits of an unsigned integer as a signed one, of a float as an integer, and back. */
static inline cs_i32 cs_as_vint(cs_u32 x)
{
    cs_i32 y;
    memcpy(&y, &x, sizeof y);
    return y;
}
static inline cs_u32 cs_float_bits(cs_f32 x)
{
    cs_u32 y;
    memcpy(&y, &x, sizeof y);
    return y;
}
static inline cs_f32 cs_as_vfloat(cs_u32 x)
{
    cs_f32 y;
    memcpy(&y, &x, sizeof y);
    return y;
}
#define cs_as_vuint(x) cs_float_bits(x)
#define cs_to_vfloat(x) ((cs_f32)(cs_i32)(x))
#define cs_to_vuint(x) ((cs_u32)(cs_i32)(x))
#define cs_mul_hi(a, b) ((cs_u32)(((uint64_t)(a) * (uint64_t)(b)) >> 32))
#define cs_sqrt(x) sqrtf(x)
#define cs_cbrt(x) cbrtf(x)
#define cs_abs(x) fabsf(x)
#define cs_floor(x) floorf(x)
/* Whether any lane of a mask is true: here there is one. */
static inline int cs_any(cs_i32 mask)
{
    return mask != 0;
}

#endif

/* Packets that are mapped together at most (cs_shear_together): as many as lie between two updates
 * of a pixel. With one lane there is one, which keeps to registers. */
#if CS_PACKET == 1
#define CS_TOGETHER 1
#else
#define CS_TOGETHER (CS_FLUSH_BLOCKS * CS_BLOCK / CS_PACKET)
#endif

/* Smaller and larger of two values; arguments are evaluated twice. A NaN in the first argument
 * gives the second. fmin and fmax must order NaN, which costs two more instructions. */
#define cs_min(a, b) ((a) < (b) ? (a) : (b))
#define cs_max(a, b) ((a) > (b) ? (a) : (b))

/* `value` limited to [low, high]. A NaN becomes `low`. */
static inline cs_vfloat cs_clamp(cs_vfloat value, cs_vfloat low, cs_vfloat high)
{
    return cs_min(cs_max(value, low), high);
}

/* Unions give the lanes one by one. */
typedef union cs_float_lanes {
    cs_vfloat all;
    cs_f32 lane[CS_PACKET];
} cs_float_lanes;

typedef union cs_int_lanes {
    cs_vint all;
    cs_i32 lane[CS_PACKET];
} cs_int_lanes;

typedef union cs_uint_lanes {
    cs_vuint all;
    cs_u32 lane[CS_PACKET];
} cs_uint_lanes;

#ifdef CS_DEVICE

/* Compiled for the processor itself: translators of SPIR know no reductions. */
#if defined(__x86_64__) || defined(__aarch64__)
#define CS_NATIVE
#endif
#if defined(__has_builtin) && defined(CS_NATIVE)
#if __has_builtin(__builtin_reduce_or)
#define CS_REDUCE_OR(x) __builtin_reduce_or(x)
#endif
#endif

/* Asks for the cache line at a global address. Packets are for CPUs, where all addresses are alike.
 */
#if CS_PACKET > 1 && defined(__has_builtin) && defined(CS_NATIVE)
#if __has_builtin(__builtin_prefetch)
#define CS_PREFETCH(address) __builtin_prefetch((const void *)(address))
#endif
#endif
#ifndef CS_PREFETCH
#define CS_PREFETCH(address) (void)(address)
#endif

/* Whether any lane of a mask is true. Compilers with the reduction test a mask register, or move a
 * mask, by one instruction; narrowing does for others what any() makes a chain of extracts of. */
static inline int cs_any(cs_vint mask)
{
#if CS_PACKET == 1
    return mask != 0;
#elif defined(CS_REDUCE_OR)
    return CS_REDUCE_OR(mask) != 0;
#elif CS_PACKET == 4
    return as_uint(convert_char4(mask)) != 0u;
#elif CS_PACKET == 8
    return as_ulong(convert_char8(mask)) != 0ul;
#else
    return as_ulong(convert_char8(mask.lo | mask.hi)) != 0ul;
#endif
}

/* Declares `two`, the lanes of `x` folded by halves down to two, by a function of two vectors. */
#if CS_PACKET == 16
#define CS_FOLD(type, combine, x, two)          \
    type##8 eight = combine((x).lo, (x).hi);    \
    type##4 four = combine(eight.lo, eight.hi); \
    type##2 two = combine(four.lo, four.hi)
#elif CS_PACKET == 8
#define CS_FOLD(type, combine, x, two)      \
    type##4 four = combine((x).lo, (x).hi); \
    type##2 two = combine(four.lo, four.hi)
#elif CS_PACKET == 4
#define CS_FOLD(type, combine, x, two) type##2 two = combine((x).lo, (x).hi)
#endif
#define CS_SUM(a, b) ((a) + (b))

/* Sum of the lanes, in an order that the width fixes. */
static inline cs_f32 cs_reduce_add(cs_vfloat x)
{
#if CS_PACKET == 1
    return x;
#else
    CS_FOLD(float, CS_SUM, x, two);
    return two.x + two.y;
#endif
}

/* Largest lane, of floats. */
static inline cs_f32 cs_reduce_max_float(cs_vfloat x)
{
#if CS_PACKET == 1
    return x;
#else
    CS_FOLD(float, cs_max, x, two);
    return cs_max(two.x, two.y);
#endif
}

/* Largest lane. */
static inline cs_i32 cs_reduce_max(cs_vint x)
{
#if CS_PACKET == 1
    return x;
#else
    CS_FOLD(int, max, x, two);
    return max(two.x, two.y);
#endif
}

#endif

#include "fp_contract_restore.h"

#endif
