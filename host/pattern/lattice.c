/* Sample table of the rank-1 lattice. */
#include <math.h>

#include "pattern/table_makers.h"

int cs_table_none(cs_table *table)
{
    (void)table;
    return 1;
}

void cs_table_cut_evenly(cs_table *table)
{
    const cs_u32 boxes = table->pattern->grid.count / CS_GROUP;
    table->boxes[0] = (cs_u32)lround(sqrt((double)boxes));
    if (table->boxes[0] == 0) table->boxes[0] = 1;
    table->boxes[1] = boxes / table->boxes[0] > 0 ? boxes / table->boxes[0] : 1;
}

/* value / count in units of 2^-32. */
static cs_u32 fraction(uint64_t value, cs_u32 count)
{
    return (cs_u32)((value << 32) / count);
}

static cs_u32 common_divisor(cs_u32 a, cs_u32 b)
{
    while (b != 0) {
        const cs_u32 rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* Squared worst-case error, up to a constant, over functions with Fourier coefficients below |h|^-2
 * in each coordinate: P_2 of Sloan & Joe 1994, section 4.2. Stops early above `until`. */
static double figure_of_merit(cs_u32 count, cs_u32 multiplier, double until)
{
    const double two_pi_squared = 19.739208802178716, scale = 1.0 / count;
    double sum = 0.0;
    for (cs_u32 i = 0; i < count && sum - count < until * count; i++) {
        double term = 1.0;
        uint64_t at = i;
        for (int d = 0; d < CS_MAIN_DIMENSIONS; d++) {
            const double x = (double)at * scale;
            term *= 1.0 + two_pi_squared * (x * x - x + 1.0 / 6.0);
            at = at * multiplier % count;
        }
        sum += term;
    }
    return sum * scale - 1.0;
}

/* The best multiplier a of the lattice (1, a, a^2, a^3) / N among candidates spread over [1, N) and
 * coprime to N. */
static cs_u32 korobov_multiplier(cs_u32 count)
{
    const cs_u32 effort = 1u << 22;
    cs_u32 candidates = effort / count > 8 ? effort / count : 8;
    if (count < 512) candidates = count;
    cs_u32 best = 1;
    double least = INFINITY;
    for (cs_u32 i = 1; i <= candidates; i++) {
        cs_u32 a = candidates == count
                       ? i
                       : (cs_u32)(((uint64_t)i * 0x9e3779b9u & 0xffffffffu) * count >> 32);
        while (common_divisor(a, count) != 1) /* ends at the latest at a multiple of N plus 1 */
            a++;
        const double merit = figure_of_merit(count, a, least);
        if (merit >= least) continue;
        least = merit;
        best = a;
    }
    return best;
}

int cs_table_rank1(cs_table *table)
{
    const cs_u32 count = table->pattern->grid.count;
    const cs_u32 multiplier = korobov_multiplier(count);
    for (cs_u32 row = 0; row < count; row++) {
        uint64_t at = row;
        for (int d = 0; d < CS_MAIN_DIMENSIONS; d++) {
            table->word[d][row] = fraction(at, count);
            at = at * multiplier % count;
        }
        table->place[0][row] = table->word[0][row];
        table->place[1][row] = table->word[1][row];
    }
    table->words = CS_MAIN_DIMENSIONS;
    cs_table_cut_evenly(table);
    return 1;
}
