/* A square and a box in time: the exact map of two numbers to their fibre, and of a third to the
 * place on it. */
#ifndef CLSHEAR_DEVICE_TIMED_PLACE_H
#define CLSHEAR_DEVICE_TIMED_PLACE_H

#include "boxes.h"
#include "camera_sample.h"

#include "fp_contract_off.h"

/* A place on a shape of area 1 around the origin, and a time. */
typedef struct cs_timed_place {
    cs_vfloat x;
    cs_vfloat y;
    cs_vfloat time; /* in [0, 1] */
} cs_timed_place;

/* The map of a square: x and y are in [-1/2, 1/2]. The fibre is x + rate_x * time, y + rate_y *
 * time; `across` and `beside` choose it, `along` the time on it, all three in [0, 1). rate_x: above
 * 0, the larger; rate_y: 0 or more. */
static inline cs_timed_place cs_square_and_time(cs_vfloat across, cs_vfloat beside, cs_vfloat along,
                                                cs_f32 rate_x, cs_f32 rate_y)
{
    cs_vfloat zero = (cs_vfloat)(0.0f), one = (cs_vfloat)(1.0f), rate = (cs_vfloat)(rate_x);
    cs_vfloat t = cs_two_boxes_quantile(cs_two_boxes_of(one, rate), across);
    cs_vfloat low = cs_clamp((t - 1.0f) / rate, zero, one);
    cs_vfloat high = cs_clamp(t / rate, low, one);
    cs_vfloat left = cs_max(rate_y * (high - low), (cs_vfloat)(1e-6f));
    cs_vfloat other = cs_two_boxes_quantile(cs_two_boxes_of(one, left), beside);
    cs_vfloat first = cs_clamp((other - 1.0f) / left, zero, one);
    cs_vfloat last = cs_clamp(other / left, first, one);
    cs_vfloat part = first + (last - first) * along;
    cs_timed_place place;
    place.time = low + (high - low) * part;
    place.x = cs_clamp(t - rate * place.time, zero, one) - 0.5f;
    place.y = cs_clamp(other - left * part, zero, one) - 0.5f;
    return place;
}

#include "fp_contract_restore.h"

#endif
