/* clshear/kernels.h: the words that the device headers work on, for programs of others. */
#include "clshear/kernels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/array.h"
#include "base/status.h"
#include "device/device.h"
#include "optics/optics.h"
#include "pattern/pattern.h"
#include "scene/camera.h"

_Static_assert((int)CLSHEAR_ORDER_COHERENT == (int)CS_ORDER_COHERENT, "orders have equal numbers");
_Static_assert((int)CLSHEAR_ORDER_SEQUENCE == (int)CS_ORDER_SEQUENCE, "orders have equal numbers");

const char *clshear_device_source(void)
{
    return cs_device_source();
}

/* Copies a struct of the device headers to a caller who says that it has `size` bytes there. */
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

static clshear_status out_of_memory(void)
{
    return cs_fail(cs_thread_error(), CLSHEAR_OUT_OF_MEMORY, "out of memory");
}

/* ------------------------------------------------------------------------------------------------
 * Patterns
 * --------------------------------------------------------------------------------------------- */

struct clshear_pattern {
    cs_pattern constants;
    cs_array table; /* cs_u32; never empty */
};

/* Number of a sampler and of its samples from their names. */
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
    cs_u32 number;
    return find_count(sampler, wanted, &number, count);
}

clshear_status clshear_pattern_create(const char *sampler, uint32_t wanted,
                                      clshear_sample_order order, clshear_pattern **result)
{
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
    return give("cs_pattern", &pattern->constants, sizeof pattern->constants, constants, size);
}

const uint32_t *clshear_pattern_table(const clshear_pattern *pattern, size_t *words)
{
    *words = pattern->table.count;
    return pattern->table.items;
}

/* ------------------------------------------------------------------------------------------------
 * Lenses
 * --------------------------------------------------------------------------------------------- */

/* What was asked for, and what was made of it. */
struct clshear_lens {
    clshear_camera request;
    clshear_aperture_image image; /* owned; request.image points to it if there is one */
    clshear_filter filter;
    float filter_width_px;
    cs_optics_tables made;
};

static clshear_status make(const clshear_lens *lens, cs_optics_tables *made)
{
    const clshear_status status = cs_optics_make(&lens->request, lens->filter,
                                                 lens->filter_width_px, made, cs_thread_error());
    if (status != CLSHEAR_OK) cs_optics_free(made);
    return status;
}

/* The lens becomes `changed` if the tables for that can be made. */
static clshear_status change(clshear_lens *lens, clshear_lens changed)
{
    changed.made = (cs_optics_tables){0};
    const clshear_status status = make(&changed, &changed.made);
    if (status != CLSHEAR_OK) return status;
    cs_optics_free(&lens->made);
    *lens = changed;
    return CLSHEAR_OK;
}

clshear_status clshear_lens_create(clshear_lens **result)
{
    clshear_lens *lens = calloc(1, sizeof *lens);
    if (lens == NULL) return out_of_memory();
    lens->request.anamorphic = 1.0f;
    lens->request.focal_distance = 1.0f;
    const clshear_status status = change(lens, *lens);
    if (status != CLSHEAR_OK) {
        clshear_lens_free(lens);
        return status;
    }
    *result = lens;
    return CLSHEAR_OK;
}

void clshear_lens_free(clshear_lens *lens)
{
    if (lens == NULL) return;
    free(lens->image.luminance);
    cs_optics_free(&lens->made);
    free(lens);
}

clshear_status clshear_lens_set_aperture(clshear_lens *lens, const char *aperture, int blades,
                                         float rotation_deg)
{
    clshear_lens changed = *lens;
    for (int kind = CLSHEAR_APERTURE_DISK; kind < CLSHEAR_APERTURE_IMAGE; kind++)
        if (strcmp(aperture, cs_aperture_name((clshear_aperture)kind)) == 0) {
            changed.request.aperture = (clshear_aperture)kind;
            changed.request.blades = blades;
            changed.request.blade_rotation_deg = rotation_deg;
            return change(lens, changed);
        }
    return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT,
                   "aperture \"%s\" is not known; there are disk, square, polygon", aperture);
}

clshear_status clshear_lens_set_image(clshear_lens *lens, const float *luminance, int width,
                                      int height)
{
    clshear_lens changed = *lens;
    const clshear_aperture_image given = {(float *)luminance, width, height};
    cs_optics_tables made = {0};
    changed.request.aperture = CLSHEAR_APERTURE_IMAGE;
    changed.request.image = &given;
    const clshear_status status = make(&changed, &made); /* which checks the image */
    if (status != CLSHEAR_OK) return status;
    const size_t size = (size_t)width * (size_t)height * sizeof *luminance;
    float *copy = malloc(size);
    if (copy == NULL) {
        cs_optics_free(&made);
        return out_of_memory();
    }
    memcpy(copy, luminance, size);
    free(lens->image.luminance);
    cs_optics_free(&lens->made);
    lens->image = (clshear_aperture_image){copy, width, height};
    lens->request.aperture = CLSHEAR_APERTURE_IMAGE;
    lens->request.image = &lens->image;
    lens->made = made;
    return CLSHEAR_OK;
}

clshear_status clshear_lens_set_anamorphic(clshear_lens *lens, float ratio)
{
    clshear_lens changed = *lens;
    if (!(ratio > 0.0f)) ratio = -1.0f; /* out of range; 0 would mean 1 */
    changed.request.anamorphic = ratio;
    return change(lens, changed);
}

clshear_status clshear_lens_set_filter(clshear_lens *lens, const char *filter, float width_px)
{
    clshear_lens changed = *lens;
    for (int kind = 0; cs_filter_name((clshear_filter)kind) != NULL; kind++)
        if (strcmp(filter, cs_filter_name((clshear_filter)kind)) == 0) {
            changed.filter = (clshear_filter)kind;
            changed.filter_width_px = width_px;
            return change(lens, changed);
        }
    return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT,
                   "filter \"%s\" is not known; there are box, tent, gaussian, blackman-harris",
                   filter);
}

clshear_status clshear_lens_set_focus(clshear_lens *lens, float radius, float focal_distance)
{
    if (!(radius >= 0.0f) || !isfinite(radius))
        return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT, "lens radius %g: must be 0 or more",
                       (double)radius);
    if (!(focal_distance > 0.0f) || !isfinite(focal_distance))
        return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT,
                       "focal distance %g: must be above 0", (double)focal_distance);
    lens->request.lens_radius = radius;
    lens->request.focal_distance = focal_distance;
    return CLSHEAR_OK;
}

clshear_status clshear_lens_optics(const clshear_lens *lens, void *optics, size_t size)
{
    return give("cs_optics", &lens->made.optics, sizeof lens->made.optics, optics, size);
}

const float *clshear_lens_table(const clshear_lens *lens, size_t *floats)
{
    *floats = lens->made.table.count;
    return lens->made.table.items;
}

clshear_status clshear_lens_camera(const clshear_lens *lens, const float look_at[9], float fov_deg,
                                   int width, int height, void *camera, size_t size)
{
    cs_error *error = cs_thread_error();
    clshear_camera request = lens->request;
    cs_camera made;
    if (width < 1 || height < 1)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "image of %d x %d pixels: must be 1 x 1 or more", width, height);
    memcpy(request.eye, look_at, sizeof request.eye);
    memcpy(request.target, look_at + 3, sizeof request.target);
    memcpy(request.up, look_at + 6, sizeof request.up);
    request.fov_deg = fov_deg;
    const clshear_status status = cs_camera_frame(&request, width, height, &made, error);
    if (status != CLSHEAR_OK) return status;
    made.optics = lens->made.optics;
    return give("cs_camera", &made, sizeof made, camera, size);
}
