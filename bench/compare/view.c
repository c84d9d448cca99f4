#include "view.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "clshear/device/lens.h"
#include "clshear/device/shear.h"
#include "kernels/launch.h"
#include "measure.h"
#include "meshes.h"
#include "oracle/oracle.h"
#include "scene/camera.h"

void *bench_allocate(size_t size)
{
    void *memory = malloc(size);
    if (memory != NULL) return memory;
    fprintf(stderr, "out of memory for %zu bytes\n", size);
    exit(1);
}

static void must(clshear_status status, const cs_error *error)
{
    if (status == CLSHEAR_OK) return;
    fprintf(stderr, "%s\n", error->message);
    exit(1);
}

static void place_camera(bench_view *view, cs_error *error)
{
    const float eye[3] = {0.5f, 0.5f, 2.2f}, target[3] = {0.5f, 0.5f, 0.5f};
    const float light[3] = {0.5f, 0.95f, 0.5f};
    cs_view *camera = &view->camera;
    *camera = cs_camera_of_scene(&view->scene, -1, view->size, view->size);
    memcpy(camera->eye, eye, sizeof eye);
    memcpy(camera->target, target, sizeof target);
    memcpy(view->light, light, sizeof light);
    camera->lens_radius = (float)view->lens_radius;
    camera->aperture = view->aperture;
    camera->blades = view->blades;
    camera->focal_distance = 1.5f;
    camera->fov_deg = 45.0f;
    must(cs_camera_frame(camera, view->size, view->size, &view->frame, error), error);
    must(cs_optics_make(&view->camera, view->filter, 0.0f, &view->optics, error), error);
    view->frame.optics = view->optics.optics;
}

clshear_settings *bench_view_settings(const bench_view *view)
{
    const cs_view *camera = &view->camera;
    clshear_settings *settings = bench_settings(NULL);
    bench_set_vector(settings, CLSHEAR_EYE, camera->eye);
    bench_set_vector(settings, CLSHEAR_TARGET, camera->target);
    bench_set_vector(settings, CLSHEAR_UP, camera->up);
    bench_set(settings, CLSHEAR_FOV, (double)camera->fov_deg);
    bench_set(settings, CLSHEAR_LENS_RADIUS, (double)camera->lens_radius);
    bench_set(settings, CLSHEAR_FOCAL_DISTANCE, (double)camera->focal_distance);
    if (camera->blades > 0) bench_set(settings, CLSHEAR_BLADES, camera->blades);
    bench_set(settings, CLSHEAR_APERTURE, camera->aperture);
    bench_set(settings, CLSHEAR_FILTER, view->filter);
    bench_set(settings, CLSHEAR_WIDTH, view->size);
    bench_set(settings, CLSHEAR_HEIGHT, view->size);
    return settings;
}

/* The ray of sample number `place` in the order of the pixel's samples. */
static cs_ray ray_at(const bench_view *view, const cs_u32 *rows, cs_u32 pixel, cs_u32 place,
                     float shear_px)
{
    const cs_u32 key = cs_pattern_key(0, pixel, 0), size = (cs_u32)view->size;
    float tuple[CS_DIMENSIONS] = {0};
    cs_draw(&view->pattern, rows, key, cs_index_at(&view->pattern, key, place), tuple);
    const cs_camera_sample point =
        cs_shear(tuple[0], tuple[1], tuple[2], tuple[3], CS_SHEAR_EQUAL_AREA, &view->frame.optics,
                 view->optics.table.items, shear_px);
    const cs_u32 row = pixel / size, column = pixel - row * size;
    return cs_lens_ray(view->frame, point.x + (float)column, point.y + (float)row, point.u,
                       point.v);
}

static void make_rays(bench_view *view, cs_error *error)
{
    const size_t pixels = (size_t)view->size * (size_t)view->size, spp = (size_t)view->spp;
    const int window[4] = {0, view->size, 0, view->size};
    cs_array rows = {0};
    cs_depth *depth = bench_allocate(pixels * sizeof *depth);
    ray_planes *rays = &view->rays;
    must(cs_accel_depth(view->accel, NULL, &view->frame, NULL, window, 0, depth, error), error);
    must(cs_sample_table_make(&view->pattern, CS_ORDER_COHERENT, &rows, error), error);
    rays->count = pixels * spp;
    rays->origins = bench_allocate(3 * rays->count * sizeof(float));
    rays->directions = bench_allocate(3 * rays->count * sizeof(float));
    rays->reach = bench_allocate(rays->count * sizeof(float));
    for (size_t i = 0; i < rays->count; i++) {
        const cs_u32 pixel =
            cs_tiled_pixel((cs_u32)(i / spp), (cs_u32)view->size, (cs_u32)view->size);
        const float shear_px =
            cs_oracle_shear(&view->frame, 0.0f, 0.0f, &depth[pixel], CS_RULE_CENTRE);
        const cs_ray ray = ray_at(view, rows.items, pixel, (cs_u32)(i % spp), shear_px);
        for (size_t axis = 0; axis < 3; axis++) {
            rays->origins[axis * rays->count + i] = ray.origin[axis];
            rays->directions[axis * rays->count + i] = ray.direction[axis];
        }
        rays->reach[i] = INFINITY;
    }
    free(depth);
    cs_array_free(&rows);
}

void bench_view_open(bench_view *view)
{
    cs_error error = {0};
    view->spp = (int)cs_sampler_count(view->sampler, (cs_u32)view->spp);
    view->pattern = cs_pattern_of(view->sampler, 0, (cs_u32)view->spp);
    cs_scene_init(&view->scene);
    must(test_make_mesh(view->mesh, view->triangles, &view->scene, &error), &error);
    const double start_s = cs_now_s();
    must(cs_accel_create(&view->scene, view->threads, &view->accel, &error), &error);
    must(cs_accel_build_bvh(view->accel, &view->bvh, &error), &error);
    view->build_s = cs_now_s() - start_s;
    place_camera(view, &error);
    make_rays(view, &error);
}

void bench_view_close(bench_view *view)
{
    free(view->rays.origins);
    free(view->rays.directions);
    free(view->rays.reach);
    cs_optics_free(&view->optics);
    cs_flat_bvh_free(&view->bvh);
    cs_accel_free(view->accel);
    cs_scene_free(&view->scene);
}
