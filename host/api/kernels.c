/* clshear/kernels.h: data for the device headers in other programs' kernels. */
#include "clshear/kernels.h"

#include <stdlib.h>
#include <string.h>

#include "api/arguments.h"
#include "base/array.h"
#include "base/status.h"
#include "device/device.h"
#include "optics/optics.h"
#include "pattern/pattern.h"
#include "scene/camera.h"
#include "settings/view.h"

_Static_assert((int)CLSHEAR_ORDER_COHERENT == (int)CS_ORDER_COHERENT, "orders have equal numbers");
_Static_assert((int)CLSHEAR_ORDER_SEQUENCE == (int)CS_ORDER_SEQUENCE, "orders have equal numbers");

const char *clshear_device_source(void)
{
    return cs_device_source();
}

/* Copies a struct of the device headers. Fails unless the caller's `size` is that of this
 * library. */
static clshear_status give(const char *type, const void *words, size_t real_size, void *target,
                           size_t size)
{
    if (size != real_size)
        return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT,
                       "a %s of %zu bytes: this library has %zu; it and the device headers are of "
                       "different versions",
                       type, size, real_size);
    memcpy(target, words, size);
    return CLSHEAR_OK;
}

/* ------------------------------------------------------------------------------------------------
 * Patterns
 * --------------------------------------------------------------------------------------------- */

struct clshear_pattern {
    cs_pattern constants;
    cs_array table; /* cs_u32; never empty */
};

/* Finds a sampler by name, and its next sample count. */
static clshear_status find_count(const char *name, uint32_t wanted, cs_u32 *sampler,
                                 uint32_t *count)
{
    cs_error *error = cs_thread_error();
    const clshear_status status = cs_sampler_find(name, sampler, error);
    if (status != CLSHEAR_OK) return status;
    const cs_u32 most = cs_sampler_most(*sampler);
    if (wanted < 1 || wanted > most)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "%u samples of sampler %s: must be 1 to %u",
                       wanted, cs_sampler_name(*sampler), most);
    *count = cs_sampler_count(*sampler, wanted);
    return CLSHEAR_OK;
}

clshear_status clshear_sampler_count(const char *sampler, uint32_t wanted, uint32_t *count)
{
    CS_NEEDS(count);
    cs_u32 number;
    return find_count(sampler, wanted, &number, count);
}

clshear_status clshear_pattern_create(const char *sampler, uint32_t wanted,
                                      clshear_sample_order order, clshear_pattern **result)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(result);
    clshear_status status = CLSHEAR_OK;
    cs_error *error = cs_thread_error();
    clshear_pattern *pattern = calloc(1, sizeof *pattern);
    cs_u32 number = 0;
    uint32_t count = 0;
    CS_REQUIRE(pattern != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    CS_REQUIRE(order == CLSHEAR_ORDER_COHERENT || order == CLSHEAR_ORDER_SEQUENCE,
               CLSHEAR_BAD_ARGUMENT, "sample order %d is not known", (int)order);
    CS_TRY(find_count(sampler, wanted, &number, &count));
    pattern->constants = cs_pattern_of(number, 0, count);
    CS_TRY(
        cs_sample_table_make(&pattern->constants, (cs_sample_order)order, &pattern->table, error));
    CS_REQUIRE(pattern->table.count > 0 || cs_array_extend(&pattern->table, 1) != NULL,
               CLSHEAR_OUT_OF_MEMORY, "out of memory");
    *result = pattern;
    pattern = NULL;
done:
    clshear_pattern_free(pattern);
    return status;
}

void clshear_pattern_free(clshear_pattern *pattern)
{
    if (pattern == NULL) return;
    cs_array_free(&pattern->table);
    free(pattern);
}

clshear_status clshear_pattern_constants(const clshear_pattern *pattern, void *constants,
                                         size_t size)
{
    CS_NEEDS(pattern);
    CS_NEEDS(constants);
    return give("cs_pattern", &pattern->constants, sizeof pattern->constants, constants, size);
}

const uint32_t *clshear_pattern_table(const clshear_pattern *pattern, size_t *words)
{
    if (words != NULL) *words = pattern != NULL ? pattern->table.count : 0;
    return pattern != NULL ? pattern->table.items : NULL;
}

/* ------------------------------------------------------------------------------------------------
 * Lenses
 * --------------------------------------------------------------------------------------------- */

struct clshear_lens {
    cs_optics_tables made;
    cs_camera camera;
    clshear_status camera_status; /* CLSHEAR_OK if the settings have a camera */
    cs_error camera_error;
};

/* Makes the camera if the settings have one. */
static void make_camera(const clshear_settings *settings, const cs_view *view, clshear_lens *lens)
{
    lens->camera_status = CLSHEAR_BAD_ARGUMENT;
    if (!cs_is_set(settings, EYE) || !cs_is_set(settings, TARGET) ||
        !(cs_is_set(settings, FOV) || cs_is_set(settings, ORTHOGRAPHIC))) {
        cs_fail(&lens->camera_error, CLSHEAR_BAD_ARGUMENT,
                "a camera needs eye, target and fov or orthographic; they are not set");
        return;
    }
    cs_view upright = *view;
    if (!cs_is_set(settings, UP)) upright.up[1] = 1.0f;
    lens->camera_status =
        cs_camera_frame(&upright, (int)cs_integer(settings, WIDTH),
                        (int)cs_integer(settings, HEIGHT), &lens->camera, &lens->camera_error);
    lens->camera.optics = lens->made.optics;
}

/* Fails for settings that only a scene turns into a lens radius or a focal distance. */
static clshear_status check_numbers(const clshear_settings *settings)
{
    static const int by_scene[] = {CS_INDEX_F_STOP, CS_INDEX_BLUR, CS_INDEX_FOCUS_PIXEL,
                                   CS_INDEX_FOCUS_POINT};
    for (size_t i = 0; i < sizeof by_scene / sizeof *by_scene; i++)
        if (settings->values[by_scene[i]].is_set)
            return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT,
                           "%s: needs a scene; clshear_camera_complete turns it into a number",
                           cs_setting_table[by_scene[i]].name);
    return CLSHEAR_OK;
}

clshear_status clshear_lens_create(const clshear_settings *settings, clshear_lens **result)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(settings);
    CS_NEEDS(result);
    if (check_numbers(settings) != CLSHEAR_OK) return CLSHEAR_BAD_ARGUMENT;
    cs_error *error = cs_thread_error();
    cs_view view;
    clshear_lens *lens = calloc(1, sizeof *lens);
    if (lens == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    cs_view_of(settings, NULL, &view);
    const clshear_status status =
        cs_optics_make(&view, (clshear_filter)cs_integer(settings, FILTER),
                       (float)cs_number(settings, FILTER_WIDTH), &lens->made, error);
    if (status != CLSHEAR_OK) {
        clshear_lens_free(lens);
        return status;
    }
    make_camera(settings, &view, lens);
    *result = lens;
    return CLSHEAR_OK;
}

void clshear_lens_free(clshear_lens *lens)
{
    if (lens == NULL) return;
    cs_optics_free(&lens->made);
    free(lens);
}

clshear_status clshear_lens_optics(const clshear_lens *lens, void *optics, size_t size)
{
    CS_NEEDS(lens);
    CS_NEEDS(optics);
    return give("cs_optics", &lens->made.optics, sizeof lens->made.optics, optics, size);
}

const float *clshear_lens_table(const clshear_lens *lens, size_t *floats)
{
    if (floats != NULL) *floats = lens != NULL ? lens->made.table.count : 0;
    return lens != NULL ? lens->made.table.items : NULL;
}

clshear_status clshear_lens_camera(const clshear_lens *lens, void *camera, size_t size)
{
    CS_NEEDS(lens);
    CS_NEEDS(camera);
    if (lens->camera_status != CLSHEAR_OK)
        return cs_fail(cs_thread_error(), lens->camera_status, "%s", lens->camera_error.message);
    return give("cs_camera", &lens->camera, sizeof lens->camera, camera, size);
}
