/* Kinds of scene files on which public reports of other programs dwell: what becomes of each. */
#include "import_support.h"

#include <math.h>
#include <stdio.h>

#define SQUARE "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"
#define POINTS "-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n"
#define XYZ "property float x\nproperty float y\nproperty float z\n"
#define RGB(type) "property " type " red\nproperty " type " green\nproperty " type " blue\n"
#define RED_POINTS "-1 -1 0 255 0 0\n1 -1 0 255 0 0\n1 1 0 255 0 0\n-1 1 0 255 0 0\n"
#define PLY(vertex, face, numbers)                                             \
    "ply\nformat ascii 1.0\nelement vertex 4\n" vertex "element face 1\n" face \
    "end_header\n" numbers
#define LIST "property list uchar int vertex_indices\n"
#define LOOP(a, b, c) "outer loop\nvertex " a "\nvertex " b "\nvertex " c "\nendloop\n"
#define FACETS                                                                           \
    "facet normal 0 0 1\n" LOOP("-1 -1 0", "1 -1 0",                                     \
                                "1 1 0") "endfacet\n"                                    \
                                         "facet normal 0 0 1\n" LOOP("-1 -1 0", "1 1 0", \
                                                                     "-1 1 0") "endfacet\n"

/* Files of a square with the area 4, and the colour of its first corner. */
static const struct {
    const char *name;
    const char *text;
    float colour[3];
    const char *warning; /* "" for none */
} squares[] = {
    {"faces-first.ply",
     "ply\nformat ascii 1.0\nelement face 1\n" LIST "element vertex 4\n" XYZ
     "end_header\n4 0 1 2 3\n" POINTS,
     {0.5f, 0.5f, 0.5f},
     ""},
    {"longer-lines.ply",
     PLY(XYZ, LIST, "-1 -1 0 7 7\n1 -1 0 7 7\n1 1 0 7 7\n-1 1 0 7 7\n4 0 1 2 3\n"),
     {0.5f, 0.5f, 0.5f},
     "lines with more numbers than the head says"},
    {"capitals.ply",
     PLY("property float X\nproperty float Y\nproperty float Z\nproperty uchar Red\n"
         "property uchar Green\nproperty uchar Blue\n",
         LIST, RED_POINTS "4 0 1 2 3\n"),
     {1, 0, 0},
     ""},
    {"elements.ply",
     "ply\nformat ascii 1.0\nelement Vertex 4\n" XYZ "element Face 1\n" LIST "end_header\n" POINTS
     "4 0 1 2 3\n",
     {0.5f, 0.5f, 0.5f},
     ""},
    {"floats-to-255.ply", PLY(XYZ RGB("float"), LIST, RED_POINTS "4 0 1 2 3\n"), {1, 0, 0}, ""},
    {"int64.ply",
     PLY(XYZ "property int64 id\n", LIST, "-1 -1 0 1\n1 -1 0 2\n1 1 0 3\n-1 1 0 4\n4 0 1 2 3\n"),
     {0.5f, 0.5f, 0.5f},
     ""},
    {"material.ply",
     "ply\nformat ascii 1.0\nelement vertex 4\n" XYZ "element face 1\n" LIST
     "element material 1\nproperty uchar diffuse_red\nend_header\n" POINTS "4 0 1 2 3\n255\n",
     {0.5f, 0.5f, 0.5f},
     "\"material\" is not supported"},
    {"behind.ply",
     PLY(XYZ, LIST, POINTS "4 0 1 2 3\n3 0 2 3\n"),
     {0.5f, 0.5f, 0.5f},
     "goes on behind the last item that its head counts; 8 bytes are left out"},
    {"names.ply",
     PLY(XYZ "property float normal_x\nproperty float normal_y\nproperty float normal_z\n"
             "property uchar diffuse_r\nproperty uchar diffuse_g\nproperty uchar diffuse_b\n",
         LIST,
         "-1 -1 0 0 0 1 255 0 0\n1 -1 0 0 0 1 255 0 0\n1 1 0 0 0 1 255 0 0\n"
         "-1 1 0 0 0 1 255 0 0\n4 0 1 2 3\n"),
     {1, 0, 0},
     ""},
    {"comment.stl", "# by hand\nsolid a\n" FACETS "endsolid\n", {0.5f, 0.5f, 0.5f}, ""},
    {"words.stl", "solid facet vertex\n" FACETS "endsolid vertex\n", {0.5f, 0.5f, 0.5f}, ""},
    {"last.stl", "solid facet\n" FACETS "endsolid facet end\n", {0.5f, 0.5f, 0.5f}, ""},
    {"apart.stl",
     "solid the end\nfacet\nouter loop\nvertex -1 -1 0\nvertex 3 -1 0\nvertex -1 1 0\n"
     "end loop\nend facet\nend solid\n",
     {0.5f, 0.5f, 0.5f},
     ""},
    {"open.stl",
     "solid\nfacet\nouter loop\nvertex -1 -1 0\nvertex 3 -1 0\nvertex -1 1 0\nendloop\n"
     "endsolid\n",
     {0.5f, 0.5f, 0.5f},
     ""},
    {"line.stl",
     "solid a facet normal 0 0 1 outer loop vertex -1 -1 0 vertex 3 -1 0 vertex -1 1 0 endloop "
     "endfacet endsolid a\n",
     {0.5f, 0.5f, 0.5f},
     ""},
    {"loops.stl",
     "solid a\n" LOOP("-1 -1 0", "1 -1 0", "1 1 0") LOOP("-1 -1 0", "1 1 0", "-1 1 0"),
     {0.5f, 0.5f, 0.5f},
     ""},
    {"plain.off", "OFF\n# c\n\n4 1 0 # counts\n" POINTS "4 0 1 2 3 # face", {0.5f, 0.5f, 0.5f}, ""},
    {"comment.off", "# c\nOFF\n4 1\n" POINTS "4 0 1 2 3\n", {0.5f, 0.5f, 0.5f}, ""},
    {"glued.off", "OFF4 1 0\n" POINTS "4 0 1 2 3\n", {0.5f, 0.5f, 0.5f}, ""},
    {"unmarked.off", "4 1 0\n" POINTS "4 0 1 2 3\n", {0.5f, 0.5f, 0.5f}, ""},
    {"faces.off", "OFF 4 1 0\n" POINTS "4 0 1 2 3 255 0 0\n", {1, 0, 0}, ""},
    {"share.off", "OFF 4 1 0\n" POINTS "4 0 1 2 3 0 1.0 0 0.5\n", {0, 1, 0}, ""},
    {"vertices.off", "COFF\n4 1 0\n" RED_POINTS "4 0 1 2 3\n", {1, 0, 0}, ""},
    {"no-c.off", "OFF\n4 1 0\n" RED_POINTS "4 0 1 2 3\n", {1, 0, 0}, ""},
    {"all.off",
     "STCNOFF\n4 1 0\n-1 -1 0 0 0 1 0 1 0 1 0 0\n1 -1 0 0 0 1 0 1 0 1 1 0\n"
     "1 1 0 0 0 1 0 1 0 1 1 1\n-1 1 0 0 0 1 0 1 0 1 0 1\n4 0 1 2 3\n",
     {0, 1, 0},
     ""},
    {"four.off",
     "4OFF\n4 1 0\n-2 -2 0 2\n1 -1 0 1\n1 1 0 1\n-1 1 0 1\n4 0 1 2 3\n",
     {0.5f, 0.5f, 0.5f},
     ""},
    {"shared.off",
     "OFF 4 2\n-1 -1 0 1 -1 0\n1 1 0 -1 1 0\n3 0 1 2\n3 0 2 3\n",
     {0.5f, 0.5f, 0.5f},
     ""},
    {"faces-share.off", "COFF\n4 2 0\n" RED_POINTS "3 0 1 2 3 0 2 3\x1a", {1, 0, 0}, ""},
    {"one-line.off",
     "STOFF 4 1 0 -1 -1 0 0 0 1 -1 0 1 0 1 1 0 1 1 -1 1 0 0 1 4 0 1 2 3",
     {0.5f, 0.5f, 0.5f},
     ""},
    {"spread.off",
     "OFF\n4 1 0\n-1\n-1 0\n1 -1 0\n1 1\n0\n-1 1 0\n4\n0 1 2 3\n",
     {0.5f, 0.5f, 0.5f},
     ""},
    {"more.off",
     "OFF\n4 1 0\n-1 -1 0 7 7 7 7 7 7 7 7 7 7 7 7 7 7 7 7 7\n1 -1 0\n1 1 0\n-1 1 0\n4 0 1 2 3\n",
     {0.5f, 0.5f, 0.5f},
     "more.off: has lines with more numbers"},
    {"two-more.off",
     "OFF\n4 1 0\n-1 -1 0 0.5 0.5\n1 -1 0\n1 1 0\n-1 1 0\n4 0 1 2 3\n",
     {0.5f, 0.5f, 0.5f},
     "two-more.off: has lines with more numbers"},
    {"counts.off", "OFF\n4\n1\n5\n" POINTS "4 0 1 2 3\n", {0.5f, 0.5f, 0.5f}, ""},
    {"no-edges.off", "OFF\n4\n1\n" POINTS "4 0 1 2 3\n", {0.5f, 0.5f, 0.5f}, ""},
    {"behind.off",
     "OFF\n4 1 0\n" POINTS "4 0 1 2 3\n3 0 1 2\n",
     {0.5f, 0.5f, 0.5f},
     "behind.off:8: what is behind the faces"},
    {"more-faces.off",
     "OFF\n4 1 0\n" POINTS "4 0 1 2 3 1 0 0 1 9\n",
     {0.5f, 0.5f, 0.5f},
     "more-faces.off: has lines with more numbers"},
    {"bytes.obj",
     "v -1 -1 0 255 0 0\nv 1 -1 0 1 1 1\nv 1 1 0 9 9 9\nv -1 1 0 0 0 0\nf 1 2 3 4\n",
     {1, 0, 0},
     ""},
    {"paint.obj",
     SQUARE "#MRGB ffff0000ff00ff00\n#MRGB ff0000ffff000000\nf 1 2 3 4\n",
     {1, 0, 0},
     ""},
    {"absent.obj", SQUARE "f 1/0/0 2/0/0 3/0/0 4/0/0\n", {0.5f, 0.5f, 0.5f}, ""},
    {"windows.obj", SQUARE "v -1.#IND 1.#QNAN 0\nf 1 2 3 4\n", {0.5f, 0.5f, 0.5f}, ""},
    {"capitals.obj", "V -1 -1 0\nV 1 -1 0\nV 1 1 0\nV -1 1 0\nF 1 2 3 4\n", {0.5f, 0.5f, 0.5f}, ""},
    {"namesake.obj", SQUARE "usemtl r\nf 1 2 3 4\n", {1, 0, 0}, ""},
    {"comment.obj", "mtllib namesake.mtl\n" SQUARE "usemtl r # red\nf 1 2 3 4\n", {1, 0, 0}, ""},
    {"marks.obj",
     "\xef\xbb\xbf\xef\xbb\xbfmtllib namesake.mtl\n" SQUARE "usemtl r\nf 1 2 3 4\n",
     {1, 0, 0},
     ""},
    {"call.obj",
     SQUARE "f 1 2 3 4\ncall more.obj\n",
     {0.5f, 0.5f, 0.5f},
     "call.obj:6: \"call\" is not supported"},
};

static void squares_of_all_kinds(void **state)
{
    (void)state;
    test_file("namesake.mtl", "newmtl r\nKd 1 0 0\n");
    for (size_t i = 0; i < sizeof squares / sizeof *squares; i++) {
        cs_scene scene = import_text(squares[i].name, squares[i].text);
        const float *colour = import_material(&scene, 0)->diffuse;
        if (colour[0] == 1.0f && colour[1] == 1.0f) colour = import_colour(&scene, 0, 0);
        expect_close(colour, squares[i].colour[0], squares[i].colour[1], squares[i].colour[2]);
        assert_true(fabs(import_area(&scene) - 4.0) < 1e-6);
        if (squares[i].warning[0] == '\0')
            assert_string_equal(import_warnings, "");
        else
            import_warned(squares[i].warning);
        cs_scene_free(&scene);
    }
}

static const struct {
    const char *name;
    const char *text;
    const char *words;
} refused[] = {
    {"short.ply", PLY(XYZ "property float q\n", LIST, POINTS "4 0 1 2 3\n"),
     "short.ply:11: vertex 0 of 4: its line has fewer numbers than the head says"},
    {"none.ply", "ply\nformat ascii 1.0\nelement face 1\n" LIST "end_header\n3 0 1 2\n",
     "has faces but no vertices"},
    {"two.stl", "solid a\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n",
     "two.stl:6: a facet has fewer than three vertices"},
    {"binary.off", "OFF BINARY\n\1\2", "binary OFF is not supported; export it as text"},
    {"range.off", "OFF\n4 1 0\n" POINTS "3 0 1 4\n",
     "range.off:7: the face names a vertex that is not there"},
    {"back.off", "OFF\n4 1 0\n" POINTS "3 0 1 -1\n", "back.off:7:"},
    {"cut.off", "OFF\n4 3 0\n" POINTS "4 0 1 2 3\n", "cut.off:7: the file ends here"},
    {"cut-black.off", "OFF\n4 3 0\n" POINTS "3 0 1 2 0 0 0\n3 0 2 3 0 0 0\n",
     "cut-black.off: has fewer lines than vertices and faces, but more numbers; it was cut"},
    {"cut-red.off", "OFF\n4 3 0\n" POINTS "3 0 1 2 255 0 0\n3 0 2 3 255 0 0\n",
     "or lines are missing: the file was cut"},
    {"cut-vertices.off", "OFF\n4 3 0\n" RED_POINTS "3 0 1 2\n", "the file was cut"},
    {"word.off", "OFF\n4 1 0\n0 0 x\n", "word.off:3: this is not a number"},
    {"share.off", "OFF\n4.5 1 0\n" POINTS "4 0 1 2 3\n", "share.off:2: a count must be a whole"},
    {"corners.off", "OFF\n4 1 0\n" POINTS "3.5 0 1 2 3\n",
     "corners.off:7: a count must be a whole"},
    {"between.off", "OFF\n4 1 0\n" POINTS "4 0 1.5 2 3\n",
     "between.off:7: the face names a vertex that is not there"},
    {"points.off", "OFF\n4 0 0\n" POINTS, "there are no faces in it"},
    {"comma.obj", "v 1,5 2 3\n",
     "comma.obj:1: a vertex needs three numbers; \"1,5\" is not a number"},
    {"none.obj", "f 1 2 3\n", "none.obj:1: the face names vertex 1, but there are none"},
    {"library.obj", "mtllib namesake.mtl\n", "library.obj: has no vertices and no faces"},
    {"groups.obj", "# a\no a\ng b\n", "groups.obj: has no vertices and no faces"},
    {"gzip.obj", "\x1f\x8b\x08", "compressed by gzip; unpack it first"},
    {"zip.obj", "PK\3\4", "is a ZIP archive; unpack it first"},
    {"lost.stl", "solid\nfacet\nvertex 0 0 1\nvertex 0 1 0\n" FACETS,
     "lost.stl:5: a facet has fewer than three vertices"},
    {"faces.stl", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "is text without facets"},
    {"pointer.stl", "version https://git-lfs.github.com/spec/v1\n", "run git lfs pull"},
    {"page.ply", "<!DOCTYPE html>\n", "is a web page"},
    {"page.off", "\xef\xbb\xbf\n\n  <!Doctype HTML>\n", "is a web page"},
};

static void refusals_name_the_remedy(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++)
        import_refused(test_file(refused[i].name, refused[i].text), refused[i].words);
}

/* In place of Assimp: takes what is called so, and refuses all else. */
static clshear_status read_some(cs_bytes *bytes, cs_model *model, cs_error *error)
{
    (void)bytes;
    static const double triangle[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    static const cs_corner corners[3] = {{0, CS_NO_INDEX, CS_NO_INDEX},
                                         {1, CS_NO_INDEX, CS_NO_INDEX},
                                         {2, CS_NO_INDEX, CS_NO_INDEX}};
    if (strstr(model->path, "some.") == NULL)
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: no reader", model->path);
    memcpy(cs_model_extend(&model->positions, 3), triangle, sizeof triangle);
    cs_model_set_colour(model, 0, (const float[3]){-1.0f, -0.5f, 0.25f}, error);
    cs_model_set_colour(model, 1, (const float[3]){0.25f, 0.5f, 2.0f}, error);
    return cs_model_add_polygon(model, corners, 3, CS_NO_INDEX, 0, error);
}

static const cs_import_modules some_modules = {.other = read_some};

/* Negative colours are black, not the white of positions that have none. */
static void colours_below_0(void **state)
{
    cs_scene scene;
    cs_error error;
    const cs_log log = {.warn = import_collect};
    const cs_import_options options = {.smooth_degrees = -1.0};
    (void)state;
    cs_scene_init(&scene);
    const char *path = test_file("some.dae", "<COLLADA/>");
    assert_int_equal(cs_import_here(path, &options, &some_modules, &scene, &log, &error),
                     CLSHEAR_OK);
    expect_close(import_colour(&scene, 0, 0), 0, 0, 0.25f);
    expect_close(import_colour(&scene, 0, 1), 0.25f, 0.5f, 2);
    expect_close(import_colour(&scene, 0, 2), 1, 1, 1);
    cs_scene_free(&scene);
}

/* Formats that Assimp reads may be packed, as Blender's; those that clshear reads itself are not.
 */
static void packed_files(void **state)
{
    static const struct {
        const char *name;
        const char *first;
        const char *words; /* "" where it is read */
    } files[] = {{"some.blend", "\x1f\x8b\x08", ""},
                 {"some.3mf", "PK\3\4", ""},
                 {"some.obj", "\x1f\x8b\x08", "is compressed by gzip; unpack it first"},
                 {"some.obj.gz", "\x1f\x8b\x08", "is compressed by gzip; unpack it first"},
                 {"other.blend", "\x28\xb5\x2f\xfd", "is compressed by zstd; unpack it first"},
                 {"other",
                  "\xfd"
                  "7zXZ",
                  "is compressed by xz; unpack it first"},
                 {"other.3mf", "PK\3\4", "no reader"},
                 {"some.blend", "<!DOCTYPE html>", "is a web page"}};
    const cs_log log = {.warn = import_collect};
    const cs_import_options options = {.smooth_degrees = -1.0};
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        cs_scene scene;
        cs_error error = {""};
        cs_scene_init(&scene);
        const char *path = test_file(files[i].name, files[i].first);
        const clshear_status status =
            cs_import_here(path, &options, &some_modules, &scene, &log, &error);
        assert_int_equal(status, *files[i].words == '\0' ? CLSHEAR_OK : CLSHEAR_BAD_FILE);
        if (strstr(error.message, files[i].words) == NULL)
            fail_msg("%s: \"%s\"", files[i].name, error.message);
        cs_scene_free(&scene);
    }
}

static void long_names_of_materials(void **state)
{
    char mtl[512], obj[512], name[140];
    (void)state;
    memset(name, 'a', 130);
    name[130] = '\0';
    snprintf(mtl, sizeof mtl, "newmtl %s1\nKd 1 0 0\nnewmtl %s2\nKd 0 1 0\n", name, name);
    test_file("long.mtl", mtl);
    snprintf(obj, sizeof obj,
             "mtllib long.mtl\n" SQUARE "usemtl %s1\nf 1 2 3\nusemtl %s2\nf 1 3 4\n", name, name);
    cs_scene scene = import_text("long.obj", obj);
    expect_close(import_material(&scene, 0)->diffuse, 1, 0, 0);
    expect_close(import_material(&scene, 1)->diffuse, 0, 1, 0);
    cs_scene_free(&scene);
}

/* C1's control characters are letters in UTF-8, and terminals obey them. */
static void controls_do_not_reach_terminals(void **state)
{
    (void)state;
    cs_scene scene = import_text("controls.obj", "mtllib a\xc2\x9b"
                                                 "2J\xc3\xa9.mtl\n" SQUARE "f 1 2 3\n");
    import_warned("material file a??2J\xc3\xa9.mtl not found");
    cs_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(squares_of_all_kinds),
        cmocka_unit_test(refusals_name_the_remedy),
        cmocka_unit_test(colours_below_0),
        cmocka_unit_test(packed_files),
        cmocka_unit_test(long_names_of_materials),
        cmocka_unit_test(controls_do_not_reach_terminals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
