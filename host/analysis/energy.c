/* Energy of a function of four or five coordinates at frequencies of one, two or all of them.
 *
 * The function is sampled on several grids, each shifted by a random part of a cell. Within each
 * cell the other coordinates follow a randomly shifted lattice. The transform of one grid is the
 * sum of the function's coefficient at k, aliases, and noise. The shift turns the phase of the
 * coefficient by a known angle, which is removed, and the phases of the aliases by others. Aliases
 * and noise are therefore independent between grids with mean 0, and the mean product of two
 * different grids is |f|^2. */
#include "analysis/energy.h"

#include <fftw3.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "analysis/fourier.h"
#include "base/pi.h"
#include "clshear/device/hash.h"

enum {
    MOST_DIMENSIONS = 5,
    CHUNK = 1 << 16 /* points per call of the function */
};

typedef struct accumulation {
    const cs_part_marginal *marginal;
    clshear_function function;
    void *user;
    size_t cells;
    size_t coefficients;
    double *grid;
    fftw_complex *transform;
    fftw_complex *sum;
    double shift[MOST_DIMENSIONS]; /* shift of the current grid, in cells */
    float *points;                 /* CHUNK points */
    float *values;                 /* values at these points */
    fftw_plan plan;
} accumulation;

/* Computes point number `index` of a grid. The lattice's steps are powers of an odd number over the
 * number of samples, a power of two, so each coordinate alone is evenly spread. */
static void place_point(const accumulation *a, cs_u32 key, size_t index, float *point)
{
    const cs_part_marginal *m = a->marginal;
    const cs_u32 odd = (cs_u32)(0.382 * (double)m->samples) | 1u;
    cs_u32 step = m->samples > 1 ? (cs_u32)(0x1p32 / (double)m->samples) : 0;
    size_t cell = index / m->samples;
    const cs_u32 own = cs_key(key, (cs_u32)cell), number = (cs_u32)(index % m->samples);
    for (cs_u32 d = 0; d < (cs_u32)m->dimensions; d++, step *= odd)
        point[d] = (float)((cs_key(own, d) + number * step) >> 8) * 0x1p-24f;
    for (int d = m->rank - 1; d >= 0; d--, cell /= m->side)
        point[m->coordinate[d]] =
            (float)(((double)(cell % m->side) + a->shift[d]) / (double)m->side);
}

/* Fills the grid of one group with the means of its cells. */
static clshear_status sample_grid(accumulation *a, cs_u32 key)
{
    const size_t samples = a->marginal->samples, all = a->cells * samples;
    memset(a->grid, 0, a->cells * sizeof *a->grid);
    for (size_t first = 0; first < all; first += CHUNK) {
        const size_t count = all - first < CHUNK ? all - first : CHUNK;
        for (size_t i = 0; i < count; i++)
            place_point(a, key, first + i, a->points + (size_t)a->marginal->dimensions * i);
        const clshear_status status = a->function(a->user, a->points, count, a->values);
        if (status != CLSHEAR_OK) return status;
        for (size_t i = 0; i < count; i++)
            a->grid[(first + i) / samples] += (double)a->values[i] / (double)samples;
    }
    return CLSHEAR_OK;
}

/* Phase of coefficient number `index` due to the grid's shift, in half turns. */
static double phase_of(const accumulation *a, size_t index)
{
    const cs_part_marginal *m = a->marginal;
    const size_t half = m->side / 2 + 1;
    double turns = (double)(index % half) * a->shift[m->rank - 1];
    index /= half;
    for (int d = m->rank - 2; d >= 0; d--, index /= m->side) {
        const size_t k = index % m->side;
        turns += ((double)k - (k > m->side / 2 ? (double)m->side : 0.0)) * a->shift[d];
    }
    return 2.0 * turns / (double)m->side;
}

/* Adds the group's coefficients to the sum and subtracts their squared magnitudes from the energy,
 * which leaves the products of different groups. */
static void add_group(accumulation *a, cs_energy *energy)
{
    fftw_execute(a->plan);
    for (size_t i = 0; i < a->coefficients; i++) {
        const double angle = -CS_PI_DOUBLE * phase_of(a, i);
        const double c = cos(angle) / (double)a->cells, s = sin(angle) / (double)a->cells;
        const double re = a->transform[i][0] * c - a->transform[i][1] * s;
        const double im = a->transform[i][0] * s + a->transform[i][1] * c;
        a->sum[i][0] += re;
        a->sum[i][1] += im;
        energy->values[i] -= re * re + im * im;
    }
}

static clshear_status allocate_grids(accumulation *a, cs_energy *energy, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const cs_part_marginal *m = a->marginal;
    int sides[MOST_DIMENSIONS];
    for (int d = 0; d < MOST_DIMENSIONS; d++)
        sides[d] = (int)m->side;
    a->cells = 1;
    for (int d = 0; d < m->rank; d++)
        a->cells *= m->side;
    a->coefficients = a->cells / m->side * (m->side / 2 + 1);
    a->grid = fftw_malloc(a->cells * sizeof *a->grid);
    a->transform = fftw_malloc(a->coefficients * sizeof *a->transform);
    a->sum = calloc(a->coefficients, sizeof *a->sum);
    a->points = malloc((size_t)m->dimensions * CHUNK * sizeof *a->points);
    a->values = malloc((size_t)CHUNK * sizeof *a->values);
    energy->values = calloc(a->coefficients, sizeof *energy->values);
    CS_REQUIRE(a->grid != NULL && a->transform != NULL && a->sum != NULL && a->points != NULL &&
                   a->values != NULL && energy->values != NULL,
               CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu values of an integrand", a->cells);
    cs_fourier_start();
    a->plan = fftw_plan_dft_r2c(m->rank, sides, a->grid, a->transform, FFTW_ESTIMATE);
    CS_REQUIRE(a->plan != NULL, CLSHEAR_OUT_OF_MEMORY, "no transform of %zu values", a->cells);
done:
    return status;
}

clshear_status cs_energy_measure(const cs_part_marginal *marginal, clshear_function function,
                                 void *user, cs_energy *result, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    accumulation a = {.marginal = marginal, .function = function, .user = user};
    cs_energy energy = {.side = marginal->side, .rank = marginal->rank};
    cs_u32 key = cs_key(0x656e6572u, (cs_u32)marginal->rank);
    for (int d = 0; d < marginal->rank; d++)
        key = cs_key(key, (cs_u32)marginal->coordinate[d]);
    CS_TRY(allocate_grids(&a, &energy, error));
    for (cs_u32 group = 0; group < CS_ENERGY_GROUPS; group++) {
        const cs_u32 own = cs_key(key, group);
        for (cs_u32 d = 0; d < MOST_DIMENSIONS; d++)
            a.shift[d] = (double)cs_key(own ^ 0x73686966u, d) * 0x1p-32;
        CS_TRY(sample_grid(&a, own));
        add_group(&a, &energy);
    }
    for (size_t i = 0; i < a.coefficients; i++) {
        energy.values[i] += a.sum[i][0] * a.sum[i][0] + a.sum[i][1] * a.sum[i][1];
        energy.values[i] /= CS_ENERGY_GROUPS * (CS_ENERGY_GROUPS - 1.0);
    }
    *result = energy;
    energy.values = NULL;
done:
    if (a.plan != NULL) fftw_destroy_plan(a.plan);
    fftw_free(a.grid);
    fftw_free(a.transform);
    free(a.sum);
    free(a.points);
    free(a.values);
    free(energy.values);
    return status;
}

double cs_energy_at(const cs_energy *energy, const int *k)
{
    size_t index = 0;
    for (int d = 0; d < energy->rank - 1; d++)
        index = index * energy->side + (size_t)(k[d] < 0 ? k[d] + (int)energy->side : k[d]);
    return energy->values[index * (energy->side / 2 + 1) + (size_t)k[energy->rank - 1]];
}

void cs_energy_free(cs_energy *energy)
{
    free(energy->values);
    *energy = (cs_energy){0};
}
