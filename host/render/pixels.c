#include "render/pixels.h"

#include <stdlib.h>

#include "kernels/aov.h"

enum {
    BAND = 8 /* rows of a tile, as in cs_tiled_pixel */
};

size_t cs_page_pixels(const clshear_context *context, cs_u32 width)
{
    const size_t sums = CS_PLANES * sizeof(cs_exact_sum); /* with or without, for one cut */
    const size_t most = sums > sizeof(cs_pixel) ? sums : sizeof(cs_pixel);
    const size_t band = (size_t)BAND * width, bands = context->page_bytes / (band * most);
    return band * (bands > 0 ? bands : 1);
}

static size_t pixels_of_page(const cs_pixels *pixels, size_t page)
{
    const size_t left = pixels->count - page * pixels->page_pixels;
    return left < pixels->page_pixels ? left : pixels->page_pixels;
}

/* A buffer of zeros for each page. */
static clshear_status create_pages(cs_device *device, const cs_pixels *pixels, size_t item,
                                   cs_buffer ***pages, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    *pages = calloc(pixels->page_count, sizeof(cs_buffer *));
    CS_REQUIRE(*pages != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu pixels",
               pixels->count);
    for (size_t page = 0; page < pixels->page_count; page++)
        CS_TRY(cs_buffer_create(device, pixels_of_page(pixels, page) * item, NULL, &(*pages)[page],
                                error));
done:
    return status;
}

size_t cs_pixel_bytes(size_t planes)
{
    return sizeof(cs_pixel) + planes * sizeof(cs_exact_sum);
}

clshear_status cs_pixels_create(clshear_context *context, size_t count, cs_u32 width, size_t planes,
                                cs_pixels *pixels, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    pixels->count = count;
    pixels->page_pixels = cs_page_pixels(context, width);
    pixels->page_count = (count + pixels->page_pixels - 1) / pixels->page_pixels;
    pixels->planes = planes;
    CS_TRY(create_pages(context->device, pixels, sizeof(cs_pixel), &pixels->pages, error));
    if (planes > 0)
        CS_TRY(create_pages(context->device, pixels, planes * sizeof(cs_exact_sum), &pixels->aovs,
                            error));
done:
    return status;
}

static void free_pages(cs_buffer **pages, size_t count)
{
    for (size_t page = 0; pages != NULL && page < count; page++)
        cs_buffer_free(pages[page]);
    free(pages);
}

void cs_pixels_free(cs_pixels *pixels)
{
    free_pages(pixels->pages, pixels->page_count);
    free_pages(pixels->aovs, pixels->page_count);
    *pixels = (cs_pixels){0};
}

void cs_pixels_release(cs_pixels *pixels, size_t end)
{
    const size_t count = end == pixels->count ? pixels->page_count : end / pixels->page_pixels;
    for (size_t page = 0; page < count; page++) {
        cs_buffer_free(pixels->pages[page]);
        pixels->pages[page] = NULL;
    }
}

/* The part of pixels `first` ... that lies in the page of the first: how many, and where in it. */
static size_t part_in_page(const cs_pixels *pixels, size_t first, size_t count, size_t *page,
                           size_t *place)
{
    *page = first / pixels->page_pixels;
    *place = first % pixels->page_pixels;
    const size_t left = pixels_of_page(pixels, *page) - *place;
    return count < left ? count : left;
}

/* What is moved: `item` bytes of each pixel, from `from` to the device, or to `to`. */
typedef struct traffic {
    cs_buffer **pages;
    size_t item;
    char *to;
    const char *from; /* NULL: to the host */
} traffic;

/* Moves pixels `first` ... page by page. */
static clshear_status transfer(const cs_pixels *pixels, size_t first, size_t count,
                               const traffic *move, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    for (size_t at = 0, part, page, place; at < count; at += part) {
        part = part_in_page(pixels, first + at, count - at, &page, &place);
        cs_buffer *buffer = move->pages[page];
        const size_t size = part * move->item, offset = place * move->item;
        if (move->from != NULL)
            CS_TRY(cs_buffer_write(buffer, offset, size, move->from + at * move->item, error));
        else
            CS_TRY(cs_buffer_read(buffer, offset, size, move->to + at * move->item, error));
    }
done:
    return status;
}

clshear_status cs_pixels_read(const cs_pixels *pixels, size_t first, size_t count, cs_pixel *values,
                              cs_error *error)
{
    const traffic move = {pixels->pages, sizeof *values, (char *)values, NULL};
    return transfer(pixels, first, count, &move, error);
}

clshear_status cs_pixels_write(cs_pixels *pixels, size_t first, size_t count,
                               const cs_pixel *values, cs_error *error)
{
    const traffic move = {pixels->pages, sizeof *values, NULL, (const char *)values};
    return transfer(pixels, first, count, &move, error);
}

clshear_status cs_pixels_read_aovs(const cs_pixels *pixels, size_t first, size_t count,
                                   cs_exact_sum *values, cs_error *error)
{
    const traffic move = {pixels->aovs, pixels->planes * sizeof *values, (char *)values, NULL};
    return transfer(pixels, first, count, &move, error);
}

clshear_status cs_pixels_write_aovs(cs_pixels *pixels, size_t first, size_t count,
                                    const cs_exact_sum *values, cs_error *error)
{
    const traffic move = {pixels->aovs, pixels->planes * sizeof *values, NULL,
                          (const char *)values};
    return transfer(pixels, first, count, &move, error);
}
