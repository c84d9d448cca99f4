/* Image apertures: tabulated marginals of the columns and of the texels in each column. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "clshear/device/marginal.h"
#include "image/image_io.h"
#include "optics/aperture_kinds.h"

enum {
    MOST_TEXELS = 256 /* limit of each side */
};

/* A line of `count` equally wide texels from -half_width to half_width. Texel i is at first[i *
 * stride]. */
typedef struct strip {
    const float *first;
    size_t stride;
    cs_u32 count;
    double half_width;
} strip;

static double strip_sum(const strip *texels)
{
    double sum = 0.0;
    for (cs_u32 i = 0; i < texels->count; i++)
        sum += (double)texels->first[i * texels->stride];
    return sum;
}

/* The probability of texel i. A dark strip is never chosen; equal shares avoid a division by
 * zero. */
static double share_of(const strip *texels, cs_u32 i, double sum)
{
    return sum > 0.0 ? (double)texels->first[i * texels->stride] / sum : 1.0 / texels->count;
}

/* Fills count + 1 rows of the marginal; returns its variance. */
static double fill_rows(const strip *texels, cs_f32 *rows)
{
    const double width = 2.0 * texels->half_width / texels->count, sum = strip_sum(texels);
    double cdf = 0.0, integral = 0.0, mean = 0.0, square = 0.0;
    for (cs_u32 i = 0; i <= texels->count; i++) {
        cs_f32 *row = rows + (size_t)i * CS_MARGINAL_COLUMNS;
        const double share = i < texels->count ? share_of(texels, i, sum) : 0.0;
        const double start = i * width - texels->half_width, middle = start + 0.5 * width;
        row[CS_MARGINAL_START] = (cs_f32)start;
        row[CS_MARGINAL_CDF] = i < texels->count ? (cs_f32)cdf : 1.0f;
        row[CS_MARGINAL_INTEGRAL] = (cs_f32)integral;
        row[CS_MARGINAL_DENSITY] = (cs_f32)(share / width);
        integral += width * (cdf + 0.5 * share);
        cdf += share;
        mean += share * middle;
        square += share * (middle * middle + width * width / 12.0);
    }
    return square - mean * mean;
}

clshear_status cs_aperture_image_check(const cs_aperture_image *image, cs_error *error)
{
    double sum = 0.0;
    if (image == NULL || image->luminance == NULL)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "an image aperture needs an image");
    if (image->width < 1 || image->height < 1 || image->width > MOST_TEXELS ||
        image->height > MOST_TEXELS)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "aperture image of %d x %d: each side must be 1 to %d", image->width,
                       image->height, MOST_TEXELS);
    for (int i = 0; i < image->width * image->height; i++) {
        if (!(image->luminance[i] >= 0.0f) || !isfinite(image->luminance[i]))
            return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                           "aperture image: luminance %g at %d,%d: must be 0 or more",
                           (double)image->luminance[i], i % image->width, i / image->width);
        sum += (double)image->luminance[i];
    }
    if (!(sum > 0.0)) return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "aperture image: all black");
    return CLSHEAR_OK;
}

clshear_status cs_aperture_image_make(const cs_view *camera, cs_optics_tables *tables,
                                      cs_error *error)
{
    const cs_aperture_image *image = camera->image;
    cs_optics *optics = &tables->optics;
    float columns[MOST_TEXELS] = {0};
    clshear_status status = cs_aperture_image_check(image, error);
    if (status != CLSHEAR_OK) return status;
    const cs_u32 width = (cs_u32)image->width, height = (cs_u32)image->height;
    const double longer = width > height ? width : height;
    const double half_width[2] = {0.5 * width / longer, 0.5 * height / longer};
    const size_t rows = width + 1 + (size_t)width * (height + 1);
    cs_f32 *row = cs_array_extend(&tables->table, rows * CS_MARGINAL_COLUMNS);
    if (row == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    double most = 0.0;
    for (cs_u32 i = 0; i < width * height; i++)
        most = fmax(most, (double)image->luminance[i]);
    for (cs_u32 i = 0; i < width; i++)
        columns[i] =
            (float)(strip_sum(&(strip){image->luminance + i, width, height, half_width[1]}) / most);
    double variance[2] = {fill_rows(&(strip){columns, 1, width, half_width[0]}, row), 0.0};
    row += (size_t)(width + 1) * CS_MARGINAL_COLUMNS;
    for (cs_u32 i = 0; i < width; i++) {
        variance[1] +=
            fill_rows(&(strip){image->luminance + i, width, height, half_width[1]}, row) / width;
        row += (size_t)(height + 1) * CS_MARGINAL_COLUMNS;
    }
    optics->marginal = CS_MARGINAL_IMAGE;
    optics->segments[0] = width;
    optics->segments[1] = height;
    for (int axis = 0; axis < 2; axis++) {
        optics->half_width[axis] = (cs_f32)half_width[axis];
        optics->deviation[axis] = (cs_f32)sqrt(variance[axis]);
    }
    return CLSHEAR_OK;
}

clshear_status cs_aperture_image_read(const char *path, cs_aperture_image *image, cs_error *error)
{
    return cs_image_read_luminance(path, MOST_TEXELS, &image->luminance, &image->width,
                                   &image->height, error);
}

clshear_status cs_aperture_image_copy(const cs_aperture_image *from, cs_aperture_image *to,
                                      cs_error *error)
{
    const size_t size = (size_t)from->width * (size_t)from->height * sizeof *from->luminance;
    float *luminance = malloc(size);
    if (luminance == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    memcpy(luminance, from->luminance, size);
    *to = (cs_aperture_image){luminance, from->width, from->height};
    return CLSHEAR_OK;
}

void cs_aperture_image_free(cs_aperture_image *image)
{
    free(image->luminance);
    *image = (cs_aperture_image){0};
}
