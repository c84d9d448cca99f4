/* Traversal: our kernel against Embree's single rays, with the same rays and threads.
 *
 *   bench_traverse [--mesh box|spheres|terrain] [--triangles N] [--spp N] [--size PX] [--rounds N]
 *                  [--threads N] [--packet W] [--lens R]
 *
 * Camera rays are drawn by the renderer's sampler, sheared and sent through its lens; shadow rays
 * go from what they hit to a point light. Rounds are interleaved, Embree then kernel, and the
 * medians of the rounds are compared. Prints a table; exits with 1 if the hits disagree. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "accel/accel.h"
#include "device/device.h"
#include "embree_rays.h"
#include "frame.h"
#include "lens.h"
#include "meshes.h"
#include "optics/optics.h"
#include "oracle/oracle.h"
#include "pattern/pattern.h"
#include "scene/camera.h"
#include "shear.h"

enum {
    MAX_ROUNDS = 64
};

typedef struct settings {
    const char *mesh;
    size_t triangles;
    int spp, size, rounds, threads, packet;
    double lens;
} settings;

typedef struct bench {
    settings set;
    cs_error error;
    cs_scene scene;
    cs_accel *accel;
    cs_flat_bvh bvh;
    cs_device *device;
    cs_buffer *nodes, *triangles, *origins, *directions, *distances, *hits;
    embree_scene *embree[2]; /* medium, high */
    ray_planes rays;
    float *found[2]; /* distances by Embree and by the kernel */
    int *faces[2];
} bench;

static void must(bench *state, clshear_status status)
{
    if (status == CLSHEAR_OK) return;
    fprintf(stderr, "bench_traverse: %s\n", state->error.message);
    exit(1);
}

static void *must_allocate(size_t size)
{
    void *memory = malloc(size);
    if (memory == NULL) abort();
    return memory;
}

static settings read_settings(int argc, char **argv)
{
    settings set = {"spheres", 250000, 64, 256, 7, 0, 0, 0.05};
    for (int i = 1; i + 1 < argc; i += 2) {
        const char *value = argv[i + 1];
        if (strcmp(argv[i], "--mesh") == 0)
            set.mesh = value;
        else if (strcmp(argv[i], "--triangles") == 0)
            set.triangles = strtoul(value, NULL, 10);
        else if (strcmp(argv[i], "--spp") == 0)
            set.spp = atoi(value);
        else if (strcmp(argv[i], "--size") == 0)
            set.size = atoi(value);
        else if (strcmp(argv[i], "--rounds") == 0)
            set.rounds = atoi(value);
        else if (strcmp(argv[i], "--threads") == 0)
            set.threads = atoi(value);
        else if (strcmp(argv[i], "--packet") == 0)
            set.packet = atoi(value);
        else if (strcmp(argv[i], "--lens") == 0)
            set.lens = atof(value);
        else
            fprintf(stderr, "bench_traverse: unknown flag %s\n", argv[i]), exit(2);
    }
    if (set.rounds > MAX_ROUNDS) set.rounds = MAX_ROUNDS;
    return set;
}

/* The rays of a render: pixel by pixel, in the order in which the kernel draws a pattern. */
static void make_camera_rays(bench *state)
{
    const int size = state->set.size;
    const size_t pixels = (size_t)size * (size_t)size, spp = (size_t)state->set.spp;
    const int window[4] = {0, size, 0, size};
    clshear_camera camera = cs_camera_of_scene(&state->scene, size, size);
    const float eye[3] = {0.5f, 0.5f, 2.2f}, target[3] = {0.5f, 0.5f, 0.5f};
    memcpy(camera.eye, eye, sizeof eye);
    memcpy(camera.target, target, sizeof target);
    camera.lens_radius = (float)state->set.lens;
    camera.focal_distance = 1.5f;
    camera.fov_deg = 45.0f;
    cs_camera frame;
    cs_optics_tables optics = {0};
    must(state, cs_camera_frame(&camera, size, size, &frame, &state->error));
    must(state, cs_optics_make(&camera, CLSHEAR_FILTER_BOX, 0.0f, &optics, &state->error));
    frame.optics = optics.optics;
    cs_depth *depth = must_allocate(pixels * sizeof *depth);
    must(state, cs_accel_depth(state->accel, &frame, NULL, window, 0, depth, &state->error));
    const cs_pattern pattern = cs_pattern_of(CS_SAMPLER_MJ, 0, (u32)spp);
    ray_planes *rays = &state->rays;
    rays->count = pixels * spp;
    rays->origins = must_allocate(3 * rays->count * sizeof(float));
    rays->directions = must_allocate(3 * rays->count * sizeof(float));
    rays->reach = must_allocate(rays->count * sizeof(float));
    for (size_t i = 0; i < rays->count; i++) {
        u32 pixel = cs_tiled_pixel((u32)(i / spp), (u32)size, (u32)size), index = (u32)(i % spp);
        u32 key = cs_pattern_key(0, pixel, 0);
        float tuple[CS_DIMENSIONS] = {0};
        cs_draw(&pattern, NULL, key, index, 2, tuple);
        cs_film_lens point =
            cs_shear(tuple[0], tuple[1], tuple[2], tuple[3], CS_SHEAR_EQUAL_AREA, &frame.optics,
                     optics.table.items, cs_oracle_shear(&frame, &depth[pixel], CS_RULE_CENTRE));
        cs_ray ray = cs_lens_ray(frame, point.x + (float)(pixel % (u32)size),
                                 point.y + (float)(pixel / (u32)size), point.u, point.v);
        for (size_t axis = 0; axis < 3; axis++) {
            rays->origins[axis * rays->count + i] = ray.origin[axis];
            rays->directions[axis * rays->count + i] = ray.direction[axis];
        }
        rays->reach[i] = INFINITY;
    }
    free(depth);
    cs_optics_free(&optics);
}

/* Turns rays that hit something into rays from there to a light; the others get no reach. */
static void make_shadow_rays(bench *state)
{
    const float light[3] = {0.5f, 0.95f, 0.5f};
    ray_planes *rays = &state->rays;
    for (size_t i = 0; i < rays->count; i++) {
        int hit = state->faces[0][i] != CS_NO_HIT;
        for (size_t axis = 0; axis < 3 && hit; axis++) {
            size_t at = axis * rays->count + i;
            float point = rays->origins[at] + 0.9999f * state->found[0][i] * rays->directions[at];
            rays->origins[at] = point;
            rays->directions[at] = light[axis] - point;
        }
        rays->reach[i] = hit ? 1.0f : -1.0f;
    }
}

static void upload_rays(bench *state)
{
    const ray_planes *rays = &state->rays;
    size_t plane = rays->count * sizeof(float);
    must(state, cs_buffer_write(state->origins, 0, 3 * plane, rays->origins, &state->error));
    must(state, cs_buffer_write(state->directions, 0, 3 * plane, rays->directions, &state->error));
}

/* Seconds that the kernel takes for all rays. */
static double time_kernel(bench *state, int any_hit)
{
    const ray_planes *rays = &state->rays;
    uint32_t count = (uint32_t)rays->count;
    const cs_argument arguments[] = {{.value = &count, .size = sizeof count},
                                     {.value = &any_hit, .size = sizeof any_hit},
                                     {.buffer = state->origins},
                                     {.buffer = state->directions},
                                     {.buffer = state->distances},
                                     {.buffer = state->hits},
                                     {.buffer = state->nodes},
                                     {.buffer = state->triangles}};
    must(state, cs_buffer_write(state->distances, 0, rays->count * sizeof(float), rays->reach,
                                &state->error));
    double start_s = cs_now_s();
    must(state, cs_device_run(state->device, CS_KERNEL_TRACE,
                              rays->count / (size_t)cs_device_packet(state->device), arguments,
                              sizeof arguments / sizeof *arguments, &state->error));
    double took_s = cs_now_s() - start_s;
    must(state, cs_buffer_read(state->distances, 0, rays->count * sizeof(float), state->found[1],
                               &state->error));
    return took_s;
}

static double time_embree(bench *state, int quality, int any_hit)
{
    double start_s = cs_now_s();
    if (any_hit)
        embree_blocked(state->embree[quality], &state->rays, state->found[0]);
    else
        embree_closest(state->embree[quality], &state->rays, state->found[0], state->faces[0]);
    return cs_now_s() - start_s;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *values, int count)
{
    qsort(values, (size_t)count, sizeof *values, ascending);
    return values[count / 2];
}

/* Share of rays whose distances differ by more than a part in 10^4. */
static double disagreement(const bench *state)
{
    size_t different = 0;
    for (size_t i = 0; i < state->rays.count; i++) {
        float a = state->found[0][i], b = state->found[1][i];
        if (a != b && !(fabsf(a - b) <= 1e-4f * fabsf(a))) different++;
    }
    return (double)different / (double)state->rays.count;
}

static size_t rays_with_reach(const ray_planes *rays)
{
    size_t count = 0;
    for (size_t i = 0; i < rays->count; i++)
        count += rays->reach[i] > 0.0f;
    return count;
}

typedef struct outcome {
    double embree_s[2];
    double kernel_s;
} outcome;

static outcome compare(bench *state, int any_hit)
{
    double times[3][MAX_ROUNDS], ratios[2][MAX_ROUNDS];
    const int rounds = state->set.rounds;
    time_kernel(state, any_hit); /* compiles */
    for (int round = 0; round < rounds; round++) {
        for (int quality = 0; quality < 2; quality++)
            times[quality][round] = time_embree(state, quality, any_hit);
        times[2][round] = time_kernel(state, any_hit);
        for (int quality = 0; quality < 2; quality++)
            ratios[quality][round] = times[quality][round] / times[2][round];
    }
    double mrays = 1e-6 * (double)rays_with_reach(&state->rays);
    outcome result = {{median(times[0], rounds), median(times[1], rounds)},
                      median(times[2], rounds)};
    printf(
        "%-8s  Embree 1 %7.2f (medium) %7.2f (high)   kernel %7.2f Mrays/s   ratio %.2f / %.2f\n",
        any_hit ? "shadow" : "primary", mrays / result.embree_s[0], mrays / result.embree_s[1],
        mrays / result.kernel_s, median(ratios[0], rounds), median(ratios[1], rounds));
    return result;
}

static void set_up(bench *state)
{
    const settings *set = &state->set;
    cs_error *error = &state->error;
    cs_scene_init(&state->scene);
    must(state, bench_make_mesh(set->mesh, set->triangles, &state->scene, error));
    must(state, cs_accel_create(&state->scene, set->threads, &state->accel, error));
    double start_s = cs_now_s();
    must(state, cs_accel_build_bvh(state->accel, &state->bvh, error));
    double build_s = cs_now_s() - start_s;
    must(state, cs_device_open(NULL, set->threads, set->packet, &state->device, error));
    for (int quality = 0; quality < 2; quality++)
        state->embree[quality] = embree_scene_create(&state->scene, quality, set->threads);
    make_camera_rays(state);
    const size_t plane = state->rays.count * sizeof(float);
    const cs_array *nodes = &state->bvh.nodes, *triangles = &state->bvh.triangles;
    must(state, cs_buffer_create(state->device, nodes->count * nodes->item_size, nodes->items,
                                 &state->nodes, error));
    must(state, cs_buffer_create(state->device, triangles->count * triangles->item_size,
                                 triangles->items, &state->triangles, error));
    must(state, cs_buffer_create(state->device, 3 * plane, NULL, &state->origins, error));
    must(state, cs_buffer_create(state->device, 3 * plane, NULL, &state->directions, error));
    must(state, cs_buffer_create(state->device, plane, NULL, &state->distances, error));
    must(state, cs_buffer_create(state->device, plane, NULL, &state->hits, error));
    for (int i = 0; i < 2; i++) {
        state->found[i] = must_allocate(plane);
        state->faces[i] = must_allocate(plane);
    }
    printf("%s, %zu triangles, built in %.2f s; %zu rays, %d spp, packet %d, %d threads\n",
           set->mesh, cs_scene_triangle_count(&state->scene), build_s, state->rays.count, set->spp,
           cs_device_packet(state->device), cs_device_threads(state->device));
}

static void tear_down(bench *state)
{
    cs_buffer *buffers[] = {state->nodes,      state->triangles, state->origins,
                            state->directions, state->distances, state->hits};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
        cs_buffer_free(buffers[i]);
    for (int i = 0; i < 2; i++) {
        embree_scene_free(state->embree[i]);
        free(state->found[i]);
        free(state->faces[i]);
    }
    free(state->rays.origins);
    free(state->rays.directions);
    free(state->rays.reach);
    cs_device_close(state->device);
    cs_flat_bvh_free(&state->bvh);
    cs_accel_free(state->accel);
    cs_scene_free(&state->scene);
}

int main(int argc, char **argv)
{
    bench state = {.set = read_settings(argc, argv)};
    set_up(&state);
    upload_rays(&state);
    outcome primary = compare(&state, 0);
    double wrong = disagreement(&state);
    time_embree(&state, 1, 0);
    make_shadow_rays(&state);
    upload_rays(&state);
    outcome shadow = compare(&state, 1);
    double wrong_shadow = disagreement(&state);
    double best = INFINITY;
    for (int quality = 0; quality < 2; quality++)
        best = fmin(best, primary.embree_s[quality] + shadow.embree_s[quality]);
    printf("together  ratio %.2f against the better quality; hits differ on %.4f %% and %.4f %%\n",
           best / (primary.kernel_s + shadow.kernel_s), 100.0 * wrong, 100.0 * wrong_shadow);
    tear_down(&state);
    return wrong > 1e-4 || wrong_shadow > 1e-4;
}
