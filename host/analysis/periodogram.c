/* Power spectra of point sets. The device tabulates complex exponentials and multiplies them. */
#include "analysis/periodogram.h"

#include <stdlib.h>

enum {
    ROWS = 8,    /* equals CS_SPECTRUM_ROWS of cl/spectrum.cl */
    LANES = 16,  /* columns are a multiple of the widest packet */
    CHUNK = 1024 /* points per launch */
};

typedef struct transform {
    cs_device *device;
    const cs_lattice *lattice;
    uint32_t counts[2]; /* columns and rows, padded */
    uint32_t stride;    /* floats from one point to the next */
    cs_buffer *points;  /* coordinates of CHUNK points */
    cs_buffer *x[2];    /* exponentials of columns: real, imaginary */
    cs_buffer *y[2];    /* exponentials of rows: real, imaginary */
    cs_buffer *sums;
    cs_buffer *power;
} transform;

static clshear_status prepare(transform *t, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    for (int side = 0; side < 2; side++)
        t->counts[side] = (t->lattice->counts[side] + LANES - 1) / LANES * LANES;
    const size_t plane = (size_t)t->counts[0] * t->counts[1] * sizeof(float);
    CS_TRY(cs_device_prepare(t->device, CS_PROGRAM_ANALYSIS, 0, error));
    CS_TRY(cs_buffer_create(t->device, t->stride * CHUNK * sizeof(float), NULL, &t->points, error));
    for (int part = 0; part < 2; part++) {
        CS_TRY(cs_buffer_create(t->device, CHUNK * t->counts[0] * sizeof(float), NULL, &t->x[part],
                                error));
        CS_TRY(cs_buffer_create(t->device, CHUNK * t->counts[1] * sizeof(float), NULL, &t->y[part],
                                error));
    }
    CS_TRY(cs_buffer_create(t->device, 2 * plane, NULL, &t->sums, error));
    CS_TRY(cs_buffer_create(t->device, plane, NULL, &t->power, error));
done:
    return status;
}

static void release(transform *t)
{
    for (int part = 0; part < 2; part++) {
        cs_buffer_free(t->x[part]);
        cs_buffer_free(t->y[part]);
    }
    cs_buffer_free(t->points);
    cs_buffer_free(t->sums);
    cs_buffer_free(t->power);
}

/* Tabulates the exponentials of columns (side 0) or rows (side 1). */
static clshear_status tabulate(const transform *t, uint32_t count, int side, cs_error *error)
{
    cs_buffer *const *table = side == 0 ? t->x : t->y;
    const cs_frequencies *set = &t->lattice->sets[side];
    const cs_argument arguments[] = {{.value = &count, .size = sizeof count},
                                     {.value = &t->counts[side], .size = sizeof t->counts[side]},
                                     {.value = set, .size = sizeof *set},
                                     {.value = &t->stride, .size = sizeof t->stride},
                                     {.buffer = t->points},
                                     {.buffer = table[0]},
                                     {.buffer = table[1]}};
    const size_t items = (size_t)count * t->counts[side] / (size_t)cs_device_packet(t->device);
    return CS_RUN(t->device, EXPONENTIALS, items, arguments, error);
}

/* Adds up to CHUNK points of a set of `all` points. */
static clshear_status add_chunk(transform *t, const float *points, uint32_t count, uint32_t begins,
                                uint32_t ends, size_t all, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const float scale = 1.0f / (float)all;
    const cs_argument arguments[] = {{.value = &count, .size = sizeof count},
                                     {.value = &t->counts[0], .size = sizeof t->counts[0]},
                                     {.value = &t->counts[1], .size = sizeof t->counts[1]},
                                     {.value = &begins, .size = sizeof begins},
                                     {.value = &ends, .size = sizeof ends},
                                     {.value = &scale, .size = sizeof scale},
                                     {.buffer = t->x[0]},
                                     {.buffer = t->x[1]},
                                     {.buffer = t->y[0]},
                                     {.buffer = t->y[1]},
                                     {.buffer = t->sums},
                                     {.buffer = t->power}};
    const size_t items =
        (size_t)t->counts[0] / (size_t)cs_device_packet(t->device) * (t->counts[1] / ROWS);
    CS_TRY(cs_buffer_write(t->points, 0, t->stride * count * sizeof *points, points, error));
    CS_TRY(tabulate(t, count, 0, error));
    CS_TRY(tabulate(t, count, 1, error));
    CS_TRY(CS_RUN(t->device, PERIODOGRAM, items, arguments, error));
done:
    return status;
}

/* Reads the power, averages it over the sets and drops the padding. */
static clshear_status read_power(const transform *t, size_t sets, float *power, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const size_t columns = t->lattice->counts[0], padded = t->counts[0];
    float *all = malloc(padded * t->counts[1] * sizeof *all);
    CS_REQUIRE(all != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu frequencies",
               padded * t->counts[1]);
    CS_TRY(cs_buffer_read(t->power, 0, padded * t->counts[1] * sizeof *all, all, error));
    for (size_t row = 0; row < t->lattice->counts[1]; row++)
        for (size_t column = 0; column < columns; column++)
            power[row * columns + column] = all[row * padded + column] / (float)sets;
done:
    free(all);
    return status;
}

static clshear_status check_points(const clshear_points *points, cs_error *error)
{
    const size_t stride = points->dimensions;
    for (size_t i = 0; i < stride * points->sets * points->count; i++)
        if (!(points->values[i] >= 0.0f && points->values[i] < 1.0f))
            return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                           "point %zu of set %zu: coordinate %g must be in [0, 1)",
                           i / stride % points->count, i / stride / points->count,
                           (double)points->values[i]);
    return CLSHEAR_OK;
}

clshear_status cs_periodogram(cs_device *device, const clshear_points *points,
                              const cs_lattice *lattice, float *power, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    transform t = {.device = device, .lattice = lattice, .stride = (uint32_t)points->dimensions};
    CS_TRY(check_points(points, error));
    CS_TRY(prepare(&t, error));
    for (size_t set = 0; set < points->sets; set++)
        for (size_t first = 0; first < points->count; first += CHUNK) {
            const size_t left = points->count - first, count = left < CHUNK ? left : CHUNK;
            const float *chunk =
                points->values + points->dimensions * (set * points->count + first);
            CS_TRY(add_chunk(&t, chunk, (uint32_t)count, first == 0, left == count, points->count,
                             error));
        }
    CS_TRY(read_power(&t, points->sets, power, error));
done:
    release(&t);
    return status;
}
