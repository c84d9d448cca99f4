/* An environment image of longitude and latitude, with the tables it is sampled by. Shared.
 *
 * Where +Y is up, the middle of the image is in the direction -Z; where +Z is, it is in +Y. +X is
 * to the right of it. The tables have a cell for some texels each, and blocks of cells. A block is
 * drawn in proportion to the light that it gives to a surface, about: there are tables for some
 * directions that surfaces face. A cell of the block is drawn in proportion to its light, and a
 * direction in it uniformly (Pharr, Jakob & Humphreys 2023, section 12.5; by blocks, after Clarberg
 * et al. 2005). An image that is even enough has no tables: directions are drawn as a diffuse
 * surface draws them. */
#ifndef CS_LIGHT_LAT_LONG_H
#define CS_LIGHT_LAT_LONG_H

#include "kernels/lanes.h"
#include "kernels/scene.h"
#include "kernels/trigonometry.h"

/* The ways to face that have tables of their own: squares of an octahedron's map, CS_FACINGS_ACROSS
 * each way. CS_FACING_ANY is for surfaces that light may reach from both sides. */
enum {
    CS_FACINGS_ACROSS = 16,
    CS_FACING_ANY = CS_FACINGS_ACROSS * CS_FACINGS_ACROSS,
    CS_FACINGS,
    CS_MOST_BLOCKS_X = 32,
    CS_MOST_BLOCKS_Y = 16
};

typedef struct cs_lat_long {
    CS_GLOBAL const cs_f32 *texels; /* three a texel, rows from the top */
    /* For each way to face: probability of each row of blocks and all above it; of each block and
     * all before it in its row, given the row; and of each block. */
    CS_GLOBAL const cs_f32 *blocks;
    /* For each column of blocks: probability of each row of cells and all above it in its block,
     * given the block. */
    CS_GLOBAL const cs_f32 *rows;
    /* Of each cell and all before it in its row and block, given these. */
    CS_GLOBAL const cs_f32 *columns;
    cs_u32 width; /* texels */
    cs_u32 height;
    cs_u32 cells_x; /* 0: there are no tables */
    cs_u32 cells_y;
    cs_u32 blocks_x;
    cs_u32 blocks_y;
    cs_f32 cosine; /* of the angle by which the image is turned about the axis that is up, seen */
    cs_f32 sine;   /* from above against the clock */
    cs_i32 z_up;   /* 1: +Z is up; 0: +Y is */
} cs_lat_long;

/* The blocks that `cells` are divided into: as many as are a power of two, `most` at most. */
static inline cs_u32 cs_blocks_of(cs_u32 cells, cs_u32 most)
{
    cs_u32 power = cells & (~cells + 1u);
    return power < most ? power : most;
}

/* Numbers in the tables of one way to face. */
static inline cs_u32 cs_block_table_size(cs_u32 blocks_x, cs_u32 blocks_y)
{
    return blocks_y * (1u + 2u * blocks_x);
}

/* The parts of the environment's buffer, in this order. */
static inline cs_lat_long cs_lat_long_of(CS_GLOBAL const cs_light *light,
                                         CS_GLOBAL const cs_f32 *buffer)
{
    cs_lat_long image;
    image.width = light->count;
    image.height = (cs_u32)light->parameters[0];
    image.cells_x = (cs_u32)light->parameters[1];
    image.cells_y = (cs_u32)light->parameters[2];
    image.cosine = light->parameters[3];
    image.sine = light->parameters[4];
    image.z_up = light->axis[2] > light->axis[1];
    image.blocks_x = cs_blocks_of(image.cells_x, CS_MOST_BLOCKS_X);
    image.blocks_y = cs_blocks_of(image.cells_y, CS_MOST_BLOCKS_Y);
    image.texels = buffer;
    image.blocks = buffer + (size_t)3 * image.width * image.height;
    image.rows =
        image.blocks + (cs_u32)CS_FACINGS * cs_block_table_size(image.blocks_x, image.blocks_y);
    image.columns = image.rows + image.blocks_x * image.cells_y;
    return image;
}

/* Vectors as the image sees them: to the right of its middle, upwards, and away from its middle. */
static inline void cs_lat_long_turn(const cs_lat_long *image, const cs_vfloat *vector,
                                    cs_vfloat *right, cs_vfloat *up, cs_vfloat *ahead)
{
    cs_vfloat back = image->z_up ? -vector[1] : vector[2];
    *up = image->z_up ? vector[2] : vector[1];
    *right = image->cosine * vector[0] - image->sine * back;
    *ahead = -image->cosine * back - image->sine * vector[0];
}

/* The texel or cell that a place is in, 0 to `count` - 1. Places beyond the ends, and those that
 * are no numbers, get the one at an end. */
static inline cs_vint cs_cell_at(cs_vfloat place, cs_u32 count)
{
    return cs_whole(cs_clamp(place, (cs_vfloat)(0.0f), (cs_vfloat)((cs_f32)(count - 1u))));
}

/* Which way surfaces with these unit normals face, 0 to CS_FACING_ANY - 1. The octahedron's map:
 * Meyer et al. 2010. */
static inline cs_vint cs_lat_long_facing(const cs_lat_long *image, const cs_vfloat *normal)
{
    cs_vfloat right, up, ahead;
    cs_lat_long_turn(image, normal, &right, &up, &ahead);
    cs_vfloat scale =
        1.0f / cs_max(cs_abs(right) + cs_abs(up) + cs_abs(ahead), (cs_vfloat)(1e-20f));
    cs_vfloat x = right * scale, y = ahead * scale;
    cs_vfloat folded_x = x < 0.0f ? cs_abs(y) - 1.0f : 1.0f - cs_abs(y);
    cs_vfloat folded_y = y < 0.0f ? cs_abs(x) - 1.0f : 1.0f - cs_abs(x);
    cs_f32 half_way = 0.5f * (cs_f32)CS_FACINGS_ACROSS;
    cs_vint column =
        cs_cell_at((up < 0.0f ? folded_x : x) * half_way + half_way, (cs_u32)CS_FACINGS_ACROSS);
    cs_vint row =
        cs_cell_at((up < 0.0f ? folded_y : y) * half_way + half_way, (cs_u32)CS_FACINGS_ACROSS);
    return row * (cs_i32)CS_FACINGS_ACROSS + column;
}

/* First of `count` cumulative probabilities, from index `first` on in each lane, that exceeds
 * `target`; what is left of `target`, in [0, 1]; and that entry's own probability. The last one is
 * 1, more than any target. The steps are those of all lanes: no branch depends on what is found. */
static inline cs_vint cs_pick_cells(CS_GLOBAL const cs_f32 *cumulative, cs_vint first, cs_u32 count,
                                    cs_vfloat target, cs_vfloat *rest, cs_vfloat *probability)
{
    cs_vint low = first;
    for (cs_u32 left = count; left > 1u; left -= left / 2u) {
        cs_vint middle = low + (cs_i32)(left / 2u);
        low = cs_gather(cumulative, middle - 1) > target ? low : middle;
    }
    cs_vint is_first = low == first;
    cs_vfloat below = cs_gather(cumulative, is_first ? low : low - 1);
    below = is_first ? (cs_vfloat)(0.0f) : below;
    *probability = cs_gather(cumulative, low) - below;
    cs_vfloat part = (target - below) / cs_max(*probability, (cs_vfloat)(1e-37f));
    *rest = cs_clamp(part, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
    return low - first;
}

/* Density, per steradian, of the directions in cells. top, bottom: cosines of the angles from above
 * at the edges of their rows. */
static inline cs_vfloat cs_cell_density(const cs_lat_long *image, cs_vfloat chance, cs_vfloat top,
                                        cs_vfloat bottom)
{
    return chance * (cs_f32)image->cells_x / (2.0f * CS_PI * (top - bottom));
}

/* Draws cells by points of the unit square; returns their probabilities. x, y: the point, then the
 * place in the cell. */
static inline cs_vfloat cs_lat_long_draw_cell(const cs_lat_long *image, cs_vint facing,
                                              cs_vfloat *x, cs_vfloat *y, cs_vint *row,
                                              cs_vint *column)
{
    cs_i32 table = (cs_i32)cs_block_table_size(image->blocks_x, image->blocks_y);
    cs_i32 cells_x = (cs_i32)image->cells_x, cells_y = (cs_i32)image->cells_y;
    cs_u32 across = image->cells_x / image->blocks_x, down = image->cells_y / image->blocks_y;
    cs_vfloat of_block_row, of_block, of_row, of_cell;
    cs_vint first = facing * table;
    cs_vint block_y = cs_pick_cells(image->blocks, first, image->blocks_y, *y, y, &of_block_row);
    first += (cs_i32)image->blocks_y + block_y * (cs_i32)image->blocks_x;
    cs_vint block_x = cs_pick_cells(image->blocks, first, image->blocks_x, *x, x, &of_block);
    *row = block_y * (cs_i32)down;
    *row += cs_pick_cells(image->rows, block_x * cells_y + *row, down, *y, y, &of_row);
    *column = block_x * (cs_i32)across;
    *column += cs_pick_cells(image->columns, *row * cells_x + *column, across, *x, x, &of_cell);
    return of_block_row * of_block * of_row * of_cell;
}

/* Draws directions, unit vectors, by points of the unit square, for surfaces that face a way;
 * returns their densities. x, y: the point, then the place in the image, as cs_lat_long_place says
 * it. */
static inline cs_vfloat cs_lat_long_draw(const cs_lat_long *image, cs_vint facing, cs_vfloat *x,
                                         cs_vfloat *y, cs_vfloat *direction)
{
    cs_vfloat across = *x, down = *y, top, bottom, sine, cosine, unused;
    cs_vint row, column;
    cs_vfloat chance = cs_lat_long_draw_cell(image, facing, &across, &down, &row, &column);
    cs_f32 height = CS_PI / (cs_f32)image->cells_y;
    cs_vfloat above = cs_from_whole(row);
    cs_sine_cosine(above * height, &unused, &top);
    cs_sine_cosine((above + 1.0f) * height, &unused, &bottom);
    cs_vfloat up = top + down * (bottom - top);
    cs_vfloat outward = cs_sqrt(cs_max(1.0f - up * up, (cs_vfloat)(0.0f)));
    *x = (cs_from_whole(column) + across) / (cs_f32)image->cells_x;
    *y = cs_angle_to(outward, up) * CS_INVERSE_PI;
    cs_sine_cosine((*x - 0.5f) * (2.0f * CS_PI), &sine, &cosine); /* from -Z towards +X */
    cs_vfloat right = outward * sine, ahead = outward * cosine;
    cs_vfloat back = -image->cosine * ahead - image->sine * right;
    direction[0] = image->cosine * right - image->sine * ahead;
    direction[1] = image->z_up ? -back : up;
    direction[2] = image->z_up ? up : back;
    return cs_cell_density(image, chance, top, bottom);
}

/* Where directions, of any length, are in the image: parts of its width and height. */
static inline void cs_lat_long_place(const cs_lat_long *image, const cs_vfloat *direction,
                                     cs_vfloat *x, cs_vfloat *y)
{
    cs_vfloat right, up, ahead;
    cs_lat_long_turn(image, direction, &right, &up, &ahead);
    *x = 0.5f + cs_angle_to(right, ahead) * (0.5f * CS_INVERSE_PI);
    *y = cs_angle_to(cs_sqrt(right * right + ahead * ahead), up) * CS_INVERSE_PI;
}

/* The block of cell number `cell`, of `cells`, of which a block has `size`. */
static inline cs_vint cs_block_at(cs_vint cell, cs_u32 size)
{
    return cs_whole((cs_from_whole(cell) + 0.5f) * (1.0f / (cs_f32)size));
}

/* What entry `index` adds to cumulative probabilities that begin at index `first`. */
static inline cs_vfloat cs_own_chance(CS_GLOBAL const cs_f32 *cumulative, cs_vint first,
                                      cs_vint index)
{
    cs_vfloat below = cs_gather(cumulative, index > first ? index - 1 : index);
    return cs_gather(cumulative, index) - (index > first ? below : (cs_vfloat)(0.0f));
}

/* The density with which cs_lat_long_draw draws the directions at places in the image. */
static inline cs_vfloat cs_lat_long_density(const cs_lat_long *image, cs_vint facing, cs_vfloat x,
                                            cs_vfloat y)
{
    cs_vfloat top, bottom, unused;
    cs_u32 across = image->cells_x / image->blocks_x, down = image->cells_y / image->blocks_y;
    cs_vint row = cs_cell_at(y * (cs_f32)image->cells_y, image->cells_y);
    cs_vint column = cs_cell_at(x * (cs_f32)image->cells_x, image->cells_x);
    cs_vint block_x = cs_block_at(column, across), block_y = cs_block_at(row, down);
    cs_i32 table = (cs_i32)cs_block_table_size(image->blocks_x, image->blocks_y);
    cs_i32 behind = (cs_i32)(image->blocks_y * (1u + image->blocks_x));
    cs_vint block = block_y * (cs_i32)image->blocks_x + block_x;
    cs_vint in_column = block_x * (cs_i32)image->cells_y, in_row = row * (cs_i32)image->cells_x;
    cs_vfloat chance =
        cs_gather(image->blocks, facing * table + behind + block) *
        cs_own_chance(image->rows, in_column + block_y * (cs_i32)down, in_column + row) *
        cs_own_chance(image->columns, in_row + block_x * (cs_i32)across, in_row + column);
    cs_f32 height = CS_PI / (cs_f32)image->cells_y;
    cs_vfloat above = cs_from_whole(row);
    cs_sine_cosine(above * height, &unused, &top);
    cs_sine_cosine((above + 1.0f) * height, &unused, &bottom);
    return cs_cell_density(image, chance, top, bottom);
}

/* Radiance at places in the image: bilinear, around the horizon and up to the poles. */
static inline void cs_lat_long_radiance(const cs_lat_long *image, cs_vfloat x, cs_vfloat y,
                                        cs_vfloat *radiance)
{
    cs_i32 width = (cs_i32)image->width, height = (cs_i32)image->height;
    cs_vfloat place_x = x * (cs_f32)width - 0.5f;
    place_x = place_x < 0.0f ? place_x + (cs_f32)width : place_x;
    cs_vfloat place_y = cs_max(y * (cs_f32)height - 0.5f, (cs_vfloat)(0.0f));
    cs_vint left = cs_cell_at(place_x, image->width), above = cs_cell_at(place_y, image->height);
    cs_vfloat across = place_x - cs_from_whole(left);
    cs_vfloat down = place_y - cs_from_whole(above);
    cs_vint right = left + 1 < width ? left + 1 : (cs_vint)(0);
    cs_vint upper = above * width, lower = above + 1 < height ? upper + width : upper;
    /* Each load reads four numbers, a texel has three. The tables, or one unused number, follow the
     * last texel. */
    cs_vfloat found[4];
    const cs_vint corner[4] = {3 * (upper + left), 3 * (lower + left), 3 * (upper + right),
                               3 * (lower + right)};
    cs_blend_corners(image->texels, corner, across, down, found);
    for (int c = 0; c < 3; c++)
        radiance[c] = found[c];
}

#endif
