/* The makers of tables: one for each word in the `rows` column of cl/sampler/list.h. */
#ifndef CS_PATTERN_ROWS_H
#define CS_PATTERN_ROWS_H

#include "sampler/pattern.h"

/* A table in the making: rows in the sequence's order. Makers return 0 when out of memory. */
typedef struct cs_table {
    const cs_pattern *pattern;
    u32 *word[CS_MOST_WORDS]; /* zeros; one for each sample */
    u32 words;                /* how many of them the maker has filled */
    /* Where the first pair of a row lies, in units of 2^-32, and how many boxes the plane is cut
     * into for the coherent order. boxes[0] = 0: the rows are in that order already. */
    u32 *place[2];
    u32 boxes[2];
} cs_table;

int cs_rows_none(cs_table *table);
int cs_rows_index(cs_table *table);
int cs_rows_sobol(cs_table *table);
int cs_rows_sz(cs_table *table);
int cs_rows_halton(cs_table *table);
int cs_rows_oa(cs_table *table);
int cs_rows_oa3(cs_table *table);
int cs_rows_rank1(cs_table *table);
int cs_rows_poisson(cs_table *table);
int cs_rows_ccvt(cs_table *table);

/* N points of the unit torus, made from `seed`. Return 0 when out of memory. `x` and `y`: N each.
 */
int cs_poisson_points(u32 count, u32 seed, f32 *x, f32 *y);
int cs_ccvt_points(u32 count, u32 seed, f32 *x, f32 *y);

/* Whether `q` is a power of a prime, 2 or more. */
int cs_is_prime_power(u32 q);

#endif
