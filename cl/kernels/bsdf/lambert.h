/* Lambert's diffuse surface: the same radiance in all directions. Shared. */
#ifndef CS_BSDF_LAMBERT_H
#define CS_BSDF_LAMBERT_H

#include "clshear/device/disk.h"
#include "kernels/bsdf/value.h"

static inline cs_bsdf_value cs_bsdf_eval_lambert(const cs_bsdf_view *view, const cs_vfloat *in)
{
    const cs_surface *surface = view->surface;
    cs_bsdf_value value;
    value.scale = (cs_vfloat)(CS_INVERSE_PI);
    for (int c = 0; c < 3; c++)
        value.colour[c] = surface->albedo[c];
    cs_vfloat along =
        in[0] * surface->normal[0] + in[1] * surface->normal[1] + in[2] * surface->normal[2];
    cs_vfloat square = in[0] * in[0] + in[1] * in[1] + in[2] * in[2];
    value.density = cs_max(along, (cs_vfloat)(0.0f)) * CS_INVERSE_PI /
                    cs_sqrt(cs_max(square, (cs_vfloat)(1e-30f)));
    return value;
}

/* A direction with a density that is proportional to the cosine: a uniform point of the disk,
 * lifted to the hemisphere (Malley). Returns the density. */
static inline cs_vfloat cs_draw_diffuse(const cs_surface *surface, cs_pair pair, cs_vfloat *in)
{
    cs_vfloat tangent[3];
    tangent[0] = pair.x - 0.5f;
    tangent[1] = pair.y - 0.5f;
    cs_disk_from_square(&tangent[0], &tangent[1]);
    tangent[0] /= CS_DISK_RADIUS;
    tangent[1] /= CS_DISK_RADIUS;
    cs_vfloat square = 1.0f - tangent[0] * tangent[0] - tangent[1] * tangent[1];
    tangent[2] = cs_sqrt(cs_max(square, (cs_vfloat)(0.0f)));
    cs_from_local(surface->normal, tangent, in);
    return tangent[2] * CS_INVERSE_PI;
}

static inline cs_bsdf_direction cs_bsdf_sample_lambert(const cs_bsdf_view *view, cs_pair pair,
                                                       cs_vfloat choice)
{
    cs_bsdf_direction drawn;
    (void)choice;
    cs_vfloat density = cs_draw_diffuse(view->surface, pair, drawn.in);
    drawn.value = cs_bsdf_eval_lambert(view, drawn.in);
    drawn.value.density = density;
    return drawn;
}

#endif
