/* What Assimp reads: lights of FBX and Collada, as Blender's exporters and others write them, the
 * axis that is up in FBX, and meshes without a material. */
#include "import_support.h"

#include <math.h>
#include <stdio.h>

/* Reads a file with one light; the caller frees the scene. */
static cs_scene read_light(const char *path)
{
    cs_scene scene = import_apart(path);
    assert_int_equal(scene.lights.count, 1);
    return scene;
}

/* A triangle, and a lamp of 300 W at (0, 0, 200) that shines along -Y. Its colour is (1, 0.5, 0);
 * DecayType 2 is the squared distance, and DecayStart where Assimp takes it to be half as bright.
 */
static cs_scene read_lamp(const char *creator, const char *unit, const char *lamp)
{
    char text[4096];
    const int length = snprintf(
        text, sizeof text,
        "; FBX 7.4.0 project file\nFBXHeaderExtension: {\nFBXHeaderVersion: 1003\n"
        "FBXVersion: 7400\nCreator: \"%s\"\n}\nGlobalSettings: {\nVersion: 1000\nProperties70: {\n"
        "P: \"UnitScaleFactor\", \"double\", \"Number\", \"\",%s\n}\n}\nObjects: {\n"
        "Geometry: 1, \"Geometry::g\", \"Mesh\" {\nVertices: *9 {\na: 0,0,0,1,0,0,0,1,0\n}\n"
        "PolygonVertexIndex: *3 {\na: 0,1,-3\n}\n}\nModel: 2, \"Model::m\", \"Mesh\" {\n}\n"
        "Model: 3, \"Model::lamp\", \"Light\" {\nProperties70: {\n"
        "P: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\",0,0,200\n}\n}\n"
        "NodeAttribute: 4, \"NodeAttribute::lamp\", \"Light\" {\nTypeFlags: \"Light\"\n"
        "Properties70: {\nP: \"Color\", \"Color\", \"\", \"A\",1,0.5,0\n"
        "P: \"Intensity\", \"Number\", \"\", \"A\",30000\n"
        "P: \"DecayStart\", \"double\", \"Number\", \"\",2500\n%s}\n}\n}\n"
        "Connections: {\nC: \"OO\",2,0\nC: \"OO\",1,2\nC: \"OO\",3,0\nC: \"OO\",4,3\n}\n",
        creator, unit, lamp);
    assert_true(length > 0 && (size_t)length < sizeof text);
    return read_light(test_file("lamp.fbx", text));
}

static void expect_lamp(const char *creator, const char *unit, const char *lamp, double red)
{
    cs_scene scene = read_lamp(creator, unit, lamp);
    const cs_light *light = scene.lights.items;
    const double tolerance = 1e-5 * red;
    assert_near(light->colour[0], red, tolerance);
    assert_near(light->colour[1], 0.5 * red, tolerance);
    assert_true(light->colour[2] == 0.0f);
    cs_scene_free(&scene);
}

#define NUMBER(name, number) "P: \"" name "\", \"Number\", \"\", \"A\"," number "\n"
#define ENUM(name, number) "P: \"" name "\", \"enum\", \"\", \"\"," number "\n"
#define UP(axis) "\nP: \"UpAxis\", \"int\", \"Integer\", \"\"," axis
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
    /* without decay: as bright in the middle of the scene, at (0.5, 0.5, 0), as anywhere */
    expect_lamp("FBX SDK", "1", POINT ENUM("DecayType", "0"), 300.0 * 40000.5);
}

/* The edge of Blender's spot holds half of its light: a cone of 60 degrees with the blend 0.5. The
 * light falls by the square from the cosine at which it begins to fall to that of 30 degrees. */
static void edges_of_spots(void **state)
{
    (void)state;
    cs_scene scene = read_lamp(BLENDER("3.4.1"), "1",
                               SPOT SQUARE NUMBER("InnerAngle", "30") NUMBER("OuterAngle", "60"));
    const cs_light *light = scene.lights.items;
    const double outer = sqrt(0.75), width = 0.75 * 0.5 * (1.0 - outer);
    assert_near(light->parameters[0], 0.5 / width, 1e-3 / width);
    expect_close(light->axis, 0, 1, 0);
    cs_scene_free(&scene);
}

/* The same lamp as Collada; `kind` is the name of its element, which holds `cone`, too. The
 * triangle has none of the file's materials. */
static cs_scene read_collada(const char *tool, const char *kind, const char *cone)
{
    char text[4096];
    const int length = snprintf(
        text, sizeof text,
        "<COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'>"
        "<asset><contributor><authoring_tool>%s</authoring_tool></contributor>"
        "<unit name='centimeter' meter='0.01'/><up_axis>Y_UP</up_axis></asset>"
        "<library_lights><light id='l'><technique_common><%s><color>300 150 0</color>"
        "<constant_attenuation>1</constant_attenuation><linear_attenuation>0</linear_attenuation>"
        "<quadratic_attenuation>0.0016</quadratic_attenuation>%s</%s></technique_common></light>"
        "</library_lights><library_effects><effect id='e'><profile_COMMON><technique><lambert>"
        "<diffuse><color>1 0 0 1</color></diffuse></lambert></technique></profile_COMMON></effect>"
        "</library_effects><library_materials><material id='r'><instance_effect url='#e'/>"
        "</material></library_materials><library_geometries><geometry id='g'><mesh><source id='p'>"
        "<float_array id='a' count='9'>0 0 0 1 0 0 0 1 0</float_array><technique_common>"
        "<accessor source='#a' count='3' stride='3'><param name='X' type='float'/>"
        "<param name='Y' type='float'/><param name='Z' type='float'/></accessor>"
        "</technique_common></source><vertices id='v'><input semantic='POSITION' source='#p'/>"
        "</vertices><triangles count='1'><input semantic='VERTEX' source='#v' offset='0'/>"
        "<p>0 1 2</p></triangles></mesh></geometry></library_geometries><library_visual_scenes>"
        "<visual_scene id='w'><node id='n'><instance_geometry url='#g'/></node><node id='m'>"
        "<instance_light url='#l'/></node></visual_scene></library_visual_scenes><scene>"
        "<instance_visual_scene url='#w'/></scene></COLLADA>\n",
        tool, kind, cone, kind);
    assert_true(length > 0 && (size_t)length < sizeof text);
    return read_light(test_file("lamp.dae", text));
}

static void expect_collada(const char *tool, const char *kind, double red)
{
    cs_scene scene = read_collada(tool, kind, "");
    const cs_light *light = scene.lights.items;
    assert_near(light->colour[0], red, 1e-5 * red);
    assert_near(light->colour[1], 0.5 * red, 1e-5 * red);
    cs_scene_free(&scene);
}

/* Collada is in metres, whatever its unit; here the triangle's short sides are 0.01, and the light
 * is where they meet. One that fades in its own way is as bright as the file says in the middle. */
static void lamps_of_collada(void **state)
{
    (void)state;
    expect_collada("Blender 3.4.1", "point", per_metre);
    expect_collada("Blender 2.93.4 commit date:2021-08-31, commit time:09:23", "spot", per_metre);
    expect_collada("Blender 3.4.1", "directional", 300.0);
    const double square = 2e-4 / 4.0, old = 300.0 * square / (1.0 + 0.0016 * square);
    expect_collada("Blender 2.79.0 commit date:2018-03-22, commit time:14:10", "point", old);
    expect_collada("FBX COLLADA exporter", "spot", old);
}

/* Blender writes the blend as the exponent; one below 0.2 is taken for 0.15. */
static void edges_of_collada(void **state)
{
    static const char *const cones[] = {
        "<falloff_angle>60</falloff_angle><falloff_exponent>0.5</falloff_exponent>",
        "<falloff_angle>60</falloff_angle><falloff_exponent>0.1</falloff_exponent>"};
    static const double blends[] = {0.5, 0.15};
    (void)state;
    for (int i = 0; i < 2; i++) {
        cs_scene scene = read_collada("Blender 3.4.1", "spot", cones[i]);
        const cs_light *light = scene.lights.items;
        const double width = 0.75 * blends[i] * (1.0 - sqrt(0.75));
        assert_near(light->parameters[0], 0.5 / width, 1e-3 / width);
        cs_scene_free(&scene);
    }
}

/* FBX names the axis that is up by its number. */
static void axes_of_fbx(void **state)
{
    static const char *const more[] = {"1", "1" UP("1"), "1" UP("2")};
    (void)state;
    for (int i = 0; i < 3; i++) {
        cs_scene scene = read_lamp("", more[i], POINT SQUARE);
        assert_int_equal(scene.z_up, i == 2);
        cs_scene_free(&scene);
    }
}

static void meshes_without_material(void **state)
{
    (void)state;
    cs_scene scenes[] = {read_collada("", "point", ""), read_lamp("", "1", POINT SQUARE)};
    for (int i = 0; i < 2; i++) {
        expect_close(import_material(&scenes[i], 0)->diffuse, 0.5f, 0.5f, 0.5f);
        cs_scene_free(&scenes[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lamps_of_blender), cmocka_unit_test(lamps_of_others),
        cmocka_unit_test(edges_of_spots),   cmocka_unit_test(lamps_of_collada),
        cmocka_unit_test(edges_of_collada), cmocka_unit_test(meshes_without_material),
        cmocka_unit_test(axes_of_fbx),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
