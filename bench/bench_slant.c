/* Effect of a surface's slope on the shear, and the gain of following it. A checkered plane has a
 * shear that changes by `slope` pixels per row, as the floor's does below the horizon. A point
 * projected to (p, q), relative to the pixel's centre, is seen along x + s u = p, y + s v = q with
 * s = shear + slope * q. The result is the variance of one pattern, averaged over offsets of the
 * texture.
 *
 *   bench_slant [--offsets N] [--replicates N] */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "clshear/device/hash.h"
#include "clshear/device/sampler/sampler.h"
#include "clshear/device/shear.h"
#include "measure.h"
#include "optics/optics.h"
#include "pattern/pattern.h"

enum {
    NONE,
    CENTRE,  /* the shear of the pixel's centre for all samples */
    BY_ROW,  /* the shear of the sample's row in x: the closed-form limit */
    FRONTAL, /* a plane without slope: the upper limit of the gain */
    WAYS
};

typedef struct plane {
    double shear;
    double slope;
    double cell_px;
    double offset[2];
} plane;

static double is_white(const plane *p, cs_camera_sample point)
{
    const double v = (double)point.v, u = (double)point.u;
    const double row = ((double)point.y - 0.5 + p->shear * v) / (1.0 - p->slope * v);
    const double column = (double)point.x - 0.5 + (p->shear + p->slope * row) * u;
    const double cell =
        floor((column + p->offset[0]) / p->cell_px) + floor((row + p->offset[1]) / p->cell_px);
    return fmod(fabs(cell), 2.0);
}

/* Shears each axis by its own amount, the second axis first. */
static cs_camera_sample by_row(const cs_f32 *t, const plane *p)
{
    cs_camera_sample point;
    const cs_blur down = cs_blur_of((cs_f32)p->shear, 1.0f);
    point.v = down.sign * (cs_trapezoid(t[1], t[3], down.y, &point.y) - 0.5f);
    const cs_f32 row = point.y - 0.5f + (cs_f32)p->shear * point.v;
    const cs_blur across = cs_blur_of((cs_f32)(p->shear + p->slope * (double)row), 1.0f);
    point.u = across.sign * (cs_trapezoid(t[0], t[2], across.x, &point.x) - 0.5f);
    return point;
}

/* Computes the mean of one pattern for every way. */
static void pattern_means(const cs_pattern *pattern, const cs_u32 *rows, cs_u32 key, const plane *p,
                          const cs_optics_tables *lens, double *mean)
{
    plane frontal = *p;
    frontal.slope = 0.0;
    for (int way = 0; way < WAYS; way++)
        mean[way] = 0.0;
    for (cs_u32 i = 0; i < pattern->grid.count; i++) {
        cs_f32 t[CS_DIMENSIONS] = {0};
        cs_draw(pattern, rows, key, i, t);
        const cs_f32 *table = lens->table.items;
        const cs_camera_sample plain =
            cs_shear(t[0], t[1], t[2], t[3], CS_SHEAR_NONE, &lens->optics, table, 0.0f);
        const cs_camera_sample sheared = cs_shear(t[0], t[1], t[2], t[3], CS_SHEAR_EQUAL_AREA,
                                                  &lens->optics, table, (cs_f32)p->shear);
        mean[NONE] += is_white(p, plain);
        mean[CENTRE] += is_white(p, sheared);
        mean[BY_ROW] += is_white(p, by_row(t, p));
        mean[FRONTAL] += is_white(&frontal, sheared);
    }
    for (int way = 0; way < WAYS; way++)
        mean[way] /= pattern->grid.count;
}

static void measure_plane(plane p, cs_u32 count, cs_u32 offsets, cs_u32 replicates,
                          const cs_optics_tables *lens)
{
    cs_error error;
    cs_array rows = {0};
    double variance[WAYS] = {0};
    const cs_pattern pattern = cs_pattern_of(CS_SAMPLER_SZ, 0, count);
    if (cs_sample_table_make(&pattern, CS_ORDER_SEQUENCE, &rows, &error) != CLSHEAR_OK) exit(1);
    for (cs_u32 o = 0; o < offsets; o++) {
        double sum[WAYS] = {0}, square[WAYS] = {0}, mean[WAYS];
        for (cs_u32 axis = 0; axis < 2; axis++)
            p.offset[axis] = 2.0 * p.cell_px * 0x1p-32 * cs_key(o + 1u, axis);
        for (cs_u32 r = 0; r < replicates; r++) {
            pattern_means(&pattern, rows.items, cs_pattern_key(o, 7, r), &p, lens, mean);
            for (int way = 0; way < WAYS; way++) {
                sum[way] += mean[way];
                square[way] += mean[way] * mean[way];
            }
        }
        for (int way = 0; way < WAYS; way++)
            variance[way] += (square[way] - sum[way] * sum[way] / replicates) / (replicates - 1);
    }
    printf("| %u | %.0f | %.2f | %.0f |", count, p.shear, p.slope, p.cell_px);
    for (int way = 0; way < WAYS; way++)
        printf(" %.2e |", variance[way] / offsets);
    printf("\n");
    cs_array_free(&rows);
}

int main(int argc, char **argv)
{
    static const double shears[] = {5, 16, -16}, slopes[] = {0.05, 0.16, 0.3}, cells[] = {4, 20};
    int offsets = 60, replicates = 40;
    const bench_flag flags[] = {{.name = "offsets", .number = &offsets},
                                {.name = "replicates", .number = &replicates}};
    bench_read_flags(argc, argv, flags, sizeof flags / sizeof *flags);
    if (offsets < 1 || replicates < 2) return 2;
    const cs_view view = {.aperture = CLSHEAR_APERTURE_SQUARE};
    cs_optics_tables lens = {0};
    cs_error error;
    if (cs_optics_make(&view, CLSHEAR_FILTER_BOX, 0.0f, &lens, &error) != CLSHEAR_OK) return 1;
    printf("| N | shear | slope | cell | none | centre | by row | no slope |\n"
           "|---|---|---|---|---|---|---|---|\n");
    for (cs_u32 count = 256; count <= 1024; count *= 4)
        for (int s = 0; s < 3; s++)
            for (int g = 0; g < 3; g++)
                for (int c = 0; c < 2; c++)
                    measure_plane((plane){shears[s], slopes[g], cells[c], {0, 0}}, count,
                                  (cs_u32)offsets, (cs_u32)replicates, &lens);
    cs_optics_free(&lens);
    return 0;
}
