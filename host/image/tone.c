#include "image/tone.h"

#include <math.h>

#include "clshear/clshear.h"

float cs_tone_auto_scale(const float *pixels, size_t count)
{
    double sum = 0.0;
    size_t lit = 0;
    for (size_t i = 0; i < count; i++) {
        const float *rgb = pixels + 3 * i;
        const float luminance = 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
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

void cs_tone_apply(const cs_tone *tone, float *pixels, size_t count)
{
    const float scale =
        exp2f(tone->exposure) * (tone->is_auto ? cs_tone_auto_scale(pixels, count) : 1.0f);
    for (size_t i = 0; i < 3 * count; i++) {
        pixels[i] *= scale;
        if (tone->curve == CLSHEAR_TONE_FILMIC) pixels[i] = cs_tone_filmic(pixels[i]);
    }
}
