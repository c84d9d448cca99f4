/* Shears: measure-preserving maps of a tuple ((a, b), (c, d)) in [0, 1)^4 to a point of the pixel
 * and a point of the lens.
 *
 * A surface at one depth shows the same point along the fibres x + s * u = const of the (pixel,
 * lens) domain, where s, in pixels per unit of aperture width, is the signed circle of confusion
 * (docs/method.md). `toroidal` slides points along the fibres and wraps them around (Singh & Jarosz
 * 2017, section 5). `equal area` maps without wrapping, by Rosenblatt's transform: the fibre
 * coordinate x + s * u depends on the tuple's first pair alone, the second pair moves along the
 * fibre. Disks and polygons have a map that is nearly so, and quick (chord_map.h); a disk with a
 * box filter has an exact one too, which blurs below CS_EXACT_DISK_BLUR take (disk_map.h).
 *
 * Programs call cs_shear. Those that map several packets at once, which is faster for a disk, call
 * cs_shear_alone for each of them and then cs_shear_together once. */
#ifndef CLSHEAR_DEVICE_SHEAR_H
#define CLSHEAR_DEVICE_SHEAR_H

#include "camera.h"
#include "camera_sample.h"
#include "chord_map.h"
#include "disk_map.h"
#include "fibre.h"
#include "packet.h"

#include "fp_contract_off.h"

/* One axis of the equal-area map for a pixel of width 1 and a blur of width `blur` > 0: `across` in
 * [0, 1) picks the fibre, `along` in [0, 1) the place on it; returns x in [0, 1] through `x` and
 * the lens coordinate in [0, 1] as value.
 *
 * t = x + blur * lens is a sum of two uniform variables; its density is a trapezoid whose inverse
 * cumulative distribution is closed. Below blur 1 the lens coordinate is drawn first, which keeps
 * the map well conditioned down to a pixel in focus. */
static inline cs_vfloat cs_trapezoid(cs_vfloat across, cs_vfloat along, cs_f32 blur, cs_vfloat *x)
{
    cs_f32 narrow = cs_min(blur, 1.0f);
    cs_f32 wide = cs_max(blur, 1.0f);
    cs_f32 ramp = 0.5f * narrow / wide;
    cs_f32 inverse = 1.0f / blur;
    cs_vfloat mirrored = cs_min(across, 1.0f - across);
    cs_vfloat rising = cs_sqrt(2.0f * narrow * wide * mirrored);
    cs_vfloat flat = narrow + (across - ramp) * wide;
    cs_vfloat t = across > 0.5f ? 1.0f + blur - rising : rising;
    t = mirrored < ramp ? t : flat;
    if (blur < 1.0f) {
        cs_vfloat low = cs_max((t - 1.0f) * inverse, (cs_vfloat)(0.0f));
        cs_vfloat high = cs_min(t * inverse, (cs_vfloat)(1.0f));
        cs_vfloat lens = low + (high - low) * (1.0f - along);
        *x = t - blur * lens;
        return lens;
    }
    cs_vfloat low = cs_max(t - blur, (cs_vfloat)(0.0f));
    cs_vfloat high = cs_min(t, (cs_vfloat)(1.0f));
    *x = low + (high - low) * along;
    return (t - *x) * inverse;
}

/* The equal-area map of a square with a box filter one pixel wide. a, b, c, d: the tuple. */
static inline cs_camera_sample cs_equal_area_square(cs_vfloat a, cs_vfloat b, cs_vfloat c,
                                                    cs_vfloat d, cs_blur blur)
{
    cs_camera_sample point;
    point.u = blur.sign * (cs_trapezoid(a, c, blur.x, &point.x) - 0.5f);
    point.v = blur.sign * (cs_trapezoid(b, d, blur.y, &point.y) - 0.5f);
    return point;
}

/* The equal-area map of squares and images with any filter, in the order t_x, u | t_x, t_y | u, v |
 * t_y, u: but for a square, of one chord everywhere, the second pair moves t_y a little. */
static inline cs_camera_sample cs_equal_area_any(cs_vfloat a, cs_vfloat b, cs_vfloat c, cs_vfloat d,
                                                 const cs_optics *optics, cs_optics_table table,
                                                 cs_blur blur)
{
    int negative = blur.sign < 0.0f;
    cs_marginal across = cs_marginal_across(optics, table);
    cs_fibre_axis axis;
    axis.optics = optics;
    axis.table = table;
    axis.marginal = &across;
    axis.blur = (cs_vfloat)(blur.x);
    axis.inverse = (cs_vfloat)(1.0f / blur.x);
    cs_camera_sample point;
    point.u = cs_fibre_map(axis, a, c, negative, &point.x);
    cs_chord chord = cs_chord_at(optics, table, &across, point.u);
    axis.marginal = &chord.marginal;
    axis.blur = cs_max(blur.y * chord.length, (cs_vfloat)(CS_LEAST_BLUR));
    axis.inverse = 1.0f / axis.blur;
    point.v = cs_fibre_map(axis, b, d, negative, &point.y);
    point.v = chord.centre + chord.length * point.v;
    point.x += 0.5f;
    point.y += 0.5f;
    return point;
}

/* The point of film and lens that a tuple (a, b, c, d) stands for without any shear. */
static inline cs_camera_sample cs_unsheared(cs_vfloat a, cs_vfloat b, cs_vfloat c, cs_vfloat d,
                                            const cs_optics *optics, cs_optics_table table)
{
    cs_camera_sample point;
    cs_lens_point(c, d, optics, table, &point.u, &point.v);
    point.x = a;
    point.y = b;
    if (optics->has_closed_form) return point;
    point.x = cs_filter_quantile(optics, table, a) + 0.5f;
    point.y = cs_filter_quantile(optics, table, b) + 0.5f;
    return point;
}

/* Fractional part in [0, 1); rounding must not return 1. */
static inline cs_vfloat cs_wrap(cs_vfloat value)
{
    cs_vfloat fraction = value - cs_floor(value);
    return cs_min(fraction, (cs_vfloat)(0.99999994f));
}

/* One axis of the toroidal shear; `half_chord` is half the aperture's width at the other lens
 * coordinate. Shears the pixel coordinate for |shear| <= 1 and the lens coordinate beyond. */
static inline void cs_toroidal_axis(cs_vfloat *x, cs_vfloat *u, cs_vfloat half_chord, cs_f32 shear)
{
    if (shear >= -1.0f && shear <= 1.0f) {
        *x = cs_wrap(*x - shear * *u);
        return;
    }
    cs_vfloat width = cs_max(2.0f * half_chord, (cs_vfloat)(1e-6f));
    cs_vfloat place = (*u - (*x - 0.5f) * (1.0f / shear)) / width + 0.5f;
    *u = (cs_wrap(place) - 0.5f) * width;
}

/* Half the width of a disk or a square at the coordinate `other` of the other axis. */
static inline cs_vfloat cs_half_chord(cs_vfloat other, cs_u32 marginal)
{
    if (marginal == CS_MARGINAL_UNIFORM) return (cs_vfloat)(0.5f);
    return cs_sqrt(cs_max(CS_DISK_RADIUS * CS_DISK_RADIUS - other * other, (cs_vfloat)(0.0f)));
}

/* The toroidal shear of a tuple. `optics` must have a closed form; `shear` is in pixels per unit of
 * v. */
static inline cs_camera_sample cs_toroidal(cs_vfloat a, cs_vfloat b, cs_vfloat c, cs_vfloat d,
                                           const cs_optics *optics, cs_optics_table table,
                                           cs_f32 shear)
{
    cs_u32 marginal = optics->marginal;
    cs_camera_sample point = cs_unsheared(a, b, c, d, optics, table);
    cs_toroidal_axis(&point.x, &point.u, cs_half_chord(point.v, marginal), shear * optics->squeeze);
    cs_toroidal_axis(&point.y, &point.v, cs_half_chord(point.u, marginal), shear);
    return point;
}

/* Blur, in pixels per unit of the lens's width along its narrower axis, up to which a disk with a
 * box filter one pixel wide is mapped exactly. Beyond, the quick map moves the fibre so little that
 * the exact one is not worth its time (docs/notes/lenses.md). */
#ifndef CS_EXACT_DISK_BLUR
#define CS_EXACT_DISK_BLUR 5.0f
#endif

/* Whether cs_shear_together does the mapping, which is so for the equal-area shear of a disk with a
 * box filter one pixel wide where the blur is narrow; otherwise cs_shear_alone does it. */
static inline int cs_shears_together(cs_u32 mode, const cs_optics *optics, cs_f32 shear)
{
    cs_blur blur = cs_blur_of(shear, optics->squeeze);
    return mode == CS_SHEAR_EQUAL_AREA && optics->has_closed_form &&
           optics->marginal == CS_MARGINAL_DISK && cs_min(blur.x, blur.y) < CS_EXACT_DISK_BLUR;
}

/* Keeps a point inside the width of the filter, which rounding may leave. */
static inline void cs_clamp_to_filter(const cs_optics *optics, cs_camera_sample *point)
{
    cs_vfloat first = (cs_vfloat)(0.5f - 0.5f * optics->filter_width);
    cs_vfloat last = (cs_vfloat)(0.5f * optics->filter_width + 0.49999994f);
    point->x = cs_clamp(point->x, first, last);
    point->y = cs_clamp(point->y, first, last);
}

/* Maps a packet of tuples, unless cs_shears_together.
 *
 * p: the tuple, four coordinates in [0, 1). mode: a CS_SHEAR_ constant; CS_SHEAR_TOROIDAL only for
 * optics that have a closed form. table: the lens table of the optics. shear: signed circle of
 * confusion, in pixels per unit of v, finite; 0 in focus (cs_shear_of_depth). */
static inline cs_camera_sample cs_shear_alone(cs_camera_sample p, cs_u32 mode,
                                              const cs_optics *optics, cs_optics_table table,
                                              cs_f32 shear)
{
    cs_blur blur = cs_blur_of(shear, optics->squeeze);
    if (cs_shears_together(mode, optics, shear)) return p;
    if (mode == CS_SHEAR_NONE)
        p = cs_unsheared(p.x, p.y, p.u, p.v, optics, table);
    else if (mode == CS_SHEAR_TOROIDAL)
        p = cs_toroidal(p.x, p.y, p.u, p.v, optics, table, shear);
    else if (cs_has_chord_map(optics))
        p = cs_chord_map(p.x, p.y, p.u, p.v, optics, table, blur);
    else if (!optics->has_closed_form)
        p = cs_equal_area_any(p.x, p.y, p.u, p.v, optics, table, blur);
    else
        p = cs_equal_area_square(p.x, p.y, p.u, p.v, blur);
    cs_clamp_to_filter(optics, &p);
    return p;
}

/* Maps each packet of `points` for which cs_shears_together is true, in place, and leaves the
 * others as cs_shear_alone made them. count: packets, 1 to CS_TOGETHER. shears: of each packet,
 * pixels. */
static inline void cs_shear_together(cs_camera_sample *points, const cs_f32 *shears, int count,
                                     cs_u32 mode, const cs_optics *optics)
{
    for (int first = 0, end = 0; first < count; first = end + 1) {
        for (end = first; end < count; end++)
            if (!cs_shears_together(mode, optics, shears[end])) break;
        if (end > first) cs_disk_map(points + first, shears + first, end - first, optics->squeeze);
        for (int k = first; k < end; k++)
            cs_clamp_to_filter(optics, points + k);
    }
}

/* Maps the tuples (a, b, c, d) of one packet to points of film and lens. The other arguments are
 * those of cs_shear_alone. All modes keep measure: the mean of a function of the points is the
 * same, its variance is not. */
static inline cs_camera_sample cs_shear(cs_vfloat a, cs_vfloat b, cs_vfloat c, cs_vfloat d,
                                        cs_u32 mode, const cs_optics *optics, cs_optics_table table,
                                        cs_f32 shear)
{
    cs_camera_sample point;
    point.x = a;
    point.y = b;
    point.u = c;
    point.v = d;
    point = cs_shear_alone(point, mode, optics, table, shear);
    cs_shear_together(&point, &shear, 1, mode, optics);
    return point;
}

#include "fp_contract_restore.h"

#endif
