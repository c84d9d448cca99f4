/* The chain: the shear of lens and time for a square lens, or for none, and a box filter one pixel
 * wide.
 *
 * Along an axis of the film, pixel, lens and time are three boxes, and their sum is the fibre. The
 * x axis draws its fibre and leaves an interval of times, the y axis draws its own from the motion
 * in that interval. Without a lens it is exact; with one for motion along an axis, and else the
 * fibre's y leaks by at most min(1, |s|) |v_y / v_x| pixels. */
#ifndef CLSHEAR_DEVICE_MOTION_BOXES_H
#define CLSHEAR_DEVICE_MOTION_BOXES_H

#include "boxes.h"
#include "camera_sample.h"

#include "fp_contract_off.h"

/* Part of the widest box below which another is left out of the fibre: it moves the fibre by little
 * and its place in the fibre would lose its digits. */
#define CS_LEAST_PART 0.00390625f

/* The five numbers in [0, 1) that a map starts from. a and b choose the fibre; c, d and tau choose
 * a place on it. */
typedef struct cs_moving_tuple {
    cs_vfloat a;   /* of the fibre, along the axis of the larger motion */
    cs_vfloat b;   /* of the fibre, along the other axis */
    cs_vfloat c;   /* on the fibre, along the first axis */
    cs_vfloat d;   /* on the fibre, along the second axis */
    cs_vfloat tau; /* on the fibre, in time */
} cs_moving_tuple;

/* Pixel and lens along one line, as parts of their widths, and the time; all in [0, 1]. */
typedef struct cs_moving_axis {
    cs_vfloat film;
    cs_vfloat lens;
    cs_vfloat time;
} cs_moving_axis;

/* One line of the chain, whose fibre is film_px * film + lens_px * lens + speed_px * time.
 *
 * across, narrow, tau: in [0, 1). `across` chooses the fibre, `narrow` the narrower of film and
 * lens, `tau` a time between `low` and `high`. low, high: receive the first and the last time that
 * the fibre leaves, in [0, 1]. film_px, lens_px, speed_px: above 0. */
static inline cs_moving_axis cs_chain_axis(cs_vfloat across, cs_vfloat narrow, cs_vfloat tau,
                                           cs_vfloat film_px, cs_vfloat lens_px, cs_vfloat speed_px,
                                           cs_vfloat *low, cs_vfloat *high)
{
    cs_vfloat thick = cs_max(film_px, lens_px);
    cs_vfloat least = CS_LEAST_PART * cs_max(thick, speed_px);
    cs_vfloat thin = cs_min(film_px, lens_px), safe = cs_max(thin, least);
    cs_vint is_left_out = thin < least;
    cs_two_boxes others = cs_two_boxes_of(thick, speed_px);
    cs_vfloat t = cs_three_boxes_quantile(safe, thick, speed_px, across);
    cs_vfloat part = cs_box_given(t, safe, others, narrow);
    cs_vfloat rest = is_left_out ? cs_two_boxes_quantile(others, across) : t - safe * part;
    part = is_left_out ? narrow : part;
    *low = cs_clamp((rest - thick) / speed_px, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
    *high = cs_clamp(rest / speed_px, *low, (cs_vfloat)(1.0f));
    cs_moving_axis axis;
    axis.time = *low + (*high - *low) * tau;
    cs_vfloat other =
        cs_clamp((rest - speed_px * axis.time) / thick, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
    axis.film = lens_px < film_px ? other : part;
    axis.lens = lens_px < film_px ? part : other;
    return axis;
}

/* Maps both axes of a square lens with one time. The x axis gives an interval of times, the y axis
 * chooses one time in it, and x then takes its place at that time.
 *
 * blur_x, blur_y, speed_x, speed_y: magnitudes, pixels. speed_x is the larger speed. */
static inline void cs_chain(const cs_moving_tuple *z, cs_f32 blur_x, cs_f32 blur_y, cs_f32 speed_x,
                            cs_f32 speed_y, cs_moving_axis *x, cs_moving_axis *y)
{
    cs_vfloat pixel = (cs_vfloat)(1.0f), low, high, first, last;
    *x = cs_chain_axis(z->a, z->c, (cs_vfloat)(0.0f), pixel, (cs_vfloat)(blur_x),
                       (cs_vfloat)(speed_x), &low, &high);
    cs_vfloat left = cs_max(speed_y * (high - low), (cs_vfloat)(0.1f * CS_LEAST_MOTION));
    *y = cs_chain_axis(z->b, z->d, z->tau, pixel, (cs_vfloat)(blur_y), left, &first, &last);
    /* x holds low's place on the wider of its two; move it to the time that y has chosen. */
    cs_vfloat time = low + (high - low) * y->time;
    cs_vfloat moved = speed_x * (time - low);
    if (blur_x < 1.0f)
        x->film = cs_clamp(x->film - moved, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
    else
        x->lens = cs_clamp(x->lens - moved / blur_x, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
    x->time = time;
    y->time = time;
}

/* Exchanges two values if `swap`. */
static inline void cs_swap_if(int swap, cs_vfloat *a, cs_vfloat *b)
{
    cs_vfloat kept = *a;
    *a = swap ? *b : *a;
    *b = swap ? kept : *b;
}

/* The chain for an image moving by (-velocity) along the fibre. tuple: film and lens, as for
 * cs_shear; time: the fifth number. Mirrors turn every sign positive, and the axis of the larger
 * motion comes first. */
static inline cs_moving_sample cs_moving_boxes(cs_camera_sample tuple, cs_vfloat time, cs_blur blur,
                                               cs_velocity velocity)
{
    cs_f32 speed_x = cs_max(velocity.x, -velocity.x), speed_y = cs_max(velocity.y, -velocity.y);
    int swap = speed_y > speed_x;
    int mirror_x = velocity.x > 0.0f, mirror_y = velocity.y > 0.0f;
    cs_moving_axis x, y;
    cs_moving_tuple z = {tuple.x, tuple.y, tuple.u, tuple.v, time};
    cs_swap_if(swap, &z.a, &z.b);
    cs_swap_if(swap, &z.c, &z.d);
    z.a = (swap ? mirror_y : mirror_x) ? 1.0f - z.a : z.a;
    z.b = (swap ? mirror_x : mirror_y) ? 1.0f - z.b : z.b;
    cs_f32 larger = swap ? speed_y : speed_x, smaller = swap ? speed_x : speed_y;
    cs_chain(&z, swap ? blur.y : blur.x, swap ? blur.x : blur.y, larger, smaller, &x, &y);
    cs_swap_if(swap, &x.film, &y.film);
    cs_swap_if(swap, &x.lens, &y.lens);
    if (mirror_x != (blur.sign < 0.0f)) x.lens = 1.0f - x.lens;
    if (mirror_y != (blur.sign < 0.0f)) y.lens = 1.0f - y.lens;
    cs_moving_sample sample;
    sample.point.x = mirror_x ? 1.0f - x.film : x.film;
    sample.point.y = mirror_y ? 1.0f - y.film : y.film;
    sample.point.u = x.lens - 0.5f;
    sample.point.v = y.lens - 0.5f;
    sample.time = x.time;
    return sample;
}

#include "fp_contract_restore.h"

#endif
