/* The integrand itself: radiance at points of one pixel and the lens that the caller chooses. */
#include "clshear/device/lens.h"
#include "clshear/device/shear.h"
#include "kernels/kernel.h"
#include "kernels/lanes.h"
#include "kernels/motion.h"
#include "kernels/path.h"
#include "kernels/radiance.h"
#include "launch.h"

/* Shears a point of film, lens and, with the feature MOTION, time in place. */
static inline void cs_shear_point(const cs_launch *launch, cs_optics_table lens_table, cs_f32 shear,
                                  cs_velocity velocity, cs_vfloat *point)
{
#if CS_HAS(MOTION)
    const cs_camera_sample tuple = {point[CS_AT_FILM], point[CS_END_FILM], point[CS_AT_LENS],
                                    point[CS_END_LENS]};
    const cs_moving_sample moving =
        cs_shear_moving(tuple, point[CS_DIMENSIONS], launch->shear_mode, &launch->camera.optics,
                        lens_table, shear, velocity);
    const cs_camera_sample place = moving.point;
    point[CS_DIMENSIONS] = moving.time;
#else
    (void)velocity;
    const cs_camera_sample place =
        cs_shear(point[CS_AT_FILM], point[CS_END_FILM], point[CS_AT_LENS], point[CS_END_LENS],
                 launch->shear_mode, &launch->camera.optics, lens_table, shear);
#endif
    point[CS_AT_FILM] = place.x;
    point[CS_END_FILM] = place.y;
    point[CS_AT_LENS] = place.u;
    point[CS_END_LENS] = place.v;
}

/* One work-item computes CS_PACKET points. Global size: count / CS_PACKET; `count` is a multiple of
 * it.
 *
 * x, y: the pixel. points: CS_EVALUATED planes of `count` floats: place in the pixel (its left
 * upper corner is 0, 0), lens coordinates in aperture widths from the centre, a sample for area
 * lights, and the part of the exposure, 0 to 1, which only the feature MOTION reads; or, where
 * `tuples` is not 0, what a sampler draws, to be sheared by `shear` and `velocity` as
 * launch.shear_mode says, with the lens table. radiance: out, three planes of `count` floats. The
 * others: the scene, see cs_scene_buffers. Paths draw independent numbers, fixed by the point:
 * launch.pattern must be of the sampler `random`. */
CS_KERNEL void cs_radiance_at(const cs_launch launch, const uint x, const uint y, const uint count,
                              const uint tuples, const float shear, const cs_velocity velocity,
                              cs_optics_table lens_table, __global const float *points,
                              __global float *radiance CS_SCENE_PARAMETERS)
{
    size_t first = get_global_id(0) * CS_PACKET;
    if (first >= count) return;
    cs_scene_buffers scene = CS_SCENE_VALUES;
    cs_vfloat point[CS_EVALUATED];
    for (int plane = 0; plane < CS_EVALUATED; plane++)
        point[plane] = *(__global const cs_loose_float *)(points + (size_t)plane * count + first);
    if (tuples) cs_shear_point(&launch, lens_table, shear, velocity, point);
#if CS_HAS(MOTION)
    const cs_vfloat time = cs_shutter_time(point[CS_DIMENSIONS], launch.shutter);
#endif
#if CS_HAS(MOVING)
    scene.time = time;
#endif
#if CS_HAS(MOTION)
    const cs_eye eye = cs_eye_at(&launch, time);
    cs_ray ray = cs_eye_ray(&launch, &eye, point[CS_AT_FILM] + (cs_f32)x,
                            point[CS_END_FILM] + (cs_f32)y, point[CS_AT_LENS], point[CS_END_LENS]);
#else
    cs_ray ray = cs_lens_ray(launch.camera, point[CS_AT_FILM] + (cs_f32)x,
                             point[CS_END_FILM] + (cs_f32)y, point[CS_AT_LENS], point[CS_END_LENS]);
#endif
    cs_pair light;
    light.x = point[CS_AT_LIGHT];
    light.y = point[CS_END_LIGHT];
#if CS_HAS(PATHS)
    cs_vuint number = cs_key_lanes(cs_hash(x + launch.image_width * y), cs_as_vuint(point[0]));
    for (int plane = 1; plane < CS_DIMENSIONS; plane++)
        number = cs_hash_lanes(number + cs_as_vuint(point[plane]));
#if CS_HAS(MOTION)
    number = cs_hash_lanes(number + cs_as_vuint(point[CS_DIMENSIONS]));
#endif
    cs_draws draws = {&launch.pattern, 0, (cs_vuint)(launch.seed), number};
    cs_paths paths;
    paths.launch = &launch;
    paths.paired = 0;
    cs_path_begin(&paths, 0, &ray, light, &draws, point[CS_AT_FILM] == point[CS_AT_FILM]);
#if CS_HAS(MOVING)
    paths.path[0].time = scene.time;
#endif
    cs_follow_paths(&scene, &paths, 1);
    cs_radiance found = paths.found[0];
#else
    cs_radiance found = cs_radiance_along(&scene, launch.lights, &ray, light,
                                          point[CS_AT_FILM] == point[CS_AT_FILM]);
#endif
    for (int channel = 0; channel < 3; channel++)
        *(__global cs_loose_float *)(radiance + (size_t)channel * count + first) =
            found.channel[channel];
}
