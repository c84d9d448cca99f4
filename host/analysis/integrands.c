/* Functions on the unit square with known spectra, and means of functions over point sets. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "analysis/integrands.h"
#include "base/parallel.h"
#include "base/pi.h"
#include "base/status.h"
#include "clshear/device/hash.h"

/* A row of CLSHEAR_INTEGRAND_LIST. Its index is the integrand's number. */
static const struct {
    const char *name;
    double extent;
} known[] = {
#define CS_INTEGRAND(identifier, number, name, extent, meaning) {name, extent},
    CLSHEAR_INTEGRAND_LIST(CS_INTEGRAND)
#undef CS_INTEGRAND
};
enum {
    KNOWN = sizeof known / sizeof *known
};

clshear_status cs_integrand_find(const char *name, clshear_integrand *integrand)
{
    for (int i = 0; i < KNOWN; i++)
        if (strcmp(name, known[i].name) == 0) {
            *integrand = (clshear_integrand){.struct_size = sizeof *integrand,
                                             .kind = (clshear_integrand_kind)i,
                                             .extent = known[i].extent};
            return CLSHEAR_OK;
        }
    return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT,
                   "no integrand %s: there are step, box, disk, gaussian, tent and plane-wave",
                   name);
}

double cs_integrand_at(const clshear_integrand *integrand, double x, double y)
{
    const double angle = integrand->angle_deg * CS_PI_DOUBLE / 180.0, size = integrand->extent;
    const double along = (x - 0.5) * cos(angle) + (y - 0.5) * sin(angle);
    const double across = (y - 0.5) * cos(angle) - (x - 0.5) * sin(angle);
    switch (integrand->kind) {
    case CLSHEAR_INTEGRAND_STEP:
        return along < size ? 1.0 : 0.0;
    case CLSHEAR_INTEGRAND_BOX:
        return fabs(along) < 0.5 * size && fabs(across) < 0.5 * size ? 1.0 : 0.0;
    case CLSHEAR_INTEGRAND_DISK:
        return along * along + across * across < 0.25 * size * size ? 1.0 : 0.0;
    case CLSHEAR_INTEGRAND_GAUSSIAN:
        return exp(-(8.0 * along * along + 72.0 * across * across) / (size * size));
    case CLSHEAR_INTEGRAND_TENT:
        return fmax(1.0 - 2.0 * fabs(along) / size, 0.0);
    default:
        return 0.5 + 0.5 * cos(2.0 * CS_PI_DOUBLE * along / size);
    }
}

enum {
    PARTS = 4 /* values along the side of a cell */
};

typedef struct tabulation {
    const clshear_integrand *integrand;
    size_t side;
    float *cells;
    double *squares; /* sum of squared values, one entry per row */
} tabulation;

static void tabulate_rows(void *user, size_t begin, size_t end)
{
    const tabulation *job = user;
    const double step = 1.0 / (PARTS * (double)job->side);
    for (size_t row = begin; row < end; row++)
        for (size_t column = 0; column < job->side; column++) {
            double sum = 0.0;
            for (size_t part = 0; part < PARTS * PARTS; part++) {
                const double x = step * ((double)(column * PARTS + part % PARTS) + 0.5);
                const size_t down = part / PARTS;
                const double y = step * ((double)(row * PARTS + down) + 0.5);
                const double value = cs_integrand_at(job->integrand, x, y);
                sum += value;
                job->squares[row] += value * value;
            }
            job->cells[row * job->side + column] = (float)(sum / (PARTS * PARTS));
        }
}

clshear_status cs_integrand_tabulate(const clshear_integrand *integrand, size_t side, float *cells,
                                     double *mean_square)
{
    tabulation job = {integrand, side, cells, calloc(side, sizeof *job.squares)};
    if (job.squares == NULL)
        return cs_fail(cs_thread_error(), CLSHEAR_OUT_OF_MEMORY, "out of memory");
    cs_parallel(0, side, tabulate_rows, &job);
    *mean_square = 0.0;
    for (size_t row = 0; row < side; row++)
        *mean_square += job.squares[row] / ((double)(side * side) * PARTS * PARTS);
    free(job.squares);
    return CLSHEAR_OK;
}

typedef struct integration {
    const clshear_points *points;
    const clshear_integrand *integrand;
    int homogenise;
    uint32_t seed;
    double *means;
} integration;

static void integrate_sets(void *user, size_t begin, size_t end)
{
    const integration *job = user;
    const clshear_points *points = job->points;
    for (size_t set = begin; set < end; set++) {
        const cs_u32 key = cs_key(job->seed ^ 0x746f7275u, (cs_u32)set);
        const double scale = job->homogenise ? 0x1p-32 : 0.0;
        const double shift[2] = {scale * cs_key(key, 0), scale * cs_key(key, 1)};
        double sum = 0.0;
        for (size_t i = 0; i < points->count; i++) {
            const float *point = points->values + (set * points->count + i) * points->dimensions;
            const double x = (double)point[0] + shift[0], y = (double)point[1] + shift[1];
            sum += cs_integrand_at(job->integrand, x - floor(x), y - floor(y));
        }
        job->means[set] = sum / (double)points->count;
    }
}

void cs_points_integrate(const clshear_points *points, const clshear_integrand *integrand,
                         int homogenise, uint32_t seed, double *means)
{
    integration job = {points, integrand, homogenise, seed, means};
    if (points->dimensions < 2) {
        for (size_t set = 0; set < points->sets; set++)
            means[set] = NAN;
        return;
    }
    cs_parallel(0, points->sets, integrate_sets, &job);
}

/* The first `dimensions` coordinates of point number `index` over all sets, with its set's random
 * shift. */
static void shifted(const clshear_points *points, size_t index, size_t dimensions, int homogenise,
                    uint32_t seed, float *place)
{
    const cs_u32 key = cs_key(seed ^ 0x746f7275u, (cs_u32)(index / points->count));
    for (cs_u32 d = 0; d < dimensions; d++) {
        const double shift = homogenise ? 0x1p-32 * cs_key(key, d) : 0.0;
        const double x = (double)points->values[index * points->dimensions + d] + shift;
        place[d] = fminf((float)(x - floor(x)), 0.99999994f);
    }
}

size_t cs_points_arguments(const clshear_points *points)
{
    if (strncmp(points->names, "xyuv", 4) != 0) return 0;
    return points->names[4] == 't' ? 5 : 4;
}

clshear_status cs_points_integrate_4d(const clshear_points *points, clshear_function function,
                                      void *user, int homogenise, uint32_t seed, double *means)
{
    enum {
        CHUNK = 1 << 16
    };
    clshear_status status = CLSHEAR_OK;
    cs_error *error = cs_thread_error();
    const size_t all = points->sets * points->count;
    const size_t dimensions = cs_points_arguments(points);
    float *places = malloc((dimensions + 1) * CHUNK * sizeof *places);
    float *values = places + dimensions * CHUNK;
    CS_REQUIRE(places != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    CS_REQUIRE(dimensions > 0, CLSHEAR_BAD_ARGUMENT, "points of %s: must begin with x, y, u, v",
               points->names);
    for (size_t set = 0; set < points->sets; set++)
        means[set] = 0.0;
    for (size_t first = 0; first < all; first += CHUNK) {
        const size_t count = all - first < CHUNK ? all - first : CHUNK;
        for (size_t i = 0; i < count; i++)
            shifted(points, first + i, dimensions, homogenise, seed, places + dimensions * i);
        CS_TRY(function(user, places, count, values));
        for (size_t i = 0; i < count; i++)
            means[(first + i) / points->count] += (double)values[i] / (double)points->count;
    }
done:
    free(places);
    return status;
}
