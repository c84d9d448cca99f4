/* Angles and powers for packets, the same in both languages. Shared.
 *
 * Polynomials of Moshier's Cephes library for floats. Drivers' functions take their time for
 * arguments of any size, and some compute lane by lane. */
#ifndef CS_KERNELS_TRIGONOMETRY_H
#define CS_KERNELS_TRIGONOMETRY_H

#include "clshear/device/packet.h"

#ifdef CS_DEVICE
#define cs_power(x, y) pow(x, y)
#else
#define cs_power(x, y) powf(x, y)
#endif

/* Sine and cosine of angles from -2 pi to 2 pi; absolute error 1e-7, and relative to small sines.
 */
static inline void cs_sine_cosine(cs_vfloat angle, cs_vfloat *sine, cs_vfloat *cosine)
{
    cs_vfloat quarter = cs_floor(angle * (2.0f * CS_INVERSE_PI) + 0.5f);
    /* pi / 2 in three parts, of which the products with small integers are exact. */
    cs_vfloat rest = angle - quarter * 1.5703125f;
    rest = rest - quarter * 4.83751296997e-4f;
    rest = rest - quarter * 7.5497899549e-8f;
    cs_vfloat square = rest * rest;
    cs_vfloat odd = ((-1.9515295891e-4f * square + 8.3321608736e-3f) * square - 1.6666654611e-1f);
    odd = rest + rest * square * odd;
    cs_vfloat even =
        ((2.443315711809948e-5f * square - 1.388731625493765e-3f) * square + 4.166664568298827e-2f);
    even = (1.0f - 0.5f * square) + square * square * even;
    cs_vint turns = cs_as_vint(cs_to_vuint(quarter + 4.0f));
    cs_vint swapped = (turns & 1) != 0;
    cs_vfloat s = swapped ? even : odd, c = swapped ? odd : even;
    *sine = (turns & 2) != 0 ? -s : s;
    *cosine = ((turns + 1) & 2) != 0 ? -c : c;
}

/* The angle from (1, 0) to (x, y), -pi to pi; relative error 3e-7. 0 for (0, 0). */
static inline cs_vfloat cs_angle_to(cs_vfloat y, cs_vfloat x)
{
    cs_vfloat rise = cs_abs(y), run = cs_abs(x);
    cs_vfloat low = cs_min(rise, run), high = cs_max(cs_max(rise, run), (cs_vfloat)(1e-37f));
    /* Beyond tan(pi / 8), from the diagonal. */
    cs_vint far = low > 0.414213562f * high;
    cs_vfloat slope = (far ? low - high : low) / (far ? low + high : high);
    cs_vfloat square = slope * slope;
    cs_vfloat rest =
        ((8.05374449538e-2f * square - 1.38776856032e-1f) * square + 1.99777106478e-1f) * square -
        3.33329491539e-1f;
    cs_vfloat angle = slope + slope * square * rest;
    angle = far ? angle + 0.25f * CS_PI : angle;
    angle = rise > run ? 0.5f * CS_PI - angle : angle;
    angle = x < 0.0f ? CS_PI - angle : angle;
    return y < 0.0f ? -angle : angle;
}

#endif
