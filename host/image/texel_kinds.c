#include "image/texel_kinds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/vector.h"

float cs_roughness_of_exponent(float exponent)
{
    return powf(2.0f / (fmaxf(exponent, 0.0f) + 2.0f), 0.25f);
}

static void take_opacity(float *rgba, size_t count)
{
    int varies = 0;
    for (size_t i = 0; i < count; i++)
        varies |= rgba[4 * i + 3] != 1.0f;
    for (size_t i = 0; i < count; i++)
        if (!varies) rgba[4 * i + 3] = cs_luminance(rgba + 4 * i);
}

static void take_gloss(float *rgba, size_t count)
{
    for (size_t i = 0; i < count; i++)
        rgba[4 * i] = rgba[4 * i + 1] = rgba[4 * i + 2] =
            cs_roughness_of_exponent(cs_luminance(rgba + 4 * i));
}

/* Exporters name normal maps as bump maps. Such a map is bluish, and its mean is straight up. */
static int are_normals(const float *rgba, size_t count)
{
    double mean[3] = {0, 0, 0};
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < 3; c++)
            mean[c] += (double)rgba[4 * i + (size_t)c] / (double)count;
    return mean[2] > 0.7 && fabs(mean[0] - 0.5) < 0.15 && fabs(mean[1] - 0.5) < 0.15;
}

/* Slopes by central differences, as if the image repeats; a height of 1 is as high as a texel is
 * wide. */
static int take_heights(float *rgba, size_t width, size_t height)
{
    float *heights = calloc(width * height + 1, sizeof *heights);
    if (heights == NULL) return 0;
    for (size_t i = 0; i < width * height; i++)
        heights[i] = cs_luminance(rgba + 4 * i);
    for (size_t y = 0; y < height; y++) {
        const float *row = heights + y * width;
        const float *above = heights + (y + height - 1) % height * width;
        const float *below = heights + (y + 1) % height * width;
        for (size_t x = 0; x < width; x++) {
            const float across = 0.5f * (row[(x + 1) % width] - row[(x + width - 1) % width]);
            const float up = 0.5f * (above[x] - below[x]);
            const float scale = 0.5f / sqrtf(1.0f + across * across + up * up);
            float *normal = rgba + 4 * (y * width + x);
            normal[0] = 0.5f - scale * across;
            normal[1] = 0.5f - scale * up;
            normal[2] = 0.5f + scale;
        }
    }
    free(heights);
    return 1;
}

int cs_texels_convert(cs_texel_kind kind, float *rgba, size_t width, size_t height)
{
    if (kind == CS_TEXELS_OPACITY) take_opacity(rgba, width * height);
    if (kind == CS_TEXELS_GLOSS) take_gloss(rgba, width * height);
    if (kind == CS_TEXELS_BUMPS && !are_normals(rgba, width * height))
        return take_heights(rgba, width, height);
    return 1;
}
