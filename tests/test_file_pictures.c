/* Pictures of materials of files, where closed forms say what they show. */
#include "material_files.h"
#include "support.h"

#include <math.h>

static const double pi = 3.14159265358979;

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

/* What the square shows from 4 before it, at its middle or another place. */
typedef struct shown {
    double red;
    double error; /* standard error; 240 degrees of freedom */
} shown;

static shown look_at(clshear_context *context, const char *path, double x, clshear_setting light,
                     const char *value)
{
    shown found = {0.0, 0.0};
    clshear_scene *scene = NULL;
    clshear_settings *settings = test_settings(NULL, 4, 4, 512);
    test_set(settings, CLSHEAR_EYE, "%g,0,4", x);
    test_set(settings, CLSHEAR_TARGET, "%g,0,0", x);
    test_set(settings, light, "%s", value);
    test_set_number(settings, CLSHEAR_FOV, 0.01);
    test_set_number(settings, CLSHEAR_LENS_RADIUS, 0.0);
    test_set_number(settings, CLSHEAR_FOCAL_DISTANCE, 4.0);
    test_set_number(settings, CLSHEAR_REPLICATES, 16);
    test_set_number(settings, CLSHEAR_BOUNCES, 1);
    test_ok(clshear_scene_load(context, path, NULL, &scene));
    clshear_film *film = test_render(scene, settings);
    for (int p = 0; p < 16; p++) {
        found.red += (double)clshear_film_channel(film, "R")[p] / 16.0;
        found.error += (double)clshear_film_channel(film, "Variance.R")[p] / 256.0;
    }
    found.error = sqrt(found.error);
    clshear_film_free(film);
    clshear_settings_free(settings);
    clshear_scene_free(scene);
    return found;
}

static shown look(clshear_context *context, const char *path, clshear_setting light,
                  const char *value)
{
    return look_at(context, path, 0.0, light, value);
}

/* Alpha 0.2 of an image shows a fifth of its colour, (128 / 255) on the sRGB curve, and four fifths
 * of a sky of 1. 5 standard errors: false alarms 1e-6. */
static void alpha_of_an_image(void **state)
{
    material_even_picture("grey.tga", 128, 128, 128, 51);
    material_even_picture("tone.tga", 255, 255, 255, 255);
    const char *blend = "{'alphaMode':'BLEND','extensions':{'KHR_materials_unlit':{}},"
                        "'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}}";
    shown found = look(*state, material_gltf(blend), CLSHEAR_ENVIRONMENT, "1,1,1");
    print_message("blend: %.4f, error %.4f\n", found.red, found.error);
    assert_near(found.red, 0.2 * 0.2158 + 0.8, 5.0 * found.error + 1e-3);
    const char *mask = "{'alphaMode':'MASK','extensions':{'KHR_materials_unlit':{}},"
                       "'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}}";
    found = look(*state, material_gltf(mask), CLSHEAR_ENVIRONMENT, "3,3,3");
    assert_near(found.red, 3.0, 1e-5);
    found = look(*state, material_mtl("Kd 0 0 0\nmap_d grey.tga"), CLSHEAR_ENVIRONMENT, "1,1,1");
    assert_near(found.red, 0.8, 5.0 * found.error + 1e-3);
}

/* The alpha of vertices multiplies the material's: a black square of 0.8 that fades before a sky of
 * 1 shows 1 - 0.8 (1 + x) / 2, and a mask is there from its cutoff on; an opaque one everywhere.
 * 5 standard errors: false alarms 1e-6. */
static void alpha_of_vertices(void **state)
{
    const char *blend = "{'alphaMode':'BLEND','extensions':{'KHR_materials_unlit':{}},"
                        "'pbrMetallicRoughness':{'baseColorFactor':[0,0,0,0.8]}}";
    const char *mask = "{'alphaMode':'MASK','alphaCutoff':0.6,'extensions':{'KHR_materials_unlit'"
                       ":{}},'pbrMetallicRoughness':{'baseColorFactor':[0,0,0,0.8]}}";
    const char *opaque = "{'extensions':{'KHR_materials_unlit':{}},"
                         "'pbrMetallicRoughness':{'baseColorFactor':[0,0,0,0.8]}}";
    for (int i = 0; i < 4; i++) {
        const double x = 0.5 * (double)i - 0.75;
        const char *path = material_gltf_fading(blend);
        shown found = look_at(*state, path, x, CLSHEAR_ENVIRONMENT, "1,1,1");
        print_message("at %5.2f: %.4f, error %.4f\n", x, found.red, found.error);
        assert_near(found.red, 1.0 - 0.4 * (1.0 + x), 5.0 * found.error + 1e-3);
        found = look_at(*state, material_gltf_fading(mask), x, CLSHEAR_ENVIRONMENT, "1,1,1");
        assert_near(found.red, 0.4 * (1.0 + x) < 0.6, 1e-5);
        found = look_at(*state, material_gltf_fading(opaque), x, CLSHEAR_ENVIRONMENT, "1,1,1");
        assert_near(found.red, 0.0, 1e-5);
    }
}

/* Factor times strength times texel, on a black surface. */
static void emission_of_an_image(void **state)
{
    material_even_picture("grey.tga", 128, 128, 128, 51);
    const char *text = "{'emissiveFactor':[1,1,1],'emissiveTexture':{'index':0},'extensions':"
                       "{'KHR_materials_emissive_strength':{'emissiveStrength':6}},"
                       "'pbrMetallicRoughness':{'baseColorFactor':[0,0,0,1]}}";
    const shown found = look(*state, material_gltf(text), CLSHEAR_ENVIRONMENT, "1,1,1");
    assert_near(found.red, 6.0 * 0.2158, 2e-3);
}

/* The map's green is roughness and its blue is metallic, both as they are: the same picture as by
 * numbers. Halves keep 11 bits. */
static void facets_of_an_image(void **state)
{
    material_even_picture("grey.tga", 7, 128, 64, 255);
    material_even_picture("tone.tga", 255, 255, 255, 255);
    const char *mapped = "{'pbrMetallicRoughness':{'baseColorFactor':[0.5,0.5,0.5,1],"
                         "'metallicRoughnessTexture':{'index':0}}}";
    const char *plain = "{'pbrMetallicRoughness':{'baseColorFactor':[0.5,0.5,0.5,1],"
                        "'metallicFactor':0.25098,'roughnessFactor':0.50196}}";
    const char *light = "1,0,4,50,50,50";
    const shown a = look(*state, material_gltf(mapped), CLSHEAR_LIGHT, light);
    const shown b = look(*state, material_gltf(plain), CLSHEAR_LIGHT, light);
    print_message("by a map %.5f, by numbers %.5f\n", a.red, b.red);
    assert_near(a.red, b.red, 3e-3 * b.red);
    assert_above(a.red, 0.1);
}

/* A normal of (0.6, 0, 0.8) under a sun in its direction, and a third of its slope under one that
 * it then faces: E / pi times the colour. Bytes of the map round to 0.4 %. */
static void normals_of_an_image(void **state)
{
    material_even_picture("bent.tga", 204, 128, 230, 255);
    const double truth = 0.5 * 2.0 / pi;
    shown found = look(*state, material_mtl("Kd 0.5 0.5 0.5\nnorm bent.tga"), CLSHEAR_SUN,
                       "0.6,0,0.8,2,2,2,0");
    assert_near(found.red, truth, 5e-3 * truth);
    found = look(*state, material_mtl("Kd 0.5 0.5 0.5\nnorm -bm 0.3333 bent.tga"), CLSHEAR_SUN,
                 "0.2425,0,0.9701,2,2,2,0");
    assert_near(found.red, truth, 5e-3 * truth);
}

/* White surfaces under an even sky of 1 show 1, whatever lies over the white: within 1 % for the
 * tables of albedos and 5 standard errors (false alarms 1e-6). */
static void no_energy_from_nothing(void **state)
{
    static const char *const lines[] = {
        "Kd 1 1 1\nKs 1 1 1\nNs 96\nillum 2", "Kd 1 1 1\nKs 0.7 0.7 0.7\nNs 10\nillum 3",
        "Kd 0 0 0\nKs 1 1 1\nNs 96\nillum 3", "Kd 1 1 1\nd 0.2\nillum 4",
        "Kd 1 1 1\nNi 1.5\nillum 7",          "Kd 1 1 1\nPr 0.4\nPm 0.5\nPc 1"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        const shown found = look(*state, material_mtl(lines[i]), CLSHEAR_ENVIRONMENT, "1,1,1");
        print_message("white %zu: %.4f, error %.4f\n", i, found.red, found.error);
        assert_near(found.red, 1.0, 0.01 + 5.0 * found.error);
        assert_below(found.error, 0.01);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(alpha_of_an_image),      cmocka_unit_test(emission_of_an_image),
        cmocka_unit_test(facets_of_an_image),     cmocka_unit_test(normals_of_an_image),
        cmocka_unit_test(no_energy_from_nothing), cmocka_unit_test(alpha_of_vertices),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
