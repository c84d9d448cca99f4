/* Variance of integrals over four coordinates, or five with the time, predicted from the spectra of
 * samples and integrand. Each part (axes, planes, block) covers its own range of frequencies; the
 * tail is the rest. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "analysis/energy.h"
#include "analysis/integrands.h"
#include "analysis/periodogram.h"
#include "analysis/predict.h"

enum {
    MOST_COORDINATES = 5,
    FOLD = 128,           /* frequencies of an axis per row of the lattice */
    GRID_POINTS = 1 << 19 /* least number of points per grid of a part, unless it is given */
};

/* Frequencies of some coordinates alone. */
typedef struct part {
    const char *name;
    int rank; /* number of coordinates; 0: the tail */
    int coordinate[MOST_COORDINATES];
} part;

static const part parts_at_rest[] = {{"x", 1, {0}},
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

static const part moving_parts[] = {
    {"x", 1, {0}},     {"y", 1, {1}},     {"u", 1, {2}},     {"v", 1, {3}},
    {"t", 1, {4}},     {"xy", 2, {0, 1}}, {"xu", 2, {0, 2}}, {"xv", 2, {0, 3}},
    {"yu", 2, {1, 2}}, {"yv", 2, {1, 3}}, {"uv", 2, {2, 3}}, {"xt", 2, {0, 4}},
    {"yt", 2, {1, 4}}, {"ut", 2, {2, 4}}, {"vt", 2, {3, 4}}, {"block", 5, {0, 1, 2, 3, 4}},
    {"tail", 0, {0}}};

static int reach_of(const clshear_reach *reach, int rank)
{
    if (rank == 1) return (int)reach->axis;
    if (rank == 2) return (int)reach->plane;
    return (int)reach->block;
}

/* The frequencies of a part: -reach ... reach in all coordinates, but 0 ... reach in the last,
 * because the others are mirror images. An axis is folded into rows of FOLD; a block has x and u in
 * its columns, and the others in its rows. */
static cs_lattice lattice_of(const part *p, int reach)
{
    const cs_u32 whole = 2 * (cs_u32)reach + 1, half = (cs_u32)reach + 1;
    const cs_u32 first = (cs_u32)p->coordinate[0], second = (cs_u32)p->coordinate[1];
    if (p->rank == 1)
        return (cs_lattice){
            .sets = {{.coordinate = {first}, .step = {1}, .wide = FOLD, .deep = 1},
                     {.coordinate = {first}, .step = {FOLD}, .wide = half, .deep = 1}},
            .counts = {FOLD, half / FOLD + 1}};
    if (p->rank == 2)
        return (cs_lattice){
            .sets =
                {{.coordinate = {first}, .first = {-reach}, .step = {1}, .wide = whole, .deep = 1},
                 {.coordinate = {second}, .step = {1}, .wide = half, .deep = 1}},
            .counts = {whole, half}};
    cs_lattice block = {.sets = {{{0, 2}, {-reach, -reach}, {1, 1}, whole, whole},
                                 {{1, 3}, {-reach, 0}, {1, 1}, whole, half}},
                        .counts = {whole * whole, whole * half}};
    if (p->rank == 5) {
        block.sets[1] = (cs_frequencies){{1, 3, 4}, {-reach, -reach, 0}, {1, 1, 1}, whole, whole};
        block.counts[1] *= whole;
    }
    return block;
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
        if (rank == 4) return;
        k[4] = k[3] / (int)whole;
        k[3] = k[3] % (int)whole - reach;
    }
}

/* Weight of a frequency in its part. It is 0 unless an axis has one nonzero coordinate, a plane
 * two, a block three or more. It is 2 if the lattice leaves out the mirror image. */
static int weight_of(int rank, int reach, const int *k)
{
    int used = 0;
    for (int d = 0; d < rank; d++)
        used += k[d] != 0;
    if (k[rank - 1] > reach || used < (rank > 2 ? 3 : rank)) return 0;
    return k[rank - 1] == 0 ? 1 : 2;
}

/* Adds what a part has to number `index` of a prediction. */
static void add_up(int rank, int reach, const cs_lattice *lattice, const float *power,
                   const cs_energy *energy, double count, size_t index, clshear_prediction *p)
{
    for (size_t row = 0; row < lattice->counts[1]; row++)
        for (size_t column = 0; column < lattice->counts[0]; column++) {
            int k[MOST_COORDINATES] = {0};
            frequency_of(rank, reach, column, row, k);
            const int weight = weight_of(rank, reach, k);
            if (weight == 0) continue;
            const double part_energy = weight * cs_energy_at(energy, k);
            p->energies[index] += part_energy;
            p->variances[index] +=
                part_energy * (double)power[row * lattice->counts[0] + column] / count;
        }
}

static size_t points_of(const clshear_reach *reach)
{
    return reach->points > 0 ? reach->points : GRID_POINTS;
}

static cs_part_marginal marginal_of(const part *p, int dimensions, int reach, size_t least)
{
    cs_part_marginal m = {
        .dimensions = dimensions, .rank = p->rank, .side = 2 * (size_t)reach + 2, .samples = 1};
    memcpy(m.coordinate, p->coordinate, sizeof m.coordinate);
    size_t cells = 1;
    for (int d = 0; d < m.rank; d++)
        cells *= m.side;
    while (cells * m.samples < least)
        m.samples *= 2;
    return m;
}

/* What a prediction is made from. */
typedef struct question {
    clshear_context *context;
    const clshear_points *samples;
    clshear_function function;
    void *user;
    const clshear_reach *reach;
    int dimensions; /* of the function: 4 or 5 */
} question;

/* Adds part number `index` to a prediction. */
static clshear_status predict_part(const question *q, const part *part, size_t index,
                                   clshear_prediction *p)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = cs_thread_error();
    const int reach = reach_of(q->reach, part->rank);
    const cs_lattice lattice = lattice_of(part, reach);
    const cs_part_marginal marginal = marginal_of(part, q->dimensions, reach, points_of(q->reach));
    cs_energy energy = {0};
    float *power = malloc((size_t)lattice.counts[0] * lattice.counts[1] * sizeof *power);
    CS_REQUIRE(power != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for a spectrum");
    CS_TRY(cs_energy_measure(&marginal, q->function, q->user, &energy, error));
    CS_TRY(cs_periodogram(q->context->device, q->samples, &lattice, power, error));
    add_up(part->rank, reach, &lattice, power, &energy, (double)q->samples->count, index, p);
done:
    cs_energy_free(&energy);
    free(power);
    return status;
}

/* Measures the variance of the function with 32 sets of `count` well-spread samples, because the
 * tail is a small difference from it. */
static clshear_status measure_energy(const question *q, size_t count, double *energy,
                                     cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const size_t sets = 32, stride = (size_t)q->dimensions;
    double mean = 0.0, mean_square = 0.0;
    clshear_points points = {0};
    float *values = malloc(count * sizeof *values);
    CS_REQUIRE(values != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    status = cs_points_draw("sz", count, sets, 0, 0, q->dimensions == 5, &points);
    if (status == CLSHEAR_OK)
        status = cs_points_select(&points, q->dimensions == 5 ? "xyuvt" : "xyuv");
    CS_REQUIRE(status == CLSHEAR_OK, status, "%s", cs_thread_error()->message);
    for (size_t set = 0; set < sets; set++) {
        CS_TRY(q->function(q->user, points.values + set * count * stride, count, values));
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

static clshear_status check_reach(const question *q, cs_error *error)
{
    const clshear_reach *reach = q->reach;
    const uint32_t most = q->dimensions == 5 ? 5 : 15;
    if (reach->axis >= 1 && reach->axis <= 65536 && reach->plane >= 1 && reach->plane <= 2047 &&
        reach->block >= 1 && reach->block <= most && reach->points <= 1u << 24)
        return CLSHEAR_OK;
    return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                   "frequencies up to %u, %u and %u: must be 1 to 65536, 2047 and %u", reach->axis,
                   reach->plane, reach->block, most);
}

clshear_status cs_predict_variance_4d(clshear_context *context, const clshear_points *samples,
                                      clshear_function function, void *user,
                                      const clshear_reach *reach, clshear_prediction *prediction)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = cs_thread_error();
    const question q = {.context = context,
                        .samples = samples,
                        .function = function,
                        .user = user,
                        .reach = reach,
                        .dimensions = (int)cs_points_arguments(samples)};
    const part *parts = q.dimensions == 5 ? moving_parts : parts_at_rest;
    const size_t tail =
        (q.dimensions == 5 ? sizeof moving_parts : sizeof parts_at_rest) / sizeof *parts - 1;
    clshear_prediction p = {.parts = tail + 1};
    double seen = 0.0;
    CS_REQUIRE(q.dimensions > 0, CLSHEAR_BAD_ARGUMENT, "samples of %s: must begin with x, y, u, v",
               samples->names);
    CS_TRY(check_reach(&q, error));
    CS_TRY(measure_energy(&q, (points_of(reach) + 7) / 8, &p.energy, error));
    for (size_t i = 0; i < tail; i++) {
        CS_TRY(predict_part(&q, &parts[i], i, &p));
        seen += p.energies[i];
        p.variance += p.variances[i];
    }
    p.energies[tail] = fmax(p.energy - seen, 0.0);
    p.variances[tail] = p.energies[tail] / (double)samples->count;
    p.variance += p.variances[tail];
    for (size_t level = 0; level < CS_CONE_LEVELS; level++)
        p.by_cones[level] = NAN;
    for (size_t i = 0; i < p.parts; i++)
        p.names[i] = parts[i].name;
    *prediction = p;
done:
    return status;
}
