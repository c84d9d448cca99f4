/* Energy of a function of four or five coordinates at frequencies of one, two or all of them. */
#ifndef CS_ANALYSIS_ENERGY_H
#define CS_ANALYSIS_ENERGY_H

#include "base/status.h"
#include "clshear/analysis.h"

/* The marginal of a function: its mean over the remaining coordinates, on a grid of side^rank
 * cells. */
typedef struct cs_part_marginal {
    int dimensions;    /* coordinates of the function: 4 or 5 */
    int rank;          /* number of coordinates that are kept: 1, 2 or all */
    int coordinate[5]; /* indices of these coordinates, from 0, rising */
    size_t side;       /* cells along each coordinate, even */
    size_t samples;    /* samples of a cell in each of CS_ENERGY_GROUPS grids, a power of two */
} cs_part_marginal;

enum {
    CS_ENERGY_GROUPS = 8
};

/* |f|^2 at whole frequencies. Only half of them are stored, because f(-k) = conj f(k). */
typedef struct cs_energy {
    double *values; /* side^(rank - 1) rows of side / 2 + 1 frequencies; the last coordinate is 0 or
                       more */
    size_t side;
    int rank;
} cs_energy;

/* Measures the energy from CS_ENERGY_GROUPS * samples * side^rank points. Initialise `energy` to
 * zero; free it with cs_energy_free. */
clshear_status cs_energy_measure(const cs_part_marginal *marginal, clshear_function function,
                                 void *user, cs_energy *energy, cs_error *error);

/* The energy at frequency `k`, which has `rank` coordinates above -side / 2 and up to side / 2. The
 * last one is 0 or more. The estimate is unbiased and may be negative. */
double cs_energy_at(const cs_energy *energy, const int *k);
void cs_energy_free(cs_energy *energy);

#endif
