/* The integrand of a pixel, at points that the caller chooses. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "frame.h"
#include "render/handles.h"
#include "scene/camera.h"

enum {
    LANES = 16,      /* the widest packet */
    CHUNK = 1 << 18, /* points on their way at once */
    PLANES = 6
};

typedef struct evaluation {
    clshear_scene *scene;
    cs_frame frame;
    u32 pixel[2];
    f32 lens_scale; /* from the square around the aperture to aperture widths */
    cs_buffer *points;
    cs_buffer *radiance;
    float *planes; /* PLANES * CHUNK */
} evaluation;

static clshear_status launch(const evaluation *e, u32 count, cs_error *error)
{
    enum {
        BEFORE_WORLD = 6
    };
    cs_argument arguments[BEFORE_WORLD + CS_WORLD_BUFFERS] = {
        {.value = &e->frame, .size = sizeof e->frame},
        {.value = &e->pixel[0], .size = sizeof e->pixel[0]},
        {.value = &e->pixel[1], .size = sizeof e->pixel[1]},
        {.value = &count, .size = sizeof count},
        {.buffer = e->points},
        {.buffer = e->radiance}};
    for (int i = 0; i < CS_WORLD_BUFFERS; i++)
        arguments[BEFORE_WORLD + i].buffer = e->scene->world.buffers[i];
    cs_device *device = e->scene->context->device;
    return cs_device_run(device, CS_KERNEL_RADIANCE, count / (u32)cs_device_packet(device),
                         arguments, BEFORE_WORLD + CS_WORLD_BUFFERS, error);
}

/* Up to CHUNK points; the last packet is filled up with the last point. */
static clshear_status evaluate(evaluation *e, const float *points, size_t count, float *rgb,
                               cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const size_t all = (count + LANES - 1) / LANES * LANES;
    for (size_t i = 0; i < all; i++) {
        const float *point = points + 4 * (i < count ? i : count - 1);
        e->planes[i] = point[0];
        e->planes[all + i] = point[1];
        e->planes[2 * all + i] = (point[2] - 0.5f) * e->lens_scale;
        e->planes[3 * all + i] = (point[3] - 0.5f) * e->lens_scale;
        e->planes[4 * all + i] = e->planes[5 * all + i] = 0.5f;
    }
    CS_TRY(cs_buffer_write(e->points, 0, PLANES * all * sizeof(float), e->planes, error));
    CS_TRY(launch(e, (u32)all, error));
    CS_TRY(cs_buffer_read(e->radiance, 0, 3 * all * sizeof(float), e->planes, error));
    for (size_t i = 0; i < count; i++)
        for (size_t c = 0; c < 3; c++)
            rgb[3 * i + c] = e->planes[c * all + i];
done:
    return status;
}

clshear_status clshear_radiance(clshear_scene *scene, const clshear_camera *camera, int width,
                                int height, int x, int y, const float *points, size_t count,
                                float *rgb)
{
    clshear_status status = CLSHEAR_OK;
    clshear_context *context = scene->context;
    cs_error *error = &context->error;
    evaluation e = {.scene = scene, .pixel = {(u32)x, (u32)y}};
    CS_REQUIRE(width >= 1 && height >= 1 && x >= 0 && y >= 0 && x < width && y < height,
               CLSHEAR_BAD_ARGUMENT, "pixel %d,%d is outside the %d x %d image", x, y, width,
               height);
    CS_REQUIRE(camera->lens_radius >= 0.0f && camera->focal_distance > 0.0f, CLSHEAR_BAD_ARGUMENT,
               "the camera's lens is not chosen");
    CS_TRY(cs_camera_frame(camera, width, height, &e.frame.camera, error));
    e.frame.camera.optics.squeeze = camera->anamorphic > 0.0f ? 1.0f / camera->anamorphic : 1.0f;
    e.frame.lights = scene->world.lights;
    e.frame.emitters = scene->world.emitters;
    e.lens_scale = camera->lens_radius > 0.0f
                       ? 2.0f * camera->lens_radius / e.frame.camera.aperture_width
                       : 1.0f;
    e.planes = malloc((size_t)PLANES * CHUNK * sizeof *e.planes);
    CS_REQUIRE(e.planes != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    CS_TRY(cs_buffer_create(context->device, (size_t)PLANES * CHUNK * sizeof(float), NULL,
                            &e.points, error));
    CS_TRY(cs_buffer_create(context->device, (size_t)3 * CHUNK * sizeof(float), NULL, &e.radiance,
                            error));
    for (size_t first = 0; first < count; first += CHUNK)
        CS_TRY(evaluate(&e, points + 4 * first, count - first < CHUNK ? count - first : CHUNK,
                        rgb + 3 * first, error));
done:
    cs_buffer_free(e.points);
    cs_buffer_free(e.radiance);
    free(e.planes);
    return status;
}
