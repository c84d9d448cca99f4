/* The makers of sample tables: one for each name in the `table` column of
 * cl/clshear/device/sampler/list.h. Parts of a table are made by several threads at once. */
#ifndef CS_PATTERN_TABLE_MAKERS_H
#define CS_PATTERN_TABLE_MAKERS_H

#include "clshear/device/sampler/pattern.h"

/* A part of a sample table under construction, with rows in the order of the sequence. Makers
 * return 0 when out of memory. */
typedef struct cs_table {
    const cs_pattern *pattern;
    cs_u32 part;                 /* of cs_pattern_parts: which one to make */
    cs_u32 *word[CS_MOST_WORDS]; /* columns of one word per sample, initially 0 */
    cs_u32 words;                /* number of filled columns */
    cs_u32 *place[2];            /* first pair of each row, in units of 2^-32 */
    cs_u32 boxes[2]; /* boxes of the coherent order along x and y; 0: already in order */
} cs_table;

int cs_table_none(cs_table *table);
int cs_table_index(cs_table *table);
int cs_table_sobol(cs_table *table);
int cs_table_sz(cs_table *table);
int cs_table_halton(cs_table *table);
int cs_table_oa(cs_table *table);
int cs_table_oa3(cs_table *table);
int cs_table_rank1(cs_table *table);
int cs_table_poisson(cs_table *table);
int cs_table_ccvt(cs_table *table);

/* Cuts the plane of an evenly spread set into boxes of about CS_GROUP points. */
void cs_table_cut_evenly(cs_table *table);

/* Fill `x` and `y` with `count` points of the unit torus. Return 0 when out of memory. */
int cs_poisson_points(cs_u32 count, cs_u32 seed, cs_f32 *x, cs_f32 *y);
int cs_ccvt_points(cs_u32 count, cs_u32 seed, cs_f32 *x, cs_f32 *y);

/* Returns 1 if `q` is a prime power (2 or more), else 0. */
int cs_is_prime_power(cs_u32 q);

#endif
