/* Power spectra of point sets: the device sums exponentials, the host keeps half of the plane. */
#include <stddef.h>
#include <stdlib.h>

#include "context/context.h"

enum {
    ROWS = 8,     /* CS_SPECTRUM_ROWS of cl/spectrum.cl */
    LANES = 16,   /* columns are padded to the widest packet */
    CHUNK = 1024, /* points whose exponentials are tabulated at once */
    MOST_SIDE = 8192
};

/* The transform at columns -width/2 ... width/2 and rows 0 ... height/2, both padded: the rest is
 * their mirror image, P(-f) = P(f). */
typedef struct transform {
    cs_device *device;
    uint32_t columns;
    uint32_t rows;
    int32_t first_column;
    cs_buffer *points; /* CHUNK pairs */
    cs_buffer *x[2];   /* exponentials: real, imaginary */
    cs_buffer *y[2];
    cs_buffer *sums;
    cs_buffer *power;
} transform;

static uint32_t padded(size_t count, uint32_t multiple)
{
    return ((uint32_t)count + multiple - 1) / multiple * multiple;
}

static clshear_status prepare(transform *t, size_t width, size_t height, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    t->columns = padded(width / 2 * 2 + 1, LANES);
    t->rows = padded(height / 2 + 1, LANES);
    t->first_column = -(int32_t)(width / 2);
    const size_t plane = (size_t)t->columns * t->rows * sizeof(float);
    CS_TRY(cs_device_prepare(t->device, CS_PROGRAM_ANALYSIS, error));
    CS_TRY(cs_buffer_create(t->device, 2 * CHUNK * sizeof(float), NULL, &t->points, error));
    for (int part = 0; part < 2; part++) {
        CS_TRY(cs_buffer_create(t->device, CHUNK * t->columns * sizeof(float), NULL, &t->x[part],
                                error));
        CS_TRY(
            cs_buffer_create(t->device, CHUNK * t->rows * sizeof(float), NULL, &t->y[part], error));
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

/* Tabulates the exponentials of one coordinate, which is `offset` floats into each point. */
static clshear_status tabulate(const transform *t, uint32_t count, int axis, cs_error *error)
{
    const uint32_t columns = axis == 0 ? t->columns : t->rows, stride = 2;
    const int32_t first = axis == 0 ? t->first_column : 0;
    const uint32_t offset = (uint32_t)axis;
    cs_buffer *const *table = axis == 0 ? t->x : t->y;
    const cs_argument arguments[] = {{.value = &count, .size = sizeof count},
                                     {.value = &columns, .size = sizeof columns},
                                     {.value = &first, .size = sizeof first},
                                     {.value = &stride, .size = sizeof stride},
                                     {.value = &offset, .size = sizeof offset},
                                     {.buffer = t->points},
                                     {.buffer = table[0]},
                                     {.buffer = table[1]}};
    const size_t items = (size_t)count * columns / (size_t)cs_device_packet(t->device);
    return cs_device_run(t->device, CS_KERNEL_EXPONENTIALS, items, arguments, 8, error);
}

/* Adds up to CHUNK points of a set of `all`. */
static clshear_status add_chunk(transform *t, const float *points, uint32_t count, uint32_t begins,
                                uint32_t ends, size_t all, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const float scale = 1.0f / (float)all;
    const cs_argument arguments[] = {{.value = &count, .size = sizeof count},
                                     {.value = &t->columns, .size = sizeof t->columns},
                                     {.value = &t->rows, .size = sizeof t->rows},
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
        (size_t)t->columns / (size_t)cs_device_packet(t->device) * (t->rows / ROWS);
    CS_TRY(cs_buffer_write(t->points, 0, 2 * count * sizeof *points, points, error));
    CS_TRY(tabulate(t, count, 0, error));
    CS_TRY(tabulate(t, count, 1, error));
    CS_TRY(cs_device_run(t->device, CS_KERNEL_PERIODOGRAM, items, arguments, 12, error));
done:
    return status;
}

/* The whole plane from its computed half, as means over sets. */
static clshear_status unfold(const transform *t, clshear_spectrum *spectrum, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const size_t width = spectrum->width, height = spectrum->height;
    float *half = malloc((size_t)t->columns * t->rows * sizeof *half);
    spectrum->power = malloc(width * height * sizeof *spectrum->power);
    CS_REQUIRE(half != NULL && spectrum->power != NULL, CLSHEAR_OUT_OF_MEMORY,
               "out of memory for %zu x %zu frequencies", width, height);
    CS_TRY(cs_buffer_read(t->power, 0, (size_t)t->columns * t->rows * sizeof *half, half, error));
    for (size_t row = 0; row < height; row++)
        for (size_t column = 0; column < width; column++) {
            const ptrdiff_t y = (ptrdiff_t)row - (ptrdiff_t)(height / 2);
            const ptrdiff_t x = (ptrdiff_t)column - (ptrdiff_t)(width / 2);
            const size_t from_row = (size_t)(y < 0 ? -y : y);
            const size_t from_column = (size_t)((y < 0 ? -x : x) - t->first_column);
            spectrum->power[row * width + column] =
                half[from_row * t->columns + from_column] / (float)spectrum->sets;
        }
done:
    free(half);
    return status;
}

static clshear_status check(const clshear_points *points, size_t width, size_t height,
                            cs_error *error)
{
    if (points->dimensions != 2)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "a spectrum of points of %zu dimensions: must be 2; choose a projection",
                       points->dimensions);
    if (width < 2 || height < 2 || width > MOST_SIDE || height > MOST_SIDE)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "a spectrum of %zu x %zu frequencies: each side must be 2 to %d", width,
                       height, MOST_SIDE);
    for (size_t i = 0; i < 2 * points->sets * points->count; i++)
        if (!(points->values[i] >= 0.0f && points->values[i] < 1.0f))
            return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                           "point %zu of set %zu: coordinate %g must be in [0, 1)",
                           i / 2 % points->count, i / 2 / points->count, (double)points->values[i]);
    return CLSHEAR_OK;
}

clshear_status clshear_spectrum_measure(clshear_context *context, const clshear_points *points,
                                        size_t width, size_t height, clshear_spectrum *spectrum)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = &context->error;
    transform t = {.device = context->device};
    clshear_spectrum made = {
        .width = width, .height = height, .sets = points->sets, .count = points->count};
    CS_TRY(check(points, width, height, error));
    CS_TRY(prepare(&t, width, height, error));
    for (size_t set = 0; set < points->sets; set++)
        for (size_t first = 0; first < points->count; first += CHUNK) {
            const size_t left = points->count - first, count = left < CHUNK ? left : CHUNK;
            CS_TRY(add_chunk(&t, points->values + 2 * (set * points->count + first),
                             (uint32_t)count, first == 0, left == count, points->count, error));
        }
    CS_TRY(unfold(&t, &made, error));
    *spectrum = made;
    made.power = NULL;
done:
    free(made.power);
    release(&t);
    return status;
}

void clshear_spectrum_free(clshear_spectrum *spectrum)
{
    if (spectrum == NULL) return;
    free(spectrum->power);
    *spectrum = (clshear_spectrum){0};
}
