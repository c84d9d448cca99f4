/* From what a packet of rays hit to its surfaces. Device only. */
#ifndef CS_HITS_H
#define CS_HITS_H

#include "kernels/bsdf/list.h"
#include "kernels/shape.h"
#include "kernels/surface.h"
#include "kernels/texture.h"
#include "kernels/traverse.h"
#include "kernels/vector.h"

#if CS_HAS(TEXTURES)
/* Texture coordinates at barycentrics (b1, b2). */
static inline void cs_texture_place(const cs_scene_buffers *scene, CS_GLOBAL const cs_face *face,
                                    cs_vfloat b1, cs_vfloat b2, cs_vfloat *s, cs_vfloat *t)
{
    CS_GLOBAL const cs_vertex *v0 = scene->vertices + face->vertex[0];
    CS_GLOBAL const cs_vertex *v1 = scene->vertices + face->vertex[1];
    CS_GLOBAL const cs_vertex *v2 = scene->vertices + face->vertex[2];
    *s = v0->texture[0] + b1 * (v1->texture[0] - v0->texture[0]) +
         b2 * (v2->texture[0] - v0->texture[0]);
    *t = v0->texture[1] + b1 * (v1->texture[1] - v0->texture[1]) +
         b2 * (v2->texture[1] - v0->texture[1]);
}
#endif

#if CS_HAS(COLOURS)
#if CS_HAS(MATERIALS)
/* The alpha of a face's vertices at barycentrics (b1, b2). */
static inline cs_vfloat cs_vertex_alpha(const cs_scene_buffers *scene,
                                        CS_GLOBAL const cs_face *face, cs_vfloat b1, cs_vfloat b2)
{
    cs_f32 a0 = scene->colours[face->vertex[0]].alpha;
    cs_f32 a1 = scene->colours[face->vertex[1]].alpha;
    cs_f32 a2 = scene->colours[face->vertex[2]].alpha;
    return cs_clamp(a0 + b1 * (a1 - a0) + b2 * (a2 - a0), (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
}
#endif

/* Multiplies the albedo of the lanes in `mine` by the vertex colours at barycentrics (b1, b2), and
 * alpha by theirs. */
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
#if CS_HAS(MATERIALS)
    cs_vfloat alpha = surface->alpha * cs_vertex_alpha(scene, face, b1, b2);
    surface->alpha = mine ? alpha : surface->alpha;
#endif
}
#endif

/* A coordinate of a vertex's normal. */
static inline cs_shape_number cs_vertex_normal(const cs_scene_buffers *scene, cs_u32 vertex,
                                               int axis)
{
#if CS_HAS(MOVING)
    return cs_moved(scene->vertices[vertex].normal[axis], scene->normal_steps[vertex].normal[axis],
                    scene->time);
#else
    return scene->vertices[vertex].normal[axis];
#endif
}

/* Interpolates the vertex normals over the lanes in `mine`, turned to the viewer's side. */
static inline void cs_apply_smooth_normal(const cs_scene_buffers *scene,
                                          CS_GLOBAL const cs_face *face, cs_vfloat b1, cs_vfloat b2,
                                          cs_vint mine, cs_surface *surface)
{
    cs_vfloat normal[3];
    for (int axis = 0; axis < 3; axis++) {
        cs_shape_number n0 = cs_vertex_normal(scene, face->vertex[0], axis);
        cs_shape_number n1 = cs_vertex_normal(scene, face->vertex[1], axis);
        cs_shape_number n2 = cs_vertex_normal(scene, face->vertex[2], axis);
        normal[axis] = n0 + b1 * (n1 - n0) + b2 * (n2 - n0);
    }
    cs_vfloat square = cs_dot(normal, normal);
    cs_vfloat scale = 1.0f / sqrt(square);
    scale = cs_dot(normal, surface->outward) < 0.0f ? -scale : scale;
    cs_vint usable = mine & (square > 1e-12f);
    for (int axis = 0; axis < 3; axis++)
        surface->normal[axis] = usable ? scale * normal[axis] : surface->normal[axis];
}

#if CS_HAS(MATERIALS)
/* The BSDF of the lanes in `mine`. */
static inline void cs_describe_bsdf(CS_GLOBAL const cs_material *material, cs_vint mine,
                                    cs_surface *surface)
{
    surface->bsdf = mine ? (cs_vint)((cs_i32)material->bsdf) : surface->bsdf;
    for (int i = 0; i < CS_MATERIAL_PARAMETERS; i++)
        surface->parameters[i] =
            mine ? (cs_vfloat)(material->parameters[i]) : surface->parameters[i];
    surface->alpha = mine ? (cs_vfloat)(material->alpha) : surface->alpha;
}
#endif

#if CS_HAS(TEXTURES)
/* A texture's channels at (s, t), in the lanes that are `mine`; the fourth with the feature
 * MATERIALS only. Textures count from 1; 0 is white. */
static inline void cs_map_at(const cs_scene_buffers *scene, cs_u32 number, cs_vfloat s, cs_vfloat t,
                             cs_vint mine, cs_float_lanes *colour)
{
    cs_int_lanes wanted;
    wanted.all = mine;
    for (int c = 0; c < 4; c++)
        colour[c].all = (cs_vfloat)(1.0f);
    if (number > 0u) cs_texels(scene, number - 1u, s, t, wanted, colour);
}

/* Finds the first axis of a normal map at barycentrics (b1, b2) of a smooth face. `flat` holds the
 * axis of the triangle, at right angles to the normal. Where the vertices have tangents, it becomes
 * their interpolated tangent, which is only nearly at right angles to the normal. Both axes have
 * any length. mirrored: 1 where the texture is mirrored, else 0. */
static inline void cs_smooth_tangent(const cs_scene_buffers *scene, CS_GLOBAL const cs_face *face,
                                     cs_vfloat b1, cs_vfloat b2, cs_u32 mirrored, cs_vfloat *flat)
{
    CS_GLOBAL const cs_f32 *t0 = scene->tangents[2u * face->vertex[0] + mirrored].value;
    CS_GLOBAL const cs_f32 *t1 = scene->tangents[2u * face->vertex[1] + mirrored].value;
    CS_GLOBAL const cs_f32 *t2 = scene->tangents[2u * face->vertex[2] + mirrored].value;
    cs_vfloat tangent[3];
    for (int i = 0; i < 3; i++)
        tangent[i] = t0[i] + b1 * (t1[i] - t0[i]) + b2 * (t2[i] - t0[i]);
    cs_vint usable = cs_dot(tangent, tangent) > 1e-4f;
    for (int i = 0; i < 3; i++)
        flat[i] = usable ? tangent[i] : flat[i];
}

/* Bends the normal of the lanes in `mine` as a normal map says, whose axes are those of the texture
 * on the triangle, at barycentrics (b1, b2) (glTF 2.0, material.normalTexture). The normal stays on
 * the viewer's side. */
static inline void cs_apply_normal_map(const cs_scene_buffers *scene, const cs_shape *shape,
                                       CS_GLOBAL const cs_triangle *triangle, cs_vfloat b1,
                                       cs_vfloat b2, const cs_float_lanes *map, cs_f32 scale,
                                       cs_vint mine, cs_surface *surface)
{
    CS_GLOBAL const cs_face *face = scene->faces + triangle->face;
    CS_GLOBAL const cs_f32 *t0 = scene->vertices[face->vertex[0]].texture;
    CS_GLOBAL const cs_f32 *t1 = scene->vertices[face->vertex[1]].texture;
    CS_GLOBAL const cs_f32 *t2 = scene->vertices[face->vertex[2]].texture;
    cs_f32 s1 = t1[0] - t0[0], s2 = t2[0] - t0[0], u1 = t1[1] - t0[1], u2 = t2[1] - t0[1];
    cs_f32 sign = s1 * u2 - s2 * u1 < 0.0f ? -1.0f : 1.0f;
    cs_vfloat x = (2.0f * map[0].all - 1.0f) * scale, y = (2.0f * map[1].all - 1.0f) * scale;
    cs_vfloat z = 2.0f * map[2].all - 1.0f, along[3], up[3], bent[3];
    const cs_vfloat *n = surface->normal;
    for (int i = 0; i < 3; i++)
        along[i] = (cs_vfloat)(sign * (shape->edge1[i] * u2 - shape->edge2[i] * u1));
    cs_vfloat off = cs_dot(along, n);
    for (int i = 0; i < 3; i++)
        along[i] -= off * n[i];
#if !CS_HAS(MOVING) /* there the triangle's own, which moves with it */
    if (triangle->flags & CS_FACE_SMOOTH)
        cs_smooth_tangent(scene, face, b1, b2, sign < 0.0f ? 1u : 0u, along);
#else
    (void)b1;
    (void)b2;
#endif
    cs_vfloat square = cs_dot(along, along);
    cs_vint usable = mine & (square > 1e-30f);
    cs_vfloat inverse = 1.0f / sqrt(cs_max(square, (cs_vfloat)(1e-30f)));
    /* Seen from behind, the whole bent normal is reversed; z goes with the normal already. */
    cs_vfloat facing = surface->outward[0] * shape->normal[0] +
                       surface->outward[1] * shape->normal[1] +
                       surface->outward[2] * shape->normal[2];
    facing = facing < 0.0f ? (cs_vfloat)(-1.0f) : (cs_vfloat)(1.0f);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        up[i] = sign * (n[j] * along[k] - n[k] * along[j]);
        bent[i] = (x * facing * along[i] + y * up[i]) * inverse + z * n[i];
    }
    inverse = 1.0f / sqrt(cs_max(cs_dot(bent, bent), (cs_vfloat)(1e-30f)));
    usable = usable & (cs_dot(bent, surface->outward) > 0.0f);
    for (int i = 0; i < 3; i++)
        surface->normal[i] = usable ? bent[i] * inverse : surface->normal[i];
}

/* Everything that the material's textures say of the lanes in `mine`. */
static inline void cs_apply_textures(const cs_scene_buffers *scene,
                                     CS_GLOBAL const cs_triangle *triangle, const cs_shape *shape,
                                     cs_vfloat b1, cs_vfloat b2, cs_vint mine, cs_surface *surface)
{
    CS_GLOBAL const cs_material *material = scene->materials + triangle->material;
    cs_vfloat s, t;
    cs_float_lanes map[4];
    cs_texture_place(scene, scene->faces + triangle->face, b1, b2, &s, &t);
    cs_map_at(scene, (cs_u32)(material->texture + 1), s, t, mine, map);
    for (int c = 0; c < 3; c++)
        surface->albedo[c] = mine ? surface->albedo[c] * map[c].all : surface->albedo[c];
#if CS_HAS(MATERIALS)
    surface->alpha = mine ? surface->alpha * map[3].all : surface->alpha;
    cs_map_at(scene, material->emission_texture, s, t, mine, map);
    for (int c = 0; c < 3; c++)
        surface->emission[c] = mine ? surface->emission[c] * map[c].all : surface->emission[c];
    cs_map_at(scene, material->facets_texture, s, t, mine, map);
    cs_vfloat *p = surface->parameters;
    p[CS_PARAMETER_ROUGHNESS] =
        mine ? p[CS_PARAMETER_ROUGHNESS] * map[1].all : p[CS_PARAMETER_ROUGHNESS];
    p[CS_PARAMETER_METALLIC] =
        mine ? p[CS_PARAMETER_METALLIC] * map[2].all : p[CS_PARAMETER_METALLIC];
    if (material->normal_texture == 0u) return;
    cs_map_at(scene, material->normal_texture, s, t, mine, map);
    cs_apply_normal_map(scene, shape, triangle, b1, b2, map, material->normal_scale, mine, surface);
#else
    (void)shape;
#endif
}
#endif

#if CS_HAS(MATERIALS)
/* From alpha to the chance that a ray stops. */
static inline cs_vfloat cs_covering(CS_GLOBAL const cs_material *material, cs_vfloat alpha)
{
    cs_vfloat covers = (cs_vfloat)(1.0f);
    if (material->flags & CS_MATERIAL_BLEND) covers = alpha;
    if (material->flags & CS_MATERIAL_MASK)
        covers = alpha >= material->cutoff ? (cs_vfloat)(1.0f) : (cs_vfloat)(0.0f);
    return covers;
}

/* Does so, and makes emission of unlit surfaces. */
static inline void cs_finish_material(CS_GLOBAL const cs_material *material, cs_vint mine,
                                      cs_surface *surface)
{
    surface->alpha = mine ? cs_covering(material, surface->alpha) : surface->alpha;
    if (material->emission_texture > 0u || material->flags != 0u)
        surface->shines_to = mine ? (cs_vint)(CS_SHINES_RAYS) : surface->shines_to;
    if (!(material->flags & CS_MATERIAL_UNLIT)) return;
    surface->shines_to = mine ? (cs_vint)(CS_SHINES_CAMERA) : surface->shines_to;
    surface->bsdf = mine ? (cs_vint)(CS_BSDF_LAMBERT) : surface->bsdf; /* and black */
    for (int c = 0; c < 3; c++) {
        surface->emission[c] = mine ? surface->albedo[c] : surface->emission[c];
        surface->albedo[c] = mine ? (cs_vfloat)(0.0f) : surface->albedo[c];
    }
}
#endif

/* Interpolates normal, textures and colour between a triangle's vertices, in the lanes of `mine`.
 * They all hit that triangle, at surface->point. square: squared length of shape->normal. */
static inline void cs_apply_vertices(const cs_scene_buffers *scene,
                                     CS_GLOBAL const cs_triangle *triangle, const cs_shape *shape,
                                     cs_shape_number square, cs_vint mine, cs_surface *surface)
{
    const cs_shape_number *n = shape->normal;
    cs_vfloat x = surface->point[0] - shape->corner[0];
    cs_vfloat y = surface->point[1] - shape->corner[1];
    cs_vfloat z = surface->point[2] - shape->corner[2];
    cs_shape_number inverse = 1.0f / square;
    const cs_shape_number *e1 = shape->edge1;
    const cs_shape_number *e2 = shape->edge2;
    cs_vfloat b1 = (x * (e2[1] * n[2] - e2[2] * n[1]) + y * (e2[2] * n[0] - e2[0] * n[2]) +
                    z * (e2[0] * n[1] - e2[1] * n[0])) *
                   inverse;
    cs_vfloat b2 = (x * (n[1] * e1[2] - n[2] * e1[1]) + y * (n[2] * e1[0] - n[0] * e1[2]) +
                    z * (n[0] * e1[1] - n[1] * e1[0])) *
                   inverse;
    CS_GLOBAL const cs_face *face = scene->faces + triangle->face;
    if (triangle->flags & CS_FACE_SMOOTH)
        cs_apply_smooth_normal(scene, face, b1, b2, mine, surface);
#if CS_HAS(TEXTURES)
    if (triangle->flags & CS_FACE_TEXTURED)
        cs_apply_textures(scene, triangle, shape, b1, b2, mine, surface);
#endif
#if CS_HAS(COLOURS)
    if (triangle->flags & CS_FACE_COLOURED) cs_apply_colour(scene, face, b1, b2, mine, surface);
#endif
}

/* Fills in the lanes in `mine`, which all hit triangle number `index`. */
static inline void cs_describe_triangle(const cs_scene_buffers *scene, const cs_ray *ray,
                                        cs_i32 index, cs_vint mine, cs_surface *surface)
{
    CS_GLOBAL const cs_triangle *triangle = scene->triangles + index;
    CS_GLOBAL const cs_material *material = scene->materials + triangle->material;
    const cs_shape shape = CS_SHAPE_AT(scene, index);
    const cs_shape_number *n = shape.normal;
    cs_shape_number square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    cs_shape_number scale = 1.0f / sqrt(square);
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
#if CS_HAS(EMITTERS)
    surface->emitter = mine ? (cs_vint)((cs_i32)triangle->emitter) : surface->emitter;
#endif
#if CS_HAS(MATERIALS)
    cs_describe_bsdf(material, mine, surface);
    surface->inside = mine ? (cs_vint)(along > 0.0f) : surface->inside;
#endif
    if (triangle->flags != 0u) cs_apply_vertices(scene, triangle, &shape, square, mine, surface);
#if CS_HAS(MATERIALS)
    cs_finish_material(material, mine, surface);
#endif
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
#if CS_HAS(EMITTERS)
    surface.emitter = (cs_vint)(0);
#endif
#if CS_HAS(MATERIALS)
    surface.bsdf = (cs_vint)(0);
    for (int i = 0; i < CS_MATERIAL_PARAMETERS; i++)
        surface.parameters[i] = (cs_vfloat)(0.0f);
    surface.alpha = (cs_vfloat)(1.0f);
    surface.inside = (cs_vint)(0);
    surface.shines_to = (cs_vint)(CS_SHINES_SAMPLED);
    surface.albedos = scene->albedos;
#endif
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
