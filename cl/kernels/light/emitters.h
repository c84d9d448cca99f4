/* All emissive triangles together, as one area light: one is chosen by the tree, and a direction
 * in its solid angle. Device only. */
#ifndef CS_LIGHT_EMITTERS_H
#define CS_LIGHT_EMITTERS_H

#include "kernels/bsdf/bsdf.h"
#include "kernels/hits.h"
#include "kernels/light/emitter_tree.h"
#include "kernels/light/sample.h"

#if CS_HAS(EMITTERS)

static inline cs_emitter_tree cs_emitter_tree_of(const cs_scene_buffers *scene)
{
    cs_emitter_tree tree;
    tree.nodes = scene->emitter_nodes;
    tree.emitters = scene->emitters;
#if CS_HAS(MOVING)
    tree.steps = scene->emitter_steps;
    tree.time.all = scene->time;
#endif
    return tree;
}

static inline cs_vantage cs_vantage_of(const cs_surface *surface)
{
    cs_vantage vantage;
    for (int i = 0; i < 3; i++) {
        vantage.point[i] = surface->point[i];
        vantage.normal[i] = surface->normal[i];
    }
    vantage.through = cs_lets_through(surface);
    return vantage;
}

/* Density, per steradian, with which cs_sample_light_triangles draws from the vantage points the
 * directions to the surface; 0 where its emission is not among the emitters. */
static inline cs_vfloat cs_emitters_density(const cs_scene_buffers *scene,
                                            const cs_vantage *vantage, const cs_surface *surface)
{
    cs_emitter_tree tree = cs_emitter_tree_of(scene);
    cs_emitter_lanes loaded;
    cs_int_lanes index;
    cs_vint known = surface->emitter > 0;
    index.all = known ? surface->emitter - 1 : (cs_vint)(0);
    cs_seen_triangle seen = cs_see_emitters(&tree, index, vantage->point, &loaded);
    cs_vfloat density =
        cs_emitter_chance(&tree, vantage, index) / cs_max(seen.solid_angle, (cs_vfloat)(1e-30f));
    return known ? density : (cs_vfloat)(0.0f);
}

#if CS_HAS(MATERIALS)
/* Multiplies `colour` by two factors at a point of each lane's emitter: the texel of its emission,
 * and its opacity (cs_covering). chosen: the emitters' numbers. place: the point, as two parts of
 * the triangle's edges from the first vertex, 0 to 1. colour: the radiance, three channels. */
static inline void cs_vary_emission(const cs_scene_buffers *scene, cs_int_lanes chosen,
                                    const cs_vfloat *place, cs_vfloat *colour)
{
    cs_int_lanes left;
    for (int lane = 0; lane < CS_PACKET; lane++)
        left.lane[lane] =
            scene->emitters[chosen.lane[lane]].varies ? chosen.lane[lane] : (cs_i32)(-1);
    for (cs_i32 index = cs_reduce_max(left.all); index >= 0; index = cs_reduce_max(left.all)) {
        CS_GLOBAL const cs_emitter *emitter = scene->emitters + index;
        CS_GLOBAL const cs_material *material = scene->materials + emitter->material;
        cs_vint mine = left.all == (cs_vint)(index);
        cs_vfloat alpha = (cs_vfloat)(material->alpha);
#if CS_HAS(TEXTURES)
        if (emitter->varies & CS_EMITTER_TEXTURED) {
            cs_vfloat s, t;
            cs_float_lanes map[4];
            cs_texture_place(scene, scene->faces + emitter->face, place[0], place[1], &s, &t);
            cs_map_at(scene, (cs_u32)(material->texture + 1), s, t, mine, map);
            alpha *= map[3].all;
            cs_map_at(scene, material->emission_texture, s, t, mine, map);
            for (int c = 0; c < 3; c++)
                colour[c] *= mine ? map[c].all : (cs_vfloat)(1.0f);
        }
#endif
#if CS_HAS(COLOURS)
        if (emitter->varies & CS_EMITTER_COLOURED)
            alpha *= cs_vertex_alpha(scene, scene->faces + emitter->face, place[0], place[1]);
#endif
        (void)place;
        cs_vfloat covers = cs_covering(material, alpha);
        for (int c = 0; c < 3; c++)
            colour[c] *= mine ? covers : (cs_vfloat)(1.0f);
        left.all = mine ? (cs_vint)(-1) : left.all;
    }
}
#endif

/* colour: radiance. `pair` is a stratified point of the unit square. */
static inline cs_light_sample cs_sample_light_triangles(const cs_scene_buffers *scene,
                                                        CS_GLOBAL const cs_light *light,
                                                        const cs_surface *surface, cs_pair pair)
{
    cs_light_sample sample;
    cs_emitter_tree tree = cs_emitter_tree_of(scene);
    cs_vantage vantage = cs_vantage_of(surface);
    cs_emitter_choice chosen = cs_choose_emitters(&tree, &vantage, pair.x);
    cs_emitter_lanes loaded;
    cs_seen_triangle seen = cs_see_emitters(&tree, chosen.emitter, vantage.point, &loaded);
    cs_vfloat place[2];
    cs_float_lanes radiance[3];
    (void)light;
    pair.x = chosen.rest;
    cs_draw_in_triangle(&seen, pair, place);
    for (int lane = 0; lane < CS_PACKET; lane++)
        for (int c = 0; c < 3; c++)
            radiance[c].lane[lane] = tree.emitters[chosen.emitter.lane[lane]].radiance[c];
    for (int i = 0; i < 3; i++) {
        sample.towards[i] = loaded.corner[i].all - vantage.point[i] +
                            place[0] * loaded.edge1[i].all + place[1] * loaded.edge2[i].all;
        sample.colour[i] = radiance[i].all;
    }
#if CS_HAS(MATERIALS)
    cs_vary_emission(scene, chosen.emitter, place, sample.colour);
#endif
    cs_vfloat square = cs_max(cs_dot(sample.towards, sample.towards), (cs_vfloat)(1e-30f));
    cs_vfloat cosine = cs_dot(surface->normal, sample.towards) / sqrt(square);
    cs_vint any = (chosen.probability > 0.0f) & (seen.solid_angle > 0.0f);
    sample.weight = any ? cosine * seen.solid_angle / chosen.probability : (cs_vfloat)(0.0f);
    sample.density = any ? chosen.probability / seen.solid_angle : (cs_vfloat)(0.0f);
    sample.reach = 0.9999f;
    return sample;
}

#endif

#endif
