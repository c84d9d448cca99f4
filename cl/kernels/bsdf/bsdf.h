/* The BSDF of whatever kinds a packet hit. Shared.
 *
 * Directions point away from the surface: `out` to the viewer, `in` to where the light comes from.
 * Either may have any length above 0; a kind that needs unit vectors divides by their length. */
#ifndef CS_BSDF_H
#define CS_BSDF_H

#include "kernels/bsdf/glass.h"

/* Lanes whose surface is of a kind: all of them, known to the compiler, while there is one kind. */
static inline cs_vint cs_bsdf_lanes(const cs_surface *surface, cs_i32 kind)
{
#if CS_HAS(MATERIALS)
    return (cs_vint)(surface->bsdf == (cs_vint)(kind));
#else
    (void)surface;
    (void)kind;
    return (cs_vint)(-1);
#endif
}

/* Lanes whose surface lets light through to the other side. */
static inline cs_vint cs_lets_through(const cs_surface *surface)
{
#if CS_HAS(MATERIALS)
    return (surface->bsdf != (cs_vint)(CS_BSDF_LAMBERT)) &
           (surface->parameters[CS_PARAMETER_TRANSMISSION] > 0.0f);
#else
    (void)surface;
    return (cs_vint)(0);
#endif
}

/* Surfaces as seen from the directions `out`, for the functions below. Both must outlive it. */
static inline cs_bsdf_view cs_bsdf_view_of(const cs_surface *surface, const cs_vfloat *out)
{
    cs_bsdf_view view;
    view.surface = surface;
    view.out = out;
#if CS_HAS(MATERIALS)
    const cs_vfloat *p = surface->parameters;
    cs_vint solid = cs_bsdf_lanes(surface, CS_BSDF_GLASS);
    cs_vfloat glass = solid ? cs_glass_part(surface) : (cs_vfloat)(0.0f);
    cs_vint needed = cs_bsdf_lanes(surface, CS_BSDF_STANDARD) | (solid & (glass < 1.0f));
    /* What of a solid is not glass is opaque. */
    view.has_standard = cs_any(needed);
    if (view.has_standard)
        view.standard = cs_standard_of(
            surface, out, p[CS_PARAMETER_METALLIC] / cs_max(1.0f - glass, (cs_vfloat)(1e-6f)),
            solid ? (cs_vfloat)(0.0f) : p[CS_PARAMETER_TRANSMISSION]);
#endif
    return view;
}

/* Takes over the lanes in `mine`. */
static inline void cs_bsdf_take_value(cs_bsdf_value *value, const cs_bsdf_value *from, cs_vint mine)
{
    value->scale = mine ? from->scale : value->scale;
    value->density = mine ? from->density : value->density;
    for (int c = 0; c < 3; c++)
        value->colour[c] = mine ? from->colour[c] : value->colour[c];
}

static inline cs_bsdf_value cs_bsdf_nothing(void)
{
    cs_bsdf_value value;
    value.scale = (cs_vfloat)(0.0f);
    value.density = (cs_vfloat)(0.0f);
    for (int c = 0; c < 3; c++)
        value.colour[c] = (cs_vfloat)(0.0f);
    return value;
}

/* The value for another direction, and the density with which cs_bsdf_sample draws it; the cosine
 * is not part of it. */
static inline cs_bsdf_value cs_bsdf_eval(const cs_bsdf_view *view, const cs_vfloat *in)
{
    cs_bsdf_value value = cs_bsdf_nothing();
#define CS_BSDF_EVAL(identifier, name, suffix)                             \
    {                                                                      \
        cs_vint mine = cs_bsdf_lanes(view->surface, CS_BSDF_##identifier); \
        if (CS_BSDF_KINDS == 1 || cs_any(mine)) {                          \
            cs_bsdf_value its = cs_bsdf_eval_##suffix(view, in);           \
            cs_bsdf_take_value(&value, &its, mine);                        \
        }                                                                  \
    }
    CS_BSDF_LIST(CS_BSDF_EVAL)
#undef CS_BSDF_EVAL
    return value;
}

/* An upper bound of the density, per steradian, with which cs_bsdf_sample draws any direction;
 * INFINITY if none is known. */
static inline cs_vfloat cs_bsdf_most_density(const cs_bsdf_view *view)
{
    cs_vint lambert = cs_bsdf_lanes(view->surface, CS_BSDF_LAMBERT);
    cs_vfloat most = lambert ? (cs_vfloat)(CS_INVERSE_PI) : (cs_vfloat)(INFINITY);
#if CS_HAS(MATERIALS)
    cs_vint standard = cs_bsdf_lanes(view->surface, CS_BSDF_STANDARD);
    if (cs_any(standard)) most = standard ? cs_standard_most_density(&view->standard) : most;
#endif
    return most;
}

/* Draws a direction `in` by a point of the unit square and a number, to choose a lobe by, in each
 * lane. */
static inline cs_bsdf_direction cs_bsdf_sample(const cs_bsdf_view *view, cs_pair pair,
                                               cs_vfloat choice)
{
    cs_bsdf_direction drawn;
    drawn.value = cs_bsdf_nothing();
    for (int axis = 0; axis < 3; axis++)
        drawn.in[axis] = view->surface->normal[axis];
#define CS_BSDF_SAMPLE(identifier, name, suffix)                                 \
    {                                                                            \
        cs_vint mine = cs_bsdf_lanes(view->surface, CS_BSDF_##identifier);       \
        if (CS_BSDF_KINDS == 1 || cs_any(mine)) {                                \
            cs_bsdf_direction its = cs_bsdf_sample_##suffix(view, pair, choice); \
            cs_bsdf_take_value(&drawn.value, &its.value, mine);                  \
            for (int axis = 0; axis < 3; axis++)                                 \
                drawn.in[axis] = mine ? its.in[axis] : drawn.in[axis];           \
        }                                                                        \
    }
    CS_BSDF_LIST(CS_BSDF_SAMPLE)
#undef CS_BSDF_SAMPLE
    return drawn;
}

#endif
