/* Distributions of one lens coordinate: their mass, its integral and its inverse. Shared.
 *
 * Uniform on [-1/2, 1/2]; the marginal of the disk of area 1; or tabulated, where a row has what
 * holds from the start of a segment on: the density is linear in a segment of a polygon and
 * constant in a texel of an image. */
#ifndef CS_PROFILE_H
#define CS_PROFILE_H

#include "disk.h"
#include "packet.h"
#include "shared.h"

/* The table of a cs_optics. */
typedef CS_GLOBAL const f32 *cs_optics_table;

/* Columns of a row; the last row of a profile ends it. */
enum {
    CS_ROW_START = 0,    /* lens coordinate */
    CS_ROW_MASS = 1,     /* left of the start */
    CS_ROW_INTEGRAL = 2, /* of the mass, from the left end to the start */
    CS_ROW_DENSITY = 3,  /* at the start; of a polygon: the chord's length, as its area is 1 */
    CS_ROW_SLOPE = 4,    /* of the density */
    CS_ROW_LOW = 5,      /* polygon: the chord's lower end */
    CS_ROW_LOW_SLOPE = 6
};

typedef enum cs_profile_kind {
    CS_PROFILE_UNIFORM,
    CS_PROFILE_DISK,
    CS_PROFILE_POLYGON,
    CS_PROFILE_IMAGE
} cs_profile_kind;

typedef struct cs_profile {
    cs_profile_kind kind;
    f32 low; /* its ends */
    f32 high;
    f32 deviation;
    cs_optics_table rows; /* the first of all */
    u32 segments;
    f32 inverse_width; /* of a texel */
    vuint first;       /* the profile's first row; 0 but for the columns of an image */
} cs_profile;

CS_INLINED cs_profile cs_profile_of(cs_profile_kind kind, f32 reach, f32 deviation,
                                    cs_optics_table table)
{
    cs_profile profile;
    profile.kind = kind;
    profile.low = -reach;
    profile.high = reach;
    profile.deviation = deviation;
    profile.rows = table + CS_FILTER_STEPS;
    profile.segments = 1u;
    profile.inverse_width = 1.0f;
    profile.first = (vuint)(0u);
    return profile;
}

/* The profile of u of an aperture. */
CS_INLINED cs_profile cs_profile_across(const cs_optics *optics, cs_optics_table table)
{
    cs_profile_kind kind = optics->aperture == CS_APERTURE_SQUARE    ? CS_PROFILE_UNIFORM
                           : optics->aperture == CS_APERTURE_DISK    ? CS_PROFILE_DISK
                           : optics->aperture == CS_APERTURE_POLYGON ? CS_PROFILE_POLYGON
                                                                     : CS_PROFILE_IMAGE;
    cs_profile profile = cs_profile_of(kind, optics->reach[0], optics->deviation[0], table);
    profile.segments = optics->segments[0];
    if (kind == CS_PROFILE_IMAGE)
        profile.inverse_width = 0.5f * (f32)profile.segments / optics->reach[0];
    if (kind != CS_PROFILE_POLYGON) return profile;
    profile.low = profile.rows[CS_ROW_START];
    profile.high = profile.rows[profile.segments * (u32)CS_PROFILE_COLUMNS + (u32)CS_ROW_START];
    return profile;
}

typedef struct cs_profile_row {
    vfloat start;
    vfloat mass;
    vfloat integral;
    vfloat density;
    vfloat slope;
    vfloat low;
    vfloat low_slope;
} cs_profile_row;

/* The last row whose entry in `column` is not above `key`. Polygons have few rows: looking at all
 * of them needs no gathering. */
CS_INLINED cs_profile_row cs_profile_pick(const cs_profile *profile, u32 column, vfloat key)
{
    cs_optics_table row = profile->rows;
    cs_profile_row picked;
    picked.start = (vfloat)(row[CS_ROW_START]);
    picked.mass = (vfloat)(row[CS_ROW_MASS]);
    picked.integral = (vfloat)(row[CS_ROW_INTEGRAL]);
    picked.density = (vfloat)(row[CS_ROW_DENSITY]);
    picked.slope = (vfloat)(row[CS_ROW_SLOPE]);
    picked.low = (vfloat)(row[CS_ROW_LOW]);
    picked.low_slope = (vfloat)(row[CS_ROW_LOW_SLOPE]);
    for (u32 i = 1u; i < profile->segments; i++) {
        row += CS_PROFILE_COLUMNS;
        vint right = key >= row[column];
        picked.start = right ? (vfloat)(row[CS_ROW_START]) : picked.start;
        picked.mass = right ? (vfloat)(row[CS_ROW_MASS]) : picked.mass;
        picked.integral = right ? (vfloat)(row[CS_ROW_INTEGRAL]) : picked.integral;
        picked.density = right ? (vfloat)(row[CS_ROW_DENSITY]) : picked.density;
        picked.slope = right ? (vfloat)(row[CS_ROW_SLOPE]) : picked.slope;
        picked.low = right ? (vfloat)(row[CS_ROW_LOW]) : picked.low;
        picked.low_slope = right ? (vfloat)(row[CS_ROW_LOW_SLOPE]) : picked.low_slope;
    }
    return picked;
}

/* Entries of different rows. */
CS_INLINED vfloat cs_profile_gather(const cs_profile *profile, vuint row, u32 column)
{
    vuint place = (profile->first + row) * (u32)CS_PROFILE_COLUMNS + column;
#if CS_PACKET == 1
    return profile->rows[place];
#else
    cs_uint_lanes from;
    cs_float_lanes value;
    from.all = place;
    for (u32 lane = 0u; lane < (u32)CS_PACKET; lane++)
        value.lane[lane] = profile->rows[from.lane[lane]];
    return value.all;
#endif
}

/* Number of the texel at u. */
static inline vuint cs_profile_texel(const cs_profile *profile, vfloat u)
{
    f32 last = (f32)profile->segments - 0.5f;
    return cs_to_vuint(
        cs_clamp((u - profile->low) * profile->inverse_width, (vfloat)(0.0f), (vfloat)(last)));
}

/* The last texel with no more than `mass` left of it, by bisection. */
static inline vuint cs_profile_texel_at_mass(const cs_profile *profile, vfloat mass)
{
    u32 step = 1u;
    while (2u * step < profile->segments)
        step *= 2u;
    vuint texel = (vuint)(0u);
    for (; step > 0u; step /= 2u) {
        vuint next = texel + step;
        next = next < profile->segments ? next : (vuint)(profile->segments - 1u);
        texel = cs_profile_gather(profile, next, CS_ROW_MASS) <= mass ? next : texel;
    }
    return texel;
}

/* The row of an image's texel: its density does not change. */
CS_INLINED cs_profile_row cs_profile_texel_row(const cs_profile *profile, vuint texel)
{
    cs_profile_row row;
#if CS_PACKET == 1
    cs_optics_table from = profile->rows + (profile->first + texel) * (u32)CS_PROFILE_COLUMNS;
    row.start = from[CS_ROW_START];
    row.mass = from[CS_ROW_MASS];
    row.integral = from[CS_ROW_INTEGRAL];
    row.density = from[CS_ROW_DENSITY];
#else
    cs_uint_lanes place;
    cs_float_lanes start, mass, integral, density;
    place.all = (profile->first + texel) * (u32)CS_PROFILE_COLUMNS;
    for (u32 lane = 0u; lane < (u32)CS_PACKET; lane++) {
        float4 four = vload4(0, profile->rows + place.lane[lane]); /* the first four columns */
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
    row.slope = (vfloat)(0.0f);
    row.low = (vfloat)(0.0f);
    row.low_slope = (vfloat)(0.0f);
    return row;
}

typedef struct cs_profile_mass {
    vfloat density;  /* of U at u */
    vfloat below;    /* P(U < u) */
    vfloat integral; /* of it, from the left */
} cs_profile_mass;

CS_INLINED cs_profile_mass cs_profile_tabulated(const cs_profile *profile, vfloat u)
{
    vfloat inside = cs_clamp(u, (vfloat)(profile->low), (vfloat)(profile->high));
    cs_profile_row row = profile->kind == CS_PROFILE_POLYGON
                             ? cs_profile_pick(profile, CS_ROW_START, inside)
                             : cs_profile_texel_row(profile, cs_profile_texel(profile, inside));
    vfloat step = inside - row.start;
    vfloat beyond = u - inside;
    cs_profile_mass mass;
    mass.density = beyond == 0.0f ? row.density + row.slope * step : (vfloat)(0.0f);
    mass.below = row.mass + step * (row.density + 0.5f * row.slope * step);
    mass.integral =
        row.integral + cs_max(beyond, (vfloat)(0.0f)) +
        step * (row.mass + step * (0.5f * row.density + (1.0f / 6.0f) * row.slope * step));
    return mass;
}

CS_INLINED cs_profile_mass cs_profile_at(const cs_profile *profile, vfloat u)
{
    cs_profile_mass mass;
    if (profile->kind == CS_PROFILE_UNIFORM) {
        mass.below = cs_clamp(u + 0.5f, (vfloat)(0.0f), (vfloat)(1.0f));
        mass.integral = 0.5f * mass.below * mass.below + cs_max(u - 0.5f, (vfloat)(0.0f));
        mass.density = cs_abs(u) < 0.5f ? (vfloat)(1.0f) : (vfloat)(0.0f);
        return mass;
    }
    if (profile->kind == CS_PROFILE_DISK) {
        cs_half_circle at = cs_half_circle_at(u);
        mass.below = cs_half_circle_cdf(at, u);
        mass.integral = cs_max(u, (vfloat)(0.0f)) + cs_half_circle_excess(at);
        mass.density = 2.0f * CS_DISK_RADIUS * at.height;
        return mass;
    }
    return cs_profile_tabulated(profile, u);
}

/* The u with P(U < u) = mass. */
CS_INLINED vfloat cs_profile_quantile(const cs_profile *profile, vfloat mass)
{
    if (profile->kind == CS_PROFILE_UNIFORM) return mass - 0.5f;
    if (profile->kind == CS_PROFILE_DISK) return cs_disk_quantile(mass);
    cs_profile_row row =
        profile->kind == CS_PROFILE_POLYGON
            ? cs_profile_pick(profile, CS_ROW_MASS, mass)
            : cs_profile_texel_row(profile, cs_profile_texel_at_mass(profile, mass));
    vfloat rest = mass - row.mass;
    vfloat square = row.density * row.density + 2.0f * row.slope * rest;
    vfloat root = cs_sqrt(cs_max(square, (vfloat)(0.0f)));
    vfloat step = 2.0f * rest / cs_max(row.density + root, (vfloat)(1e-12f));
    return cs_clamp(row.start + step, (vfloat)(profile->low), (vfloat)(profile->high));
}

/* What of the aperture lies at u: v = centre + length * (a variable of `profile`). */
typedef struct cs_chord {
    cs_profile profile;
    vfloat centre;
    vfloat length;
} cs_chord;

static inline cs_chord cs_chord_at(const cs_optics *optics, cs_optics_table table,
                                   const cs_profile *across, vfloat u)
{
    cs_chord chord;
    chord.profile = cs_profile_of(CS_PROFILE_UNIFORM, 0.5f, 0.288675135f, table);
    chord.centre = (vfloat)(0.0f);
    chord.length = (vfloat)(1.0f);
    if (optics->aperture == CS_APERTURE_DISK) {
        vfloat square = (CS_DISK_RADIUS - u) * (CS_DISK_RADIUS + u);
        chord.length = 2.0f * cs_sqrt(cs_max(square, (vfloat)(0.0f)));
    } else if (optics->aperture == CS_APERTURE_POLYGON) {
        cs_profile_row row = cs_profile_pick(across, CS_ROW_START, u);
        vfloat step = u - row.start;
        chord.length = cs_max(row.density + step * row.slope, (vfloat)(0.0f));
        chord.centre = row.low + step * row.low_slope + 0.5f * chord.length;
    } else if (optics->aperture == CS_APERTURE_IMAGE) {
        cs_profile *profile = &chord.profile;
        *profile = cs_profile_of(CS_PROFILE_IMAGE, optics->reach[1], optics->deviation[1], table);
        profile->segments = optics->segments[1];
        profile->inverse_width = 0.5f * (f32)profile->segments / optics->reach[1];
        profile->first =
            optics->segments[0] + 1u + cs_profile_texel(across, u) * (optics->segments[1] + 1u);
    }
    return chord;
}

#endif
