/* The equal-area shear of disks and polygons with any filter: one axis of film and lens after the
 * other, without any equation to solve.
 *
 * Along an axis the other lens coordinate stays, so the lens coordinate is uniform on a chord of
 * the aperture. A box filter makes the film coordinate uniform too, and for two uniform variables
 * the map is known: t = film + blur * lens has a trapezoid as its density (shear.h). A symmetrical
 * filter with one hump is a mixture of boxes, one for each height under its curve. A hash of the
 * tuple chooses a height, and so a box that holds the film's place. The film moves within that box.
 *
 * Up to a blur of CS_FILM_FIRST the first pair is a point of the film and the second a point of the
 * lens; beyond it they change places. Each axis takes its fibre from the first pair and the place
 * on the fibre from the second.
 *
 * The map keeps measure to rounding for every blur, because each axis keeps it while the other
 * coordinates are fixed. The second pair moves the fibre a little, because chords differ in length
 * and boxes in width: by a mean square of at most 0.004 square pixels for a hexagon with a box and
 * 0.05 for a gaussian, both near a blur of one pixel (tests/test_shear.c). Without a shear the mean
 * square is blur^2 / (2 pi). */
#ifndef CLSHEAR_DEVICE_CHORD_MAP_H
#define CLSHEAR_DEVICE_CHORD_MAP_H

#include "camera_sample.h"
#include "fibre.h"
#include "hash.h"

#include "fp_contract_off.h"

/* Blur, in pixels per lens unit, over the standard deviation of the filter, up to which the film is
 * the wider: there the first pair moves the fibre as much either way. */
#define CS_FILM_FIRST 3.5f

/* Whether cs_chord_map maps these optics. */
static inline int cs_has_chord_map(const cs_optics *optics)
{
    return optics->marginal == CS_MARGINAL_DISK || optics->marginal == CS_MARGINAL_POLYGON;
}

/* A box of the mixture that the filter is, and a place in it. */
typedef struct cs_film_box {
    cs_vfloat width; /* pixels; its middle is the pixel's centre */
    cs_vfloat place; /* in [0, 1] from its left end to its right */
} cs_film_box;

/* The box and the place that `mass`, in [0, 1), stands for. `level`, in [0, 1), chooses the box. */
static inline cs_film_box cs_film_box_of(const cs_optics *optics, cs_optics_table table,
                                         cs_vfloat mass, cs_vfloat level)
{
    cs_film_box box;
    box.width = (cs_vfloat)(optics->filter_width);
    box.place = mass;
    if (optics->filter_steps == 1u) return box;
    cs_f32 step = optics->filter_width / (cs_f32)optics->filter_steps;
    cs_filter_place film = cs_filter_place_of(optics, table, mass);
    cs_vfloat height = level * film.density;
    for (cs_u32 k = 1u; k < optics->filter_steps / 2u; k++) {
        cs_vfloat narrower = (cs_vfloat)(optics->filter_width - 2.0f * (cs_f32)k * step);
        box.width = height > table[k - 1u] ? narrower : box.width;
    }
    box.place = cs_clamp(film.x / box.width + 0.5f, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
    return box;
}

/* One axis: moves along the fibre. blur: signed shear along the axis, pixels per lens unit. lens:
 * the lens coordinate, on the chord `span`; receives the new one. Returns the film's, in pixels
 * from the pixel's centre. */
static inline cs_vfloat cs_slide(cs_film_box box, cs_span span, cs_f32 blur, int film_first,
                                 cs_vfloat *lens)
{
    cs_f32 sign = blur < 0.0f ? -1.0f : 1.0f;
    cs_f32 inverse = 1.0f / blur;
    cs_vfloat length = cs_max(span.length, (cs_vfloat)(1e-6f));
    cs_vfloat place = cs_clamp(sign * (*lens - span.centre) / length + 0.5f, (cs_vfloat)(0.0f),
                               (cs_vfloat)(1.0f));
    cs_vfloat across = film_first ? box.place : place;
    cs_vfloat along = film_first ? place : box.place;
    cs_vfloat blurred = sign * blur * length;
    cs_vfloat narrow = cs_min(blurred, box.width);
    cs_vfloat wide = cs_max(blurred, box.width);
    cs_vfloat tail = wide * cs_min(across, 1.0f - across);
    cs_vfloat rising = cs_sqrt(2.0f * narrow * tail);
    cs_vfloat t = rising < narrow ? rising : 0.5f * narrow + tail;
    t = across > 0.5f ? narrow + wide - t : t;
    cs_vfloat least = cs_max(t - wide, (cs_vfloat)(0.0f));
    cs_vfloat part = least + (cs_min(t, narrow) - least) * along; /* of the narrower */
    cs_vfloat rest = t - part;
    cs_vint is_narrow = blurred < box.width;
    *lens = span.centre + ((is_narrow ? part : rest) * inverse - (0.5f * sign) * length);
    return (is_narrow ? rest : part) - 0.5f * box.width;
}

/* Numbers in [0, 1) from the 24 upper bits of a hash. */
static inline cs_vfloat cs_level_of(cs_vuint hash)
{
    return cs_to_vfloat(hash >> 8) * (1.0f / 16777216.0f);
}

/* Maps a packet of tuples (a, b, c, d) of optics that cs_has_chord_map. */
static inline cs_camera_sample cs_chord_map(cs_vfloat a, cs_vfloat b, cs_vfloat c, cs_vfloat d,
                                            const cs_optics *optics, cs_optics_table table,
                                            cs_blur blur)
{
    cs_f32 least = CS_FILM_FIRST * optics->filter_deviation;
    int film_first = blur.x * blur.y < least * least;
    cs_vuint first = cs_hash_lanes(cs_as_vuint(a) + 0x9e3779b9u * cs_as_vuint(b) +
                                   0x85ebca6bu * cs_as_vuint(c) + 0xc2b2ae35u * cs_as_vuint(d));
    cs_vuint second = cs_hash_lanes(first);
    cs_film_box box = cs_film_box_of(optics, table, film_first ? a : c, cs_level_of(first));
    cs_film_box below = cs_film_box_of(optics, table, film_first ? b : d, cs_level_of(second));
    cs_marginal across = cs_marginal_across(optics, table);
    cs_camera_sample point;
    cs_lens_point(film_first ? c : a, film_first ? d : b, optics, table, &point.u, &point.v);
    point.x =
        cs_slide(box, cs_span_at(optics, table, point.v), blur.sign * blur.x, film_first, &point.u);
    cs_chord chord = cs_chord_at(optics, table, &across, point.u);
    cs_span span;
    span.centre = chord.centre;
    span.length = chord.length;
    point.y = cs_slide(below, span, blur.sign * blur.y, film_first, &point.v);
    point.x += 0.5f;
    point.y += 0.5f;
    return point;
}

#include "fp_contract_restore.h"

#endif
