/* An environment image of longitude and latitude, with the tables it is sampled by. Shared.
 *
 * +Y is up. The middle of the image is in the direction -Z, and +X is to the right of it. The
 * tables have a cell for some texels each; a cell is drawn in proportion to the light that it
 * gives, a direction in it uniformly (Pharr, Jakob & Humphreys 2023, section 12.5). */
#ifndef CS_LIGHT_LAT_LONG_H
#define CS_LIGHT_LAT_LONG_H

#include "kernels/lanes.h"
#include "kernels/scene.h"
#include "kernels/trigonometry.h"

typedef struct cs_lat_long {
    CS_GLOBAL const cs_f32 *texels;  /* three a texel, rows from the top */
    CS_GLOBAL const cs_f32 *rows;    /* probability of each row of cells and all above it */
    CS_GLOBAL const cs_f32 *columns; /* of each cell and all before it in its row, given the row */
    cs_u32 width;                    /* texels */
    cs_u32 height;
    cs_u32 cells_x;
    cs_u32 cells_y;
    cs_f32 cosine; /* of the angle by which the image is turned about +Y, seen from above against */
    cs_f32 sine;   /* the clock */
} cs_lat_long;

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
    image.texels = buffer;
    image.rows = buffer + (size_t)3 * image.width * image.height;
    image.columns = image.rows + image.cells_y;
    return image;
}

/* First of `count` cumulative probabilities that exceeds `target`; what is left of `target`, in
 * [0, 1]; and that entry's own probability. */
static inline cs_u32 cs_pick_cell(CS_GLOBAL const cs_f32 *cumulative, cs_u32 count, cs_f32 target,
                                  cs_f32 *rest, cs_f32 *probability)
{
    cs_u32 low = 0u, high = count - 1u;
    while (low < high) {
        cs_u32 middle = (low + high) / 2u;
        if (cumulative[middle] > target)
            high = middle;
        else
            low = middle + 1u;
    }
    cs_f32 below = low > 0u ? cumulative[low - 1u] : 0.0f;
    *probability = cumulative[low] - below;
    cs_f32 part = *probability > 0.0f ? (target - below) / *probability : 0.0f;
    *rest = part < 0.0f ? 0.0f : part > 1.0f ? 1.0f : part;
    return low;
}

/* Cells of the image, one a lane. */
typedef struct cs_lat_long_cells {
    cs_float_each row;
    cs_float_each column;
    cs_float_each chance; /* of drawing the cell */
} cs_lat_long_cells;

/* Density, per steradian, of the directions in cells. top, bottom: cosines of the angles from +Y at
 * the edges of their rows. */
static inline cs_vfloat cs_cell_density(const cs_lat_long *image, cs_vfloat chance, cs_vfloat top,
                                        cs_vfloat bottom)
{
    return chance * (cs_f32)image->cells_x / (2.0f * CS_PI * (top - bottom));
}

/* Draws directions, unit vectors, by points of the unit square; returns their densities. */
static inline cs_vfloat cs_lat_long_draw(const cs_lat_long *image, cs_vfloat x, cs_vfloat y,
                                         cs_vfloat *direction)
{
    cs_lat_long_cells cells;
    cs_float_each across, down;
    across.all = x;
    down.all = y;
    for (int lane = 0; lane < CS_PACKET; lane++) {
        cs_f32 along, below, row_chance, column_chance;
        cs_u32 row = cs_pick_cell(image->rows, image->cells_y, CS_LANE(down), &below, &row_chance);
        cs_u32 column = cs_pick_cell(image->columns + (size_t)row * image->cells_x, image->cells_x,
                                     CS_LANE(across), &along, &column_chance);
        CS_LANE(across) = along;
        CS_LANE(down) = below;
        CS_LANE(cells.row) = (cs_f32)row;
        CS_LANE(cells.column) = (cs_f32)column;
        CS_LANE(cells.chance) = row_chance * column_chance;
    }
    cs_f32 height = CS_PI / (cs_f32)image->cells_y;
    cs_vfloat top = cs_cos(cells.row.all * height),
              bottom = cs_cos((cells.row.all + 1.0f) * height);
    cs_vfloat up = top + down.all * (bottom - top);
    cs_vfloat outward = cs_sqrt(cs_max(1.0f - up * up, (cs_vfloat)(0.0f)));
    cs_vfloat place = (cells.column.all + across.all) / (cs_f32)image->cells_x;
    cs_vfloat longitude = (place - 0.5f) * (2.0f * CS_PI); /* from -Z towards +X */
    cs_vfloat right = outward * cs_sin(longitude), ahead = outward * cs_cos(longitude);
    direction[0] = image->cosine * right - image->sine * ahead;
    direction[1] = up;
    direction[2] = -image->cosine * ahead - image->sine * right;
    return cs_cell_density(image, cells.chance.all, top, bottom);
}

/* Where directions, of any length, are in the image: parts of its width and height. */
static inline void cs_lat_long_place(const cs_lat_long *image, const cs_vfloat *direction,
                                     cs_vfloat *x, cs_vfloat *y)
{
    cs_vfloat right = image->cosine * direction[0] - image->sine * direction[2];
    cs_vfloat ahead = -image->cosine * direction[2] - image->sine * direction[0];
    *x = 0.5f + cs_atan2(right, ahead) * (0.5f * CS_INVERSE_PI);
    *y = cs_atan2(cs_sqrt(right * right + ahead * ahead), direction[1]) * CS_INVERSE_PI;
}

/* The number of a texel or cell, of `count`, from its place; the last for what is none. */
static inline cs_u32 cs_cell_at(cs_f32 place, cs_u32 count)
{
    cs_u32 cell = (cs_u32)place;
    return cell < count ? cell : count - 1u;
}

/* The density with which cs_lat_long_draw draws the directions at places in the image. */
static inline cs_vfloat cs_lat_long_density(const cs_lat_long *image, cs_vfloat x, cs_vfloat y)
{
    cs_float_each column, row, chance;
    column.all = x * (cs_f32)image->cells_x;
    row.all = y * (cs_f32)image->cells_y;
    for (int lane = 0; lane < CS_PACKET; lane++) {
        cs_u32 down = cs_cell_at(CS_LANE(row), image->cells_y);
        cs_u32 along = cs_cell_at(CS_LANE(column), image->cells_x);
        CS_GLOBAL const cs_f32 *columns = image->columns + (size_t)down * image->cells_x;
        cs_f32 row_chance = image->rows[down] - (down > 0u ? image->rows[down - 1u] : 0.0f);
        cs_f32 column_chance = columns[along] - (along > 0u ? columns[along - 1u] : 0.0f);
        CS_LANE(row) = (cs_f32)down;
        CS_LANE(chance) = row_chance * column_chance;
    }
    cs_f32 height = CS_PI / (cs_f32)image->cells_y;
    return cs_cell_density(image, chance.all, cs_cos(row.all * height),
                           cs_cos((row.all + 1.0f) * height));
}

/* Radiance at places in the image: bilinear, around the horizon and up to the poles. */
static inline void cs_lat_long_radiance(const cs_lat_long *image, cs_vfloat x, cs_vfloat y,
                                        cs_vfloat *radiance)
{
    cs_float_each place_x, place_y, found[3];
    place_x.all = x * (cs_f32)image->width - 0.5f;
    place_x.all = place_x.all < 0.0f ? place_x.all + (cs_f32)image->width : place_x.all;
    place_y.all = cs_max(y * (cs_f32)image->height - 0.5f, (cs_vfloat)(0.0f));
    for (int lane = 0; lane < CS_PACKET; lane++) {
        cs_u32 left = cs_cell_at(CS_LANE(place_x), image->width);
        cs_u32 above = cs_cell_at(CS_LANE(place_y), image->height);
        cs_f32 across = CS_LANE(place_x) - (cs_f32)left, down = CS_LANE(place_y) - (cs_f32)above;
        cs_u32 right = left + 1u < image->width ? left + 1u : 0u;
        cs_u32 below = above + 1u < image->height ? above + 1u : above;
        CS_GLOBAL const cs_f32 *upper = image->texels + (size_t)3 * above * image->width;
        CS_GLOBAL const cs_f32 *lower = image->texels + (size_t)3 * below * image->width;
        for (cs_u32 c = 0u; c < 3u; c++) {
            cs_f32 a = upper[3u * left + c], b = lower[3u * left + c];
            cs_f32 high = a + across * (upper[3u * right + c] - a);
            cs_f32 low = b + across * (lower[3u * right + c] - b);
            CS_LANE(found[c]) = high + down * (low - high);
        }
    }
    for (int c = 0; c < 3; c++)
        radiance[c] = found[c].all;
}

#endif
