/* The thin-lens camera with its aperture and pixel filter, as samples see it. */
#ifndef CLSHEAR_DEVICE_CAMERA_H
#define CLSHEAR_DEVICE_CAMERA_H

#include "constants.h"
#include "dialect.h"

#include "fp_contract_off.h"

/* Modes of the shear: how (pixel, lens) tuples are moved along the fibres of the integrand. */
enum {
    CS_SHEAR_NONE = 0,      /* not at all */
    CS_SHEAR_TOROIDAL = 1,  /* along the fibre, wrapped around; only for optics in closed form */
    CS_SHEAR_EQUAL_AREA = 2 /* the first pair chooses the fibre, the second the place on it */
};

/* Distribution of a lens coordinate. Kernels tell apertures apart by the kind of u's marginal
 * alone; it determines the length of the chord at u, too. */
typedef enum cs_marginal_kind {
    CS_MARGINAL_UNIFORM = 0, /* on [-1/2, 1/2]; a square: all chords are alike */
    CS_MARGINAL_DISK = 1,    /* of the disk of area 1 */
    CS_MARGINAL_POLYGON = 2, /* of a convex polygon of area 1: tabulated by its chords */
    CS_MARGINAL_IMAGE = 3    /* of texels: tabulated, and v's marginal too for each column */
} cs_marginal_kind;

/* Shape of the aperture and the pixel filter. Make it by clshear_lens_optics.
 *
 * Lens coordinates (u, v) have their origin in the middle of the lens; u points right and v down.
 * Their unit is cs_camera.aperture_width. They describe the aperture before the squeeze. */
typedef struct cs_optics {
    cs_u32 marginal;         /* cs_marginal_kind of u */
    cs_u32 has_closed_form;  /* 1 for a disk or a square with a box filter one pixel wide, else 0 */
    cs_f32 squeeze;          /* width of the aperture over the width of its shape, above 0 */
    cs_u32 filter_steps;     /* parts of the filter's width on which it is constant, 1 or 16 */
    cs_f32 filter_width;     /* pixels, 0.01 to 64 */
    cs_f32 filter_deviation; /* standard deviation of the filter, pixels */
    cs_u32 segments[2];      /* rows but one of the tabulated marginals of u, and of v given u */
    cs_f32 half_width[2];    /* largest |u| and largest |v|, lens units */
    cs_f32 deviation[2];     /* standard deviations of u and of v, lens units */
} cs_optics;
CS_SHARED_WORDS(cs_optics, 12);

/* A thin-lens camera. Make it by clshear_lens_camera. Lengths are in units of the scene.
 *
 * An orthographic camera has parallel lines of sight, each through the middle of a lens of its own:
 * a telecentric lens. Its lenses lie in the plane of the eye. */
typedef struct cs_camera {
    cs_f32 eye[3];         /* centre of the lens */
    cs_f32 right[3];       /* unit vector along the image's rows */
    cs_f32 down[3];        /* unit vector along the image's columns */
    cs_f32 forward[3];     /* unit vector along the optical axis */
    cs_f32 focal_distance; /* camera depth of the focal plane on the optical axis, above 0 */
    cs_f32 pixel_width;    /* width of a pixel at that depth */
    cs_f32 aperture_width; /* length of one unit of the lens coordinates; 0 for a pinhole */
    cs_f32 centre_px[2];   /* raster coordinates of the optical axis, pixels */
    cs_u32 orthographic;   /* 1: lines of sight are parallel; 0: they meet in the eye */
    cs_f32 rise[2];        /* slopes of the focal plane on the optical axis, to the right and down:
                              change of its depth over pixel_width, in focal distances. 0, 0 is
                              perpendicular to the axis */
    cs_optics optics;      /* aperture and filter */
} cs_camera;
CS_SHARED_WORDS(cs_camera, 32);

#include "fp_contract_restore.h"

#endif
