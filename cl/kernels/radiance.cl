/* The integrand itself: radiance at points of one pixel and the lens that the caller chooses. */
#include "clshear/device/lens.h"
#include "clshear/device/shear.h"
#include "kernels/kernel.h"
#include "kernels/path.h"
#include "launch.h"

/* One work-item computes CS_PACKET points. Global size: count / CS_PACKET; `count` is a multiple of
 * it.
 *
 * x, y: the pixel. points: CS_DIMENSIONS planes of `count` floats: place in the pixel (its left
 * upper corner is 0, 0), lens coordinates in aperture widths from the centre, and a sample for area
 * lights; or, where `tuples` is not 0, what a sampler draws, to be sheared by `shear` as
 * launch.shear_mode says, with the lens table. radiance: out, three planes of `count` floats. The
 * others: the scene, see cs_scene_buffers. Paths draw independent numbers, fixed by the point:
 * launch.pattern must be of the sampler `random`. */
CS_KERNEL void cs_radiance_at(const cs_launch launch, const uint x, const uint y, const uint count,
                              const uint tuples, const float shear, cs_optics_table lens_table,
                              __global const float *points,
                              __global float *radiance CS_SCENE_PARAMETERS)
{
    size_t first = get_global_id(0) * CS_PACKET;
    if (first >= count) return;
    const cs_scene_buffers scene = CS_SCENE_VALUES;
    cs_vfloat point[CS_DIMENSIONS];
    for (int plane = 0; plane < CS_DIMENSIONS; plane++)
        point[plane] = *(__global const cs_vfloat *)(points + (size_t)plane * count + first);
    if (tuples) {
        cs_camera_sample place =
            cs_shear(point[CS_AT_FILM], point[CS_END_FILM], point[CS_AT_LENS], point[CS_END_LENS],
                     launch.shear_mode, &launch.camera.optics, lens_table, shear);
        point[CS_AT_FILM] = place.x;
        point[CS_END_FILM] = place.y;
        point[CS_AT_LENS] = place.u;
        point[CS_END_LENS] = place.v;
    }
    cs_ray ray = cs_lens_ray(launch.camera, point[CS_AT_FILM] + (cs_f32)x,
                             point[CS_END_FILM] + (cs_f32)y, point[CS_AT_LENS], point[CS_END_LENS]);
    cs_pair light;
    light.x = point[CS_AT_LIGHT];
    light.y = point[CS_END_LIGHT];
#if CS_HAS(PATHS)
    cs_vuint number = cs_key_lanes(cs_hash(x + launch.image_width * y), cs_as_vuint(point[0]));
    for (int plane = 1; plane < CS_DIMENSIONS; plane++)
        number = cs_hash_lanes(number + cs_as_vuint(point[plane]));
    cs_draws draws = {&launch.pattern, 0, launch.seed, number};
    cs_radiance found =
        cs_path_along(&scene, &launch, &ray, light, &draws, point[CS_AT_FILM] == point[CS_AT_FILM]);
#else
    cs_radiance found = cs_radiance_along(&scene, launch.lights, &ray, light,
                                          point[CS_AT_FILM] == point[CS_AT_FILM]);
#endif
    for (int channel = 0; channel < 3; channel++)
        *(__global cs_vfloat *)(radiance + (size_t)channel * count + first) =
            found.channel[channel];
}
