#include "oracle/choose_rule.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A summed-area table of (width + 1) * (height + 1) values. */
typedef struct summed_area {
    double *sum;
    size_t stride;
} summed_area;

static void fill_sums(summed_area *t, int width, int height, const cs_f32 *values,
                      const cs_f32 *where)
{
    for (int y = 0; y < height; y++) {
        double row = 0.0;
        for (int x = 0; x < width; x++) {
            const size_t i = (size_t)y * (size_t)width + (size_t)x;
            if (where[i] >= 0.0f) row += values != NULL ? (double)values[i] : 1.0;
            t->sum[((size_t)y + 1) * t->stride + (size_t)x + 1] =
                t->sum[(size_t)y * t->stride + (size_t)x + 1] + row;
        }
    }
}

static double sum_around(const summed_area *t, int width, int height, int x, int y, int radius)
{
    const size_t x0 = (size_t)(x > radius ? x - radius : 0);
    const size_t y0 = (size_t)(y > radius ? y - radius : 0);
    const size_t x1 = (size_t)(x + radius + 1 < width ? x + radius + 1 : width);
    const size_t y1 = (size_t)(y + radius + 1 < height ? y + radius + 1 : height);
    return t->sum[y1 * t->stride + x1] - t->sum[y0 * t->stride + x1] - t->sum[y1 * t->stride + x0] +
           t->sum[y0 * t->stride + x0];
}

/* Fills tables of the candidate's variance, the prior's variance, and the number of
 * observations. */
static void tabulate(summed_area *tables, int width, int height, const cs_evidence *evidence)
{
    fill_sums(&tables[0], width, height, evidence->variance, evidence->variance);
    fill_sums(&tables[1], width, height, evidence->prior, evidence->variance);
    fill_sums(&tables[2], width, height, NULL, evidence->variance);
}

/* Ratio of the candidate's variance to the prior's around a pixel. The ratio of the whole picture
 * enters with the weight of `trust` pixels. */
static double ratio_at(const summed_area *tables, int width, int height, int x, int y, int radius)
{
    const double trust = 30.0;
    const size_t last = tables[0].stride * ((size_t)height + 1) - 1;
    const double all = tables[1].sum[last];
    if (!(all > 0.0)) return 1.0;
    const double everywhere = tables[0].sum[last] / all;
    const double here = sum_around(&tables[1], width, height, x, y, radius);
    const double count = sum_around(&tables[2], width, height, x, y, radius);
    if (!(here > 0.0)) return everywhere;
    const double local = sum_around(&tables[0], width, height, x, y, radius) / here;
    if (!(local > 0.0)) return everywhere;
    return exp((log(local) * count + log(everywhere) * trust) / (count + trust));
}

enum {
    TABLES = 3
};

size_t cs_pilot_choose_bytes(void)
{
    return TABLES * sizeof(double) + sizeof(cs_f32);
}

clshear_status cs_pilot_choose(const cs_evidence *evidence, cs_rule prior, int width, int height,
                               int radius, uint8_t *rules, cs_error *error)
{
    const double clear = 0.8; /* largest ratio of variances at which a rule replaces the prior */
    const size_t pixels = (size_t)width * (size_t)height;
    const size_t stride = (size_t)width + 1, size = stride * ((size_t)height + 1);
    double *memory = calloc(TABLES * size, sizeof *memory);
    cs_f32 *best = malloc(pixels * sizeof *best);
    if (memory == NULL || best == NULL) {
        free(memory);
        free(best);
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for the pilot");
    }
    summed_area tables[TABLES] = {
        {memory, stride}, {memory + size, stride}, {memory + 2 * size, stride}};
    memset(rules, (int)prior, pixels);
    for (size_t i = 0; i < pixels; i++)
        best[i] = (cs_f32)clear;
    for (int rule = 0; rule < CS_RULE_COUNT; rule++) {
        if (rule == (int)prior || evidence[rule].variance == NULL) continue;
        tabulate(tables, width, height, &evidence[rule]);
        for (size_t i = 0; i < pixels; i++) {
            const int x = (int)(i % (size_t)width), y = (int)(i / (size_t)width);
            const cs_f32 ratio = (cs_f32)ratio_at(tables, width, height, x, y, radius);
            if (ratio >= best[i]) continue;
            best[i] = ratio;
            rules[i] = (uint8_t)rule;
        }
    }
    free(memory);
    free(best);
    return CLSHEAR_OK;
}
