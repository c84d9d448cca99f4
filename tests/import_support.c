#include "import_support.h"

#include <math.h>
#include <stdio.h>

char import_warnings[8192];

void import_collect(void *user, const char *line)
{
    const size_t used = strlen(import_warnings);
    (void)user;
    snprintf(import_warnings + used, sizeof import_warnings - used, "%s\n", line);
}

void import_picture(const char *name)
{
    const unsigned char bytes[] = {'P', '6', '\n', '2', ' ', '2', '\n', '2', '5', '5', '\n', 255,
                                   0,   0,   0,    255, 0,   0,   0,    255, 255, 255, 255};
    test_bytes(name, bytes, sizeof bytes);
}

clshear_status import_smooth(const char *path, double degrees, cs_scene *scene, cs_error *error)
{
    const cs_log log = {.warn = import_collect};
    const cs_import_options options = {.smooth_degrees = degrees};
    import_warnings[0] = error->message[0] = '\0';
    cs_scene_init(scene);
    return cs_import_here(path, &options, NULL, scene, &log, error);
}

cs_scene import_load(const char *path)
{
    cs_scene scene;
    cs_error error;
    if (import_smooth(path, -1.0, &scene, &error) != CLSHEAR_OK) fail_msg("%s", error.message);
    return scene;
}

cs_scene import_apart(const char *path)
{
    const cs_import_options options = {.smooth_degrees = -1.0};
    const cs_log log = {.warn = import_collect};
    cs_scene scene;
    cs_error error = {0};
    import_warnings[0] = '\0';
    cs_scene_init(&scene);
    if (cs_scene_import(path, &options, &scene, &log, &error) != CLSHEAR_OK)
        fail_msg("%s", error.message);
    return scene;
}

cs_scene import_text(const char *name, const char *text)
{
    return import_load(test_file(name, text));
}

void import_refused(const char *path, const char *words)
{
    cs_scene scene;
    cs_error error;
    assert_int_equal(import_smooth(path, -1.0, &scene, &error), CLSHEAR_BAD_FILE);
    if (strstr(error.message, words) == NULL)
        fail_msg("\"%s\" does not contain \"%s\"", error.message, words);
    assert_null(strchr(error.message, '\n'));
    assert_int_equal(strncmp(error.message, path, strlen(path)), 0);
    cs_scene_free(&scene);
}

void import_warned(const char *words)
{
    if (strstr(import_warnings, words) == NULL)
        fail_msg("\"%s\" does not contain \"%s\"", import_warnings, words);
}

const cs_material *import_material(const cs_scene *scene, size_t triangle)
{
    const uint32_t *numbers = scene->triangle_materials.items;
    return (const cs_material *)scene->materials.items + numbers[triangle];
}

void expect_close(const float *values, float a, float b, float c)
{
    const float expected[3] = {a, b, c};
    for (int i = 0; i < 3; i++)
        if (!(fabsf(values[i] - expected[i]) < 1e-4f))
            fail_msg("%g %g %g is not %g %g %g", (double)values[0], (double)values[1],
                     (double)values[2], (double)a, (double)b, (double)c);
}

const uint32_t *import_corners(const cs_scene *scene, size_t triangle)
{
    return ((const uint32_t(*)[3])scene->indices.items)[triangle];
}

const cs_vertex *import_vertex(const cs_scene *scene, size_t triangle, int corner)
{
    return (const cs_vertex *)scene->vertices.items + import_corners(scene, triangle)[corner];
}

const float *import_position(const cs_scene *scene, size_t triangle, int corner)
{
    return ((const float(*)[3])scene->positions.items)[import_corners(scene, triangle)[corner]];
}

const float *import_colour(const cs_scene *scene, size_t triangle, int corner)
{
    assert_int_equal(scene->colours.count, scene->positions.count);
    return ((const cs_colour *)scene->colours.items)[import_corners(scene, triangle)[corner]].value;
}

void expect_st(const cs_scene *scene, int corner, float s, float t)
{
    const float *st = import_vertex(scene, 0, corner)->texture;
    if (fabsf(st[0] - s) > 1e-5f || fabsf(st[1] - t) > 1e-5f)
        fail_msg("%g %g is not %g %g", (double)st[0], (double)st[1], (double)s, (double)t);
}

double import_area(const cs_scene *scene)
{
    double sum = 0.0;
    for (size_t i = 0; i < scene->indices.count; i++) {
        const float *a = import_position(scene, i, 0), *b = import_position(scene, i, 1);
        const float *c = import_position(scene, i, 2);
        sum += 0.5 * fabs((double)((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])));
    }
    return sum;
}

/* A buffer with 4 positions (48 bytes), 4 pairs of ushort at 48 and 4 of float at 64, 6 bytes of
 * indices at 96, 4 quads of ubyte at 104. */
static char *gltf_buffer_uri(void)
{
    static char uri[512];
    static const char letters[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const float positions[12] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    const uint16_t pairs[8] = {0, 65535, 65535, 65535, 65535, 0, 0, 0};
    const float others[8] = {0.25f, 0.25f, 0.5f, 0.25f, 0.5f, 0.5f, 0.25f, 0.5f};
    const unsigned char indices[6] = {0, 1, 2, 0, 2, 3};
    unsigned char bytes[120] = {0};
    memcpy(bytes, positions, sizeof positions);
    memcpy(bytes + 48, pairs, sizeof pairs);
    memcpy(bytes + 64, others, sizeof others);
    memcpy(bytes + 96, indices, sizeof indices);
    for (int i = 0; i < 4; i++) /* the last one fades */
        memcpy(bytes + 104 + 4 * i, (const unsigned char[]){255, 0, 51, i == 3 ? 128 : 255}, 4);
    size_t used = (size_t)snprintf(uri, sizeof uri, "data:;base64,");
    for (size_t i = 0; i < sizeof bytes; i += 3) {
        const uint32_t word = (uint32_t)bytes[i] << 16 | (uint32_t)bytes[i + 1] << 8 | bytes[i + 2];
        for (int k = 3; k >= 0; k--)
            uri[used++] = letters[word >> 6 * k & 63];
    }
    uri[used] = '\0';
    return uri;
}

const char *import_gltf_square(const char *attributes, const char *material, const char *nodes,
                               const char *more)
{
    char text[8192];
    snprintf(
        text, sizeof text,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
        "\"nodes\":[%s],\"materials\":[%s],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0%s},\"indices\":3,"
        "\"material\":0}]}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":48,\"componentType\":5123,\"normalized\":true,"
        "\"count\":4,\"type\":\"VEC2\"},"
        "{\"bufferView\":0,\"byteOffset\":64,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"},"
        "{\"bufferView\":0,\"byteOffset\":96,\"componentType\":5121,\"count\":6,"
        "\"type\":\"SCALAR\"},"
        "{\"bufferView\":0,\"byteOffset\":104,\"componentType\":5121,\"normalized\":true,"
        "\"count\":4,\"type\":\"VEC4\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":120}],"
        "\"images\":[{\"uri\":\"my%%20four.ppm\"}],\"textures\":[{\"source\":0,\"sampler\":0}],"
        "\"samplers\":[{\"wrapS\":33071,\"wrapT\":33648}],"
        "\"buffers\":[{\"byteLength\":120,\"uri\":\"%s\"}]%s}",
        nodes, material, attributes, gltf_buffer_uri(), more);
    return test_file("square.gltf", text);
}
