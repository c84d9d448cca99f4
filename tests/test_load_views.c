/* Scene files: which of their cameras is chosen, and what is up in them. */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "render/objects.h"

static const char two_cameras[] =
    "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0},{\"camera\":0,"
    "\"translation\":[0,0,5]},{\"camera\":1,\"translation\":[0,0,9]}],"
    "\"cameras\":[{\"name\":\"near\",\"type\":\"perspective\",\"perspective\":"
    "{\"yfov\":0.5}},{\"name\":\"far\",\"type\":\"orthographic\",\"orthographic\":"
    "{\"xmag\":2,\"ymag\":1.5}}],\"meshes\":[{\"primitives\":[{\"attributes\":{"
    "\"POSITION\":0}"
    "}]}],\"accessors\":[{\"bufferView\":0,\"componentType\":5121,\"count\":3,"
    "\"type\":\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":12,"
    "\"byteStride\":4}],\"buffers\":[{\"byteLength\":12,"
    "\"uri\":\"data:;base64,AAAAAAEAAAAAAQAA\"}]}";

static void cameras_are_chosen(void **state)
{
    double eye[3], width = 0.0;
    size_t count = 0;
    clshear_settings *settings = NULL;
    clshear_scene *scene = test_load(*state, test_file("cameras.gltf", two_cameras));
    assert_string_equal(clshear_scene_camera(scene, 1), "far");
    assert_null(clshear_scene_camera(scene, 2));
    static const struct {
        const char *name;
        double z, width; /* 0: in perspective. The picture is twice as high as wide */
    } cases[] = {{NULL, 5, 0}, {"far", 9, 1.5}, {"0", 5, 0}, {"1", 9, 1.5}};
    for (int i = 0; i < 4; i++) {
        test_ok(clshear_settings_create(&settings));
        if (cases[i].name != NULL)
            test_ok(clshear_settings_set_text(settings, CLSHEAR_CAMERA, cases[i].name));
        test_ok(clshear_settings_set_integer(settings, CLSHEAR_WIDTH, 256));
        test_ok(clshear_camera_complete(scene, settings));
        test_ok(clshear_settings_get_numbers(settings, CLSHEAR_EYE, eye, 3, &count));
        assert_true(eye[2] == cases[i].z);
        const int parallel = clshear_settings_is_set(settings, CLSHEAR_ORTHOGRAPHIC);
        assert_int_equal(clshear_settings_is_set(settings, CLSHEAR_FOV), !parallel);
        width = 0.0;
        if (parallel) test_ok(clshear_settings_get_number(settings, CLSHEAR_ORTHOGRAPHIC, &width));
        assert_true(width == cases[i].width);
        clshear_settings_free(settings);
    }
    test_ok(clshear_settings_create(&settings));
    test_ok(clshear_settings_set_text(settings, CLSHEAR_CAMERA, "side"));
    assert_int_equal(clshear_camera_complete(scene, settings), CLSHEAR_BAD_ARGUMENT);
    assert_string_equal(clshear_message(), "camera side: the scene has 2: 0 \"near\", 1 \"far\"");
    clshear_settings_free(settings);
    clshear_scene_free(scene);
}

/* A triangle of 3DS: chunks of a number, a length and what is in them. */
static const char *write_3ds(const float corners[3][3])
{
    static const struct {
        uint16_t number;
        uint32_t size;
    } chunks[] = {{0x4d4d, 86}, {0x3d3d, 80}, {0x4000, 74}, {0x4100, 66}};
    static const uint16_t face[] = {1, 0, 1, 2, 0}, count = 3;
    unsigned char bytes[86] = {0};
    size_t used = 0;
    for (int i = 0; i < 4; i++) {
        memcpy(bytes + used, &chunks[i].number, 2);
        memcpy(bytes + used + 2, &chunks[i].size, 4);
        used += 6;
        if (chunks[i].number == 0x4000) bytes[used] = 'a'; /* the name of the object, and a zero */
        if (chunks[i].number == 0x4000) used += 2;
    }
    memcpy(bytes + used, &(uint16_t){0x4110}, 2);
    memcpy(bytes + used + 2, &(uint32_t){44}, 4);
    memcpy(bytes + used + 6, &count, 2);
    memcpy(bytes + used + 8, corners, 36);
    used += 44;
    memcpy(bytes + used, &(uint16_t){0x4120}, 2);
    memcpy(bytes + used + 2, &(uint32_t){16}, 4);
    memcpy(bytes + used + 6, face, 10);
    return test_bytes("one.3ds", bytes, sizeof bytes);
}

/* +Z is up by the format's convention, and coordinates are those of the file. */
static void up_is_z_in_3ds(void **state)
{
    static const float corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 3}};
    static const double ups[2][3] = {{0, 1, 0}, {0, 0, 1}};
    clshear_scene *scene = test_load(*state, write_3ds(corners));
    clshear_scene_info info = {.struct_size = sizeof info};
    clshear_scene_describe(scene, &info);
    for (int axis = 0; axis < 3; axis++) {
        assert_true(info.low[axis] == 0.0);
        assert_true(info.high[axis] == axis + 1.0);
    }
    for (int z_up = -1; z_up < 2; z_up++) { /* -1: as the format has it */
        clshear_settings *settings = NULL;
        double up[3];
        size_t count = 0;
        test_ok(clshear_settings_create(&settings));
        test_ok(clshear_settings_set_text(settings, CLSHEAR_ORBIT, "20,0"));
        if (z_up >= 0) test_ok(clshear_settings_set_integer(settings, CLSHEAR_Z_UP, z_up));
        test_ok(clshear_camera_complete(scene, settings));
        test_ok(clshear_settings_get_numbers(settings, CLSHEAR_UP, up, 3, &count));
        for (int axis = 0; axis < 3; axis++)
            assert_true(fabs(up[axis] - ups[z_up != 0][axis]) < 1e-6);
        clshear_settings_free(settings);
    }
    clshear_scene_free(scene);
}

/* A block from (-1, y, z) that is 2 wide, 2 deep and 3 high, as OBJ; what is said of its camera. */
static void expect_hint(clshear_context *context, double y, double z, const char *flag,
                        int is_expected)
{
    char text[512] = "";
    clshear_settings *settings = NULL;
    for (int i = 0; i < 8; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "v %d %g %g\n", i & 1 ? 1 : -1,
                 i & 2 ? y + 2 : y, i & 4 ? z + 3 : z);
    strcat(text, "f 1 2 4 3\nf 5 6 8 7\nf 1 2 6 5\nf 2 4 8 6\nf 4 3 7 8\nf 3 1 5 7\n");
    clshear_scene *scene = test_load(context, test_file("block.obj", text));
    test_ok(clshear_settings_create(&settings));
    if (flag != NULL) test_ok(clshear_settings_set_text(settings, CLSHEAR_Z_UP, flag));
    test_ok(clshear_camera_complete(scene, settings));
    assert_int_equal(strstr(test_warnings(), "--z-up sets it upright") != NULL, is_expected);
    clshear_settings_free(settings);
    clshear_scene_free(scene);
}

/* OBJ does not say what is up: a model that stands on z = 0 may have +Z up. */
static void what_stands_on_z_is_told(void **state)
{
    expect_hint(*state, -1.0, 0.0, NULL, 1);
    expect_hint(*state, -1.0, 0.0, "0", 0);   /* the user has said it */
    expect_hint(*state, 0.0, 0.0, NULL, 0);   /* as well on y = 0 */
    expect_hint(*state, -1.0, -1.0, NULL, 0); /* on neither */
}

/* A quarter of a turn takes +X to -Z where +Y is up, and to +Y where +Z is. */
static void turntable_turns_about_what_is_up(void **state)
{
    static const float expected[2][3] = {{0, 0, -1}, {0, 1, 0}};
    const char *path = test_file("turned.obj", "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\n"
                                               "v 0 0 -1\nf 1 3 5\nf 2 4 6\n");
    for (int z_up = 0; z_up < 2; z_up++) {
        clshear_settings *settings = NULL;
        test_ok(clshear_settings_create(&settings));
        test_ok(clshear_settings_set_number(settings, CLSHEAR_TURNTABLE, 90.0));
        test_set_number(settings, CLSHEAR_Z_UP, z_up);
        clshear_scene *scene = NULL;
        test_ok(clshear_scene_load(*state, path, settings, &scene));
        const float(*from)[3] = scene->scene.positions.items;
        const float(*to)[3] = scene->scene.positions_to.items;
        assert_int_equal(scene->scene.positions_to.count, 6);
        for (size_t i = 0; i < 6; i++)
            for (int axis = 0; axis < 3 && from[i][0] == 1.0f; axis++)
                assert_near(to[i][axis], expected[z_up][axis], 1e-6);
        clshear_scene_free(scene);
        clshear_settings_free(settings);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cameras_are_chosen),
        cmocka_unit_test(up_is_z_in_3ds),
        cmocka_unit_test(what_stands_on_z_is_told),
        cmocka_unit_test(turntable_turns_about_what_is_up),
    };
    return cmocka_run_group_tests(tests, test_open_context, test_close_context);
}
