/* A camera with its lens, as the settings or a scene file have it. */
#ifndef CS_OPTICS_VIEW_H
#define CS_OPTICS_VIEW_H

#include "base/status.h"
#include "clshear/choices.h"

/* How much light passes where, seen from behind the lens; rows from the top. Start from zeros. */
typedef struct cs_aperture_image {
    float *luminance; /* 0 or more, not all 0; only ratios count; owned */
    int width;        /* 1 to 256 each */
    int height;
} cs_aperture_image;

typedef struct cs_view {
    float eye[3];
    float target[3];
    float up[3];
    float fov_deg;        /* along the shorter image axis, in (0, 180) */
    float lens_radius;    /* world units; 0: pinhole */
    float focal_distance; /* camera depth of the focal plane, world units */
    clshear_aperture aperture;
    int blades;                     /* corners of the polygon, 3 to 32 */
    float blade_rotation_deg;       /* anticlockwise as seen; at 0 a corner is on the right */
    const cs_aperture_image *image; /* of an image aperture; not owned */
    float anamorphic;               /* the aperture is this many times narrower; 0 counts as 1 */
} cs_view;

/* Reads the luminance of an image file, reduced to at most 256 x 256. */
clshear_status cs_aperture_image_read(const char *path, cs_aperture_image *image, cs_error *error);
clshear_status cs_aperture_image_check(const cs_aperture_image *image, cs_error *error);
clshear_status cs_aperture_image_copy(const cs_aperture_image *from, cs_aperture_image *to,
                                      cs_error *error);
void cs_aperture_image_free(cs_aperture_image *image);

#endif
