/* Shears of (pixel, lens, time): measure-preserving maps of five numbers in [0, 1) to a point of
 * the pixel, a point of the lens and a time of the shutter.
 *
 * A surface that moves over the film by v pixels while the shutter is open, with the circle of
 * confusion s, shows the same point along the fibres x + s * u - v * time = const. The first two of
 * the five choose the fibre; the others move along it. Each map preserves measure for any v and s,
 * so that wrong ones raise the variance and leave the mean unbiased.
 *
 * chain       A square lens with a box filter, and no lens: along the axes (motion_boxes.h).
 * chords      Other squares, disks and polygons: along the motion (motion_chords.h).
 * time free   An image as a lens: the fibre leaks by v. */
#ifndef CLSHEAR_DEVICE_MOTION_H
#define CLSHEAR_DEVICE_MOTION_H

#include "motion_boxes.h"
#include "motion_chords.h"
#include "shear.h"

#include "fp_contract_off.h"

/* Whether the chain maps these optics and this blur. It is the better of two along the axes of the
 * film, which many edges follow. With as good as no lens, the aperture's shape does not matter. */
static inline int cs_has_chain(const cs_optics *optics, cs_blur blur, cs_f32 speed_px)
{
    int is_sharp = cs_max(blur.x, blur.y) < CS_LEAST_PART * cs_max(speed_px, 1.0f);
    return optics->has_closed_form && (is_sharp || optics->marginal == (cs_u32)CS_MARGINAL_UNIFORM);
}

/* Maps a packet of five numbers. tuple: film and lens, as for cs_shear. time: the fifth, in [0, 1).
 * velocity: of the surface on the film. The others as for cs_shear. */
static inline cs_moving_sample cs_shear_moving(cs_camera_sample tuple, cs_vfloat time, cs_u32 mode,
                                               const cs_optics *optics, cs_optics_table table,
                                               cs_f32 shear, cs_velocity velocity)
{
    cs_f32 speed_px = cs_max(cs_max(velocity.x, -velocity.x), cs_max(velocity.y, -velocity.y));
    cs_blur blur = cs_blur_of(shear, optics->squeeze);
    cs_moving_sample sample;
    if (mode != CS_SHEAR_EQUAL_AREA || speed_px < CS_LEAST_MOTION || !cs_has_stretch(optics)) {
        sample.point = cs_shear(tuple.x, tuple.y, tuple.u, tuple.v, mode, optics, table, shear);
        sample.time = time;
        return sample;
    }
    if (cs_has_chain(optics, blur, speed_px)) {
        sample = cs_moving_boxes(tuple, time, blur, velocity);
        if (optics->marginal == (cs_u32)CS_MARGINAL_DISK)
            cs_disk_from_square(&sample.point.u, &sample.point.v);
    } else {
        sample = cs_moving_chords(tuple, time, optics, table, blur, velocity);
    }
    cs_clamp_to_filter(optics, &sample.point);
    return sample;
}

#include "fp_contract_restore.h"

#endif
