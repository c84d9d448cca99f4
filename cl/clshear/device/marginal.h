/* Marginal distributions of one lens coordinate: density, cumulative distribution, its integral,
 * and its inverse.
 *
 * There are four kinds: uniform on [-1/2, 1/2]; the marginal of the disk of area 1; and two that
 * are tabulated, where the density is linear in each segment (polygon) or constant in each texel
 * (image).
 *
 * Layout of a lens table, which clshear_lens_table makes:
 * - CS_FILTER_STEPS floats: the filter's density, per pixel, on each of its filter_steps steps.
 * - For a polygon, segments[0] + 1 rows of CS_MARGINAL_COLUMNS floats: the marginal of u and the
 *   chords along v. Then segments[1] + 1 rows: the same with u and v exchanged.
 * - For an image, segments[0] + 1 such rows for the marginal of u, then for each of the segments[0]
 *   columns of texels segments[1] + 1 rows for the distribution of v in that column.
 * A row tells of the segment that begins at it; the last row of a marginal is its right end. */
#ifndef CLSHEAR_DEVICE_MARGINAL_H
#define CLSHEAR_DEVICE_MARGINAL_H

#include "camera.h"
#include "disk.h"
#include "packet.h"

#include "fp_contract_off.h"

/* A lens table. Disk and square in closed form (has_closed_form) do not read it: any pointer will
 * do.
 */
typedef CS_GLOBAL const cs_f32 *cs_optics_table;

/* Columns of a row. */
enum {
    CS_MARGINAL_START = 0,    /* lens coordinate at which the segment begins */
    CS_MARGINAL_CDF = 1,      /* probability left of the start */
    CS_MARGINAL_INTEGRAL = 2, /* integral of the cumulative distribution up to the start */
    CS_MARGINAL_DENSITY = 3,  /* density at the start; for a polygon also the chord's length */
    CS_MARGINAL_SLOPE = 4,    /* derivative of the density; for a polygon only */
    CS_MARGINAL_LOW = 5,      /* lower end of the chord at the start; for a polygon only */
    CS_MARGINAL_LOW_SLOPE = 6 /* derivative of the lower end; for a polygon only */
};

/* A marginal distribution. */
typedef struct cs_marginal {
    cs_marginal_kind kind; /* how the others are read */
    cs_f32 low;            /* left end, lens units */
    cs_f32 high;           /* right end, lens units */
    cs_f32 deviation;      /* standard deviation, lens units */
    cs_optics_table rows;  /* first row of the lens table */
    cs_u32 segments;       /* number of segments or texels */
    cs_f32 inverse_width;  /* 1 / width of a texel; for an image only */
    cs_vuint first;        /* number of the marginal's first row */
} cs_marginal;

/* A marginal of `kind` from -reach to reach. */
CS_INLINED cs_marginal cs_marginal_of(cs_marginal_kind kind, cs_f32 reach, cs_f32 deviation,
                                      cs_optics_table table)
{
    cs_marginal marginal;
    marginal.kind = kind;
    marginal.low = -reach;
    marginal.high = reach;
    marginal.deviation = deviation;
    marginal.rows = table + CS_FILTER_STEPS;
    marginal.segments = 1u;
    marginal.inverse_width = 1.0f;
    marginal.first = (cs_vuint)(0u);
    return marginal;
}

/* The marginal of u of an aperture. `table` is the lens table of `optics`. */
CS_INLINED cs_marginal cs_marginal_across(const cs_optics *optics, cs_optics_table table)
{
    cs_marginal_kind kind = (cs_marginal_kind)optics->marginal;
    cs_marginal marginal = cs_marginal_of(kind, optics->half_width[0], optics->deviation[0], table);
    marginal.segments = optics->segments[0];
    if (kind == CS_MARGINAL_IMAGE)
        marginal.inverse_width = 0.5f * (cs_f32)marginal.segments / optics->half_width[0];
    if (kind != CS_MARGINAL_POLYGON) return marginal;
    marginal.low = marginal.rows[CS_MARGINAL_START];
    marginal.high =
        marginal.rows[marginal.segments * (cs_u32)CS_MARGINAL_COLUMNS + (cs_u32)CS_MARGINAL_START];
    return marginal;
}

/* A row of the table, a lane for each sample. Members are the columns above. */
typedef struct cs_marginal_row {
    cs_vfloat start;
    cs_vfloat mass;
    cs_vfloat integral;
    cs_vfloat density;
    cs_vfloat slope;
    cs_vfloat low;
    cs_vfloat low_slope;
} cs_marginal_row;

/* The last row whose entry in column `column` is not above `key`. It looks at all rows, which for a
 * polygon are few, and so needs no gathering. */
CS_INLINED cs_marginal_row cs_marginal_pick(const cs_marginal *marginal, cs_u32 column,
                                            cs_vfloat key)
{
    cs_optics_table row = marginal->rows;
    cs_marginal_row picked;
    picked.start = (cs_vfloat)(row[CS_MARGINAL_START]);
    picked.mass = (cs_vfloat)(row[CS_MARGINAL_CDF]);
    picked.integral = (cs_vfloat)(row[CS_MARGINAL_INTEGRAL]);
    picked.density = (cs_vfloat)(row[CS_MARGINAL_DENSITY]);
    picked.slope = (cs_vfloat)(row[CS_MARGINAL_SLOPE]);
    picked.low = (cs_vfloat)(row[CS_MARGINAL_LOW]);
    picked.low_slope = (cs_vfloat)(row[CS_MARGINAL_LOW_SLOPE]);
    for (cs_u32 i = 1u; i < marginal->segments; i++) {
        row += CS_MARGINAL_COLUMNS;
        cs_vint right = key >= row[column];
        picked.start = right ? (cs_vfloat)(row[CS_MARGINAL_START]) : picked.start;
        picked.mass = right ? (cs_vfloat)(row[CS_MARGINAL_CDF]) : picked.mass;
        picked.integral = right ? (cs_vfloat)(row[CS_MARGINAL_INTEGRAL]) : picked.integral;
        picked.density = right ? (cs_vfloat)(row[CS_MARGINAL_DENSITY]) : picked.density;
        picked.slope = right ? (cs_vfloat)(row[CS_MARGINAL_SLOPE]) : picked.slope;
        picked.low = right ? (cs_vfloat)(row[CS_MARGINAL_LOW]) : picked.low;
        picked.low_slope = right ? (cs_vfloat)(row[CS_MARGINAL_LOW_SLOPE]) : picked.low_slope;
    }
    return picked;
}

/* Entries in column `column` of rows `row`, 0 to segments. */
CS_INLINED cs_vfloat cs_marginal_gather(const cs_marginal *marginal, cs_vuint row, cs_u32 column)
{
    cs_vuint place = (marginal->first + row) * (cs_u32)CS_MARGINAL_COLUMNS + column;
#if CS_PACKET == 1
    return marginal->rows[place];
#else
    cs_uint_lanes from;
    cs_float_lanes value;
    from.all = place;
    for (cs_u32 lane = 0u; lane < (cs_u32)CS_PACKET; lane++)
        value.lane[lane] = marginal->rows[from.lane[lane]];
    return value.all;
#endif
}

/* Number of the texel at u; beyond the ends, of the outermost one. */
static inline cs_vuint cs_marginal_texel(const cs_marginal *marginal, cs_vfloat u)
{
    cs_f32 last = (cs_f32)marginal->segments - 0.5f;
    return cs_to_vuint(cs_clamp((u - marginal->low) * marginal->inverse_width, (cs_vfloat)(0.0f),
                                (cs_vfloat)(last)));
}

/* The last texel that has at most the probability `mass`, in [0, 1], left of it, by bisection. */
static inline cs_vuint cs_marginal_texel_at_mass(const cs_marginal *marginal, cs_vfloat mass)
{
    cs_u32 step = 1u;
    while (2u * step < marginal->segments)
        step *= 2u;
    cs_vuint texel = (cs_vuint)(0u);
    for (; step > 0u; step /= 2u) {
        cs_vuint next = texel + step;
        next = next < marginal->segments ? next : (cs_vuint)(marginal->segments - 1u);
        texel = cs_marginal_gather(marginal, next, CS_MARGINAL_CDF) <= mass ? next : texel;
    }
    return texel;
}

/* The row of texel `texel` of an image. */
CS_INLINED cs_marginal_row cs_marginal_texel_row(const cs_marginal *marginal, cs_vuint texel)
{
    cs_marginal_row row;
#if CS_PACKET == 1
    cs_optics_table from = marginal->rows + (marginal->first + texel) * (cs_u32)CS_MARGINAL_COLUMNS;
    row.start = from[CS_MARGINAL_START];
    row.mass = from[CS_MARGINAL_CDF];
    row.integral = from[CS_MARGINAL_INTEGRAL];
    row.density = from[CS_MARGINAL_DENSITY];
#else
    cs_uint_lanes place;
    cs_float_lanes start, mass, integral, density;
    place.all = (marginal->first + texel) * (cs_u32)CS_MARGINAL_COLUMNS;
    for (cs_u32 lane = 0u; lane < (cs_u32)CS_PACKET; lane++) {
        float4 four = vload4(0, marginal->rows + place.lane[lane]); /* the first four columns */
        start.lane[lane] = four.x;
        mass.lane[lane] = four.y;
        integral.lane[lane] = four.z;
        density.lane[lane] = four.w;
    }
    row.start = start.all;
    row.mass = mass.all;
    row.integral = integral.all;
    row.density = density.all;
#endif
    row.slope = (cs_vfloat)(0.0f);
    row.low = (cs_vfloat)(0.0f);
    row.low_slope = (cs_vfloat)(0.0f);
    return row;
}

/* Density, mass and integral of a marginal at a place u. */
typedef struct cs_marginal_value {
    cs_vfloat density;  /* density of U at u */
    cs_vfloat below;    /* P(U < u) */
    cs_vfloat integral; /* integral of P(U < u) from the left end to u */
} cs_marginal_value;

/* The values at any u of a marginal that is tabulated. */
CS_INLINED cs_marginal_value cs_marginal_tabulated(const cs_marginal *marginal, cs_vfloat u)
{
    cs_vfloat inside = cs_clamp(u, (cs_vfloat)(marginal->low), (cs_vfloat)(marginal->high));
    cs_marginal_row row =
        marginal->kind == CS_MARGINAL_POLYGON
            ? cs_marginal_pick(marginal, CS_MARGINAL_START, inside)
            : cs_marginal_texel_row(marginal, cs_marginal_texel(marginal, inside));
    cs_vfloat step = inside - row.start;
    cs_vfloat beyond = u - inside;
    cs_marginal_value mass;
    mass.density = beyond == 0.0f ? row.density + row.slope * step : (cs_vfloat)(0.0f);
    mass.below = row.mass + step * (row.density + 0.5f * row.slope * step);
    mass.integral =
        row.integral + cs_max(beyond, (cs_vfloat)(0.0f)) +
        step * (row.mass + step * (0.5f * row.density + (1.0f / 6.0f) * row.slope * step));
    return mass;
}

/* The values at any u. */
CS_INLINED cs_marginal_value cs_marginal_at(const cs_marginal *marginal, cs_vfloat u)
{
    cs_marginal_value mass;
    if (marginal->kind == CS_MARGINAL_UNIFORM) {
        mass.below = cs_clamp(u + 0.5f, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
        mass.integral = 0.5f * mass.below * mass.below + cs_max(u - 0.5f, (cs_vfloat)(0.0f));
        mass.density = cs_abs(u) < 0.5f ? (cs_vfloat)(1.0f) : (cs_vfloat)(0.0f);
        return mass;
    }
    if (marginal->kind == CS_MARGINAL_DISK) {
        cs_half_circle at = cs_half_circle_at(u);
        mass.below = cs_half_circle_cdf(at, u);
        mass.integral = cs_max(u, (cs_vfloat)(0.0f)) + cs_half_circle_excess(at);
        mass.density = 2.0f * CS_DISK_RADIUS * at.height;
        return mass;
    }
    return cs_marginal_tabulated(marginal, u);
}

/* The u with P(U < u) = mass, for mass in [0, 1]. */
CS_INLINED cs_vfloat cs_marginal_quantile(const cs_marginal *marginal, cs_vfloat mass)
{
    if (marginal->kind == CS_MARGINAL_UNIFORM) return mass - 0.5f;
    if (marginal->kind == CS_MARGINAL_DISK) return cs_disk_quantile(mass);
    cs_marginal_row row =
        marginal->kind == CS_MARGINAL_POLYGON
            ? cs_marginal_pick(marginal, CS_MARGINAL_CDF, mass)
            : cs_marginal_texel_row(marginal, cs_marginal_texel_at_mass(marginal, mass));
    cs_vfloat rest = mass - row.mass;
    cs_vfloat square = row.density * row.density + 2.0f * row.slope * rest;
    cs_vfloat root = cs_sqrt(cs_max(square, (cs_vfloat)(0.0f)));
    cs_vfloat step = 2.0f * rest / cs_max(row.density + root, (cs_vfloat)(1e-12f));
    return cs_clamp(row.start + step, (cs_vfloat)(marginal->low), (cs_vfloat)(marginal->high));
}

/* The part of the aperture at one u: there v = centre + length * V. */
typedef struct cs_chord {
    cs_marginal marginal; /* distribution of V */
    cs_vfloat centre;     /* lens units */
    cs_vfloat length;     /* 0 or more; 1 for an image, whose V is v itself */
} cs_chord;

/* The chord along v at u. `across` must be cs_marginal_across(optics, table). */
static inline cs_chord cs_chord_at(const cs_optics *optics, cs_optics_table table,
                                   const cs_marginal *across, cs_vfloat u)
{
    cs_chord chord;
    chord.marginal = cs_marginal_of(CS_MARGINAL_UNIFORM, 0.5f, 0.288675135f, table);
    chord.centre = (cs_vfloat)(0.0f);
    chord.length = (cs_vfloat)(1.0f);
    if (optics->marginal == CS_MARGINAL_DISK) {
        cs_vfloat square = (CS_DISK_RADIUS - u) * (CS_DISK_RADIUS + u);
        chord.length = 2.0f * cs_sqrt(cs_max(square, (cs_vfloat)(0.0f)));
    } else if (optics->marginal == CS_MARGINAL_POLYGON) {
        cs_marginal_row row = cs_marginal_pick(across, CS_MARGINAL_START, u);
        cs_vfloat step = u - row.start;
        chord.length = cs_max(row.density + step * row.slope, (cs_vfloat)(0.0f));
        chord.centre = row.low + step * row.low_slope + 0.5f * chord.length;
    } else if (optics->marginal == CS_MARGINAL_IMAGE) {
        cs_marginal *marginal = &chord.marginal;
        *marginal =
            cs_marginal_of(CS_MARGINAL_IMAGE, optics->half_width[1], optics->deviation[1], table);
        marginal->segments = optics->segments[1];
        marginal->inverse_width = 0.5f * (cs_f32)marginal->segments / optics->half_width[1];
        marginal->first =
            optics->segments[0] + 1u + cs_marginal_texel(across, u) * (optics->segments[1] + 1u);
    }
    return chord;
}

/* A chord of the aperture along u. */
typedef struct cs_span {
    cs_vfloat centre; /* lens units */
    cs_vfloat length; /* lens units, 0 or more */
} cs_span;

/* The chord along u at v, of a disk or a polygon. */
static inline cs_span cs_span_at(const cs_optics *optics, cs_optics_table table, cs_vfloat v)
{
    cs_span span;
    span.centre = (cs_vfloat)(0.0f);
    if (optics->marginal == CS_MARGINAL_DISK) {
        cs_vfloat square = (CS_DISK_RADIUS - v) * (CS_DISK_RADIUS + v);
        span.length = 2.0f * cs_sqrt(cs_max(square, (cs_vfloat)(0.0f)));
        return span;
    }
    cs_marginal down = cs_marginal_of(CS_MARGINAL_POLYGON, 0.0f, 0.0f, table);
    down.rows += (optics->segments[0] + 1u) * (cs_u32)CS_MARGINAL_COLUMNS;
    down.segments = optics->segments[1];
    cs_marginal_row row = cs_marginal_pick(&down, CS_MARGINAL_START, v);
    cs_vfloat step = v - row.start;
    span.length = cs_max(row.density + step * row.slope, (cs_vfloat)(0.0f));
    span.centre = row.low + step * row.low_slope + 0.5f * span.length;
    return span;
}

/* The point of the aperture that a pair (a, b) in [0, 1) stands for. */
static inline void cs_lens_point(cs_vfloat a, cs_vfloat b, const cs_optics *optics,
                                 cs_optics_table table, cs_vfloat *u, cs_vfloat *v)
{
    *u = a - 0.5f;
    *v = b - 0.5f;
    if (optics->marginal == CS_MARGINAL_UNIFORM) return;
    if (optics->marginal == CS_MARGINAL_DISK) {
        cs_disk_from_square(u, v);
        return;
    }
    cs_marginal across = cs_marginal_across(optics, table);
    *u = cs_marginal_quantile(&across, a);
    cs_chord chord = cs_chord_at(optics, table, &across, *u);
    *v = chord.centre + chord.length * cs_marginal_quantile(&chord.marginal, b);
}

#include "fp_contract_restore.h"

#endif
