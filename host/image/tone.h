/* From linear radiance to values that a screen shows, before the sRGB curve. */
#ifndef CS_IMAGE_TONE_H
#define CS_IMAGE_TONE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* How a picture of 8 or 16 bits is made from linear values. All zero: as they are. */
typedef struct cs_tone {
    float exposure; /* stops: values are multiplied by 2^exposure */
    int is_auto;    /* 1: first scaled by cs_tone_auto_scale */
    int curve;      /* a choice of CLSHEAR_TONE_LIST */
} cs_tone;

/* 0.18 / the log-average of luminance (Reinhard, Stark, Shirley and Ferwerda, Photographic Tone
 * Reproduction for Digital Images, 2002, equations 1 and 2), here over the pixels that have any
 * light, so that a black background does not count. 1 where no pixel has. `planes` are red, green
 * and blue, linear Rec.709, of `count` pixels. */
float cs_tone_auto_scale(const float *const *planes, size_t count);

/* By what `tone` multiplies values before the curve: 2^exposure, times cs_tone_auto_scale if it
 * asks for that. */
float cs_tone_scale(const cs_tone *tone, const float *const *planes, size_t count);

/* Hable's curve (Filmic Tonemapping for Real-time Rendering, SIGGRAPH 2010 course), which takes
 * 0 to 0 and the linear white of 11.2 to 1; the value is doubled before, as there. */
float cs_tone_filmic(float value);

/* AgX, the base image of Troy Sobotka's OpenColorIO configuration (github.com/sobotka/AgX, 2022),
 * of three linear Rec.709 values: inset of the primaries, log2 encoding from 10 stops below grey
 * to 6.5 above, the sigmoid. What that gives is meant for an sRGB screen, and is made linear here
 * so that the sRGB curve that follows brings it back. */
void cs_tone_agx(float *rgb);

/* Its sigmoid, of a place in the log2 encoding, 0 to 1: from 0 to 1, with 0.5 and slope 2 at grey.
 */
float cs_tone_agx_curve(float place);

/* Multiplies three linear values for each of `count` pixels by `scale`, and applies the curve of
 * `tone`. */
void cs_tone_apply(const cs_tone *tone, float scale, float *pixels, size_t count);

#ifdef __cplusplus
}
#endif

#endif
