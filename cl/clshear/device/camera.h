/* The thin-lens camera with its aperture and pixel filter, as samples see it. Shared. */
#ifndef CS_CAMERA_H
#define CS_CAMERA_H

#include "constants.h"
#include "dialect.h"

/* How (pixel, lens) tuples are slid along the fibres of the integrand. */
enum {
    CS_SHEAR_NONE = 0,
    CS_SHEAR_TOROIDAL = 1,
    CS_SHEAR_EQUAL_AREA = 2
};

/* How a lens coordinate is distributed. Kernels know apertures by the kind of u's marginal alone:
 * it says what the chord at u is as well. */
typedef enum cs_marginal_kind {
    CS_MARGINAL_UNIFORM = 0, /* on [-1/2, 1/2]; a square: all chords are alike */
    CS_MARGINAL_DISK = 1,    /* of the disk of area 1 */
    CS_MARGINAL_POLYGON = 2, /* of a convex polygon of area 1: tabulated by its chords */
    CS_MARGINAL_IMAGE = 3    /* of texels: tabulated, and v's marginal too for each column */
} cs_marginal_kind;

/* Shape of the aperture and the pixel filter. Lens coordinates (u, v) are centred; one unit of them
 * is cs_camera.aperture_width. */
typedef struct cs_optics {
    cs_u32 marginal;         /* cs_marginal_kind of u */
    cs_u32 closed;           /* box filter one pixel wide, square or disk: maps in closed form */
    cs_f32 squeeze;          /* width of the aperture as a part of what its shape says */
    cs_u32 filter_steps;     /* the filter is constant on each of these parts of its width */
    cs_f32 filter_width;     /* px */
    cs_f32 filter_deviation; /* standard deviation, px */
    cs_u32 segments[2];      /* of the profiles of u and of v given u, where they are tabulated */
    cs_f32 half_width[2];    /* largest |u| and largest |v| */
    cs_f32 deviation[2];     /* standard deviations of u and v */
} cs_optics;
CS_SHARED_WORDS(cs_optics, 12);

/* Pinhole frame and thin lens. World units; unit vectors. */
typedef struct cs_camera {
    cs_f32 eye[3];
    cs_f32 right[3];
    cs_f32 down[3];
    cs_f32 forward[3];
    cs_f32 focal_distance;
    cs_f32 pixel_width; /* of one pixel on the focal plane */
    cs_f32
        aperture_width;  /* side of a square or image aperture; of the square as large as others */
    cs_f32 centre_px[2]; /* raster coordinates of the optical axis */
    cs_optics optics;
} cs_camera;
CS_SHARED_WORDS(cs_camera, 29);

#endif
