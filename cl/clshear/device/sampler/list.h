/* clang-format off */
/* The table of samplers. The kernels' switch, the host's tables, the names on the command line and
 * the tests are all made from it.
 *
 * X(identifier, name, draw, light, extra, shape, table, progressive, about)
 *
 * identifier   CS_SAMPLER_<identifier> is the sampler's number.
 * name         Users call the sampler by it.
 * draw         cs_draw_<draw>, in this folder, makes the film and lens coordinates.
 * light        cs_extra_<light>, in this folder, makes the light's pair of a tuple.
 * extra        cs_extra_<extra>, in this folder, makes the coordinates of any other slot, and all
 *              that paths draw beyond the tuple.
 * shape        Rule for the numbers of samples that exist and for the grid under them (host/pattern).
 * table        Rule for the sample table (host/pattern); `none` if the sampler reads no table.
 * progressive  1 if the first n samples do not depend on how many follow, else 0.
 * about        One line for users.
 *
 * A sampler's place in the list is its number. Nets stand apart, for programs that draw no others
 * (CS_NETS_ONLY, sampler.h). */
#ifndef CLSHEAR_DEVICE_SAMPLER_LIST_H
#define CLSHEAR_DEVICE_SAMPLER_LIST_H

#define CS_SAMPLER_LIST_BEFORE(X) \
    X(RANDOM, "random", random, random, random, any, none, 1, "independent points") \
    X(JITTERED, "jittered", jittered, jittered, jittered, grid, none, 0, "2D strata, pairs paired at random") \
    X(JITTERED4D, "jittered4d", jittered4d, jittered, jittered, hypergrid, none, 0, "4D strata") \
    X(NROOKS, "nrooks", nrooks, nrooks, nrooks, any, none, 0, "1D strata: Latin hypercube") \
    X(MJ, "mj", multijittered, multijittered, multijittered, any, none, 0, "multi-jittered pairs (Chiu et al. 1994)") \
    X(CMJ, "cmj", correlated, correlated, correlated, any, none, 0, "correlated multi-jittered pairs (Kensler 2013)") \
    X(OA, "oa", array, multijittered, multijittered, square, oa, 0, "orthogonal array, strength 2 (Jarosz et al. 2019)") \
    X(OA3, "oa3", strong_array, strong_array, strong_array, cube, oa3, 0, "orthogonal array, strength 3") \
    X(HALTON, "halton", halton, net_pair, net_pair, digits, halton, 1, "bases 2, 3, 5, 7, permuted digits")

#define CS_SAMPLER_LIST_NETS(X) \
    X(SOBOL, "sobol", net, net_words, net_pair, any, sobol, 1, "6D, nested uniform scrambling (Burley 2020)") \
    X(SOBOL_PAIRS, "sobol-pairs", net_pairs, net_pair, net_pair, any, index, 1, "(0,2)-sequences, shuffled pairs") \
    X(SZ, "sz", net, net_pair, net_pair, any, sz, 1, "(0,4)-sequence of (0,2)-pairs (Ahmed 2025)")

#define CS_SAMPLER_LIST_BEHIND(X) \
    X(RANK1, "rank1", lattice, partner, partner, any, rank1, 0, "Korobov lattice, shifted at random") \
    X(POISSON, "poisson", point_set, point_set, point_set, modest, poisson, 0, "Poisson disk pairs, paired at random") \
    X(CCVT, "ccvt", point_set, point_set, point_set, few, ccvt, 0, "equal-capacity Voronoi pairs, paired at random")

#define CS_SAMPLER_LIST(X) \
    CS_SAMPLER_LIST_BEFORE(X) CS_SAMPLER_LIST_NETS(X) CS_SAMPLER_LIST_BEHIND(X)
/* clang-format on */

#define CS_SAMPLER_IDENTIFIER(identifier, name, draw, light, extra, shape, table, progressive, \
                              about)                                                           \
    CS_SAMPLER_##identifier,

enum {
    CS_SAMPLER_LIST(CS_SAMPLER_IDENTIFIER) CS_SAMPLER_COUNT
};

#endif
