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

/* By which the density of facets becomes that of directions that visible facets mirror `out` to. */
static inline cs_vfloat cs_facet_part(cs_vfloat cos_out, cs_vfloat width)
{
    return 0.5f / (cos_out + cs_facet_slant(cos_out, width));
}

/* Density of `in` when it mirrors `out` at a visible facet. */
static inline cs_vfloat cs_facet_density(const cs_vfloat *normal, const cs_vfloat *half_way,
                                         cs_vfloat cos_out, cs_vfloat width)
{
    return cs_facet_distribution(normal, half_way, width) * cs_facet_part(cos_out, width);
}

/* A facet's normal that `out` sees, in the frame of which the surface's normal is the last axis. */
static inline void cs_visible_facet(const cs_vfloat *out, cs_vfloat width, cs_pair pair,
                                    cs_vfloat *facet)
{
    cs_vfloat stretched[3] = {width * out[0], width * out[1], out[2]}, seen[3], cap[3];
    cs_normalised(stretched, seen);
    cs_vfloat up = (1.0f - pair.y) * (1.0f + seen[2]) - seen[2];
    cs_vfloat outward = cs_sqrt(cs_clamp(1.0f - up * up, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f)));
    cs_vfloat sine, cosine;
    cs_sine_cosine(2.0f * CS_PI * pair.x, &sine, &cosine);
    cap[0] = (outward * cosine + seen[0]) * width;
    cap[1] = (outward * sine + seen[1]) * width;
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
 * The table of albedos. Each roughness has a pair of albedos, of CS_ALBEDO_ALL and
 * CS_ALBEDO_SCHLICK, for CS_ALBEDO_COSINES cosines from 0 to 1, then the pair of their averages,
 * 2 int E(c) c dc; then as many albedos of sheen.
 * --------------------------------------------------------------------------------------------- */

enum {
    CS_ALBEDO_COSINES = 64,
    CS_ALBEDO_ROUGHNESSES = 32,
    CS_ALBEDO_FIBRES = 2 * (CS_ALBEDO_COSINES + 1), /* where those of sheen begin */
    CS_ALBEDO_ROW = 3 * (CS_ALBEDO_COSINES + 1),    /* of a roughness */
    CS_ALBEDO_FLOATS = CS_ALBEDO_ROW * CS_ALBEDO_ROUGHNESSES
};

/* Places in the table. */
typedef struct cs_albedo_place {
    cs_vint row;      /* first number of the roughness below */
    cs_vfloat across; /* part of the way to the next one */
    cs_vint cell;     /* the cosine below */
    cs_vfloat along;  /* part of the way to the next one */
} cs_albedo_place;

/* cosine, roughness: 0 to 1. */
static inline cs_albedo_place cs_albedo_place_of(cs_vfloat cosine, cs_vfloat roughness)
{
    cs_albedo_place at;
    cs_vfloat across = cs_clamp(roughness, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f)) *
                       (cs_f32)(CS_ALBEDO_ROUGHNESSES - 1);
    cs_vfloat row = cs_min(cs_floor(across), (cs_vfloat)((cs_f32)(CS_ALBEDO_ROUGHNESSES - 2)));
    cs_vfloat along =
        cs_clamp(cosine, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f)) * (cs_f32)(CS_ALBEDO_COSINES - 1);
    cs_vfloat cell = cs_min(cs_floor(along), (cs_vfloat)((cs_f32)(CS_ALBEDO_COSINES - 2)));
    at.across = across - row;
    at.along = along - cell;
    at.row = cs_whole(row) * CS_ALBEDO_ROW;
    at.cell = cs_whole(cell);
    return at;
}

/* Of facets, linear between the roughnesses and between the cosines. */
static inline cs_albedo cs_albedo_at(CS_GLOBAL const cs_f32 *table, cs_vfloat cosine,
                                     cs_vfloat roughness)
{
    cs_albedo_place at = cs_albedo_place_of(cosine, roughness);
    cs_vint first = at.row + 2 * at.cell;
    cs_vfloat found[4];
    cs_albedo albedo;
    cs_blend_four(table, first, first + CS_ALBEDO_ROW, at.across, found);
    for (int p = 0; p < CS_ALBEDO_PLANES; p++)
        albedo.plane[p] = found[p] + at.along * (found[CS_ALBEDO_PLANES + p] - found[p]);
    return albedo;
}

/* Averages over cosines. */
static inline cs_albedo cs_average_albedo(CS_GLOBAL const cs_f32 *table, cs_vfloat roughness)
{
    cs_albedo_place at = cs_albedo_place_of((cs_vfloat)(0.0f), roughness);
    cs_vint first = at.row + CS_ALBEDO_PLANES * CS_ALBEDO_COSINES;
    cs_albedo albedo;
    for (int p = 0; p < CS_ALBEDO_PLANES; p++) {
        cs_vfloat found = cs_gather(table, first + p);
        albedo.plane[p] =
            found + at.across * (cs_gather(table, first + (CS_ALBEDO_ROW + p)) - found);
    }
    return albedo;
}

/* Of white sheen. */
static inline cs_vfloat cs_fibre_albedo(CS_GLOBAL const cs_f32 *table, cs_vfloat cosine,
                                        cs_vfloat roughness)
{
    cs_albedo_place at = cs_albedo_place_of(cosine, roughness);
    cs_vint first = at.row + at.cell + CS_ALBEDO_FIBRES;
    cs_vfloat ends[2];
    for (int i = 0; i < 2; i++) {
        cs_vfloat found = cs_gather(table, first + i);
        ends[i] = found + at.across * (cs_gather(table, first + (CS_ALBEDO_ROW + i)) - found);
    }
    return ends[0] + at.along * (ends[1] - ends[0]);
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
