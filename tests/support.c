#include "support.h"

#include <math.h>
#include <stdio.h>

#include "clshear/device/sampler/sampler.h"
#include "image/image_io.h"

static char warnings[8192];
static char shown[8192];

static void keep_warning(void *user, const char *line)
{
    (void)user;
    size_t used = strlen(warnings);
    snprintf(warnings + used, sizeof warnings - used, "%s\n", line);
}

void test_near(double a, double b, double tolerance, const char *what, const char *file, int line)
{
    if (a == b || fabs(a - b) <= tolerance) return;
    print_error("%s is %.9g, not %.9g +- %.3g\n", what, a, b, tolerance);
    _fail(file, line);
}

void test_compare(double a, const char *relation, double b, const char *what, const char *file,
                  int line)
{
    const int equal = relation[1] == '=';
    if (relation[0] == '<' ? a < b : a > b) return;
    if (equal && a == b) return;
    print_error("%s is %.9g, not %s %.9g\n", what, a, relation, b);
    _fail(file, line);
}

/* Probability that Student's t lies beyond +-limit. */
static double tails(int degrees, double limit)
{
    enum {
        STEPS = 4096
    };
    const double pi = 3.14159265358979, n = degrees;
    const double scale = exp(lgamma(0.5 * (n + 1.0)) - lgamma(0.5 * n)) / sqrt(n * pi);
    double sum = 0.0;
    for (int i = 0; i < STEPS; i++) { /* over the inverse of t, in units of the limit's */
        const double s = (i + 0.5) / STEPS, t = limit / s;
        sum += scale * pow(1.0 + t * t / n, -0.5 * (n + 1.0)) * t / s;
    }
    return 2.0 * sum / STEPS;
}

double test_quantile(int degrees, int checks)
{
    double low = 1.0, high = 1e3;
    for (int i = 0; i < 50; i++) {
        const double middle = 0.5 * (low + high);
        *(tails(degrees, middle) > 1e-6 / checks ? &low : &high) = middle;
    }
    return high;
}

clshear_context *test_context(void)
{
    clshear_context *context = NULL;
    test_ok(clshear_context_create(NULL, &context));
    clshear_context_set_warning(context, keep_warning, NULL);
    return context;
}

void test_ok(clshear_status status)
{
    if (status != CLSHEAR_OK) fail_msg("%s: %s", clshear_status_name(status), clshear_message());
}

void test_expect_refusal(clshear_status status, clshear_status expected, const char *words,
                         const char *call, const char *file, int line)
{
    const char *message = status != CLSHEAR_OK ? clshear_message() : "";
    if (status == expected && strstr(message, words) != NULL && strchr(message, '\n') == NULL)
        return;
    print_error("%s: status %d, not %d; \"%s\" is to be one line with \"%s\"\n", call, (int)status,
                (int)expected, message, words);
    _fail(file, line);
}

const char *test_path(const char *name)
{
    static char paths[8][1024];
    static int next;
    char *path = paths[next++ % 8];
    snprintf(path, sizeof paths[0], "%s/%s", SCRATCH, name);
    return path;
}

const char *test_bytes(const char *name, const void *bytes, size_t size)
{
    const char *path = test_path(name);
    FILE *stream = fopen(path, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(bytes, 1, size, stream), size);
    fclose(stream);
    return path;
}

const char *test_file(const char *name, const char *text)
{
    return test_bytes(name, text, strlen(text));
}

void test_colours(const char *path, int width, int height, const float *texels)
{
    const char *const names[3] = {"R", "G", "B"};
    const size_t count = (size_t)width * (size_t)height;
    float *planes = malloc(3 * count * sizeof *planes);
    const float *const list[3] = {planes, planes + count, planes + 2 * count};
    const cs_picture picture = {.width = width,
                                .height = height,
                                .full_width = width,
                                .full_height = height,
                                .channel_count = 3,
                                .names = names,
                                .planes = list};
    cs_error error;
    for (size_t i = 0; i < 3 * count; i++)
        planes[i % 3 * count + i / 3] = texels[i];
    if (cs_image_write(path, &picture, &error) != CLSHEAR_OK) fail_msg("%s", error.message);
    free(planes);
}

const char *test_warnings(void)
{
    memcpy(shown, warnings, sizeof shown);
    warnings[0] = '\0';
    return shown;
}

clshear_settings *test_settings(const clshear_settings *base, int width, int height, uint32_t spp)
{
    clshear_settings *settings = NULL;
    test_ok(base != NULL ? clshear_settings_copy(base, &settings)
                         : clshear_settings_create(&settings));
    test_set_number(settings, CLSHEAR_WIDTH, width);
    test_set_number(settings, CLSHEAR_HEIGHT, height);
    test_set_number(settings, CLSHEAR_SPP, spp);
    return settings;
}

void test_set(clshear_settings *settings, clshear_setting setting, const char *format, ...)
{
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    test_ok(clshear_settings_set_text(settings, setting, text));
}

void test_set_number(clshear_settings *settings, clshear_setting setting, double value)
{
    test_ok(clshear_settings_set_numbers(settings, setting, &value, 1));
}

clshear_status test_set_all(clshear_settings *settings, clshear_setting setting, size_t count,
                            double value)
{
    enum {
        MOST = 12
    };
    double numbers[MOST];
    assert_in_range(count, 1, MOST);
    for (size_t i = 0; i < count; i++)
        numbers[i] = value;
    return clshear_settings_set_numbers(settings, setting, numbers, count);
}

int test_open_settings(void **state)
{
    clshear_settings *settings = NULL;
    test_ok(clshear_settings_create(&settings));
    *state = settings;
    return 0;
}

int test_close_settings(void **state)
{
    clshear_settings_free(*state);
    return 0;
}

clshear_film *test_render(clshear_scene *scene, const clshear_settings *settings)
{
    clshear_film *film = NULL;
    test_ok(clshear_render(scene, settings, &film));
    return film;
}

clshear_film_info test_film_info(const clshear_film *film)
{
    clshear_film_info info = {.struct_size = sizeof info};
    clshear_film_describe(film, &info);
    return info;
}

clshear_scene_info test_scene_info(const clshear_scene *scene)
{
    clshear_scene_info info = {.struct_size = sizeof info};
    clshear_scene_describe(scene, &info);
    return info;
}

test_estimate test_mean(const clshear_film *film, const char *channel)
{
    char name[32];
    test_estimate found = {0.0, 0.0};
    snprintf(name, sizeof name, "Variance.%s", channel);
    const float *value = clshear_film_channel(film, channel);
    const float *variance = clshear_film_channel(film, name);
    const clshear_film_info info = test_film_info(film);
    const int count = info.width * info.height;
    for (int p = 0; p < count; p++) {
        found.mean += (double)value[p] / count;
        found.error += (double)variance[p];
    }
    found.error = sqrt(found.error) / count;
    return found;
}

test_estimate test_mean_of_render(clshear_scene *scene, clshear_settings *settings,
                                  const char *channel)
{
    clshear_film *film = test_render(scene, settings);
    const test_estimate found = test_mean(film, channel);
    clshear_film_free(film);
    clshear_settings_free(settings);
    return found;
}

clshear_settings *test_looking_down(double x, int spp)
{
    clshear_settings *settings = test_settings(NULL, 4, 4, (uint32_t)spp);
    test_set(settings, CLSHEAR_EYE, "%g,1,0", x);
    test_set(settings, CLSHEAR_TARGET, "%g,0,0", x);
    test_set(settings, CLSHEAR_UP, "0,0,-1");
    test_set_number(settings, CLSHEAR_FOV, 0.01);
    test_set_number(settings, CLSHEAR_LENS_RADIUS, 0.0);
    test_set_number(settings, CLSHEAR_FOCAL_DISTANCE, 1.0);
    test_set_number(settings, CLSHEAR_REPLICATES, 16);
    test_set_number(settings, CLSHEAR_BOUNCES, 0.0);
    return settings;
}

clshear_scene *test_meshes(clshear_context *context, const clshear_mesh *meshes, size_t count)
{
    clshear_scene *scene = NULL;
    test_ok(clshear_scene_create(context, &scene));
    for (size_t i = 0; i < count; i++) {
        clshear_mesh mesh = meshes[i];
        mesh.struct_size = sizeof mesh;
        test_ok(clshear_scene_add_mesh(scene, &mesh));
    }
    test_ok(clshear_scene_complete(scene));
    return scene;
}

void test_add_light(clshear_scene *scene, const clshear_light *light)
{
    clshear_light added = *light;
    added.struct_size = sizeof added;
    test_ok(clshear_scene_add_light(scene, &added));
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
    return test_meshes(context, &mesh, 1);
}

clshear_scene *test_cornell(clshear_context *context)
{
    clshear_scene *scene = NULL;
    test_ok(clshear_scene_load(context, SCENES "/cornell.obj", NULL, &scene));
    return scene;
}

clshear_settings *test_cornell_settings(void)
{
    clshear_settings *settings = NULL;
    test_ok(clshear_settings_create(&settings));
    test_ok(clshear_settings_read(settings, SCENES "/cornell.flags", NULL, NULL));
    test_set(settings, CLSHEAR_APERTURE, "disk");
    return settings;
}

int test_open_context(void **state)
{
    *state = test_context();
    return 0;
}

int test_close_context(void **state)
{
    clshear_context_free(*state);
    return 0;
}

clshear_scene *test_load(clshear_context *context, const char *path)
{
    clshear_scene *scene = NULL;
    test_warnings();
    test_ok(clshear_scene_load(context, path, NULL, &scene));
    return scene;
}

int test_open_cornell(void **state)
{
    test_fixture *made = calloc(1, sizeof *made);
    made->context = test_context();
    made->scene = test_cornell(made->context);
    made->settings = test_cornell_settings();
    *state = made;
    return 0;
}

int test_close(void **state)
{
    test_fixture *made = *state;
    clshear_settings_free(made->settings);
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
    if (cs_pattern_parts(&made.pattern) > 1 && count > 128)
        made.pattern.shape[0] = 4; /* many sets of `ccvt` take minutes */
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

cs_optics_tables test_optics(const cs_view *view, clshear_filter filter, float width_px)
{
    cs_error error;
    cs_optics_tables tables = {0};
    assert_int_equal(cs_optics_make(view, filter, width_px, &tables, &error), CLSHEAR_OK);
    return tables;
}

const cs_aperture_image *test_aperture_image(void)
{
    static float luminance[5 * 4] = {0, 1, 0, 2, 3, 1, 4, 0, 0, 2, 0, 0, 0, 1, 1, 5, 2, 0, 0, 0};
    static const cs_aperture_image image = {luminance, 5, 4};
    return &image;
}

void test_base64(const void *data, size_t size, char *text)
{
    static const char letters[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i += 3) {
        const unsigned word = (unsigned)bytes[i] << 16 | (unsigned)bytes[i + 1] << 8 | bytes[i + 2];
        for (unsigned k = 0; k < 4; k++)
            *text++ = letters[word >> (18 - 6 * k) & 63];
    }
    *text = '\0';
}
