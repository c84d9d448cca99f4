/* Microfacets after Trowbridge and Reitz (GGX) on one side of a surface, and what they reflect in
 * all. Shared.
 *
 * Walter et al. 2007 (distribution), Heitz 2014 (height-correlated shadowing, equation 99), Dupuy &
 * Benyoub 2023 (visible normals by spherical caps), Kulla & Conty 2017 (light that meets several
 * facets). Directions are unit vectors.
 *
 * CS_FACETS_OF_MITSUBA, which only scripts/agreement defines, takes shadowing and masking apart and
 * leaves out what meets several facets, as Mitsuba 3 does. */
#ifndef CS_BSDF_MICROFACET_H
#define CS_BSDF_MICROFACET_H

#include "clshear/device/sampler/grid.h"
#include "kernels/bsdf/value.h"
#include "kernels/lanes.h"
#include "kernels/trigonometry.h"

#if CS_HAS(MATERIALS)

/* Below, the distribution would leave the range of floats, and no picture shows a difference. */
#define CS_LEAST_ROUGHNESS 0.03f

static inline cs_vfloat cs_inner(const cs_vfloat *a, const cs_vfloat *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void cs_normalised(const cs_vfloat *vector, cs_vfloat *unit)
{
    cs_vfloat scale = 1.0f / cs_sqrt(cs_max(cs_inner(vector, vector), (cs_vfloat)(1e-30f)));
    for (int i = 0; i < 3; i++)
        unit[i] = vector[i] * scale;
}

/* Width of the distribution, from the roughness that users know (Burley 2012). */
static inline cs_vfloat cs_facet_width(cs_vfloat roughness)
{
    cs_vfloat used = cs_max(roughness, (cs_vfloat)(CS_LEAST_ROUGHNESS));
    return used * used;
}

/* Density of facet normals. The sine comes from a cross product: one less the cosine would have no
 * digits left. */
static inline cs_vfloat cs_facet_distribution(const cs_vfloat *normal, const cs_vfloat *half_way,
                                              cs_vfloat width)
{
    cs_vfloat cosine = cs_inner(normal, half_way), square = (cs_vfloat)(0.0f);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        cs_vfloat across = normal[j] * half_way[k] - normal[k] * half_way[j];
        square += across * across;
    }
    cs_vfloat slope = square / (width * width) + cosine * cosine;
    return 1.0f / (CS_PI * width * width * slope * slope);
}

/* cosine * sqrt(1 + tan^2 width^2): twice the cosine by this and itself is the part of facets seen.
 */
static inline cs_vfloat cs_facet_slant(cs_vfloat cosine, cs_vfloat width)
{
    return cs_sqrt(width * width + (1.0f - width * width) * cosine * cosine);
}

/* Shadowing and masking of one height by 4 times both cosines; for Mitsuba, as if they had nothing
 * to do with each other (Walter et al. 2007, equation 23). */
static inline cs_vfloat cs_facet_visibility(cs_vfloat cos_out, cs_vfloat cos_in, cs_vfloat width)
{
#ifdef CS_FACETS_OF_MITSUBA
    return 1.0f /
           ((cos_out + cs_facet_slant(cos_out, width)) * (cos_in + cs_facet_slant(cos_in, width)));
#else
    return 0.5f /
           (cos_in * cs_facet_slant(cos_out, width) + cos_out * cs_facet_slant(cos_in, width));
#endif
}

/* Density of `in` when it mirrors `out` at a visible facet. */
static inline cs_vfloat cs_facet_density(const cs_vfloat *normal, const cs_vfloat *half_way,
                                         cs_vfloat cos_out, cs_vfloat width)
{
    return cs_facet_distribution(normal, half_way, width) * 0.5f /
           (cos_out + cs_facet_slant(cos_out, width));
}

/* A facet's normal that `out` sees, in the frame of which the surface's normal is the last axis. */
static inline void cs_visible_facet(const cs_vfloat *out, cs_vfloat width, cs_pair pair,
                                    cs_vfloat *facet)
{
    cs_vfloat stretched[3] = {width * out[0], width * out[1], out[2]}, seen[3], cap[3];
    cs_normalised(stretched, seen);
    cs_vfloat up = (1.0f - pair.y) * (1.0f + seen[2]) - seen[2];
    cs_vfloat outward = cs_sqrt(cs_clamp(1.0f - up * up, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f)));
    cs_vfloat angle = 2.0f * CS_PI * pair.x;
    cap[0] = (outward * cs_cos(angle) + seen[0]) * width;
    cap[1] = (outward * cs_sin(angle) + seen[1]) * width;
    cap[2] = cs_max(up + seen[2], (cs_vfloat)(1e-7f));
    cs_normalised(cap, facet);
}

/* A facet's normal that `out` sees around the surface's normal; `cosine` is between the two. */
static inline void cs_draw_facet(const cs_vfloat *normal, const cs_vfloat *out, cs_vfloat cosine,
                                 cs_vfloat width, cs_pair pair, cs_vfloat *half_way)
{
    cs_vfloat tangent[3], other[3], facet[3];
    const cs_vfloat one[3] = {(cs_vfloat)(1.0f), (cs_vfloat)(0.0f), (cs_vfloat)(0.0f)};
    const cs_vfloat two[3] = {(cs_vfloat)(0.0f), (cs_vfloat)(1.0f), (cs_vfloat)(0.0f)};
    cs_from_local(normal, one, tangent);
    cs_from_local(normal, two, other);
    cs_vfloat seen_out[3] = {cs_inner(out, tangent), cs_inner(out, other), cosine};
    cs_visible_facet(seen_out, width, pair, facet);
    cs_from_local(normal, facet, half_way);
}

/* (1 - cosine)^5 (Schlick 1994). */
static inline cs_vfloat cs_schlick(cs_vfloat cosine)
{
    cs_vfloat rest = cs_clamp(1.0f - cosine, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
    cs_vfloat square = rest * rest;
    return square * square * rest;
}

/* ------------------------------------------------------------------------------------------------
 * The table of albedos: for each roughness, planes of CS_ALBEDO_COSINES values from cosine 0 to 1,
 * then their averages, 2 int E(c) c dc.
 * --------------------------------------------------------------------------------------------- */

enum {
    CS_ALBEDO_COSINES = 64,
    CS_ALBEDO_ROUGHNESSES = 32,
    CS_ALBEDO_ALL = 0,     /* of facets that are perfect mirrors, met once */
    CS_ALBEDO_SCHLICK = 1, /* with cs_schlick as reflectance */
    CS_ALBEDO_SHEEN = 2,   /* of white sheen */
    CS_ALBEDO_PLANES = 3,
    CS_ALBEDO_ROW = CS_ALBEDO_PLANES * (CS_ALBEDO_COSINES + 1), /* of a roughness */
    CS_ALBEDO_FLOATS = CS_ALBEDO_ROW * CS_ALBEDO_ROUGHNESSES
};

typedef struct cs_albedo {
    cs_vfloat plane[CS_ALBEDO_PLANES];
} cs_albedo;

/* Linear between the roughnesses and, where `cosine` is not negative, between cosines; else the
 * averages. */
static inline cs_albedo cs_albedo_at(CS_GLOBAL const cs_f32 *table, cs_vfloat cosine,
                                     cs_vfloat roughness)
{
    cs_float_each c, r, found[CS_ALBEDO_PLANES];
    cs_albedo albedo;
    c.all = cosine;
    r.all = cs_clamp(roughness, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
    for (int lane = 0; lane < CS_PACKET; lane++) {
        cs_f32 across = CS_LANE(r) * (cs_f32)(CS_ALBEDO_ROUGHNESSES - 1);
        cs_u32 row = (cs_u32)across;
        row = row > (cs_u32)(CS_ALBEDO_ROUGHNESSES - 2) ? (cs_u32)(CS_ALBEDO_ROUGHNESSES - 2) : row;
        across -= (cs_f32)row;
        cs_f32 place = CS_LANE(c) * (cs_f32)(CS_ALBEDO_COSINES - 1);
        cs_u32 cell = place > 0.0f ? (cs_u32)place : 0u;
        cell = cell > (cs_u32)(CS_ALBEDO_COSINES - 2) ? (cs_u32)(CS_ALBEDO_COSINES - 2) : cell;
        cs_f32 along = place - (cs_f32)cell;
        if (CS_LANE(c) < 0.0f) {
            cell = (cs_u32)(CS_ALBEDO_COSINES - 1);
            along = 1.0f;
        }
        CS_GLOBAL const cs_f32 *low = table + row * (cs_u32)CS_ALBEDO_ROW + cell;
        for (cs_u32 p = 0u; p < (cs_u32)CS_ALBEDO_PLANES; p++) {
            CS_GLOBAL const cs_f32 *a = low + p * (cs_u32)(CS_ALBEDO_COSINES + 1);
            CS_GLOBAL const cs_f32 *b = a + CS_ALBEDO_ROW;
            cs_f32 lower = a[0] + along * (a[1] - a[0]), upper = b[0] + along * (b[1] - b[0]);
            CS_LANE(found[p]) = lower + across * (upper - lower);
        }
    }
    for (int p = 0; p < CS_ALBEDO_PLANES; p++)
        albedo.plane[p] = found[p].all;
    return albedo;
}

/* Part of the light that no single facet lets go which the others do, where a facet reflects `f0`
 * of what it meets head-on and `f90` at grazing angles: Kulla & Conty 2017, with the mean of
 * Schlick's reflectance. */
static inline cs_vfloat cs_repeated_part(cs_vfloat f0, cs_vfloat f90, cs_vfloat average_albedo)
{
    cs_vfloat mean = f0 + (f90 - f0) * (1.0f / 21.0f);
    return mean * mean * average_albedo / (1.0f - mean * (1.0f - average_albedo));
}

/* Sheen of fibres that stand up (Estevez & Kulla 2017, equation 2; visibility by Neubelt & Pettineo
 * 2013, as KHR_materials_sheen allows). */
static inline cs_vfloat cs_sheen(cs_vfloat cos_half, cs_vfloat cos_out, cs_vfloat cos_in,
                                 cs_vfloat roughness)
{
    cs_vfloat used = cs_max(roughness, (cs_vfloat)(0.1f));
    cs_vfloat power = 1.0f / (used * used);
    cs_vfloat square = cs_clamp(1.0f - cos_half * cos_half, (cs_vfloat)(1e-8f), (cs_vfloat)(1.0f));
    cs_vfloat density = (2.0f + power) * cs_power(square, 0.5f * power) * (0.5f * CS_INVERSE_PI);
    return density / (4.0f * (cos_out + cos_in - cos_out * cos_in));
}

#endif /* MATERIALS */

#endif
