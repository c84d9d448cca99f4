/* What a packet of hits looks like, and the light it reflects. Device only.
 *
 * Lambertian surfaces, two-sided; direct light with shadow rays; emission seen directly counts. */
#ifndef CS_SHADE_H
#define CS_SHADE_H

#include "traverse.h"

/* The buffers of a scene, as the kernel's arguments name them. */
typedef struct cs_world {
    CS_GLOBAL const cs_node *nodes;
    CS_GLOBAL const cs_triangle *triangles;
    CS_GLOBAL const cs_face *faces;
    CS_GLOBAL const cs_vertex *vertices;
    CS_GLOBAL const cs_material *materials;
    CS_GLOBAL const cs_texture *textures;
    CS_GLOBAL const half *texels;
    CS_GLOBAL const cs_light *lights;
    CS_GLOBAL const cs_emitter *emitters;
} cs_world;

typedef struct cs_surface {
    vint hit;
    vfloat point[3];
    vfloat outward[3]; /* unit geometric normal on the viewer's side */
    vfloat normal[3];  /* unit shading normal on the viewer's side */
    vfloat albedo[3];
    vfloat emission[3];
} cs_surface;

static inline vfloat cs_dot(const vfloat *a, const vfloat *b)
{
    return fma(a[0], b[0], fma(a[1], b[1], a[2] * b[2]));
}

/* Between which two of `size` texels the repeating coordinate `place` lies, and how far on. */
typedef struct cs_texel_pair {
    cs_int_lanes first;
    cs_int_lanes second;
    cs_float_lanes part;
} cs_texel_pair;

static inline cs_texel_pair cs_texels_at(vfloat place, u32 size)
{
    f32 last = (f32)size - 1.0f;
    vfloat centre = (place - floor(place)) * (f32)size - 0.5f;
    vfloat before = floor(centre);
    /* Rounding may reach the far edge; the limits also hold what huge coordinates give. */
    vfloat first = before < 0.0f ? (vfloat)(last) : cs_min(before, (vfloat)(last));
    vfloat second = before + 1.0f > last ? (vfloat)(0.0f) : cs_max(before + 1.0f, (vfloat)(0.0f));
    cs_texel_pair pair;
    pair.first.all = CS_OVER_LANES(convert_int)(first);
    pair.second.all = CS_OVER_LANES(convert_int)(cs_min(second, (vfloat)(last)));
    pair.part.all = centre - before;
    return pair;
}

/* Bilinear, repeating, at the texture coordinates (s, t) of the lanes that are `wanted`; (0, 0) is
 * the lower left corner of the image. */
static inline void cs_texels(const cs_world *world, u32 texture, vfloat s, vfloat t,
                             cs_int_lanes wanted, cs_float_lanes *colour)
{
    CS_GLOBAL const cs_texture *image = world->textures + texture;
    cs_texel_pair x = cs_texels_at(s, image->width);
    cs_texel_pair y = cs_texels_at(1.0f - (t - floor(t)), image->height);
    y.first.all *= (i32)image->width;
    y.second.all *= (i32)image->width;
    CS_GLOBAL const half *texels = world->texels + 4u * (size_t)image->first;
    for (int lane = 0; lane < CS_PACKET; lane++) {
        if (!wanted.lane[lane]) continue;
        size_t left = (size_t)x.first.lane[lane], right = (size_t)x.second.lane[lane];
        size_t above = (size_t)y.first.lane[lane], below = (size_t)y.second.lane[lane];
        f32 across = x.part.lane[lane];
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
static inline void cs_apply_texture(const cs_world *world, CS_GLOBAL const cs_face *face,
                                    u32 texture, vfloat b1, vfloat b2, vint mine,
                                    cs_surface *surface)
{
    CS_GLOBAL const cs_vertex *v0 = world->vertices + face->vertex[0];
    CS_GLOBAL const cs_vertex *v1 = world->vertices + face->vertex[1];
    CS_GLOBAL const cs_vertex *v2 = world->vertices + face->vertex[2];
    vfloat s = v0->texture[0] + b1 * (v1->texture[0] - v0->texture[0]) +
               b2 * (v2->texture[0] - v0->texture[0]);
    vfloat t = v0->texture[1] + b1 * (v1->texture[1] - v0->texture[1]) +
               b2 * (v2->texture[1] - v0->texture[1]);
    cs_float_lanes colour[3];
    cs_int_lanes wanted;
    wanted.all = mine;
    for (int c = 0; c < 3; c++)
        colour[c].all = (vfloat)(0.0f);
    cs_texels(world, texture, s, t, wanted, colour);
    for (int c = 0; c < 3; c++)
        surface->albedo[c] = mine ? surface->albedo[c] * colour[c].all : surface->albedo[c];
}

/* Interpolates the vertex normals over the lanes in `mine`, turned to the viewer's side. */
static inline void cs_apply_smooth_normal(const cs_world *world, CS_GLOBAL const cs_face *face,
                                          vfloat b1, vfloat b2, vint mine, cs_surface *surface)
{
    CS_GLOBAL const cs_vertex *v0 = world->vertices + face->vertex[0];
    CS_GLOBAL const cs_vertex *v1 = world->vertices + face->vertex[1];
    CS_GLOBAL const cs_vertex *v2 = world->vertices + face->vertex[2];
    vfloat normal[3];
    for (int axis = 0; axis < 3; axis++)
        normal[axis] = v0->normal[axis] + b1 * (v1->normal[axis] - v0->normal[axis]) +
                       b2 * (v2->normal[axis] - v0->normal[axis]);
    vfloat square = cs_dot(normal, normal);
    vfloat scale = 1.0f / sqrt(square);
    scale = cs_dot(normal, surface->outward) < 0.0f ? -scale : scale;
    vint usable = mine & (square > 1e-12f);
    for (int axis = 0; axis < 3; axis++)
        surface->normal[axis] = usable ? scale * normal[axis] : surface->normal[axis];
}

/* Fills in the lanes in `mine`, which all hit triangle number `index`. */
static inline void cs_describe_triangle(const cs_world *world, const cs_ray *ray, i32 index,
                                        vint mine, cs_surface *surface)
{
    CS_GLOBAL const cs_triangle *triangle = world->triangles + index;
    CS_GLOBAL const cs_material *material = world->materials + triangle->material;
    CS_GLOBAL const f32 *n = triangle->normal;
    f32 square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    f32 scale = 1.0f / sqrt(square);
    vfloat along = fma((vfloat)(n[0]), ray->direction[0],
                       fma((vfloat)(n[1]), ray->direction[1], n[2] * ray->direction[2]));
    vfloat towards = along > 0.0f ? (vfloat)(-scale) : (vfloat)(scale);
    for (int axis = 0; axis < 3; axis++) {
        surface->outward[axis] = mine ? towards * n[axis] : surface->outward[axis];
        surface->normal[axis] = mine ? surface->outward[axis] : surface->normal[axis];
        surface->albedo[axis] = mine ? (vfloat)(material->diffuse[axis]) : surface->albedo[axis];
        surface->emission[axis] =
            mine ? (vfloat)(material->emission[axis]) : surface->emission[axis];
    }
    if (triangle->flags == 0u) return;

    vfloat x = surface->point[0] - triangle->corner[0];
    vfloat y = surface->point[1] - triangle->corner[1];
    vfloat z = surface->point[2] - triangle->corner[2];
    f32 inverse = 1.0f / square;
    CS_GLOBAL const f32 *e1 = triangle->edge1;
    CS_GLOBAL const f32 *e2 = triangle->edge2;
    vfloat b1 = (x * (e2[1] * n[2] - e2[2] * n[1]) + y * (e2[2] * n[0] - e2[0] * n[2]) +
                 z * (e2[0] * n[1] - e2[1] * n[0])) *
                inverse;
    vfloat b2 = (x * (n[1] * e1[2] - n[2] * e1[1]) + y * (n[2] * e1[0] - n[0] * e1[2]) +
                 z * (n[0] * e1[1] - n[1] * e1[0])) *
                inverse;
    CS_GLOBAL const cs_face *face = world->faces + triangle->face;
    if (triangle->flags & CS_FACE_SMOOTH)
        cs_apply_smooth_normal(world, face, b1, b2, mine, surface);
    if (triangle->flags & CS_FACE_TEXTURED)
        cs_apply_texture(world, face, (u32)material->texture, b1, b2, mine, surface);
}

/* The surfaces that a packet hit, one distinct triangle after another: mostly there are few. */
static inline cs_surface cs_describe_hits(const cs_world *world, const cs_ray *ray,
                                          const cs_hit *hit)
{
    cs_surface surface;
    surface.hit = hit->triangle >= 0;
    for (int axis = 0; axis < 3; axis++) {
        surface.point[axis] = fma(ray->direction[axis], hit->distance, ray->origin[axis]);
        surface.outward[axis] = (vfloat)(0.0f);
        surface.normal[axis] = (vfloat)(0.0f);
        surface.albedo[axis] = (vfloat)(0.0f);
        surface.emission[axis] = (vfloat)(0.0f);
    }
    vint left = hit->triangle;
    for (i32 index = cs_reduce_max(left); index >= 0; index = cs_reduce_max(left)) {
        vint mine = left == (vint)(index);
        cs_describe_triangle(world, ray, index, mine, &surface);
        left = mine ? (vint)(CS_NO_HIT) : left;
    }
    return surface;
}

/* Origins of rays that leave a surface: off it by more than the rounding of the hit point, which
 * grows with its coordinates and the distance travelled. */
static inline void cs_leave_surface(const cs_surface *surface, vfloat distance, vfloat *origin)
{
    vfloat size = cs_max(cs_max(fabs(surface->point[0]), fabs(surface->point[1])),
                         cs_max(fabs(surface->point[2]), distance));
    vfloat step = size * 3e-5f;
    for (int axis = 0; axis < 3; axis++)
        origin[axis] = fma(surface->outward[axis], step, surface->point[axis]);
}

typedef struct cs_radiance {
    vfloat channel[3];
    vfloat shadow_rays; /* traced, a lane */
} cs_radiance;

/* Adds the light of something that lies `towards` from the surface (not normalised, its end at
 * distance `reach`) with the unshadowed irradiance per unit of `colour` in `weight`. The shadow ray
 * begins at `origin`, off the surface, and ends in the same place: what the light gives does not
 * shift. */
static inline void cs_add_light(const cs_world *world, const cs_surface *surface,
                                const vfloat *origin, const vfloat *towards, f32 reach,
                                vfloat weight, const vfloat *colour, cs_radiance *radiance)
{
    vint facing = surface->hit & (weight > 0.0f) & (cs_dot(surface->outward, towards) > 0.0f);
    if (!cs_any(facing)) return;
    cs_ray shadow;
    for (int axis = 0; axis < 3; axis++) {
        shadow.origin[axis] = origin[axis];
        shadow.direction[axis] = towards[axis];
        if (reach < INFINITY) shadow.direction[axis] += surface->point[axis] - origin[axis];
    }
    cs_hit blocked;
    blocked.distance = facing ? (vfloat)(reach) : (vfloat)(-1.0f);
    cs_traverse(world->nodes, world->triangles, &shadow, 1, &blocked);
    weight = blocked.distance > 0.0f ? weight * CS_INVERSE_PI : (vfloat)(0.0f);
    for (int c = 0; c < 3; c++)
        radiance->channel[c] += weight * colour[c] * surface->albedo[c];
    radiance->shadow_rays += facing ? (vfloat)(1.0f) : (vfloat)(0.0f);
}

static inline void cs_add_delta_light(const cs_world *world, const cs_surface *surface,
                                      const vfloat *origin, CS_GLOBAL const cs_light *light,
                                      cs_radiance *radiance)
{
    vfloat towards[3], colour[3];
    int point = light->kind == CS_LIGHT_POINT;
    for (int axis = 0; axis < 3; axis++) {
        towards[axis] =
            point ? light->vector[axis] - surface->point[axis] : (vfloat)(light->vector[axis]);
        colour[axis] = (vfloat)(light->colour[axis]);
    }
    vfloat cosine = cs_dot(surface->normal, towards);
    vfloat square = cs_max(cs_dot(towards, towards), (vfloat)(1e-30f));
    vfloat weight = point ? cosine / (square * sqrt(square)) : cosine;
    cs_add_light(world, surface, origin, towards, point ? 1.0f : INFINITY, weight, colour,
                 radiance);
}

/* First emitter whose cumulative probability exceeds `target`. */
static inline u32 cs_pick_emitter(CS_GLOBAL const cs_emitter *emitters, u32 count, f32 target)
{
    u32 low = 0u, high = count - 1u;
    while (low < high) {
        u32 middle = (low + high) / 2u;
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
static inline void cs_add_emitters(const cs_world *world, u32 count, const cs_surface *surface,
                                   const vfloat *origin, cs_pair sample, cs_radiance *radiance)
{
    cs_float_lanes a, b, end[3], normal[3], colour[3], density;
    a.all = sample.x;
    b.all = sample.y;
    for (int lane = 0; lane < CS_PACKET; lane++) {
        CS_GLOBAL const cs_emitter *emitter =
            world->emitters + cs_pick_emitter(world->emitters, count, a.lane[lane]);
        f32 below = emitter->cumulative - emitter->probability;
        f32 stretched = clamp((a.lane[lane] - below) / emitter->probability, 0.0f, 1.0f);
        f32 root = sqrt(stretched);
        f32 b1 = root * (1.0f - b.lane[lane]), b2 = root * b.lane[lane];
        CS_GLOBAL const f32 *e1 = emitter->edge1;
        CS_GLOBAL const f32 *e2 = emitter->edge2;
        for (int axis = 0; axis < 3; axis++) {
            int next = (axis + 1) % 3, last = (axis + 2) % 3;
            end[axis].lane[lane] = emitter->corner[axis] + b1 * e1[axis] + b2 * e2[axis];
            normal[axis].lane[lane] =
                (e1[next] * e2[last] - e1[last] * e2[next]) * 0.5f / emitter->area;
            colour[axis].lane[lane] = emitter->radiance[axis];
        }
        density.lane[lane] = emitter->probability / emitter->area;
    }
    vfloat towards[3], light_normal[3], light_colour[3];
    for (int axis = 0; axis < 3; axis++) {
        towards[axis] = end[axis].all - surface->point[axis];
        light_normal[axis] = normal[axis].all;
        light_colour[axis] = colour[axis].all;
    }
    vfloat square = cs_max(cs_dot(towards, towards), (vfloat)(1e-30f));
    vfloat cosines = cs_dot(surface->normal, towards) * fabs(cs_dot(light_normal, towards));
    vfloat weight = cosines / (square * square * density.all);
    cs_add_light(world, surface, origin, towards, 0.9999f, weight, light_colour, radiance);
}

/* Radiance that arrives at the lens along each ray; `emitter_sample` is used if there are any. */
static inline cs_radiance cs_radiance_along(const cs_world *world, u32 lights, u32 emitters,
                                            const cs_ray *ray, cs_pair emitter_sample, vint active)
{
    cs_hit hit;
    hit.distance = active ? (vfloat)(INFINITY) : (vfloat)(-1.0f);
    cs_traverse(world->nodes, world->triangles, ray, 0, &hit);
    cs_radiance radiance;
    radiance.shadow_rays = (vfloat)(0.0f);
    for (int c = 0; c < 3; c++)
        radiance.channel[c] = (vfloat)(0.0f);
    vint seen = hit.triangle >= 0;
    if (!cs_any(seen)) return radiance;
    hit.distance = seen ? hit.distance : (vfloat)(0.0f);
    cs_surface surface = cs_describe_hits(world, ray, &hit);
    for (int c = 0; c < 3; c++)
        radiance.channel[c] = surface.emission[c];
    vfloat origin[3];
    cs_leave_surface(&surface, hit.distance, origin);
    for (u32 light = 0u; light < lights; light++)
        cs_add_delta_light(world, &surface, origin, world->lights + light, &radiance);
    if (emitters > 0u)
        cs_add_emitters(world, emitters, &surface, origin, emitter_sample, &radiance);
    return radiance;
}

#endif
