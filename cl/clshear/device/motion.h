/* Shears of (pixel, lens, time): measure-preserving maps of five numbers in [0, 1) to a point of
 * the pixel, a point of the lens and a time of the shutter.
 *
 * A surface that moves over the film by v pixels while the shutter is open, with the circle of
 * confusion s, shows the same point along the fibres x + s * u - v * time = const. The first two of
 * the five choose the fibre; the others move along it. Each map preserves measure for any v and s,
 * so that wrong ones raise the variance and leave the mean unbiased.
 *
 * pinhole     Time and pixel are two boxes, as lens and pixel are without motion: exact.
 * chain       For a square lens. Exact for motion along an axis; else the fibre's y leaks by at
 *             most min(1, |s|) |v_y / v_x| pixels.
 * time free   For other lenses and filters: the fibre leaks by v. */
#ifndef CLSHEAR_DEVICE_MOTION_H
#define CLSHEAR_DEVICE_MOTION_H

#include "boxes.h"
#include "shear.h"
#include "stretch.h"

#include "fp_contract_off.h"

/* Motion, in pixels while the shutter is open, below which a surface counts as at rest. */
#define CS_LEAST_MOTION 1e-3f

/* Circle of confusion, as a part of the motion, below which it is the motion that counts. */
#define CS_LEAST_CONFUSION 0.015625f

/* Part of the widest box below which another is left out of the fibre. */
#define CS_LEAST_PART (1.0f / 64.0f)

/* A point of pixel and lens, and a time of the shutter, 0 where it opens and 1 where it closes. */
typedef struct cs_moving_sample {
    cs_camera_sample point;
    cs_vfloat time;
} cs_moving_sample;

/* The five numbers in [0, 1) that a map starts from. a and b choose the fibre; c, d and tau choose
 * a place on it. */
typedef struct cs_moving_tuple {
    cs_vfloat a;   /* of the fibre, along the axis of the larger motion */
    cs_vfloat b;   /* of the fibre, along the other axis */
    cs_vfloat c;   /* on the fibre, along the first axis */
    cs_vfloat d;   /* on the fibre, along the second axis */
    cs_vfloat tau; /* on the fibre, in time */
} cs_moving_tuple;

/* Pixel and lens along one axis, and the time; all in [0, 1]. */
typedef struct cs_moving_axis {
    cs_vfloat film;
    cs_vfloat lens;
    cs_vfloat time;
} cs_moving_axis;

/* One axis of the chain, whose fibre is film + blur * lens + speed * time.
 *
 * across, narrow, tau: in [0, 1). `across` chooses the fibre, `narrow` the narrower of film and
 * lens, `tau` a time between `low` and `high`. low, high: receive the first and the last time that
 * the fibre leaves, in [0, 1]. blur, speed: pixels, above 0. */
static inline cs_moving_axis cs_chain_axis(cs_vfloat across, cs_vfloat narrow, cs_vfloat tau,
                                           cs_f32 blur, cs_vfloat speed, cs_vfloat *low,
                                           cs_vfloat *high)
{
    cs_vfloat thin = (cs_vfloat)(cs_min(1.0f, blur)), thick = (cs_vfloat)(cs_max(1.0f, blur));
    cs_vfloat t = cs_three_boxes_quantile(thin, thick, speed, across);
    cs_vfloat part = cs_box_given(t, thin, cs_two_boxes_of(thick, speed), narrow);
    cs_vfloat rest = t - thin * part;
    *low = cs_clamp((rest - thick) / speed, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
    *high = cs_clamp(rest / speed, *low, (cs_vfloat)(1.0f));
    cs_moving_axis axis;
    axis.time = *low + (*high - *low) * tau;
    cs_vfloat other =
        cs_clamp((rest - speed * axis.time) / thick, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
    axis.film = blur < 1.0f ? other : part;
    axis.lens = blur < 1.0f ? part : other;
    return axis;
}

/* Maps both axes of a square lens with one time. The x axis gives an interval of times, the y axis
 * chooses one time in it, and x then takes its place at that time.
 *
 * blur_x, blur_y, speed_x, speed_y: magnitudes, pixels. speed_x is the larger speed. */
static inline void cs_chain(const cs_moving_tuple *z, cs_f32 blur_x, cs_f32 blur_y, cs_f32 speed_x,
                            cs_f32 speed_y, cs_moving_axis *x, cs_moving_axis *y)
{
    cs_vfloat low, high, first, last;
    *x = cs_chain_axis(z->a, z->c, (cs_vfloat)(0.0f), blur_x, (cs_vfloat)(speed_x), &low, &high);
    cs_vfloat left = cs_max(speed_y * (high - low), (cs_vfloat)(0.1f * CS_LEAST_MOTION));
    *y = cs_chain_axis(z->b, z->d, z->tau, blur_y, left, &first, &last);
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

/* The pinhole's map: two trapezoids; the lens is free. */
static inline void cs_pinhole_motion(const cs_moving_tuple *z, cs_f32 speed_x, cs_f32 speed_y,
                                     cs_moving_axis *x, cs_moving_axis *y)
{
    cs_vfloat speed = (cs_vfloat)(speed_x);
    cs_vfloat t = cs_two_boxes_quantile(cs_two_boxes_of((cs_vfloat)(1.0f), speed), z->a);
    cs_vfloat low = cs_clamp((t - 1.0f) / speed, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
    cs_vfloat high = cs_clamp(t / speed, low, (cs_vfloat)(1.0f));
    cs_vfloat left = cs_max(speed_y * (high - low), (cs_vfloat)(0.1f * CS_LEAST_MOTION));
    cs_vfloat other = cs_two_boxes_quantile(cs_two_boxes_of((cs_vfloat)(1.0f), left), z->b);
    cs_vfloat first = cs_clamp((other - 1.0f) / left, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
    cs_vfloat last = cs_clamp(other / left, first, (cs_vfloat)(1.0f));
    cs_vfloat place = first + (last - first) * z->tau;
    x->time = low + (high - low) * place;
    y->time = x->time;
    x->film = cs_clamp(t - speed_x * x->time, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
    y->film = cs_clamp(other - left * place, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
    x->lens = z->c;
    y->lens = z->d;
}

/* Exchanges two values if `swap`. */
static inline void cs_swap_if(int swap, cs_vfloat *a, cs_vfloat *b)
{
    cs_vfloat kept = *a;
    *a = swap ? *b : *a;
    *b = swap ? kept : *b;
}

/* The pinhole's map or the chain, for an image moving by (-velocity) along the fibre; blur: of the
 * shear. Mirrors turn every sign positive, and the axis of the larger motion comes first. */
static inline cs_moving_sample cs_moving_boxes(cs_moving_tuple z, cs_blur blur,
                                               cs_velocity velocity, int chained)
{
    cs_f32 speed_x = cs_max(velocity.x, -velocity.x), speed_y = cs_max(velocity.y, -velocity.y);
    int swap = speed_y > speed_x;
    int mirror_x = velocity.x > 0.0f, mirror_y = velocity.y > 0.0f;
    cs_moving_axis x, y;
    z.a = (swap ? mirror_y : mirror_x) ? 1.0f - z.a : z.a;
    z.b = (swap ? mirror_x : mirror_y) ? 1.0f - z.b : z.b;
    cs_f32 larger = swap ? speed_y : speed_x, smaller = swap ? speed_x : speed_y;
    if (chained)
        cs_chain(&z, swap ? blur.y : blur.x, swap ? blur.x : blur.y, larger, smaller, &x, &y);
    else
        cs_pinhole_motion(&z, larger, smaller, &x, &y);
    cs_swap_if(swap, &x.film, &y.film);
    cs_swap_if(swap, &x.lens, &y.lens);
    if (chained && (mirror_x != (blur.sign < 0.0f))) x.lens = 1.0f - x.lens;
    if (chained && (mirror_y != (blur.sign < 0.0f))) y.lens = 1.0f - y.lens;
    cs_moving_sample sample;
    sample.point.x = mirror_x ? 1.0f - x.film : x.film;
    sample.point.y = mirror_y ? 1.0f - y.film : y.film;
    sample.point.u = x.lens;
    sample.point.v = y.lens;
    sample.time = x.time;
    return sample;
}

/* One line of the film, along which pixel, lens and time are three boxes whose sum is the fibre.
 *
 * across, narrow, tau: in [0, 1). `across` chooses the fibre, `narrow` the narrower of film and
 * lens, `tau` the time. film_px, lens_px: widths of the chords, pixels; speed_px: above 0. */
static inline cs_moving_axis cs_chain_line(cs_vfloat across, cs_vfloat narrow, cs_vfloat tau,
                                           cs_vfloat film_px, cs_vfloat lens_px, cs_f32 speed_px)
{
    cs_vfloat speed = (cs_vfloat)(speed_px);
    cs_vfloat thick = cs_max(film_px, lens_px);
    cs_vfloat least = CS_LEAST_PART * cs_max(thick, speed);
    cs_vfloat thin = cs_min(film_px, lens_px);
    cs_vint alone = thin < least; /* so narrow that it may as well be left out of the fibre */
    cs_vfloat safe = cs_max(thin, least);
    cs_two_boxes others = cs_two_boxes_of(thick, speed);
    cs_vfloat t = cs_three_boxes_quantile(safe, thick, speed, across);
    cs_vfloat part = cs_box_given(t, safe, others, narrow);
    cs_vfloat rest = alone ? cs_two_boxes_quantile(others, across) : t - safe * part;
    part = alone ? narrow : part;
    cs_vfloat low = cs_clamp((rest - thick) / speed, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
    cs_vfloat high = cs_clamp(rest / speed, low, (cs_vfloat)(1.0f));
    cs_moving_axis axis;
    axis.time = low + (high - low) * tau;
    cs_vfloat other =
        cs_clamp((rest - speed * axis.time) / thick, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
    axis.film = lens_px < film_px ? other : part;
    axis.lens = lens_px < film_px ? part : other;
    return axis;
}

/* A point of film and lens on its way through the map. */
typedef struct cs_moving_point {
    cs_vfloat width; /* of the rectangle of the film that it is in, pixels */
    cs_vfloat height;
    cs_vfloat x; /* pixels from the pixel's centre */
    cs_vfloat y;
    cs_vfloat u; /* lens units */
    cs_vfloat v;
} cs_moving_point;

/* Moves a point by these distances along a heading. */
static inline void cs_move(cs_moving_point *point, cs_heading to, cs_vfloat film_px, cs_vfloat lens)
{
    point->x += film_px * to.x;
    point->y += film_px * to.y;
    point->u += lens * to.u;
    point->v += lens * to.v;
}

/* Its chords along a heading. */
typedef struct cs_chords {
    cs_stretch film;  /* pixels */
    cs_stretch lens;  /* lens units */
    cs_film_box box;  /* the film's, and the place in it */
    cs_vfloat length; /* of the lens's */
} cs_chords;

static inline cs_chords cs_chords_of(const cs_moving_point *point, const cs_optics *optics,
                                     cs_optics_table table, cs_heading to)
{
    cs_vfloat least = (cs_vfloat)(1e-6f);
    cs_chords chords;
    chords.film = cs_film_stretch(point->width, point->height, point->x, point->y, to);
    chords.lens = cs_lens_stretch(optics, table, point->u, point->v, to);
    chords.box.width = cs_max(chords.film.high - chords.film.low, least);
    chords.box.place = cs_min(-chords.film.low / chords.box.width, (cs_vfloat)(1.0f));
    chords.length = cs_max(chords.lens.high - chords.lens.low, least);
    return chords;
}

/* The map along the motion. */
static inline cs_vfloat cs_slide_along(cs_moving_point *point, cs_vfloat time,
                                       const cs_optics *optics, cs_optics_table table,
                                       cs_heading to, int film_first, cs_f32 speed_px)
{
    cs_chords at = cs_chords_of(point, optics, table, to);
    cs_vfloat place = cs_min(-at.lens.low / at.length, (cs_vfloat)(1.0f));
    cs_moving_axis axis =
        cs_chain_line(film_first ? at.box.place : place, film_first ? place : at.box.place, time,
                      at.box.width, at.length * to.blur, speed_px);
    cs_move(point, to, at.film.low + at.box.width * axis.film, at.lens.low + at.length * axis.lens);
    return axis.time;
}

/* The map across the motion, where time has no part. */
static inline void cs_slide_across(cs_moving_point *point, const cs_optics *optics,
                                   cs_optics_table table, cs_heading to, int film_first)
{
    cs_chords at = cs_chords_of(point, optics, table, to);
    cs_vfloat middle = 0.5f * (at.lens.low + at.lens.high), lens = -middle;
    cs_span span;
    span.centre = (cs_vfloat)(0.0f);
    span.length = at.length;
    cs_vfloat film = cs_slide(at.box, span, to.blur, film_first, &lens);
    cs_vfloat reach = 0.5f * at.length; /* which rounding may leave in focus */
    cs_move(point, to, 0.5f * (at.film.low + at.film.high) + film,
            middle + cs_clamp(lens, -reach, reach));
}

/* For all apertures with chords, and any filter. */
static inline cs_moving_sample cs_moving_chords(cs_camera_sample tuple, cs_vfloat time,
                                                const cs_optics *optics, cs_optics_table table,
                                                cs_blur blur, cs_velocity velocity)
{
    cs_f32 speed = cs_sqrt(velocity.x * velocity.x + velocity.y * velocity.y);
    cs_heading along = cs_heading_of(-velocity.x / speed, -velocity.y / speed, blur);
    cs_heading across = cs_heading_of(-along.y, along.x, blur);
    cs_f32 least = CS_FILM_FIRST * optics->filter_deviation;
    int film_first = blur.x * blur.y < least * least;
    cs_vuint first =
        cs_hash_lanes(cs_as_vuint(tuple.x) + 0x9e3779b9u * cs_as_vuint(tuple.y) +
                      0x85ebca6bu * cs_as_vuint(tuple.u) + 0xc2b2ae35u * cs_as_vuint(tuple.v));
    cs_vuint second = cs_hash_lanes(first);
    cs_film_box box =
        cs_film_box_of(optics, table, film_first ? tuple.x : tuple.u, cs_level_of(first));
    cs_film_box below =
        cs_film_box_of(optics, table, film_first ? tuple.y : tuple.v, cs_level_of(second));
    cs_moving_point at;
    at.width = box.width;
    at.height = below.width;
    at.x = (box.place - 0.5f) * box.width;
    at.y = (below.place - 0.5f) * below.width;
    cs_lens_point(film_first ? tuple.u : tuple.x, film_first ? tuple.v : tuple.y, optics, table,
                  &at.u, &at.v);
    cs_moving_sample sample;
    sample.time = cs_slide_along(&at, time, optics, table, along, film_first, speed);
    cs_slide_across(&at, optics, table, across, film_first);
    sample.point.x = at.x + 0.5f;
    sample.point.y = at.y + 0.5f;
    sample.point.u = at.u;
    sample.point.v = at.v;
    cs_clamp_to_filter(optics, &sample.point);
    return sample;
}

/* Maps a packet of five numbers. tuple: film and lens, as for cs_shear. time: the fifth, in [0, 1).
 * velocity: of the surface on the film. The others as for cs_shear. */
static inline cs_moving_sample cs_shear_moving(cs_camera_sample tuple, cs_vfloat time, cs_u32 mode,
                                               const cs_optics *optics, cs_optics_table table,
                                               cs_f32 shear, cs_velocity velocity)
{
    cs_f32 speed_x = cs_max(velocity.x, -velocity.x), speed_y = cs_max(velocity.y, -velocity.y);
    cs_f32 speed = cs_max(speed_x, speed_y);
    cs_blur blur = cs_blur_of(shear, optics->squeeze);
    int sharp = cs_max(blur.x, blur.y) < CS_LEAST_CONFUSION * cs_max(speed, 1.0f);
    int square = optics->marginal == CS_MARGINAL_UNIFORM;
    cs_moving_sample sample;
    if (mode == CS_SHEAR_EQUAL_AREA && cs_has_chord_map(optics) && speed >= CS_LEAST_MOTION)
        return cs_moving_chords(tuple, time, optics, table, blur, velocity);
    if (mode != CS_SHEAR_EQUAL_AREA || !optics->has_closed_form || speed < CS_LEAST_MOTION ||
        (!sharp && !square)) {
        sample.point = cs_shear(tuple.x, tuple.y, tuple.u, tuple.v, mode, optics, table, shear);
        sample.time = time;
        return sample;
    }
    cs_moving_tuple z;
    z.a = speed_y > speed_x ? tuple.y : tuple.x;
    z.b = speed_y > speed_x ? tuple.x : tuple.y;
    z.c = speed_y > speed_x ? tuple.v : tuple.u;
    z.d = speed_y > speed_x ? tuple.u : tuple.v;
    z.tau = time;
    sample = cs_moving_boxes(z, blur, velocity, !sharp);
    sample.point.u -= 0.5f;
    sample.point.v -= 0.5f;
    if (!square) cs_disk_from_square(&sample.point.u, &sample.point.v);
    cs_clamp_to_filter(optics, &sample.point);
    return sample;
}

#include "fp_contract_restore.h"

#endif
