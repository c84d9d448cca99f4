/* Poisson disk sets of an exact number of points on the torus. */
#include <math.h>
#include <stdlib.h>

#include "clshear/device/hash.h"
#include "pattern/table_makers.h"

/* Points by cells of the torus. A cell is at least as wide as the radius. */
typedef struct cells {
    cs_u32 side;  /* cells along an axis */
    cs_i32 *head; /* first point of a cell, or -1 */
    cs_i32 *next; /* next point in the same cell, or -1; one per point */
} cells;

static cs_f32 torus_difference(cs_f32 a, cs_f32 b)
{
    const cs_f32 difference = fabsf(a - b);
    return difference > 0.5f ? 1.0f - difference : difference;
}

static cs_u32 cell_of(const cells *in, cs_f32 coordinate)
{
    const cs_u32 cell = (cs_u32)(coordinate * (cs_f32)in->side);
    return cell < in->side ? cell : in->side - 1;
}

static int is_free(const cells *in, const cs_f32 *x, const cs_f32 *y, cs_f32 px, cs_f32 py,
                   cs_f32 radius)
{
    const cs_u32 side = in->side, column = cell_of(in, px), row = cell_of(in, py);
    const cs_u32 reach = side < 3 ? side : 3; /* with fewer than 3 cells each is visited once */
    for (cs_u32 j = 0; j < reach; j++)
        for (cs_u32 i = 0; i < reach; i++) {
            const cs_u32 cell = (row + side + j - 1) % side * side + (column + side + i - 1) % side;
            for (cs_i32 k = in->head[cell]; k >= 0; k = in->next[k]) {
                const cs_f32 dx = torus_difference(x[k], px), dy = torus_difference(y[k], py);
                if (dx * dx + dy * dy < radius * radius) return 0;
            }
        }
    return 1;
}

/* Throws darts with a radius that starts at 0.8 of the densest packing's and shrinks a little after
 * every run of misses (McCool & Fiume 1992). */
static void throw_darts(cs_u32 count, cs_u32 seed, cs_f32 *x, cs_f32 *y, cells *in, cs_f32 radius)
{
    const cs_u32 patience = 300;
    cs_u32 placed = 0, misses = 0;
    for (cs_u32 dart = 0; placed < count; dart++) {
        const cs_f32 px = (cs_f32)(cs_key(seed, 2 * dart) >> 8) * 0x1p-24f;
        const cs_f32 py = (cs_f32)(cs_key(seed, 2 * dart + 1) >> 8) * 0x1p-24f;
        if (is_free(in, x, y, px, py, radius)) {
            const cs_u32 cell = cell_of(in, py) * in->side + cell_of(in, px);
            x[placed] = px;
            y[placed] = py;
            in->next[placed] = in->head[cell];
            in->head[cell] = (cs_i32)placed++;
            misses = 0;
        } else if (++misses == patience) {
            radius *= 0.995f;
            misses = 0;
        }
    }
}

int cs_poisson_points(cs_u32 count, cs_u32 seed, cs_f32 *x, cs_f32 *y)
{
    const cs_f32 radius = 0.8f * sqrtf(1.1547005f / (cs_f32)count);
    cells in = {.side = radius < 1.0f ? (cs_u32)(1.0f / radius) : 1};
    in.head = malloc((size_t)in.side * in.side * sizeof *in.head);
    in.next = malloc(count * sizeof *in.next);
    const int good = in.head != NULL && in.next != NULL;
    if (good) {
        for (cs_u32 i = 0; i < in.side * in.side; i++)
            in.head[i] = -1;
        throw_darts(count, seed, x, y, &in, radius);
    }
    free(in.head);
    free(in.next);
    return good;
}
