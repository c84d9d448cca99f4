/* Paths: where they are, what they carry, and where what they find is kept. Device only.
 *
 * A packet's paths may be of any samples of the pool: they are sorted anew at every surface
 * (sort.h). */
#ifndef CS_PATH_STATE_H
#define CS_PATH_STATE_H

#include "kernels/draws.h"
#include "kernels/found.h"
#include "kernels/launch.h"
#include "kernels/light/escaped.h"

/* Lanes only: sorting moves them as words. */
typedef struct cs_path {
    cs_ray ray;
    cs_vint alive;           /* lanes whose ray is to be followed */
    cs_vint home;            /* the sample: CS_PACKET times its packet, and its lane there */
    cs_vuint key;            /* of the sample's pattern */
    cs_vuint index;          /* of the sample in the pattern */
    cs_vfloat throughput[3]; /* radiance at the lens for one at the end of the ray */
    cs_vfloat density;       /* with which the BSDF drew the ray; of camera rays it is not used */
    cs_vfloat cosine;        /* of the ray at the surface that it left; negative behind it */
#if CS_HAS(LIGHTS)
    cs_vint facing; /* of that surface, see cs_environment_facing */
#endif
#if CS_HAS(EMITTERS)
    cs_vantage left; /* the surface behind the path's end */
#endif
#if CS_HAS(MATERIALS)
    cs_vfloat squeezed; /* by which solids, that the path is in, lower the throughput */
#endif
#if CS_HAS(MOVING)
    cs_vfloat time;
#endif
} cs_path;

/* Rays to lights, of any samples of the pool. Lanes only, too. */
typedef struct cs_shadow {
    cs_ray ray;
    cs_vfloat reach;    /* where the light is, in lengths of the direction; negative: no ray */
    cs_vfloat light[3]; /* radiance at the lens if nothing is in the way */
    cs_vint home;       /* as in cs_path */
#if CS_HAS(MATERIALS)
    cs_vuint passing; /* what choices to pass a surface are made of */
#endif
#if CS_HAS(MOVING)
    cs_vfloat time;
#endif
} cs_shadow;

/* Packets of samples whose paths are followed together, and packets of shadow rays that wait for
 * each other: many, since few paths are left behind the first surfaces. */
#if CS_PACKET == 1
enum {
    CS_FLUSHES = 1, /* updates of pixels' states that they are for */
    CS_SHADOWS = 1
};
#else
enum {
    CS_FLUSHES = CS_POOL_FLUSHES,
    CS_SHADOWS = 8
};
#endif
#define CS_POOL (CS_FLUSHES * CS_TOGETHER)

/* The paths of the samples of a pixel, or of several, all of them at the same depth. */
typedef struct cs_paths {
    const cs_launch *launch;
    cs_sample_table table;
    int paired; /* whether `light` is drawn with the tuples, so that its opposite may be used too */
    cs_pair light[CS_POOL];     /* of each packet of samples: the tuples' pairs for lights */
    cs_radiance found[CS_POOL]; /* of each, so far */
    cs_path path[CS_POOL];
    int count;      /* packets of paths */
    cs_u32 depth;   /* surfaces behind the paths */
    cs_vfloat rays; /* traced after the first, a lane */
    cs_shadow shadow[CS_SHADOWS];
    cs_u32 shadow_light[CS_SHADOWS]; /* number of the light of each packet */
    int shadows;                     /* packets of them */
} cs_paths;

/* Weight of a sample with density `own` where another way would have drawn it with `other`. The
 * ratio keeps squares within floats. */
static inline cs_vfloat cs_power_weight(cs_vfloat own, cs_vfloat other)
{
    cs_vfloat ratio = other / cs_max(own, (cs_vfloat)(1e-30f));
    return 1.0f / (1.0f + ratio * ratio);
}

/* Whether lanes are those of one packet, in order. */
static inline int cs_is_packet(cs_int_lanes home)
{
    cs_vint first = (cs_vint)(home.lane[0]);
    return home.lane[0] % CS_PACKET == 0 && !cs_any(home.all != first + cs_as_vint(CS_LANE_INDEX));
}

/* Adds radiance at the lens to the samples of the lanes in `lit`. met: surfaces that it met. */
static inline void cs_samples_add(cs_paths *paths, cs_vint home, cs_u32 met, cs_vint lit,
                                  const cs_vfloat *radiance)
{
    cs_int_lanes to, wanted;
    cs_float_lanes light[3];
    to.all = home;
    if (cs_is_packet(to)) {
        for (int c = 0; c < 3; c++)
            cs_radiance_add(paths->found + to.lane[0] / CS_PACKET, met, c,
                            lit ? radiance[c] : (cs_vfloat)(0.0f));
        return;
    }
    wanted.all = lit;
    for (int c = 0; c < 3; c++)
        light[c].all = radiance[c];
    for (int lane = 0; lane < CS_PACKET; lane++) {
        if (!wanted.lane[lane]) continue;
        for (int c = 0; c < 3; c++)
            cs_radiance_add_lane(paths->found + to.lane[lane] / CS_PACKET,
                                 to.lane[lane] % CS_PACKET, met, c, light[c].lane[lane]);
    }
}

/* Computes the radiance at the lens that `colour` times `weight` makes at the end of the paths.
 * met: number of surfaces that the light met. `clamp` limits light that met more than one. */
static inline void cs_path_carry(const cs_paths *paths, const cs_path *path, cs_u32 met,
                                 cs_vfloat weight, const cs_vfloat *colour, cs_vfloat *light)
{
    cs_vfloat scale = (cs_vfloat)(1.0f);
    cs_f32 clamp = paths->launch->clamp;
    for (int c = 0; c < 3; c++)
        light[c] = path->throughput[c] * weight * colour[c];
    if (clamp > 0.0f && met > 1u) {
        cs_vfloat most = cs_max(light[0], cs_max(light[1], light[2]));
        scale = most > clamp ? clamp / most : scale;
    }
    for (int c = 0; c < 3; c++)
        light[c] *= scale;
}

/* Adds what the paths' rays found; lanes with weight 0 add nothing. */
static inline void cs_path_add(cs_paths *paths, const cs_path *path, cs_vfloat weight,
                               const cs_vfloat *colour)
{
    cs_vfloat light[3];
    cs_path_carry(paths, path, paths->depth, weight, colour, light);
    cs_samples_add(paths, path->home, paths->depth, weight > 0.0f, light);
}

#endif
