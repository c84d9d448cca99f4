/* The random numbers of a path beyond those of its tuple. Device only. */
#ifndef CS_KERNELS_DRAWS_H
#define CS_KERNELS_DRAWS_H

#include "clshear/device/sampler/sampler.h"

/* What a surface on a path needs pairs of numbers for. */
enum {
    CS_DRAW_LIGHT,  /* the place on area lights; the first surface has the tuple's own slot */
    CS_DRAW_BSDF,   /* the direction that goes on; likewise, if that is drawn with the tuple */
    CS_DRAW_CHOICE, /* between the lobes of a BSDF; whether the path goes on */
    CS_DRAW_PURPOSES
};

/* The samples that a packet traces: of one pattern, or, where cs_pads_lanes, of several. */
typedef struct cs_draws {
    const cs_pattern *pattern;
    cs_sample_table table;
    cs_vuint key; /* of each sample's pattern */
    cs_vuint index;
} cs_draws;

typedef struct cs_numbers {
    cs_pair light;
    cs_pair bsdf;
    cs_pair choice;
} cs_numbers;

/* A pair for surface number `depth` of the paths. Each is padding with a key of its own, as well
 * stratified as the pairs of a tuple. */
static inline cs_pair cs_draw_at(const cs_draws *draws, cs_u32 depth, cs_u32 purpose)
{
    cs_uint_lanes key;
    cs_u32 number = CS_KEY_BOUNCES + depth * (cs_u32)CS_DRAW_PURPOSES + purpose;
    key.all = cs_key_families(draws->key, (cs_vuint)(number));
    if (cs_pads_lanes(draws->pattern->sampler))
        return cs_draw_padding_lanes(draws->pattern, draws->table, key.all, draws->index,
                                     CS_SLOT_LIGHT);
    return cs_draw_padding(draws->pattern, draws->table, key.lane[0], draws->index, CS_SLOT_LIGHT);
}

#endif
