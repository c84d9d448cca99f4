/* Chords of the pixel and of the aperture in any direction: how far a point can move along a line
 * without leaving them. */
#ifndef CLSHEAR_DEVICE_STRETCH_H
#define CLSHEAR_DEVICE_STRETCH_H

#include "camera_sample.h"
#include "fibre.h"

#include "fp_contract_off.h"

/* A chord through a point inside of a convex shape, as distances from the point along a line. */
typedef struct cs_stretch {
    cs_vfloat low;  /* 0 or less */
    cs_vfloat high; /* 0 or more */
} cs_stretch;

/* A direction on the film, and the direction on the lens that moves the image along it. */
typedef struct cs_heading {
    cs_f32 x; /* unit vector on the film */
    cs_f32 y;
    cs_f32 u; /* unit vector on the lens */
    cs_f32 v;
    cs_f32 blur; /* pixels on the film per lens unit along them, above 0 */
} cs_heading;

/* The heading (x, y), a unit vector on the film. */
static inline cs_heading cs_heading_of(cs_f32 x, cs_f32 y, cs_blur blur)
{
    cs_heading to;
    cs_f32 u = blur.sign * x * blur.y, v = blur.sign * y * blur.x;
    cs_f32 length = cs_sqrt(u * u + v * v);
    to.x = x;
    to.y = y;
    to.u = u / length;
    to.v = v / length;
    to.blur = blur.x * blur.y / length;
    return to;
}

/* Cuts a stretch at a straight side which is `room` away from the point, 0 or more, and comes
 * nearer by `rate` for each unit along the line. */
static inline void cs_cut(cs_stretch *stretch, cs_vfloat room, cs_f32 rate)
{
    cs_vfloat left = cs_max(room, (cs_vfloat)(0.0f));
    if (rate > 1e-6f) stretch->high = cs_min(stretch->high, left * (1.0f / rate));
    if (rate < -1e-6f) stretch->low = cs_max(stretch->low, left * (1.0f / rate));
}

/* The chord of a polygon. Its rows have a lower and an upper side each. */
static inline void cs_cut_to_polygon(cs_stretch *stretch, const cs_marginal *across, cs_vfloat u,
                                     cs_vfloat v, cs_heading to)
{
    cs_optics_table row = across->rows;
    for (cs_u32 i = 0u; i < across->segments; i++) {
        cs_f32 low_slope = row[CS_MARGINAL_LOW_SLOPE];
        cs_f32 high_slope = low_slope + row[CS_MARGINAL_SLOPE];
        cs_vfloat step = u - row[CS_MARGINAL_START];
        cs_vfloat above = v - (row[CS_MARGINAL_LOW] + low_slope * step);
        cs_vfloat high = row[CS_MARGINAL_LOW] + row[CS_MARGINAL_DENSITY] + high_slope * step;
        cs_cut(stretch, above, low_slope * to.u - to.v);
        cs_cut(stretch, high - v, to.v - high_slope * to.u);
        row += CS_MARGINAL_COLUMNS;
    }
    cs_cut(stretch, u - across->low, -to.u);
    cs_cut(stretch, across->high - u, to.u);
}

/* Whether cs_lens_stretch knows the aperture. */
static inline int cs_has_stretch(const cs_optics *optics)
{
    return optics->marginal != (cs_u32)CS_MARGINAL_IMAGE;
}

/* The chord of an aperture that is no image, in lens units from (u, v), a point of it. */
static inline cs_stretch cs_lens_stretch(const cs_optics *optics, cs_optics_table table,
                                         cs_vfloat u, cs_vfloat v, cs_heading to)
{
    cs_stretch stretch;
    if (optics->marginal == (cs_u32)CS_MARGINAL_DISK) {
        cs_vfloat beside = u * to.v - v * to.u, ahead = u * to.u + v * to.v;
        cs_vfloat square = (CS_DISK_RADIUS - beside) * (CS_DISK_RADIUS + beside);
        cs_vfloat reach = cs_max(cs_sqrt(cs_max(square, (cs_vfloat)(0.0f))), cs_abs(ahead));
        stretch.low = -reach - ahead;
        stretch.high = reach - ahead;
        return stretch;
    }
    stretch.low = (cs_vfloat)(-4.0f);
    stretch.high = (cs_vfloat)(4.0f);
    if (optics->marginal == (cs_u32)CS_MARGINAL_POLYGON) {
        cs_marginal across = cs_marginal_across(optics, table);
        cs_cut_to_polygon(&stretch, &across, u, v, to);
        return stretch;
    }
    cs_cut(&stretch, 0.5f + u, -to.u);
    cs_cut(&stretch, 0.5f - u, to.u);
    cs_cut(&stretch, 0.5f + v, -to.v);
    cs_cut(&stretch, 0.5f - v, to.v);
    return stretch;
}

/* The chord of a rectangle of the film around the pixel's centre, in pixels from (x, y), a point of
 * it. width, height: pixels, at most 64. */
static inline cs_stretch cs_film_stretch(cs_vfloat width, cs_vfloat height, cs_vfloat x,
                                         cs_vfloat y, cs_heading to)
{
    cs_stretch stretch;
    stretch.low = (cs_vfloat)(-128.0f);
    stretch.high = (cs_vfloat)(128.0f);
    cs_cut(&stretch, 0.5f * width + x, -to.x);
    cs_cut(&stretch, 0.5f * width - x, to.x);
    cs_cut(&stretch, 0.5f * height + y, -to.y);
    cs_cut(&stretch, 0.5f * height - y, to.y);
    return stretch;
}

#include "fp_contract_restore.h"

#endif
