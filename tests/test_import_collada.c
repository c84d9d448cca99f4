/* Collada, which Assimp reads behind the wall: as its exporters write it. */
#include "import_support.h"

#include <stdio.h>
#include <stdlib.h>

#define SOURCE(id, numbers)                                                                      \
    "<source id='" id "'><float_array id='" id "-a' count='9'>" numbers "</float_array>"         \
    "<technique_common><accessor source='#" id "-a' count='3' stride='3'>"                       \
    "<param name='X' type='float'/><param name='Y' type='float'/><param name='Z' type='float'/>" \
    "</accessor></technique_common></source>"

/* A triangle with a colour, and an image that nothing uses. */
#define COLLADA(head, colour)                                                                      \
    head "<COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'>"          \
         "<asset><up_axis>Y_UP</up_axis></asset>"                                                  \
         "<library_images><image id='i'><init_from>\n none.png\n</init_from></image>"              \
         "</library_images>"                                                                       \
         "<library_effects><effect id='e'><profile_COMMON><technique sid='t'><lambert><diffuse>"   \
         "<color>" colour "</color></diffuse></lambert></technique></profile_COMMON></effect>"     \
         "</library_effects><library_materials><material id='m'><instance_effect url='#e'/>"       \
         "</material></library_materials><library_geometries><geometry id='g'><mesh>" SOURCE(      \
             "p", "0 0 0 1 0 0 0 1 0") "<vertices id='v'><input semantic='POSITION' source='#p'/>" \
                                       "</vertices><triangles count='1' material='s'><input "      \
                                       "semantic='VERTEX' source='#v' "                            \
                                       "offset='0'/><p>0 1 "                                       \
                                       "2</p></triangles></mesh></geometry></library_geometries>"  \
                                       "<library_visual_scenes><visual_scene id='w'><node "        \
                                       "id='n'><instance_geometry url='#g'>"                       \
                                       "<bind_material><technique_common><instance_material "      \
                                       "symbol='s' target='#m'/>"                                  \
                                       "</technique_common></bind_material></instance_geometry></" \
                                       "node></visual_scene>"                                      \
                                       "</library_visual_scenes><scene><instance_visual_scene "    \
                                       "url='#w'/></scene></COLLADA>\n"

static void expect_triangle(const char *path, float red, float green, float blue)
{
    cs_scene scene = import_apart(path);
    assert_int_equal(scene.triangle_flags.count, 1);
    expect_close(import_material(&scene, 0)->diffuse, red, green, blue);
    cs_scene_free(&scene);
}

/* Colours that begin with a blank, or on a line of their own, or have no opacity. */
static void colours_behind_blanks(void **state)
{
    (void)state;
    expect_triangle(test_file("plain.dae", COLLADA("", "0.5 0.25 0 1")), 0.5f, 0.25f, 0);
    expect_triangle(test_file("three.dae", COLLADA("", " 0.75 0.25\n0 ")), 0.75f, 0.25f, 0);
    expect_triangle(test_file("blank.dae", COLLADA("", " 0.75 0.25 0 1")), 0.75f, 0.25f, 0);
    expect_triangle(test_file("line.dae", COLLADA("", "\r\n\t0.125 0.25\n0 1\n")), 0.125f, 0.25f,
                    0);
}

/* The name of an image on a line of its own. */
static void names_between_lines(void **state)
{
    (void)state;
    expect_triangle(
        test_file("image.dae",
                  COLLADA("", "1 1 1 1</color><texture texture='i' texcoord='U'/><color>1 1 1 1")),
        0.5f, 0.5f, 0.5f);
    import_warned("texture none.png is not there");
}

/* A file of a triangle, with `to` in the place of `from`. */
static const char *file_with(const char *from, const char *to)
{
    static const char plain[] = COLLADA("", "0.5 0.25 0 1");
    const char *place = strstr(plain, from);
    char text[16384];
    assert_non_null(place);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(place - plain), plain, to, place + strlen(from));
    return test_file("other.dae", text);
}

#define POLYGONS(inside)                                                                        \
    "<polygons count='1' material='s'><input semantic='VERTEX' source='#v' offset='0'/>" inside \
    "</polygons><triangles "
#define MORPH                                                                                 \
    "<library_controllers><controller id='k'><morph source='#g'><source id='z'><IDREF_array " \
    "id='z-a' count='1'>g</IDREF_array></source><targets><input semantic='MORPH_TARGET' "     \
    "source='#z'/></targets></morph></controller></library_controllers>"

/* What Assimp refuses, or makes something else of. */
static void polygons_with_holes(void **state)
{
    (void)state;
    cs_scene scene = import_apart(
        file_with("<triangles ", POLYGONS("<ph><p>2 1 0</p><h>0 1 2</h><h>\n0 1 2</h></ph>")));
    assert_int_equal(scene.triangle_flags.count, 2);
    import_warned("holes of polygons are not supported: 2 closed");
    cs_scene_free(&scene);
}

static void morph_targets(void **state)
{
    char text[8192];
    (void)state;
    snprintf(text, sizeof text,
             MORPH "<library_visual_scenes><visual_scene id='w'>"
                   "<node id='o'><instance_controller url='#k'/></node>");
    cs_scene scene = import_apart(file_with("<library_visual_scenes><visual_scene id='w'>", text));
    assert_int_equal(scene.triangle_flags.count, 2);
    expect_close(import_position(&scene, 0, 1), 1, 0, 0);
    import_warned("morph targets are not supported: the first shape of 1 mesh");
    cs_scene_free(&scene);
}

/* The triangle below a skew of its node. */
static cs_scene skewed(const char *skew)
{
    char text[256];
    snprintf(text, sizeof text, "<translate>0 0 5</translate>%s<instance_geometry url='#g'>", skew);
    return import_apart(file_with("<instance_geometry url='#g'>", text));
}

/* Of an angle and two axes: points move along the second, as far as they are along the first. */
static void skews(void **state)
{
    (void)state;
    cs_scene scene = skewed("<skew sid='s'>\n 45 0 2 0 3 0 0 </skew>");
    expect_close(import_position(&scene, 0, 1), 1, 0, 5);
    expect_close(import_position(&scene, 0, 2), 1, 1, 5);
    assert_string_equal(import_warnings, "");
    cs_scene_free(&scene);
    scene = skewed("<skew>0 0 1 0 1 0 0</skew><skew>-45 1 0 0 0 0 1</skew>");
    expect_close(import_position(&scene, 0, 1), 1, 0, 4);
    expect_close(import_position(&scene, 0, 2), 0, 1, 5);
    assert_string_equal(import_warnings, "");
    cs_scene_free(&scene);
    scene = skewed(
        "<skew/><skew>45 0 0 0 1 0 0</skew><skew>45 0 1 0</skew ><skew>90 0 1 0 1 0 0</skew>");
    expect_close(import_position(&scene, 0, 2), 0, 1, 5);
    import_warned("4 skews without an angle below 90 degrees and two axes; left out");
    cs_scene_free(&scene);
}

/* Skins are where they are bound, below their node; the targets of morphs may lie below. */
static void skins_as_bound(void **state)
{
    static const char scene_begin[] = "<library_visual_scenes><visual_scene id='w'>";
    char text[8192];
    (void)state;
    for (int has_morph = 0; has_morph < 2; has_morph++) {
        snprintf(text, sizeof text,
                 "%s<library_controllers><controller id='s'><skin source='#%s'><bind_shape_matrix>"
                 "2 0 0 100\n0 2 0 0 0 0 2 0 0 0 0 1</bind_shape_matrix></skin></controller>"
                 "</library_controllers>%s<node id='o'><translate>0 7 0</translate>"
                 "<instance_controller url='#s'><skeleton>#n</skeleton><bind_material>"
                 "<technique_common><instance_material symbol='s' target='#m'/></technique_common>"
                 "</bind_material></instance_controller></node>",
                 has_morph ? MORPH : "", has_morph ? "k" : "g", scene_begin);
        cs_scene scene = import_apart(file_with(scene_begin, text));
        assert_int_equal(scene.triangle_flags.count, 2);
        expect_close(import_position(&scene, 0, 0), 100, 7, 0);
        expect_close(import_position(&scene, 0, 1), 102, 7, 0);
        expect_close(import_material(&scene, 0)->diffuse, 0.5f, 0.25f, 0);
        if (has_morph)
            import_warned("morph targets");
        else
            assert_string_equal(import_warnings, "");
        cs_scene_free(&scene);
    }
}

#define BESIDE(elements) "1 1 1 1</color></diffuse>" elements "<diffuse><color>0.5 0.25 0 1"
#define TRANSPARENT(mode, colour, factor)                                                         \
    BESIDE("<transparent opaque='" mode "'><color>" colour "</color></transparent><transparency>" \
           "<float>" factor "</float></transparency>")

/* Opacity in the four ways of Collada; 0 is opaque, as exporters mean it. */
static void opacity(void **state)
{
    static const struct {
        const char *text;
        float alpha;
    } files[] = {{COLLADA("", TRANSPARENT("A_ONE", "1 1 1 0.25", "1")), 0.25f},
                 {COLLADA("", TRANSPARENT("A_ZERO", "1 1 1 0.75", "1")), 0.25f},
                 {COLLADA("", TRANSPARENT("RGB_ZERO", "0.75 0.75 0.75 1", "1")), 0.25f},
                 {COLLADA("", TRANSPARENT("RGB_ONE", "0.25 0.25 0.25 1", "1")), 0.25f},
                 {COLLADA("", TRANSPARENT("A_ONE", "1 1 1 1", "0.75")), 0.75f},
                 {COLLADA("", TRANSPARENT("RGB_ZERO", "0 0 0 1", "1")), 1.0f},
                 {COLLADA("", TRANSPARENT("A_ONE", "1 1 1 1", "0")), 1.0f}};
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        cs_scene scene = import_apart(test_file("opacity.dae", files[i].text));
        const cs_material *material = import_material(&scene, 0);
        assert_near(material->alpha, files[i].alpha, 1e-6f);
        assert_int_equal((material->flags & CS_MATERIAL_BLEND) != 0, files[i].alpha < 1.0f);
        expect_close(material->diffuse, 0.5f, 0.25f, 0);
        cs_scene_free(&scene);
    }
    import_warned("the opacity 0 of 1 material is taken as opaque");
}

/* The file with colours of its vertices, the last of this alpha, before their positions or behind.
 * is_before: 1: before an empty tag, 2: before a pair of tags. */
static const char *coloured_file(const char *alpha, int is_before)
{
    static const char head[] = "<vertices id='v'>",
                      colour[] = "<input semantic='COLOR' source='#c'/>";
    static const char plain[] = "<vertices id='v'><input semantic='POSITION' source='#p'/>";
    const char *position = is_before > 1 ? "<input semantic='POSITION' source='#p'></input >"
                                         : "<input semantic='POSITION' source='#p'/>";
    char text[2048];
    snprintf(text, sizeof text,
             "<source id='c'><float_array id='c-a' count='12'>1 0.5 0 1 1 0 0 1 1 0 0 %s"
             "</float_array><technique_common><accessor source='#c-a' count='3' stride='4'>"
             "<param name='R' type='float'/><param name='G' type='float'/><param name='B' "
             "type='float'/><param name='A' type='float'/></accessor></technique_common>"
             "</source>%s%s%s",
             alpha, head, is_before ? colour : position, is_before ? position : colour);
    return file_with(plain, text);
}

/* Vertices' colours, on the sRGB curve; their alpha, which Collada's materials do not ask for. */
static void colours_of_vertices(void **state)
{
    (void)state;
    for (int kind = 0; kind < 6; kind++) {
        cs_scene scene = import_apart(coloured_file(kind < 3 ? "0.5" : "1", kind % 3));
        expect_close(import_colour(&scene, 0, 0), 1, 0.21404f, 0);
        expect_close(import_position(&scene, 0, 1), 1, 0, 0);
        if (kind < 3)
            import_warned(
                "the alpha of its vertices is not used; export glTF, whose materials use it");
        else
            assert_string_equal(import_warnings, "");
        cs_scene_free(&scene);
    }
}

/* UTF-16 with a byte order mark, of both orders. */
static void utf_16(void **state)
{
    static const char text[] = COLLADA("<?xml version='1.0' encoding='UTF-16'?>", " 0.75 0.25 0 1");
    unsigned char *bytes = malloc(2 * sizeof text);
    (void)state;
    assert_non_null(bytes);
    for (int big = 0; big < 2; big++) {
        bytes[big] = 0xff;
        bytes[!big] = 0xfe;
        for (size_t i = 0; i + 1 < sizeof text; i++) {
            bytes[2 * i + 2 + (size_t)big] = (unsigned char)text[i];
            bytes[2 * i + 2 + (size_t)!big] = 0;
        }
        expect_triangle(test_bytes("wide.dae", bytes, 2 * sizeof text), 0.75f, 0.25f, 0);
    }
    free(bytes);
}

/* A file with a camera of these optics at the origin. */
static const char *camera_file(const char *optics)
{
    static const char plain[] = COLLADA("", "0.5 0.25 0 1");
    const char *effects = strstr(plain, "<library_effects>"), *node = strstr(plain, "<node ");
    char text[8192];
    snprintf(text, sizeof text,
             "%.*s<library_cameras><camera id='c' "
             "name='c'><optics><technique_common>%s</technique_common>"
             "</optics></camera></library_cameras>%.*s<node id='k'><instance_camera url='#c'/>"
             "</node>%s",
             (int)(effects - plain), plain, optics, (int)(node - effects), effects, node);
    return test_file("camera.dae", text);
}

/* What the picture shows downwards: an angle in degrees, or of parallel cameras the height. */
static void expect_extent(const char *optics, float degrees, float height)
{
    cs_scene scene = import_apart(camera_file(optics));
    assert_int_equal(scene.cameras.count, 1);
    const cs_view *view = &((const cs_scene_camera *)scene.cameras.items)->view;
    assert_near(view->orthographic, height, 1e-5f * height);
    if (height <= 0.0f) assert_near(view->fov_deg, degrees, 1e-4f * degrees);
    cs_scene_free(&scene);
}

/* What is downwards counts; what is across needs an aspect: 60 degrees at 4 : 3 are 2 atan(tan 30
 * degrees 3 / 4) downwards. */
static void cameras_show_what_they_say(void **state)
{
    (void)state;
    expect_extent("<perspective><yfov>50</yfov><znear>1</znear><zfar>9</zfar></perspective>", 50.0f,
                  0.0f);
    expect_extent("<perspective>\n <yfov sid='Y'>50</yfov>\n <aspect_ratio>2</aspect_ratio> "
                  "<znear>1</znear><zfar>9</zfar></perspective>",
                  50.0f, 0.0f);
    expect_extent("<perspective><xfov>60</xfov><yfov>46.82644889</yfov><znear>1</znear><zfar>9</"
                  "zfar></perspective>",
                  46.82644889f, 0.0f);
    expect_extent("<perspective><xfov>60</xfov><aspect_ratio>1.3333333</aspect_ratio>"
                  "<znear>1</znear><zfar>9</zfar></perspective>",
                  46.82644889f, 0.0f);
    expect_extent("<orthographic><ymag>1.5</ymag><znear>1</znear><zfar>9</zfar></orthographic>",
                  0.0f, 3.0f);
    expect_extent(
        "<orthographic><xmag>4</xmag><ymag>1.5</ymag><znear>1</znear><zfar>9</zfar></orthographic>",
        0.0f, 3.0f);
    expect_extent("<orthographic><xmag sid='X'> 3</xmag><aspect_ratio>2</aspect_ratio>"
                  "<znear>1</znear><zfar>9</zfar></orthographic>",
                  0.0f, 3.0f);
}

/* Adds `added` to a text before the first `place` in it. */
static void splice(char *text, size_t size, const char *place, const char *added)
{
    char *at = strstr(text, place);
    assert_non_null(at);
    assert_true(strlen(text) + strlen(added) < size);
    memmove(at + strlen(added), at, strlen(at) + 1);
    memcpy(at, added, strlen(added));
}

/* Expects that the texture of a triangle has at its corner 1 the coordinates (s, t). It has two
 * sets of these numbers, with (1, 0) and (0, 1) there. Its material calls one of them U with
 * `digits`, and binds number `bound` to this name, or nothing where that is negative. */
static void expect_set(const int numbers[2], const char *digits, int bound, float s, float t)
{
    static const char binding[] = "<bind_vertex_input semantic='U%s' input_semantic='TEXCOORD' "
                                  "input_set='%d'/>";
    char text[8192], added[512];
    snprintf(text, sizeof text, "%s",
             COLLADA("", "1 1 1 1</color><texture texture='i' texcoord='U'/><color>1 1 1 1"));
    splice(text, sizeof text, "'/><color>", digits);
    splice(text, sizeof text, "<vertices",
           SOURCE("a", "0 0 0 1 0 0 0 1 0") SOURCE("b", "0 0 0 0 1 0 1 0 0"));
    snprintf(added, sizeof added,
             "<input semantic='TEXCOORD' source='#a' offset='0' set='%d'/>"
             "<input semantic='TEXCOORD' source='#b' offset='0' set='%d'/>",
             numbers[0], numbers[1]);
    splice(text, sizeof text, "<p>", added);
    memcpy(strstr(text, "' target='#m'/>"), "' target='#m' >", 15);
    snprintf(added, sizeof added, bound < 0 ? "" : binding, digits, bound);
    splice(text, sizeof text, "</technique_common></bind_material>", added);
    splice(text, sizeof text, "</technique_common></bind_material>", "</instance_material>");
    memcpy(strstr(text, "none"), "some", 4); /* which another test does not find */
    import_picture("some.png");
    cs_scene scene = import_apart(test_file("sets.dae", text));
    assert_string_equal(import_warnings, "");
    expect_st(&scene, 1, s, t);
    cs_scene_free(&scene);
}

/* Sets of texture coordinates are found by what materials bind, or else by the digits in a name,
 * wherever the numbers begin. */
static void sets_of_coordinates(void **state)
{
    static const int pairs[][2] = {{0, 1}, {1, 2}, {3, 12}};
    (void)state;
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        char digits[2][4];
        for (int set = 0; set < 2; set++)
            snprintf(digits[set], sizeof digits[set], "%d", pairs[i][set]);
        for (int set = 0; set < 2; set++) {
            const float s = set == 0 ? 1.0f : 0.0f;
            expect_set(pairs[i], "", pairs[i][set], s, 1.0f - s);
            expect_set(pairs[i], digits[!set], pairs[i][set], s, 1.0f - s);
            expect_set(pairs[i], digits[set], -1, s, 1.0f - s);
        }
        expect_set(pairs[i], "", -1, 1, 0);
        expect_set(pairs[i], "", 13, 0, 1); /* no such set: the one before it */
    }
    cs_scene scene = import_apart(file_with(
        "<library_visual_scenes>", "<bind_vertex_input semantic='U' input_semantic='TEXCOORD' "
                                   "input_set='0'/><bind_vertex_input semantic='U' "
                                   "input_semantic='TEXCOORD' input_set='1'/>"
                                   "<library_visual_scenes>"));
    import_warned("give one name to several sets of texture coordinates");
    cs_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colours_behind_blanks),
        cmocka_unit_test(names_between_lines),
        cmocka_unit_test(polygons_with_holes),
        cmocka_unit_test(morph_targets),
        cmocka_unit_test(skews),
        cmocka_unit_test(skins_as_bound),
        cmocka_unit_test(opacity),
        cmocka_unit_test(sets_of_coordinates),
        cmocka_unit_test(colours_of_vertices),
        cmocka_unit_test(utf_16),
        cmocka_unit_test(cameras_show_what_they_say),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
