/* A disk and a box in time: the exact map of two numbers to the fibre of lens and time, and of a
 * third to the place on it.
 *
 * (U, V) is uniform on the disk of area 1 and T on [0, 1]. The fibre is p = U + rate_u * T and
 * q = V + rate_v * T: Rosenblatt's transform in the order p, q | p. p is the sum of a box and the
 * disk's marginal (disk.h). Given p, (U, V) is uniform on a slab of the disk, and q is up to a
 * constant V - slope * U there. */
#ifndef CLSHEAR_DEVICE_DISK_TIME_H
#define CLSHEAR_DEVICE_DISK_TIME_H

#include "boxes.h"
#include "disk.h"
#include "timed_place.h"

#include "fp_contract_off.h"

enum {
    CS_FIBRE_STEPS = 2, /* Halley's steps towards p, at most */
    CS_SLANT_STEPS = 3  /* towards q, at most */
};

/* The part of the disk between two values of u. */
typedef struct cs_slab_of_times {
    cs_vfloat low; /* lens units, -CS_DISK_RADIUS or more */
    cs_vfloat high;
    cs_vfloat low_mass; /* P(U < low) */
    cs_vfloat high_mass;
} cs_slab_of_times;

/* The line v = offset + slope * u in it. */
typedef struct cs_slant {
    cs_vfloat first;  /* u where the line enters the slab or the disk */
    cs_vfloat last;   /* u where it leaves them */
    cs_vfloat below;  /* area of the slab below the line; the disk's is 1 */
    cs_vfloat change; /* derivative of last - first by the offset */
} cs_slant;

CS_INLINED cs_slant cs_slant_at(const cs_slab_of_times *slab, cs_vfloat slope, cs_vfloat offset)
{
    cs_vfloat stretch = 1.0f + slope * slope, inverse = 1.0f / stretch;
    cs_vfloat square = (CS_DISK_RADIUS * CS_DISK_RADIUS) * stretch - offset * offset;
    cs_vfloat root = cs_sqrt(cs_max(square, (cs_vfloat)(1e-14f)));
    cs_vfloat enters = (-slope * offset - root) * inverse;
    cs_vfloat leaves = (root - slope * offset) * inverse;
    cs_slant at;
    at.first = cs_clamp(enters, slab->low, slab->high);
    at.last = cs_clamp(leaves, slab->low, slab->high);
    cs_vfloat first_mass = cs_disk_cdf(at.first), last_mass = cs_disk_cdf(at.last);
    /* Beside the line's chord, all of the disk is below the line or none of it. */
    cs_vfloat left =
        offset + slope * enters > 0.0f ? first_mass - slab->low_mass : (cs_vfloat)(0.0f);
    cs_vfloat right =
        offset + slope * leaves > 0.0f ? slab->high_mass - last_mass : (cs_vfloat)(0.0f);
    cs_vfloat middle = offset + 0.5f * slope * (at.first + at.last);
    at.below = left + right + middle * (at.last - at.first) + 0.5f * (last_mass - first_mass);
    cs_vfloat turn = offset * inverse / root;
    cs_vfloat none = (cs_vfloat)(0.0f);
    at.change = (at.last == leaves ? -slope * inverse - turn : none) -
                (at.first == enters ? turn - slope * inverse : none);
    return at;
}

/* The line of this slope that has the part `mass`, in (0, 1/2], of the slab below it. */
CS_INLINED cs_slant cs_slant_of(const cs_slab_of_times *slab, cs_vfloat slope, cs_vfloat mass,
                                cs_vfloat *offset)
{
    cs_vfloat area = cs_max(slab->high_mass - slab->low_mass, (cs_vfloat)(1e-9f));
    cs_vfloat scale = 1.0f / area, root = cs_sqrt(mass);
    cs_vfloat width = slab->high - slab->low, middle = 0.5f * (slab->low + slab->high);
    cs_vfloat norm = cs_sqrt(1.0f + slope * slope);
    cs_vfloat lowest = cs_clamp(slope * CS_DISK_RADIUS / norm, slab->low, slab->high);
    cs_vfloat chord =
        cs_sqrt(cs_max((CS_DISK_RADIUS - lowest) * (CS_DISK_RADIUS + lowest), (cs_vfloat)(0.0f)));
    cs_vfloat least = -chord - slope * lowest;
    /* The guess takes the slab for a parallelogram of its area. */
    cs_vfloat height = area / cs_max(width, (cs_vfloat)(1e-6f));
    cs_vfloat rise = cs_abs(slope) * width;
    cs_two_boxes boxes = cs_two_boxes_of(height, cs_max(rise, (cs_vfloat)(1e-6f)));
    *offset = cs_two_boxes_quantile(boxes, mass) - 0.5f * (height + rise) - slope * middle;
    *offset = cs_max(*offset, least + 0.02f * height);
    cs_vint rough = mass >= 0.0f;
    for (int step = 0; step < CS_SLANT_STEPS && cs_any(rough); step++) {
        cs_slant at = cs_slant_at(slab, slope, *offset);
        cs_root_step move = cs_root_step_of(root, scale * at.below, scale * (at.last - at.first),
                                            scale * at.change);
        /* Never all the way to the end, where the slope says nothing. */
        cs_vfloat end = least + 0.1f * (*offset - least);
        cs_vfloat next = cs_clamp(*offset - move.back, end, (cs_vfloat)(4.0f));
        *offset = rough ? next : *offset;
        rough = move.rough;
    }
    return cs_slant_at(slab, slope, *offset);
}

/* The map. across, beside, along: in [0, 1). rate_u: above 0; rate_v: in [0, rate_u]. */
static inline cs_timed_place cs_disk_and_time(cs_vfloat across, cs_vfloat beside, cs_vfloat along,
                                              cs_f32 rate_u, cs_f32 rate_v)
{
    cs_f32 blur = 1.0f / rate_u, slope = rate_v / rate_u;
    cs_vfloat mass = cs_disk_fibre_mass(across), root = cs_sqrt(mass);
    cs_vfloat t = cs_disk_fibre_guess(mass, blur);
    cs_vint rough = mass >= 0.0f;
    for (int step = 0; step < CS_FIBRE_STEPS && cs_any(rough); step++) {
        cs_vint again;
        cs_vfloat next = cs_disk_fibre_step(t, root, blur, &again);
        t = rough ? next : t;
        rough = again;
    }
    t = across > 0.5f ? -t : t; /* p = rate_u * (t + 1/2) */
    cs_slab_of_times slab;
    cs_vfloat edge = (cs_vfloat)(CS_DISK_RADIUS);
    slab.low = cs_clamp(rate_u * (t - 0.5f), -edge, edge);
    slab.high = cs_clamp(rate_u * (t + 0.5f), slab.low, edge);
    slab.low_mass = cs_disk_cdf(slab.low);
    slab.high_mass = cs_disk_cdf(slab.high);
    cs_vint mirror = beside > 0.5f; /* of v */
    cs_vfloat slant = mirror ? (cs_vfloat)(-slope) : (cs_vfloat)(slope);
    cs_vfloat part = cs_max(mirror ? 1.0f - beside : beside, (cs_vfloat)(1e-7f));
    cs_vfloat offset;
    cs_slant line = cs_slant_of(&slab, slant, part, &offset);
    cs_timed_place point;
    point.x = line.first + (line.last - line.first) * along;
    cs_vfloat square = (CS_DISK_RADIUS - point.x) * (CS_DISK_RADIUS + point.x);
    cs_vfloat chord = cs_sqrt(cs_max(square, (cs_vfloat)(0.0f)));
    point.y = cs_clamp(offset + slant * point.x, -chord, chord);
    point.y = mirror ? -point.y : point.y;
    point.time = cs_clamp(t + 0.5f - blur * point.x, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
    return point;
}

#include "fp_contract_restore.h"

#endif
