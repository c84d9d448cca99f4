/* What emissive triangles light: pictures by both ways to sample them, and by rays alone. */
#include "material_files.h"
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "clshear/device/hash.h"

static float number_at(cs_u32 key, cs_u32 index)
{
    return (float)(cs_key(key, index) >> 8) * 0x1p-24f;
}

/* A view of the floor from (0, 0.4, 0.6), 16 pixels of it. */
static clshear_settings *view_of(clshear_emitters choice, int bounces, int spp)
{
    clshear_settings *settings = test_settings(NULL, 4, 4, (uint32_t)spp);
    test_set(settings, CLSHEAR_EYE, "0,0.4,0.6");
    test_set(settings, CLSHEAR_TARGET, "0,0,0");
    test_set(settings, CLSHEAR_UP, "0,1,0");
    test_set_number(settings, CLSHEAR_FOV, 12.0);
    test_set_number(settings, CLSHEAR_LENS_RADIUS, 0.01);
    test_set_number(settings, CLSHEAR_FOCAL_DISTANCE, 0.7);
    test_set_number(settings, CLSHEAR_REPLICATES, 16);
    test_set_number(settings, CLSHEAR_BOUNCES, bounces);
    test_set_number(settings, CLSHEAR_EMITTERS, choice);
    return settings;
}

static test_estimate mean_of_render(clshear_scene *scene, clshear_settings *settings)
{
    return test_mean_of_render(scene, settings, "G");
}

/* Two estimates of one mean: 5 standard errors, a false alarm of 1e-6. */
static void expect_same(const char *name, test_estimate a, test_estimate b)
{
    const double error = sqrt(a.error * a.error + b.error * b.error);
    print_message("%s: %.5f and %.5f, errors %.5f and %.5f\n", name, a.mean, b.mean, a.error,
                  b.error);
    assert_near(a.mean, b.mean, 5.0 * error + 1e-6);
    assert_above(a.mean, 5.0 * error);
}

enum {
    SPECKS = 400
};

/* A floor under small triangles of eight brightnesses, the brighter the rarer. */
static clshear_scene *specks(clshear_context *context)
{
    static float positions[8][SPECKS / 8 * 9];
    static uint32_t indices[SPECKS / 8 * 3];
    static const float floor_y[12] = {-9, 0, 9, 9, 0, 9, 9, 0, -9, -9, 0, -9};
    static const uint32_t quad[6] = {0, 1, 2, 0, 2, 3};
    clshear_mesh meshes[9] = {[8] = {.positions = floor_y,
                                     .indices = quad,
                                     .vertex_count = 4,
                                     .triangle_count = 2,
                                     .diffuse = {0.5f, 0.5f, 0.5f}}};
    for (cs_u32 i = 0; i < SPECKS / 8 * 3; i++)
        indices[i] = i;
    for (cs_u32 m = 0; m < 8; m++) {
        const float light = ldexpf(1.0f, (int)m - 2);
        for (cs_u32 i = 0; i < SPECKS / 8 * 9; i++) {
            const float spread = i % 3 == 1 ? 2.0f : 9.0f, low = i % 3 == 1 ? 0.7f : -4.5f;
            const cs_u32 place = 100 * m + i / 9 * 3 + i % 3;
            positions[m][i] = low + spread * number_at(7, place) +
                              ldexpf(0.4f, -(int)m) * (number_at(9 + m, i) - 0.5f);
        }
        meshes[m] = (clshear_mesh){.positions = positions[m],
                                   .indices = indices,
                                   .vertex_count = SPECKS / 8 * 3,
                                   .triangle_count = SPECKS / 8,
                                   .diffuse = {0.3f, 0.3f, 0.3f},
                                   .emission = {light, light, light}};
    }
    return test_meshes(context, meshes, 9);
}

/* The tree and the table by power, whose choice does not look at the point, have the same mean; the
 * tree has at most a fifth of the error. */
static void tree_and_power_agree(void **state)
{
    clshear_scene *scene = specks(*state);
    for (int bounces = 0; bounces < 3; bounces += 2) {
        const test_estimate tree =
            mean_of_render(scene, view_of(CLSHEAR_EMITTERS_TREE, bounces, 4096));
        const test_estimate power =
            mean_of_render(scene, view_of(CLSHEAR_EMITTERS_POWER, bounces, 4096));
        expect_same("tree and power", tree, power);
        const test_estimate few =
            mean_of_render(scene, view_of(CLSHEAR_EMITTERS_TREE, bounces, 256));
        const test_estimate few_power =
            mean_of_render(scene, view_of(CLSHEAR_EMITTERS_POWER, bounces, 256));
        expect_same("few samples", few, few_power);
        if (bounces == 0) assert_below(2.0 * few.error, few_power.error);
    }
    clshear_scene_free(scene);
}

/* A square of 2 x 2 at a distance d before a wall of 18 x 18, and what a point of the wall behind
 * its middle gets: its form factor to a parallel square (Howell's catalog, configuration 11). */
static void a_panel_close_to_a_wall(void **state)
{
    static const float distances[] = {1.0f, 1e-1f, 1e-2f};
    static const float wall[12] = {-9, 0, 9, 9, 0, 9, 9, 0, -9, -9, 0, -9};
    static const uint32_t quad[6] = {0, 1, 2, 0, 2, 3};
    for (size_t n = 0; n < sizeof distances / sizeof *distances; n++) {
        const float d = distances[n];
        const float panel[12] = {-1, d, 1, 1, d, 1, 1, d, -1, -1, d, -1};
        const clshear_mesh meshes[2] = {{.positions = wall,
                                         .indices = quad,
                                         .vertex_count = 4,
                                         .triangle_count = 2,
                                         .diffuse = {0.5f, 0.5f, 0.5f}},
                                        {.positions = panel,
                                         .indices = quad,
                                         .vertex_count = 4,
                                         .triangle_count = 2,
                                         .emission = {2, 2, 2}}};
        clshear_scene *scene = test_meshes(*state, meshes, 2);
        const double a = 1.0 / (double)d, root = sqrt(1.0 + a * a);
        const double factor = 4.0 * a / root * atan(a / root) / acos(-1.0);
        for (int bounces = 0; bounces < 2; bounces++) {
            clshear_settings *settings = view_of(CLSHEAR_EMITTERS_TREE, bounces, 1024);
            test_set(settings, CLSHEAR_EYE, "0,%g,0", 0.5 * (double)d);
            test_set(settings, CLSHEAR_UP, "0,0,-1");
            test_set_number(settings, CLSHEAR_LENS_RADIUS, 0.0);
            test_set_number(settings, CLSHEAR_FOV, 0.01);
            const test_estimate found = mean_of_render(scene, settings);
            print_message("%g away: %.6f of %.6f, error %.6f\n", (double)d, found.mean, factor,
                          found.error);
            assert_near(found.mean, factor, 5.0 * found.error + 1e-4);
            assert_below(found.error, 2e-3);
        }
        clshear_scene_free(scene);
    }
}

/* A floor and above it a panel with these lines of MTL. The panel shows a picture: three texels are
 * black, the fourth has the colour that is given. */
static clshear_scene *floor_and_panel(clshear_context *context, const char *panel)
{
    const unsigned char texels[16] = {[8] = 255, 255, 255, 128};
    char text[256];
    material_picture("grey.tga", texels);
    snprintf(text, sizeof text, "newmtl floor\nKd 0.5 0.5 0.5\nnewmtl panel\nKd 0 0 0\n%s\n",
             panel);
    test_file("panel.mtl", text);
    const char *path =
        test_file("panel.obj", "mtllib panel.mtl\n"
                               "v -9 0 9\nv 9 0 9\nv 9 0 -9\nv -9 0 -9\n"
                               "v -1 1 1\nv 1 1 1\nv 1 1 -1\nv -1 1 -1\n"
                               "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                               "usemtl floor\nf 1 2 3 4\nusemtl panel\nf 5/1 6/2 7/3 8/4\n");
    return test_load(context, path);
}

/* The same floor and a panel of emission 2 whose vertices fade across, by their colours' alpha. */
static clshear_scene *floor_and_fading_panel(clshear_context *context)
{
    material_gltf_fading("{}"); /* its buffer */
    const char *path = test_file(
        "panel.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"mesh\":0,"
        "\"rotation\":[-0.70710678,0,0,0.70710678],\"scale\":[9,9,9]},{\"mesh\":1,"
        "\"rotation\":[-0.70710678,0,0,0.70710678],\"translation\":[0,1,0]}],\"meshes\":["
        "{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":0}]},"
        "{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"COLOR_0\":2},\"indices\":1,"
        "\"material\":1}]}],\"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":0}},"
        "{\"alphaMode\":\"BLEND\",\"emissiveFactor\":[1,1,1],\"extensions\":{"
        "\"KHR_materials_emissive_strength\":{\"emissiveStrength\":2}},\"pbrMetallicRoughness\":{"
        "\"baseColorFactor\":[0,0,0,1]}}],\"buffers\":[{\"uri\":\"material.bin\","
        "\"byteLength\":150}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":150}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":144,\"componentType\":5121,\"count\":6,"
        "\"type\":\"SCALAR\"},{\"bufferView\":0,\"byteOffset\":80,\"componentType\":5126,"
        "\"count\":4,\"type\":\"VEC4\"}]}");
    return test_load(context, path);
}

/* What varies over a panel, by an image or by alpha, lights the floor as rays alone find it; with
 * direct light it is sampled, and a plain lamp beside it changes nothing of that. */
static void varying_emission_is_sampled(void **state)
{
    static const char *const panels[] = {"Ke 9 9 9\nmap_Ke grey.tga", "Ke 2 2 2\nd 0.25",
                                         "that fades"};
    for (size_t i = 0; i < 3; i++) {
        clshear_scene *scene =
            i < 2 ? floor_and_panel(*state, panels[i]) : floor_and_fading_panel(*state);
        const test_estimate rays = mean_of_render(scene, view_of(CLSHEAR_EMITTERS_POWER, 1, 16384));
        const test_estimate both = mean_of_render(scene, view_of(CLSHEAR_EMITTERS_TREE, 1, 4096));
        const test_estimate direct = mean_of_render(scene, view_of(CLSHEAR_EMITTERS_TREE, 0, 4096));
        expect_same(panels[i], rays, both);
        expect_same("directly", rays, direct);
        assert_below(both.error, 2.0 * rays.error);
        clshear_scene_free(scene);
    }
}

/* A model that only an image lights has no studio: unlike a label, it is bright enough. */
static void the_studio_looks_at_images(void **state)
{
    clshear_scene *scene = floor_and_panel(*state, "Ke 99 99 99\nmap_Ke grey.tga");
    test_warnings();
    mean_of_render(scene, view_of(CLSHEAR_EMITTERS_TREE, 1, 64));
    assert_null(strstr(test_warnings(), "studio"));
    clshear_scene_free(scene);
    scene = floor_and_panel(*state, "Ke 1 1 1\nmap_Ke grey.tga");
    const test_estimate found = mean_of_render(scene, view_of(CLSHEAR_EMITTERS_TREE, 1, 64));
    assert_above(found.mean, 0.1);
    clshear_scene_free(scene);
}

/* Renders a few samples in the light of a point, too; whether their sampler was the one of the
 * light's own pair. */
static int takes_sobol(clshear_scene *scene, clshear_emitters choice)
{
    clshear_settings *settings = view_of(choice, 1, 16);
    test_set(settings, CLSHEAR_LIGHT, "0,3,0,9,9,9");
    clshear_film *film = test_render(scene, settings);
    const char *sampler = clshear_film_text(film, "clshear.sampler");
    const int is_sobol = sampler != NULL && strcmp(sampler, "sobol") == 0;
    assert_true(is_sobol || (sampler != NULL && strcmp(sampler, "sz") == 0));
    clshear_film_free(film);
    clshear_settings_free(settings);
    return is_sobol;
}

/* Surfaces that shine have a size, however they are found; a texture of no light, or of nothing
 * that is there, does not shine. */
static void what_shines_chooses_the_sampler(void **state)
{
    clshear_scene *scene = floor_and_panel(*state, "Ke 2 2 2\nd 0.25");
    assert_true(takes_sobol(scene, CLSHEAR_EMITTERS_POWER));
    assert_true(takes_sobol(scene, CLSHEAR_EMITTERS_TREE));
    clshear_scene_free(scene);
    scene = test_load(*state, material_gltf("{'emissiveTexture':{'index':0}}"));
    assert_false(takes_sobol(scene, CLSHEAR_EMITTERS_TREE));
    clshear_scene_free(scene);
    scene = test_load(*state, material_gltf("{},{'emissiveFactor':[1,1,1],"
                                            "'emissiveTexture':{'index':0}}"));
    assert_false(takes_sobol(scene, CLSHEAR_EMITTERS_TREE));
    clshear_scene_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tree_and_power_agree),
        cmocka_unit_test(a_panel_close_to_a_wall),
        cmocka_unit_test(varying_emission_is_sampled),
        cmocka_unit_test(the_studio_looks_at_images),
        cmocka_unit_test(what_shines_chooses_the_sampler),
    };
    return cmocka_run_group_tests(tests, test_open_context, test_close_context);
}
