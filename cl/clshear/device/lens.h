/* From a point of the film and a point of the lens to a ray: the thin lens. */
#ifndef CLSHEAR_DEVICE_LENS_H
#define CLSHEAR_DEVICE_LENS_H

#include "camera.h"
#include "packet.h"

#include "fp_contract_off.h"

typedef struct cs_ray {
    cs_vfloat origin[3];    /* on the lens, units of the scene */
    cs_vfloat direction[3]; /* not a unit vector: its part along the camera's forward axis is 1 */
} cs_ray;

/* Where a ray leaves the lens, and its direction, along the camera's axes. */
typedef struct cs_lens_place {
    cs_vfloat lens_right; /* from the middle of the lens, units of the scene */
    cs_vfloat lens_down;
    cs_vfloat right; /* part of the direction, whose part along `forward` is 1 */
    cs_vfloat down;
} cs_lens_place;

/* Arguments as for cs_lens_ray. */
static inline cs_lens_place cs_lens_place_of(const cs_camera *camera, cs_vfloat x, cs_vfloat y,
                                             cs_vfloat u, cs_vfloat v)
{
    cs_f32 inverse_focus = 1.0f / camera->focal_distance;
    cs_lens_place place;
    place.lens_right = u * (camera->aperture_width * camera->optics.squeeze);
    place.lens_down = v * camera->aperture_width;
    place.right =
        ((x - camera->centre_px[0]) * camera->pixel_width - place.lens_right) * inverse_focus;
    place.down =
        ((y - camera->centre_px[1]) * camera->pixel_width - place.lens_down) * inverse_focus;
    return place;
}

/* The ray that leaves the lens at (u, v) and belongs to raster position (x, y).
 *
 * x, y: pixels from the image's top left corner: the pixel's number plus cs_camera_sample.x or y.
 * u, v: cs_camera_sample.u and v. All rays of one (x, y) meet on the focal plane. A distance along
 * the ray, in lengths of its direction, is a camera depth. */
static inline cs_ray cs_lens_ray(cs_camera camera, cs_vfloat x, cs_vfloat y, cs_vfloat u,
                                 cs_vfloat v)
{
    cs_lens_place place = cs_lens_place_of(&camera, x, y, u, v);
    cs_ray ray;
    for (int axis = 0; axis < 3; axis++) {
        ray.origin[axis] = camera.eye[axis] + place.lens_right * camera.right[axis] +
                           place.lens_down * camera.down[axis];
        ray.direction[axis] = camera.forward[axis] + place.right * camera.right[axis] +
                              place.down * camera.down[axis];
    }
    return ray;
}

/* The shear for a surface at camera depth `depth`, above 0: its signed circle of confusion, in
 * pixels per lens unit. It is positive in front of the focal plane and negative behind it. A point
 * that is seen at raster (x, y) through (u, v) is seen through the middle of the lens at (x + shear
 * * squeeze * u, y + shear * v). */
static inline cs_f32 cs_shear_of_depth(cs_camera camera, cs_f32 depth)
{
    return camera.aperture_width / camera.pixel_width * (camera.focal_distance / depth - 1.0f);
}

#include "fp_contract_restore.h"

#endif
