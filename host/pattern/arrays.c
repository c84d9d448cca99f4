/* Sample tables of the orthogonal arrays, and the finite fields behind them. */
#include <stdlib.h>
#include <string.h>

#include "pattern/table_makers.h"

enum {
    MOST_LEVELS = 1024, /* CS_MAX_PATTERN is the square of this */
    MOST_DIGITS = 10
};

/* The finite field of q = prime^degree elements. An element's number has the coefficients of its
 * polynomial as digits in base `prime`. */
typedef struct field {
    cs_u32 q;
    cs_u32 prime;
    cs_u32 degree;
    cs_u32 power[MOST_LEVELS]; /* powers 0 to q - 2 of a generator */
    cs_u32 logarithm[MOST_LEVELS];
} field;

static int factor(cs_u32 q, cs_u32 *prime, cs_u32 *degree)
{
    *prime = 2;
    while (*prime * *prime <= q && q % *prime != 0)
        ++*prime;
    if (q % *prime != 0) *prime = q;
    for (*degree = 0; q % *prime == 0; q /= *prime)
        ++*degree;
    return q == 1;
}

int cs_is_prime_power(cs_u32 q)
{
    cs_u32 prime, degree;
    return q >= 2 && factor(q, &prime, &degree);
}

static cs_u32 add(const field *f, cs_u32 a, cs_u32 b)
{
    cs_u32 sum = 0, place = 1;
    for (; a != 0 || b != 0; a /= f->prime, b /= f->prime, place *= f->prime)
        sum += (a + b) % f->prime * place;
    return sum;
}

static cs_u32 multiply(const field *f, cs_u32 a, cs_u32 b)
{
    if (a == 0 || b == 0) return 0;
    return f->power[(f->logarithm[a] + f->logarithm[b]) % (f->q - 1)];
}

/* a times x, modulo x^degree - `rest`. */
static cs_u32 times_x(const field *f, cs_u32 a, cs_u32 rest)
{
    const cs_u32 top = f->q / f->prime;
    const cs_u32 carry = a / top;
    cs_u32 product = a % top * f->prime;
    for (cs_u32 i = 0; i < carry; i++)
        product = add(f, product, rest);
    return product;
}

/* Finds a primitive polynomial: modulo it, the powers of x are all elements except 0. Returns NULL
 * when out of memory, or if q < 3: an array has three levels or more. The caller frees it. */
static field *make_field(cs_u32 q)
{
    field *f = q >= 3 ? calloc(1, sizeof *f) : NULL;
    if (f == NULL) return NULL;
    f->q = q;
    factor(q, &f->prime, &f->degree);
    for (cs_u32 rest = 1; rest < q; rest++) {
        cs_u32 element = 1, order = 0;
        do {
            f->power[order] = element;
            f->logarithm[element] = order++;
            element = times_x(f, element, rest);
        } while (element > 1 && order < q - 1);
        if (order == q - 1 && element == 1) break;
    }
    return f;
}

/* Run i q + j has the levels i + j and i + x j, where x generates the field. */
int cs_table_oa(cs_table *table)
{
    const cs_u32 q = table->pattern->grid.columns;
    field *f = make_field(q);
    if (f == NULL) return 0;
    const cs_u32 x = f->power[1];
    for (cs_u32 run = 0; run < q * q; run++) {
        const cs_u32 i = run / q, j = run % q;
        table->word[0][run] = add(f, i, j) << 16 | add(f, i, multiply(f, x, j));
    }
    table->words = 1;
    free(f);
    return 1;
}

/* Bush's array: run (a q + c) q + b has the values of a + b x + c x^2 at x = 0, infinity, 1 and a
 * generator. The first two values are a and c. */
int cs_table_oa3(cs_table *table)
{
    const cs_u32 q = table->pattern->grid.columns;
    field *f = make_field(q);
    if (f == NULL) return 0;
    const cs_u32 x = f->power[1], square = multiply(f, x, x);
    for (cs_u32 run = 0; run < q * q * q; run++) {
        const cs_u32 a = run / (q * q), c = run / q % q, b = run % q;
        const cs_u32 third = add(f, a, add(f, b, c));
        const cs_u32 fourth = add(f, a, add(f, multiply(f, x, b), multiply(f, square, c)));
        table->word[0][run] = third << 16 | fourth;
    }
    table->words = 1;
    free(f);
    return 1;
}
