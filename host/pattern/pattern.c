#include "pattern/pattern.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"
#include "pattern/table_makers.h"

/* Returns 1 if the construction has a set of exactly `count` points, else 0. */
typedef int (*count_rule)(cs_u32 count);

static int counts_any(cs_u32 count)
{
    (void)count;
    return 1;
}

/* A limit for sets with a slow construction. */
static int counts_modest(cs_u32 count)
{
    return count <= 1u << 18;
}

static int counts_few(cs_u32 count)
{
    return count <= 1u << 16;
}

/* Counts with a full grid, without a partial row. */
static int counts_grid(cs_u32 count)
{
    return cs_grid_of(count).extra == 0;
}

/* Finds the sides of a 4D grid, shape[0] >= ... >= shape[3], as equal as possible, the largest at
 * most twice the smallest. Returns 0 if the count has no such grid. */
static int hypergrid(cs_u32 count, cs_u32 shape[CS_MAIN_DIMENSIONS])
{
    cs_u32 best = 0;
    for (cs_u32 d = 1; d * d * d * d <= count; d++) {
        if (count % d != 0) continue;
        const cs_u32 without_d = count / d;
        for (cs_u32 c = d; c * c * c <= without_d && c <= 2 * d; c++) {
            if (without_d % c != 0) continue;
            const cs_u32 pair = without_d / c;
            for (cs_u32 b = c; b * b <= pair; b++) {
                if (pair % b != 0 || pair / b > 2 * d) continue;
                if (d < best) continue;
                best = d;
                const cs_u32 sides[CS_MAIN_DIMENSIONS] = {pair / b, b, c, d};
                memcpy(shape, sides, sizeof sides);
            }
        }
    }
    return best > 0;
}

static int counts_hypergrid(cs_u32 count)
{
    cs_u32 shape[CS_MAIN_DIMENSIONS];
    return hypergrid(count, shape);
}

static cs_u32 root_of(cs_u32 count, int power)
{
    cs_u32 root = 1;
    for (;; root++) {
        uint64_t next = 1;
        for (int i = 0; i < power; i++)
            next *= root + 1;
        if (next > count) return root;
    }
}

/* Returns 1 if `count` is q^power and an orthogonal array of four columns has q levels. */
static int is_array(cs_u32 count, int power)
{
    const cs_u32 q = root_of(count, power);
    cs_u32 runs = 1;
    for (int i = 0; i < power; i++)
        runs *= q;
    return runs == count && q >= 3 && cs_is_prime_power(q);
}

static int counts_square(cs_u32 count)
{
    return is_array(count, 2);
}

static int counts_cube(cs_u32 count)
{
    return is_array(count, 3);
}

/* Fills the grid and the shape of a pattern of `count` points. The other constants are set. */
typedef void (*shape_rule)(cs_pattern *pattern, cs_u32 count);

static void shape_evenly(cs_pattern *pattern, cs_u32 count)
{
    pattern->grid = cs_grid_of(count);
}

static void shape_hypergrid(cs_pattern *pattern, cs_u32 count)
{
    shape_evenly(pattern, count);
    if (hypergrid(count, pattern->shape))
        pattern->grid = cs_grid_on(count, pattern->shape[0] * pattern->shape[1]);
}

static void shape_square(cs_pattern *pattern, cs_u32 count)
{
    pattern->grid = cs_grid_on(count, root_of(count, 2));
}

static void shape_cube(cs_pattern *pattern, cs_u32 count)
{
    pattern->grid = cs_grid_on(count, root_of(count, 3));
}

/* Number of digits in base `base` of the numbers below `end`. */
static cs_u32 digits_of(cs_u32 end, cs_u32 base)
{
    cs_u32 digits = 0;
    for (uint64_t power = 1; power < end; power *= base)
        digits++;
    return digits;
}

static void shape_digits(cs_pattern *pattern, cs_u32 count)
{
    const cs_u32 bases[CS_MAIN_DIMENSIONS] = {2, 3, 5, 7};
    shape_evenly(pattern, count);
    for (int d = 0; d < CS_MAIN_DIMENSIONS; d++)
        pattern->shape[d] = digits_of(pattern->first + count, bases[d]);
}

enum {
    POOL_SETS = 64,        /* planar sets of a pattern, unless that makes too many points: */
    POOL_POINTS = 1 << 18, /* most points of a pool, */
    LEAST_SETS = 4         /* unless that leaves fewer sets (cs_set_word) */
};

/* shape[0] is the number of planar sets, shape[1] the pool that they come from. */
static void shape_sets(cs_pattern *pattern, cs_u32 count)
{
    shape_evenly(pattern, count);
    pattern->shape[0] = POOL_SETS;
    while (pattern->shape[0] > LEAST_SETS && pattern->shape[0] * count > POOL_POINTS)
        pattern->shape[0] /= 2;
}

/* An entry of the `shape` column of cl/clshear/device/sampler/list.h. */
typedef struct sampler_shape {
    count_rule has;
    shape_rule fill;
} sampler_shape;

static const sampler_shape shape_rules_any = {counts_any, shape_evenly};
static const sampler_shape shape_rules_modest = {counts_modest, shape_sets};
static const sampler_shape shape_rules_few = {counts_few, shape_sets};
static const sampler_shape shape_rules_grid = {counts_grid, shape_evenly};
static const sampler_shape shape_rules_hypergrid = {counts_hypergrid, shape_hypergrid};
static const sampler_shape shape_rules_square = {counts_square, shape_square};
static const sampler_shape shape_rules_cube = {counts_cube, shape_cube};
static const sampler_shape shape_rules_digits = {counts_any, shape_digits};

typedef struct sampler {
    const char *name;
    const char *about;
    const sampler_shape *shape;
    int (*make_table)(cs_table *table);
    int progressive;
} sampler;

#define CS_SAMPLER_ENTRY(identifier, name, draw, light, extra, shape, table, progressive, about) \
    {name, about, &shape_rules_##shape, cs_table_##table, progressive},

static const sampler samplers[CS_SAMPLER_COUNT] = {CS_SAMPLER_LIST(CS_SAMPLER_ENTRY)};

static const cs_u32 default_sampler = CS_SAMPLER_SZ;

const char *cs_sampler_name(cs_u32 number)
{
    return samplers[number].name;
}

const char *cs_sampler_about(cs_u32 number)
{
    return samplers[number].about;
}

int cs_sampler_is_progressive(cs_u32 number)
{
    return samplers[number].progressive;
}

int cs_sampler_is_net(cs_u32 number)
{
#define CS_OR_NET(identifier, name, draw, light, extra, shape, table, progressive, about) \
    || number == CS_SAMPLER_##identifier
    return 0 CS_SAMPLER_LIST_NETS(CS_OR_NET);
#undef CS_OR_NET
}

clshear_status cs_sampler_find(const char *name, cs_u32 *number, cs_error *error)
{
    char names[256] = "";
    *number = default_sampler;
    if (name == NULL) return CLSHEAR_OK;
    for (cs_u32 i = 0; i < CS_SAMPLER_COUNT; i++) {
        const size_t used = strlen(names);
        if (strcmp(name, samplers[i].name) == 0) {
            *number = i;
            return CLSHEAR_OK;
        }
        snprintf(names + used, sizeof names - used, "%s%s", i > 0 ? ", " : "", samplers[i].name);
    }
    return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "sampler \"%s\" is not known; there are %s", name,
                   names);
}

cs_u32 cs_sampler_count(cs_u32 number, cs_u32 wanted)
{
    for (cs_u32 count = wanted; count <= CS_MAX_PATTERN; count++)
        if (samplers[number].shape->has(count)) return count;
    return 0;
}

cs_u32 cs_sampler_most(cs_u32 number)
{
    cs_u32 count = CS_MAX_PATTERN;
    while (!samplers[number].shape->has(count))
        count--;
    return count;
}

cs_pattern cs_pattern_of(cs_u32 number, cs_u32 first, cs_u32 count)
{
    cs_pattern pattern = {.sampler = number, .first = first};
    pattern.blocks = (count + CS_BLOCK - 1) / CS_BLOCK;
    pattern.block_domain = cs_domain_of(pattern.blocks);
    samplers[number].shape->fill(&pattern, count);
    return pattern;
}

/* Sort key of the coherent order: the box of the first pair, then the row. */
typedef struct sort_key {
    cs_u32 box;
    cs_u32 row;
} sort_key;

static int by_box(const void *a, const void *b)
{
    const sort_key *one = a, *other = b;
    if (one->box != other->box) return one->box < other->box ? -1 : 1;
    return one->row < other->row ? -1 : one->row > other->row;
}

/* Sorts rows by boxes in serpentine order, so that neighbours in the table are neighbours in the
 * plane. Returns 0 when out of memory. */
static int sort_rows(cs_table *table)
{
    const cs_u32 count = table->pattern->grid.count;
    sort_key *keys = malloc(count * sizeof *keys);
    cs_u32 *sorted = malloc(count * sizeof *sorted);
    if (keys == NULL || sorted == NULL) {
        free(keys);
        free(sorted);
        return 0;
    }
    for (cs_u32 i = 0; i < count; i++) {
        const cs_u32 column = (cs_u32)((uint64_t)table->place[0][i] * table->boxes[0] >> 32);
        const cs_u32 band = (cs_u32)((uint64_t)table->place[1][i] * table->boxes[1] >> 32);
        const cs_u32 along = band % 2 == 0 ? column : table->boxes[0] - 1 - column;
        keys[i] = (sort_key){band * table->boxes[0] + along, i};
    }
    qsort(keys, count, sizeof *keys, by_box);
    for (cs_u32 w = 0; w < table->words; w++) {
        for (cs_u32 i = 0; i < count; i++)
            sorted[i] = table->word[w][keys[i].row];
        memcpy(table->word[w], sorted, count * sizeof *sorted);
    }
    free(keys);
    free(sorted);
    return 1;
}

/* Appends the filled columns one after another, each padded to whole blocks. */
static int pack(const cs_table *table, cs_array *table_words)
{
    const size_t stride = (size_t)table->pattern->blocks * CS_BLOCK;
    cs_u32 *words = cs_array_extend(table_words, stride * table->words);
    if (words == NULL) return 0;
    for (cs_u32 w = 0; w < table->words; w++)
        memcpy(words + w * stride, table->word[w], table->pattern->grid.count * sizeof *words);
    return 1;
}

static int has_pool(const cs_pattern *pattern)
{
    return samplers[pattern->sampler].shape->fill == shape_sets;
}

cs_u32 cs_pattern_parts(const cs_pattern *pattern)
{
    return has_pool(pattern) ? pattern->shape[0] : 1;
}

void cs_pattern_refresh(cs_pattern *pattern, cs_u32 seed)
{
    if (has_pool(pattern)) pattern->shape[1] = cs_key(0u, seed) | 1u;
}

cs_pattern cs_pattern_of_length(const cs_pattern *like, cs_u32 count)
{
    cs_pattern pattern = cs_pattern_of(like->sampler, 0, cs_sampler_count(like->sampler, count));
    if (has_pool(like)) pattern.shape[1] = like->shape[1];
    return pattern;
}

/* The parts of a table, while they are made. */
typedef struct table_job {
    cs_sample_order order;
    cs_table *parts;
    int *good;
} table_job;

static void make_parts(void *user, size_t begin, size_t end)
{
    const table_job *job = user;
    for (size_t i = begin; i < end; i++) {
        cs_table *table = &job->parts[i];
        job->good[i] = samplers[table->pattern->sampler].make_table(table);
        if (job->good[i] && job->order == CS_ORDER_COHERENT && table->words > 0 &&
            table->boxes[0] > 0)
            job->good[i] = sort_rows(table);
    }
}

/* Points the parts to their columns, one after another in `memory`. */
static void lay_out(const cs_pattern *pattern, cs_u32 parts, cs_u32 *memory, cs_table *table)
{
    for (cs_u32 part = 0; part < parts; part++, table++) {
        table->pattern = pattern;
        table->part = part;
        for (cs_u32 w = 0; w < CS_MOST_WORDS; w++, memory += pattern->grid.count)
            table->word[w] = memory;
        for (cs_u32 d = 0; d < 2; d++, memory += pattern->grid.count)
            table->place[d] = memory;
    }
}

clshear_status cs_sample_table_make(const cs_pattern *pattern, cs_sample_order order,
                                    cs_array *table_words, cs_error *error)
{
    const cs_u32 count = pattern->grid.count, parts = cs_pattern_parts(pattern);
    cs_u32 *memory = calloc((size_t)parts * count * (CS_MOST_WORDS + 2), sizeof *memory);
    table_job job = {order, calloc(parts, sizeof *job.parts), calloc(parts, sizeof *job.good)};
    int good = memory != NULL && job.parts != NULL && job.good != NULL;
    *table_words = (cs_array){.item_size = sizeof(cs_u32)};
    if (good) {
        lay_out(pattern, parts, memory, job.parts);
        cs_parallel(parts > 1 ? 0 : 1, parts, make_parts, &job);
    }
    for (cs_u32 part = 0; good && part < parts; part++) {
        good = job.good[part];
        if (good && job.parts[part].words > 0) good = pack(&job.parts[part], table_words);
    }
    free(memory);
    free(job.parts);
    free(job.good);
    if (good) return CLSHEAR_OK;
    cs_array_free(table_words);
    return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for %u samples of %s", count,
                   samplers[pattern->sampler].name);
}

cs_u32 cs_sampler_default(void)
{
    return default_sampler;
}
