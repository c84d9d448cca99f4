/* The surface of glTF 2.0: a metal or a dielectric over a diffuse or transparent base, under a
 * clear coat and sheen. Shared.
 *
 * Layers pass on what the albedo of those above leaves. Between the dielectric's facets and its
 * base that is symmetric, (1 - E(out)) (1 - E(in)) / (1 - mean E) (Kulla & Conty 2017); for coat
 * and sheen it depends on `out` alone (glTF 2.0, appendix B and KHR_materials_clearcoat, _sheen),
 * so that reciprocity ends there. What enters a thin wall leaves it on the other side, mirrored at
 * the wall. No layer gives more than it gets: white is white in a white furnace. */
#ifndef CS_BSDF_STANDARD_H
#define CS_BSDF_STANDARD_H

#include "kernels/bsdf/lambert.h"
#include "kernels/bsdf/microfacet.h"

#if CS_HAS(MATERIALS)

/* What of the model does not depend on `in`. */
typedef struct cs_standard {
    cs_vfloat out[3]; /* unit */
    cs_vfloat cosine; /* of it */
    cs_vfloat width;
    cs_vfloat metal; /* part; the rest is dielectric */
    cs_vfloat f0;    /* of the dielectric, and at grazing angles */
    cs_vfloat f90;
    cs_vfloat repeated;   /* of the dielectric, see cs_repeated_part */
    cs_vfloat repeats[3]; /* of the metal, times its part */
    cs_vfloat base[3];    /* colour of what is below the dielectric, times its part */
    cs_vfloat through;    /* part of the base that is transparent */
    cs_albedo albedo;     /* seen from `out` */
    cs_albedo average;
    cs_vfloat below; /* part that coat and sheen leave */
    cs_vfloat
        fibres; /* what the sheen is scaled by: at grazing angles it would give more than it gets */
    cs_vfloat coat;
    cs_vfloat coat_width;
    cs_vfloat chance_facets; /* of drawing by each lobe; the rest is diffuse on this side */
    cs_vfloat chance_coat;
    cs_vfloat chance_through; /* mirrored facets */
    cs_vfloat chance_behind;  /* diffuse on the other side */
} cs_standard;

/* Albedo of the dielectric's facets, from a row of the table. */
static inline cs_vfloat cs_dielectric_albedo(const cs_standard *s, const cs_albedo *albedo)
{
    cs_vfloat all = albedo->plane[CS_ALBEDO_ALL];
    return s->f0 * all + (s->f90 - s->f0) * albedo->plane[CS_ALBEDO_SCHLICK] +
           s->repeated * (1.0f - all);
}

static inline cs_vfloat cs_largest(const cs_vfloat *colour)
{
    return cs_max(colour[0], cs_max(colour[1], colour[2]));
}

/* Chances in proportion to what the lobes reflect of white light. */
static inline void cs_standard_chances(const cs_surface *surface, cs_vfloat coat_albedo,
                                       cs_standard *s)
{
    cs_vfloat all = s->albedo.plane[CS_ALBEDO_ALL];
    cs_vfloat once = s->albedo.plane[CS_ALBEDO_SCHLICK];
    cs_vfloat f0 = s->metal * cs_largest(surface->albedo) + (1.0f - s->metal) * s->f0;
    cs_vfloat dielectric = cs_dielectric_albedo(s, &s->albedo);
    cs_vfloat base = cs_largest(s->base);
    cs_vfloat f90 = s->metal + (1.0f - s->metal) * s->f90;
    cs_vfloat facets = s->below * (f0 * all + (f90 - f0) * once);
    cs_vfloat coat = s->coat * coat_albedo;
    cs_vfloat entered = s->f0 * all + (s->f90 - s->f0) * once;
    cs_vfloat through = s->below * base * s->through * (all - entered);
    cs_vfloat behind = s->below * base * s->through * (1.0f - s->repeated) * (1.0f - all);
    cs_vfloat diffuse =
        s->below * (base * (1.0f - s->through) * (1.0f - dielectric) +
                    (cs_largest(s->repeats) + (1.0f - s->metal) * s->repeated) * (1.0f - all)) +
        (1.0f - s->below) * 0.25f + 1e-3f;
    cs_vfloat scale = 1.0f / (facets + coat + through + behind + diffuse);
    s->chance_facets = facets * scale;
    s->chance_coat = coat * scale;
    s->chance_through = through * scale;
    s->chance_behind = behind * scale;
}

static inline cs_standard cs_standard_of(const cs_surface *surface, const cs_vfloat *out)
{
    cs_standard s;
    const cs_vfloat *p = surface->parameters;
    cs_normalised(out, s.out);
    s.cosine = cs_max(cs_inner(s.out, surface->normal), (cs_vfloat)(1e-4f));
    s.width = cs_facet_width(p[CS_PARAMETER_ROUGHNESS]);
    s.metal = p[CS_PARAMETER_METALLIC];
    s.f0 = p[CS_PARAMETER_F0];
    s.f90 = p[CS_PARAMETER_F90];
    s.through = p[CS_PARAMETER_TRANSMISSION];
    s.albedo = cs_albedo_at(surface->albedos, s.cosine, p[CS_PARAMETER_ROUGHNESS]);
    s.average = cs_albedo_at(surface->albedos, (cs_vfloat)(-1.0f), p[CS_PARAMETER_ROUGHNESS]);
    s.repeated = cs_repeated_part(s.f0, s.f90, s.average.plane[CS_ALBEDO_ALL]);
    for (int c = 0; c < 3; c++) {
        s.repeats[c] = s.metal * cs_repeated_part(surface->albedo[c], (cs_vfloat)(1.0f),
                                                  s.average.plane[CS_ALBEDO_ALL]);
        s.base[c] = (1.0f - s.metal) * surface->albedo[c];
    }
    s.coat = p[CS_PARAMETER_COAT];
    s.coat_width = cs_facet_width(p[CS_PARAMETER_COAT_ROUGHNESS]);
    cs_albedo above = cs_albedo_at(surface->albedos, s.cosine, p[CS_PARAMETER_COAT_ROUGHNESS]);
    cs_vfloat coat_albedo = CS_COAT_F0 * above.plane[CS_ALBEDO_ALL] +
                            (1.0f - CS_COAT_F0) * above.plane[CS_ALBEDO_SCHLICK];
    above = cs_albedo_at(surface->albedos, s.cosine, p[CS_PARAMETER_SHEEN_ROUGHNESS]);
    s.fibres =
        (1.0f - s.coat * coat_albedo) / cs_max(above.plane[CS_ALBEDO_SHEEN], (cs_vfloat)(1.0f));
    cs_vfloat sheen = cs_largest(p + CS_PARAMETER_SHEEN) *
                      cs_min(above.plane[CS_ALBEDO_SHEEN], (cs_vfloat)(1.0f));
    s.below = (1.0f - s.coat * coat_albedo) * (1.0f - sheen);
    cs_standard_chances(surface, coat_albedo, &s);
    return s;
}

/* Direction half way between two unit vectors. */
static inline void cs_half_way(const cs_vfloat *a, const cs_vfloat *b, cs_vfloat *half_way)
{
    cs_vfloat sum[3] = {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
    cs_normalised(sum, half_way);
}

/* Per steradian, what no single facet lets go towards directions with the albedo `seen`. */
static inline cs_vfloat cs_met_again(const cs_standard *s, const cs_albedo *seen)
{
#ifdef CS_FACETS_OF_MITSUBA
    (void)s;
    (void)seen;
    return (cs_vfloat)(0.0f);
#else
    return (1.0f - s->albedo.plane[CS_ALBEDO_ALL]) * (1.0f - seen->plane[CS_ALBEDO_ALL]) *
           CS_INVERSE_PI / cs_max(1.0f - s->average.plane[CS_ALBEDO_ALL], (cs_vfloat)(1e-6f));
#endif
}

/* The value on this side: facets, what meets several of them, base, coat, sheen. */
static inline void cs_standard_front(const cs_standard *s, const cs_surface *surface,
                                     const cs_vfloat *in, cs_vfloat cos_in, cs_vfloat *value)
{
    const cs_vfloat *p = surface->parameters;
    cs_vfloat half_way[3];
    cs_half_way(s->out, in, half_way);
    cs_vfloat grazing = cs_schlick(cs_inner(s->out, half_way));
    cs_vfloat facets = cs_facet_distribution(surface->normal, half_way, s->width) *
                       cs_facet_visibility(s->cosine, cos_in, s->width);
    cs_albedo seen = cs_albedo_at(surface->albedos, cos_in, p[CS_PARAMETER_ROUGHNESS]);
    cs_vfloat lost = cs_met_again(s, &seen);
    cs_vfloat passed = (1.0f - cs_dielectric_albedo(s, &s->albedo)) *
                       (1.0f - cs_dielectric_albedo(s, &seen)) * CS_INVERSE_PI /
                       cs_max(1.0f - cs_dielectric_albedo(s, &s->average), (cs_vfloat)(1e-6f));
    for (int c = 0; c < 3; c++) {
        cs_vfloat f0 = s->metal * surface->albedo[c] + (1.0f - s->metal) * s->f0;
        cs_vfloat f90 = s->metal + (1.0f - s->metal) * s->f90;
        cs_vfloat repeats = s->repeats[c] + (1.0f - s->metal) * s->repeated;
        value[c] = s->below * (facets * (f0 + (f90 - f0) * grazing) + lost * repeats +
                               s->base[c] * (1.0f - s->through) * passed);
    }
    cs_vfloat above = s->coat * cs_facet_distribution(surface->normal, half_way, s->coat_width) *
                      cs_facet_visibility(s->cosine, cos_in, s->coat_width) *
                      (CS_COAT_F0 + (1.0f - CS_COAT_F0) * grazing);
    cs_vfloat fibres = (cs_vfloat)(0.0f);
    if (cs_any(cs_largest(p + CS_PARAMETER_SHEEN) > 0.0f))
        fibres = s->fibres * cs_sheen(cs_inner(surface->normal, half_way), s->cosine, cos_in,
                                      p[CS_PARAMETER_SHEEN_ROUGHNESS]);
    for (int c = 0; c < 3; c++)
        value[c] += above + fibres * p[CS_PARAMETER_SHEEN + c];
}

/* The value on the other side, of a direction that is mirrored to this one. */
static inline void cs_standard_behind(const cs_standard *s, const cs_surface *surface,
                                      const cs_vfloat *mirrored, cs_vfloat cos_in, cs_vfloat *value)
{
    cs_vfloat half_way[3];
    cs_half_way(s->out, mirrored, half_way);
    cs_vfloat grazing = cs_schlick(cs_inner(s->out, half_way));
    cs_vfloat facets = cs_facet_distribution(surface->normal, half_way, s->width) *
                       cs_facet_visibility(s->cosine, cos_in, s->width);
    cs_albedo seen =
        cs_albedo_at(surface->albedos, cos_in, surface->parameters[CS_PARAMETER_ROUGHNESS]);
    cs_vfloat lost = cs_met_again(s, &seen);
    cs_vfloat passed =
        (1.0f - s->f0 - (s->f90 - s->f0) * grazing) * facets + (1.0f - s->repeated) * lost;
    for (int c = 0; c < 3; c++)
        value[c] = s->below * s->base[c] * s->through * passed;
}

/* `in` as a unit vector, mirrored to this side; its cosine, negative where it was behind. */
static inline cs_vfloat cs_to_this_side(const cs_surface *surface, const cs_vfloat *in,
                                        cs_vfloat *front)
{
    cs_normalised(in, front);
    cs_vfloat cosine = cs_inner(front, surface->normal);
    cs_vfloat twice = cosine < 0.0f ? 2.0f * cosine : (cs_vfloat)(0.0f);
    for (int i = 0; i < 3; i++)
        front[i] -= twice * surface->normal[i];
    return cosine;
}

static inline cs_bsdf_value cs_standard_value(const cs_standard *s, const cs_surface *surface,
                                              const cs_vfloat *in)
{
    cs_bsdf_value value;
    cs_vfloat front[3], here[3], behind[3];
    cs_vfloat cosine = cs_to_this_side(surface, in, front);
    cs_vfloat cos_in = cs_max(cs_abs(cosine), (cs_vfloat)(1e-4f));
    cs_standard_front(s, surface, front, cos_in, here);
    for (int c = 0; c < 3; c++)
        behind[c] = (cs_vfloat)(0.0f);
    if (cs_any(cosine < 0.0f)) cs_standard_behind(s, surface, front, cos_in, behind);
    value.scale = (cs_vfloat)(1.0f);
    for (int c = 0; c < 3; c++)
        value.colour[c] = cosine < 0.0f ? behind[c] : here[c];
    return value;
}

static inline cs_vfloat cs_standard_density(const cs_standard *s, const cs_surface *surface,
                                            const cs_vfloat *in)
{
    cs_vfloat front[3], half_way[3];
    cs_vfloat cosine = cs_to_this_side(surface, in, front);
    cs_half_way(s->out, front, half_way);
    cs_vfloat facets = cs_facet_density(surface->normal, half_way, s->cosine, s->width);
    cs_vfloat coat = cs_facet_density(surface->normal, half_way, s->cosine, s->coat_width);
    cs_vfloat even = cs_abs(cosine) * CS_INVERSE_PI;
    cs_vfloat rest =
        1.0f - s->chance_facets - s->chance_coat - s->chance_through - s->chance_behind;
    return cosine < 0.0f ? s->chance_through * facets + s->chance_behind * even
                         : s->chance_facets * facets + s->chance_coat * coat + rest * even;
}

static inline cs_bsdf_value cs_bsdf_eval_standard(const cs_surface *surface, const cs_vfloat *out,
                                                  const cs_vfloat *in)
{
    cs_standard s = cs_standard_of(surface, out);
    return cs_standard_value(&s, surface, in);
}

static inline cs_vfloat cs_bsdf_density_standard(const cs_surface *surface, const cs_vfloat *out,
                                                 const cs_vfloat *in)
{
    cs_standard s = cs_standard_of(surface, out);
    return cs_standard_density(&s, surface, in);
}

/* A direction that mirrors `out` at a visible facet. */
static inline void cs_mirror_at_facet(const cs_standard *s, const cs_surface *surface,
                                      cs_vfloat width, cs_pair pair, cs_vfloat *in)
{
    cs_vfloat half_way[3];
    cs_draw_facet(surface->normal, s->out, s->cosine, width, pair, half_way);
    cs_vfloat twice = 2.0f * cs_inner(s->out, half_way);
    for (int i = 0; i < 3; i++)
        in[i] = twice * half_way[i] - s->out[i];
}

static inline cs_bsdf_direction cs_bsdf_sample_standard(const cs_surface *surface,
                                                        const cs_vfloat *out, cs_pair pair,
                                                        cs_vfloat choice)
{
    cs_standard s = cs_standard_of(surface, out);
    cs_bsdf_direction drawn = cs_bsdf_sample_lambert(surface, out, pair, choice);
    cs_vfloat mirrored[3];
    cs_vfloat facets = s.chance_facets + s.chance_through, all = facets + s.chance_coat;
    cs_vint by_facet = choice < all;
    cs_vfloat width = choice < facets ? s.width : s.coat_width;
    cs_mirror_at_facet(&s, surface, width, pair, mirrored);
    for (int i = 0; i < 3; i++)
        drawn.in[i] = by_facet ? mirrored[i] : drawn.in[i];
    cs_vfloat cosine = cs_inner(drawn.in, surface->normal);
    /* Mirrored at a facet to below the surface: shadowed, nothing is drawn. */
    cs_vint lost = cosine < 0.0f;
    cs_vint crosses = choice < facets
                          ? (cs_vint)(choice >= s.chance_facets)
                          : (cs_vint)((choice >= all) & (choice < all + s.chance_behind));
    for (int i = 0; i < 3; i++)
        drawn.in[i] -= crosses ? 2.0f * cosine * surface->normal[i] : (cs_vfloat)(0.0f);
    drawn.density = lost ? (cs_vfloat)(0.0f) : cs_standard_density(&s, surface, drawn.in);
    drawn.value = cs_standard_value(&s, surface, drawn.in);
    return drawn;
}

#endif /* MATERIALS */

#endif
