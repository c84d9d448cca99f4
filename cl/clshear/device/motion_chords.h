/* The shear of lens and time for disks, polygons and squares, with any filter.
 *
 * First the wider of film and lens is put on the fibre that the first pair chooses, with the time
 * (timed_place.h, disk_time.h). Then the narrower joins by sliding. Where all but their places
 * along one line is fixed, film, lens and time are uniform on chords of that line. Along the motion
 * these are three boxes: the fibre goes to where their sum has the rank that the sum of the first
 * two had (cs_chain_axis). Across it the time has no part, and two boxes slide as at rest
 * (chord_map.h). The line along the motion comes first, because the lens's place
 * on it depends on the time and sets the length of the chord across. That length changes the places
 * across little. The filter is a mixture of boxes as in chord_map.h.
 *
 * A polygon, a box of such a mixture, and a disk that hardly moves have no map to their fibre with
 * the time: their place in the chord along the motion takes the place of the rank.
 *
 * Each step keeps measure to rounding, because it keeps it while the rest is fixed. The other three
 * numbers move the fibre by a mean square of at most 0.02 square pixels with a box filter and 0.25
 * with a gaussian, for any blur and motion (tests/test_motion_map.c); with the time free it is a
 * twelfth of the square of the motion. */
#ifndef CLSHEAR_DEVICE_MOTION_CHORDS_H
#define CLSHEAR_DEVICE_MOTION_CHORDS_H

#include "chord_map.h"
#include "disk_time.h"
#include "motion_boxes.h"
#include "stretch.h"

#include "fp_contract_off.h"

/* Slowest motion, in parts of the lens while the shutter is open, for which the map of disk and
 * time keeps its digits; a slower one hardly moves the fibre. */
#define CS_LEAST_RATE 0.015625f

/* A point of film and lens on its way through the map. */
typedef struct cs_moving_point {
    cs_vfloat width; /* of the film's box that it is in, pixels; its middle is the pixel's centre */
    cs_vfloat height; /* likewise */
    cs_vfloat x;      /* pixels from the pixel's centre */
    cs_vfloat y;
    cs_vfloat u; /* lens units */
    cs_vfloat v;
    cs_vfloat time;  /* in [0, 1] */
    int film_first;  /* whether the first pair has chosen the film's place, not the lens's */
    int is_on_fibre; /* whether it has chosen the fibre of that place and the time */
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

/* Slides film, lens and time along the motion. along: the number in [0, 1) that has chosen the time
 * on the fibre. */
static inline void cs_slide_along(cs_moving_point *point, cs_vfloat along, const cs_optics *optics,
                                  cs_optics_table table, cs_heading to, cs_f32 speed_px)
{
    cs_chords at = cs_chords_of(point, optics, table, to);
    cs_vfloat film_px = at.box.width, lens_px = at.length * to.blur;
    cs_vfloat speed = (cs_vfloat)(speed_px), low, high;
    cs_vfloat wide = point->film_first ? film_px : lens_px;
    cs_vfloat place = point->film_first ? at.box.place : at.place;
    cs_vfloat rank =
        cs_two_boxes_below(cs_two_boxes_of(wide, speed), wide * place + speed * point->time);
    rank = point->is_on_fibre ? rank : place;
    cs_moving_axis axis = cs_chain_axis(rank, point->film_first ? at.place : at.box.place, along,
                                        film_px, lens_px, speed, &low, &high);
    cs_move(point, to, at.film.low + at.box.width * axis.film, at.lens.low + at.length * axis.lens);
    point->time = axis.time;
}

/* Slides film and lens across the motion. */
static inline void cs_slide_across(cs_moving_point *point, const cs_optics *optics,
                                   cs_optics_table table, cs_heading to)
{
    cs_chords at = cs_chords_of(point, optics, table, to);
    cs_vfloat middle = 0.5f * (at.lens.low + at.lens.high), lens = -middle;
    cs_span span;
    span.centre = (cs_vfloat)(0.0f);
    span.length = at.length;
    cs_vfloat film = cs_slide(at.box, span, to.blur, point->film_first, &lens);
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

/* The place and time of the fibre that (a, b) chooses, `along` on it, of a shape of these widths in
 * pixels: a disk or else a square, stretched. Mirrors turn both signs of the motion, and the axis
 * of the larger rate comes first. */
static inline cs_timed_place cs_timed_place_of(cs_vfloat a, cs_vfloat b, cs_vfloat along,
                                               int is_disk, cs_f32 width, cs_f32 height,
                                               cs_velocity velocity)
{
    int mirror_x = velocity.x > 0.0f, mirror_y = velocity.y > 0.0f;
    cs_f32 rate_x = (mirror_x ? velocity.x : -velocity.x) / width;
    cs_f32 rate_y = (mirror_y ? velocity.y : -velocity.y) / height;
    int swap = rate_y > rate_x;
    a = mirror_x ? 1.0f - a : a;
    b = mirror_y ? 1.0f - b : b;
    cs_swap_if(swap, &a, &b);
    cs_f32 larger = cs_max(rate_x, rate_y), smaller = cs_min(rate_x, rate_y);
    cs_timed_place place = is_disk ? cs_disk_and_time(a, b, along, larger, smaller)
                                   : cs_square_and_time(a, b, along, larger, smaller);
    cs_swap_if(swap, &place.x, &place.y);
    place.x *= mirror_x ? -width : width;
    place.y *= mirror_y ? -height : height;
    return place;
}

/* Puts the first pair's place, and the time, on the fibre that the pair chooses, where there is a
 * map for it. along: in [0, 1). */
static inline void cs_put_on_fibre(const cs_camera_sample *tuple, cs_vfloat along,
                                   const cs_optics *optics, cs_blur blur, cs_velocity velocity,
                                   cs_moving_point *point)
{
    int is_disk = optics->marginal == (cs_u32)CS_MARGINAL_DISK && !point->film_first;
    cs_f32 width = point->film_first ? optics->filter_width : blur.x;
    cs_f32 height = point->film_first ? optics->filter_width : blur.y;
    cs_f32 rate =
        cs_max(cs_max(velocity.x, -velocity.x) / width, cs_max(velocity.y, -velocity.y) / height);
    int is_square = point->film_first ? optics->filter_steps == 1u
                                      : optics->marginal == (cs_u32)CS_MARGINAL_UNIFORM;
    if (!is_square && !(is_disk && rate > CS_LEAST_RATE)) return;
    cs_timed_place place =
        cs_timed_place_of(tuple->x, tuple->y, along, is_disk, width, height, velocity);
    point->is_on_fibre = 1;
    point->time = place.time;
    if (point->film_first) {
        point->x = place.x;
        point->y = place.y;
    } else {
        point->u = blur.sign / blur.x * place.x;
        point->v = blur.sign / blur.y * place.y;
    }
}

/* The point that a tuple stands for before it slides. along: in [0, 1). */
static inline cs_moving_point cs_moving_point_of(const cs_camera_sample *tuple, cs_vfloat along,
                                                 const cs_optics *optics, cs_optics_table table,
                                                 int film_first)
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
    point.time = along;
    point.film_first = film_first;
    point.is_on_fibre = 0;
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
    cs_moving_point at = cs_moving_point_of(&tuple, time, optics, table, film_first);
    cs_put_on_fibre(&tuple, time, optics, blur, velocity, &at);
    cs_slide_along(&at, time, optics, table, along, speed_px);
    cs_slide_across(&at, optics, table, across);
    cs_moving_sample sample;
    sample.time = at.time;
    sample.point.x = at.x + 0.5f;
    sample.point.y = at.y + 0.5f;
    sample.point.u = at.u;
    sample.point.v = at.v;
    return sample;
}

#include "fp_contract_restore.h"

#endif
