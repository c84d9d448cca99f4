/* OBJ and MTL files, by what the reader makes of small ones. */
#include "import_support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <time.h>

#define SQUARE "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"
#define COORDINATES "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
#define TEXTURED SQUARE COORDINATES "usemtl t\nf 1/1 2/2 3/3 4/4\n"

/* ----- OBJ and MTL ----- */

static void marks_line_ends_and_encodings(void **state)
{
    static const char *const texts[] = {
        "\xef\xbb\xbfmtllib red.mtl\n" SQUARE "usemtl r\nf 1 2 3 4\n",
        "mtllib red.mtl\r\nv -1 -1 0\r\nv 1 -1 0\r\nv 1 1 0\r\nv -1 1 0\r\nusemtl r\r\nf 1 2 3 4",
        "mtllib red.mtl\rv -1 -1 0\rv 1 -1 0\rv 1 1 0\rv -1 1 0\rusemtl r\rf 1 2 3 4\r",
        "mtllib red.mtl\n" SQUARE "# a comment \\\nusemtl r\nf 1 2 \\ \t\n 3 4 \\",
        "usemtl r\n" SQUARE "f -4 -3 -2 -1\nmtllib red.mtl\n",
        "mtllib red.mtl\nusemtl r\nf 1 2 3 4\n" SQUARE};
    (void)state;
    test_file("red.mtl", "\xef\xbb\xbfnewmtl r\nKd 1 0 0\n");
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        cs_scene scene = import_text("marks.obj", texts[i]);
        assert_int_equal(scene.indices.count, 2);
        expect_close(import_material(&scene, 0)->diffuse, 1, 0, 0);
        assert_string_equal(import_warnings, "");
        cs_scene_free(&scene);
    }
    for (int big = 0; big < 2; big++) {
        const char *text = texts[5];
        char wide[1024] = {0};
        size_t size = 2;
        memcpy(wide, big ? "\xfe\xff" : "\xff\xfe", 2);
        for (; *text != '\0'; text++, size += 2)
            wide[size + (size_t)big] = *text;
        cs_scene scene = import_load(test_bytes("wide.obj", wide, size));
        expect_close(import_material(&scene, 0)->diffuse, 1, 0, 0);
        cs_scene_free(&scene);
    }
}

static void maps_are_found_wherever_they_are(void **state)
{
    static const char *const lines[] = {"map_Kd four.ppm",
                                        "map_Kd \"four.ppm\"",
                                        "map_Kd .\\four.ppm",
                                        "map_Kd FOUR.ppm",
                                        "map_Kd C:\\Users\\x\\four.ppm",
                                        "map_Kd -blendu on -texres 64 -imfchan l four.ppm",
                                        "map_kd\t four.ppm  ",
                                        "map_Kd ..\\of\\the\\author\\four.ppm",
                                        "map_Kd file:///nowhere/four.ppm",
                                        "map_Kd four.ppm -s 1 1 1 -clamp off"};
    char text[256];
    (void)state;
    mkdir(test_path("materials"), 0700);
    import_picture("materials/four.ppm");
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        snprintf(text, sizeof text, "newmtl t\nKd 1 1 1\n%s\n", lines[i]);
        test_file("materials/sub.mtl", text);
        cs_scene scene = import_text("sub.obj", "mtllib materials\\sub.mtl\n" TEXTURED);
        assert_string_equal(import_warnings, "");
        assert_int_equal(scene.textures.count, 1);
        assert_int_equal(import_material(&scene, 0)->texture, 0);
        cs_scene_free(&scene);
    }
}

static void map_options_are_obeyed(void **state)
{
    (void)state;
    import_picture("four.ppm");
    test_file("options.mtl", "newmtl t\nKd 1 1 1\nmap_Kd -s 2 3 1 -o 0.5 0.25 0 -clamp on "
                             "-mm 0.25 0.5 four.ppm\n");
    cs_scene scene = import_text("options.obj", "mtllib options.mtl\n" TEXTURED);
    const cs_texture *texture = scene.textures.items;
    texture += import_material(&scene, 0)->texture;
    assert_int_equal(texture->lookup, CS_TEXTURE_CLAMP | CS_TEXTURE_CLAMP << CS_TEXTURE_WRAP_BITS);
    expect_st(&scene, 0, 0.5f, 0.25f);
    expect_st(&scene, 2, 2.5f, 3.25f);
    const uint16_t *texel = (const uint16_t *)scene.texels.items + 4 * texture->first;
    assert_int_equal(texel[0], 0x3a00); /* 0.75 */
    assert_int_equal(texel[1], 0x3400); /* 0.25 */
    assert_string_equal(import_warnings, "");
    cs_scene_free(&scene);
}

/* An option without its word takes nothing, least of all the name. */
static void words_of_map_options(void **state)
{
    static const struct {
        const char *line;
        int clamps;
    } lines[] = {{"-clamp on four.ppm", 1},    {"-clamp ON four.ppm", 1},
                 {"four.ppm -clamp on", 1},    {"-clamp off four.ppm", 0},
                 {"-clamp four.ppm", 0},       {"four.ppm -clamp", 0},
                 {"-imfchan four.ppm", 0},     {"-blendu -cc four.ppm", 0},
                 {"-type sphere four.ppm", 0}, {"-colorspace sRGB four.ppm", 0}};
    char text[128];
    (void)state;
    import_picture("four.ppm");
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        snprintf(text, sizeof text, "newmtl t\nKd 1 1 1\nmap_Kd %s\n", lines[i].line);
        test_file("words.mtl", text);
        cs_scene scene = import_text("words.obj", "mtllib words.mtl\n" TEXTURED);
        assert_string_equal(import_warnings, "");
        const cs_texture *texture = scene.textures.items;
        texture += import_material(&scene, 0)->texture;
        assert_int_equal(texture->lookup & CS_TEXTURE_CLAMP,
                         lines[i].clamps ? CS_TEXTURE_CLAMP : 0);
        cs_scene_free(&scene);
    }
}

/* Exporters of MTL leave Kd 0 beside a map, or no Kd; in glTF black is black. */
static void black_beside_a_map(void **state)
{
    (void)state;
    import_picture("four.ppm");
    test_file("none.mtl", "newmtl t\nmap_Kd four.ppm # no Kd\n");
    cs_scene bare = import_text("none.obj", "mtllib none.mtl # one\n" TEXTURED);
    expect_close(import_material(&bare, 0)->diffuse, 1, 1, 1);
    assert_string_equal(import_warnings, "");
    cs_scene_free(&bare);
    test_file("black.mtl", "newmtl t\nKd 0 0 0\nmap_Kd four.ppm\n");
    cs_scene scene = import_text("black.obj", "mtllib black.mtl\n" TEXTURED);
    expect_close(import_material(&scene, 0)->diffuse, 1, 1, 1);
    cs_scene_free(&scene);
    import_picture("my four.ppm");
    scene = import_load(
        import_gltf_square(",\"TEXCOORD_0\":1",
                           "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0},"
                           "\"baseColorFactor\":[0,0,0,1]}}",
                           "{\"mesh\":0}", ""));
    expect_close(import_material(&scene, 0)->diffuse, 0, 0, 0);
    cs_scene_free(&scene);
}

static void what_is_missing_is_told_once(void **state)
{
    (void)state;
    cs_scene scene = import_text("missing.obj", "mtllib gone.mtl\nmtllib gone.mtl\n" SQUARE
                                                "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n");
    import_warned("material file gone.mtl not found");
    assert_ptr_equal(strchr(import_warnings, '\n'), import_warnings + strlen(import_warnings) - 1);
    cs_scene_free(&scene);
    test_file("some.mtl", "newmtl a\nKd 1 0 0\nmap_Kd none.png\nnewmtl c\nKd 1 1 1\n"
                          "map_Kd none.png\n");
    scene = import_text("some.obj", "mtllib some.mtl\n" SQUARE COORDINATES
                                    "usemtl a\nf 1/1 2/2 3/3\nusemtl c\nf 1/1 3/3 4/4\n"
                                    "usemtl lost\nf 1 2 4\n");
    import_warned("texture none.png is not there");
    import_warned("material \"lost\" is not defined");
    assert_int_equal(strstr(strstr(import_warnings, "none.png") + 1, "none.png") == NULL, 1);
    expect_close(import_material(&scene, 0)->diffuse, 0.5f, 0.5f, 0.5f);
    cs_scene_free(&scene);
}

static void material_lines(void **state)
{
    (void)state;
    test_file("lines.mtl", "newmtl a\nKd 0.25\nnewmtl b\nKd 2 1 1\nKe 1 2 3\n"
                           "newmtl c\nKd xyz 1 1 1\nPm 1\nPr 0.2\nmap_Bump x.png\nd 0.5\naniso 1\n"
                           "map_Ks y.png\nnewmtl e\nKd 0 1 0;\n");
    cs_scene scene = import_text("lines.obj", "mtllib lines.mtl\n" SQUARE
                                              "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n"
                                              "usemtl c\nf 1 2 4\n");
    expect_close(import_material(&scene, 0)->diffuse, 0.25f, 0.25f, 0.25f);
    expect_close(import_material(&scene, 1)->diffuse, 2, 1, 1);
    expect_close(import_material(&scene, 1)->emission, 1, 2, 3);
    import_warned("\"b\" has the colour 2 1 1: above 1");
    import_warned("lines.mtl:15: Kd \"0;\" is not a number");
    import_warned("lines.mtl:7: Kd \"xyz 1 1 1\" is not a number");
    import_warned("texture x.png is not there; it is left out");
    import_warned("\"c\": not supported, left out: anisotropy, a map of highlights\n");
    cs_scene_free(&scene);
}

static void vertex_colours_of_obj(void **state)
{
    (void)state;
    cs_scene scene =
        import_text("colours.obj", "v -1 -1 0 1 0 0\nv 1 -1 0 1 0 0.5 0\nv 1 1 0 0 0 2\n"
                                   "v -2 2 0 2\nf 1 2 3\nf 1 3 4\n");
    expect_close(import_colour(&scene, 0, 0), 1, 0, 0);
    expect_close(import_colour(&scene, 0, 1), 0, 0.21404f, 0); /* the sRGB curve */
    expect_close(import_colour(&scene, 0, 2), 0, 0, 2);
    expect_close(import_colour(&scene, 1, 2), 1, 1, 1); /* none given */
    expect_close(import_position(&scene, 1, 2), -1, 1, 0);
    const uint8_t *flags = scene.triangle_flags.items;
    assert_int_equal(flags[0], CS_FACE_COLOURED);
    const cs_material *materials = scene.materials.items;
    const uint32_t *numbers = scene.triangle_materials.items;
    expect_close(materials[numbers[0]].diffuse, 1, 1, 1); /* what the colours multiply */
    cs_scene_free(&scene);
}

static void texture_without_coordinates(void **state)
{
    (void)state;
    import_picture("four.ppm");
    test_file("plain.mtl", "newmtl t\nKd 1 1 1\nmap_Kd four.ppm\n");
    cs_scene scene = import_text("plain.obj", "mtllib plain.mtl\n" SQUARE COORDINATES
                                              "usemtl t\nf 1/1 2/2 3/3\nf 1 3 4\n");
    const uint8_t *flags = scene.triangle_flags.items;
    assert_int_equal(flags[0], CS_FACE_TEXTURED);
    assert_int_equal(flags[1], 0);
    import_warned("\"t\" has a texture, but 1 of its triangles have no texture coordinates");
    cs_scene_free(&scene);
}

static void polygons_keep_their_area(void **state)
{
    (void)state;
    char text[8192] = "";
    cs_scene scene = import_text("arrow.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 0.5 0\nv 0 2 0\n"
                                              "f 1 2 3 4 5\nf 5 4 3 2 1\n");
    assert_true(fabs(import_area(&scene) - 2.0 * 2.5) < 1e-6);
    cs_scene_free(&scene);
    double expected = 0.0;
    for (int i = 0; i < 60; i++) { /* a star */
        const double angle = 6.283185307179586 * i / 60, radius = i % 2 == 0 ? 1.0 : 0.4;
        snprintf(text + strlen(text), sizeof text - strlen(text), "v %.9f %.9f 0\n",
                 radius * cos(angle), radius * sin(angle));
        expected += 0.5 * 0.4 * sin(6.283185307179586 / 60);
    }
    strcat(text, "f");
    for (int i = 0; i < 60; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), " %d", i + 1);
    scene = import_text("star.obj", text);
    assert_int_equal(scene.indices.count, 58);
    assert_true(fabs(import_area(&scene) - expected) < 1e-6);
    cs_scene_free(&scene);
}

static void damaged_obj(void **state)
{
    (void)state;
    import_refused(test_file("bad.obj", SQUARE "f 1 2 9\n"), "bad.obj:5: the face names vertex 9");
    import_refused(test_file("bad.obj", SQUARE "f 1/3 2 3\n"), "bad.obj:5: the face names texture");
    import_refused(test_file("bad.obj", SQUARE "f 1 2 0\n"), "bad.obj:5:");
    import_refused(test_file("bad.obj", SQUARE "f 1 2 -5\n"), "bad.obj:5:");
    import_refused(test_file("bad.obj", SQUARE "f 1 \\\n2 x\n"), "bad.obj:5: \"x\" is no corner");
    import_refused(test_file("bad.obj", "v 1 2\n"), "bad.obj:1: a vertex needs three numbers");
    import_refused(test_file("bad.obj", "v 1 2 nan\nv 0 0 0\nv 1 0 0\nf 1 2 3\n"),
                   "not a finite number");
    import_refused(test_file("bad.obj", SQUARE "l 1 2\n"), "points and lines only");
    import_refused(test_file("bad.obj", SQUARE "curv 0 1 1 2\n"), "free-form");
    import_refused(test_file("bad.obj", "hello\n"), "is it one?");
    import_refused(test_file("bad.obj", ""), "is empty");
    import_refused(SCRATCH, "is a folder");
}

/* ----- Names of materials ----- */

/* Expects a triangle's material to be of a colour of 0 or 1 in each of red, green and blue. */
static void expect_material(const cs_scene *scene, size_t triangle, const char *rgb)
{
    expect_close(import_material(scene, triangle)->diffuse, (float)(rgb[0] - '0'),
                 (float)(rgb[1] - '0'), (float)(rgb[2] - '0'));
}

/* What follows a # is part of the name where a material is called so, else a comment. */
static void names_with_comments(void **state)
{
    (void)state;
    test_file("names.mtl", "newmtl Material #1\nKd 1 0 0\nnewmtl Material\nKd 0 1 0\n"
                           "newmtl red\nKd 0 0 1\nnewmtl red\nKd 1 0 0\n");
    cs_scene scene =
        import_text("names.obj", "mtllib names.mtl\n" SQUARE "usemtl Material #1\nf 1 2 3\n"
                                 "usemtl red # a\nf 1 2 3\nusemtl red # b\nf 1 2 3\n"
                                 "usemtl red\nf 1 2 3\nusemtl Material # c\nf 1 2 3\n"
                                 "usemtl Material #2\nf 1 2 3\n");
    static const char *const colours[] = {"100", "100", "100", "100", "010", "010"};
    for (size_t i = 0; i < sizeof colours / sizeof *colours; i++)
        expect_material(&scene, i, colours[i]);
    assert_string_equal(import_warnings, "");
    cs_scene_free(&scene);
    test_file("whole.mtl", "newmtl red # a\nKd 1 0 0\n");
    scene = import_text("whole.obj", "mtllib whole.mtl\n" SQUARE
                                     "usemtl red # a\nf 1 2 3\nusemtl red\nf 1 3 4\n");
    expect_material(&scene, 0, "100");
    import_warned("material \"red\" is not defined");
    cs_scene_free(&scene);
}

/* Libraries whose names begin with the same 255 bytes are two. */
static void long_names_of_libraries(void **state)
{
    char name[300], text[1024];
    (void)state;
    for (size_t i = 0; i < 280; i += 2)
        memcpy(name + i, "./", 2);
    for (int i = 0; i < 2; i++) {
        snprintf(name + 280, sizeof name - 280, "long%d.mtl", i);
        snprintf(text, sizeof text, "newmtl m%d\nKd %d 1 0\n", i, i);
        test_file(name + 280, text);
    }
    name[280] = '\0';
    snprintf(text, sizeof text,
             "mtllib %slong0.mtl\nmtllib %slong1.mtl\n" SQUARE
             "usemtl m0\nf 1 2 3\nusemtl m1\nf 1 2 3\n",
             name, name);
    cs_scene scene = import_text("long.obj", text);
    assert_string_equal(import_warnings, "");
    expect_material(&scene, 0, "010");
    expect_material(&scene, 1, "110");
    cs_scene_free(&scene);
}

/* Time that is linear in the number of materials: 20 000 that are defined and 20 000 others that
 * are used with comments took the square of that, many seconds. */
static void many_names(void **state)
{
    enum {
        COUNT = 20000,
        ROOM = 48 * COUNT
    };
    char *text = malloc(ROOM);
    size_t used = 0;
    (void)state;
    assert_non_null(text);
    for (int i = 0; i < COUNT; i++)
        used += (size_t)snprintf(text + used, ROOM - used, "newmtl m%d\n", i);
    test_file("many.mtl", text);
    used = (size_t)snprintf(text, ROOM, "mtllib many.mtl\n" SQUARE);
    for (int i = 0; i < COUNT; i++)
        used += (size_t)snprintf(text + used, ROOM - used, "usemtl n%d # n\nf 1 2 3\n", i);
    const clock_t begin = clock();
    cs_scene scene = import_text("many.obj", text);
    const double taken_s = (double)(clock() - begin) / CLOCKS_PER_SEC;
    print_message("%d names of materials: %.2f s\n", COUNT, taken_s);
    assert_below(taken_s, 3.0);
    cs_scene_free(&scene);
    free(text);
}

/* ----- Smoothness ----- */

/* Normals count by their direction alone, and one without a direction not at all. */
static void normals_have_length_one(void **state)
{
    cs_scene scene;
    (void)state;
    scene = import_text("long.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1000\nvn 0 3e-20 0\n"
                                    "vn 0 0 0\nf 1//1 2//2 3//3\n");
    expect_close(import_vertex(&scene, 0, 0)->normal, 0, 0, 1);
    expect_close(import_vertex(&scene, 0, 1)->normal, 0, 1, 0);
    expect_close(import_vertex(&scene, 0, 2)->normal, 0, 0, 0);
    cs_scene_free(&scene);
}

#define ROOF "v -1 0 0\nv 0 0 1\nv 1 0 0\nv -1 1 0\nv 0 1 1\nv 1 1 0\n"

static void smoothing_groups_and_angles(void **state)
{
    cs_scene scene;
    cs_error error;
    (void)state;
    /* Two planes that meet at a right angle. */
    scene = import_text("roof.obj", ROOF "s 1\nf 1 2 5 4\nf 2 3 6 5\n");
    expect_close(import_vertex(&scene, 0, 1)->normal, 0, 0, 1);
    cs_scene_free(&scene);
    scene = import_text("roof.obj", ROOF "s 1\nf 1 2 5 4\ns 2\nf 2 3 6 5\n");
    expect_close(import_vertex(&scene, 0, 1)->normal, -0.70711f, 0, 0.70711f);
    cs_scene_free(&scene);
    /* A leaf of two sides that lie on each other, of own vertices: each has its own normal. */
    scene = import_text("leaf.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                                    "s 1\nf 1 2 3\nf 6 5 4\n");
    expect_close(import_vertex(&scene, 0, 1)->normal, 0, 0, 1);
    expect_close(import_vertex(&scene, 1, 1)->normal, 0, 0, -1);
    cs_scene_free(&scene);
    const char *flat = test_file("flat.obj", ROOF "s off\nf 1 2 5 4\nf 2 3 6 5\n");
    scene = import_load(flat);
    assert_int_equal(*(const uint8_t *)scene.triangle_flags.items, 0);
    cs_scene_free(&scene);
    assert_int_equal(import_smooth(flat, 80.0, &scene, &error), CLSHEAR_OK);
    expect_close(import_vertex(&scene, 0, 1)->normal, -0.70711f, 0, 0.70711f);
    cs_scene_free(&scene);
    assert_int_equal(import_smooth(flat, 100.0, &scene, &error), CLSHEAR_OK);
    expect_close(import_vertex(&scene, 0, 1)->normal, 0, 0, 1);
    cs_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(marks_line_ends_and_encodings),
        cmocka_unit_test(maps_are_found_wherever_they_are),
        cmocka_unit_test(map_options_are_obeyed),
        cmocka_unit_test(words_of_map_options),
        cmocka_unit_test(black_beside_a_map),
        cmocka_unit_test(what_is_missing_is_told_once),
        cmocka_unit_test(material_lines),
        cmocka_unit_test(vertex_colours_of_obj),
        cmocka_unit_test(texture_without_coordinates),
        cmocka_unit_test(polygons_keep_their_area),
        cmocka_unit_test(damaged_obj),
        cmocka_unit_test(normals_have_length_one),
        cmocka_unit_test(names_with_comments),
        cmocka_unit_test(long_names_of_libraries),
        cmocka_unit_test(many_names),
        cmocka_unit_test(smoothing_groups_and_angles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
