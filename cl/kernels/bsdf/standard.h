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
static inline void cs_standard_chances(const cs_surface *surface, cs_standard *s)
{
    cs_vfloat all = s->albedo.plane[CS_ALBEDO_ALL];
    cs_vfloat once = s->albedo.plane[CS_ALBEDO_SCHLICK];
    cs_vfloat f0 = s->metal * cs_largest(surface->albedo) + (1.0f - s->metal) * s->f0;
    cs_vfloat dielectric = cs_dielectric_albedo(s, &s->albedo);
    cs_vfloat base = cs_largest(s->base);
    cs_vfloat f90 = s->metal + (1.0f - s->metal) * s->f90;
    cs_vfloat facets = s->below * (f0 * all + (f90 - f0) * once);
    cs_vfloat coat = s->coat * s->coat_albedo;
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

/* The layers above the facets: what they reflect themselves, and what they leave. */
static inline void cs_standard_above(const cs_surface *surface, cs_standard *s)
{
    const cs_vfloat *p = surface->parameters;
    cs_vfloat sheen = cs_largest(p + CS_PARAMETER_SHEEN);
    s->coat = p[CS_PARAMETER_COAT];
    s->has_coat = cs_any(s->coat > 0.0f);
    s->has_sheen = cs_any(sheen > 0.0f);
    s->coat_width = (cs_vfloat)(1.0f);
    s->coat_albedo = (cs_vfloat)(0.0f);
    s->fibres = (cs_vfloat)(0.0f);
    if (s->has_coat) {
        cs_albedo of = cs_albedo_at(surface->albedos, s->cosine, p[CS_PARAMETER_COAT_ROUGHNESS]);
        s->coat_width = cs_facet_width(p[CS_PARAMETER_COAT_ROUGHNESS]);
        s->coat_albedo = CS_COAT_F0 * of.plane[CS_ALBEDO_ALL] +
                         (1.0f - CS_COAT_F0) * of.plane[CS_ALBEDO_SCHLICK];
    }
    s->below = 1.0f - s->coat * s->coat_albedo;
    if (s->has_sheen) {
        cs_vfloat all =
            cs_fibre_albedo(surface->albedos, s->cosine, p[CS_PARAMETER_SHEEN_ROUGHNESS]);
        s->fibres = s->below / cs_max(all, (cs_vfloat)(1.0f));
        s->below *= 1.0f - sheen * cs_min(all, (cs_vfloat)(1.0f));
    }
}

/* metal, through: parts of the surface that are metal, and of the rest's base that is transparent.
 */
static inline cs_standard cs_standard_of(const cs_surface *surface, const cs_vfloat *out,
                                         cs_vfloat metal, cs_vfloat through)
{
    cs_standard s;
    const cs_vfloat *p = surface->parameters;
    cs_normalised(out, s.out);
    s.cosine = cs_max(cs_inner(s.out, surface->normal), (cs_vfloat)(1e-4f));
    s.width = cs_facet_width(p[CS_PARAMETER_ROUGHNESS]);
    s.metal = metal;
    s.f0 = p[CS_PARAMETER_F0];
    s.f90 = p[CS_PARAMETER_F90];
    s.through = through;
    s.albedo = cs_albedo_at(surface->albedos, s.cosine, p[CS_PARAMETER_ROUGHNESS]);
    s.average = cs_average_albedo(surface->albedos, p[CS_PARAMETER_ROUGHNESS]);
    s.repeated = cs_repeated_part(s.f0, s.f90, s.average.plane[CS_ALBEDO_ALL]);
    for (int c = 0; c < 3; c++) {
        s.repeats[c] = s.metal * cs_repeated_part(surface->albedo[c], (cs_vfloat)(1.0f),
                                                  s.average.plane[CS_ALBEDO_ALL]);
        s.base[c] = (1.0f - s.metal) * surface->albedo[c];
    }
    cs_standard_above(surface, &s);
    cs_standard_chances(surface, &s);
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

/* A direction as the surface meets it: mirrored to this side, with what the lobes have in common.
 */
typedef struct cs_meeting {
    cs_vfloat in[3];       /* unit, on this side */
    cs_vfloat cosine;      /* of the direction itself, negative behind */
    cs_vfloat cos_in;      /* above 0 */
    cs_vfloat half_way[3]; /* unit */
    cs_vfloat grazing;     /* cs_schlick of the angle at the facet */
    cs_vfloat facets;      /* density of facets that mirror one direction to the other */
} cs_meeting;

static inline cs_meeting cs_meeting_of(const cs_standard *s, const cs_surface *surface,
                                       const cs_vfloat *in)
{
    cs_meeting m;
    cs_normalised(in, m.in);
    m.cosine = cs_inner(m.in, surface->normal);
    cs_vfloat twice = m.cosine < 0.0f ? 2.0f * m.cosine : (cs_vfloat)(0.0f);
    for (int i = 0; i < 3; i++)
        m.in[i] -= twice * surface->normal[i];
    m.cos_in = cs_max(cs_abs(m.cosine), (cs_vfloat)(1e-4f));
    cs_half_way(s->out, m.in, m.half_way);
    m.grazing = cs_schlick(cs_inner(s->out, m.half_way));
    m.facets = cs_facet_distribution(surface->normal, m.half_way, s->width);
    return m;
}

/* The value on this side: facets, what meets several of them, and base. */
static inline void cs_standard_front(const cs_standard *s, const cs_surface *surface,
                                     const cs_meeting *m, cs_vfloat facets, const cs_albedo *seen,
                                     cs_vfloat *value)
{
    cs_vfloat lost = cs_met_again(s, seen);
    cs_vfloat passed = (1.0f - cs_dielectric_albedo(s, &s->albedo)) *
                       (1.0f - cs_dielectric_albedo(s, seen)) * CS_INVERSE_PI /
                       cs_max(1.0f - cs_dielectric_albedo(s, &s->average), (cs_vfloat)(1e-6f));
    for (int c = 0; c < 3; c++) {
        cs_vfloat f0 = s->metal * surface->albedo[c] + (1.0f - s->metal) * s->f0;
        cs_vfloat f90 = s->metal + (1.0f - s->metal) * s->f90;
        cs_vfloat repeats = s->repeats[c] + (1.0f - s->metal) * s->repeated;
        value[c] = s->below * (facets * (f0 + (f90 - f0) * m->grazing) + lost * repeats +
                               s->base[c] * (1.0f - s->through) * passed);
    }
}

/* Adds coat and sheen. coat: density of the coat's facets, as m->facets. */
static inline void cs_standard_add_above(const cs_standard *s, const cs_surface *surface,
                                         const cs_meeting *m, cs_vfloat coat, cs_vfloat *value)
{
    const cs_vfloat *p = surface->parameters;
    cs_vfloat fibres = (cs_vfloat)(0.0f);
    cs_vfloat above = s->coat * coat * cs_facet_visibility(s->cosine, m->cos_in, s->coat_width) *
                      (CS_COAT_F0 + (1.0f - CS_COAT_F0) * m->grazing);
    if (s->has_sheen)
        fibres = s->fibres * cs_sheen(cs_inner(surface->normal, m->half_way), s->cosine, m->cos_in,
                                      p[CS_PARAMETER_SHEEN_ROUGHNESS]);
    for (int c = 0; c < 3; c++)
        value[c] += above + fibres * p[CS_PARAMETER_SHEEN + c];
}

/* The value on the other side, of a direction that is mirrored to this one. */
static inline void cs_standard_behind(const cs_standard *s, const cs_meeting *m, cs_vfloat facets,
                                      const cs_albedo *seen, cs_vfloat *value)
{
    cs_vfloat passed = (1.0f - s->f0 - (s->f90 - s->f0) * m->grazing) * facets +
                       (1.0f - s->repeated) * cs_met_again(s, seen);
    for (int c = 0; c < 3; c++)
        value[c] = s->below * s->base[c] * s->through * passed;
}

/* coat: as above. */
static inline cs_vfloat cs_standard_density(const cs_standard *s, const cs_meeting *m,
                                            cs_vfloat coat)
{
    cs_vfloat facets = m->facets * cs_facet_part(s->cosine, s->width);
    cs_vfloat even = cs_abs(m->cosine) * CS_INVERSE_PI;
    cs_vfloat rest =
        1.0f - s->chance_facets - s->chance_coat - s->chance_through - s->chance_behind;
    cs_vfloat front = s->chance_facets * facets + rest * even;
    if (s->has_coat) front += s->chance_coat * coat * cs_facet_part(s->cosine, s->coat_width);
    return m->cosine < 0.0f ? s->chance_through * facets + s->chance_behind * even : front;
}

/* An upper bound of cs_standard_density over all directions `in`. The distribution of facets is
 * greatest at the surface's normal, where it is 1 / (pi width^2). */
static inline cs_vfloat cs_standard_most_density(const cs_standard *s)
{
    cs_vfloat facets = (s->chance_facets + s->chance_through) * cs_facet_part(s->cosine, s->width) /
                       (s->width * s->width);
    if (s->has_coat)
        facets += s->chance_coat * cs_facet_part(s->cosine, s->coat_width) /
                  (s->coat_width * s->coat_width);
    return (1.0f + facets) * CS_INVERSE_PI;
}

static inline cs_bsdf_value cs_standard_value(const cs_standard *s, const cs_surface *surface,
                                              const cs_vfloat *in)
{
    cs_bsdf_value value;
    cs_vfloat behind[3], coat = (cs_vfloat)(0.0f);
    cs_meeting m = cs_meeting_of(s, surface, in);
    cs_albedo seen =
        cs_albedo_at(surface->albedos, m.cos_in, surface->parameters[CS_PARAMETER_ROUGHNESS]);
    cs_vfloat facets = m.facets * cs_facet_visibility(s->cosine, m.cos_in, s->width);
    if (s->has_coat) coat = cs_facet_distribution(surface->normal, m.half_way, s->coat_width);
    value.scale = (cs_vfloat)(1.0f);
    value.density = cs_standard_density(s, &m, coat);
    cs_standard_front(s, surface, &m, facets, &seen, value.colour);
    if (s->has_coat | s->has_sheen) cs_standard_add_above(s, surface, &m, coat, value.colour);
    if (!cs_any(m.cosine < 0.0f)) return value;
    cs_standard_behind(s, &m, facets, &seen, behind);
    for (int c = 0; c < 3; c++)
        value.colour[c] = m.cosine < 0.0f ? behind[c] : value.colour[c];
    return value;
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

/* Draws a direction; returns the lanes in which there is none. */
static inline cs_vint cs_standard_draw(const cs_standard *s, const cs_surface *surface,
                                       cs_pair pair, cs_vfloat choice, cs_vfloat *in)
{
    cs_vfloat mirrored[3];
    cs_vfloat facets = s->chance_facets + s->chance_through, all = facets + s->chance_coat;
    cs_vint by_facet = choice < all;
    cs_draw_diffuse(surface, pair, in);
    if (cs_any(by_facet)) {
        cs_vfloat width = choice < facets ? s->width : s->coat_width;
        cs_mirror_at_facet(s, surface, width, pair, mirrored);
        for (int i = 0; i < 3; i++)
            in[i] = by_facet ? mirrored[i] : in[i];
    }
    cs_vfloat cosine = cs_inner(in, surface->normal);
    cs_vint crosses = choice < facets
                          ? (cs_vint)(choice >= s->chance_facets)
                          : (cs_vint)((choice >= all) & (choice < all + s->chance_behind));
    for (int i = 0; i < 3; i++)
        in[i] -= crosses ? 2.0f * cosine * surface->normal[i] : (cs_vfloat)(0.0f);
    /* Mirrored at a facet to below the surface: shadowed, nothing is drawn. */
    return cosine < 0.0f;
}

static inline cs_bsdf_value cs_bsdf_eval_standard(const cs_bsdf_view *view, const cs_vfloat *in)
{
    return cs_standard_value(&view->standard, view->surface, in);
}

static inline cs_bsdf_direction cs_bsdf_sample_standard(const cs_bsdf_view *view, cs_pair pair,
                                                        cs_vfloat choice)
{
    cs_bsdf_direction drawn;
    cs_vint lost = cs_standard_draw(&view->standard, view->surface, pair, choice, drawn.in);
    drawn.value = cs_bsdf_eval_standard(view, drawn.in);
    drawn.value.density = lost ? (cs_vfloat)(0.0f) : drawn.value.density;
    return drawn;
}

#endif /* MATERIALS */

#endif
