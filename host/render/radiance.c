/* The integrand of a pixel, at points that the caller chooses. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/launch.h"
#include "oracle/oracle.h"
#include "render/motion.h"
#include "render/radiance.h"
#include "render/render_job.h"

enum {
    LANES = 16,     /* the widest packet */
    MOST = 1 << 18, /* points on their way at once */
    PLANES = CS_EVALUATED
};

typedef struct evaluation {
    cs_job job;
    cs_launch launch;
    cs_u32 pixel[2]; /* x, y */
    cs_u32 tuples;   /* not 0: points are what a sampler draws */
    cs_f32 shear_px;
    cs_velocity velocity_px;
    size_t dimensions;  /* of a point: x, y, u, v, and 5 for the time too */
    cs_f32 lens_offset; /* of points that are places: to the centre of the square around the */
    cs_f32 lens_scale;  /* aperture, and from that square to aperture widths */
    cs_buffer *table;
    cs_buffer *points;
    cs_buffer *radiance;
    size_t chunk;  /* points on their way at once */
    float *planes; /* PLANES * chunk */
} evaluation;

static clshear_status run_kernel(const evaluation *e, cs_u32 count, cs_error *error)
{
    cs_device *device = e->job.scene->context->device;
    const cs_buffer *buffers[CS_SCENE_BUFFERS];
    cs_lit_buffers(e->job.scene, &e->job.lighting, buffers);
    const cs_argument arguments[] = {{.value = &e->launch, .size = sizeof e->launch},
                                     {.value = &e->pixel[0], .size = sizeof e->pixel[0]},
                                     {.value = &e->pixel[1], .size = sizeof e->pixel[1]},
                                     {.value = &count, .size = sizeof count},
                                     {.value = &e->tuples, .size = sizeof e->tuples},
                                     {.value = &e->shear_px, .size = sizeof e->shear_px},
                                     {.value = &e->velocity_px, .size = sizeof e->velocity_px},
                                     {.buffer = e->table},
                                     {.buffer = e->points},
                                     {.buffer = e->radiance},
                                     CS_SCENE_BUFFER_LIST(CS_SCENE_ARGUMENT)};
    return CS_RUN_WITH(device, RADIANCE, e->job.features, count / (cs_u32)cs_device_packet(device),
                       arguments, error);
}

/* Up to `chunk` points; the last packet is filled up with the last point. */
static clshear_status evaluate(evaluation *e, const float *points, size_t count, float *rgb,
                               cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const size_t all = (count + LANES - 1) / LANES * LANES;
    for (size_t i = 0; i < all; i++) {
        const float *point = points + e->dimensions * (i < count ? i : count - 1);
        e->planes[i] = point[0];
        e->planes[all + i] = point[1];
        e->planes[2 * all + i] = (point[2] - e->lens_offset) * e->lens_scale;
        e->planes[3 * all + i] = (point[3] - e->lens_offset) * e->lens_scale;
        e->planes[4 * all + i] = e->planes[5 * all + i] = 0.5f;
        e->planes[CS_DIMENSIONS * all + i] = e->dimensions > 4 ? point[4] : 0.5f;
    }
    CS_TRY(cs_buffer_write(e->points, 0, PLANES * all * sizeof(float), e->planes, error));
    CS_TRY(run_kernel(e, (cs_u32)all, error));
    CS_TRY(cs_buffer_read(e->radiance, 0, 3 * all * sizeof(float), e->planes, error));
    for (size_t i = 0; i < count; i++)
        for (size_t c = 0; c < 3; c++)
            rgb[3 * i + c] = e->planes[c * all + i];
done:
    return status;
}

static clshear_status reserve(evaluation *e, size_t count, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_device *device = e->job.scene->context->device;
    const cs_array *table = &e->job.optics.table;
    e->chunk = count < MOST ? (count / LANES + 1) * LANES : MOST;
    e->planes = malloc((size_t)PLANES * e->chunk * sizeof *e->planes);
    CS_REQUIRE(e->planes != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    CS_TRY(cs_buffer_create(device, table->count * sizeof(cs_f32), table->items, &e->table, error));
    CS_TRY(cs_buffer_create(device, (size_t)PLANES * e->chunk * sizeof(float), NULL, &e->points,
                            error));
    CS_TRY(
        cs_buffer_create(device, (size_t)3 * e->chunk * sizeof(float), NULL, &e->radiance, error));
done:
    return status;
}

/* The job of a render that draws nothing: it checks the settings and makes camera and lights. */
static clshear_status prepare(evaluation *e, clshear_scene *scene, const clshear_settings *settings,
                              int x, int y, size_t count, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    CS_TRY(cs_job_begin(&e->job, scene, settings, NULL, error));
    CS_TRY(cs_wide_scene_make(scene, &e->job.features, error));
    CS_REQUIRE(x >= 0 && x < e->job.width && y >= 0 && y < e->job.height, CLSHEAR_BAD_ARGUMENT,
               "pixel %d,%d is outside the %d x %d image", x, y, e->job.width, e->job.height);
    e->pixel[0] = (cs_u32)x;
    e->pixel[1] = (cs_u32)y;
    e->launch = cs_job_pass(&e->job).launch;
    e->launch.pattern.sampler = CS_SAMPLER_RANDOM; /* of paths, beyond the tuple */
    CS_TRY(reserve(e, count, error));
done:
    return status;
}

static void release(evaluation *e)
{
    cs_buffer_free(e->table);
    cs_buffer_free(e->points);
    cs_buffer_free(e->radiance);
    cs_job_free(&e->job);
    free(e->planes);
}

static clshear_status evaluate_all(evaluation *e, const float *points, size_t count, float *rgb,
                                   cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    for (size_t first = 0; first < count; first += e->chunk)
        CS_TRY(evaluate(e, points + e->dimensions * first,
                        count - first < e->chunk ? count - first : e->chunk, rgb + 3 * first,
                        error));
done:
    return status;
}

clshear_status cs_radiance(clshear_scene *scene, const clshear_settings *settings, int x, int y,
                           size_t dimensions, const float *points, size_t count, float *rgb,
                           cs_error *error)
{
    evaluation e = {.lens_offset = 0.5f, .dimensions = dimensions};
    clshear_status status = prepare(&e, scene, settings, x, y, count, error);
    if (status == CLSHEAR_OK) {
        const float radius = (float)cs_number(&e.job.settings, LENS_RADIUS);
        e.lens_scale = radius > 0.0f ? 2.0f * radius / e.launch.camera.aperture_width : 1.0f;
        status = evaluate_all(&e, points, count, rgb, error);
    }
    release(&e);
    return status;
}

clshear_status cs_radiance_of_samples(clshear_scene *scene, const clshear_settings *settings, int x,
                                      int y, const cs_pixel_shears *shears, size_t dimensions,
                                      const float *samples, size_t count, float *rgb,
                                      cs_error *error)
{
    evaluation e = {.tuples = 1,
                    .shear_px = shears->shear_px,
                    .velocity_px = shears->velocity_px,
                    .lens_scale = 1.0f,
                    .dimensions = dimensions};
    clshear_status status = prepare(&e, scene, settings, x, y, count, error);
    if (status == CLSHEAR_OK) {
        e.velocity_px = cs_motion_exposed(&e.job, e.velocity_px);
        status = evaluate_all(&e, samples, count, rgb, error);
    }
    release(&e);
    return status;
}

clshear_status cs_pixel_shear(clshear_scene *scene, const clshear_settings *settings, int x, int y,
                              float *shear_px, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const int window[4] = {x, x + 1, y, y + 1};
    cs_depth depth;
    cs_job job = {0};
    CS_TRY(cs_job_begin(&job, scene, settings, NULL, error));
    CS_REQUIRE(x >= 0 && x < job.width && y >= 0 && y < job.height, CLSHEAR_BAD_ARGUMENT,
               "pixel %d,%d is outside the %d x %d image", x, y, job.width, job.height);
    const cs_shapes shapes = cs_lighting_shapes(&job.lighting);
    CS_TRY(cs_accel_depth(scene->accel, &shapes, &job.camera, job.optics.table.items, window,
                          (int)cs_integer(&job.settings, LENS_RAYS), &depth, error));
    const cs_f32 middle[2] = {(cs_f32)x + 0.5f, (cs_f32)y + 0.5f};
    const clshear_oracle oracle =
        cs_is_set(&job.settings, ORACLE) ? job.oracle : CLSHEAR_ORACLE_CENTRE;
    const cs_rule rule = cs_oracle_rule(oracle, &depth);
    *shear_px = cs_is_set(&job.settings, SHEAR_PX)
                    ? (float)cs_number(&job.settings, SHEAR_PX)
                    : cs_oracle_shear(&job.camera, middle[0], middle[1], &depth, rule);
done:
    cs_job_free(&job);
    return status;
}

clshear_status cs_pixel_motion(clshear_scene *scene, const clshear_settings *settings, int x, int y,
                               int *moves, cs_velocity *velocity_px, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const int window[4] = {x, x + 1, y, y + 1};
    cs_job job = {0};
    CS_TRY(cs_job_begin(&job, scene, settings, NULL, error));
    CS_REQUIRE(x >= 0 && x < job.width && y >= 0 && y < job.height, CLSHEAR_BAD_ARGUMENT,
               "pixel %d,%d is outside the %d x %d image", x, y, job.width, job.height);
    *moves = job.moves;
    *velocity_px = (cs_velocity){0.0f, 0.0f};
    if (job.moves) cs_accel_velocity(scene->accel, &job.cameras, window, velocity_px);
done:
    cs_job_free(&job);
    return status;
}
