/* A mesh, a camera with a lens, and the rays of a render of it in the order of its kernel. */
#ifndef CS_BENCH_VIEW_H
#define CS_BENCH_VIEW_H

#include "accel/accel.h"
#include "embree_rays.h"
#include "optics/optics.h"
#include "pattern/pattern.h"

typedef struct bench_view {
    const char *mesh; /* a name of test_make_mesh */
    size_t triangles; /* about */
    int size;         /* of the image, pixels along a side */
    int spp;
    int threads;
    double lens_radius;
    cs_u32 sampler;
    int square; /* the aperture; else round */
    cs_scene scene;
    cs_accel *accel;
    cs_flat_bvh bvh;
    double build_s;
    cs_view camera;
    cs_camera frame;
    cs_optics_tables optics;
    cs_pattern pattern;
    float light[3];  /* a point under the ceiling */
    ray_planes rays; /* pixel by pixel in tiles of 8 x 8; of those, as the kernel draws them */
} bench_view;

/* Fills in what is below `square`. Prints a line and exits with 1 where that fails. */
void bench_view_open(bench_view *view);
void bench_view_close(bench_view *view);

/* Settings with the view's camera, lens and image size. */
clshear_settings *bench_view_settings(const bench_view *view);

/* malloc that exits. */
void *bench_allocate(size_t size);

#endif
