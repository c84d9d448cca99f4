/* Energy of a function of four coordinates at frequencies of some of them. */
#ifndef CS_ANALYSIS_ENERGY_H
#define CS_ANALYSIS_ENERGY_H

#include "base/status.h"
#include "clshear/analysis.h"

/* What is asked of a function: its mean over all other coordinates, on a grid of side^rank cells.
 */
typedef struct cs_part_marginal {
    int rank;          /* 1, 2 or 4 */
    int coordinate[4]; /* which, rising */
    size_t side;       /* even */
    size_t samples;    /* of each cell, in each of CS_ENERGY_GROUPS grids: a power of two */
} cs_part_marginal;

enum {
    CS_ENERGY_GROUPS = 8
};

/* |f|^2 at the whole frequencies of the marginal's coordinates, from the first of which the rest
 * follow by f(-k) = conj f(k). */
typedef struct cs_energy {
    double *values; /* side^(rank - 1) * (side / 2 + 1); the last coordinate's are not negative */
    size_t side;
    int rank;
} cs_energy;

/* Calls `function` for CS_ENERGY_GROUPS * samples * side^rank points. Start from zeros; freed by
 * cs_energy_free. */
clshear_status cs_energy_measure(const cs_part_marginal *marginal, clshear_function function,
                                 void *user, cs_energy *energy, cs_error *error);

/* At frequency k, of as many coordinates as the rank; each above -side / 2 and at most side / 2,
 * the last not negative. Unbiased, and so below 0 at times. */
double cs_energy_at(const cs_energy *energy, const int *k);
void cs_energy_free(cs_energy *energy);

#endif
