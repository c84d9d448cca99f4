/* What the pixels of a window have gathered, on the device: in pages, since a device's largest
 * buffer may be smaller than a large image needs. */
#ifndef CS_RENDER_PIXELS_H
#define CS_RENDER_PIXELS_H

#include "clshear/device/stats.h"
#include "kernels/pixel.h"
#include "render/objects.h"

enum {
    CS_PIXEL_SLICE = 1 << 16,    /* pixels on their way between device and host at once */
    CS_AOV_PIXEL_SLICE = 1 << 14 /* where their sums of planes are with them */
};

/* Pages are whole bands of tiles, so that a walk through tiles (cs_tiled_pixel) does not come back
 * to one. Start from zeros. */
typedef struct cs_pixels {
    cs_buffer **pages; /* cs_pixel */
    cs_buffer **aovs;  /* of the same pixels: `planes` cs_exact_sum each; NULL: none */
    size_t planes;
    size_t page_count;
    size_t page_pixels; /* of all pages but the last */
    size_t count;
} cs_pixels;

/* The sum as one number. */
static inline double cs_exact_total(cs_exact_sum sum)
{
    return (double)sum.sum + (double)sum.carry;
}

/* Pixels in a page of a window of this width. */
size_t cs_page_pixels(const clshear_context *context, cs_u32 width);

/* Bytes of a pixel on the device, with sums of some planes of AOVs. */
size_t cs_pixel_bytes(size_t planes);

/* `count` pixels of a window, all zero, with sums of some planes of AOVs. */
clshear_status cs_pixels_create(clshear_context *context, size_t count, cs_u32 width, size_t planes,
                                cs_pixels *pixels, cs_error *error);

/* Gives back the memory of the pages that end before pixel `end`, or with it. Their pixels must not
 * be read or written any more. */
void cs_pixels_release(cs_pixels *pixels, size_t end);

void cs_pixels_free(cs_pixels *pixels);

/* Pixels `first` ... `first` + `count` - 1, row by row. */
clshear_status cs_pixels_read(const cs_pixels *pixels, size_t first, size_t count, cs_pixel *values,
                              cs_error *error);
clshear_status cs_pixels_write(cs_pixels *pixels, size_t first, size_t count,
                               const cs_pixel *values, cs_error *error);

/* The same for their sums of planes. */
clshear_status cs_pixels_read_aovs(const cs_pixels *pixels, size_t first, size_t count,
                                   cs_exact_sum *values, cs_error *error);
clshear_status cs_pixels_write_aovs(cs_pixels *pixels, size_t first, size_t count,
                                    const cs_exact_sum *values, cs_error *error);

#endif
