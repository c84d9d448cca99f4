#include "scene/environment_tables.h"

#include <math.h>
#include <stdlib.h>

#include "base/pi.h"
#include "base/vec.h"
#include "kernels/light/lat_long.h"
#include "scene/scene.h"

enum {
    PARTS = 2,  /* of a block each way, that are looked at as one direction; 1 or 2 */
    NORMALS = 3 /* that stand for a way to face, each way */
};

/* Of the weight of a block, what goes by the mean cosine of the normals that face one way, and what
 * by the largest: no direction may have a much smaller density than some of them need. */
static const double by_mean = 0.75, by_most = 0.25;

/* Between a normal that faces a way and the nearest of those that stand for it, at most. */
static const double between_normals_rad = 0.089;

/* An image, and what is made of it. */
typedef struct table_maker {
    const float *texels;
    size_t width, height;
    size_t across, down;       /* cells */
    size_t blocks_x, blocks_y; /* a power of two each */
    size_t parts_x, parts_y;   /* of a block */
    double *light;             /* of each cell, row by row: luminance times its solid angle */
    double *of_parts;          /* of the parts of all blocks, row by row */
} table_maker;

/* ----- Cells ----- */

static double luminance_at(const table_maker *maker, size_t x, size_t y)
{
    const float *texel = maker->texels + 3 * (y * maker->width + x);
    return cs_luminance_double((double)texel[0], (double)texel[1], (double)texel[2]);
}

/* Mean luminance of the bilinear image over a texel. Over the half of a texel that is nearer to one
 * neighbour the interpolation gives it 1/8 of the whole, so the weights along an axis are 1/8, 3/4,
 * 1/8: no direction that shines has density 0. */
static double mean_luminance(const table_maker *maker, size_t x, size_t y)
{
    static const double weights[3] = {0.125, 0.75, 0.125};
    double sum = 0.0;
    for (size_t j = 0; j < 3; j++)
        for (size_t i = 0; i < 3; i++) {
            size_t row = y + j > 0 ? y + j - 1 : 0;
            if (row >= maker->height) row = maker->height - 1;
            sum += weights[i] * weights[j] *
                   luminance_at(maker, (x + maker->width + i - 1) % maker->width, row);
        }
    return sum;
}

static void find_light(table_maker *maker)
{
    const size_t step_x = maker->width / maker->across, step_y = maker->height / maker->down;
    for (size_t row = 0; row < maker->down; row++) {
        const double top = cos(CS_PI_DOUBLE * (double)row / (double)maker->down);
        const double bottom = cos(CS_PI_DOUBLE * (double)(row + 1) / (double)maker->down);
        for (size_t column = 0; column < maker->across; column++) {
            double sum = 0.0;
            for (size_t y = row * step_y; y < (row + 1) * step_y; y++)
                for (size_t x = column * step_x; x < (column + 1) * step_x; x++)
                    sum += mean_luminance(maker, x, y);
            maker->light[row * maker->across + column] = sum * (top - bottom);
        }
    }
}

/* Adds up the light of the cells of each part. The edge of a part may halve cells, so each cell is
 * four quarters. */
static void find_light_of_parts(table_maker *maker)
{
    const size_t all_x = maker->blocks_x * maker->parts_x, all_y = maker->blocks_y * maker->parts_y;
    for (size_t i = 0; i < all_x * all_y; i++)
        maker->of_parts[i] = 0.0;
    for (size_t y = 0; y < 2 * maker->down; y++)
        for (size_t x = 0; x < 2 * maker->across; x++) {
            const size_t row = y * all_y / (2 * maker->down),
                         column = x * all_x / (2 * maker->across);
            maker->of_parts[row * all_x + column] +=
                0.25 * maker->light[y / 2 * maker->across + x / 2];
        }
}

/* Makes cumulative probabilities of weights; returns their sum. All 0: even. */
static double accumulate(const double *weights, size_t count, float *cumulative)
{
    double total = 0.0, below = 0.0;
    for (size_t i = 0; i < count; i++)
        total += weights[i];
    for (size_t i = 0; i < count; i++) {
        below += weights[i];
        cumulative[i] = (float)(total > 0.0 ? below / total : ((double)i + 1.0) / (double)count);
    }
    cumulative[count - 1] = 1.0f;
    return total;
}

/* For each column of blocks its rows of cells, and behind them all cells: both begin anew in each
 * block. `weights` has room for `down` of them. */
static void tabulate_cells(const table_maker *maker, double *weights, float *rows)
{
    const size_t high = maker->down / maker->blocks_y, wide = maker->across / maker->blocks_x;
    float *columns = rows + maker->blocks_x * maker->down;
    for (size_t x = 0; x < maker->across; x += wide)
        for (size_t y = 0; y < maker->down; y += high) {
            for (size_t row = 0; row < high; row++) {
                const size_t first = (y + row) * maker->across + x;
                weights[row] = accumulate(maker->light + first, wide, columns + first);
            }
            accumulate(weights, high, rows + x / wide * maker->down + y);
        }
}

/* ----- Blocks ----- */

/* The unit vector, as the image sees it, at a point of the octahedron's map, -1 to 1. */
static void decode_octahedron(double x, double y, double *vector)
{
    const double up = 1.0 - fabs(x) - fabs(y);
    vector[0] = up >= 0.0 ? x : copysign(1.0 - fabs(y), x);
    vector[1] = up;
    vector[2] = up >= 0.0 ? y : copysign(1.0 - fabs(x), y);
    const double length = sqrt(vector[0] * vector[0] + up * up + vector[2] * vector[2]);
    for (int i = 0; i < 3; i++)
        vector[i] /= length;
}

/* Normals that face one way, from edge to edge. */
static void find_normals(int facing, double normals[NORMALS * NORMALS][3])
{
    for (int i = 0; i < NORMALS * NORMALS; i++) {
        const int column = facing % CS_FACINGS_ACROSS, row = facing / CS_FACINGS_ACROSS;
        const int across = i % NORMALS, down = i / NORMALS;
        const double x = column + across / (NORMALS - 1.0), y = row + down / (NORMALS - 1.0);
        decode_octahedron(2.0 * x / CS_FACINGS_ACROSS - 1.0, 2.0 * y / CS_FACINGS_ACROSS - 1.0,
                          normals[i]);
    }
}

/* What light from a part of a block counts for surfaces that face a way; 0 only where it is behind
 * all of them. polar, longitude, as the image has them: of the part's middle. spread: sine of the
 * angle from there to any direction of the part, and between a normal and the nearest of these. */
static double weight_of(double normals[NORMALS * NORMALS][3], double polar, double longitude,
                        double spread)
{
    const double direction[3] = {sin(polar) * sin(longitude), cos(polar),
                                 sin(polar) * cos(longitude)};
    double sum = 0.0, most = -1.0;
    for (int i = 0; i < NORMALS * NORMALS; i++) {
        const double cosine = cs_vec_dot_double(normals[i], direction);
        if (cosine > 0.0) sum += cosine;
        if (cosine > most) most = cosine;
    }
    const double bound = most + spread > 0.0 ? most + spread : 0.0;
    return by_mean * sum / (NORMALS * NORMALS) + by_most * bound;
}

/* The light of a block for surfaces that face a way. normals: of these; NULL: the light as it is.
 */
static double block_weight(const table_maker *maker, size_t block_x, size_t block_y,
                           double normals[NORMALS * NORMALS][3])
{
    const size_t all_x = maker->blocks_x * maker->parts_x, all_y = maker->blocks_y * maker->parts_y;
    const double part_polar = CS_PI_DOUBLE / (double)all_y;
    const double part_longitude = 2.0 * CS_PI_DOUBLE / (double)all_x;
    const double apart = 0.5 * hypot(part_polar, part_longitude) + between_normals_rad;
    const double spread = apart < 0.5 * CS_PI_DOUBLE ? sin(apart) : 1.0;
    double sum = 0.0;
    for (size_t i = 0; i < maker->parts_x * maker->parts_y; i++) {
        const size_t x = block_x * maker->parts_x + i % maker->parts_x;
        const size_t y = block_y * maker->parts_y + i / maker->parts_x;
        const double light = maker->of_parts[y * all_x + x];
        const double polar = ((double)y + 0.5) * part_polar;
        const double longitude = ((double)x + 0.5) * part_longitude - CS_PI_DOUBLE;
        if (light > 0.0)
            sum += light * (normals != NULL ? weight_of(normals, polar, longitude, spread) : 1.0);
    }
    return sum;
}

/* The tables of one way to face. */
static void tabulate_blocks(const table_maker *maker, double normals[NORMALS * NORMALS][3],
                            float *table)
{
    double of_rows[CS_MOST_BLOCKS_Y], of_blocks[CS_MOST_BLOCKS_X];
    float *columns = table + maker->blocks_y;
    float *chances = columns + maker->blocks_y * maker->blocks_x;
    for (size_t y = 0; y < maker->blocks_y; y++) {
        for (size_t x = 0; x < maker->blocks_x; x++)
            of_blocks[x] = block_weight(maker, x, y, normals);
        of_rows[y] = accumulate(of_blocks, maker->blocks_x, columns + y * maker->blocks_x);
    }
    accumulate(of_rows, maker->blocks_y, table);
    for (size_t i = 0; i < maker->blocks_x * maker->blocks_y; i++) {
        const size_t y = i / maker->blocks_x;
        const float above = y > 0 ? table[y - 1] : 0.0f;
        const float before = i % maker->blocks_x > 0 ? columns[i - 1] : 0.0f;
        chances[i] = (table[y] - above) * (columns[i] - before);
    }
}

clshear_status cs_environment_tabulate(size_t width, size_t height, size_t across, size_t down,
                                       cs_array *image, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    double normals[NORMALS * NORMALS][3], *weights = malloc(down * sizeof *weights);
    table_maker maker = {.width = width,
                         .height = height,
                         .across = across,
                         .down = down,
                         .blocks_x = cs_blocks_of((cs_u32)across, CS_MOST_BLOCKS_X),
                         .blocks_y = cs_blocks_of((cs_u32)down, CS_MOST_BLOCKS_Y),
                         .light = malloc(across * down * sizeof *maker.light)};
    maker.parts_x = across / maker.blocks_x < PARTS ? across / maker.blocks_x : PARTS;
    maker.parts_y = down / maker.blocks_y < PARTS ? down / maker.blocks_y : PARTS;
    maker.of_parts = malloc(PARTS * PARTS * maker.blocks_x * maker.blocks_y * sizeof(double));
    const size_t size = cs_block_table_size((cs_u32)maker.blocks_x, (cs_u32)maker.blocks_y);
    float *tables =
        cs_array_extend(image, CS_FACINGS * size + maker.blocks_x * down + across * down);
    CS_REQUIRE(weights != NULL && maker.light != NULL && maker.of_parts != NULL && tables != NULL,
               CLSHEAR_OUT_OF_MEMORY, "out of memory for an environment of %zu x %zu texels", width,
               height);
    maker.texels = image->items;
    find_light(&maker);
    find_light_of_parts(&maker);
    for (int facing = 0; facing < CS_FACINGS; facing++) {
        if (facing < CS_FACING_ANY) find_normals(facing, normals);
        tabulate_blocks(&maker, facing < CS_FACING_ANY ? normals : NULL,
                        tables + (size_t)facing * size);
    }
    tabulate_cells(&maker, weights, tables + CS_FACINGS * size);
done:
    free(maker.light);
    free(maker.of_parts);
    free(weights);
    return status;
}
