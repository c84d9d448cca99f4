/* Variance of integrals over four coordinates, predicted from the spectra of samples and integrand.
 * Each part (axes, planes, block) covers its own range of frequencies; the tail is the rest. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "analysis/energy.h"
#include "analysis/periodogram.h"
#include "analysis/predict.h"

enum {
    AXES = 4,
    PLANES = 6,
    BLOCK = AXES + PLANES,
    TAIL = BLOCK + 1,
    FOLD = 128,           /* frequencies of an axis per row of the lattice */
    GRID_POINTS = 1 << 19 /* least number of points per grid of a part, unless it is given */
};

static const struct {
    const char *name;
    int rank;
    int coordinate[4];
} parts[CS_MOST_PARTS] = {{"x", 1, {0}},
                          {"y", 1, {1}},
                          {"u", 1, {2}},
                          {"v", 1, {3}},
                          {"xy", 2, {0, 1}},
                          {"xu", 2, {0, 2}},
                          {"xv", 2, {0, 3}},
                          {"yu", 2, {1, 2}},
                          {"yv", 2, {1, 3}},
                          {"uv", 2, {2, 3}},
                          {"block", 4, {0, 1, 2, 3}},
                          {"tail", 0, {0}}};

static int reach_of(const clshear_reach *reach, int rank)
{
    if (rank == 1) return (int)reach->axis;
    if (rank == 2) return (int)reach->plane;
    return (int)reach->block;
}

/* The frequencies of a part: -reach ... reach in all coordinates, but 0 ... reach in the last,
 * because the others are mirror images. An axis is folded into rows of FOLD. */
static cs_lattice lattice_of(int part, int reach)
{
    const cs_u32 whole = 2 * (cs_u32)reach + 1, half = (cs_u32)reach + 1, last = (cs_u32)reach + 1;
    const int *c = parts[part].coordinate;
    const cs_u32 d[4] = {(cs_u32)c[0], (cs_u32)c[1], (cs_u32)c[2], (cs_u32)c[3]};
    if (parts[part].rank == 1)
        return (cs_lattice){
            .sets = {{{d[0], d[0]}, {0, 0}, {1, 0}, FOLD}, {{d[0], d[0]}, {0, 0}, {FOLD, 0}, last}},
            .counts = {FOLD, last / FOLD + 1}};
    if (parts[part].rank == 2)
        return (cs_lattice){.sets = {{{d[0], d[0]}, {-reach, 0}, {1, 0}, whole},
                                     {{d[1], d[1]}, {0, 0}, {1, 0}, half}},
                            .counts = {whole, half}};
    return (cs_lattice){.sets = {{{d[0], d[2]}, {-reach, -reach}, {1, 1}, whole},
                                 {{d[1], d[3]}, {-reach, 0}, {1, 1}, whole}},
                        .counts = {whole * whole, whole * half}};
}

/* The frequency of a cell of lattice_of. */
static void frequency_of(int rank, int reach, size_t column, size_t row, int *k)
{
    const size_t whole = 2 * (size_t)reach + 1;
    if (rank == 1) {
        k[0] = (int)(column + FOLD * row);
    } else if (rank == 2) {
        k[0] = (int)column - reach;
        k[1] = (int)row;
    } else {
        k[0] = (int)(column % whole) - reach;
        k[2] = (int)(column / whole) - reach;
        k[1] = (int)(row % whole) - reach;
        k[3] = (int)(row / whole);
    }
}

/* Weight of a frequency in its part. It is 0 unless an axis has one nonzero coordinate, a plane
 * two, a block three or four. It is 2 if the lattice leaves out the mirror image. */
static int weight_of(int rank, int reach, const int *k)
{
    int used = 0;
    for (int d = 0; d < rank; d++)
        used += k[d] != 0;
    if (k[rank - 1] > reach || used < (rank == 4 ? 3 : rank)) return 0;
    return k[rank - 1] == 0 ? 1 : 2;
}

static void add_up(int part, int reach, const cs_lattice *lattice, const float *power,
                   const cs_energy *energy, double count, clshear_prediction *p)
{
    const int rank = parts[part].rank;
    for (size_t row = 0; row < lattice->counts[1]; row++)
        for (size_t column = 0; column < lattice->counts[0]; column++) {
            int k[4] = {0};
            frequency_of(rank, reach, column, row, k);
            const int weight = weight_of(rank, reach, k);
            if (weight == 0) continue;
            const double part_energy = weight * cs_energy_at(energy, k);
            p->energies[part] += part_energy;
            p->variances[part] +=
                part_energy * (double)power[row * lattice->counts[0] + column] / count;
        }
}

static size_t points_of(const clshear_reach *reach)
{
    return reach->points > 0 ? reach->points : GRID_POINTS;
}

static cs_part_marginal marginal_of(int part, int reach, size_t least)
{
    cs_part_marginal m = {.rank = parts[part].rank, .side = 2 * (size_t)reach + 2, .samples = 1};
    memcpy(m.coordinate, parts[part].coordinate, sizeof m.coordinate);
    size_t cells = 1;
    for (int d = 0; d < m.rank; d++)
        cells *= m.side;
    while (cells * m.samples < least)
        m.samples *= 2;
    return m;
}

static clshear_status predict_part(clshear_context *context, const clshear_points *samples,
                                   clshear_function function, void *user, int part,
                                   const clshear_reach *given, clshear_prediction *p)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = cs_thread_error();
    const int reach = reach_of(given, parts[part].rank);
    const cs_lattice lattice = lattice_of(part, reach);
    const cs_part_marginal marginal = marginal_of(part, reach, points_of(given));
    cs_energy energy = {0};
    float *power = malloc((size_t)lattice.counts[0] * lattice.counts[1] * sizeof *power);
    CS_REQUIRE(power != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for a spectrum");
    CS_TRY(cs_energy_measure(&marginal, function, user, &energy, error));
    CS_TRY(cs_periodogram(context->device, samples, &lattice, power, error));
    add_up(part, reach, &lattice, power, &energy, (double)samples->count, p);
done:
    cs_energy_free(&energy);
    free(power);
    return status;
}

/* Measures the variance of the function with 32 sets of `count` well-spread samples, because the
 * tail is a small difference from it. */
static clshear_status measure_energy(clshear_function function, void *user, size_t count,
                                     double *energy, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const size_t sets = 32;
    double mean = 0.0, mean_square = 0.0;
    clshear_points points = {0};
    float *values = malloc(count * sizeof *values);
    CS_REQUIRE(values != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    status = cs_points_draw("sz", count, sets, 0, 0, &points);
    if (status == CLSHEAR_OK) status = cs_points_select(&points, "xyuv");
    CS_REQUIRE(status == CLSHEAR_OK, status, "%s", cs_thread_error()->message);
    for (size_t set = 0; set < sets; set++) {
        CS_TRY(function(user, points.values + set * count * 4, count, values));
        for (size_t i = 0; i < count; i++) {
            const double value = (double)values[i];
            mean += value / (double)(count * sets);
            mean_square += value * value / (double)(count * sets);
        }
    }
    *energy = fmax(mean_square - mean * mean, 0.0);
done:
    cs_points_free(&points);
    free(values);
    return status;
}

clshear_status cs_predict_variance_4d(clshear_context *context, const clshear_points *samples,
                                      clshear_function function, void *user,
                                      const clshear_reach *reach, clshear_prediction *prediction)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = cs_thread_error();
    clshear_prediction p = {.parts = CS_MOST_PARTS};
    double seen = 0.0;
    CS_REQUIRE(samples->dimensions >= 4 && strncmp(samples->names, "xyuv", 4) == 0,
               CLSHEAR_BAD_ARGUMENT, "samples of %s: must begin with x, y, u, v", samples->names);
    CS_REQUIRE(
        reach->axis >= 1 && reach->axis <= 65536 && reach->plane >= 1 && reach->plane <= 2047 &&
            reach->block >= 1 && reach->block <= 15 && reach->points <= 1u << 24,
        CLSHEAR_BAD_ARGUMENT, "frequencies up to %u, %u and %u: must be 1 to 65536, 2047 and 15",
        reach->axis, reach->plane, reach->block);
    CS_TRY(measure_energy(function, user, (points_of(reach) + 7) / 8, &p.energy, error));
    for (int part = 0; part < TAIL; part++) {
        CS_TRY(predict_part(context, samples, function, user, part, reach, &p));
        seen += p.energies[part];
        p.variance += p.variances[part];
    }
    p.energies[TAIL] = fmax(p.energy - seen, 0.0);
    p.variances[TAIL] = p.energies[TAIL] / (double)samples->count;
    p.variance += p.variances[TAIL];
    for (size_t level = 0; level < CS_CONE_LEVELS; level++)
        p.by_cones[level] = NAN;
    for (size_t part = 0; part < p.parts; part++)
        p.names[part] = parts[part].name;
    *prediction = p;
done:
    return status;
}
