/* What a packet of hits looks like, and the light it reflects. Device only.
 *
 * Lambertian surfaces, two-sided; direct light with shadow rays; emission seen directly counts. */
#ifndef CS_KERNELS_SHADE_H
#define CS_KERNELS_SHADE_H

#include "clshear/device/sampler/grid.h"
#include "kernels/traverse.h"

/* The buffers of a scene, as the kernel's arguments name them. */
typedef struct cs_scene_buffers {
    CS_GLOBAL const cs_node *nodes;
    CS_GLOBAL const cs_triangle *triangles;
    CS_GLOBAL const cs_face *faces;
    CS_GLOBAL const cs_vertex *vertices;
    CS_GLOBAL const cs_material *materials;
    CS_GLOBAL const cs_texture *textures;
    CS_GLOBAL const half *texels;
    CS_GLOBAL const cs_light *lights;
    CS_GLOBAL const cs_emitter *emitters;
} cs_scene_buffers;

typedef struct cs_surface {
    cs_vint hit;
    cs_vfloat point[3];
    cs_vfloat outward[3]; /* unit geometric normal on the viewer's side */
    cs_vfloat normal[3];  /* unit shading normal on the viewer's side */
    cs_vfloat albedo[3];
    cs_vfloat emission[3];
} cs_surface;

static inline cs_vfloat cs_dot(const cs_vfloat *a, const cs_vfloat *b)
{
    return fma(a[0], b[0], fma(a[1], b[1], a[2] * b[2]));
}

/* Between which two of `size` texels the repeating coordinate `place` lies, and how far on. */
typedef struct cs_texel_pair {
    cs_int_lanes first;
    cs_int_lanes second;
    cs_float_lanes part;
} cs_texel_pair;

static inline cs_texel_pair cs_texels_at(cs_vfloat place, cs_u32 size)
{
    cs_f32 last = (cs_f32)size - 1.0f;
    cs_vfloat centre = (place - floor(place)) * (cs_f32)size - 0.5f;
    cs_vfloat before = floor(centre);
    /* Rounding may reach the far edge; the limits also hold what huge coordinates give. */
    cs_vfloat first = before < 0.0f ? (cs_vfloat)(last) : cs_min(before, (cs_vfloat)(last));
    cs_vfloat second =
        before + 1.0f > last ? (cs_vfloat)(0.0f) : cs_max(before + 1.0f, (cs_vfloat)(0.0f));
    cs_texel_pair pair;
    pair.first.all = CS_OVER_LANES(convert_int)(first);
    pair.second.all = CS_OVER_LANES(convert_int)(cs_min(second, (cs_vfloat)(last)));
    pair.part.all = centre - before;
    return pair;
}

/* Bilinear, repeating, at the texture coordinates (s, t) of the lanes that are `wanted`; (0, 0) is
 * the lower left corner of the image. */
static inline void cs_texels(const cs_scene_buffers *scene, cs_u32 texture, cs_vfloat s,
                             cs_vfloat t, cs_int_lanes wanted, cs_float_lanes *colour)
{
    CS_GLOBAL const cs_texture *image = scene->textures + texture;
    cs_texel_pair x = cs_texels_at(s, image->width);
    cs_texel_pair y = cs_texels_at(1.0f - (t - floor(t)), image->height);
    y.first.all *= (cs_i32)image->width;
    y.second.all *= (cs_i32)image->width;
    CS_GLOBAL const half *texels = scene->texels + 4u * (size_t)image->first;
    for (int lane = 0; lane < CS_PACKET; lane++) {
        if (!wanted.lane[lane]) continue;
        size_t left = (size_t)x.first.lane[lane], right = (size_t)x.second.lane[lane];
        size_t above = (size_t)y.first.lane[lane], below = (size_t)y.second.lane[lane];
        cs_f32 across = x.part.lane[lane];
        float4 upper =
            mix(vload_half4(above + left, texels), vload_half4(above + right, texels), across);
        float4 lower =
            mix(vload_half4(below + left, texels), vload_half4(below + right, texels), across);
        float4 value = mix(upper, lower, y.part.lane[lane]);
        colour[0].lane[lane] = value.x;
        colour[1].lane[lane] = value.y;
        colour[2].lane[lane] = value.z;
    }
}

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

typedef struct cs_radiance {
    cs_vfloat channel[3];
    cs_vfloat shadow_rays; /* traced, a lane */
} cs_radiance;

/* Adds the light of something that lies `towards` from the surface (not normalised, its end at
 * distance `reach`) with the unshadowed irradiance per unit of `colour` in `weight`. The shadow ray
 * begins at `origin`, off the surface, and ends in the same place: what the light gives does not
 * shift. */
static inline void cs_add_light(const cs_scene_buffers *scene, const cs_surface *surface,
                                const cs_vfloat *origin, const cs_vfloat *towards, cs_f32 reach,
                                cs_vfloat weight, const cs_vfloat *colour, cs_radiance *radiance)
{
    cs_vint facing = surface->hit & (weight > 0.0f) & (cs_dot(surface->outward, towards) > 0.0f);
    if (!cs_any(facing)) return;
    cs_ray shadow;
    for (int axis = 0; axis < 3; axis++) {
        shadow.origin[axis] = origin[axis];
        shadow.direction[axis] = towards[axis];
        if (reach < INFINITY) shadow.direction[axis] += surface->point[axis] - origin[axis];
    }
    cs_hit blocked;
    blocked.distance = facing ? (cs_vfloat)(reach) : (cs_vfloat)(-1.0f);
    cs_traverse(scene->nodes, scene->triangles, &shadow, 1, &blocked);
    weight = blocked.distance > 0.0f ? weight * CS_INVERSE_PI : (cs_vfloat)(0.0f);
    for (int c = 0; c < 3; c++)
        radiance->channel[c] += weight * colour[c] * surface->albedo[c];
    radiance->shadow_rays += facing ? (cs_vfloat)(1.0f) : (cs_vfloat)(0.0f);
}

static inline void cs_add_delta_light(const cs_scene_buffers *scene, const cs_surface *surface,
                                      const cs_vfloat *origin, CS_GLOBAL const cs_light *light,
                                      cs_radiance *radiance)
{
    cs_vfloat towards[3], colour[3];
    int point = light->kind == CS_LIGHT_POINT;
    for (int axis = 0; axis < 3; axis++) {
        towards[axis] =
            point ? light->vector[axis] - surface->point[axis] : (cs_vfloat)(light->vector[axis]);
        colour[axis] = (cs_vfloat)(light->colour[axis]);
    }
    cs_vfloat cosine = cs_dot(surface->normal, towards);
    cs_vfloat square = cs_max(cs_dot(towards, towards), (cs_vfloat)(1e-30f));
    cs_vfloat weight = point ? cosine / (square * sqrt(square)) : cosine;
    cs_add_light(scene, surface, origin, towards, point ? 1.0f : INFINITY, weight, colour,
                 radiance);
}

/* First emitter whose cumulative probability exceeds `target`. */
static inline cs_u32 cs_pick_emitter(CS_GLOBAL const cs_emitter *emitters, cs_u32 count,
                                     cs_f32 target)
{
    cs_u32 low = 0u, high = count - 1u;
    while (low < high) {
        cs_u32 middle = (low + high) / 2u;
        if (emitters[middle].cumulative > target)
            high = middle;
        else
            low = middle + 1u;
    }
    return low;
}

/* One sample of all emissive triangles together: emitter in proportion to its power, then a uniform
 * point by the square-root map (Turk 1990). `sample` is stratified; choosing the emitter from its
 * first coordinate and stretching the rest keeps it so. */
static inline void cs_add_emitters(const cs_scene_buffers *scene, cs_u32 count,
                                   const cs_surface *surface, const cs_vfloat *origin,
                                   cs_pair sample, cs_radiance *radiance)
{
    cs_float_lanes a, b, end[3], normal[3], colour[3], density;
    a.all = sample.x;
    b.all = sample.y;
    for (int lane = 0; lane < CS_PACKET; lane++) {
        CS_GLOBAL const cs_emitter *emitter =
            scene->emitters + cs_pick_emitter(scene->emitters, count, a.lane[lane]);
        cs_f32 below = emitter->cumulative - emitter->probability;
        cs_f32 stretched = clamp((a.lane[lane] - below) / emitter->probability, 0.0f, 1.0f);
        cs_f32 root = sqrt(stretched);
        cs_f32 b1 = root * (1.0f - b.lane[lane]), b2 = root * b.lane[lane];
        CS_GLOBAL const cs_f32 *e1 = emitter->edge1;
        CS_GLOBAL const cs_f32 *e2 = emitter->edge2;
        for (int axis = 0; axis < 3; axis++) {
            int next = (axis + 1) % 3, last = (axis + 2) % 3;
            end[axis].lane[lane] = emitter->corner[axis] + b1 * e1[axis] + b2 * e2[axis];
            normal[axis].lane[lane] =
                (e1[next] * e2[last] - e1[last] * e2[next]) * 0.5f / emitter->area;
            colour[axis].lane[lane] = emitter->radiance[axis];
        }
        density.lane[lane] = emitter->probability / emitter->area;
    }
    cs_vfloat towards[3], light_normal[3], light_colour[3];
    for (int axis = 0; axis < 3; axis++) {
        towards[axis] = end[axis].all - surface->point[axis];
        light_normal[axis] = normal[axis].all;
        light_colour[axis] = colour[axis].all;
    }
    cs_vfloat square = cs_max(cs_dot(towards, towards), (cs_vfloat)(1e-30f));
    cs_vfloat cosines = cs_dot(surface->normal, towards) * fabs(cs_dot(light_normal, towards));
    cs_vfloat weight = cosines / (square * square * density.all);
    cs_add_light(scene, surface, origin, towards, 0.9999f, weight, light_colour, radiance);
}

/* Radiance that arrives at the lens along each ray; `emitter_sample` is used if there are any. */
static inline cs_radiance cs_radiance_along(const cs_scene_buffers *scene, cs_u32 lights,
                                            cs_u32 emitters, const cs_ray *ray,
                                            cs_pair emitter_sample, cs_vint active)
{
    cs_hit hit;
    hit.distance = active ? (cs_vfloat)(INFINITY) : (cs_vfloat)(-1.0f);
    cs_traverse(scene->nodes, scene->triangles, ray, 0, &hit);
    cs_radiance radiance;
    radiance.shadow_rays = (cs_vfloat)(0.0f);
    for (int c = 0; c < 3; c++)
        radiance.channel[c] = (cs_vfloat)(0.0f);
    cs_vint seen = hit.triangle >= 0;
    if (!cs_any(seen)) return radiance;
    hit.distance = seen ? hit.distance : (cs_vfloat)(0.0f);
    cs_surface surface = cs_describe_hits(scene, ray, &hit);
    for (int c = 0; c < 3; c++)
        radiance.channel[c] = surface.emission[c];
    cs_vfloat origin[3];
    cs_leave_surface(&surface, hit.distance, origin);
    for (cs_u32 light = 0u; light < lights; light++)
        cs_add_delta_light(scene, &surface, origin, scene->lights + light, &radiance);
    if (emitters > 0u)
        cs_add_emitters(scene, emitters, &surface, origin, emitter_sample, &radiance);
    return radiance;
}

#endif
