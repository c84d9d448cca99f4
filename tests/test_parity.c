/* The device computes what the host computes: the same tuples to the bit, sheared points to a few
 * ulps (division and square root need not be correctly rounded in OpenCL; on CPUs they are). */
#include "support.h"

#include <math.h>

#include "device/device.h"
#include "frame.h"
#include "shear.h"

static const int widths[] = {1, 4, 8, 16};
enum {
    WIDTHS = sizeof widths / sizeof *widths,
    VALUES = 8
};

static cs_error error;

static void run_points(cs_device *device, const cs_frame *frame, u32 pixel, f32 shear,
                       float *points)
{
    cs_buffer *buffer = NULL;
    const size_t size = frame->grid.count * VALUES * sizeof(float);
    const size_t packets =
        (frame->grid.count + (u32)cs_device_packet(device) - 1) / (u32)cs_device_packet(device);
    assert_int_equal(cs_buffer_create(device, size, NULL, &buffer, &error), CLSHEAR_OK);
    const cs_argument arguments[] = {{.value = frame, .size = sizeof *frame},
                                     {.value = &pixel, .size = sizeof pixel},
                                     {.value = &shear, .size = sizeof shear},
                                     {.buffer = buffer}};
    assert_int_equal(cs_device_run(device, CS_KERNEL_POINTS, packets, arguments, 4, &error),
                     CLSHEAR_OK);
    assert_int_equal(cs_buffer_read(buffer, 0, size, points, &error), CLSHEAR_OK);
    cs_buffer_free(buffer);
}

/* Distance in the last place relative to 1: coordinates are sums and differences of such size. */
static double ulps(float a, float b)
{
    return fabs((double)a - (double)b) * 16777216.0;
}

static void compare(const cs_frame *frame, u32 pixel, f32 shear, const float *points)
{
    const u32 key = cs_pattern_key(frame->seed, pixel, frame->replicate);
    for (u32 i = 0; i < frame->grid.count; i++) {
        cs_pair film = cs_draw_pair(&frame->grid, key, CS_PAIR_FIBRE, i);
        cs_pair lens = cs_draw_pair(&frame->grid, key, CS_PAIR_LENS, i);
        cs_film_lens p = cs_shear(film.x, film.y, lens.x, lens.y, frame->shear_mode,
                                  frame->camera.aperture, shear);
        const float tuple[4] = {film.x, film.y, lens.x, lens.y};
        const float place[4] = {p.x, p.y, p.u, p.v};
        assert_memory_equal(points + VALUES * i, tuple, sizeof tuple);
        for (int k = 0; k < 4; k++)
            assert_true(ulps(points[VALUES * i + 4 + (u32)k], place[k]) <= 16.0);
    }
}

static void host_equals_device(void **state)
{
    (void)state;
    const u32 counts[] = {1, 7, 49, 64, 1000};
    const f32 shears[] = {0.0f, 0.4f, -3.0f, 12.0f};
    for (int w = 0; w < WIDTHS; w++) {
        cs_device *device = NULL;
        assert_int_equal(cs_device_open(NULL, 0, widths[w], &device, &error), CLSHEAR_OK);
        for (size_t k = 0; k < 5; k++)
            for (u32 variant = 0; variant < 24; variant++) {
                float *points = malloc(counts[k] * VALUES * sizeof *points);
                cs_frame frame = {.grid = cs_grid_of(counts[k]),
                                  .seed = variant,
                                  .replicate = variant / 3,
                                  .shear_mode = variant % 3};
                frame.camera.aperture = variant / 3 % 2;
                run_points(device, &frame, 1234u + variant, shears[variant / 6], points);
                compare(&frame, 1234u + variant, shears[variant / 6], points);
                free(points);
            }
        cs_device_close(device);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(host_equals_device)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
