/* Point sets whose Voronoi regions have equal capacity: blue noise by optimal transport.
 *
 * Every point owns the pixels of a fine raster of the torus that are nearest to it by power
 * distance. Weights are moved until all regions are equally large, and points to the centroids of
 * their regions (de Goes et al. 2012, section 4, both at once and on a raster). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pattern/rows.h"

enum {
    PIXELS = 12,  /* of the raster, along a point's mean region */
    MOVES = 120,  /* of points and weights */
    BALANCES = 40 /* of weights alone, after that */
};

typedef struct raster {
    i32 side;
    i32 reach; /* a region lies within this many pixels of its point */
    u32 count;
    f32 *x, *y, *weight; /* of points; pixels, and their squares */
    f32 *distance;       /* of a pixel to its owner */
    u32 *owner;
    f32 *sums; /* of pixels, x and y of a region relative to its point: 3 for each */
} raster;

static i32 wrap(i32 at, i32 side)
{
    return at < 0 ? at + side : at >= side ? at - side : at;
}

/* Lets every point claim what is nearer to it than to those before it. */
static void assign(raster *r)
{
    const i32 side = r->side, reach = r->reach;
    for (i32 i = 0; i < side * side; i++)
        r->distance[i] = INFINITY;
    for (u32 k = 0; k < r->count; k++) {
        const i32 column = (i32)r->x[k], row = (i32)r->y[k];
        for (i32 j = -reach; j <= reach; j++) {
            const f32 dy = (f32)(row + j) + 0.5f - r->y[k];
            const f32 base = dy * dy - r->weight[k];
            const size_t line = (size_t)wrap(row + j, side) * (size_t)side;
            for (i32 i = -reach; i <= reach; i++) {
                const f32 dx = (f32)(column + i) + 0.5f - r->x[k];
                const size_t at = line + (size_t)wrap(column + i, side);
                if (base + dx * dx >= r->distance[at]) continue;
                r->distance[at] = base + dx * dx;
                r->owner[at] = k;
            }
        }
    }
}

/* The way from b to a that does not leave the torus's half. */
static f32 towards(f32 a, f32 b, f32 side)
{
    const f32 way = a - b;
    return way > 0.5f * side ? way - side : way < -0.5f * side ? way + side : way;
}

static void gather(raster *r)
{
    const f32 side = (f32)r->side;
    memset(r->sums, 0, 3 * (size_t)r->count * sizeof *r->sums);
    for (i32 j = 0; j < r->side; j++)
        for (i32 i = 0; i < r->side; i++) {
            const size_t at = (size_t)j * (size_t)r->side + (size_t)i;
            if (isinf(r->distance[at])) continue;
            const u32 k = r->owner[at];
            r->sums[3 * k] += 1.0f;
            r->sums[3 * k + 1] += towards((f32)i + 0.5f, r->x[k], side);
            r->sums[3 * k + 2] += towards((f32)j + 0.5f, r->y[k], side);
        }
}

static f32 on_torus(f32 at, f32 side)
{
    at -= side * floorf(at / side);
    return at < side ? at : 0.0f;
}

/* A region of mean width w grows by about 1.75 times what its weight does; half of that step is
 * stable. */
static void improve(raster *r, int move)
{
    const f32 side = (f32)r->side, capacity = side * side / (f32)r->count;
    for (u32 k = 0; k < r->count; k++) {
        const f32 *sum = r->sums + 3 * (size_t)k;
        r->weight[k] += 0.3f * (capacity - sum[0]);
        if (!move || sum[0] < 1.0f) continue;
        r->x[k] = on_torus(r->x[k] + sum[1] / sum[0], side);
        r->y[k] = on_torus(r->y[k] + sum[2] / sum[0], side);
    }
}

static int reserve(raster *r)
{
    const size_t pixels = (size_t)r->side * (size_t)r->side;
    r->weight = calloc(r->count, sizeof *r->weight);
    r->distance = malloc(pixels * sizeof *r->distance);
    r->owner = calloc(pixels, sizeof *r->owner);
    r->sums = malloc(3 * (size_t)r->count * sizeof *r->sums);
    return r->weight != NULL && r->distance != NULL && r->owner != NULL && r->sums != NULL;
}

int cs_ccvt_points(u32 count, u32 seed, f32 *x, f32 *y)
{
    raster r = {.count = count, .x = x, .y = y};
    r.side = (i32)ceil(PIXELS * sqrt((double)count));
    r.reach = 2 * PIXELS < (r.side - 1) / 2 ? 2 * PIXELS : (r.side - 1) / 2;
    int good = reserve(&r) && cs_poisson_points(count, seed, x, y);
    for (u32 k = 0; good && k < count; k++) {
        x[k] *= (f32)r.side;
        y[k] *= (f32)r.side;
    }
    for (int step = 0; good && step < MOVES + BALANCES; step++) {
        assign(&r);
        gather(&r);
        improve(&r, step < MOVES || step == MOVES + BALANCES - 1);
    }
    for (u32 k = 0; good && k < count; k++) {
        x[k] /= (f32)r.side;
        y[k] /= (f32)r.side;
        if (x[k] >= 1.0f) x[k] = 0.0f;
        if (y[k] >= 1.0f) y[k] = 0.0f;
    }
    free(r.weight);
    free(r.distance);
    free(r.owner);
    free(r.sums);
    return good;
}
