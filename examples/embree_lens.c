/* Sheared depth of field in a ray tracer of your own: here Embree, one ray at a time, on the host.
 *
 * The device headers are C as well, so the sampler, the shear and the lens need no OpenCL. One
 * pixel looks at a checkered wall out of focus; its variance is printed without and with the shear.
 *
 *     cc -ffp-contract=off embree_lens.c $(pkg-config --cflags --libs clshear) -lembree3 -lm
 */
#include <clshear/clshear.h>
#include <clshear/device/lens.h>
#include <clshear/device/sampler/sampler.h>
#include <clshear/device/shear.h>
#include <clshear/kernels.h>
#include <embree3/rtcore.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    SAMPLES = 64,
    REPLICATES = 2048,
    IMAGE_SIDE = 100,
    PIXEL_X = 61,
    PIXEL_Y = 47
};

static void check(clshear_status status)
{
    if (status == CLSHEAR_OK) return;
    fprintf(stderr, "%s\n", clshear_message());
    exit(2);
}

/* A wall of 10 x 10 units, 3 units in front of a camera at the origin that looks down -Z. */
static RTCScene make_wall(RTCDevice device)
{
    static const float corners[4][3] = {{-5, -5, -3}, {5, -5, -3}, {5, 5, -3}, {-5, 5, -3}};
    static const unsigned quad[4] = {0, 1, 2, 3};
    RTCScene scene = rtcNewScene(device);
    RTCGeometry wall = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
    void *vertices = rtcSetNewGeometryBuffer(wall, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof corners[0], 4);
    void *indices =
        rtcSetNewGeometryBuffer(wall, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, sizeof quad, 1);
    if (vertices == NULL || indices == NULL) {
        fprintf(stderr, "Embree has no memory\n");
        exit(2);
    }
    memcpy(vertices, corners, sizeof corners);
    memcpy(indices, quad, sizeof quad);
    rtcCommitGeometry(wall);
    rtcAttachGeometry(scene, wall);
    rtcReleaseGeometry(wall);
    rtcCommitScene(scene);
    return scene;
}

/* Camera depth of what a ray hits, or infinity: the direction's part along the camera axis is 1. */
static float trace(RTCScene scene, const cs_ray *ray)
{
    struct RTCIntersectContext context;
    struct RTCRayHit hit = {0};
    rtcInitIntersectContext(&context);
    hit.ray.org_x = ray->origin[0];
    hit.ray.org_y = ray->origin[1];
    hit.ray.org_z = ray->origin[2];
    hit.ray.dir_x = ray->direction[0];
    hit.ray.dir_y = ray->direction[1];
    hit.ray.dir_z = ray->direction[2];
    hit.ray.tfar = INFINITY;
    hit.ray.mask = -1u;
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &hit);
    return hit.ray.tfar;
}

/* Black and white squares, 1/4 unit wide; black where the ray leaves the scene. */
static float checker(const cs_ray *ray, float depth)
{
    if (!isfinite(depth)) return 0.0f;
    const float x = ray->origin[0] + depth * ray->direction[0];
    const float y = ray->origin[1] + depth * ray->direction[1];
    return (float)(((int)floorf(4.0f * x) + (int)floorf(4.0f * y)) & 1);
}

/* What a render has to know about its pixel. */
typedef struct pixel_view {
    RTCScene scene;
    cs_camera camera;
    const float *lens_table;
    cs_pattern pattern;
    const uint32_t *sample_table;
} pixel_view;

/* The shear for the depth that is seen through the middles of pixel and lens. */
static float shear_of_pixel(const pixel_view *view)
{
    const cs_ray ray = cs_lens_ray(view->camera, PIXEL_X + 0.5f, PIXEL_Y + 0.5f, 0.0f, 0.0f);
    const float depth = trace(view->scene, &ray);
    return isfinite(depth) ? cs_shear_of_depth(view->camera, depth) : 0.0f;
}

/* Mean of the pixel's samples. */
static double render(const pixel_view *view, uint32_t replicate, uint32_t mode, float shear)
{
    const uint32_t key = cs_pattern_key(1, PIXEL_Y * IMAGE_SIDE + PIXEL_X, replicate);
    double sum = 0.0;
    for (uint32_t i = 0; i < view->pattern.grid.count; i++) {
        float t[CS_MAIN_DIMENSIONS] = {0};
        cs_draw(&view->pattern, view->sample_table, key, i, t);
        const cs_camera_sample p =
            cs_shear(t[0], t[1], t[2], t[3], mode, &view->camera.optics, view->lens_table, shear);
        const cs_ray ray = cs_lens_ray(view->camera, PIXEL_X + p.x, PIXEL_Y + p.y, p.u, p.v);
        sum += (double)checker(&ray, trace(view->scene, &ray));
    }
    return sum / view->pattern.grid.count;
}

/* Prints mean and variance of the pixel; returns the variance. */
static double measure(const pixel_view *view, uint32_t mode, float shear)
{
    double sum = 0.0, square = 0.0;
    for (uint32_t replicate = 0; replicate < REPLICATES; replicate++) {
        const double mean = render(view, replicate, mode, shear);
        sum += mean;
        square += mean * mean;
    }
    const double average = sum / REPLICATES;
    const double variance = (square - sum * average) / (REPLICATES - 1);
    printf("%-10s mean %.4f, variance %.3e\n", mode == CS_SHEAR_NONE ? "unsheared" : "sheared",
           average, variance);
    return variance;
}

/* A camera at the origin that looks down -Z, focused behind the wall. */
static clshear_lens *make_lens(void)
{
    static const double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1};
    clshear_settings *settings = NULL;
    clshear_lens *lens = NULL;
    check(clshear_settings_create(&settings));
    check(clshear_settings_set_integer(settings, CLSHEAR_WIDTH, IMAGE_SIDE));
    check(clshear_settings_set_integer(settings, CLSHEAR_HEIGHT, IMAGE_SIDE));
    check(clshear_settings_set_numbers(settings, CLSHEAR_EYE, eye, 3));
    check(clshear_settings_set_numbers(settings, CLSHEAR_TARGET, target, 3));
    check(clshear_settings_set_number(settings, CLSHEAR_FOV, 40.0));
    check(clshear_settings_set_number(settings, CLSHEAR_LENS_RADIUS, 0.2));
    check(clshear_settings_set_number(settings, CLSHEAR_FOCAL_DISTANCE, 4.0));
    check(clshear_lens_create(settings, &lens));
    clshear_settings_free(settings);
    return lens;
}

int main(void)
{
    clshear_pattern *pattern = NULL;
    clshear_lens *lens = make_lens();
    pixel_view view = {0};
    size_t words, floats;
    check(clshear_pattern_create("sz", SAMPLES, CLSHEAR_ORDER_COHERENT, &pattern));
    check(clshear_pattern_constants(pattern, &view.pattern, sizeof view.pattern));
    view.sample_table = clshear_pattern_table(pattern, &words);
    check(clshear_lens_camera(lens, &view.camera, sizeof view.camera));
    view.lens_table = clshear_lens_table(lens, &floats);

    RTCDevice device = rtcNewDevice(NULL);
    if (device == NULL) {
        fprintf(stderr, "Embree does not start\n");
        return 2;
    }
    view.scene = make_wall(device);
    const double unsheared = measure(&view, CS_SHEAR_NONE, 0.0f);
    const double sheared = measure(&view, CS_SHEAR_EQUAL_AREA, shear_of_pixel(&view));
    printf("the shear divides the variance by %.1f\n", unsheared / sheared);

    rtcReleaseScene(view.scene);
    rtcReleaseDevice(device);
    clshear_lens_free(lens);
    clshear_pattern_free(pattern);
    return sheared < 0.5 * unsheared ? 0 : 1;
}
