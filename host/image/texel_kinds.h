/* What the texels of an image stand for, and their conversion to what the device reads. */
#ifndef CS_IMAGE_TEXEL_KINDS_H
#define CS_IMAGE_TEXEL_KINDS_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The largest number that a half holds. */
#define CS_LARGEST_HALF 65504.0f

typedef enum cs_texel_kind {
    CS_TEXELS_COLOUR,  /* on the curve that the file says, or sRGB's; becomes linear */
    CS_TEXELS_DATA,    /* numbers as they are */
    CS_TEXELS_OPACITY, /* becomes alpha: that of the image where it varies, otherwise its grey */
    CS_TEXELS_GLOSS,   /* exponents of Blinn's highlight; become roughnesses */
    CS_TEXELS_BUMPS    /* heights, or normals if they look so; become a normal map */
} cs_texel_kind;

/* How an image is read. */
typedef struct cs_texel_use {
    cs_texel_kind kind;
    float base; /* colours and numbers, not alpha, are base + gain * those of the file */
    float gain;
    int is_srgb; /* colours of integers are on sRGB's curve, whatever the file says of it */
} cs_texel_use;

/* The roughness whose facets give Blinn's highlight of an exponent: its square is the width
 * sqrt(2 / (exponent + 2)) (Walter et al. 2007, section 5.2). */
float cs_roughness_of_exponent(float exponent);

/* Converts texels (4 floats each, rows from the top) in place. Returns 0 without memory. */
int cs_texels_convert(cs_texel_kind kind, float *rgba, size_t width, size_t height);

#ifdef __cplusplus
}
#endif

#endif
