/* What files say of materials, from the lines of a file to the numbers on the device. */
#include "material_scenes.h"

#include <math.h>
#include <stdio.h>

#include "import/transfer.h"
#include "kernels/bsdf/list.h"

/* A float of a device material. */
typedef struct expectation {
    const char *text; /* of the material */
    size_t offset;
    double value;
} expectation;

#define PARAMETER(name) (offsetof(cs_material, parameters) + sizeof(float) * CS_PARAMETER_##name)

static void expect_all(const expectation *all, size_t count, cs_scene (*load_text)(const char *))
{
    for (size_t i = 0; i < count; i++) {
        cs_scene scene = load_text(all[i].text);
        float found;
        memcpy(&found, (const char *)import_material(&scene, 0) + all[i].offset, sizeof found);
        if (!(fabs((double)found - all[i].value) < 1e-5))
            fail_msg("%s: %g is not %g", all[i].text, (double)found, all[i].value);
        assert_int_equal(import_material(&scene, 0)->bsdf, CS_BSDF_STANDARD);
        assert_string_equal(import_warnings, "");
        cs_scene_free(&scene);
    }
}

#define PBR(text) "{'pbrMetallicRoughness':{" text "}}"
#define EXTENSION(name, text)                                                                    \
    "{'pbrMetallicRoughness':{'metallicFactor':0},'extensions':{'KHR_materials_" name "':{" text \
    "}}}"

static void numbers_of_gltf(void **state)
{
    static const expectation all[] = {
        {PBR("'roughnessFactor':0.3"), PARAMETER(ROUGHNESS), 0.3},
        {PBR("'roughnessFactor':0.3"), PARAMETER(METALLIC), 1.0},
        {PBR("'metallicFactor':0.2"), PARAMETER(METALLIC), 0.2},
        {PBR("'metallicFactor':0.2"), PARAMETER(ROUGHNESS), 1.0},
        {PBR("'metallicFactor':0"), PARAMETER(F0), 0.04},
        {PBR("'metallicFactor':0"), PARAMETER(F90), 1.0},
        {PBR("'metallicFactor':0,'roughnessFactor':7"), PARAMETER(ROUGHNESS), 1.0},
        {PBR("'metallicFactor':0,'baseColorFactor':[0.5,0.25,0.125,1]"),
         offsetof(cs_material, diffuse) + 4, 0.25},
        {EXTENSION("ior", "'ior':2"), PARAMETER(F0), 1.0 / 9.0},
        {EXTENSION("specular", "'specularFactor':0.5"), PARAMETER(F0), 0.02},
        {EXTENSION("specular", "'specularFactor':0.5"), PARAMETER(F90), 0.5},
        {EXTENSION("specular", "'specularColorFactor':[2,2,2]"), PARAMETER(F0), 0.08},
        {EXTENSION("transmission", "'transmissionFactor':0.7"), PARAMETER(TRANSMISSION), 0.7},
        {EXTENSION("clearcoat", "'clearcoatFactor':0.6"), PARAMETER(COAT), 0.6},
        {EXTENSION("clearcoat", "'clearcoatRoughnessFactor':0.6"), PARAMETER(COAT_ROUGHNESS), 0.6},
        {EXTENSION("sheen", "'sheenColorFactor':[0.1,0.2,0.3]"), PARAMETER(SHEEN) + 8, 0.3},
        {EXTENSION("sheen", "'sheenRoughnessFactor':0.4"), PARAMETER(SHEEN_ROUGHNESS), 0.4},
        {EXTENSION("emissive_strength", "'emissiveStrength':3"), offsetof(cs_material, alpha), 1.0},
        {EXTENSION("pbrSpecularGlossiness", "'glossinessFactor':0.7"), PARAMETER(ROUGHNESS), 0.3},
        {EXTENSION("pbrSpecularGlossiness", "'specularFactor':[0.2,0.2,0.2]"), PARAMETER(F0), 0.2},
        {EXTENSION("pbrSpecularGlossiness", "'diffuseFactor':[0,0,0,1]"), PARAMETER(METALLIC), 1.0},
    };
    (void)state;
    expect_all(all, sizeof all / sizeof *all, material_scene_gltf);
}

/* Roughness by Ns: (2 / (Ns + 2))^(1/4). */
static void numbers_of_mtl(void **state)
{
    static const expectation all[] = {
        {"Ks 0.5 0.5 0.5\nNs 30", PARAMETER(ROUGHNESS), 0.5},
        {"Ks 0.5 0.5 0.5\nNs 30\nillum 2\nNi 1\nd 1", PARAMETER(F0), 0.04},
        {"Ks 0.5 0.5 0.5\nNs 30", PARAMETER(F90), 1.0},
        {"Ks 0.25 0.25 0.25\nNs 30", PARAMETER(F90), 0.5},
        {"Ks 9 9 9\nNs 30", PARAMETER(F0), 0.08},
        {"Ks 0 1 0\nNs 30", PARAMETER(F0), 0.08 * 0.7152},
        {"Ks 0.6 0.6 0.6\nillum 3", PARAMETER(F0), 0.6},
        {"Ks 0.6 0.6 0.6\nillum 3", PARAMETER(ROUGHNESS), 0.0},
        {"Ks 0.6 0.6 0.6\nNs 30\nillum 3", PARAMETER(ROUGHNESS), 0.5},
        {"Kd 0 0 0\nKs 0.6 0.5 0.2\nillum 3", PARAMETER(METALLIC), 1.0},
        {"Kd 0 0 0\nKs 0.6 0.5 0.2\nillum 3", offsetof(cs_material, diffuse) + 8, 0.2},
        {"Ks 0.6 0.6 0.6\nNi 2\nillum 5", PARAMETER(F0), 1.0 / 9.0},
        {"d 0.3\nillum 4", PARAMETER(TRANSMISSION), 0.7},
        {"d 0.3\nillum 4\nNi 1", PARAMETER(F0), 0.04},
        {"Kd 0.5 0.5 0.5\nd 0\nTf 0.9 0.8 0.7\nillum 6", offsetof(cs_material, diffuse) + 4, 0.8},
        {"Ni 2\nillum 7", PARAMETER(TRANSMISSION), 1.0},
        {"Ni 2\nillum 7", PARAMETER(F0), 1.0 / 9.0},
        {"Pr 0.3", PARAMETER(ROUGHNESS), 0.3},
        {"Pr 0.3", PARAMETER(F0), 0.04},
        {"Pm 0.8", PARAMETER(METALLIC), 0.8},
        {"Pc 0.6", PARAMETER(COAT), 0.6},
        {"Pc 1\nPcr 0.2", PARAMETER(COAT_ROUGHNESS), 0.2},
        {"Ps 0.5", PARAMETER(SHEEN) + 8, 0.5},
    };
    (void)state;
    expect_all(all, sizeof all / sizeof *all, material_scene_mtl);
}

#define METAL "newmtl m\nNs 225\nKa 0.75 0.75 0.75\nKd 0.5 0.5 0.5\nKs 0.5 0.5 0.5\nillum 3\n"

/* Metals by Blender from 2.80 on; older ones, whose Ni is 1, mean mirrors of Ka, others of Ks. */
static void metals_of_blender(void **state)
{
    static const expectation all[] = {
        {"# Blender MTL File: 'None'\n" METAL "Ni 1.45", PARAMETER(METALLIC), 0.75},
        {"# Blender MTL File: 'None'\n" METAL "Ni 1.45", PARAMETER(ROUGHNESS), 0.5},
        {"# Blender MTL File: 'None'\n" METAL "Ni 1.45", PARAMETER(F0), 0.04},
        {"# Blender 3.4.1 MTL File: 'a.blend'\n" METAL "Ns 250\nNi 1.5", PARAMETER(ROUGHNESS), 0.5},
        {"# Blender MTL File: 'a.blend'\n" METAL "Ni 1", PARAMETER(METALLIC), 0.0},
        {"# Blender MTL File: 'a.blend'\n" METAL "Ni 1", PARAMETER(F0), 0.75},
        {"# Made by another\n" METAL "Ni 1.45", PARAMETER(F0), 0.5},
        {"# Blender MTL File: 'None'\n" METAL "Ni 1.45\nPm 0.25", PARAMETER(METALLIC), 0.25},
    };
    (void)state;
    expect_all(all, sizeof all / sizeof *all, material_scene_mtl);
}

/* Files that ask for Lambert's surface have it, and the kernels that know no other. */
static void lambert_stays_lambert(void **state)
{
    static const char *const mtl[] = {
        "Kd 0.5 0.4 0.3",
        "Kd 0.5 0.4 0.3\nKs 0 0 0\nNs 96\nNi 1.45\nd 1\nillum 2",
        "Kd 0.5 0.4 0.3\nKs 1 1 1\nNs 0\nillum 2",
        "Kd 0.5 0.4 0.3\nKs 1 1 1\nNs 50\nillum 1",
        "Kd 0.5 0.4 0.3\nTf 1 1 1\nNi 1\nillum 4",
        "Kd 0.5 0.4 0.3\nTr 0",
        "Kd 0.5 0.4 0.3\nd 1\nTr 1",
        "Kd 0.5 0.4 0.3\nKe 1 1 1",
    };
    static const char *const gltf[] = {
        "{}",
        "{'doubleSided':true}",
        PBR("'baseColorFactor':[0.5,0.4,0.3,1]"),
        "{'alphaMode':'BLEND'}",
        "{'alphaMode':'MASK','alphaCutoff':0.7}",
        "{'emissiveFactor':[1,1,1]}",
    };
    const size_t count = sizeof mtl / sizeof *mtl;
    (void)state;
    for (size_t i = 0; i < count + sizeof gltf / sizeof *gltf; i++) {
        cs_scene scene =
            i < count ? material_scene_mtl(mtl[i]) : material_scene_gltf(gltf[i - count]);
        assert_int_equal(import_material(&scene, 0)->bsdf, CS_BSDF_LAMBERT);
        assert_int_equal(cs_scene_material_needs(&scene).features, 0);
        assert_string_equal(import_warnings, "");
        cs_scene_free(&scene);
    }
}

#define VOLUME(text)                                                                              \
    "{'pbrMetallicRoughness':{'metallicFactor':0},'extensions':{'KHR_materials_ior':{'ior':1.3}," \
    "'KHR_materials_transmission':{'transmissionFactor':0.9},'KHR_materials_volume':{" text "}}}"

/* A thickness makes what is transparent a solid, of the material's index, which absorbs -ln(colour)
 * / distance per unit; without a distance nothing, and without a thickness the wall stays thin.
 * What is opaque has no inside. */
static void volumes_are_solids(void **state)
{
    static const struct {
        const char *text;
        int is_solid;
        double absorption[3];
    } all[] = {
        {VOLUME("'thicknessFactor':1"), 1, {0, 0, 0}},
        {VOLUME("'thicknessFactor':1,'attenuationDistance':2,'attenuationColor':[0.5,1,0.25]"),
         1,
         {0.34657359, 0.0, 0.69314718}},
        {VOLUME("'thicknessFactor':1,'attenuationColor':[0.5,1,0.25]"), 1, {0, 0, 0}},
        {VOLUME("'thicknessFactor':0,'attenuationDistance':2"), 0, {0, 0, 0}},
        {VOLUME("'attenuationDistance':2"), 0, {0, 0, 0}},
        {EXTENSION("volume", "'thicknessFactor':1"), 0, {0, 0, 0}},
    };
    (void)state;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        cs_scene scene = material_scene_gltf(all[i].text);
        const cs_material *material = import_material(&scene, 0);
        assert_int_equal(material->bsdf, all[i].is_solid ? CS_BSDF_GLASS : CS_BSDF_STANDARD);
        if (all[i].is_solid) assert_near(material->parameters[CS_PARAMETER_INDEX], 1.3, 1e-6);
        for (int c = 0; c < 3 && all[i].is_solid; c++)
            assert_near(material->parameters[CS_PARAMETER_ABSORPTION + c], all[i].absorption[c],
                        1e-6);
        assert_string_equal(import_warnings, "");
        cs_scene_free(&scene);
    }
}

static void flags_of_materials(void **state)
{
    static const struct {
        int is_mtl;
        const char *text;
        cs_u32 flags;
        float alpha;
    } all[] = {
        {1, "d 0.25", CS_MATERIAL_BLEND, 0.25f},
        {1, "Tr 0.25", CS_MATERIAL_BLEND, 0.75f},
        {1, "d 0.25\nTr 0.1", CS_MATERIAL_BLEND, 0.25f},
        {1, "d -halo 0.25", CS_MATERIAL_BLEND, 0.25f},
        {0, "{'alphaMode':'BLEND','pbrMetallicRoughness':{'baseColorFactor':[1,1,1,0.5]}}",
         CS_MATERIAL_BLEND, 0.5f},
        {0, "{'alphaMode':'MASK','pbrMetallicRoughness':{'baseColorFactor':[1,1,1,0.25]}}",
         CS_MATERIAL_MASK, 0.25f},
        {0, "{'pbrMetallicRoughness':{'baseColorFactor':[1,1,1,0.25]}}", 0, 0.25f},
        {0, "{'extensions':{'KHR_materials_unlit':{}}}", CS_MATERIAL_UNLIT, 1.0f},
    };
    (void)state;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        cs_scene scene =
            all[i].is_mtl ? material_scene_mtl(all[i].text) : material_scene_gltf(all[i].text);
        assert_int_equal(import_material(&scene, 0)->flags, all[i].flags);
        assert_true(import_material(&scene, 0)->alpha == all[i].alpha);
        cs_scene_free(&scene);
    }
    cs_scene scene = material_scene_mtl("Tr 1");
    assert_int_equal(import_material(&scene, 0)->flags, 0);
    import_warned("Tr 1 is taken as opaque, as some programs mean it, in 1 material without d");
    cs_scene_free(&scene);
    scene = material_scene_mtl("d 0");
    import_warned("\"m\" has the opacity 0 and cannot be seen");
    cs_scene_free(&scene);
}

/* What a helper may send only by mistake. Each case changes one word of a sound scene. */
/* Whatever number a file has, the material is one that the device can take. */
static void numbers_out_of_range_are_sound(void **state)
{
    static const char *const numbers[] = {"-1",    "0",     "0.5",  "1.5",
                                          "1e-30", "-1e30", "1e30", "1e39"};
    static const char *const gltf[] = {
        "{'pbrMetallicRoughness':{'baseColorFactor':[%s,1,1,1],'roughnessFactor':0.5}}",
        "{'alphaMode':'BLEND','pbrMetallicRoughness':{'baseColorFactor':[1,1,1,%s]}}",
        "{'pbrMetallicRoughness':{'metallicFactor':%s,'roughnessFactor':0.5}}",
        "{'pbrMetallicRoughness':{'metallicFactor':0.5,'roughnessFactor':%s}}",
        "{'emissiveFactor':[1,%s,0]}",
        "{'emissiveFactor':[1,1,1],'extensions':{'KHR_materials_emissive_strength':"
        "{'emissiveStrength':%s}}}",
        "{'alphaMode':'MASK','alphaCutoff':%s}",
        EXTENSION("ior", "'ior':%s"),
        EXTENSION("specular", "'specularFactor':%s"),
        EXTENSION("specular", "'specularColorFactor':[1,%s,1]"),
        EXTENSION("clearcoat", "'clearcoatFactor':%s,'clearcoatRoughnessFactor':0.5"),
        EXTENSION("clearcoat", "'clearcoatFactor':1,'clearcoatRoughnessFactor':%s"),
        EXTENSION("sheen", "'sheenColorFactor':[1,%s,1]"),
        EXTENSION("sheen", "'sheenColorFactor':[1,1,1],'sheenRoughnessFactor':%s"),
        EXTENSION("transmission", "'transmissionFactor':%s"),
        EXTENSION("pbrSpecularGlossiness", "'specularFactor':[%s,1,1],'glossinessFactor':0.5"),
        EXTENSION("pbrSpecularGlossiness", "'diffuseFactor':[0,0,0,1],'specularFactor':[%s,1,1]"),
        EXTENSION("pbrSpecularGlossiness", "'glossinessFactor':%s"),
        VOLUME("'thicknessFactor':%s,'attenuationDistance':2,'attenuationColor':[0.5,1,0.25]"),
        VOLUME("'thicknessFactor':1,'attenuationDistance':%s,'attenuationColor':[0.5,1,0.25]"),
        VOLUME("'thicknessFactor':1,'attenuationDistance':2,'attenuationColor':[0.5,%s,0.25]"),
        "{'pbrMetallicRoughness':{'metallicFactor':0},'extensions':{'KHR_materials_ior':{'ior':%s},"
        "'KHR_materials_transmission':{'transmissionFactor':1},'KHR_materials_volume':{"
        "'thicknessFactor':1}}}"};
    static const char *const mtl[] = {"Kd %s 1 1",
                                      "Ke %s 1 1",
                                      "Ks %s 1 1\nNs 10",
                                      "Ks 1 1 1\nNs %s",
                                      "Ni %s\nillum 7\nd 0.5",
                                      "Ni %s\nillum 5\nKs 1 1 1",
                                      "d %s",
                                      "Tr %s",
                                      "illum 7\nd 0.5\nTf 1 %s 1",
                                      "Pr %s",
                                      "Pm %s",
                                      "Pc %s\nPcr 0.5",
                                      "Pc 1\nPcr %s",
                                      "Ps %s"};
    char text[1024];
    (void)state;
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) {
        for (size_t i = 0; i < sizeof gltf / sizeof *gltf + sizeof mtl / sizeof *mtl; i++) {
            const size_t first = sizeof gltf / sizeof *gltf;
            const char *const form = i < first ? gltf[i] : mtl[i - first], *at = strstr(form, "%s");
            snprintf(text, sizeof text, "%.*s%s%s", (int)(at - form), form, numbers[k], at + 2);
            cs_scene scene = i < first ? material_scene_gltf(text) : material_scene_mtl(text);
            if (!cs_scene_is_sound(&scene)) fail_msg("%s", text);
            cs_scene_free(&scene);
        }
    }
}

static void unsound_materials_are_found(void **state)
{
    static const struct {
        size_t offset;
        float number;
        cs_u32 word; /* where number is 0 */
    } cases[] = {
        {offsetof(cs_material, texture), 0, 2},
        {offsetof(cs_material, texture), 0, 0x80000000u},
        {offsetof(cs_material, facets_texture), 0, 9},
        {offsetof(cs_material, normal_texture), 0, 9},
        {offsetof(cs_material, emission_texture), 0, 0xffffffffu},
        {offsetof(cs_material, bsdf), 0, CS_BSDF_ALL},
        {offsetof(cs_material, flags), 0, 0x100},
        {offsetof(cs_material, alpha), 1.5f, 0},
        {offsetof(cs_material, cutoff), NAN, 0},
        {offsetof(cs_material, normal_scale), INFINITY, 0},
        {offsetof(cs_material, diffuse), -1.0f, 0},
        {offsetof(cs_material, emission), NAN, 0},
        {PARAMETER(ROUGHNESS), NAN, 0},
        {PARAMETER(SHEEN_ROUGHNESS), 2.0f, 0},
    };
    (void)state;
    material_even_picture("grey.tga", 128, 128, 128, 255);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        cs_scene scene = material_scene_mtl("map_Kd grey.tga\nPr 0.5\nnorm grey.tga");
        char *material = scene.materials.items;
        if (cases[i].number != 0.0f)
            memcpy(material + cases[i].offset, &cases[i].number, sizeof(float));
        else
            memcpy(material + cases[i].offset, &cases[i].word, sizeof(cs_u32));
        if (cs_scene_is_sound(&scene)) fail_msg("case %zu passes", i);
        cs_scene_free(&scene);
    }
    cs_scene scene = material_scene_mtl("map_Kd grey.tga");
    ((cs_vertex *)scene.vertices.items)->texture[1] = NAN;
    assert_false(cs_scene_is_sound(&scene));
    ((cs_vertex *)scene.vertices.items)->texture[1] = 0.0f;
    ((cs_texture *)scene.textures.items)->lookup = 3;
    assert_false(cs_scene_is_sound(&scene));
    cs_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_of_gltf),
        cmocka_unit_test(numbers_of_mtl),
        cmocka_unit_test(metals_of_blender),
        cmocka_unit_test(volumes_are_solids),
        cmocka_unit_test(lambert_stays_lambert),
        cmocka_unit_test(flags_of_materials),
        cmocka_unit_test(unsound_materials_are_found),
        cmocka_unit_test(numbers_out_of_range_are_sound),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
