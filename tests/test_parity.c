/* The device computes the same as the host: tuples equal bit for bit, and sheared points, of what
 * moves too, up to a few ulps. (Division and square root need not be correctly rounded in OpenCL;
 * on CPUs they are.) */
#include "support.h"

#include <math.h>

#include "clshear/device/motion.h"
#include "clshear/device/sampler/time.h"
#include "device/device.h"
#include "kernels/features.h"
#include "kernels/launch.h"

static const int widths[] = {1, 4, 8, 16};
enum {
    WIDTHS = sizeof widths / sizeof *widths
};

static cs_error error;

static void run_points(cs_device *device, const cs_launch *frame, const cs_array *rows,
                       const cs_array *optics, cs_u32 pixel, const cs_f32 *shear,
                       const cs_velocity *velocity, float *points)
{
    cs_buffer *buffer = NULL, *table = NULL, *profiles = NULL;
    const cs_u32 count = frame->pattern.grid.count, packet = (cs_u32)cs_device_packet(device);
    const size_t size = count * CS_POINT_VALUES * sizeof(float);
    assert_int_equal(cs_buffer_create(device, size, NULL, &buffer, &error), CLSHEAR_OK);
    assert_int_equal(
        cs_buffer_create(device, rows->count * sizeof(cs_u32), rows->items, &table, &error),
        CLSHEAR_OK);
    assert_int_equal(
        cs_buffer_create(device, optics->count * sizeof(cs_f32), optics->items, &profiles, &error),
        CLSHEAR_OK);
    const cs_argument arguments[] = {{.value = frame, .size = sizeof *frame},
                                     {.value = &pixel, .size = sizeof pixel},
                                     {.value = shear, .size = sizeof *shear},
                                     {.value = velocity, .size = sizeof *velocity},
                                     {.buffer = table},
                                     {.buffer = profiles},
                                     {.buffer = buffer}};
    const uint32_t features = velocity->x != 0.0f || velocity->y != 0.0f ? CS_FEATURE_MOTION : 0u;
    assert_int_equal(
        CS_RUN_WITH(device, POINTS, features, (count + packet - 1) / packet, arguments, &error),
        CLSHEAR_OK);
    assert_int_equal(cs_buffer_read(buffer, 0, size, points, &error), CLSHEAR_OK);
    cs_buffer_free(buffer);
    cs_buffer_free(table);
    cs_buffer_free(profiles);
}

/* Distance in ulps of 1, because coordinates are sums and differences of this size. */
static double ulps(float a, float b)
{
    return fabs((double)a - (double)b) * 16777216.0;
}

static void compare(const cs_launch *frame, const test_pattern *drawn, const cs_array *optics,
                    cs_u32 pixel, cs_f32 shear, const float *points)
{
    const cs_u32 key = cs_pattern_key(frame->seed, pixel, frame->replicate);
    for (cs_u32 i = 0; i < frame->pattern.grid.count; i++) {
        const float *given = points + (size_t)CS_POINT_VALUES * i;
        cs_f32 t[CS_DIMENSIONS];
        test_draw(drawn, key, i, t);
        cs_camera_sample p = cs_shear(t[0], t[1], t[2], t[3], frame->shear_mode,
                                      &frame->camera.optics, optics->items, shear);
        const float place[4] = {p.x, p.y, p.u, p.v};
        if (memcmp(given, t, sizeof t) != 0)
            fail_msg("%s: sample %u differs", cs_sampler_name(frame->pattern.sampler), i);
        for (cs_u32 k = 0; k < 4; k++)
            assert_at_most(ulps(given[CS_DIMENSIONS + k], place[k]), 16.0);
    }
}

/* The same for what moves. A map's time and place are quotients of a few steps: 64 ulps. */
static void compare_moving(const cs_launch *frame, const test_pattern *drawn,
                           const cs_array *optics, cs_u32 pixel, cs_f32 shear, cs_velocity velocity,
                           const float *points)
{
    const cs_u32 key = cs_pattern_key(frame->seed, pixel, frame->replicate);
    for (cs_u32 i = 0; i < frame->pattern.grid.count; i++) {
        const float *given = points + (size_t)CS_POINT_VALUES * i + CS_DIMENSIONS;
        cs_f32 t[CS_DIMENSIONS];
        test_draw(drawn, key, i, t);
        cs_camera_sample tuple = {t[0], t[1], t[2], t[3]};
        const cs_f32 time = cs_draw_time(&frame->pattern, drawn->rows.items, key, i, 0, &tuple);
        const cs_moving_sample p = cs_shear_moving(
            tuple, time, frame->shear_mode, &frame->camera.optics, optics->items, shear, velocity);
        const float place[5] = {p.point.x, p.point.y, p.point.u, p.point.v, p.time};
        for (cs_u32 k = 0; k < 5; k++)
            assert_at_most(ulps(given[k], place[k]), 64.0);
    }
}

/* A lens of the test: shear, aperture, filter, and shear in pixels. Every sampler is combined with
 * every lens. The toroidal shear supports disks, squares and boxes only. */
typedef struct lens {
    cs_u32 shear_mode;
    clshear_aperture aperture;
    clshear_filter filter;
    cs_f32 shear_px;
} lens;

static const lens lenses[] = {
    {CS_SHEAR_NONE, CLSHEAR_APERTURE_SQUARE, CLSHEAR_FILTER_BOX, 0.0f},
    {CS_SHEAR_NONE, CLSHEAR_APERTURE_DISK, CLSHEAR_FILTER_BOX, 12.0f},
    {CS_SHEAR_NONE, CLSHEAR_APERTURE_IMAGE, CLSHEAR_FILTER_TENT, -3.0f},
    {CS_SHEAR_TOROIDAL, CLSHEAR_APERTURE_SQUARE, CLSHEAR_FILTER_BOX, 0.4f},
    {CS_SHEAR_TOROIDAL, CLSHEAR_APERTURE_DISK, CLSHEAR_FILTER_BOX, -3.0f},
    {CS_SHEAR_EQUAL_AREA, CLSHEAR_APERTURE_DISK, CLSHEAR_FILTER_BOX, -3.0f},
    {CS_SHEAR_EQUAL_AREA, CLSHEAR_APERTURE_DISK, CLSHEAR_FILTER_TENT, 12.0f},
    {CS_SHEAR_EQUAL_AREA, CLSHEAR_APERTURE_DISK, CLSHEAR_FILTER_GAUSSIAN, 0.4f},
    {CS_SHEAR_EQUAL_AREA, CLSHEAR_APERTURE_DISK, CLSHEAR_FILTER_BLACKMAN_HARRIS, 0.0f},
    {CS_SHEAR_EQUAL_AREA, CLSHEAR_APERTURE_SQUARE, CLSHEAR_FILTER_BOX, 12.0f},
    {CS_SHEAR_EQUAL_AREA, CLSHEAR_APERTURE_SQUARE, CLSHEAR_FILTER_TENT, 0.4f},
    {CS_SHEAR_EQUAL_AREA, CLSHEAR_APERTURE_SQUARE, CLSHEAR_FILTER_GAUSSIAN, 0.0f},
    {CS_SHEAR_EQUAL_AREA, CLSHEAR_APERTURE_SQUARE, CLSHEAR_FILTER_BLACKMAN_HARRIS, -3.0f},
    {CS_SHEAR_EQUAL_AREA, CLSHEAR_APERTURE_POLYGON, CLSHEAR_FILTER_BOX, 0.4f},
    {CS_SHEAR_EQUAL_AREA, CLSHEAR_APERTURE_POLYGON, CLSHEAR_FILTER_TENT, 0.0f},
    {CS_SHEAR_EQUAL_AREA, CLSHEAR_APERTURE_POLYGON, CLSHEAR_FILTER_GAUSSIAN, -3.0f},
    {CS_SHEAR_EQUAL_AREA, CLSHEAR_APERTURE_POLYGON, CLSHEAR_FILTER_BLACKMAN_HARRIS, 12.0f},
    {CS_SHEAR_EQUAL_AREA, CLSHEAR_APERTURE_IMAGE, CLSHEAR_FILTER_BOX, 0.0f},
    {CS_SHEAR_EQUAL_AREA, CLSHEAR_APERTURE_IMAGE, CLSHEAR_FILTER_TENT, -3.0f},
    {CS_SHEAR_EQUAL_AREA, CLSHEAR_APERTURE_IMAGE, CLSHEAR_FILTER_GAUSSIAN, 12.0f},
    {CS_SHEAR_EQUAL_AREA, CLSHEAR_APERTURE_IMAGE, CLSHEAR_FILTER_BLACKMAN_HARRIS, 0.4f},
};

/* Motions of the test: each is combined with every lens whose shear knows time, for
 * patterns of 64 samples. */
static const cs_velocity velocities[] = {{8.0f, -3.0f}, {-0.5f, 20.0f}};
enum {
    VELOCITIES = sizeof velocities / sizeof *velocities
};

static cs_optics_tables optics_of(const lens *lens)
{
    const cs_view view = {.aperture = lens->aperture,
                          .blades = 5,
                          .blade_rotation_deg = 11.0f,
                          .anamorphic = 1.5f,
                          .image = test_aperture_image()};
    return test_optics(&view, lens->filter, 0.0f);
}

static void expect_parity(cs_device *device, const lens *lens, const test_pattern *drawn,
                          const cs_optics_tables *optics, cs_u32 pixel)
{
    cs_launch frame = {.pattern = drawn->pattern,
                       .seed = pixel,
                       .replicate = pixel / 3,
                       .shear_mode = lens->shear_mode};
    float *points = malloc(drawn->pattern.grid.count * CS_POINT_VALUES * sizeof *points);
    frame.camera.optics = optics->optics;
    const cs_velocity rest = {0.0f, 0.0f};
    run_points(device, &frame, &drawn->rows, &optics->table, pixel, &lens->shear_px, &rest, points);
    compare(&frame, drawn, &optics->table, pixel, lens->shear_px, points);
    const int knows_time = lens->shear_mode != CS_SHEAR_TOROIDAL;
    for (size_t i = 0; i < VELOCITIES && knows_time && drawn->pattern.grid.count == 64; i++) {
        run_points(device, &frame, &drawn->rows, &optics->table, pixel, &lens->shear_px,
                   &velocities[i], points);
        compare_moving(&frame, drawn, &optics->table, pixel, lens->shear_px, velocities[i], points);
    }
    free(points);
}

static void host_equals_device(void **state)
{
    static const cs_u32 counts[] = {1, 7, 49, 64, 1000};
    (void)state;
    for (int w = 0; w < WIDTHS; w++) {
        cs_device *device = NULL;
        assert_int_equal(cs_device_open(NULL, 0, widths[w], &device, &error), CLSHEAR_OK);
        for (cs_u32 sampler = 0; sampler < CS_SAMPLER_COUNT; sampler++)
            for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
                test_pattern drawn = test_pattern_of(sampler, counts[c], CS_ORDER_COHERENT);
                for (cs_u32 l = 0; l < sizeof lenses / sizeof *lenses; l++) {
                    cs_optics_tables optics = optics_of(&lenses[l]);
                    expect_parity(device, &lenses[l], &drawn, &optics, 1234u + 7u * l + sampler);
                    cs_optics_free(&optics);
                }
                test_pattern_free(&drawn);
            }
        cs_device_close(device);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(host_equals_device)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
