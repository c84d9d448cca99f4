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

/* Depth of the focal plane at raster position (x, y), relative to that on the optical axis, is
 * 1 / (1 - rise) in perspective, where lines of sight spread, and 1 + rise for parallel ones. This
 * is the rise, of scalars as of packets; 0 unless the plane is tilted. */
#define CS_RISE(camera, x, y)                           \
    (((x) - (camera).centre_px[0]) * (camera).rise[0] + \
     ((y) - (camera).centre_px[1]) * (camera).rise[1])

/* Where a ray leaves the lens, and its direction, along the camera's axes. */
typedef struct cs_lens_place {
    cs_vfloat lens_right; /* from the camera's eye, units of the scene */
    cs_vfloat lens_down;
    cs_vfloat right; /* part of the direction, whose part along `forward` is 1 */
    cs_vfloat down;
} cs_lens_place;

/* Arguments as for cs_lens_ray. */
static inline cs_lens_place cs_lens_place_of(const cs_camera *camera, cs_vfloat x, cs_vfloat y,
                                             cs_vfloat u, cs_vfloat v)
{
    cs_vfloat rise = CS_RISE(*camera, x, y);
    cs_vfloat right = (x - camera->centre_px[0]) * camera->pixel_width;
    cs_vfloat down = (y - camera->centre_px[1]) * camera->pixel_width;
    cs_f32 inverse_focus = 1.0f / camera->focal_distance;
    cs_lens_place place;
    place.lens_right = u * (camera->aperture_width * camera->optics.squeeze);
    place.lens_down = v * camera->aperture_width;
    if (camera->orthographic) {
        cs_vfloat inverse = -inverse_focus / (1.0f + rise);
        place.right = place.lens_right * inverse;
        place.down = place.lens_down * inverse;
        place.lens_right += right;
        place.lens_down += down;
    } else {
        cs_vfloat nearness = 1.0f - rise;
        place.right = (right - place.lens_right * nearness) * inverse_focus;
        place.down = (down - place.lens_down * nearness) * inverse_focus;
    }
    return place;
}

/* The ray that leaves the lens at (u, v) and belongs to raster position (x, y).
 *
 * x, y: pixels from the image's top left corner: the pixel's number plus cs_camera_sample.x or y.
 * u, v: cs_camera_sample.u and v. All rays of one (x, y) meet on the focal plane. Where a tilted
 * plane lies behind the lens, it is their continuations backwards that do. A distance along the
 * ray, in lengths of its direction, is a camera depth. */
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

/* The shear for a surface at camera depth `depth`, above 0, around raster position (x, y): its
 * signed circle of confusion, in pixels per lens unit. It is positive in front of the focal plane
 * and negative behind it. A point that is seen at raster (x, y) through (u, v) is seen through the
 * middle of the lens at (x + shear * squeeze * u, y + shear * v). */
static inline cs_f32 cs_shear_at(cs_camera camera, cs_f32 x, cs_f32 y, cs_f32 depth)
{
    cs_f32 rise = CS_RISE(camera, x, y);
    cs_f32 width = camera.aperture_width / camera.pixel_width;
    if (camera.orthographic)
        return width * (1.0f - depth / (camera.focal_distance * (1.0f + rise)));
    return width * (camera.focal_distance / depth - (1.0f - rise));
}

/* The same on the optical axis: in the whole picture, unless the focal plane is tilted. */
static inline cs_f32 cs_shear_of_depth(cs_camera camera, cs_f32 depth)
{
    return cs_shear_at(camera, camera.centre_px[0], camera.centre_px[1], depth);
}

#include "fp_contract_restore.h"

#endif
