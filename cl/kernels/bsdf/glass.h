/* Solid glass: light is reflected by its facets or refracted into what is behind them. Shared.
 *
 * Walter et al. 2007, but that nothing is lost: there, light that its first facet sends towards
 * other facets ends, a third of all at roughness 0.7 inside of glass. Here it leaves, as if there
 * were no others; what would go to the wrong side of the surface is mirrored at it. So the value is
 * the density of what facets that `out` sees do to it, and white is white for every index and
 * roughness. That depends on `out` alone, so that reciprocity ends with shadowing: it holds as
 * long as the surface is smooth. (Turquin 2019 scales Walter's value by a table to the same end.)
 *
 * The dielectric's transparent part, transmission (1 - metallic), is glass; the rest is the
 * standard surface. The side of the triangle's normal is outside, with the index 1. The base colour
 * tints what is refracted. */
#ifndef CS_BSDF_GLASS_H
#define CS_BSDF_GLASS_H

#include "kernels/bsdf/standard.h"

#if CS_HAS(MATERIALS)

typedef struct cs_glass {
    cs_vfloat out[3]; /* unit */
    cs_vfloat cosine; /* of it */
    cs_vfloat width;
    cs_vfloat index_here; /* of refraction, on the side of `out` */
    cs_vfloat index_beyond;
    cs_vfloat part; /* of the surface that is glass */
} cs_glass;

static inline cs_vfloat cs_glass_part(const cs_surface *surface)
{
    return surface->parameters[CS_PARAMETER_TRANSMISSION] *
           (1.0f - surface->parameters[CS_PARAMETER_METALLIC]);
}

static inline cs_glass cs_glass_of(const cs_surface *surface, const cs_vfloat *out)
{
    cs_glass g;
    const cs_vfloat *p = surface->parameters;
    cs_normalised(out, g.out);
    g.cosine = cs_max(cs_inner(g.out, surface->normal), (cs_vfloat)(1e-4f));
    g.width = cs_facet_width(p[CS_PARAMETER_ROUGHNESS]);
    g.index_here = surface->inside ? p[CS_PARAMETER_INDEX] : (cs_vfloat)(1.0f);
    g.index_beyond = surface->inside ? (cs_vfloat)(1.0f) : p[CS_PARAMETER_INDEX];
    g.part = cs_glass_part(surface);
    return g;
}

/* Part of unpolarised light that a facet reflects (Walter et al. 2007, equation 22); 1 where
 * nothing gets out. `cosine` is between `out` and the facet's normal. */
static inline cs_vfloat cs_glass_reflectance(const cs_glass *g, cs_vfloat cosine)
{
    cs_vfloat ratio = g->index_beyond / g->index_here;
    cs_vfloat square = ratio * ratio - 1.0f + cosine * cosine;
    cs_vfloat root = cs_sqrt(cs_max(square, (cs_vfloat)(0.0f)));
    cs_vfloat across = (root - cosine) / cs_max(root + cosine, (cs_vfloat)(1e-20f));
    cs_vfloat along = (cosine * (root + cosine) - 1.0f) /
                      cs_max(cosine * (root - cosine) + 1.0f, (cs_vfloat)(1e-20f));
    cs_vfloat part = 0.5f * across * across * (1.0f + along * along);
    return square > 0.0f ? part : (cs_vfloat)(1.0f);
}

/* Density with which visible facets mirror `out` to `in`, unit, or refract it there. */
static inline cs_vfloat cs_glass_facets(const cs_glass *g, const cs_surface *surface,
                                        const cs_vfloat *in, cs_vint mirrored)
{
    cs_vfloat sum[3], half_way[3];
    for (int i = 0; i < 3; i++)
        sum[i] = mirrored ? g->out[i] + in[i] : g->index_here * g->out[i] + g->index_beyond * in[i];
    cs_normalised(sum, half_way);
    cs_vfloat side =
        cs_inner(half_way, surface->normal) < 0.0f ? (cs_vfloat)(-1.0f) : (cs_vfloat)(1.0f);
    for (int i = 0; i < 3; i++)
        half_way[i] *= side;
    cs_vfloat to_out = cs_inner(g->out, half_way), to_in = cs_inner(in, half_way);
    cs_vfloat reflected = cs_glass_reflectance(g, to_out);
    cs_vfloat drawn = cs_facet_density(surface->normal, half_way, g->cosine, g->width);
    /* From solid angles of facets to those of refracted light (equation 17). */
    cs_vfloat stretch = g->index_here * to_out + g->index_beyond * to_in;
    stretch = 4.0f * to_out * cs_abs(to_in) * g->index_beyond * g->index_beyond /
              cs_max(stretch * stretch, (cs_vfloat)(1e-20f));
    cs_vint meets =
        (to_out > 0.0f) & (mirrored ? (cs_vint)(to_in > 0.0f) : (cs_vint)(to_in < 0.0f));
    cs_vfloat density = drawn * (mirrored ? reflected : (1.0f - reflected) * stretch);
    return meets ? density : (cs_vfloat)(0.0f);
}

/* Density with which glass draws `in`, unit: straight, or mirrored at the surface. */
static inline cs_vfloat cs_glass_density(const cs_glass *g, const cs_surface *surface,
                                         const cs_vfloat *in)
{
    cs_vfloat cosine = cs_inner(in, surface->normal);
    cs_vint mirrored = cosine > 0.0f;
    cs_vfloat straight = cs_glass_facets(g, surface, in, mirrored);
#ifdef CS_FACETS_OF_MITSUBA
    return straight;
#else
    cs_vfloat other[3];
    for (int i = 0; i < 3; i++)
        other[i] = in[i] - 2.0f * cosine * surface->normal[i];
    return straight + cs_glass_facets(g, surface, other, mirrored);
#endif
}

/* The value from that density. Radiance grows with the square of the index. */
static inline cs_vfloat cs_glass_value(const cs_glass *g, const cs_surface *surface,
                                       const cs_vfloat *in, cs_vfloat density)
{
    cs_vfloat cosine = cs_inner(in, surface->normal), ratio = g->index_here / g->index_beyond;
    cs_vfloat cos_in = cs_max(cs_abs(cosine), (cs_vfloat)(1e-4f));
#ifdef CS_FACETS_OF_MITSUBA
    cos_in = 0.5f * (cos_in + cs_facet_slant(cos_in, g->width));
#endif
    return density / cos_in * (cosine > 0.0f ? (cs_vfloat)(1.0f) : ratio * ratio);
}

static inline cs_bsdf_value cs_bsdf_eval_glass(const cs_bsdf_view *view, const cs_vfloat *in)
{
    const cs_surface *surface = view->surface;
    cs_glass g = cs_glass_of(surface, view->out);
    cs_bsdf_value value;
    cs_vfloat unit[3];
    cs_normalised(in, unit);
    cs_vfloat density = cs_glass_density(&g, surface, unit);
    cs_vfloat glass = cs_glass_value(&g, surface, unit, density);
    cs_vint behind = cs_inner(unit, surface->normal) < 0.0f;
    value.scale = (cs_vfloat)(1.0f);
    value.density = g.part * density;
    for (int c = 0; c < 3; c++)
        value.colour[c] = g.part * glass * (behind ? surface->albedo[c] : (cs_vfloat)(1.0f));
    if (!view->has_standard) return value;
    cs_bsdf_value rest = cs_standard_value(&view->standard, surface, unit);
    value.density += (1.0f - g.part) * rest.density;
    for (int c = 0; c < 3; c++)
        value.colour[c] += (1.0f - g.part) * rest.colour[c];
    return value;
}

/* A direction that a visible facet mirrors or refracts; `choice` says which. On the wrong side of
 * the surface, it is mirrored there, or, in the lanes of `lost`, none. */
static inline void cs_glass_draw(const cs_glass *g, const cs_surface *surface, cs_pair pair,
                                 cs_vfloat choice, cs_vfloat *in, cs_vint *lost)
{
    cs_vfloat half_way[3];
    cs_draw_facet(surface->normal, g->out, g->cosine, g->width, pair, half_way);
    cs_vfloat cosine = cs_inner(g->out, half_way), ratio = g->index_here / g->index_beyond;
    cs_vint mirrored = choice < cs_glass_reflectance(g, cosine);
    cs_vfloat square = 1.0f - ratio * ratio * (1.0f - cosine * cosine);
    cs_vfloat bent = ratio * cosine - cs_sqrt(cs_max(square, (cs_vfloat)(0.0f)));
    cs_vfloat drawn[3];
    for (int i = 0; i < 3; i++)
        drawn[i] = mirrored ? 2.0f * cosine * half_way[i] - g->out[i]
                            : bent * half_way[i] - ratio * g->out[i];
    cs_normalised(drawn, in);
    cs_vfloat side = cs_inner(in, surface->normal);
    cs_vint wrong = mirrored ? (cs_vint)(side <= 0.0f) : (cs_vint)(side >= 0.0f);
#ifdef CS_FACETS_OF_MITSUBA
    *lost = wrong;
#else
    for (int i = 0; i < 3; i++)
        in[i] -= wrong ? 2.0f * side * surface->normal[i] : (cs_vfloat)(0.0f);
    *lost = side == 0.0f;
#endif
}

static inline cs_bsdf_direction cs_bsdf_sample_glass(const cs_bsdf_view *view, cs_pair pair,
                                                     cs_vfloat choice)
{
    const cs_surface *surface = view->surface;
    cs_glass g = cs_glass_of(surface, view->out);
    cs_bsdf_direction drawn;
    cs_vint lost;
    cs_vfloat among = choice / cs_max(g.part, (cs_vfloat)(1e-20f));
    cs_glass_draw(&g, surface, pair, among, drawn.in, &lost);
    if (view->has_standard) {
        cs_vfloat rest[3];
        cs_vint by_rest = choice >= g.part;
        among = (choice - g.part) / cs_max(1.0f - g.part, (cs_vfloat)(1e-20f));
        cs_vint lost_by_rest = cs_standard_draw(&view->standard, surface, pair, among, rest);
        for (int i = 0; i < 3; i++)
            drawn.in[i] = by_rest ? rest[i] : drawn.in[i];
        lost = by_rest ? lost_by_rest : lost;
    }
    drawn.value = cs_bsdf_eval_glass(view, drawn.in);
    drawn.value.density = lost ? (cs_vfloat)(0.0f) : drawn.value.density;
    return drawn;
}

#endif /* MATERIALS */

#endif
