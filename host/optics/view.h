/* A camera with its lens. */
#ifndef CS_OPTICS_VIEW_H
#define CS_OPTICS_VIEW_H

#include "base/status.h"
#include "clshear/choices.h"

/* Transmittance of the aperture, seen from behind the lens, rows from the top. Initialise to
 * zero. */
typedef struct cs_aperture_image {
    float *luminance; /* values 0 or more, with a sum above 0; only ratios matter; owned */
    int width;        /* 1 to 256 */
    int height;
} cs_aperture_image;

typedef struct cs_view {
    float eye[3];
    float target[3];
    float up[3];
    float fov_deg;        /* degrees along the shorter image axis, in (0, 180) */
    float orthographic;   /* length that the shorter image axis shows, world units, along parallel
                             lines of sight; 0: they meet in the eye and spread by fov_deg */
    float lens_radius;    /* world units; 0: pinhole */
    float focal_distance; /* depth of the focal plane on the optical axis, world units */
    float tilt_deg[2];    /* azimuth and elevation of the side to which the focal plane faces, as
                             the camera sees it; 0, 0: it faces the camera */
    clshear_aperture aperture;
    int blades;                     /* corners of a polygonal aperture, 3 to 32 */
    float blade_rotation_deg;       /* anticlockwise in the picture; 0 puts a corner on the right */
    const cs_aperture_image *image; /* transmittance of an image aperture; not owned */
    float anamorphic;               /* ratio that narrows the aperture in x; 0 counts as 1 */
} cs_view;

/* Reads the luminance of an image file, reduced to at most 256 x 256. */
clshear_status cs_aperture_image_read(const char *path, cs_aperture_image *image, cs_error *error);
clshear_status cs_aperture_image_check(const cs_aperture_image *image, cs_error *error);
clshear_status cs_aperture_image_copy(const cs_aperture_image *from, cs_aperture_image *to,
                                      cs_error *error);
void cs_aperture_image_free(cs_aperture_image *image);

#endif
