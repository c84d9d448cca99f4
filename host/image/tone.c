#include "image/tone.h"

#include <math.h>

#include "clshear/clshear.h"
#include "kernels/vector.h"

float cs_tone_auto_scale(const float *const *planes, size_t count)
{
    double sum = 0.0;
    size_t lit = 0;
    for (size_t i = 0; i < count; i++) {
        const float colour[3] = {planes[0][i], planes[1][i], planes[2][i]};
        const float luminance = cs_luminance(colour);
        if (!(luminance > 0.0f) || !isfinite(luminance)) continue;
        sum += log((double)luminance);
        lit++;
    }
    return lit > 0 ? (float)(0.18 / exp(sum / (double)lit)) : 1.0f;
}

static float hable(float x)
{
    const float a = 0.15f, b = 0.50f, c = 0.10f, d = 0.20f, e = 0.02f, f = 0.30f;
    return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
}

float cs_tone_filmic(float value)
{
    if (!(value > 0.0f)) return 0.0f;
    if (value > 5.6f) return 1.0f; /* doubled: the white */
    return hable(2.0f * value) / hable(11.2f);
}

/* Inset of the working primaries: towards white, so that bright saturated colours become paler
 * instead of being cut. */
static const float agx_inset[3][3] = {{0.842479062f, 0.0784335999f, 0.0792237451f},
                                      {0.0423282423f, 0.878468636f, 0.0791661275f},
                                      {0.0423756550f, 0.0784336000f, 0.879142974f}};
static const float agx_grey = 0.18f;
static const float agx_stops[2] = {-10.0f, 6.5f}; /* around grey, taken to 0 and 1 */
static const float agx_middle = 0.5f;             /* what grey becomes */
static const float agx_slope = 2.0f;              /* there */
static const float agx_powers[2] = {3.0f, 3.25f}; /* of toe and shoulder */

/* One half of the curve, from the grey outwards, away from its place by `from`: a hyperbola with
 * the slope at its start that reaches `end_y` at `end`. */
static float agx_half(float from, float end, float end_y, float power)
{
    const float scale =
        powf((powf(agx_slope * end / end_y, power) - 1.0f) / powf(agx_slope * end, power),
             -1.0f / power);
    const float x = agx_slope * from / scale;
    return scale * x / powf(1.0f + powf(x, power), 1.0f / power);
}

float cs_tone_agx_curve(float place)
{
    const float grey = agx_stops[0] / (agx_stops[0] - agx_stops[1]);
    if (place <= grey) return agx_middle - agx_half(grey - place, grey, agx_middle, agx_powers[0]);
    return agx_middle + agx_half(place - grey, 1.0f - grey, 1.0f - agx_middle, agx_powers[1]);
}

/* Inverse of the sRGB curve, IEC 61966-2-1. */
static float from_srgb(float value)
{
    return value <= 0.04045f ? value / 12.92f : powf((value + 0.055f) / 1.055f, 2.4f);
}

void cs_tone_agx(float *rgb)
{
    float inset[3] = {0.0f, 0.0f, 0.0f};
    for (int row = 0; row < 3; row++)
        for (int c = 0; c < 3; c++)
            inset[row] += agx_inset[row][c] * fmaxf(rgb[c], 0.0f);
    for (int c = 0; c < 3; c++) {
        const float stops = log2f(fmaxf(inset[c], 1e-10f) / agx_grey);
        const float place = (stops - agx_stops[0]) / (agx_stops[1] - agx_stops[0]);
        rgb[c] = from_srgb(fmaxf(cs_tone_agx_curve(fmaxf(0.0f, fminf(1.0f, place))), 0.0f));
    }
}

float cs_tone_scale(const cs_tone *tone, const float *const *planes, size_t count)
{
    return exp2f(tone->exposure) * (tone->is_auto ? cs_tone_auto_scale(planes, count) : 1.0f);
}

void cs_tone_apply(const cs_tone *tone, float scale, float *pixels, size_t count)
{
    for (size_t i = 0; i < 3 * count; i++) {
        pixels[i] *= scale;
        if (tone->curve == CLSHEAR_TONE_FILMIC) pixels[i] = cs_tone_filmic(pixels[i]);
    }
    for (size_t i = 0; i < count && tone->curve == CLSHEAR_TONE_AGX; i++)
        cs_tone_agx(pixels + 3 * i);
}
