/* The equal-area shear of disks and polygons where the blur is wide for the pixel filter: a point
 * of the lens first, then one axis of the film after the other, without any equation to solve.
 *
 * The tuple's first pair chooses a point (u, v) of the aperture, which is the fibre t = blur * (u,
 * v). Each axis then moves along its fibre while the other lens coordinate stays: on the chord of
 * the aperture there, this is a map of (film, lens) in two dimensions. Two such maps are known:
 *
 * - Box filter on a chord: film and lens coordinate are uniform, and the trapezoid's map (shear.h)
 *   is exact. The second axis has its chord at the new coordinate of the first, so within half a
 *   pixel of the rim its fibre still depends on the second pair a little.
 * - Any symmetrical filter, any shape: fold. The film gets a place x by the filter, and the lens
 *   moves to u - x / blur. Where that point is off the aperture, the map takes -x and u instead,
 *   and t changes by x. This keeps measure: the moves reach every pair (x, u) but those with
 *   u + x / blur off the aperture, and x -> -x takes the pairs with u - x / blur off the aperture
 *   to exactly those.
 *
 * Both keep measure to rounding. The share of tuples whose fibre is not exact falls as 1 / blur. */
#ifndef CLSHEAR_DEVICE_WIDE_MAP_H
#define CLSHEAR_DEVICE_WIDE_MAP_H

#include "camera_sample.h"
#include "disk_fibre.h"
#include "fibre.h"

#include "fp_contract_off.h"

/* Blur that counts as wide, in pixels per lens unit, over the standard deviation of the filter: 2
 * pixels for a box on a polygon, 3.5 for a gaussian. The disk's own map for a box has a fibre that
 * is exact; up to 5 pixels that is worth its time. */
#define CS_WIDE_BLUR 7.0f
#define CS_WIDE_BLUR_OF_DISK 18.0f

/* Whether cs_wide_map maps optics of this blur. */
static inline int cs_is_wide(const cs_optics *optics, cs_blur blur)
{
    cs_f32 least = optics->has_closed_form ? CS_WIDE_BLUR_OF_DISK : CS_WIDE_BLUR;
    return (optics->marginal == CS_MARGINAL_DISK || optics->marginal == CS_MARGINAL_POLYGON) &&
           cs_min(blur.x, blur.y) >= least * optics->filter_deviation;
}

/* The point of the aperture that a pair (a, b) in [0, 1) stands for. */
static inline void cs_lens_point(cs_vfloat a, cs_vfloat b, const cs_optics *optics,
                                 cs_optics_table table, cs_vfloat *u, cs_vfloat *v)
{
    *u = a - 0.5f;
    *v = b - 0.5f;
    if (optics->marginal == CS_MARGINAL_UNIFORM) return;
    if (optics->marginal == CS_MARGINAL_DISK) {
        cs_disk_from_square(u, v);
        return;
    }
    cs_marginal across = cs_marginal_across(optics, table);
    *u = cs_marginal_quantile(&across, a);
    cs_chord chord = cs_chord_at(optics, table, &across, *u);
    *v = chord.centre + chord.length * cs_marginal_quantile(&chord.marginal, b);
}

/* An axis of the film and a chord of the aperture along it. */
typedef struct cs_wide_axis {
    cs_vfloat centre; /* of the chord, lens units */
    cs_vfloat length; /* of the chord, lens units; negative: no chord */
    cs_f32 blur;      /* signed: shear along the axis, pixels per lens unit */
} cs_wide_axis;

/* Moves the lens coordinate along the fibre for a box filter `width` pixels wide: `along` in [0, 1)
 * is the place on the fibre. Returns the lens coordinate; `x` receives the film's, in pixels from
 * the pixel's centre. */
static inline cs_vfloat cs_slide_on_chord(cs_wide_axis axis, cs_vfloat lens, cs_vfloat along,
                                          cs_f32 width, cs_vfloat *x)
{
    cs_vfloat length = cs_max(axis.length, (cs_vfloat)(1e-6f));
    cs_f32 sign = axis.blur < 0.0f ? -1.0f : 1.0f;
    cs_vfloat across = sign * (lens - axis.centre) / length + 0.5f;
    cs_vfloat blur = length * (sign * axis.blur / width); /* in widths of the filter */
    cs_vfloat narrow = cs_min(blur, (cs_vfloat)(1.0f));
    cs_vfloat wide = cs_max(blur, (cs_vfloat)(1.0f));
    cs_vfloat mirrored = cs_max(cs_min(across, 1.0f - across), (cs_vfloat)(0.0f));
    cs_vfloat rising = cs_sqrt(2.0f * narrow * wide * mirrored);
    cs_vfloat flat = 0.5f * narrow + mirrored * wide;
    cs_vfloat t = 2.0f * wide * mirrored < narrow ? rising : flat;
    t = across > 0.5f ? 1.0f + blur - t : t;
    cs_vfloat first = cs_max(t - wide, (cs_vfloat)(0.0f)); /* of what is narrower */
    cs_vfloat place = first + (cs_min(t, narrow) - first) * along;
    cs_vfloat film = blur < 1.0f ? t - place : place;
    *x = width * (film - 0.5f);
    return axis.centre + sign * length * ((t - film) / blur - 0.5f);
}

/* The same for any symmetrical filter. `x` is the place on the film by the filter, in pixels from
 * the pixel's centre, and changes sign where the lens coordinate cannot move. */
static inline cs_vfloat cs_fold_at_rim(cs_wide_axis axis, cs_vfloat lens, cs_vfloat *x)
{
    cs_vfloat moved = lens - *x * (1.0f / axis.blur);
    cs_vint inside = 2.0f * cs_abs(moved - axis.centre) <= axis.length;
    *x = inside ? *x : -*x;
    return inside ? moved : lens;
}

/* The first axis of a polygon, whose chords along u are not tabulated: a fold that looks at the
 * chords along v. */
static inline cs_vfloat cs_fold_across(const cs_optics *optics, cs_optics_table table,
                                       const cs_marginal *across, cs_f32 blur, cs_vfloat u,
                                       cs_vfloat v, cs_vfloat *x)
{
    cs_vfloat moved = u - *x * (1.0f / blur);
    cs_chord chord = cs_chord_at(optics, table, across, moved);
    cs_vint inside = (moved >= across->low) & (moved <= across->high) &
                     (2.0f * cs_abs(v - chord.centre) <= chord.length);
    *x = inside ? *x : -*x;
    return inside ? moved : u;
}

/* Maps a packet of tuples (a, b, c, d) of optics that are cs_is_wide at this blur. */
static inline cs_camera_sample cs_wide_map(cs_vfloat a, cs_vfloat b, cs_vfloat c, cs_vfloat d,
                                           const cs_optics *optics, cs_optics_table table,
                                           cs_blur blur)
{
    int is_box = optics->filter_steps == 1u;
    int is_disk = optics->marginal == CS_MARGINAL_DISK;
    cs_marginal across = cs_marginal_across(optics, table);
    cs_camera_sample point;
    cs_wide_axis axis;
    cs_lens_point(a, b, optics, table, &point.u, &point.v);
    axis.blur = blur.sign * blur.x;
    axis.centre = (cs_vfloat)(0.0f);
    axis.length = 2.0f * cs_disk_chord(point.v);
    if (is_box && is_disk) {
        point.u = cs_slide_on_chord(axis, point.u, c, optics->filter_width, &point.x);
    } else {
        point.x = cs_filter_quantile(optics, table, c);
        point.u =
            is_disk ? cs_fold_at_rim(axis, point.u, &point.x)
                    : cs_fold_across(optics, table, &across, axis.blur, point.u, point.v, &point.x);
    }
    cs_chord chord = cs_chord_at(optics, table, &across, point.u);
    axis.blur = blur.sign * blur.y;
    axis.centre = chord.centre;
    axis.length = chord.length;
    if (is_box) {
        point.v = cs_slide_on_chord(axis, point.v, d, optics->filter_width, &point.y);
    } else {
        point.y = cs_filter_quantile(optics, table, d);
        point.v = cs_fold_at_rim(axis, point.v, &point.y);
    }
    point.x += 0.5f;
    point.y += 0.5f;
    return point;
}

#include "fp_contract_restore.h"

#endif
