/* The makers of tables: one for each word in the `table` column of
 * cl/clshear/device/sampler/list.h.
 */
#ifndef CS_PATTERN_ROWS_H
#define CS_PATTERN_ROWS_H

#include "clshear/device/sampler/pattern.h"

/* A table in the making: rows in the sequence's order. Makers return 0 when out of memory. */
typedef struct cs_table {
    const cs_pattern *pattern;
    cs_u32 *word[CS_MOST_WORDS]; /* zeros; one for each sample */
    cs_u32 words;                /* how many of them the maker has filled */
    /* Where the first pair of a row lies, in units of 2^-32, and how many boxes the plane is cut
     * into for the coherent order. boxes[0] = 0: the rows are in that order already. */
    cs_u32 *place[2];
    cs_u32 boxes[2];
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

/* N points of the unit torus, made from `seed`. Return 0 when out of memory. `x` and `y`: N each.
 */
int cs_poisson_points(cs_u32 count, cs_u32 seed, cs_f32 *x, cs_f32 *y);
int cs_ccvt_points(cs_u32 count, cs_u32 seed, cs_f32 *x, cs_f32 *y);

/* Whether `q` is a power of a prime, 2 or more. */
int cs_is_prime_power(cs_u32 q);

#endif
