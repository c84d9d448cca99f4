/* Tables of the orthogonal arrays, and the finite fields they are made of. */
#include <stdlib.h>
#include <string.h>

#include "pattern/rows.h"

enum {
    MOST_LEVELS = 1024, /* its square is CS_MAX_PATTERN */
    MOST_DIGITS = 10
};

/* The field of q = prime^degree elements. Element numbers are polynomials, digits base `prime`. */
typedef struct field {
    u32 q;
    u32 prime;
    u32 degree;
    u32 power[MOST_LEVELS]; /* of a generator: 0 ... q - 2 */
    u32 logarithm[MOST_LEVELS];
} field;

static int factor(u32 q, u32 *prime, u32 *degree)
{
    *prime = 2;
    while (*prime * *prime <= q && q % *prime != 0)
        ++*prime;
    if (q % *prime != 0) *prime = q;
    for (*degree = 0; q % *prime == 0; q /= *prime)
        ++*degree;
    return q == 1;
}

int cs_is_prime_power(u32 q)
{
    u32 prime, degree;
    return q >= 2 && factor(q, &prime, &degree);
}

static u32 add(const field *f, u32 a, u32 b)
{
    u32 sum = 0, place = 1;
    for (; a != 0 || b != 0; a /= f->prime, b /= f->prime, place *= f->prime)
        sum += (a + b) % f->prime * place;
    return sum;
}

static u32 multiply(const field *f, u32 a, u32 b)
{
    if (a == 0 || b == 0) return 0;
    return f->power[(f->logarithm[a] + f->logarithm[b]) % (f->q - 1)];
}

/* a times x, modulo x^degree - `rest`. */
static u32 times_x(const field *f, u32 a, u32 rest)
{
    const u32 top = f->q / f->prime;
    const u32 carry = a / top;
    u32 product = a % top * f->prime;
    for (u32 i = 0; i < carry; i++)
        product = add(f, product, rest);
    return product;
}

/* Looks for a polynomial modulo which the powers of x are all elements but 0. */
static field field_of(u32 q)
{
    field f = {.q = q};
    factor(q, &f.prime, &f.degree);
    for (u32 rest = 1; rest < q; rest++) {
        u32 element = 1, order = 0;
        do {
            f.power[order] = element;
            f.logarithm[element] = order++;
            element = times_x(&f, element, rest);
        } while (element > 1 && order < q - 1);
        if (order == q - 1 && element == 1) break;
    }
    return f;
}

/* Levels of the second pair for every cell of the first, which are numbered in blocks. */
int cs_rows_oa(cs_table *table)
{
    const cs_grid *grid = &table->pattern->grid;
    field *f = malloc(sizeof *f);
    if (f == NULL) return 0;
    *f = field_of(grid->columns);
    const u32 factor_of_last = f->power[1 % (f->q - 1)];
    for (u32 row = 0; row < grid->count; row++) {
        const cs_cell cell = cs_cell_in_block_order(grid, row);
        const u32 third = add(f, cell.column, cell.row);
        const u32 fourth = add(f, cell.column, multiply(f, factor_of_last, cell.row));
        table->word[0][row] = third << 16 | fourth;
    }
    table->words = 1;
    free(f);
    return 1;
}

/* Bush's array: run (a, b, c) has the levels of a + b x + c x^2 at x = 0, infinity, 1 and a
 * generator. Any two of a, b and c number the runs of a level: a word is level << 16 | number. */
int cs_rows_oa3(cs_table *table)
{
    const u32 q = table->pattern->grid.columns;
    const cs_grid cells = cs_grid_on(q * q, q);
    field *f = malloc(sizeof *f);
    if (f == NULL) return 0;
    *f = field_of(q);
    const u32 x = f->power[1 % (q - 1)], square = multiply(f, x, x);
    for (u32 row = 0; row < q * q * q; row++) {
        const cs_cell cell = cs_cell_in_block_order(&cells, row / q);
        const u32 a = cell.column, b = row % q, c = cell.row;
        const u32 third = add(f, a, add(f, b, c));
        const u32 fourth = add(f, a, add(f, multiply(f, x, b), multiply(f, square, c)));
        table->word[0][row] = a << 16 | (b * q + c);
        table->word[1][row] = c << 16 | (a * q + b);
        table->word[2][row] = third << 16 | (b * q + c);
        table->word[3][row] = fourth << 16 | (b * q + c);
    }
    table->words = 4;
    free(f);
    return 1;
}
