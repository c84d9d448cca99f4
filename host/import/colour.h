/* Colours of vertices as files have them. */
#ifndef CS_IMPORT_COLOUR_H
#define CS_IMPORT_COLOUR_H

#include <math.h>

/* A linear value, 0 or more; `encoded`: from one on the sRGB curve, as bytes of a display are. */
static inline float cs_colour_value(double value, int encoded)
{
    if (!(value > 0.0) || !isfinite(value)) return 0.0f;
    if (!encoded || value > 1.0) return (float)fmin(value, 1e15);
    return (float)(value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4));
}

#endif
