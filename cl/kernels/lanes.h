/* Loads from a place of its own in each lane, which have no vector form. Shared.
 *
 * Everything around them, places and weights, is computed for all lanes at once. */
#ifndef CS_KERNELS_LANES_H
#define CS_KERNELS_LANES_H

#include "clshear/device/packet.h"

/* Integer parts of floats in [0, 2^31), as signed integers. */
static inline cs_vint cs_whole(cs_vfloat x)
{
    return cs_as_vint(cs_to_vuint(x));
}

#ifdef CS_DEVICE

/* Packets, and four floats, at addresses that are multiples of 4 bytes. A pointer to a plain vector
 * promises a multiple of the vector's size; AVX-512 loads fault where that does not hold. */
typedef cs_vfloat __attribute__((aligned(4))) cs_loose_float;
typedef cs_vint __attribute__((aligned(4))) cs_loose_int;
typedef cs_vuint __attribute__((aligned(4))) cs_loose_uint;
typedef float4 __attribute__((aligned(4))) cs_loose_four;

static inline cs_vfloat cs_from_whole(cs_vint x)
{
    return CS_OVER_LANES(convert_float)(x);
}

/* CS_EACH_LANE(of) is the packet of the numbers of(lane). CS_NEIGHBOURS(of, i) is a packet of rows
 * of four numbers: of(i), of(i + 4) and so on. CS_TRANSPOSED takes column i of the first rows of
 * four packets, then column j of the second ones, and so on. All are written out: a packet cannot
 * be loaded before the stores of its single lanes are done. */
#if CS_PACKET == 16
#define CS_EACH_LANE(of)                                                                      \
    (cs_vfloat)(of(0), of(1), of(2), of(3), of(4), of(5), of(6), of(7), of(8), of(9), of(10), \
                of(11), of(12), of(13), of(14), of(15))
#define CS_NEIGHBOURS(of, i) (cs_vfloat)(of(i), of(i + 4), of(i + 8), of(i + 12))
#define CS_TRANSPOSED(rows, i, j, k, l)                                               \
    (cs_vfloat)(rows[0].s##i, rows[1].s##i, rows[2].s##i, rows[3].s##i, rows[0].s##j, \
                rows[1].s##j, rows[2].s##j, rows[3].s##j, rows[0].s##k, rows[1].s##k, \
                rows[2].s##k, rows[3].s##k, rows[0].s##l, rows[1].s##l, rows[2].s##l, \
                rows[3].s##l)
#elif CS_PACKET == 8
#define CS_EACH_LANE(of) (cs_vfloat)(of(0), of(1), of(2), of(3), of(4), of(5), of(6), of(7))
#define CS_NEIGHBOURS(of, i) (cs_vfloat)(of(i), of(i + 4))
#define CS_TRANSPOSED(rows, i, j, k, l)                                               \
    (cs_vfloat)(rows[0].s##i, rows[1].s##i, rows[2].s##i, rows[3].s##i, rows[0].s##j, \
                rows[1].s##j, rows[2].s##j, rows[3].s##j)
#elif CS_PACKET == 4
#define CS_EACH_LANE(of) (cs_vfloat)(of(0), of(1), of(2), of(3))
#else
#define CS_EACH_LANE(of) of(0)
#endif

/* table[index] in each lane. */
static inline cs_vfloat cs_gather(CS_GLOBAL const cs_f32 *table, cs_vint index)
{
    cs_int_lanes place;
    place.all = index;
#define CS_ONE(i) table[place.lane[i]]
    return CS_EACH_LANE(CS_ONE);
#undef CS_ONE
}

#if CS_PACKET >= 8
/* Number i of the rows of all lanes, for i from 0 to 3. Lanes 4 apart share a packet of rows: so
 * numbers move within a quarter of a vector register, which is faster than a move across quarters.
 */
static inline void cs_columns(const float4 *row, cs_vfloat *columns)
{
    cs_vfloat rows[4];
#define CS_ONE(i) row[i]
    rows[0] = CS_NEIGHBOURS(CS_ONE, 0);
    rows[1] = CS_NEIGHBOURS(CS_ONE, 1);
    rows[2] = CS_NEIGHBOURS(CS_ONE, 2);
    rows[3] = CS_NEIGHBOURS(CS_ONE, 3);
#undef CS_ONE
    columns[0] = CS_TRANSPOSED(rows, 0, 4, 8, c);
    columns[1] = CS_TRANSPOSED(rows, 1, 5, 9, d);
    columns[2] = CS_TRANSPOSED(rows, 2, 6, a, e);
    columns[3] = CS_TRANSPOSED(rows, 3, 7, b, f);
}
#endif

/* Four neighbours, from table[index] on, in each lane. */
static inline void cs_gather_four(CS_GLOBAL const cs_f32 *table, cs_vint index, cs_vfloat *found)
{
#if CS_PACKET >= 8
    cs_int_lanes place;
    float4 row[CS_PACKET];
    place.all = index;
    for (int lane = 0; lane < CS_PACKET; lane++)
        row[lane] = vload4(0, table + place.lane[lane]);
    cs_columns(row, found);
#else
    for (int i = 0; i < 4; i++)
        found[i] = cs_gather(table, index + i);
#endif
}

#else

static inline cs_vfloat cs_from_whole(cs_vint x)
{
    return (cs_vfloat)x;
}

static inline cs_vfloat cs_gather(const cs_f32 *table, cs_vint index)
{
    return table[index];
}

static inline void cs_gather_four(const cs_f32 *table, cs_vint index, cs_vfloat *found)
{
    for (cs_i32 i = 0; i < 4; i++)
        found[i] = table[index + i];
}

#endif

/* Four neighbours from table[first] on and four from table[second] on, blended linearly: `part` is
 * the weight of the second ones, 0 to 1. */
static inline void cs_blend_four(CS_GLOBAL const cs_f32 *table, cs_vint first, cs_vint second,
                                 cs_vfloat part, cs_vfloat *found)
{
    cs_vfloat other[4];
    cs_gather_four(table, first, found);
    cs_gather_four(table, second, other);
    for (int i = 0; i < 4; i++)
        found[i] += part * (other[i] - found[i]);
}

/* Blends four rows of four numbers bilinearly in each lane. Row i begins at table[corner[i]]; the
 * corners are the upper left, lower left, upper right and lower right one. down: weight of the
 * lower rows, 0 to 1. across: weight of the right rows, 0 to 1. */
static inline void cs_blend_corners(CS_GLOBAL const cs_f32 *table, const cs_vint *corner,
                                    cs_vfloat across, cs_vfloat down, cs_vfloat *found)
{
#if defined(CS_DEVICE) && CS_PACKET >= 8
    /* All four numbers of a lane at once. */
    cs_int_lanes place[4];
    cs_float_lanes to_right, to_lower;
    float4 row[CS_PACKET];
    for (int i = 0; i < 4; i++)
        place[i].all = corner[i];
    to_right.all = across;
    to_lower.all = down;
    for (int lane = 0; lane < CS_PACKET; lane++) {
        float4 near = vload4(0, table + place[0].lane[lane]);
        float4 far = vload4(0, table + place[2].lane[lane]);
        near += to_lower.lane[lane] * (vload4(0, table + place[1].lane[lane]) - near);
        far += to_lower.lane[lane] * (vload4(0, table + place[3].lane[lane]) - far);
        row[lane] = near + to_right.lane[lane] * (far - near);
    }
    cs_columns(row, found);
#else
    cs_vfloat far[4];
    cs_blend_four(table, corner[0], corner[1], down, found);
    cs_blend_four(table, corner[2], corner[3], down, far);
    for (int i = 0; i < 4; i++)
        found[i] += across * (far[i] - found[i]);
#endif
}

#endif
