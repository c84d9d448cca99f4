/* The integrand itself: radiance at points of one pixel and the lens that the caller chooses. */
#include "clshear/device/lens.h"
#include "clshear/device/shear.h"
#include "kernels/radiance.h"
#include "launch.h"

/* One work-item computes CS_PACKET points. Global size: count / CS_PACKET; `count` is a multiple of
 * it.
 *
 * x, y: the pixel. points: six planes of `count` floats: place in the pixel (its left upper corner
 * is 0, 0), lens coordinates in aperture widths from the centre, and a sample for area lights; or,
 * where `tuples` is not 0, what a sampler draws, to be sheared by `shear` as launch.shear_mode
 * says, with the optics' table. radiance: out, three planes of `count` floats. The others: the
 * scene, see cs_scene_buffers. */
__kernel void cs_radiance_at(const cs_launch launch, const uint x, const uint y, const uint count,
                             const uint tuples, const float shear, cs_optics_table table,
                             __global const float *points,
                             __global float *radiance CS_SCENE_PARAMETERS)
{
    size_t first = get_global_id(0) * CS_PACKET;
    if (first >= count) return;
    const cs_scene_buffers scene = CS_SCENE_VALUES;
    cs_vfloat point[6];
    for (int plane = 0; plane < 6; plane++)
        point[plane] = *(__global const cs_vfloat *)(points + (size_t)plane * count + first);
    if (tuples) {
        cs_camera_sample place = cs_shear(point[0], point[1], point[2], point[3], launch.shear_mode,
                                          &launch.camera.optics, table, shear);
        point[0] = place.x;
        point[1] = place.y;
        point[2] = place.u;
        point[3] = place.v;
    }
    cs_ray ray =
        cs_lens_ray(launch.camera, point[0] + (cs_f32)x, point[1] + (cs_f32)y, point[2], point[3]);
    cs_pair emitter;
    emitter.x = point[4];
    emitter.y = point[5];
    cs_radiance found =
        cs_radiance_along(&scene, launch.lights, &ray, emitter, point[0] == point[0]);
    for (int channel = 0; channel < 3; channel++)
        *(__global cs_vfloat *)(radiance + (size_t)channel * count + first) =
            found.channel[channel];
}
