/* Scene files as the device sees them: wraps, colours of vertices, smoothness, places far from the
 * origin. */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "render/objects.h"

static clshear_context *context;

static int open_context(void **state)
{
    (void)state;
    context = test_context();
    return 0;
}

static int close_context(void **state)
{
    (void)state;
    clshear_context_free(context);
    return 0;
}

/* Settings for one pixel that is lit head-on, so that radiance is albedo: by a point light at
 * distance 1 with intensity pi. */
static clshear_settings *look_at(double x, double y, double z)
{
    const double pi = 3.14159265358979;
    const double eye[3] = {x, y, z + 2}, target[3] = {x, y, z};
    const double light[6] = {x, y, z + 1, pi, pi, pi};
    clshear_settings *settings = NULL;
    test_ok(clshear_settings_create(&settings));
    test_ok(clshear_settings_set_integer(settings, CLSHEAR_WIDTH, 1));
    test_ok(clshear_settings_set_integer(settings, CLSHEAR_HEIGHT, 1));
    test_ok(clshear_settings_set_integer(settings, CLSHEAR_SPP, 4));
    test_ok(clshear_settings_set_number(settings, CLSHEAR_FOV, 0.05));
    test_ok(clshear_settings_set_number(settings, CLSHEAR_LENS_RADIUS, 0.0));
    test_ok(clshear_settings_set_numbers(settings, CLSHEAR_EYE, eye, 3));
    test_ok(clshear_settings_set_numbers(settings, CLSHEAR_TARGET, target, 3));
    test_ok(clshear_settings_set_numbers(settings, CLSHEAR_LIGHT, light, 6));
    return settings;
}

static void expect_colour(clshear_scene *scene, double x, double y, double z, float r, float g,
                          float b)
{
    const float expected[3] = {r, g, b};
    const char *names[3] = {"R", "G", "B"};
    clshear_settings *settings = look_at(x, y, z);
    clshear_film *film = NULL;
    test_ok(clshear_render(scene, settings, &film));
    for (int c = 0; c < 3; c++) {
        const float value = *clshear_film_channel(film, names[c]);
        if (!(fabsf(value - expected[c]) < 0.01f))
            fail_msg("%s at %g %g is %g, not %g", names[c], x, y, (double)value,
                     (double)expected[c]);
    }
    clshear_film_free(film);
    clshear_settings_free(settings);
}

static clshear_scene *load(const char *path, const clshear_settings *settings)
{
    clshear_scene *scene = NULL;
    test_warnings(); /* of what was before */
    test_ok(clshear_scene_load(context, path, settings, &scene));
    return scene;
}

/* Red and green over blue and white: wrap.ppm. */
static void write_wrap_picture(void)
{
    static const unsigned char picture[] = {'P', '6', '\n', '2', ' ', '2', '\n', '2',
                                            '5', '5', '\n', 255, 0,   0,   0,    255,
                                            0,   0,   0,    255, 255, 255, 255};
    test_bytes("wrap.ppm", picture, sizeof picture);
}

/* A square with the image wrap.ppm, three times each way, wrapped by the sampler's `wrap`. filter:
 * of a texel that is magnified. */
static clshear_scene *load_wrapped(const char *wrap, const char *filter)
{
    char text[2048];
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0,\"scale\":[3,3,1]}],"
             "\"images\":[{\"uri\":\"wrap.ppm\"}],\"textures\":[{\"source\":0,\"sampler\":0}],"
             "\"samplers\":[{\"wrapS\":%s,\"wrapT\":%s,\"magFilter\":%s}],\"materials\":[{"
             "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0,\"extensions\":{"
             "\"KHR_texture_transform\":{\"scale\":[3,3],\"offset\":[-1,-1]}}}}}],"
             "\"meshes\":[{\"primitives\":[{\"mode\":5,\"material\":0,\"attributes\":"
             "{\"POSITION\":0,\"TEXCOORD_0\":1}}]}],\"accessors\":[{\"bufferView\":0,"
             "\"componentType\":5121,\"count\":4,\"type\":\"VEC3\"},{\"bufferView\":0,"
             "\"byteOffset\":16,\"componentType\":5121,\"count\":4,\"type\":\"VEC2\"}],"
             "\"bufferViews\":[{\"buffer\":0,\"byteLength\":32,\"byteStride\":4}],"
             /* corners 00, 10, 01, 11, as bytes; t grows downwards */
             "\"buffers\":[{\"byteLength\":32,\"uri\":\"data:;base64,"
             "AAAAAAEAAAAAAQAAAQEAAAABAAABAQAAAAAAAAEAAAA=\"}]}",
             wrap, wrap, filter);
    return load(test_file("wrap.gltf", text), NULL);
}

/* A square whose texture coordinates run from -1 to 2: the image, red and green over blue and
 * white, is in the middle. */
static void maps_beyond_their_edges(void **state)
{
    static const char *const wraps[2] = {"10497", "33648"};
    (void)state;
    write_wrap_picture();
    test_file("wrap.mtl", "newmtl t\nKd 1 1 1\nmap_Kd -clamp on wrap.ppm\n");
    clshear_scene *scene = load(test_file("wrap.obj", "mtllib wrap.mtl\nv 0 0 0\nv 3 0 0\nv 3 3 0\n"
                                                      "v 0 3 0\nvt -1 -1\nvt 2 -1\nvt 2 2\n"
                                                      "vt -1 2\nusemtl t\nf 1/1 2/2 3/3 4/4\n"),
                                NULL);
    expect_colour(scene, 1.25, 1.25, 0, 0, 0, 1);
    expect_colour(scene, 0.2, 0.2, 0, 0, 0, 1);
    expect_colour(scene, 2.8, 0.1, 0, 1, 1, 1);
    expect_colour(scene, 0.1, 2.9, 0, 1, 0, 0);
    expect_colour(scene, 2.3, 1.5, 0, 0.5f, 1, 0.5f); /* between green and white */
    clshear_scene_free(scene);
    for (int mirror = 0; mirror < 2; mirror++) {
        scene = load_wrapped(wraps[mirror], "9729");
        expect_colour(scene, 1.25, 1.25, 0, 0, 0, 1);
        if (mirror)
            expect_colour(scene, 0.25, 1.25, 0, 1, 1, 1);
        else
            expect_colour(scene, 0.25, 1.25, 0, 0, 0, 1);
        if (mirror)
            expect_colour(scene, 1.25, 2.25, 0, 1, 0, 0);
        else
            expect_colour(scene, 1.25, 2.25, 0, 0, 0, 1);
        clshear_scene_free(scene);
    }
}

/* Texels that do not blend end halfway between their centres, whatever the wrap. */
static void texels_have_edges(void **state)
{
    static const char *const wraps[3] = {"10497", "33648", "33071"};
    (void)state;
    write_wrap_picture();
    for (size_t i = 0; i < sizeof wraps / sizeof *wraps; i++) {
        clshear_scene *scene = load_wrapped(wraps[i], "9728");
        expect_colour(scene, 1.48, 1.02, 0, 0, 0, 1);
        expect_colour(scene, 1.52, 1.48, 0, 1, 1, 1);
        expect_colour(scene, 1.48, 1.52, 0, 1, 0, 0);
        expect_colour(scene, 1.52, 1.98, 0, 0, 1, 0);
        if (i < 2)
            expect_colour(scene, 0.52, 1.02, 0, i == 0, i == 0, 1);
        else
            expect_colour(scene, 0.02, 2.98, 0, 1, 0, 0);
        clshear_scene_free(scene);
    }
}

/* Colours of vertices are interpolated, and multiply the material's. */
static void vertices_have_colours(void **state)
{
    (void)state;
    test_file("half.mtl", "newmtl h\nKd 0.5 0.5 0.5\n");
    clshear_scene *scene =
        load(test_file("ramp.obj", "mtllib half.mtl\nusemtl h\nv -1 -1 0 1 0 0\nv 1 -1 0 0 1 0\n"
                                   "v 1 1 0 0 1 0\nv -1 1 0 1 0 0\nf 1 2 3 4\n"),
             NULL);
    expect_colour(scene, -0.9, 0.3, 0, 0.475f, 0.025f, 0);
    expect_colour(scene, 0.5, -0.2, 0, 0.125f, 0.375f, 0);
    clshear_scene_free(scene);
}

/* A scene far away looks as one at the origin, and its camera is in coordinates of the file. */
static void far_scenes_look_alike(void **state)
{
    double eye[3];
    size_t count = 0;
    clshear_settings *settings = NULL;
    (void)state;
    clshear_scene *scene =
        load(test_file("far.obj", "v 500000 4649776 100\nv 500002 4649776 100\n"
                                  "v 500002 4649778 100\nv 500000 4649778 100\nf 1 2 3 4\n"),
             NULL);
    assert_non_null(strstr(test_warnings(), "far from the origin, at 500001,4649777,100;"));
    expect_colour(scene, 500000.125, 4649777.5, 100, 0.5f, 0.5f, 0.5f);
    expect_colour(scene, 499999.875, 4649777.5, 100, 0, 0, 0); /* beside it */
    test_ok(clshear_settings_create(&settings));
    test_ok(clshear_settings_set_text(settings, CLSHEAR_ORBIT, "0,0"));
    test_ok(clshear_camera_complete(scene, settings));
    test_ok(clshear_settings_get_numbers(settings, CLSHEAR_EYE, eye, 3, &count));
    assert_true(eye[0] == 500001.0 && eye[1] == 4649777.0 && eye[2] > 102.0 && eye[2] < 104.0);
    const clshear_light light = {
        .struct_size = sizeof light, .position = {500001, 4649777, 101}, .colour = {3, 3, 3}};
    test_ok(clshear_scene_add_light(scene, &light));
    clshear_settings_free(settings);
    clshear_scene_free(scene);
}

/* Two planes that meet at 90 degrees: beside their edge, the smooth normal faces the light. */
static void smoothness_is_a_setting(void **state)
{
    clshear_settings *settings = NULL;
    (void)state;
    const char *path = test_file("roof.obj", "v -1 -1 -1\nv 0 -1 0\nv 0 1 0\nv -1 1 -1\nv 1 -1 -1\n"
                                             "v 1 1 -1\nf 1 2 3 4\nf 2 5 6 3\n");
    clshear_scene *scene = load(path, NULL);
    expect_colour(scene, -0.001, 0, 0, 0.3536f, 0.3536f, 0.3536f); /* cos 45 of 0.5 */
    clshear_scene_free(scene);
    test_ok(clshear_settings_create(&settings));
    test_ok(clshear_settings_set_number(settings, CLSHEAR_SMOOTH, 100.0));
    scene = load(path, settings);
    expect_colour(scene, -0.001, 0, 0, 0.5f, 0.5f, 0.5f);
    clshear_scene_free(scene);
    test_ok(clshear_settings_set_number(settings, CLSHEAR_SMOOTH, 90.0005)); /* to the last digit */
    scene = load(path, settings);
    expect_colour(scene, -0.001, 0, 0, 0.5f, 0.5f, 0.5f);
    clshear_scene_free(scene);
    clshear_settings_free(settings);
}

/* Settings of a render that the scene was not loaded with are told; the same, and none, are not. */
static void settings_of_loading_are_compared(void **state)
{
    const char *path = test_file("roof.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    clshear_settings *loaded = NULL;
    (void)state;
    test_ok(clshear_settings_create(&loaded));
    test_ok(clshear_settings_set_number(loaded, CLSHEAR_SMOOTH, 30.0));
    clshear_scene *scene = load(path, loaded);
    clshear_settings *rendered = test_settings(loaded, 2, 2, 1);
    test_warnings();
    clshear_film_free(test_render(scene, rendered));
    assert_null(strstr(test_warnings(), "loaded"));
    test_set(rendered, CLSHEAR_SMOOTH, "60");
    clshear_film_free(test_render(scene, rendered));
    assert_non_null(
        strstr(test_warnings(), "smooth: the scene was loaded with 30, not with 60, and"));
    clshear_settings_unset(rendered, CLSHEAR_SMOOTH);
    clshear_film_free(test_render(scene, rendered));
    assert_non_null(strstr(test_warnings(), "was loaded with 30, not with no value"));
    clshear_settings_free(rendered);
    clshear_settings_free(loaded);
    clshear_scene_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(maps_beyond_their_edges),
        cmocka_unit_test(texels_have_edges),
        cmocka_unit_test(vertices_have_colours),
        cmocka_unit_test(far_scenes_look_alike),
        cmocka_unit_test(smoothness_is_a_setting),
        cmocka_unit_test(settings_of_loading_are_compared),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
