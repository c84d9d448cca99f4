#include "support.h"

#include <stdio.h>

#include "clshear/device/sampler/sampler.h"

static char warnings[8192];
static char shown[8192];

static void keep_warning(void *user, const char *line)
{
    (void)user;
    size_t used = strlen(warnings);
    snprintf(warnings + used, sizeof warnings - used, "%s\n", line);
}

clshear_context *test_context(void)
{
    clshear_context *context = NULL;
    clshear_context_options options = clshear_context_defaults();
    options.warn = keep_warning;
    if (clshear_context_create(&options, &context) != CLSHEAR_OK)
        fail_msg("%s", clshear_message(NULL));
    return context;
}

void test_ok(const clshear_context *context, clshear_status status)
{
    if (status != CLSHEAR_OK) fail_msg("%s", clshear_message(context));
}

const char *test_path(const char *name)
{
    static char paths[4][1024];
    static int next;
    char *path = paths[next++ % 4];
    snprintf(path, sizeof paths[0], "%s/%s", SCRATCH, name);
    return path;
}

const char *test_file(const char *name, const char *text)
{
    const char *path = test_path(name);
    FILE *stream = fopen(path, "wb");
    assert_non_null(stream);
    fputs(text, stream);
    fclose(stream);
    return path;
}

const char *test_warnings(void)
{
    memcpy(shown, warnings, sizeof shown);
    warnings[0] = '\0';
    return shown;
}

clshear_scene *test_floor(clshear_context *context, float half, float albedo)
{
    const float positions[12] = {-half, 0, -half, half, 0, -half, half, 0, half, -half, 0, half};
    const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    const clshear_mesh mesh = {.positions = positions,
                               .indices = indices,
                               .vertex_count = 4,
                               .triangle_count = 2,
                               .diffuse = {albedo, albedo, albedo}};
    clshear_scene *scene = NULL;
    test_ok(context, clshear_scene_create(context, &mesh, 1, &scene));
    return scene;
}

clshear_scene *test_cornell(clshear_context *context, clshear_camera *camera)
{
    clshear_scene *scene = NULL;
    const clshear_light light = {.vector = {278, 430, -20}, .colour = {230000, 215000, 185000}};
    test_ok(context, clshear_scene_load(context, SCENES "/cornell.obj", &scene));
    test_ok(context, clshear_scene_add_light(scene, &light));
    *camera = (clshear_camera){.eye = {276.4f, 274.4f, 800},
                               .target = {276.4f, 274.4f, 0},
                               .up = {0, 1, 0},
                               .fov_deg = 36.0f,
                               .lens_radius = 25.0f,
                               .focal_distance = 930.0f};
    return scene;
}

int test_open_cornell(void **state)
{
    test_fixture *made = calloc(1, sizeof *made);
    made->context = test_context();
    made->scene = test_cornell(made->context, &made->camera);
    *state = made;
    return 0;
}

int test_close(void **state)
{
    test_fixture *made = *state;
    clshear_scene_free(made->scene);
    clshear_context_free(made->context);
    free(made);
    return 0;
}

test_pattern test_pattern_of(cs_u32 sampler, cs_u32 count, cs_sample_order order)
{
    cs_error error;
    test_pattern made;
    made.pattern = cs_pattern_of(sampler, 0, cs_sampler_count(sampler, count));
    if (cs_sample_table_make(&made.pattern, order, &made.rows, &error) != CLSHEAR_OK)
        fail_msg("%s", error.message);
    return made;
}

void test_pattern_free(test_pattern *pattern)
{
    cs_array_free(&pattern->rows);
}

void test_draw(const test_pattern *pattern, cs_u32 key, cs_u32 index, cs_f32 *tuple)
{
    cs_draw_all(&pattern->pattern, pattern->rows.items, key, index, tuple);
}

cs_optics_tables test_optics(const clshear_camera *camera, clshear_filter filter, float width_px)
{
    cs_error error;
    cs_optics_tables tables = {0};
    assert_int_equal(cs_optics_make(camera, filter, width_px, &tables, &error), CLSHEAR_OK);
    return tables;
}

const clshear_aperture_image *test_aperture_image(void)
{
    static float luminance[5 * 4] = {0, 1, 0, 2, 3, 1, 4, 0, 0, 2, 0, 0, 0, 1, 1, 5, 2, 0, 0, 0};
    static const clshear_aperture_image image = {luminance, 5, 4};
    return &image;
}
