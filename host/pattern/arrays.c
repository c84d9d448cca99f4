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

/* Levels i + j and i + x j of run i q + j, where x generates the field. */
int cs_rows_oa(cs_table *table)
{
    const u32 q = table->pattern->grid.columns;
    field *f = malloc(sizeof *f);
    if (f == NULL || q < 3) { /* there is no smaller array */
        free(f);
        return 0;
    }
    *f = field_of(q);
    const u32 x = f->power[1];
    for (u32 run = 0; run < q * q; run++) {
        const u32 i = run / q, j = run % q;
        table->word[0][run] = add(f, i, j) << 16 | add(f, i, multiply(f, x, j));
    }
    table->words = 1;
    free(f);
    return 1;
}

/* Bush's array: run (a q + c) q + b has the values of a + b x + c x^2 at x = 0, infinity, 1 and a
 * generator; the first two are a and c themselves. */
int cs_rows_oa3(cs_table *table)
{
    const u32 q = table->pattern->grid.columns;
    field *f = malloc(sizeof *f);
    if (f == NULL || q < 3) { /* there is no smaller array */
        free(f);
        return 0;
    }
    *f = field_of(q);
    const u32 x = f->power[1], square = multiply(f, x, x);
    for (u32 run = 0; run < q * q * q; run++) {
        const u32 a = run / (q * q), c = run / q % q, b = run % q;
        const u32 third = add(f, a, add(f, b, c));
        const u32 fourth = add(f, a, add(f, multiply(f, x, b), multiply(f, square, c)));
        table->word[0][run] = third << 16 | fourth;
    }
    table->words = 1;
    free(f);
    return 1;
}
