/* Scene files: reading and repairs. */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <sys/stat.h>

#include "settings/view.h"

/* A narrow view of (x, y, 0) from a height above it. */
static clshear_settings *looking_down_z(double x, double y, double height)
{
    clshear_settings *settings = test_settings(NULL, 1, 1, 4);
    test_set(settings, CLSHEAR_EYE, "%.9g,%.9g,%.9g", x, y, height);
    test_set(settings, CLSHEAR_TARGET, "%.9g,%.9g,0", x, y);
    test_set(settings, CLSHEAR_UP, "0,1,0");
    test_set(settings, CLSHEAR_FOV, "0.1");
    test_set(settings, CLSHEAR_LENS_RADIUS, "0");
    test_set(settings, CLSHEAR_FOCAL_DISTANCE, "%.9g", height);
    return settings;
}

/* Renders the colour in the middle of a square of half-width 1 in the plane z = 0. The light is
 * head-on at distance 1 with intensity pi, so radiance is albedo. */
static void look_at(clshear_scene *scene, float x, float y, float *colour)
{
    const float pi = 3.14159265f;
    const clshear_light light = {.position = {x, y, 1.0f}, .colour = {pi, pi, pi}};
    clshear_settings *settings = looking_down_z((double)x, (double)y, 2.0);
    test_add_light(scene, &light);
    clshear_film *film = test_render(scene, settings);
    clshear_settings_free(settings);
    colour[0] = *clshear_film_channel(film, "R");
    colour[1] = *clshear_film_channel(film, "G");
    colour[2] = *clshear_film_channel(film, "B");
    clshear_film_free(film);
}

static void expect_colour(clshear_scene *scene, float x, float y, float r, float g, float b)
{
    float colour[3];
    look_at(scene, x, y, colour);
    if (fabsf(colour[0] - r) + fabsf(colour[1] - g) + fabsf(colour[2] - b) > 0.01f)
        fail_msg("colour %g %g %g, not %g %g %g", (double)colour[0], (double)colour[1],
                 (double)colour[2], (double)r, (double)g, (double)b);
}

#define SQUARE "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"

static void obj_polygons_and_negative_indices(void **state)
{
    clshear_context *context = *state;
    const char *path = test_file("polygons.obj", SQUARE "v 0 1.5 0\nf 1 2 3 5 4\n"
                                                        "v 2 -1 0\nv 4 -1 0\nv 4 1 0\nv 2 1 0\n"
                                                        "f -4 -3 -2 -1\n");
    clshear_scene *scene = test_load(context, path);
    assert_int_equal(test_scene_info(scene).triangles, 3 + 2);
    expect_colour(scene, 3.0f, 0.0f, 0.5f, 0.5f, 0.5f);
    clshear_scene_free(scene);
}

/* Material files in several statements, and several names in one statement. */
static void several_material_files(void **state)
{
    clshear_context *context = *state;
    const char *const statements[] = {"mtllib red.mtl\nmtllib blue.mtl\n",
                                      "mtllib red.mtl blue.mtl\n"};
    test_file("red.mtl", "newmtl red\nKd 0.8 0.1 0.1\n");
    test_file("blue.mtl", "newmtl blue\nKd 0.1 0.2 0.9\n");
    for (int k = 0; k < 2; k++) {
        char text[512];
        snprintf(text, sizeof text, "%s%s", statements[k],
                 SQUARE "v 2 -1 0\nv 4 -1 0\nv 4 1 0\nv 2 1 0\n"
                        "usemtl red\nf 1 2 3 4\nusemtl blue\nf 5 6 7 8\n");
        const char *path = test_file("materials.obj", text);
        clshear_scene *scene = test_load(context, path);
        assert_string_equal(test_warnings(), "");
        expect_colour(scene, 0, 0, 0.8f, 0.1f, 0.1f);
        clshear_scene_free(scene);
        scene = test_load(context, path);
        expect_colour(scene, 3, 0, 0.1f, 0.2f, 0.9f);
        clshear_scene_free(scene);
    }
}

static void emission_is_seen(void **state)
{
    clshear_context *context = *state;
    test_file("glow.mtl", "newmtl glow\nKd 0 0 0\nKe 2 3 4\n");
    clshear_scene *scene = test_load(
        context, test_file("glow.obj", "mtllib glow.mtl\n" SQUARE "usemtl glow\nf 1 2 3 4\n"));
    assert_int_equal(test_scene_info(scene).emitters, 2);
    expect_colour(scene, 0, 0, 2.0f, 3.0f, 4.0f);
    clshear_scene_free(scene);
}

/* Writes a 2 x 2 picture. The lower left texel is the first one of the last row. */
static void write_picture(const char *name)
{
    const unsigned char bytes[] = {'P', '6', '\n', '2', ' ', '2', '\n', '2', '5', '5', '\n', 255,
                                   0,   0,   0,    255, 0,   0,   0,    255, 255, 255, 255};
    test_bytes(name, bytes, sizeof bytes);
}

static void textures_are_bilinear_and_upright(void **state)
{
    clshear_context *context = *state;
    write_picture("four.ppm");
    test_file("textured.mtl", "newmtl t\nKd 1 1 1\nmap_Kd four.ppm\n");
    const char *path = test_file("textured.obj", "mtllib textured.mtl\n" SQUARE
                                                 "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl t\n"
                                                 "f 1/1 2/2 3/3 4/4\n");
    const float expected[][5] = {
        {-0.5f, -0.5f, 0, 0, 1}, /* centres of the texels */
        {0.5f, -0.5f, 1, 1, 1},        {-0.5f, 0.5f, 1, 0, 0},
        {0.5f, 0.5f, 0, 1, 0},         {0.0f, 0.5f, 0.5f, 0.5f, 0}, /* between red and green */
        {0.0f, 0.0f, 0.5f, 0.5f, 0.5f}};
    for (int i = 0; i < 6; i++) {
        clshear_scene *scene = test_load(context, path);
        expect_colour(scene, expected[i][0], expected[i][1], expected[i][2], expected[i][3],
                      expected[i][4]);
        clshear_scene_free(scene);
    }
}

/* Texture names may be URIs, as in glTF. */
static void texture_names_are_decoded(void **state)
{
    clshear_context *context = *state;
    write_picture("my four.ppm");
    test_file("spaced.mtl", "newmtl t\nKd 1 1 1\nmap_Kd my%20four.ppm\n");
    clshear_scene *scene =
        test_load(context, test_file("spaced.obj", "mtllib spaced.mtl\n" SQUARE
                                                   "vt 0.25 0.25\nusemtl t\nf 1/1 2/1 3/1 4/1\n"));
    assert_string_equal(test_warnings(), "");
    expect_colour(scene, 0.3f, 0.1f, 0, 0, 1);
    clshear_scene_free(scene);
}

/* Huge texture coordinates do not read outside the image. */
static void wild_texture_coordinates_are_safe(void **state)
{
    clshear_context *context = *state;
    float colour[3];
    write_picture("four.ppm");
    test_file("wild.mtl", "newmtl t\nKd 1 1 1\nmap_Kd four.ppm\n");
    clshear_scene *scene = test_load(
        context, test_file("wild.obj", "mtllib wild.mtl\n" SQUARE
                                       "vt 3e38 3e38\nvt -3e38 0\nvt nan 1\nvt 0.99999999 1\n"
                                       "usemtl t\nf 1/1 2/2 3/3 4/4\n"));
    look_at(scene, 0.1f, 0.2f, colour);
    for (int c = 0; c < 3; c++)
        assert_true(colour[c] >= 0.0f && colour[c] <= 1.01f);
    clshear_scene_free(scene);
}

/* A tilted vertex normal darkens a surface that is itself head-on: cos 60 degrees. */
static void smooth_normals_shade(void **state)
{
    clshear_context *context = *state;
    clshear_scene *scene = test_load(
        context, test_file("smooth.obj", SQUARE "vn 0.8660254 0 0.5\nf 1//1 2//1 3//1 4//1\n"));
    expect_colour(scene, 0, 0, 0.25f, 0.25f, 0.25f);
    clshear_scene_free(scene);
}

static void missing_parts_become_grey(void **state)
{
    clshear_context *context = *state;
    clshear_scene *scene = test_load(
        context, test_file("bare.obj", "mtllib nowhere.mtl\n" SQUARE "usemtl lost\nf 1 2 3 4\n"));
    assert_non_null(strstr(test_warnings(), "nowhere.mtl"));
    expect_colour(scene, 0, 0, 0.5f, 0.5f, 0.5f);
    clshear_scene_free(scene);
    test_file("nomap.mtl", "newmtl t\nKd 1 0 0\nmap_Kd nomap.png\n");
    scene = test_load(context, test_file("nomap.obj", "mtllib nomap.mtl\n" SQUARE
                                                      "vt 0 0\nusemtl t\nf 1/1 2/1 3/1 4/1\n"));
    assert_non_null(strstr(test_warnings(), "nomap.png"));
    expect_colour(scene, 0, 0, 0.5f, 0.5f, 0.5f);
    clshear_scene_free(scene);
}

static void degenerate_triangles_are_dropped(void **state)
{
    clshear_context *context = *state;
    clshear_scene *scene = test_load(
        context, test_file("thin.obj", SQUARE "f 1 2 3\nf 1 1 2\nf 1 2 2\nv 0 -1 0\nf 1 2 5\n"));
    assert_int_equal(test_scene_info(scene).triangles, 1);
    assert_int_equal(test_scene_info(scene).degenerate, 3);
    assert_non_null(strstr(test_warnings(), "3 triangles without area"));
    clshear_scene_free(scene);
}

static void other_formats(void **state)
{
    clshear_context *context = *state;
    clshear_scene *scene =
        test_load(context, test_file("square.ply",
                                     "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                                     "property float y\nproperty float z\nelement face 1\n"
                                     "property list uchar int vertex_indices\nend_header\n"
                                     "-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n4 0 1 2 3\n"));
    assert_int_equal(test_scene_info(scene).triangles, 2);
    clshear_scene_free(scene);
    scene = test_load(context, test_file("one.stl", "solid one\nfacet normal 0 0 1\nouter loop\n"
                                                    "vertex -1 -1 0\nvertex 1 -1 0\nvertex 0 1 0\n"
                                                    "endloop\nendfacet\nendsolid one\n"));
    assert_int_equal(test_scene_info(scene).triangles, 1);
    clshear_scene_free(scene);
}

/* A glTF triangle with a camera and a point light; the buffer is embedded in base 64. */
static const char seen_and_lit[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1,2]}],"
    "\"extensionsUsed\":[\"KHR_lights_punctual\"],"
    "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"point\","
    "\"color\":[1,0.5,0.25],\"intensity\":8}]}},"
    "\"nodes\":[{\"mesh\":0},{\"camera\":0,\"translation\":[0.25,0.25,3]},"
    "{\"translation\":[0,0,2],\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}],"
    "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.7,"
    "\"aspectRatio\":1.5,\"znear\":0.1}}],"
    "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.2,0.4,0.6,1]}}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,"
    "\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,0]}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
    "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}";

static void gltf_with_camera_and_light(void **state)
{
    clshear_context *context = *state;
    clshear_scene *scene = test_load(context, test_file("scene.gltf", seen_and_lit));
    const clshear_scene_info info = test_scene_info(scene);
    assert_int_equal(info.triangles, 1);
    assert_int_equal(info.lights, 1);
    assert_int_equal(info.file_camera, 1);
    clshear_settings *settings = test_settings(NULL, 300, 200, 256);
    cs_view view;
    test_ok(clshear_camera_complete(scene, settings));
    cs_view_of(settings, NULL, &view);
    clshear_settings_free(settings);
    assert_near(view.eye[0], 0.25f, 1e-5f);
    assert_near(view.eye[2], 3.0f, 1e-5f);
    assert_near(view.target[2], 2.0f, 1e-4f);
    assert_above(view.up[1], 0.99f);
    assert_near(view.fov_deg, 0.7f * 57.29578f, 0.01f);
    /* Head-on below the light: albedo / pi * intensity / 2^2. */
    settings = looking_down_z(0.02, 0.02, 1.0);
    clshear_film *film = test_render(scene, settings);
    clshear_settings_free(settings);
    assert_near(*clshear_film_channel(film, "R") / (0.2f / 3.14159265f * 2.0f), 1, 0.01f);
    assert_near(*clshear_film_channel(film, "B") / (0.6f / 3.14159265f * 0.5f), 1, 0.01f);
    clshear_film_free(film);
    clshear_scene_free(scene);
}

static void invalid_colours_become_black(void **state)
{
    clshear_context *context = *state;
    test_file("odd.mtl", "newmtl a\nKd inf 1 1\nnewmtl b\nKd 0.5 0.25 1\nKe -5 nan 1e38\n");
    clshear_scene *scene =
        test_load(context, test_file("odd.obj", "mtllib odd.mtl\n" SQUARE
                                                "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n"));
    const char *warnings = test_warnings();
    assert_non_null(strstr(warnings, "material \"a\" has the colour inf 1 1"));
    assert_non_null(strstr(warnings, "material \"b\" has the colour -5 nan 1e+38"));
    expect_colour(scene, -0.5f, 0.5f, 0.5f, 0.25f, 1);
    assert_int_equal(test_scene_info(scene).emitters, 0);
    const clshear_light lights[] = {
        {.struct_size = sizeof *lights, .kind = (clshear_light_kind)9, .colour = {1, 1, 1}},
        {.struct_size = sizeof *lights, .colour = {1e38f, 1, 1}},
        {.struct_size = sizeof *lights, .position = {NAN, 0, 0}}};
    for (int i = 0; i < 3; i++)
        test_refused(clshear_scene_add_light(scene, &lights[i]), CLSHEAR_BAD_ARGUMENT, "light");
    clshear_scene_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(obj_polygons_and_negative_indices),
        cmocka_unit_test(several_material_files),
        cmocka_unit_test(emission_is_seen),
        cmocka_unit_test(textures_are_bilinear_and_upright),
        cmocka_unit_test(texture_names_are_decoded),
        cmocka_unit_test(wild_texture_coordinates_are_safe),
        cmocka_unit_test(smooth_normals_shade),
        cmocka_unit_test(missing_parts_become_grey),
        cmocka_unit_test(degenerate_triangles_are_dropped),
        cmocka_unit_test(other_formats),
        cmocka_unit_test(gltf_with_camera_and_light),
        cmocka_unit_test(invalid_colours_become_black),
    };
    return cmocka_run_group_tests(tests, test_open_context, test_close_context);
}
