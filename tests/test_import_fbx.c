/* FBX, which Assimp reads behind the wall: lights as Blender's exporter writes them. */
#include "import_support.h"

#include <math.h>
#include <stdio.h>

#define FACTOR(name, number) "P: \"" name "\", \"double\", \"Number\", \"\"," number "\n"

/* A triangle, and a lamp of 300 W at (0, 0, 200) that shines along -Y. Its colour is (1, 0.5, 0);
 * DecayType 2 is the squared distance, and DecayStart where Assimp takes it to be half as bright.
 */
static cs_scene read_lamp(const char *creator, const char *unit, const char *lamp)
{
    const cs_import_options options = {.smooth_degrees = -1.0};
    const cs_log log = {.warn = import_collect};
    cs_scene scene;
    cs_error error = {0};
    char text[4096];
    const int length = snprintf(
        text, sizeof text,
        "; FBX 7.4.0 project file\nFBXHeaderExtension: {\nFBXHeaderVersion: 1003\n"
        "FBXVersion: 7400\nCreator: \"%s\"\n}\nGlobalSettings: {\nVersion: 1000\n"
        "Properties70: {\n" FACTOR(
            "UnitScaleFactor",
            "%s") "}\n}\nObjects: {\n"
                  "Geometry: 1, \"Geometry::g\", \"Mesh\" {\nVertices: *9 {\na: "
                  "0,0,0,1,0,0,0,1,0\n}\n"
                  "PolygonVertexIndex: *3 {\na: 0,1,-3\n}\n}\n"
                  "Model: 2, \"Model::m\", \"Mesh\" {\n}\n"
                  "Model: 3, \"Model::lamp\", \"Light\" {\nProperties70: {\n"
                  "P: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\",0,0,200\n}\n}\n"
                  "NodeAttribute: 4, \"NodeAttribute::lamp\", \"Light\" {\nTypeFlags: \"Light\"\n"
                  "Properties70: {\nP: \"Color\", \"Color\", \"\", \"A\",1,0.5,0\n" FACTOR(
                      "Intensity", "30000")
                      FACTOR("DecayStart", "2500") "%s}\n}\n}\n"
                                                   "Connections: {\nC: \"OO\",2,0\nC: "
                                                   "\"OO\",1,2\nC: \"OO\",3,0\nC: \"OO\",4,3\n}\n",
        creator, unit, lamp);
    assert_true(length > 0 && (size_t)length < sizeof text);
    import_warnings[0] = '\0';
    cs_scene_init(&scene);
    if (cs_scene_import(test_file("lamp.fbx", text), &options, &scene, &log, &error) != CLSHEAR_OK)
        fail_msg("%s", error.message);
    assert_int_equal(scene.lights.count, 1);
    return scene;
}

static void expect_lamp(const char *creator, const char *unit, const char *lamp, double red)
{
    cs_scene scene = read_lamp(creator, unit, lamp);
    const cs_light *light = scene.lights.items;
    const double tolerance = 1e-5 * red;
    assert_float_equal(light->colour[0], red, tolerance);
    assert_float_equal(light->colour[1], 0.5 * red, tolerance);
    assert_true(light->colour[2] == 0.0f);
    cs_scene_free(&scene);
}

#define ENUM(name, number) "P: \"" name "\", \"enum\", \"\", \"\"," number "\n"
#define POINT ENUM("LightType", "0")
#define SUN ENUM("LightType", "1")
#define SPOT ENUM("LightType", "2")
#define SQUARE ENUM("DecayType", "2")
#define BLENDER(version) "Blender (stable FBX IO) - " version " - 4.37.1"

static const double per_metre = 300.0 / (4.0 * 3.14159265358979323846); /* W / sr */

/* Watts in all directions; a metre has as many units as the file says. */
static void lamps_of_blender(void **state)
{
    (void)state;
    expect_lamp(BLENDER("3.4.1"), "1", POINT SQUARE, 1e4 * per_metre);
    expect_lamp(BLENDER("2.80 (sub 75)"), "1", POINT SQUARE, 1e4 * per_metre);
    expect_lamp(BLENDER("4.2.0"), "100", POINT SQUARE, per_metre);
    expect_lamp(BLENDER("5.0.0"), "2.5", POINT, 1600.0 * per_metre);
    expect_lamp(BLENDER("3.4.1"), "1", SPOT SQUARE, 1e4 * per_metre);
    expect_lamp(BLENDER("3.4.1"), "1", SUN SQUARE, 300.0);
}

/* Half as bright at the distance of the file as at none: 1 / (1 / 2500^2 x 2). */
static void lamps_of_others(void **state)
{
    (void)state;
    expect_lamp("FBX SDK/FBX Plugins version 2020.3", "1", POINT SQUARE, 300.0 * 3125000.0);
    expect_lamp(BLENDER("2.79 (sub 0)"), "1", POINT SQUARE, 300.0 * 3125000.0);
    expect_lamp("Blender", "1", POINT SQUARE, 300.0 * 3125000.0);
}

/* The edge of Blender's spot holds half of its light: a cone of 60 degrees with the blend 0.5. The
 * light falls by the square from the cosine at which it begins to fall to that of 30 degrees. */
static void edges_of_spots(void **state)
{
    (void)state;
    cs_scene scene = read_lamp(BLENDER("3.4.1"), "1",
                               SPOT SQUARE FACTOR("InnerAngle", "30") FACTOR("OuterAngle", "60"));
    const cs_light *light = scene.lights.items;
    const double outer = sqrt(0.75), width = 0.75 * 0.5 * (1.0 - outer);
    assert_float_equal(light->parameters[0], 0.5 / width, 1e-3 / width);
    expect_close(light->axis, 0, 1, 0);
    cs_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lamps_of_blender),
        cmocka_unit_test(lamps_of_others),
        cmocka_unit_test(edges_of_spots),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
