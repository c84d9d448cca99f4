#include "scene/emission_map.h"

#include <math.h>
#include <stdlib.h>

#include "base/vec.h"

enum {
    BLOCK = 8 /* texels a side */
};

static double number_of_half(uint16_t half)
{
    const int exponent = half >> 10 & 31, fraction = half & 1023;
    const double size =
        exponent == 0 ? ldexp(fraction, -24) : ldexp(1024 + fraction, exponent - 25);
    return half >> 15 ? -size : size;
}

static double luminance_of(const uint16_t *texel)
{
    return cs_luminance_double(number_of_half(texel[0]), number_of_half(texel[1]),
                               number_of_half(texel[2]));
}

static double *sum_at(const cs_emission_map *map, size_t x, size_t y)
{
    return map->sums + y * (map->across + 1) + x;
}

clshear_status cs_emission_map_make(const cs_scene *scene, const cs_texture *texture,
                                    cs_emission_map *map, cs_error *error)
{
    const uint16_t(*texels)[4] = scene->texels.items;
    map->texture = texture;
    map->across = (texture->width + BLOCK - 1) / BLOCK;
    map->down = (texture->height + BLOCK - 1) / BLOCK;
    map->sums = calloc((map->across + 1) * (map->down + 1), sizeof *map->sums);
    if (map->sums == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for an emissive texture");
    for (size_t y = 0; y < texture->height; y++)
        for (size_t x = 0; x < texture->width; x++)
            *sum_at(map, x / BLOCK + 1, y / BLOCK + 1) +=
                luminance_of(texels[texture->first + y * texture->width + x]);
    for (size_t y = 1; y <= map->down; y++)
        for (size_t x = 1; x <= map->across; x++)
            *sum_at(map, x, y) +=
                *sum_at(map, x - 1, y) + *sum_at(map, x, y - 1) - *sum_at(map, x - 1, y - 1);
    return CLSHEAR_OK;
}

void cs_emission_map_free(cs_emission_map *map)
{
    free(map->sums);
    map->sums = NULL;
}

/* The texels, of `size`, that lookups between two coordinates meet: from `first` up to `end`.
 * Returns 0 where they leave the image. */
static int texels_between(double low, double high, size_t size, size_t *first, size_t *end)
{
    const double turns = floor(low);
    const double from = floor((low - turns) * (double)size - 0.5);
    const double to = floor((high - turns) * (double)size - 0.5) + 2.0;
    if (!(from >= 0.0 && to <= (double)size)) return 0;
    *first = (size_t)from;
    *end = (size_t)to;
    return 1;
}

double cs_emission_map_mean(const cs_emission_map *map, const float *low, const float *high)
{
    const cs_texture *image = map->texture;
    const double whole = *sum_at(map, map->across, map->down);
    const double mean = whole / ((double)image->width * (double)image->height);
    size_t left, right, above, below;
    if ((image->lookup & ~(cs_u32)CS_TEXTURE_NEAREST) != CS_TEXTURE_REPEAT ||
        !texels_between((double)low[0], (double)high[0], image->width, &left, &right) ||
        !texels_between(1.0 - (double)high[1], 1.0 - (double)low[1], image->height, &above, &below))
        return mean;
    const size_t x0 = left / BLOCK, x1 = (right - 1) / BLOCK + 1;
    const size_t y0 = above / BLOCK, y1 = (below - 1) / BLOCK + 1;
    const double sum =
        *sum_at(map, x1, y1) - *sum_at(map, x0, y1) - *sum_at(map, x1, y0) + *sum_at(map, x0, y0);
    const size_t width = (x1 * BLOCK < image->width ? x1 * BLOCK : image->width) - x0 * BLOCK;
    const size_t height = (y1 * BLOCK < image->height ? y1 * BLOCK : image->height) - y0 * BLOCK;
    /* What is left of differences of large sums is not light. */
    return sum > 1e-12 * whole ? sum / ((double)width * (double)height) : 0.0;
}
