#include "oracle/certain.h"

#include <stdlib.h>

/* First and last of `count` places within `reach` of the middle of place `at`. */
typedef struct span {
    size_t first, last;
} span;

static span span_of(int at, cs_f32 reach_px, int count)
{
    const int steps = reach_px < (cs_f32)count ? (int)reach_px : count;
    return (span){at > steps ? (size_t)(at - steps) : 0,
                  at + steps < count ? (size_t)(at + steps) : (size_t)(count - 1)};
}

/* Adds 1 to a rectangle, where `corners` is summed along rows and then along columns. */
static void cover(int32_t *corners, size_t stride, span x, span y)
{
    corners[y.first * stride + x.first]++;
    corners[y.first * stride + x.last + 1]--;
    corners[(y.last + 1) * stride + x.first]--;
    corners[(y.last + 1) * stride + x.last + 1]++;
}

clshear_status cs_mark_certain(const cs_f32 *reach_px, int width, int height, uint8_t *certain,
                               cs_error *error)
{
    const size_t stride = (size_t)width + 1, size = stride * ((size_t)height + 1);
    int32_t *covers = calloc(size, sizeof *covers);
    if (covers == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for %d x %d pixels", width,
                       height);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const cs_f32 reach = reach_px[(size_t)y * (size_t)width + (size_t)x];
            if (reach >= 0.0f)
                cover(covers, stride, span_of(x, reach, width), span_of(y, reach, height));
        }
    for (size_t i = 1; i < size; i++)
        if (i % stride != 0) covers[i] += covers[i - 1];
    for (size_t i = stride; i < size; i++)
        covers[i] += covers[i - stride];
    for (size_t i = 0; i < (size_t)width * (size_t)height; i++)
        certain[i] = covers[i / (size_t)width * stride + i % (size_t)width] == 0;
    free(covers);
    return CLSHEAR_OK;
}
