/* Sample tables of planar point sets: a part for each set of a pool. */
#include <stdlib.h>

#include "clshear/device/hash.h"
#include "pattern/set_cache.h"
#include "pattern/table_makers.h"

/* Fills `x` and `y`; returns 0 when out of memory. */
typedef int (*point_maker)(cs_u32 count, cs_u32 seed, cs_f32 *x, cs_f32 *y);

/* Makes 2 count words, all x and then all y, in units of 2^-32. */
static int make_words(point_maker points, cs_u32 count, cs_u32 seed, cs_u32 *words)
{
    cs_f32 *x = malloc(2 * (size_t)count * sizeof *x);
    const int good = x != NULL && points(count, seed, x, x + count);
    for (size_t i = 0; good && i < 2 * (size_t)count; i++)
        words[i] = (cs_u32)((double)x[i] * 0x1p32);
    free(x);
    return good;
}

/* Sets of the pool that all patterns share are kept on disk. shape[1] chooses the pool. */
static int find_words(const cs_table *table, const char *sampler, point_maker points, cs_u32 *words)
{
    const cs_u32 count = table->pattern->grid.count, pool = table->pattern->shape[1];
    const cs_set_name name = {sampler, count, table->part};
    if (pool == 0 && cs_set_cache_read(&name, words)) return 1;
    if (!make_words(points, count, cs_key(pool, table->part), words)) return 0;
    if (pool == 0) cs_set_cache_write(&name, words);
    return 1;
}

static int fill_table_of_points(cs_table *table, const char *sampler, point_maker points)
{
    const cs_u32 count = table->pattern->grid.count;
    cs_u32 *words = calloc(2 * (size_t)count, sizeof *words);
    const int good = words != NULL && find_words(table, sampler, points, words);
    for (cs_u32 row = 0; good && row < count; row++)
        for (cs_u32 d = 0; d < 2; d++) {
            table->word[d][row] = words[d * count + row];
            table->place[d][row] = words[d * count + row];
        }
    free(words);
    table->words = 2;
    cs_table_cut_evenly(table);
    return good;
}

int cs_table_poisson(cs_table *table)
{
    return fill_table_of_points(table, "poisson", cs_poisson_points);
}

int cs_table_ccvt(cs_table *table)
{
    return fill_table_of_points(table, "ccvt", cs_ccvt_points);
}
