/* Animations of glTF: nodes, skins and morph targets, as vertices at times; and other scenes that
 * move between two files. */
#include "support.h"

#include <locale.h>
#include <math.h>
#include <stdio.h>

#include "import/import.h"

enum {
    FLOATS = 60,
    BYTES = 4 * FLOATS + 12,
    FRAMES = 10
};

static const float root_half = 0.70710678f;

/* Places of the numbers in the buffer: a triangle, times, rotations, weights, a morph target, a
 * joint's cubic path, weights of joints; then the joints, as bytes. */
static void fill(unsigned char *bytes)
{
    const float numbers[FLOATS] = {
        1, 0, 0, 0, 1,    0,         0, 0,         1, /* 0: positions */
        0, 1,                                         /* 9: times, s */
        0, 0, 0, 1, 0,    root_half, 0, root_half,    /* 11: rotations, 0 and 90 degrees */
        0, 1,                                         /* 19: weights of the target */
        0, 0, 2, 0, 0,    2,         0, 0,         2, /* 21: the target */
        0, 0, 0, 0, 0,    0,         0, 0,         0, 0, 0, 0,
        3, 0, 0, 0, 0,    0,                                    /* 30: tangent, place, tangent */
        1, 0, 0, 0, 0.5f, 0.5f,      0, 0,         0, 1, 0, 0}; /* 48: weights of the joints */
    const unsigned char joints[12] = {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
    memcpy(bytes, numbers, sizeof numbers);
    memcpy(bytes + sizeof numbers, joints, sizeof joints);
}

/* A file whose scene has these nodes, of five: 0 turns, 1 takes another shape, 2 has the skin of
 * the joints 3 and 4. */
static const char *animated_file(const char *nodes)
{
    static const char head[] =
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[%s]}],\"nodes\":["
        "{\"mesh\":0},{\"mesh\":1},{\"mesh\":2,\"skin\":0,\"translation\":[9,9,9]},{},{}],"
        "\"skins\":[{\"joints\":[3,4]}],\"meshes\":["
        "{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]},"
        "{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"targets\":[{\"POSITION\":4}]}]},"
        "{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"JOINTS_0\":7,\"WEIGHTS_0\":6}}]}],"
        "\"animations\":[{\"samplers\":[{\"input\":1,\"output\":2},{\"input\":1,\"output\":3},"
        "{\"input\":1,\"output\":5,\"interpolation\":\"CUBICSPLINE\"}],\"channels\":["
        "{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"rotation\"}},"
        "{\"sampler\":1,\"target\":{\"node\":1,\"path\":\"weights\"}},"
        "{\"sampler\":2,\"target\":{\"node\":4,\"path\":\"translation\"}}]}],\"accessors\":[";
    static const struct {
        int offset, count;
        const char *type;
    } accessors[] = {{0, 3, "VEC3"},  {9, 2, "SCALAR"}, {11, 2, "VEC4"}, {19, 2, "SCALAR"},
                     {21, 3, "VEC3"}, {30, 6, "VEC3"},  {48, 3, "VEC4"}, {60, 3, "VEC4"}};
    unsigned char bytes[BYTES];
    char data[2 * BYTES], text[8192];
    fill(bytes);
    test_base64(bytes, sizeof bytes, data);
    size_t used = (size_t)snprintf(text, sizeof text, head, nodes);
    for (size_t i = 0; i < sizeof accessors / sizeof *accessors; i++)
        used += (size_t)snprintf(
            text + used, sizeof text - used,
            "%s{\"bufferView\":0,\"byteOffset\":%d,\"componentType\":%d,\"count\":%d,\"type\":"
            "\"%s\"}",
            i > 0 ? "," : "", 4 * accessors[i].offset, i == 7 ? 5121 : 5126, accessors[i].count,
            accessors[i].type);
    snprintf(text + used, sizeof text - used,
             "],\"bufferViews\":[{\"buffer\":0,\"byteLength\":%d}],\"buffers\":[{\"byteLength\":%d,"
             "\"uri\":\"data:application/octet-stream;base64,%s\"}]}",
             BYTES, BYTES, data);
    return test_file("animated.gltf", text);
}

/* The nine vertices at a time, 0 to 1 s, as glTF 2.0 (3.11 and appendix C) has them. */
static void expected_places(double time, double places[9][3])
{
    const double angle = 0.5 * 3.14159265358979 * time;
    const double path = 3.0 * (3.0 * time * time - 2.0 * time * time * time);
    for (int i = 0; i < 3; i++)
        for (int axis = 0; axis < 3; axis++) {
            const double base = i == axis ? 1.0 : 0.0;
            places[3 + i][axis] = base + (axis == 2 ? 2.0 * time : 0.0);
            places[6 + i][axis] = base + (axis == 0 ? 0.5 * i * path : 0.0);
        }
    const double turned[3][3] = {
        {cos(angle), 0, -sin(angle)}, {0, 1, 0}, {sin(angle), 0, cos(angle)}};
    memcpy(places, turned, sizeof turned);
}

/* The places of `count` vertices that a file has at a time; read in this process, or behind the
 * wall, as a scene is. */
static void expect_places(const char *path, double time_s, const double (*places)[3], size_t count,
                          int behind_wall)
{
    const cs_log log = {0};
    const cs_import_options options = {.smooth_degrees = -1.0, .is_played = 1, .time_s = time_s};
    cs_error error = {{0}};
    cs_scene scene;
    cs_scene_init(&scene);
    const clshear_status status = behind_wall
                                      ? cs_scene_import(path, &options, &scene, &log, &error)
                                      : cs_import_here(path, &options, NULL, &scene, &log, &error);
    if (status != CLSHEAR_OK) fail_msg("%s", error.message);
    assert_int_equal(scene.positions.count, count);
    for (size_t i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++)
            assert_near(((const float(*)[3])scene.positions.items)[i][axis], places[i][axis], 1e-5);
    cs_scene_free(&scene);
}

/* Files with an animated node, with a morph, with a skin, and with all three: ten frames of each,
 * vertex by vertex. Beyond the last key they stand still. */
static void vertices_are_where_the_file_has_them(void **state)
{
    static const struct {
        const char *nodes;
        size_t first, count; /* of the nine vertices */
    } files[] = {{"0", 0, 3}, {"1", 3, 3}, {"2,3,4", 6, 3}, {"0,1,2,3,4", 0, 9}};
    (void)state;
    for (size_t f = 0; f < sizeof files / sizeof *files; f++) {
        const char *path = animated_file(files[f].nodes);
        for (int frame = 0; frame <= FRAMES; frame++) {
            const double time_s = frame / (FRAMES - 1.0);
            double places[9][3];
            expected_places(fmin(time_s, 1.0), places);
            expect_places(path, time_s, (const double(*)[3])(places + files[f].first),
                          files[f].count, 0);
        }
    }
}

/* The time reaches the reader in a program whose locale has decimal commas, too. Skipped where no
 * such locale is installed. */
static void times_know_no_locale(void **state)
{
    double places[9][3];
    (void)state;
    const char *path = animated_file("0");
    expected_places(0.625, places);
    expect_places(path, 0.625, (const double(*)[3])places, 3, 1);
    if (setlocale(LC_ALL, "de_DE.UTF-8") == NULL) skip();
    expect_places(path, 0.625, (const double(*)[3])places, 3, 1);
    setlocale(LC_ALL, "C");
}

/* A file that moves between two files of the same mesh shows what is between them; another mesh is
 * refused. */
static void two_files_are_two_ends(void **state)
{
    (void)state;
    static const char text[] = "v %g 0 0\nv %g 1 0\nv %g 0 1\nf 1 2 3\n%s";
    char from[128], to[128], other[128];
    snprintf(from, sizeof from, text, 0.0, 0.0, 0.0, "");
    snprintf(to, sizeof to, text, 1.0, 2.0, 3.0, "");
    snprintf(other, sizeof other, text, 0.0, 0.0, 0.0, "v 5 5 5\nf 1 2 4\n");
    const char *path = test_file("from.obj", from);
    clshear_context *context = test_context();
    clshear_settings *settings = test_settings(NULL, 8, 8, 16);
    clshear_scene *scene = NULL;
    test_set(settings, CLSHEAR_TO, "%s", test_file("to.obj", to));
    test_set(settings, CLSHEAR_EYE, "0,0.3,5");
    test_set(settings, CLSHEAR_TARGET, "0,0.3,0");
    test_ok(clshear_scene_load(context, path, settings, &scene));
    clshear_film *film = test_render(scene, settings);
    assert_non_null(clshear_film_channel(film, "Velocity.X"));
    clshear_film_free(film);
    clshear_scene_free(scene);
    clshear_settings_unset(settings, CLSHEAR_TO);
    test_set(settings, CLSHEAR_SHUTTER, "0,1");
    test_ok(clshear_scene_load(context, path, settings, &scene));
    assert_non_null(strstr(test_warnings(), "nothing in it moves"));
    clshear_scene_free(scene);
    test_set(settings, CLSHEAR_TO, "%s", test_file("other.obj", other));
    test_refused(clshear_scene_load(context, path, settings, &scene), CLSHEAR_BAD_FILE,
                 "export the same mesh for both");
    clshear_settings_free(settings);
    clshear_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vertices_are_where_the_file_has_them),
        cmocka_unit_test(times_know_no_locale),
        cmocka_unit_test(two_files_are_two_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
