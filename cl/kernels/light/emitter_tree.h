/* The choice among emissive triangles by a tree, as seen from surface points. Shared.
 *
 * A node bounds the light that its triangles can send to a point, by a sphere around them and a
 * cone of their normals (Conty Estevez & Kulla 2018; Pharr, Jakob & Humphreys 2023, section
 * 12.6.3); that of a single triangle follows from its solid angle. From the root on, a child is
 * taken with its part of both bounds. */
#ifndef CS_LIGHT_EMITTER_TREE_H
#define CS_LIGHT_EMITTER_TREE_H

#include "kernels/features.h"
#include "kernels/light/seen_triangle.h"
#include "kernels/scene.h"

#if CS_HAS(EMITTERS)

/* Where light is wanted. */
typedef struct cs_vantage {
    cs_vfloat point[3];
    cs_vfloat normal[3]; /* unit, on the side that light arrives at */
    cs_vint through;     /* lanes that light arrives at from both sides */
} cs_vantage;

/* The buffers that the tree is in. */
typedef struct cs_emitter_tree {
    CS_GLOBAL const cs_emitter_node *nodes;
    CS_GLOBAL const cs_emitter *emitters;
#if CS_HAS(MOVING)
    CS_GLOBAL const cs_triangle_step *steps; /* of the emitters */
    cs_float_lanes time;
#endif
} cs_emitter_tree;

/* An emitter in each lane, at the lane's time. */
typedef struct cs_emitter_lanes {
    cs_float_lanes corner[3];
    cs_float_lanes edge1[3];
    cs_float_lanes edge2[3];
    cs_float_lanes luminance;
} cs_emitter_lanes;

/* A node in each lane. */
typedef struct cs_node_lanes {
    cs_float_lanes centre[3];
    cs_float_lanes radius;
    cs_float_lanes axis[3];
    cs_float_lanes cosine;
    cs_float_lanes power;
    cs_int_lanes child;
} cs_node_lanes;

typedef struct cs_emitter_choice {
    cs_int_lanes emitter;  /* index */
    cs_vfloat probability; /* 0 where no emitter shines, and the index is any */
    cs_vfloat rest;        /* of the number that made the choice, in [0, 1] */
} cs_emitter_choice;

static inline void cs_load_emitters(const cs_emitter_tree *tree, cs_int_lanes index,
                                    cs_emitter_lanes *loaded)
{
    for (int lane = 0; lane < CS_PACKET; lane++) {
        CS_GLOBAL const cs_emitter *emitter = tree->emitters + index.lane[lane];
        for (int i = 0; i < 3; i++) {
            loaded->corner[i].lane[lane] = emitter->corner[i];
            loaded->edge1[i].lane[lane] = emitter->edge1[i];
            loaded->edge2[i].lane[lane] = emitter->edge2[i];
        }
#if CS_HAS(MOVING)
        CS_GLOBAL const cs_triangle_step *step = tree->steps + index.lane[lane];
        for (int i = 0; i < 3; i++) {
            loaded->corner[i].lane[lane] += tree->time.lane[lane] * step->corner[i];
            loaded->edge1[i].lane[lane] += tree->time.lane[lane] * step->edge1[i];
            loaded->edge2[i].lane[lane] += tree->time.lane[lane] * step->edge2[i];
        }
#endif
        loaded->luminance.lane[lane] = emitter->luminance;
    }
}

static inline void cs_load_nodes(const cs_emitter_tree *tree, cs_int_lanes index,
                                 cs_node_lanes *loaded)
{
    for (int lane = 0; lane < CS_PACKET; lane++) {
        CS_GLOBAL const cs_emitter_node *node = tree->nodes + index.lane[lane];
        for (int i = 0; i < 3; i++) {
            loaded->centre[i].lane[lane] = node->centre[i];
            loaded->axis[i].lane[lane] = node->axis[i];
        }
        loaded->radius.lane[lane] = node->radius;
        loaded->cosine.lane[lane] = node->cosine;
        loaded->power.lane[lane] = node->power;
        loaded->child.lane[lane] = (cs_i32)node->child;
    }
}

/* The emitters as seen from the vantage points. */
static inline cs_seen_triangle cs_see_emitters(const cs_emitter_tree *tree, cs_int_lanes index,
                                               const cs_vfloat *point, cs_emitter_lanes *loaded)
{
    cs_vfloat corner[3], edge1[3], edge2[3];
    cs_load_emitters(tree, index, loaded);
    for (int i = 0; i < 3; i++) {
        corner[i] = loaded->corner[i].all - point[i];
        edge1[i] = loaded->edge1[i].all;
        edge2[i] = loaded->edge2[i].all;
    }
    return cs_see_triangle(corner, edge1, edge2);
}

static inline cs_vfloat cs_sine_of(cs_vfloat cosine)
{
    return cs_sqrt(cs_max(1.0f - cosine * cosine, (cs_vfloat)(0.0f)));
}

/* Angles of 0 to pi, by cosine and sine. */
typedef struct cs_angle {
    cs_vfloat cosine;
    cs_vfloat sine;
} cs_angle;

static inline cs_angle cs_angle_of(cs_vfloat cosine)
{
    cs_angle angle = {cosine, cs_sine_of(cosine)};
    return angle;
}

/* The first angle less the second, at least 0. */
static inline cs_angle cs_angle_beyond(cs_angle first, cs_angle second)
{
    cs_vint none = first.cosine >= second.cosine;
    cs_vfloat cosine = first.cosine * second.cosine + first.sine * second.sine;
    cs_vfloat sine = first.sine * second.cosine - first.cosine * second.sine;
    cs_angle left;
    left.cosine = none ? (cs_vfloat)(1.0f) : cosine;
    left.sine = none ? (cs_vfloat)(0.0f) : sine;
    return left;
}

/* How the spheres of nodes appear from the vantage points. */
typedef struct cs_sight {
    cs_vfloat towards[3]; /* unit, to the centre */
    cs_vfloat square;     /* of the distance, at least of the radius */
    cs_angle spread;      /* half angle of the sphere */
    cs_vint within;       /* lanes inside the sphere */
} cs_sight;

static inline cs_sight cs_sight_of(const cs_node_lanes *node, const cs_vfloat *point)
{
    cs_sight sight;
    for (int i = 0; i < 3; i++)
        sight.towards[i] = node->centre[i].all - point[i];
    cs_vfloat radius = node->radius.all;
    cs_vfloat square = cs_max(cs_dot(sight.towards, sight.towards), (cs_vfloat)(1e-30f));
    cs_vfloat inverse = 1.0f / cs_sqrt(square);
    for (int i = 0; i < 3; i++)
        sight.towards[i] *= inverse;
    sight.square = cs_max(square, radius * radius);
    sight.within = square <= radius * radius;
    sight.spread.sine = cs_min(radius * inverse, (cs_vfloat)(1.0f));
    sight.spread.cosine = cs_sine_of(sight.spread.sine);
    return sight;
}

/* The largest cosine, at least 0, of an angle that changes by up to the spread. */
static inline cs_vfloat cs_largest_cosine(cs_angle angle, const cs_sight *sight)
{
    cs_vfloat cosine = cs_angle_beyond(angle, sight->spread).cosine;
    return sight->within ? (cs_vfloat)(1.0f) : cs_max(cosine, (cs_vfloat)(0.0f));
}

/* Upper bounds, up to rounding and to the distance within a node's sphere, of the luminance that
 * arrives from nodes: power times both cosines by the square of the distance; for a single triangle
 * its solid angle takes the place of all but the second cosine. */
static inline cs_vfloat cs_node_light(const cs_emitter_tree *tree, cs_int_lanes index,
                                      const cs_vantage *vantage)
{
    cs_node_lanes node;
    cs_int_lanes emitter;
    cs_vfloat light = (cs_vfloat)(0.0f), axis[3];
    cs_load_nodes(tree, index, &node);
    cs_sight sight = cs_sight_of(&node, vantage->point);
    cs_vfloat above = cs_dot(sight.towards, vantage->normal);
    above =
        cs_clamp(vantage->through ? cs_abs(above) : above, (cs_vfloat)(-1.0f), (cs_vfloat)(1.0f));
    cs_vfloat arriving = cs_largest_cosine(cs_angle_of(above), &sight);
    cs_vint is_leaf = node.child.all >= (cs_vint)(CS_LEAF);
    if (cs_any(node.child.all < (cs_vint)(CS_LEAF))) {
        for (int i = 0; i < 3; i++)
            axis[i] = node.axis[i].all;
        cs_vfloat along = cs_min(cs_abs(cs_dot(sight.towards, axis)), (cs_vfloat)(1.0f));
        cs_angle turned = cs_angle_beyond(cs_angle_of(along), cs_angle_of(node.cosine.all));
        light = node.power.all * cs_largest_cosine(turned, &sight) * arriving / sight.square;
    }
    if (!cs_any(is_leaf)) return light;
    emitter.all = is_leaf ? node.child.all - (cs_vint)(CS_LEAF) : (cs_vint)(0);
    cs_emitter_lanes loaded;
    cs_seen_triangle seen = cs_see_emitters(tree, emitter, vantage->point, &loaded);
    return is_leaf ? loaded.luminance.all * seen.solid_angle * arriving : light;
}

/* The part of the left one of two children, `left` and the node behind it, in the light of both; -1
 * where neither has any. */
static inline cs_vfloat cs_left_part(const cs_emitter_tree *tree, cs_int_lanes left,
                                     const cs_vantage *vantage)
{
    cs_int_lanes right;
    right.all = left.all + 1;
    cs_vfloat of_left = cs_node_light(tree, left, vantage);
    cs_vfloat both = of_left + cs_node_light(tree, right, vantage);
    return both > 0.0f ? of_left / both : (cs_vfloat)(-1.0f);
}

/* Chooses by numbers in [0, 1); what is left of them is as evenly spread. */
static inline cs_emitter_choice cs_choose_emitters(const cs_emitter_tree *tree,
                                                   const cs_vantage *vantage, cs_vfloat number)
{
    cs_emitter_choice chosen;
    cs_int_lanes child;
    chosen.rest = number;
    chosen.probability = (cs_vfloat)(1.0f);
    child.all = (cs_vint)((cs_i32)tree->nodes[CS_EMITTER_ROOT].child);
    for (cs_vint inner = child.all < (cs_vint)(CS_LEAF); cs_any(inner);
         inner = child.all < (cs_vint)(CS_LEAF)) {
        cs_int_lanes left, taken;
        left.all = inner ? child.all : (cs_vint)(CS_EMITTER_ROOT + 1);
        cs_vfloat part = cs_left_part(tree, left, vantage);
        cs_vint goes_left = chosen.rest < part;
        cs_vfloat own = goes_left ? part : 1.0f - part;
        cs_vfloat rest =
            (goes_left ? chosen.rest : chosen.rest - part) / cs_max(own, (cs_vfloat)(1e-30f));
        rest = cs_clamp(rest, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
        own = part >= 0.0f ? own : (cs_vfloat)(0.0f);
        chosen.rest = inner ? rest : chosen.rest;
        chosen.probability = inner ? chosen.probability * own : chosen.probability;
        taken.all = left.all + (goes_left ? (cs_vint)(0) : (cs_vint)(1));
        for (int lane = 0; lane < CS_PACKET; lane++)
            taken.lane[lane] = (cs_i32)tree->nodes[taken.lane[lane]].child;
        child.all = inner ? taken.all : child.all;
    }
    chosen.emitter.all = child.all - (cs_vint)(CS_LEAF);
    return chosen;
}

/* The probability with which cs_choose_emitters takes the emitters `index`. */
static inline cs_vfloat cs_emitter_chance(const cs_emitter_tree *tree, const cs_vantage *vantage,
                                          cs_int_lanes index)
{
    cs_int_lanes node;
    cs_vfloat chance = (cs_vfloat)(1.0f);
    for (int lane = 0; lane < CS_PACKET; lane++)
        node.lane[lane] = (cs_i32)tree->emitters[index.lane[lane]].node;
    for (cs_vint below = node.all > (cs_vint)(CS_EMITTER_ROOT); cs_any(below);
         below = node.all > (cs_vint)(CS_EMITTER_ROOT)) {
        cs_int_lanes left, parent;
        left.all = below ? node.all & (cs_vint)(~1) : (cs_vint)(CS_EMITTER_ROOT + 1);
        cs_vfloat part = cs_left_part(tree, left, vantage);
        cs_vfloat own = node.all > left.all ? 1.0f - part : part;
        chance *= below ? (part >= 0.0f ? own : (cs_vfloat)(0.0f)) : (cs_vfloat)(1.0f);
        for (int lane = 0; lane < CS_PACKET; lane++)
            parent.lane[lane] = (cs_i32)tree->nodes[node.lane[lane]].parent;
        node.all = below ? parent.all : node.all;
    }
    return chance;
}

#endif

#endif
