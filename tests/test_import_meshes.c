/* PLY and STL files, by what the readers make of small ones. */
#include "import_support.h"

#include <math.h>
#include <stdio.h>

/* ----- PLY ----- */

#define PLY_XYZ "property float x\nproperty float y\nproperty float z\n"
#define PLY_HEAD "ply\nformat ascii 1.0\nelement vertex 4\n" PLY_XYZ
#define PLY_POINTS "-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n"
#define PLY_LIST "property list uchar int vertex_indices\n"
#define PLY_FACE "element face 1\n" PLY_LIST

static void layouts_of_ply(void **state)
{
    (void)state;
    cs_scene scene = import_text("strip.ply", PLY_HEAD "element tristrips 1\nproperty list int int "
                                                       "vertex_indices\nend_header\n" PLY_POINTS
                                                       "8 0 1 3 2 -1 0 1 2\n");
    assert_int_equal(scene.indices.count, 3);
    assert_true(fabs(import_area(&scene) - 6.0) < 1e-6);
    expect_close(import_material(&scene, 0)->diffuse, 0.5f, 0.5f, 0.5f);
    cs_scene_free(&scene);
    scene = import_text("red.ply", PLY_HEAD "property uchar red\nproperty uchar green\n"
                                            "property uchar blue\n" PLY_FACE "end_header\n"
                                            "-1 -1 0 255 0 0\n1 -1 0 188 188 188\n1 1 0 255 0 0\n"
                                            "-1 1 0 255 0 0\n4 0 1 2 3\n");
    expect_close(import_colour(&scene, 0, 0), 1, 0, 0);
    assert_true(fabsf(import_colour(&scene, 0, 1)[0] - 0.5029f) < 1e-3f); /* the sRGB curve */
    expect_close(import_material(&scene, 0)->diffuse, 1, 1, 1);
    assert_string_equal(import_warnings, "");
    cs_scene_free(&scene);
    scene = import_text("int.ply", PLY_HEAD "property int red\nproperty int green\n" /* of bytes */
                                            "property int blue\nproperty uchar alpha\n" PLY_FACE
                                            "end_header\n-1 -1 0 255 0 0 255\n1 -1 0 255 0 0 255\n"
                                            "1 1 0 255 0 0 9\n-1 1 0 510 0 0 255\n4 0 1 2 3\n");
    expect_close(import_colour(&scene, 0, 0), 1, 0, 0);
    import_warned("its vertices have colours up to 2: above 1");
    import_warned(
        "int.ply: the alpha of its vertices is not used; export glTF, whose materials use "
        "it");
    cs_scene_free(&scene);
    scene =
        import_text("faces.ply", PLY_HEAD "element face 2\nproperty list uchar int vertex_index\n"
                                          "property float red\nproperty float green\n"
                                          "property float blue\nend_header\n" PLY_POINTS
                                          "3 0 1 2 1 0 0\n3 0 2 3 0 0.5 0\n");
    expect_close(import_colour(&scene, 0, 0), 1, 0, 0);
    expect_close(import_colour(&scene, 1, 0), 0, 0.5f, 0);
    cs_scene_free(&scene);
}

/* The square as a fan; and one triangle behind -1, which goes round the other way. */
static void fans_of_ply(void **state)
{
    (void)state;
    cs_scene scene = import_text("fan.ply", PLY_HEAD "element trifans 1\nproperty list int int "
                                                     "vertex_indices\nend_header\n" PLY_POINTS
                                                     "8 0 1 2 3 -1 2 1 0\n");
    assert_int_equal(scene.indices.count, 3);
    assert_true(fabs(import_area(&scene) - 6.0) < 1e-6);
    expect_close(import_position(&scene, 1, 0), -1, -1, 0);
    expect_close(import_position(&scene, 1, 1), 1, 1, 0);
    expect_close(import_position(&scene, 1, 2), -1, 1, 0);
    expect_close(import_position(&scene, 2, 0), 1, 1, 0);
    assert_string_equal(import_warnings, "");
    cs_scene_free(&scene);
    import_refused(test_file("fan.ply",
                             PLY_HEAD "element trifans 1\nproperty list int int vertex_indices\n"
                                      "end_header\n" PLY_POINTS "3 0 1 4\n"),
                   "it names a vertex that is not there");
}

/* A triangle with its numbers in either order of bytes. */
static void bytes_of_ply(void **state)
{
    (void)state;
    for (int big = 0; big < 2; big++) {
        unsigned char bytes[512];
        const float positions[9] = {0, 0, 0, 4, 0, 0, 0, 2, 0};
        size_t size = (size_t)snprintf(
            (char *)bytes, sizeof bytes,
            "ply\r\nformat binary_%s_endian 1.0\r\nelement vertex 3\r\nproperty float x\r\n"
            "property float y\r\nproperty float z\r\nelement face 1\r\n"
            "property list uchar ushort vertex_indices\r\nend_header\r\n",
            big ? "big" : "little");
        for (int i = 0; i < 9; i++) {
            uint32_t word;
            memcpy(&word, &positions[i], sizeof word);
            for (int k = 0; k < 4; k++)
                bytes[size++] = (unsigned char)(word >> (big ? 24 - 8 * k : 8 * k));
        }
        bytes[size++] = 3;
        for (int i = 0; i < 3; i++) {
            bytes[size++] = (unsigned char)(big ? 0 : i);
            bytes[size++] = (unsigned char)(big ? i : 0);
        }
        cs_scene scene = import_load(test_bytes("bytes.ply", bytes, size));
        assert_true(fabs(import_area(&scene) - 4.0) < 1e-6);
        cs_scene_free(&scene);
        import_refused(test_bytes("cut.ply", bytes, size - 1), "longer than the rest of the file");
        import_refused(test_bytes("cut.ply", bytes, size - 20), "cut.ply");
    }
}

static void damaged_ply(void **state)
{
    (void)state;
    import_refused(test_file("bad.ply", PLY_HEAD), "ends within its head");
    import_refused(test_file("bad.ply",
                             "ply\nformat ascii 1.0\nelement vertex 4000000000\n"
                             "property float x\nproperty float y\nproperty float z\n" PLY_FACE
                             "end_header\n0 0 0\n"),
                   "more than the file can hold");
    import_refused(test_file("bad.ply", PLY_HEAD PLY_FACE "end_header\n" PLY_POINTS "3 0 1 4\n"),
                   "bad.ply:14: face 0 of 1: it names a vertex that is not there");
    import_refused(test_file("bad.ply", PLY_HEAD PLY_FACE "end_header\n" PLY_POINTS "99 0 1 2\n"),
                   "longer than the rest of the file");
    import_refused(
        test_file("bad.ply", PLY_HEAD PLY_FACE "end_header\n-1 x 0\n" PLY_POINTS "3 0 1 2\n"),
        "bad.ply:10: vertex 0 of 4: this is not a number");
    import_refused(test_file("bad.ply", PLY_HEAD "end_header\n" PLY_POINTS),
                   "4 points but no faces");
    import_refused(
        test_file("bad.ply", PLY_HEAD "property list float int a\nend_header\n" PLY_POINTS),
        "bad.ply:7:");
    import_refused(test_file("bad.ply", PLY_HEAD "element range_grid 1\nproperty list uchar int "
                                                 "vertex_indices\nend_header\n" PLY_POINTS "1 0\n"),
                   "range grids are not supported");
}

/* Each face of a PLY file has the texture that its number says, -1 for none. */
static void textures_of_ply_faces(void **state)
{
    (void)state;
    import_picture("one.ppm");
    import_picture("two.ppm");
    cs_scene scene = import_text(
        "textures.ply",
        "ply\nformat ascii 1.0\ncomment TextureFile one.ppm\ncomment TextureFile two.ppm\n"
        "element vertex 4\n" PLY_XYZ "property float texture_s\nproperty float texture_t\n"
        "element face 3\n" PLY_LIST "property int texnumber\nend_header\n"
        "-1 -1 0 0 0\n1 -1 0 1 0\n1 1 0 1 1\n-1 1 0 0 1\n3 0 1 2 1\n3 0 2 3 0\n3 0 1 3 -1\n");
    assert_int_equal(import_material(&scene, 0)->texture, 1);
    assert_int_equal(import_material(&scene, 1)->texture, 0);
    assert_int_equal(import_material(&scene, 2)->texture, CS_NO_TEXTURE);
    assert_string_equal(import_warnings, "");
    cs_scene_free(&scene);
}

/* tx and ty are texture coordinates of some programs, and with tz the tangents of others. Of two
 * sets the first one counts. */
static void texture_coordinates_of_ply(void **state)
{
    static const struct {
        const char *properties;
        const char *numbers; /* of each vertex */
        int is_there;
    } table[] = {{"s t tx ty tz", "3 4 1 0 0", 1}, {"tx ty tz s t", "1 0 0 3 4", 1},
                 {"tx ty s t", "1 0 3 4", 1},      {"tx ty", "3 4", 1},
                 {"tx ty tz", "1 0 0", 0},         {"u v texture_u texture_v", "3 4 7 8", 1}};
    (void)state;
    import_picture("one.ppm");
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        char text[1024] =
            "ply\nformat ascii 1.0\ncomment TextureFile one.ppm\nelement vertex 4\n" PLY_XYZ;
        char names[64], *rest = names;
        snprintf(names, sizeof names, "%s", table[i].properties);
        for (char *name = strtok_r(names, " ", &rest); name; name = strtok_r(NULL, " ", &rest))
            snprintf(text + strlen(text), sizeof text - strlen(text), "property float %s\n", name);
        strcat(text, "element face 1\n" PLY_LIST "end_header\n");
        for (int k = 0; k < 4; k++)
            snprintf(text + strlen(text), sizeof text - strlen(text), "%d %d 0 %s\n",
                     k == 1 || k == 2 ? 1 : -1, k > 1 ? 1 : -1, table[i].numbers);
        strcat(text, "4 0 1 2 3\n");
        cs_scene scene = import_text("coordinates.ply", text);
        assert_int_equal(*(const uint8_t *)scene.triangle_flags.items & CS_FACE_TEXTURED,
                         table[i].is_there ? CS_FACE_TEXTURED : 0);
        if (table[i].is_there) expect_st(&scene, 0, 3, 4);
        cs_scene_free(&scene);
    }
}

/* Remarks may have any length; other lines of a head may not. */
static void long_remarks_of_ply(void **state)
{
    char remark[1024], text[4096];
    (void)state;
    memset(remark, 'x', sizeof remark - 1);
    remark[sizeof remark - 1] = '\0';
    snprintf(text, sizeof text,
             "ply\ncomment %s\nobj_info %s\nformat ascii 1.0\nelement vertex 4\n" PLY_XYZ
             "element face 1\n" PLY_LIST "end_header\n" PLY_POINTS "4 0 1 2 3\n",
             remark, remark);
    cs_scene scene = import_text("long.ply", text);
    assert_int_equal(scene.triangle_flags.count, 2);
    cs_scene_free(&scene);
    snprintf(text, sizeof text, "ply\nformat %s\n", remark);
    import_refused(test_file("long.ply", text), "long.ply:2: the head has a line of more than 511");
}

/* Returns alone end the lines of the head, and the first number begins with a line feed. */
static void ply_with_returns_alone(void **state)
{
    static const char head[] = "ply\rformat binary_little_endian 1.0\relement vertex 3\r"
                               "property float x\rproperty float y\rproperty float z\r"
                               "element face 1\rproperty list uchar uchar vertex_indices\r"
                               "end_header\r";
    const float positions[9] = {0, 0, 0, 4, 0, 0, 0, 2, 0};
    unsigned char bytes[512];
    (void)state;
    memcpy(bytes, head, sizeof head - 1);
    memcpy(bytes + sizeof head - 1, positions, sizeof positions);
    bytes[sizeof head - 1] = '\n';
    memcpy(bytes + sizeof head - 1 + sizeof positions, "\3\0\1\2", 4);
    cs_scene scene = import_load(test_bytes("mac.ply", bytes, sizeof head + 3 + sizeof positions));
    assert_true(fabs(import_area(&scene) - 4.0) < 1e-6);
    cs_scene_free(&scene);
}

/* ----- STL ----- */

#define FACET                                                                    \
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n" \
    "endloop\nendfacet\n"

static size_t binary_stl(unsigned char *bytes, const char *head, uint32_t count)
{
    const float facet[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
    memset(bytes, 0, 84 + 50 * 2);
    memcpy(bytes, head, strlen(head));
    memcpy(bytes + 80, &count, sizeof count);
    for (size_t i = 0; i < 2; i++)
        memcpy(bytes + 84 + 50 * i, facet, sizeof facet);
    return 84 + 50 * 2;
}

static void kinds_of_stl(void **state)
{
    static const char *const texts[] = {
        "solid x\n" FACET "endsolid x\n",
        "  \n solid\n" FACET "endsolid\nsolid y\n" FACET "endsolid y\n",
        "SOLID X\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\n"
        "VERTEX 1 0 0\nVERTEX 0 1 0\nENDLOOP\nENDFACET\nENDSOLID\n"};
    unsigned char bytes[512];
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        cs_scene scene = import_text("text.stl", texts[i]);
        assert_int_equal(scene.indices.count, i == 1 ? 2 : 1);
        assert_int_equal(scene.positions.count, 3); /* equal corners are one */
        expect_close(import_material(&scene, 0)->diffuse, 0.5f, 0.5f, 0.5f);
        cs_scene_free(&scene);
    }
    size_t size = binary_stl(bytes, "solid facet", 2);
    cs_scene scene = import_load(test_bytes("solid.stl", bytes, size));
    assert_int_equal(scene.indices.count, 2);
    cs_scene_free(&scene);
    size = binary_stl(bytes, "trailing", 1); /* a facet's bytes follow what it counts */
    scene = import_load(test_bytes("trailing.stl", bytes, size));
    assert_int_equal(scene.indices.count, 1);
    import_warned("says that it has 1 triangles; bytes for 1 more");
    cs_scene_free(&scene);
    size = binary_stl(bytes, "COLOR=\xff\x01\x01\xff", 2);
    bytes[84 + 48] = 0xe0;
    bytes[84 + 49] = 0x03;
    scene = import_load(test_bytes("colour.stl", bytes, size));
    expect_close(import_colour(&scene, 0, 0), 0, 1, 0);
    expect_close(import_colour(&scene, 1, 0), 1, 0, 0);
    cs_scene_free(&scene);
    size = binary_stl(bytes, "cut", 3);
    import_refused(test_bytes("cut.stl", bytes, size),
                   "says that it has 3 triangles, but ends after 2");
    import_refused(test_file("bad.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n"),
                   "bad.stl:5: the file ends in a vertex");
    import_refused(test_file("bad.stl", "solid x\nfacet\nvertex 0 0 q\n"), "bad.stl:3:");
}

/* Streams leave the count open. */
static void stl_without_a_count(void **state)
{
    (void)state;
    for (int bits = 0; bits < 2; bits++) {
        unsigned char bytes[84 + 50] = "stream";
        const float corners[9] = {0, 0, 0, 4, 0, 0, 0, 2, 0};
        memset(bytes + 80, bits ? 0xff : 0, 4);
        memcpy(bytes + 84 + 12, corners, sizeof corners);
        cs_scene scene = import_load(test_bytes("stream.stl", bytes, sizeof bytes));
        import_warned("does not say how many triangles it has; 1 fit");
        assert_true(fabs(import_area(&scene) - 4.0) < 1e-6);
        cs_scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(layouts_of_ply),        cmocka_unit_test(fans_of_ply),
        cmocka_unit_test(bytes_of_ply),          cmocka_unit_test(damaged_ply),
        cmocka_unit_test(textures_of_ply_faces), cmocka_unit_test(texture_coordinates_of_ply),
        cmocka_unit_test(long_remarks_of_ply),   cmocka_unit_test(ply_with_returns_alone),
        cmocka_unit_test(kinds_of_stl),          cmocka_unit_test(stl_without_a_count),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
