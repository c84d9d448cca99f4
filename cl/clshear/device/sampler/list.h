/* The table of samplers: command line, library, kernels and tests are all made from it.
 *
 * X(identifier, name, draw, counts, rows, progressive, about)
 * draw: cs_draw_<draw> makes tuples, in this folder. counts, rows: which numbers of samples there
 * are and what the host prepares, host/pattern/. progressive: its first n samples do not depend on
 * how many follow. */
#ifndef CLSHEAR_DEVICE_SAMPLER_LIST_H
#define CLSHEAR_DEVICE_SAMPLER_LIST_H

#define CS_SAMPLER_LIST(X)                                                                       \
    X(RANDOM, "random", random, any, none, 1, "independent points")                              \
    X(JITTERED, "jittered", jittered, grid, none, 0, "2D strata, pairs paired at random")        \
    X(JITTERED4D, "jittered4d", jittered4d, hypergrid, none, 0, "4D strata")                     \
    X(NROOKS, "nrooks", nrooks, any, none, 0, "1D strata: Latin hypercube")                      \
    X(MJ, "mj", multijitter, any, none, 0, "multi-jittered pairs (Chiu et al. 1994)")            \
    X(CMJ, "cmj", multijitter, any, none, 0, "correlated multi-jittered pairs (Kensler 2013)")   \
    X(OA, "oa", multijitter, square, oa, 0, "orthogonal array, strength 2 (Jarosz et al. 2019)") \
    X(OA3, "oa3", strong_array, cube, oa3, 0, "orthogonal array, strength 3")                    \
    X(HALTON, "halton", halton, any, halton, 1, "bases 2, 3, 5, 7, permuted digits")             \
    X(SOBOL, "sobol", net, any, sobol, 1, "4D, nested uniform scrambling (Burley 2020)")         \
    X(SOBOL_PAIRS, "sobol-pairs", net_pairs, any, index, 1, "(0,2)-sequences, shuffled pairs")   \
    X(SZ, "sz", net, any, sz, 1, "(0,4)-sequence of (0,2)-pairs (after Ahmed et al. 2025)")      \
    X(RANK1, "rank1", lattice, any, rank1, 0, "Korobov lattice, shifted at random")              \
    X(POISSON, "poisson", point_set, modest, poisson, 0, "Poisson disk pairs, paired at random") \
    X(CCVT, "ccvt", point_set, few, ccvt, 0, "equal-capacity Voronoi pairs, paired at random")

#define CS_SAMPLER_IDENTIFIER(identifier, name, draw, counts, rows, progressive, about) \
    CS_SAMPLER_##identifier,

enum {
    CS_SAMPLER_LIST(CS_SAMPLER_IDENTIFIER) CS_SAMPLER_COUNT
};

#endif
