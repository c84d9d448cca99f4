/* The oracle: depth to shear, without tracing. */
#include "support.h"

#include <math.h>

#include "lens.h"
#include "oracle/oracle.h"

/* s = A / w * (F / z - 1): positive in front of the focal plane, zero on it, negative behind; what
 * sees nothing is not sheared. */
static void depth_becomes_shear(void **state)
{
    (void)state;
    const cs_camera camera = {.focal_distance = 4.0f, .pixel_width = 0.01f, .aperture_width = 0.2f};
    const float depth[5] = {2.0f, 4.0f, 8.0f, 1e30f, INFINITY};
    const float expected[5] = {20.0f, 0.0f, -10.0f, -20.0f, 0.0f};
    float shear[5];
    cs_oracle_centre(&camera, depth, 5, shear);
    for (int i = 0; i < 5; i++)
        assert_true(fabsf(shear[i] - expected[i]) < 1e-4f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(depth_becomes_shear)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
