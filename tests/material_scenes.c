#include "material_scenes.h"

#include "import/transfer.h"

static cs_scene sound_scene(const char *path)
{
    cs_scene scene = import_load(path);
    assert_true(cs_scene_is_sound(&scene));
    return scene;
}

cs_scene material_scene_mtl(const char *lines)
{
    return sound_scene(material_mtl(lines));
}

cs_scene material_scene_gltf(const char *material)
{
    return sound_scene(material_gltf(material));
}
