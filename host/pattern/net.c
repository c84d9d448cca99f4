/* Sample tables of the progressive samplers: Sobol', the binary (0,4)-sequence, Halton. */
#include "clshear/device/sampler/net.h"
#include "clshear/device/sampler/halton.h"

#include <math.h>

#include "pattern/table_makers.h"

enum {
    BITS = 32
};

/* Columns of a binary generator matrix. Bit r of a column is row r, and row 0 makes the most
 * significant digit. Products are therefore bit-reversed coordinates. */
typedef struct generator {
    cs_u32 column[BITS];
} generator;

static cs_u32 product(const generator *matrix, cs_u32 element)
{
    cs_u32 digits = 0;
    for (int c = 0; element != 0; c++, element >>= 1)
        if (element & 1u) digits ^= matrix->column[c];
    return digits;
}

/* Cuts the plane into elementary intervals of base 2 with about CS_GROUP samples each. */
static void cut_binary(cs_table *table)
{
    cs_u32 boxes = 1, columns = 1;
    while (2 * boxes * CS_GROUP <= table->pattern->grid.count)
        boxes *= 2;
    while (2 * columns * columns <= boxes) /* boxes are square or twice as wide as high */
        columns *= 2;
    if (columns * columns > boxes) columns /= 2;
    table->boxes[0] = columns;
    table->boxes[1] = boxes / columns;
}

static void set_place(cs_table *table, cs_u32 row, cs_u32 x_reversed, cs_u32 y_reversed)
{
    table->place[0][row] = cs_reverse_bits(x_reversed);
    table->place[1][row] = cs_reverse_bits(y_reversed);
}

static int fill_net_table(cs_table *table, const generator *matrices, cs_u32 dimensions)
{
    for (cs_u32 row = 0; row < table->pattern->grid.count; row++) {
        const cs_u32 element = table->pattern->first + row;
        for (cs_u32 d = 0; d < dimensions; d++)
            table->word[d][row] = product(&matrices[d], element);
        set_place(table, row, table->word[0][row], table->word[1][row]);
    }
    table->words = dimensions;
    cut_binary(table);
    return 1;
}

/* Sobol' 1967 from primitive polynomials and initial numbers m of Joe & Kuo 2008 (their dimensions
 * 1 to 6): v_c = v_{c-s} ^ v_{c-s} >> s ^ a_1 v_{c-1} ^ ... with v_c = m_c 2^(31-c). */
static void sobol_matrix(cs_u32 degree, cs_u32 coefficients, const cs_u32 *initial,
                         generator *matrix)
{
    cs_u32 direction[BITS] = {0};
    for (cs_u32 c = 0; c < BITS; c++) {
        if (c < degree) {
            direction[c] = initial[c] << (BITS - 1 - c);
        } else {
            direction[c] = direction[c - degree] ^ direction[c - degree] >> degree;
            for (cs_u32 k = 1; k < degree; k++)
                if (coefficients >> (degree - 1 - k) & 1u) direction[c] ^= direction[c - k];
        }
        matrix->column[c] = cs_reverse_bits(direction[c]);
    }
}

int cs_table_sobol(cs_table *table)
{
    enum {
        DIMENSIONS = CS_END_LIGHT + 1
    };
    static const cs_u32 initial[DIMENSIONS][4] = {{1, 1, 1}, {1},       {1, 3},
                                                  {1, 3, 1}, {1, 1, 1}, {1, 1, 3, 3}};
    static const cs_u32 degree[DIMENSIONS] = {0, 1, 2, 3, 3, 4},
                        coefficients[DIMENSIONS] = {0, 0, 1, 1, 2, 1};
    generator matrices[DIMENSIONS];
    for (int c = 0; c < BITS; c++)
        matrices[0].column[c] = 1u << c;
    for (int d = 1; d < DIMENSIONS; d++)
        sobol_matrix(degree[d], coefficients[d], initial[d], &matrices[d]);
    return fill_net_table(table, matrices, DIMENSIONS);
}

/* The (0,4)-sequence in base 4 of Faure and Niederreiter over the field of four elements. Entry (i,
 * j) of matrix d is binom(j, i) f_d^(j-i); the f_d are the elements of the field. Each entry
 * becomes a 2 x 2 binary block, a power of a = ((0, 1), (1, 1)), as in Ahmed et al. 2025. The
 * digits of dimensions 1 and 3 are also mapped by the bijection ((1, 1), (0, 1)), which makes (x,
 * y) and (u, v) binary (0,2)-sequences too. tests/test_strata.c verifies these properties. */
static void sz_matrix(cs_u32 dimension, generator *matrix)
{
    /* Columns of the powers of a. Bit 0 is the upper row. */
    static const cs_u32 power[3][2] = {{1, 2}, {2, 3}, {3, 1}};
    static const cs_u32 exponent[CS_MAIN_DIMENSIONS] = {0, 0, 1, 2};
    for (cs_u32 c = 0; c < BITS; c++)
        matrix->column[c] = 0;
    for (cs_u32 j = 0; j < BITS / 2; j++)
        for (cs_u32 i = 0; i <= j; i++) {
            if ((i & ~j) != 0 || (dimension == 0 && i != j))
                continue; /* binom(j, i) is even, or f_0^(j-i) is 0 */
            for (cs_u32 c = 0; c < 2; c++) {
                cs_u32 block = power[exponent[dimension] * (j - i) % 3][c];
                if (dimension % 2 == 1) block ^= block >> 1;
                matrix->column[2 * j + c] |= block << (2 * i);
            }
        }
}

int cs_table_sz(cs_table *table)
{
    generator matrices[CS_MAIN_DIMENSIONS];
    for (cs_u32 d = 0; d < CS_MAIN_DIMENSIONS; d++)
        sz_matrix(d, &matrices[d]);
    return fill_net_table(table, matrices, CS_MAIN_DIMENSIONS);
}

int cs_table_index(cs_table *table)
{
    for (cs_u32 row = 0; row < table->pattern->grid.count; row++) {
        table->word[0][row] = table->pattern->first + row;
        set_place(table, row, table->word[0][row], cs_pascal(table->word[0][row]));
    }
    table->words = 1;
    cut_binary(table);
    return 1;
}

static cs_u32 digits_packed(cs_u32 element, cs_u32 base, cs_u32 bits)
{
    cs_u32 packed = 0;
    for (cs_u32 at = 0; element != 0; at += bits, element /= base)
        packed |= element % base << at;
    return packed;
}

int cs_table_halton(cs_table *table)
{
    const cs_u32 count = table->pattern->grid.count;
    for (cs_u32 row = 0; row < count; row++) {
        const cs_u32 element = table->pattern->first + row;
        table->word[0][row] = element;
        table->word[1][row] = digits_packed(element, 3, CS_HALTON_BITS3);
        table->word[2][row] = digits_packed(element, 5, CS_HALTON_BITS5);
        table->word[3][row] = digits_packed(element, 7, CS_HALTON_BITS7);
        double thirds = 0.0, scale = 1.0 / 3.0;
        for (cs_u32 rest = element; rest != 0; rest /= 3, scale /= 3.0)
            thirds += rest % 3 * scale;
        table->place[0][row] = cs_reverse_bits(element);
        table->place[1][row] = (cs_u32)(thirds * 0x1p32);
    }
    table->words = CS_MAIN_DIMENSIONS;
    /* Elementary boxes of about CS_GROUP samples, 2^a x 3^b, as square as possible. */
    cs_u32 columns = 1, bands = 1;
    while (columns * bands * 2 * CS_GROUP <= count)
        if (columns <= bands)
            columns *= 2;
        else if (columns * bands * 3 * CS_GROUP <= count)
            bands *= 3;
        else
            break;
    table->boxes[0] = columns;
    table->boxes[1] = bands;
    return 1;
}
