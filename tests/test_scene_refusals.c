/* What is no scene is refused, or repaired, and said. */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <sys/stat.h>

#define SQUARE "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"

static void refuse_file(clshear_context *context, const char *path)
{
    clshear_scene *scene = NULL;
    const char *name = strrchr(path, '/') + 1;
    assert_int_equal(clshear_scene_load(context, path, NULL, &scene), CLSHEAR_BAD_FILE);
    assert_null(scene);
    if (strstr(clshear_context_message(context), name) == NULL)
        fail_msg("\"%s\" does not name %s", clshear_context_message(context), name);
    assert_null(strchr(clshear_context_message(context), '\n'));
}

static void bad_files_are_refused(void **state)
{
    clshear_context *context = *state;
    refuse_file(context, test_path("not_there.obj"));
    refuse_file(context, SCENES);
    refuse_file(context, test_file("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    refuse_file(context, test_file("infinite.obj", "v 1e39 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    refuse_file(context, test_file("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"));
    const char *const ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                            "property float y\nproperty float z\nelement face 1\n"
                            "property list uchar int vertex_indices\nend_header\n"
                            "-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n4 0 1 2 %s\n";
    const char *const indices[] = {"900000", "-5", "4"};
    for (int i = 0; i < 3; i++) {
        char text[512];
        snprintf(text, sizeof text, ply, indices[i]);
        refuse_file(context, test_file("range.ply", text));
    }
    refuse_file(context, test_file("none.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"));
    refuse_file(context, test_file("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1 2 3\nl 1 2\n"));
    refuse_file(context, test_file("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"));
    refuse_file(context, test_file("empty.obj", ""));
    refuse_file(context, test_file("prose.txt", "This is not a scene.\n"));
    refuse_file(context, test_file("broken.gltf", "{\"asset\":"));
}

static void bad_meshes_are_refused(void **state)
{
    clshear_context *context = *state;
    clshear_scene *scene = NULL;
    const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const uint32_t outside[3] = {0, 1, 3}, inside[3] = {0, 1, 2};
    const float wrong[] = {NAN, -1.0f, INFINITY, 1e16f};
    clshear_mesh mesh = {.struct_size = sizeof mesh,
                         .positions = positions,
                         .indices = outside,
                         .vertex_count = 3,
                         .triangle_count = 1};
    test_ok(clshear_scene_create(context, &scene));
    test_refused(clshear_scene_add_mesh(scene, &mesh), CLSHEAR_BAD_ARGUMENT, "3");
    test_refused(clshear_scene_complete(scene), CLSHEAR_BAD_ARGUMENT, "no triangles");
    mesh.indices = NULL;
    test_refused(clshear_scene_add_mesh(scene, &mesh), CLSHEAR_BAD_ARGUMENT, "indices are NULL");
    mesh.indices = inside;
    for (int i = 0; i < 4; i++) {
        clshear_mesh dark = mesh, bright = mesh;
        dark.diffuse[1] = bright.emission[2] = wrong[i];
        test_refused(clshear_scene_add_mesh(scene, &dark), CLSHEAR_BAD_ARGUMENT, "diffuse");
        test_refused(clshear_scene_add_mesh(scene, &bright), CLSHEAR_BAD_ARGUMENT, "emission");
    }
    test_ok(clshear_scene_add_mesh(scene, &mesh));
    test_ok(clshear_scene_complete(scene));
    assert_int_equal(test_scene_info(scene).triangles, 1); /* refused meshes leave nothing behind */
    clshear_scene_free(scene);
}

/* Pipes and folders are refused: a pipe without a writer would block, and a folder has no bytes. */
static void pipes_and_folders_are_not_read(void **state)
{
    clshear_context *context = *state;
    mkfifo(test_path("pipe.png"), 0600);
    mkdir(test_path("folder.mtl"), 0700);
    mkdir(test_path("folder.png"), 0700);
    test_file("piped.mtl", "newmtl t\nmap_Kd pipe.png\nmap_Ke folder.png\n");
    clshear_scene *scene =
        test_load(context, test_file("piped.obj", "mtllib piped.mtl folder.mtl\n" SQUARE
                                                  "vt 0 0\nusemtl t\nf 1/1 2/1 3/1 4/1\n"));
    const char *warnings = test_warnings();
    assert_non_null(strstr(warnings, "folder.mtl: is a folder, not a file"));
    assert_non_null(strstr(warnings, "folder.png: is a folder, not a file; it is mid-grey"));
    assert_non_null(strstr(warnings, "pipe.png: is not a regular file"));
    clshear_scene_free(scene);
}

/* A folder where another kind of file names an image, or the settings an environment. */
static void folders_are_called_folders(void **state)
{
    clshear_context *context = *state;
    clshear_settings *settings = test_settings(NULL, 8, 8, 4);
    clshear_film *film = NULL;
    char folder[4096];
    mkdir(test_path("folder.png"), 0700);
    snprintf(folder, sizeof folder, "%s", test_path("folder.png"));
    clshear_scene *scene = test_load(
        context, test_file("folder.ply", "ply\nformat ascii 1.0\ncomment TextureFile folder.png\n"
                                         "element vertex 3\nproperty float x\nproperty float y\n"
                                         "property float z\nproperty float u\nproperty float v\n"
                                         "element face 1\nproperty list uchar int vertex_indices\n"
                                         "end_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n"));
    assert_non_null(strstr(test_warnings(), "folder.png: is a folder, not a file; it is mid-grey"));
    test_set(settings, CLSHEAR_ENVIRONMENT, "%s", folder);
    test_refused(clshear_render(scene, settings, &film), CLSHEAR_BAD_FILE,
                 "folder.png: is a folder, not a file");
    clshear_scene_free(scene);
    clshear_settings_free(settings);
}

static void a_buffer_is_no_folder(void **state)
{
    clshear_scene *scene = NULL;
    mkdir(test_path("folder.png"), 0700);
    const char *gltf = test_file(
        "folder.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{"
        "\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],\"bufferViews\":[{"
        "\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":\"folder.png\"}]"
        "}");
    test_refused(clshear_scene_load(*state, gltf, NULL, &scene), CLSHEAR_BAD_FILE,
                 "folder.png: is a folder, not a file");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bad_files_are_refused),
        cmocka_unit_test(bad_meshes_are_refused),
        cmocka_unit_test(pipes_and_folders_are_not_read),
        cmocka_unit_test(folders_are_called_folders),
        cmocka_unit_test(a_buffer_is_no_folder),
    };
    return cmocka_run_group_tests(tests, test_open_context, test_close_context);
}
