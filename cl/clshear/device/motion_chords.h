/* The shear of lens and time for disks, polygons and squares, with any filter, without any equation
 * to solve.
 *
 * Where all but their places along one line is fixed, film, lens and time are uniform on chords of
 * that line. Along the motion these are three boxes, whose sum the chain draws (motion_boxes.h);
 * across it the time has no part, and two boxes slide as at rest (chord_map.h). Along comes first:
 * the lens's place there depends on the time, and its chord across with it, but what slides across
 * hardly depends on that chord. The film's filter is a mixture of boxes as in chord_map.h.
 *
 * Each step keeps measure to rounding, because it keeps it while the rest is fixed. The second pair
 * and the time move the fibre by a mean square of at most 0.02 square pixels with a box filter and
 * 0.25 with a gaussian, for any blur and motion (tests/test_motion_map.c); with the time free it is
 * a twelfth of the square of the motion. */
#ifndef CLSHEAR_DEVICE_MOTION_CHORDS_H
#define CLSHEAR_DEVICE_MOTION_CHORDS_H

#include "chord_map.h"
#include "motion_boxes.h"
#include "stretch.h"

#include "fp_contract_off.h"

/* A point of film and lens on its way through the map. */
typedef struct cs_moving_point {
    cs_vfloat width; /* of the film's box that it is in, pixels; its middle is the pixel's centre */
    cs_vfloat height; /* likewise */
    cs_vfloat x;      /* pixels from the pixel's centre */
    cs_vfloat y;
    cs_vfloat u; /* lens units */
    cs_vfloat v;
} cs_moving_point;

/* The point's chords along a heading. */
typedef struct cs_chords {
    cs_stretch film;  /* pixels */
    cs_stretch lens;  /* lens units */
    cs_film_box box;  /* length of the film's chord, and the place in it */
    cs_vfloat length; /* of the lens's chord, lens units */
    cs_vfloat place;  /* in the lens's chord, in [0, 1] */
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
    chords.place = cs_min(-chords.lens.low / chords.length, (cs_vfloat)(1.0f));
    return chords;
}

/* Moves a point by these distances along a heading. */
static inline void cs_move(cs_moving_point *point, cs_heading to, cs_vfloat film_px, cs_vfloat lens)
{
    point->x += film_px * to.x;
    point->y += film_px * to.y;
    point->u += lens * to.u;
    point->v += lens * to.v;
}

/* Slides film, lens and time along the motion. time: a number in [0, 1). Returns the time. */
static inline cs_vfloat cs_slide_along(cs_moving_point *point, cs_vfloat time,
                                       const cs_optics *optics, cs_optics_table table,
                                       cs_heading to, int film_first, cs_f32 speed_px)
{
    cs_chords at = cs_chords_of(point, optics, table, to);
    cs_vfloat low, high;
    cs_moving_axis axis =
        cs_chain_axis(film_first ? at.box.place : at.place, film_first ? at.place : at.box.place,
                      time, at.box.width, at.length * to.blur, (cs_vfloat)(speed_px), &low, &high);
    cs_move(point, to, at.film.low + at.box.width * axis.film, at.lens.low + at.length * axis.lens);
    return axis.time;
}

/* Slides film and lens across the motion. */
static inline void cs_slide_across(cs_moving_point *point, const cs_optics *optics,
                                   cs_optics_table table, cs_heading to, int film_first)
{
    cs_chords at = cs_chords_of(point, optics, table, to);
    cs_vfloat middle = 0.5f * (at.lens.low + at.lens.high), lens = -middle;
    cs_span span;
    span.centre = (cs_vfloat)(0.0f);
    span.length = at.length;
    cs_vfloat film = cs_slide(at.box, span, to.blur, film_first, &lens);
    cs_vfloat most = 0.5f * at.length; /* which rounding may leave where the blur is tiny */
    cs_move(point, to, 0.5f * (at.film.low + at.film.high) + film,
            middle + cs_clamp(lens, -most, most));
}

/* Whether the first pair is a point of the film, not of the lens. It is where the film is the wider
 * of the two; but where a filter's boxes differ in width and time is wider than they are, a place
 * in a box of the film would not fix the fibre. */
static inline int cs_begins_with_film(const cs_optics *optics, cs_blur blur, cs_f32 speed_px)
{
    cs_f32 least = CS_FILM_FIRST * optics->filter_deviation;
    return blur.x * blur.y < least * least && (optics->filter_steps == 1u || speed_px < least);
}

/* The point that a tuple stands for before it slides. */
static inline cs_moving_point cs_moving_point_of(const cs_camera_sample *tuple, int film_first,
                                                 const cs_optics *optics, cs_optics_table table)
{
    cs_vuint first =
        cs_hash_lanes(cs_as_vuint(tuple->x) + 0x9e3779b9u * cs_as_vuint(tuple->y) +
                      0x85ebca6bu * cs_as_vuint(tuple->u) + 0xc2b2ae35u * cs_as_vuint(tuple->v));
    cs_film_box box =
        cs_film_box_of(optics, table, film_first ? tuple->x : tuple->u, cs_level_of(first));
    cs_film_box below = cs_film_box_of(optics, table, film_first ? tuple->y : tuple->v,
                                       cs_level_of(cs_hash_lanes(first)));
    cs_marginal across = cs_marginal_across(optics, table);
    cs_moving_point point;
    point.width = box.width;
    point.height = below.width;
    point.x = (box.place - 0.5f) * box.width;
    point.y = (below.place - 0.5f) * below.width;
    point.u = cs_marginal_quantile(&across, film_first ? tuple->u : tuple->x);
    cs_chord chord = cs_chord_at(optics, table, &across, point.u);
    point.v = chord.centre + chord.length * ((film_first ? tuple->v : tuple->y) - 0.5f);
    return point;
}

/* Maps a packet of tuples. tuple: film and lens, as for cs_shear; time: the fifth number, in
 * [0, 1). optics: of an aperture that cs_has_stretch. velocity: CS_LEAST_MOTION or more. */
static inline cs_moving_sample cs_moving_chords(cs_camera_sample tuple, cs_vfloat time,
                                                const cs_optics *optics, cs_optics_table table,
                                                cs_blur blur, cs_velocity velocity)
{
    cs_f32 speed_px = cs_sqrt(velocity.x * velocity.x + velocity.y * velocity.y);
    cs_heading along = cs_heading_of(-velocity.x / speed_px, -velocity.y / speed_px, blur);
    cs_heading across = cs_heading_of(-along.y, along.x, blur);
    int film_first = cs_begins_with_film(optics, blur, speed_px);
    cs_moving_point at = cs_moving_point_of(&tuple, film_first, optics, table);
    cs_moving_sample sample;
    sample.time = cs_slide_along(&at, time, optics, table, along, film_first, speed_px);
    cs_slide_across(&at, optics, table, across, film_first);
    sample.point.x = at.x + 0.5f;
    sample.point.y = at.y + 0.5f;
    sample.point.u = at.u;
    sample.point.v = at.v;
    return sample;
}

#include "fp_contract_restore.h"

#endif
