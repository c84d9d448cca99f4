/* An environment image of longitude and latitude, with the tables it is sampled by. Shared.
 *
 * +Y is up. The middle of the image is in the direction -Z, and +X is to the right of it. The
 * tables have a cell for some texels each; a cell is drawn in proportion to the light that it
 * gives, a direction in it uniformly (Pharr, Jakob & Humphreys 2023, section 12.5). */
#ifndef CS_LIGHT_LAT_LONG_H
#define CS_LIGHT_LAT_LONG_H

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

/* Cosine of the angle from +Y at the upper edge of a row of cells. */
static inline cs_f32 cs_row_cosine(const cs_lat_long *image, cs_u32 row)
{
    return cs_cos((cs_f32)row * (CS_PI / (cs_f32)image->cells_y));
}

/* Density, per steradian, of the directions in a cell, given its probability. */
static inline cs_f32 cs_cell_density(const cs_lat_long *image, cs_u32 row, cs_f32 probability)
{
    cs_f32 height = cs_row_cosine(image, row) - cs_row_cosine(image, row + 1u);
    return probability * (cs_f32)image->cells_x / (2.0f * CS_PI * height);
}

/* Draws a direction, a unit vector, by a point of the unit square; returns its density. */
static inline cs_f32 cs_lat_long_draw(const cs_lat_long *image, cs_f32 x, cs_f32 y,
                                      cs_f32 *direction)
{
    cs_f32 down, across, row_chance, column_chance;
    cs_u32 row = cs_pick_cell(image->rows, image->cells_y, y, &down, &row_chance);
    cs_u32 column = cs_pick_cell(image->columns + (size_t)row * image->cells_x, image->cells_x, x,
                                 &across, &column_chance);
    cs_f32 top = cs_row_cosine(image, row), bottom = cs_row_cosine(image, row + 1u);
    cs_f32 up = top + down * (bottom - top);
    cs_f32 outward = 1.0f - up * up;
    outward = cs_sqrt(outward > 0.0f ? outward : 0.0f);
    cs_f32 place = ((cs_f32)column + across) / (cs_f32)image->cells_x;
    cs_f32 longitude = (place - 0.5f) * (2.0f * CS_PI); /* from -Z towards +X */
    cs_f32 right = outward * cs_sin(longitude), ahead = outward * cs_cos(longitude);
    direction[0] = image->cosine * right - image->sine * ahead;
    direction[1] = up;
    direction[2] = -image->cosine * ahead - image->sine * right;
    return cs_cell_density(image, row, row_chance * column_chance);
}

/* Where a direction, of any length, is in the image: parts of its width and height. */
static inline void cs_lat_long_place(const cs_lat_long *image, const cs_f32 *direction, cs_f32 *x,
                                     cs_f32 *y)
{
    cs_f32 right = image->cosine * direction[0] - image->sine * direction[2];
    cs_f32 ahead = -image->cosine * direction[2] - image->sine * direction[0];
    *x = 0.5f + cs_atan2(right, ahead) * (0.5f * CS_INVERSE_PI);
    *y = cs_atan2(cs_sqrt(right * right + ahead * ahead), direction[1]) * CS_INVERSE_PI;
}

/* Number of the cell, of `count`, at a part of the whole. */
static inline cs_u32 cs_cell_at(cs_f32 part, cs_u32 count)
{
    cs_u32 cell = (cs_u32)(part * (cs_f32)count);
    return cell < count ? cell : count - 1u;
}

/* The density with which cs_lat_long_draw draws a direction. */
static inline cs_f32 cs_lat_long_density(const cs_lat_long *image, const cs_f32 *direction)
{
    cs_f32 x, y;
    cs_lat_long_place(image, direction, &x, &y);
    cs_u32 row = cs_cell_at(y, image->cells_y), column = cs_cell_at(x, image->cells_x);
    CS_GLOBAL const cs_f32 *columns = image->columns + (size_t)row * image->cells_x;
    cs_f32 row_chance = image->rows[row] - (row > 0u ? image->rows[row - 1u] : 0.0f);
    cs_f32 column_chance = columns[column] - (column > 0u ? columns[column - 1u] : 0.0f);
    return cs_cell_density(image, row, row_chance * column_chance);
}

/* Radiance from a direction: bilinear, around the horizon and up to the poles. */
static inline void cs_lat_long_radiance(const cs_lat_long *image, const cs_f32 *direction,
                                        cs_f32 *radiance)
{
    cs_f32 x, y;
    cs_lat_long_place(image, direction, &x, &y);
    x = x * (cs_f32)image->width - 0.5f;
    y = y * (cs_f32)image->height - 0.5f;
    y = y < 0.0f ? 0.0f : y;
    x = x < 0.0f ? x + (cs_f32)image->width : x;
    cs_u32 left = cs_cell_at(x / (cs_f32)image->width, image->width);
    cs_u32 above = cs_cell_at(y / (cs_f32)image->height, image->height);
    cs_f32 across = x - (cs_f32)left, down = y - (cs_f32)above;
    cs_u32 right = left + 1u < image->width ? left + 1u : 0u;
    cs_u32 below = above + 1u < image->height ? above + 1u : above;
    for (cs_u32 c = 0u; c < 3u; c++) {
        CS_GLOBAL const cs_f32 *upper = image->texels + (size_t)3 * above * image->width + c;
        CS_GLOBAL const cs_f32 *lower = image->texels + (size_t)3 * below * image->width + c;
        cs_f32 high = upper[3u * left] + across * (upper[3u * right] - upper[3u * left]);
        cs_f32 low = lower[3u * left] + across * (lower[3u * right] - lower[3u * left]);
        radiance[c] = high + down * (low - high);
    }
}

#endif
