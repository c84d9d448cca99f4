/* Sums of two and of three independent uniform variables: distribution, quantile, conditionals.
 *
 * A box of width w is a variable that is uniform on [0, w]. The sum of two has a trapezoid as its
 * density, that of three a piecewise parabola. All widths must be above 0 and may differ from lane
 * to lane. */
#ifndef CLSHEAR_DEVICE_BOXES_H
#define CLSHEAR_DEVICE_BOXES_H

#include "packet.h"

#include "fp_contract_off.h"

/* Widths of two boxes. */
typedef struct cs_two_boxes {
    cs_vfloat narrow;
    cs_vfloat wide;
} cs_two_boxes;

static inline cs_two_boxes cs_two_boxes_of(cs_vfloat a, cs_vfloat b)
{
    cs_two_boxes boxes;
    boxes.narrow = cs_min(a, b);
    boxes.wide = cs_max(a, b);
    return boxes;
}

/* Probability that the sum of two boxes is below `sum`, any number. */
static inline cs_vfloat cs_two_boxes_below(cs_two_boxes boxes, cs_vfloat sum)
{
    cs_vfloat most = boxes.narrow + boxes.wide;
    cs_vfloat inside = cs_clamp(sum, (cs_vfloat)(0.0f), most);
    cs_vfloat tail = cs_min(inside, most - inside);
    cs_vfloat rising = 0.5f * tail * tail / (boxes.narrow * boxes.wide);
    cs_vfloat flat = (tail - 0.5f * boxes.narrow) / boxes.wide;
    cs_vfloat mass = tail < boxes.narrow ? rising : flat;
    return inside + inside > most ? 1.0f - mass : mass;
}

/* The sum of two boxes with probability `mass`, in [0, 1], below it. */
static inline cs_vfloat cs_two_boxes_quantile(cs_two_boxes boxes, cs_vfloat mass)
{
    cs_vfloat tail = cs_min(mass, 1.0f - mass);
    cs_vfloat ramp = 0.5f * boxes.narrow / boxes.wide;
    cs_vfloat rising = cs_sqrt(2.0f * boxes.narrow * boxes.wide * tail);
    cs_vfloat flat = boxes.narrow + (tail - ramp) * boxes.wide;
    cs_vfloat sum = tail < ramp ? rising : flat;
    return mass > 0.5f ? boxes.narrow + boxes.wide - sum : sum;
}

/* The sum of three boxes of widths a, b, c with probability `mass`, in [0, 1], below it.
 *
 * In the lower half the density is t^2 / 2V, then as if the narrowest box were a point, then a
 * parabola, then flat (V: product of the widths). The first two and the last are inverted in closed
 * form; on the parabola two of Halley's steps leave errors of the mass below 3e-6. */
static inline cs_vfloat cs_three_boxes_quantile(cs_vfloat a, cs_vfloat b, cs_vfloat c,
                                                cs_vfloat mass)
{
    cs_vfloat first = cs_min(a, b), last = cs_max(a, b);
    cs_vfloat narrow = cs_min(first, c), wide = cs_max(last, c);
    cs_vfloat middle = cs_max(first, cs_min(last, c));
    cs_vfloat tail = cs_min(mass, 1.0f - mass);
    cs_vfloat area = middle * wide, square = narrow * narrow;
    cs_vfloat cubic = cs_cbrt(6.0f * narrow * area * tail);
    cs_vfloat root =
        cs_sqrt(cs_max(2.0f * area * tail - square * (1.0f / 12.0f), (cs_vfloat)(0.0f)));
    cs_vfloat linear = 0.5f * narrow + root;
    cs_vfloat flat = 0.5f * (narrow + middle) + wide * tail;
    /* The parabola, times 6 * area; terms in (t - middle) and (t - wide) stay small. */
    cs_vfloat end = cs_min(narrow + middle, 0.5f * (narrow + middle + wide));
    cs_vfloat t = cs_clamp(linear, middle, end);
    cs_vfloat inverse = 1.0f / narrow;
    for (int step = 0; step < 2; step++) {
        cs_vfloat h = t - middle, k = cs_max(t - wide, (cs_vfloat)(0.0f));
        cs_vfloat hh = h * h * inverse, kk = k * k * inverse;
        cs_vfloat value = 3.0f * t * (t - narrow) + square - (h * hh + k * kk) - 6.0f * area * tail;
        cs_vfloat slope = 6.0f * t - 3.0f * (narrow + hh + kk);
        cs_vfloat bend = 6.0f - 6.0f * (h + k) * inverse;
        t = t - 2.0f * value * slope / (2.0f * slope * slope - value * bend);
        t = cs_clamp(t, middle, end);
    }
    cs_vfloat sum = 6.0f * area * tail < square ? cubic : linear;
    sum = linear > middle ? t : sum;
    cs_vint has_flat = narrow + middle < wide;
    sum = (has_flat & (2.0f * wide * tail > narrow + middle)) ? flat : sum;
    return mass > 0.5f ? narrow + middle + wide - sum : sum;
}

/* A box of width `width`, as a part of that width in [0, 1], given that its sum with two others is
 * `sum`. `along`, in [0, 1), picks it. */
static inline cs_vfloat cs_box_given(cs_vfloat sum, cs_vfloat width, cs_two_boxes others,
                                     cs_vfloat along)
{
    cs_vfloat most = width + others.narrow + others.wide;
    cs_vint upper = sum + sum > most; /* mirrored: small masses keep their digits */
    cs_vfloat t = upper ? most - sum : sum;
    cs_vfloat high = cs_two_boxes_below(others, t);
    cs_vfloat low = cs_two_boxes_below(others, t - width);
    cs_vfloat eta = upper ? 1.0f - along : along;
    cs_vfloat rest = cs_two_boxes_quantile(others, high - eta * (high - low));
    cs_vfloat part = cs_clamp((t - rest) / width, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
    return upper ? 1.0f - part : part;
}

#include "fp_contract_restore.h"

#endif
