/* Shared code of the test programs. Includes cmocka and the headers it needs. */
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

/* Comparisons that print both numbers. They fail for NaN. */
#define assert_near(a, b, tolerance) \
    test_near((double)(a), (double)(b), (double)(tolerance), #a, __FILE__, __LINE__)
#define assert_below(a, b) test_compare((double)(a), "<", (double)(b), #a, __FILE__, __LINE__)
#define assert_above(a, b) test_compare((double)(a), ">", (double)(b), #a, __FILE__, __LINE__)
#define assert_at_most(a, b) test_compare((double)(a), "<=", (double)(b), #a, __FILE__, __LINE__)
#define assert_at_least(a, b) test_compare((double)(a), ">=", (double)(b), #a, __FILE__, __LINE__)

void test_near(double a, double b, double tolerance, const char *what, const char *file, int line);
void test_compare(double a, const char *relation, double b, const char *what, const char *file,
                  int line);

/* Whether an estimate with a standard error agrees with the truth, up to `bias`, which the caller
 * derives. The limit is the quantile of Student's distribution, at the estimate's degrees of
 * freedom, that one of `checks` such comparisons exceeds by chance with probability 1e-6. */
#define assert_near_estimate(value, truth, error, degrees, checks, bias)                     \
    test_near((double)(value), (double)(truth),                                              \
              test_quantile((degrees), (checks)) * (double)(error) + (double)(bias), #value, \
              __FILE__, __LINE__)

/* That quantile, in standard errors. */
double test_quantile(int degrees, int checks);

/* Creates a context on the first device. Fails the test if there is none. */
clshear_context *test_context(void);

/* Such a context as a fixture: cmocka opens and closes it; *state is the context. */
int test_open_context(void **state);
int test_close_context(void **state);

/* Loads a scene with the fallbacks of all settings. Errors fail the test; test_warnings has what
 * the file warns of. */
clshear_scene *test_load(clshear_context *context, const char *path);

/* Fails the test, with the thread's message, unless `status` is CLSHEAR_OK. */
void test_ok(clshear_status status);

/* Fails the test unless `status` is `expected`, a failure, and its one-line message has `words`. */
#define test_refused(status, expected, words) \
    test_expect_refusal((status), (expected), (words), #status, __FILE__, __LINE__)
void test_expect_refusal(clshear_status status, clshear_status expected, const char *words,
                         const char *call, const char *file, int line);

/* Path of a file in the scratch folder. Valid for the next few calls. */
const char *test_path(const char *name);

/* Writes a file of bytes or of text into the scratch folder and returns its path. */
const char *test_bytes(const char *name, const void *bytes, size_t size);
const char *test_file(const char *name, const char *text);

/* Writes a picture of linear colours: three floats a texel, row by row from the top. */
void test_colours(const char *path, int width, int height, const float *texels);

/* Joined warnings since the last call, of contexts made by test_context. Owned by this file. */
const char *test_warnings(void);

/* Copies `base` (NULL: fallbacks) with another size and number of samples. */
clshear_settings *test_settings(const clshear_settings *base, int width, int height, uint32_t spp);

/* Set a value from formatted text, or a number of any kind except text. Errors fail the test. */
void test_set(clshear_settings *settings, clshear_setting setting, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void test_set_number(clshear_settings *settings, clshear_setting setting, double value);

/* Sets a value of `count` numbers, all of them `value`. At most 12. Returns what became of it. */
clshear_status test_set_all(clshear_settings *settings, clshear_setting setting, size_t count,
                            double value);

/* Settings without values as a fixture: cmocka opens and closes it; *state is the settings. */
int test_open_settings(void **state);
int test_close_settings(void **state);

/* Renders. Errors fail the test. */
clshear_film *test_render(clshear_scene *scene, const clshear_settings *settings);
clshear_film_info test_film_info(const clshear_film *film);
clshear_scene_info test_scene_info(const clshear_scene *scene);

/* The mean over a picture and its standard error, by the film's variances. */
typedef struct test_estimate {
    double mean;
    double error;
} test_estimate;

/* Of a channel that has a Variance. */
test_estimate test_mean(const clshear_film *film, const char *channel);

/* Renders, and frees the settings. */
test_estimate test_mean_of_render(clshear_scene *scene, clshear_settings *settings,
                                  const char *channel);

/* Settings for 4 x 4 pixels straight down on (x, 0, 0) from a height of 1, with direct light and 16
 * replicates: an estimate has 240 degrees of freedom. */
clshear_settings *test_looking_down(double x, int spp);

/* Makes a complete scene of some meshes. Their struct_size need not be set. */
clshear_scene *test_meshes(clshear_context *context, const clshear_mesh *meshes, size_t count);

/* Adds a light. Its struct_size need not be set. */
void test_add_light(clshear_scene *scene, const clshear_light *light);

/* A horizontal square of half-width `half` at height 0, as two triangles. */
clshear_scene *test_floor(clshear_context *context, float half, float albedo);

/* The scene scenes/cornell.obj, and the settings of scenes/cornell.flags with a disk as
 * aperture. */
clshear_scene *test_cornell(clshear_context *context);
clshear_settings *test_cornell_settings(void);

/* The Cornell box as a fixture: cmocka opens and closes it. */
typedef struct test_fixture {
    clshear_context *context;
    clshear_scene *scene;
    clshear_settings *settings;
} test_fixture;

int test_open_cornell(void **state);
int test_close(void **state);

/* Makes the tables of an aperture and a filter. The caller frees them with cs_optics_free. */
cs_optics_tables test_optics(const cs_view *view, clshear_filter filter, float width_px);

/* A small asymmetric image with a dark column and dark texels. */
const cs_aperture_image *test_aperture_image(void);

/* A pattern with its table, for drawing on the host. */
typedef struct test_pattern {
    cs_pattern pattern;
    cs_array rows;
} test_pattern;

/* Makes a pattern. `count` is rounded up to the next sample count of the sampler. */
test_pattern test_pattern_of(cs_u32 sampler, cs_u32 count, cs_sample_order order);
void test_pattern_free(test_pattern *pattern);

/* Draws sample `index` of the pattern with this key: CS_DIMENSIONS coordinates. */
void test_draw(const test_pattern *pattern, cs_u32 key, cs_u32 index, cs_f32 *tuple);

/* Writes bytes as the text of a data URI: 4 letters for 3 bytes, and a final 0. `size` is a
 * multiple of 3. */
void test_base64(const void *data, size_t size, char *text);

#endif
