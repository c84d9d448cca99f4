/* What the test programs share. Includes cmocka with what it needs. */
#ifndef CS_TESTS_SUPPORT_H
#define CS_TESTS_SUPPORT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "clshear/clshear.h"
#include "optics/optics.h"
#include "pattern/pattern.h"

/* A context on the first device; fails the test if there is none. */
clshear_context *test_context(void);

/* Fails the test, with the context's message, unless `status` is CLSHEAR_OK. */
void test_ok(const clshear_context *context, clshear_status status);

/* Path of a file in the scratch folder; valid for the next few calls. */
const char *test_path(const char *name);

/* Writes a text file into the scratch folder and returns its path. */
const char *test_file(const char *name, const char *text);

/* Warnings of contexts made by test_context since the last call, joined; owned by the support. */
const char *test_warnings(void);

/* A horizontal square of half width `half` at height 0, one triangle pair. */
clshear_scene *test_floor(clshear_context *context, float half, float albedo);

/* scenes/cornell.obj with the light of its settings file, and the camera of that file but for the
 * aperture, which is a disk. */
clshear_scene *test_cornell(clshear_context *context, clshear_camera *camera);

/* The Cornell box, opened and closed by cmocka. */
typedef struct test_fixture {
    clshear_context *context;
    clshear_scene *scene;
    clshear_camera camera;
} test_fixture;

int test_open_cornell(void **state);
int test_close(void **state);

/* Aperture and filter; freed by cs_optics_free. */
cs_optics_tables test_optics(const clshear_camera *camera, clshear_filter filter, float width_px);

/* A small image without any symmetry, with a dark column and dark texels. */
const clshear_aperture_image *test_aperture_image(void);

/* A pattern with its table, to draw from on the host. */
typedef struct test_pattern {
    cs_pattern pattern;
    cs_array rows;
} test_pattern;

/* `count` is raised to the next one that the sampler has. */
test_pattern test_pattern_of(cs_u32 sampler, cs_u32 count, cs_sample_order order);
void test_pattern_free(test_pattern *pattern);

/* Sample `index` of the pattern named by `key`: CS_DIMENSIONS coordinates. */
void test_draw(const test_pattern *pattern, cs_u32 key, cs_u32 index, cs_f32 *tuple);

#endif
