/* The axes of normal maps on smooth surfaces: tangents of vertices, and what they show. */
#include "import_support.h"
#include "material_files.h"
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "scene/tangents.h"

static const float half_way = 0.92387953f, down = -0.38268343f; /* 22.5 degrees below +x */

static int set_up(void **state)
{
    *state = test_context();
    return 0;
}

static int tear_down(void **state)
{
    clshear_context_free(*state);
    return 0;
}

/* Three triangles of one plane. On the first the texture's first coordinate grows along +x, on the
 * second along (1, -1), on the third along +x in the mirror. normals: 1 if the file has them. */
static const char *write_fan(int normals)
{
    material_even_picture("bent.tga", 204, 128, 230, 255); /* (0.6, 0, 0.8) */
    test_file("fan.mtl", "newmtl m\nKd 0.5 0.5 0.5\nnorm bent.tga\n");
    const char *faces =
        normals ? "vn 0 0 1\nf 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\nf 1/1/1 5/5/1 2/2/1\n"
                : "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\nf 1/1 5/5 2/2\n";
    char text[512];
    snprintf(text, sizeof text,
             "mtllib fan.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 -1 0\n"
             "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 0.5\nvt 0 1\n%s",
             faces);
    return test_file("fan.obj", text);
}

static void expect_tangent(const cs_array *tangents, uint32_t vertex, int mirrored, float x,
                           float y)
{
    const cs_tangent *all = tangents->items;
    expect_close(all[2 * vertex + (uint32_t)mirrored].value, x, y, 0);
}

/* The second set is that of the triangle in the mirror; vertices of two triangles have the mean of
 * theirs, weighted by angles, which are equal here. */
static void tangents_of_vertices(void **state)
{
    cs_array tangents = {0};
    cs_error error;
    (void)state;
    cs_scene scene = import_load(write_fan(1));
    assert_int_equal(cs_tangents_make(&scene, &tangents, &error), CLSHEAR_OK);
    assert_int_equal(tangents.count, 2 * scene.vertices.count);
    expect_tangent(&tangents, import_corners(&scene, 0)[0], 0, half_way, down);
    expect_tangent(&tangents, import_corners(&scene, 0)[1], 0, 1, 0);
    expect_tangent(&tangents, import_corners(&scene, 0)[2], 0, half_way, down);
    expect_tangent(&tangents, import_corners(&scene, 1)[2], 0, sqrtf(0.5f), -sqrtf(0.5f));
    for (int k = 0; k < 3; k++)
        expect_tangent(&tangents, import_corners(&scene, 2)[k], 1, 1, 0);
    expect_tangent(&tangents, import_corners(&scene, 2)[1], 0, 0, 0);
    cs_array_free(&tangents);
    /* Flat faces have none, and without a map there is no list. */
    ((uint8_t *)scene.triangle_flags.items)[1] = CS_FACE_TEXTURED;
    assert_int_equal(cs_tangents_make(&scene, &tangents, &error), CLSHEAR_OK);
    expect_tangent(&tangents, import_corners(&scene, 0)[0], 0, 1, 0);
    expect_tangent(&tangents, import_corners(&scene, 1)[2], 0, 0, 0);
    cs_array_free(&tangents);
    for (size_t i = 0; i < scene.materials.count; i++)
        ((cs_material *)scene.materials.items)[i].normal_texture = 0;
    assert_int_equal(cs_tangents_make(&scene, &tangents, &error), CLSHEAR_OK);
    assert_int_equal(tangents.count, 0);
    cs_scene_free(&scene);
}

/* The normal that a camera before (x, y) sees. */
static void expect_normal(clshear_context *context, const char *path, double x, double y,
                          double across, double up)
{
    clshear_scene *scene = NULL;
    clshear_settings *settings = test_settings(NULL, 1, 1, 4);
    test_set(settings, CLSHEAR_EYE, "%g,%g,4", x, y);
    test_set(settings, CLSHEAR_TARGET, "%g,%g,0", x, y);
    test_set(settings, CLSHEAR_AOV, "%s", "normal");
    test_set_number(settings, CLSHEAR_FOV, 0.01);
    test_set_number(settings, CLSHEAR_LENS_RADIUS, 0.0);
    test_ok(clshear_scene_load(context, path, NULL, &scene));
    clshear_film *film = test_render(scene, settings);
    print_message("at %g %g: %.4f %.4f\n", x, y, (double)*clshear_film_channel(film, "N.X"),
                  (double)*clshear_film_channel(film, "N.Y"));
    /* Bytes of the map round to 0.004. */
    assert_near(*clshear_film_channel(film, "N.X"), across, 0.01);
    assert_near(*clshear_film_channel(film, "N.Y"), up, 0.01);
    clshear_film_free(film);
    clshear_settings_free(settings);
    clshear_scene_free(scene);
}

/* No step where two smooth triangles meet, and none of the mirrored one's; flat ones have their own
 * axes. */
static void maps_pass_edges(void **state)
{
    const double x = 0.6 * (double)half_way, y = 0.6 * (double)down;
    expect_normal(*state, write_fan(1), 0.501, 0.499, x, y);
    expect_normal(*state, write_fan(1), 0.499, 0.501, x, y);
    expect_normal(*state, write_fan(1), 0.998, 0.001, 0.6, 0.0);
    expect_normal(*state, write_fan(1), 0.3, -0.3, 0.6, 0.0);
    expect_normal(*state, write_fan(0), 0.501, 0.499, 0.6, 0.0);
    expect_normal(*state, write_fan(0), 0.499, 0.501, 0.6 * sqrt(0.5), -0.6 * sqrt(0.5));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(tangents_of_vertices),
                                       cmocka_unit_test(maps_pass_edges)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
