/* Planar sets with power regions of equal capacity: blue noise by optimal transport.
 *
 * A fine raster of the torus is divided among the points by power distance. The weights move until
 * all regions have the same area, and the points move to the centroids of their regions (de Goes et
 * al. 2012, section 4; both steps at once, on a raster). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/pi.h"
#include "clshear/device/sampler/net.h"
#include "pattern/table_makers.h"

enum {
    PIXELS = 10,     /* raster pixels along the side of a mean region */
    STEPS = 100,     /* steps of points and weights */
    FLOWS = 3,       /* passes over the low frequencies */
    FREQUENCIES = 24 /* highest frequency along an axis */
};

typedef struct raster {
    cs_i32 side;
    cs_i32 reach; /* limit of a region's extent from its point, px */
    cs_u32 count;
    cs_f32 *x, *y, *weight; /* x, y in pixels, weight in pixels squared; one per point */
    cs_f32 *distance;       /* power distance of each pixel to its owner */
    cs_u32 *owner;
    cs_f32 *sums; /* per point: area, and x and y moments relative to the point */
} raster;

static cs_i32 wrap(cs_i32 at, cs_i32 side)
{
    if (at < 0) return at + side;
    if (at >= side) return at - side;
    return at;
}

/* Assigns each pixel to the point with the smallest power distance. */
static void assign_pixels(raster *r)
{
    const cs_i32 side = r->side, reach = r->reach;
    for (cs_i32 i = 0; i < side * side; i++)
        r->distance[i] = INFINITY;
    for (cs_u32 k = 0; k < r->count; k++) {
        const cs_i32 column = (cs_i32)r->x[k], row = (cs_i32)r->y[k];
        for (cs_i32 j = -reach; j <= reach; j++) {
            const cs_f32 dy = (cs_f32)(row + j) + 0.5f - r->y[k];
            const cs_f32 base = dy * dy - r->weight[k];
            const size_t line = (size_t)wrap(row + j, side) * (size_t)side;
            for (cs_i32 i = -reach; i <= reach; i++) {
                const cs_f32 dx = (cs_f32)(column + i) + 0.5f - r->x[k];
                const size_t at = line + (size_t)wrap(column + i, side);
                if (base + dx * dx >= r->distance[at]) continue;
                r->distance[at] = base + dx * dx;
                r->owner[at] = k;
            }
        }
    }
}

/* The shortest difference a - b on a torus of this side. */
static cs_f32 towards(cs_f32 a, cs_f32 b, cs_f32 side)
{
    const cs_f32 way = a - b;
    if (way > 0.5f * side) return way - side;
    if (way < -0.5f * side) return way + side;
    return way;
}

static void sum_regions(raster *r)
{
    const cs_f32 side = (cs_f32)r->side;
    memset(r->sums, 0, 3 * (size_t)r->count * sizeof *r->sums);
    for (cs_i32 j = 0; j < r->side; j++)
        for (cs_i32 i = 0; i < r->side; i++) {
            const size_t at = (size_t)j * (size_t)r->side + (size_t)i;
            if (isinf(r->distance[at])) continue;
            const cs_u32 k = r->owner[at];
            r->sums[3 * k] += 1.0f;
            r->sums[3 * k + 1] += towards((cs_f32)i + 0.5f, r->x[k], side);
            r->sums[3 * k + 2] += towards((cs_f32)j + 0.5f, r->y[k], side);
        }
}

static cs_f32 on_torus(cs_f32 at, cs_f32 side)
{
    at -= side * floorf(at / side);
    return at < side ? at : 0.0f;
}

/* A region of mean width w grows by about 1.75 times the change of its weight; half of the
 * corresponding step is stable. */
static void update_points(raster *r)
{
    const cs_f32 side = (cs_f32)r->side, capacity = side * side / (cs_f32)r->count;
    for (cs_u32 k = 0; k < r->count; k++) {
        const cs_f32 *sum = r->sums + 3 * (size_t)k;
        r->weight[k] += 0.3f * (capacity - sum[0]);
        if (sum[0] < 1.0f) continue;
        r->x[k] = on_torus(r->x[k] + sum[1] / sum[0], side);
        r->y[k] = on_torus(r->y[k] + sum[2] / sum[0], side);
    }
}

static int allocate_raster(raster *r)
{
    const size_t pixels = (size_t)r->side * (size_t)r->side;
    r->weight = calloc(r->count, sizeof *r->weight);
    r->distance = calloc(pixels, sizeof *r->distance);
    r->owner = calloc(pixels, sizeof *r->owner);
    r->sums = malloc(3 * (size_t)r->count * sizeof *r->sums);
    return r->weight != NULL && r->distance != NULL && r->owner != NULL && r->sums != NULL;
}

static void relax(raster *r)
{
    const cs_f32 side = (cs_f32)r->side;
    for (cs_u32 k = 0; k < r->count; k++) {
        r->x[k] *= side;
        r->y[k] *= side;
    }
    for (int step = 0; step < STEPS; step++) {
        assign_pixels(r);
        sum_regions(r);
        update_points(r);
    }
    for (cs_u32 k = 0; k < r->count; k++) {
        r->x[k] /= side;
        r->y[k] /= side;
    }
}

/* exp(2 pi i a x) for a = 0 ... most, as real and imaginary parts. */
static void harmonics(cs_f32 x, int most, double (*power)[2])
{
    const double c = cos(6.283185307179586 * (double)x), s = sin(6.283185307179586 * (double)x);
    power[0][0] = 1.0;
    power[0][1] = 0.0;
    for (int a = 1; a <= most; a++) {
        power[a][0] = power[a - 1][0] * c - power[a - 1][1] * s;
        power[a][1] = power[a - 1][0] * s + power[a - 1][1] * c;
    }
}

/* exp(2 pi i (a x + b y)) from the harmonics; b may be negative. */
static void mode(double (*px)[2], double (*py)[2], int a, int b, double *value)
{
    const double re = py[abs(b)][0], im = b < 0 ? -py[abs(b)][1] : py[abs(b)][1];
    value[0] = px[a][0] * re - px[a][1] * im;
    value[1] = px[a][0] * im + px[a][1] * re;
}

/* Moves the points by the gradient field with div u = density, which cancels the density's low
 * frequencies, up to `most` along each axis, to first order. The weights equalise neighbouring
 * regions; this step evens out larger ones. */
static void flow(cs_u32 count, int most, cs_f32 *x, cs_f32 *y, double (*density)[2])
{
    double px[FREQUENCIES + 1][2], py[FREQUENCIES + 1][2], value[2];
    const int span = 2 * most + 1;
    memset(density, 0, (size_t)((most + 1) * span) * sizeof *density);
    for (cs_u32 k = 0; k < count; k++) {
        harmonics(x[k], most, px), harmonics(y[k], most, py);
        for (int a = 0; a <= most; a++)
            for (int b = -most; b <= most; b++) {
                mode(px, py, a, b, value);
                density[a * span + b + most][0] += value[0] / count;
                density[a * span + b + most][1] -= value[1] / count;
            }
    }
    for (cs_u32 k = 0; k < count; k++) {
        double way[2] = {0.0, 0.0};
        harmonics(x[k], most, px), harmonics(y[k], most, py);
        for (int a = 0; a <= most; a++)
            for (int b = a > 0 ? -most : 1; b <= most; b++) {
                const double *d = density[a * span + b + most];
                mode(px, py, a, b, value);
                /* twice the real part of -i d / (2 pi |k|^2) exp(2 pi i k x) */
                const double part =
                    (d[0] * value[1] + d[1] * value[0]) / (CS_PI_DOUBLE * (a * a + b * b));
                way[0] += a * part;
                way[1] += b * part;
            }
        x[k] = on_torus(x[k] + (cs_f32)way[0], 1.0f);
        y[k] = on_torus(y[k] + (cs_f32)way[1], 1.0f);
    }
}

/* Starts from a scrambled (0,2)-sequence, so that points have short distances to move. */
int cs_ccvt_points(cs_u32 count, cs_u32 seed, cs_f32 *x, cs_f32 *y)
{
    raster r = {.count = count, .x = x, .y = y};
    const int third = (int)(0.3 * sqrt((double)count));
    const int most = third < FREQUENCIES ? third : FREQUENCIES;
    double(*density)[2] = malloc((size_t)((most + 1) * (2 * most + 1)) * sizeof *density);
    r.side = (cs_i32)ceil(PIXELS * sqrt((double)count));
    r.reach = 2 * PIXELS < (r.side - 1) / 2 ? 2 * PIXELS : (r.side - 1) / 2;
    const int good = allocate_raster(&r) && density != NULL;
    for (cs_u32 k = 0; good && k < count; k++) {
        x[k] = cs_scrambled(k, seed, 0u);
        y[k] = cs_scrambled(cs_pascal(k), seed, 1u);
    }
    if (good) relax(&r);
    for (int pass = 0; good && pass < FLOWS; pass++)
        flow(count, most, x, y, density);
    free(density);
    free(r.weight);
    free(r.distance);
    free(r.owner);
    free(r.sums);
    return good;
}
