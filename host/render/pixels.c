#include "render/pixels.h"

#include <stdlib.h>

enum {
    BAND = 8 /* rows of a tile, as in cs_tiled_pixel */
};

size_t cs_page_pixels(const clshear_context *context, cs_u32 width)
{
    const size_t band = (size_t)BAND * width,
                 bands = context->page_bytes / (band * sizeof(cs_pixel));
    return band * (bands > 0 ? bands : 1);
}

static size_t pixels_of_page(const cs_pixels *pixels, size_t page)
{
    const size_t left = pixels->count - page * pixels->page_pixels;
    return left < pixels->page_pixels ? left : pixels->page_pixels;
}

clshear_status cs_pixels_create(clshear_context *context, size_t count, cs_u32 width,
                                cs_pixels *pixels, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    pixels->count = count;
    pixels->page_pixels = cs_page_pixels(context, width);
    pixels->page_count = (count + pixels->page_pixels - 1) / pixels->page_pixels;
    pixels->pages = calloc(pixels->page_count, sizeof(cs_buffer *));
    CS_REQUIRE(pixels->pages != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu pixels", count);
    for (size_t page = 0; page < pixels->page_count; page++)
        CS_TRY(cs_buffer_create(context->device, pixels_of_page(pixels, page) * sizeof(cs_pixel),
                                NULL, &pixels->pages[page], error));
done:
    return status;
}

void cs_pixels_free(cs_pixels *pixels)
{
    for (size_t page = 0; pixels->pages != NULL && page < pixels->page_count; page++)
        cs_buffer_free(pixels->pages[page]);
    free(pixels->pages);
    *pixels = (cs_pixels){0};
}

/* The part of pixels `first` ... that lies in the page of the first: how many, and where in it. */
static size_t part_in_page(const cs_pixels *pixels, size_t first, size_t count, size_t *page,
                           size_t *offset)
{
    *page = first / pixels->page_pixels;
    const size_t place = first % pixels->page_pixels, left = pixels_of_page(pixels, *page) - place;
    *offset = place * sizeof(cs_pixel);
    return count < left ? count : left;
}

/* Reads into `values`, or writes from `given` where that is not NULL, page by page. */
static clshear_status transfer(const cs_pixels *pixels, size_t first, size_t count,
                               cs_pixel *values, const cs_pixel *given, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    for (size_t at = 0, part, page, offset; at < count; at += part) {
        part = part_in_page(pixels, first + at, count - at, &page, &offset);
        cs_buffer *buffer = pixels->pages[page];
        const size_t size = part * sizeof(cs_pixel);
        if (given != NULL)
            CS_TRY(cs_buffer_write(buffer, offset, size, given + at, error));
        else
            CS_TRY(cs_buffer_read(buffer, offset, size, values + at, error));
    }
done:
    return status;
}

clshear_status cs_pixels_read(const cs_pixels *pixels, size_t first, size_t count, cs_pixel *values,
                              cs_error *error)
{
    return transfer(pixels, first, count, values, NULL, error);
}

clshear_status cs_pixels_write(cs_pixels *pixels, size_t first, size_t count,
                               const cs_pixel *values, cs_error *error)
{
    return transfer(pixels, first, count, NULL, values, error);
}
