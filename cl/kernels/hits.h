/* From what a packet of rays hit to its surfaces. Device only. */
#ifndef CS_HITS_H
#define CS_HITS_H

#include "kernels/surface.h"
#include "kernels/texture.h"
#include "kernels/traverse.h"
#include "kernels/vector.h"

/* Multiplies the albedo of the lanes in `mine` by the texture at barycentrics (b1, b2). */
static inline void cs_apply_texture(const cs_scene_buffers *scene, CS_GLOBAL const cs_face *face,
                                    cs_u32 texture, cs_vfloat b1, cs_vfloat b2, cs_vint mine,
                                    cs_surface *surface)
{
    CS_GLOBAL const cs_vertex *v0 = scene->vertices + face->vertex[0];
    CS_GLOBAL const cs_vertex *v1 = scene->vertices + face->vertex[1];
    CS_GLOBAL const cs_vertex *v2 = scene->vertices + face->vertex[2];
    cs_vfloat s = v0->texture[0] + b1 * (v1->texture[0] - v0->texture[0]) +
                  b2 * (v2->texture[0] - v0->texture[0]);
    cs_vfloat t = v0->texture[1] + b1 * (v1->texture[1] - v0->texture[1]) +
                  b2 * (v2->texture[1] - v0->texture[1]);
    cs_float_lanes colour[3];
    cs_int_lanes wanted;
    wanted.all = mine;
    for (int c = 0; c < 3; c++)
        colour[c].all = (cs_vfloat)(0.0f);
    cs_texels(scene, texture, s, t, wanted, colour);
    for (int c = 0; c < 3; c++)
        surface->albedo[c] = mine ? surface->albedo[c] * colour[c].all : surface->albedo[c];
}

/* Multiplies the albedo of the lanes in `mine` by the vertex colours at barycentrics (b1, b2). */
static inline void cs_apply_colour(const cs_scene_buffers *scene, CS_GLOBAL const cs_face *face,
                                   cs_vfloat b1, cs_vfloat b2, cs_vint mine, cs_surface *surface)
{
    CS_GLOBAL const cs_f32 *c0 = scene->colours[face->vertex[0]].value;
    CS_GLOBAL const cs_f32 *c1 = scene->colours[face->vertex[1]].value;
    CS_GLOBAL const cs_f32 *c2 = scene->colours[face->vertex[2]].value;
    for (int c = 0; c < 3; c++) {
        cs_vfloat colour = c0[c] + b1 * (c1[c] - c0[c]) + b2 * (c2[c] - c0[c]);
        surface->albedo[c] =
            mine ? surface->albedo[c] * cs_max(colour, (cs_vfloat)(0.0f)) : surface->albedo[c];
    }
}

/* Interpolates the vertex normals over the lanes in `mine`, turned to the viewer's side. */
static inline void cs_apply_smooth_normal(const cs_scene_buffers *scene,
                                          CS_GLOBAL const cs_face *face, cs_vfloat b1, cs_vfloat b2,
                                          cs_vint mine, cs_surface *surface)
{
    CS_GLOBAL const cs_vertex *v0 = scene->vertices + face->vertex[0];
    CS_GLOBAL const cs_vertex *v1 = scene->vertices + face->vertex[1];
    CS_GLOBAL const cs_vertex *v2 = scene->vertices + face->vertex[2];
    cs_vfloat normal[3];
    for (int axis = 0; axis < 3; axis++)
        normal[axis] = v0->normal[axis] + b1 * (v1->normal[axis] - v0->normal[axis]) +
                       b2 * (v2->normal[axis] - v0->normal[axis]);
    cs_vfloat square = cs_dot(normal, normal);
    cs_vfloat scale = 1.0f / sqrt(square);
    scale = cs_dot(normal, surface->outward) < 0.0f ? -scale : scale;
    cs_vint usable = mine & (square > 1e-12f);
    for (int axis = 0; axis < 3; axis++)
        surface->normal[axis] = usable ? scale * normal[axis] : surface->normal[axis];
}

/* The BSDF of the lanes in `mine`. What no kind reads is not loaded: the compiler sees to that. */
static inline void cs_describe_bsdf(CS_GLOBAL const cs_material *material, cs_vint mine,
                                    cs_surface *surface)
{
    surface->bsdf = mine ? (cs_vint)((cs_i32)material->bsdf) : surface->bsdf;
    for (int i = 0; i < CS_MATERIAL_PARAMETERS; i++)
        surface->parameters[i] =
            mine ? (cs_vfloat)(material->parameters[i]) : surface->parameters[i];
}

/* Fills in the lanes in `mine`, which all hit triangle number `index`. */
static inline void cs_describe_triangle(const cs_scene_buffers *scene, const cs_ray *ray,
                                        cs_i32 index, cs_vint mine, cs_surface *surface)
{
    CS_GLOBAL const cs_triangle *triangle = scene->triangles + index;
    CS_GLOBAL const cs_material *material = scene->materials + triangle->material;
    CS_GLOBAL const cs_f32 *n = triangle->normal;
    cs_f32 square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    cs_f32 scale = 1.0f / sqrt(square);
    cs_vfloat along = fma((cs_vfloat)(n[0]), ray->direction[0],
                          fma((cs_vfloat)(n[1]), ray->direction[1], n[2] * ray->direction[2]));
    cs_vfloat towards = along > 0.0f ? (cs_vfloat)(-scale) : (cs_vfloat)(scale);
    for (int axis = 0; axis < 3; axis++) {
        surface->outward[axis] = mine ? towards * n[axis] : surface->outward[axis];
        surface->normal[axis] = mine ? surface->outward[axis] : surface->normal[axis];
        surface->albedo[axis] = mine ? (cs_vfloat)(material->diffuse[axis]) : surface->albedo[axis];
        surface->emission[axis] =
            mine ? (cs_vfloat)(material->emission[axis]) : surface->emission[axis];
    }
    cs_describe_bsdf(material, mine, surface);
    if (triangle->flags == 0u) return;

    cs_vfloat x = surface->point[0] - triangle->corner[0];
    cs_vfloat y = surface->point[1] - triangle->corner[1];
    cs_vfloat z = surface->point[2] - triangle->corner[2];
    cs_f32 inverse = 1.0f / square;
    CS_GLOBAL const cs_f32 *e1 = triangle->edge1;
    CS_GLOBAL const cs_f32 *e2 = triangle->edge2;
    cs_vfloat b1 = (x * (e2[1] * n[2] - e2[2] * n[1]) + y * (e2[2] * n[0] - e2[0] * n[2]) +
                    z * (e2[0] * n[1] - e2[1] * n[0])) *
                   inverse;
    cs_vfloat b2 = (x * (n[1] * e1[2] - n[2] * e1[1]) + y * (n[2] * e1[0] - n[0] * e1[2]) +
                    z * (n[0] * e1[1] - n[1] * e1[0])) *
                   inverse;
    CS_GLOBAL const cs_face *face = scene->faces + triangle->face;
    if (triangle->flags & CS_FACE_SMOOTH)
        cs_apply_smooth_normal(scene, face, b1, b2, mine, surface);
    if (triangle->flags & CS_FACE_TEXTURED)
        cs_apply_texture(scene, face, (cs_u32)material->texture, b1, b2, mine, surface);
    if (triangle->flags & CS_FACE_COLOURED) cs_apply_colour(scene, face, b1, b2, mine, surface);
}

/* The surfaces that a packet hit, one distinct triangle after another: mostly there are few. */
static inline cs_surface cs_describe_hits(const cs_scene_buffers *scene, const cs_ray *ray,
                                          const cs_hit *hit)
{
    cs_surface surface;
    surface.hit = hit->triangle >= 0;
    for (int axis = 0; axis < 3; axis++) {
        surface.point[axis] = fma(ray->direction[axis], hit->distance, ray->origin[axis]);
        surface.outward[axis] = (cs_vfloat)(0.0f);
        surface.normal[axis] = (cs_vfloat)(0.0f);
        surface.albedo[axis] = (cs_vfloat)(0.0f);
        surface.emission[axis] = (cs_vfloat)(0.0f);
    }
    surface.bsdf = (cs_vint)(0);
    for (int i = 0; i < CS_MATERIAL_PARAMETERS; i++)
        surface.parameters[i] = (cs_vfloat)(0.0f);
    cs_vint left = hit->triangle;
    for (cs_i32 index = cs_reduce_max(left); index >= 0; index = cs_reduce_max(left)) {
        cs_vint mine = left == (cs_vint)(index);
        cs_describe_triangle(scene, ray, index, mine, &surface);
        left = mine ? (cs_vint)(CS_NO_HIT) : left;
    }
    return surface;
}

/* Origins of rays that leave a surface: off it by more than the rounding of the hit point, which
 * grows with its coordinates and the distance travelled. */
static inline void cs_leave_surface(const cs_surface *surface, cs_vfloat distance,
                                    cs_vfloat *origin)
{
    cs_vfloat size = cs_max(cs_max(fabs(surface->point[0]), fabs(surface->point[1])),
                            cs_max(fabs(surface->point[2]), distance));
    cs_vfloat step = size * 3e-5f;
    for (int axis = 0; axis < 3; axis++)
        origin[axis] = fma(surface->outward[axis], step, surface->point[axis]);
}

#endif
