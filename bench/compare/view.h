/* A mesh, a camera with a lens, and the rays of a render, in the order of its kernel. */
#ifndef CS_BENCH_VIEW_H
#define CS_BENCH_VIEW_H

#include "accel/accel.h"
#include "embree_rays.h"
#include "measure.h"
#include "optics/optics.h"
#include "pattern/pattern.h"

typedef struct bench_view {
    const char *mesh; /* a name for test_make_mesh */
    size_t triangles; /* approximate number of triangles */
    int size;         /* side of the image, px */
    int spp;
    int threads;
    double lens_radius;
    cs_u32 sampler;
    clshear_aperture aperture;
    int blades; /* of a polygon */
    clshear_filter filter;
    cs_scene scene;
    cs_accel *accel;
    cs_flat_bvh bvh;
    double build_s;
    cs_view camera;
    cs_camera frame;
    cs_optics_tables optics;
    cs_pattern pattern;
    float light[3]; /* position of a point light under the ceiling */
    /* By tiles of 8 x 8 pixels, and by pixels, in the order in which the kernel draws them. */
    ray_planes rays;
} bench_view;

/* Flags for the members of a bench_view *view: elements of an array of bench_flag. */
/* clang-format off */
#define BENCH_VIEW_FLAGS(view)                              \
    {.name = "mesh", .text = &(view)->mesh},                \
    {.name = "triangles", .count = &(view)->triangles},     \
    {.name = "spp", .number = &(view)->spp},                \
    {.name = "size", .number = &(view)->size},              \
    {.name = "threads", .number = &(view)->threads},        \
    {.name = "lens", .real = &(view)->lens_radius}
/* clang-format on */

/* Fills in the members below `filter`. On failure, prints a line and exits with 1. */
void bench_view_open(bench_view *view);
void bench_view_close(bench_view *view);

/* Settings with the view's camera, lens and image size. */
clshear_settings *bench_view_settings(const bench_view *view);

/* malloc, but exits with 1 when out of memory. */
void *bench_allocate(size_t size);

#endif
