/* The standard surface in pictures. */
#include "support.h"

#include <math.h>

#include "render/objects.h"

static const uint32_t quad[6] = {0, 1, 2, 0, 2, 3};
static const float floor_y[12] = {-50, 0, -50, 50, 0, -50, 50, 0, 50, -50, 0, 50};
static const float roof_y[12] = {-50, 2, -50, 50, 2, -50, 50, 2, 50, -50, 2, 50};

static int set_up(void **state)
{
    *state = test_context();
    return 0;
}

static int tear_down(void **state)
{
    clshear_context_free(*state);
    return 0;
}

static clshear_material material_of(float metallic, float roughness)
{
    clshear_material material = {.struct_size = sizeof material};
    clshear_material_init(&material);
    material.metallic = metallic;
    material.roughness = roughness;
    return material;
}

/* A floor of `material` (NULL: white, Lambert's) and, unless NULL, a roof 2 above it. */
static clshear_scene *scene_of(clshear_context *context, const clshear_material *material,
                               const clshear_material *roof)
{
    clshear_scene *scene = NULL;
    clshear_mesh mesh = {.struct_size = sizeof mesh,
                         .positions = floor_y,
                         .indices = quad,
                         .vertex_count = 4,
                         .triangle_count = 2};
    test_ok(clshear_scene_create(context, &scene));
    if (material != NULL)
        test_ok(clshear_scene_add_material(scene, material, &mesh.material));
    else
        mesh.diffuse[0] = mesh.diffuse[1] = mesh.diffuse[2] = 1.0f;
    test_ok(clshear_scene_add_mesh(scene, &mesh));
    if (roof != NULL) {
        mesh.positions = roof_y;
        test_ok(clshear_scene_add_material(scene, roof, &mesh.material));
        test_ok(clshear_scene_add_mesh(scene, &mesh));
    }
    test_ok(clshear_scene_complete(scene));
    return scene;
}

/* From (-height * slope, height, 0) at the origin. */
static clshear_settings *looking_at_floor(double height, double slope, int bounces)
{
    clshear_settings *settings = test_settings(NULL, 4, 4, 1024);
    test_set(settings, CLSHEAR_EYE, "%g,%g,0", -height * slope, height);
    test_set(settings, CLSHEAR_TARGET, "0,0,0");
    test_set(settings, CLSHEAR_UP, "0,0,-1");
    test_set_number(settings, CLSHEAR_FOV, 0.01);
    test_set_number(settings, CLSHEAR_LENS_RADIUS, 0.0);
    test_set_number(settings, CLSHEAR_FOCAL_DISTANCE, height);
    test_set_number(settings, CLSHEAR_REPLICATES, 16);
    test_set_number(settings, CLSHEAR_BOUNCES, bounces);
    return settings;
}

static test_estimate mean_of_render(clshear_scene *scene, clshear_settings *settings)
{
    return test_mean_of_render(scene, settings, "R");
}

/* White surfaces under an even sky of radiance 1 show 1, within 0.5 % for the tables of albedos and
 * 5 standard errors (false alarms 1e-6); light and BSDF samples are weighted on the way. */
static void white_furnace(void **state)
{
    static const float roughnesses[] = {0.05f, 0.2f, 0.4f, 0.7f, 1.0f};
    for (int kind = 0; kind < 4; kind++)
        for (int r = 0; r < 5; r++) {
            clshear_material material = material_of(kind == 0 ? 1.0f : 0.0f, roughnesses[r]);
            if (kind == 2) material.transmission = 1.0f;
            if (kind == 3) material.clearcoat = 1.0f;
            material.clearcoat_roughness = 0.3f;
            clshear_scene *scene = scene_of(*state, &material, NULL);
            clshear_settings *settings = looking_at_floor(1.0, r % 2 == 0 ? 0.3 : 2.0, r % 2);
            test_set(settings, CLSHEAR_ENVIRONMENT, "1,1,1");
            const test_estimate found = mean_of_render(scene, settings);
            print_message("kind %d, roughness %.2f: %.4f, error %.4f\n", kind,
                          (double)roughnesses[r], found.mean, found.error);
            assert_near(found.mean, 1.0, 0.005 + 5.0 * found.error);
            assert_below(found.error, 0.01);
            clshear_scene_free(scene);
        }
}

/* A polished white metal is a mirror: it shows the part of the sky that it mirrors, here a sun that
 * its own samples hardly find, as bright as it is: L = E / (pi sin^2 a), within 2 % for the width
 * of the lobe against the sun's 20 degrees. */
static void polished_metal_shows_the_sun(void **state)
{
    const clshear_material material = material_of(1.0f, 0.05f);
    clshear_scene *scene = scene_of(*state, &material, NULL);
    clshear_settings *settings = looking_at_floor(1.0, 1.0, 0);
    test_set(settings, CLSHEAR_SUN, "1,1,0,1,1,1,20");
    const double sine = sin(10.0 * acos(-1.0) / 180.0), truth = 1.0 / (acos(-1.0) * sine * sine);
    const test_estimate found = mean_of_render(scene, settings);
    print_message("sun in metal: %.3f of %.3f, error %.3f\n", found.mean, truth, found.error);
    assert_near(found.mean, truth, 0.02 * truth + 5.0 * found.error);
    clshear_scene_free(scene);
}

/* An unlit roof of colour 0.8 and alpha 0.3 before a floor: 0.3 of the one and 0.7 of the other,
 * whose light passes the roof with a chance of 0.7 too. */
static void alpha_shows_what_is_behind(void **state)
{
    clshear_material roof = material_of(0.0f, 1.0f);
    roof.unlit = 1;
    roof.base_colour[0] = 0.8f;
    roof.alpha = 0.3f;
    for (int mode = CLSHEAR_ALPHA_OPAQUE; mode <= CLSHEAR_ALPHA_BLEND; mode++) {
        roof.alpha_mode = (clshear_alpha_mode)mode;
        clshear_scene *scene = scene_of(*state, NULL, &roof);
        clshear_settings *settings = looking_at_floor(4.0, 0.2, 0);
        test_set(settings, CLSHEAR_SUN, "0,1,0,2,2,2,0");
        const double below = 2.0 / acos(-1.0);
        const double truth = mode == CLSHEAR_ALPHA_OPAQUE ? 0.8
                             : mode == CLSHEAR_ALPHA_MASK ? below
                                                          : 0.3 * 0.8 + 0.7 * 0.7 * below;
        const test_estimate found = mean_of_render(scene, settings);
        print_message("alpha mode %d: %.4f of %.4f, error %.4f\n", mode, found.mean, truth,
                      found.error);
        assert_near(found.mean, truth, 5.0 * found.error + 2e-3 * truth);
        clshear_scene_free(scene);
    }
}

/* Without its reflection the dielectric is Lambert's surface. */
static void no_reflection_is_lambert(void **state)
{
    clshear_material ground = material_of(0.0f, 0.3f);
    ground.specular = 0.0f;
    for (int c = 0; c < 3; c++)
        ground.base_colour[c] = 0.5f;
    clshear_scene *scene = scene_of(*state, &ground, NULL);
    clshear_settings *settings = looking_at_floor(1.0, 0.5, 0);
    test_set(settings, CLSHEAR_LIGHT, "0,2,0,8,8,8");
    assert_near(mean_of_render(scene, settings).mean, 0.5 * 2.0 / acos(-1.0), 1e-4);
    clshear_scene_free(scene);
}

/* A floor whose material has one texture of one colour, of 2 x 2 texels: s along X, t along -Z.
 * `place` is where in cs_material its number goes. */
static clshear_scene *mapped_floor(clshear_context *context, const clshear_material *material,
                                   const uint16_t *halves, size_t place)
{
    static const float st[12] = {0, 1, 0, 1, 1, 0, 1, 0, 0, 0, 0, 0};
    static const uint32_t facing_up[6] = {0, 2, 1, 0, 3, 2};
    cs_error error;
    uint32_t number = 0;
    clshear_scene *scene = NULL;
    const clshear_mesh mesh = {.struct_size = sizeof mesh,
                               .positions = floor_y,
                               .indices = facing_up,
                               .vertex_count = 4,
                               .triangle_count = 2};
    test_ok(clshear_scene_create(context, &scene));
    test_ok(clshear_scene_add_material(scene, material, &number));
    cs_scene *world = &scene->scene;
    cs_texture *texture = cs_array_extend(&world->textures, 1);
    uint16_t *texels = cs_array_extend(&world->texels, 4);
    *texture = (cs_texture){.width = 2, .height = 2};
    for (size_t i = 0; i < 16; i++)
        texels[i] = halves[i % 4];
    const cs_u32 named = place == offsetof(cs_material, texture) ? 0 : 1;
    memcpy((char *)world->materials.items + (number - 1) * sizeof(cs_material) + place, &named,
           sizeof named);
    assert_int_equal(cs_scene_add_mesh(world, &mesh, number - 1, "mesh", &error), CLSHEAR_OK);
    cs_vertex *vertices = world->vertices.items;
    for (size_t i = 0; i < world->vertices.count; i++)
        memcpy(vertices[i].texture, st + 2 * i, sizeof vertices[i].texture);
    uint8_t *flags = world->triangle_flags.items;
    for (size_t i = 0; i < world->triangle_flags.count; i++)
        flags[i] |= CS_FACE_TEXTURED;
    test_ok(clshear_scene_complete(scene));
    return scene;
}

/* Maps of one colour: half of the base, half of the emission, a normal bent towards +X or -Z (as
 * halves 0x3800 is 0.5, 0x3a66 0.8, 0x3b33 0.9, 0x3c00 1), seen from above and from below. A sun in
 * the direction of the bent normal gives E / pi; the halves round to 1e-3. */
static void maps_say_what_they_should(void **state)
{
    static const uint16_t half[4] = {0x3800, 0x3800, 0x3800, 0x3c00};
    static const uint16_t right[4] = {0x3a66, 0x3800, 0x3b33, 0x3c00};
    static const uint16_t ahead[4] = {0x3800, 0x3a66, 0x3b33, 0x3c00};
    const double pi = acos(-1.0);
    const struct {
        const uint16_t *texel;
        size_t place;
        const char *sun;
        double height; /* of the eye */
        double truth;
    } cases[] = {
        {half, offsetof(cs_material, texture), "0,1,0,2,2,2,0", 1.0, 1.0 / pi},
        {right, offsetof(cs_material, normal_texture), "0.6,0.8,0,2,2,2,0", 1.0, 2.0 / pi},
        {right, offsetof(cs_material, normal_texture), "-0.6,0.8,0,2,2,2,0", 1.0, 0.56 / pi},
        {ahead, offsetof(cs_material, normal_texture), "0,0.8,-0.6,2,2,2,0", 1.0, 2.0 / pi},
        {right, offsetof(cs_material, normal_texture), "-0.6,-0.8,0,2,2,2,0", -1.0, 2.0 / pi},
        {ahead, offsetof(cs_material, normal_texture), "0,-0.8,0.6,2,2,2,0", -1.0, 2.0 / pi},
    };
    clshear_material material = material_of(0.0f, 0.5f);
    material.specular = 0.0f;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        clshear_scene *scene = mapped_floor(*state, &material, cases[i].texel, cases[i].place);
        clshear_settings *settings = looking_at_floor(1.0, 0.1, 0);
        test_set(settings, CLSHEAR_EYE, "-0.1,%g,0", cases[i].height);
        test_set(settings, CLSHEAR_SUN, "%s", cases[i].sun);
        const test_estimate found = mean_of_render(scene, settings);
        print_message("map %zu: %.4f of %.4f\n", i, found.mean, cases[i].truth);
        assert_near(found.mean, cases[i].truth, 3e-3 * cases[i].truth + 5.0 * found.error);
        clshear_scene_free(scene);
    }
    material.emission[0] = 3.0f;
    material.base_colour[0] = 0.0f; /* of the studio's light it shows nothing */
    clshear_scene *scene =
        mapped_floor(*state, &material, half, offsetof(cs_material, emission_texture));
    assert_near(mean_of_render(scene, looking_at_floor(1.0, 0.1, 0)).mean, 1.5, 1e-3);
    clshear_scene_free(scene);
}

/* A slab of smooth glass, 2 thick, under and over a sky of radiance 1. White glass shows 1. Where
 * half of the light is left after 2, the sum over all ways within is R + T^2 a / (1 - R a), with
 * R = 0.04 head-on, T = 1 - R and a = 0.5. 1e-3 is for the width of the facets. */
static void slab_of_glass(void **state)
{
    static const uint32_t facing_up[6] = {0, 2, 1, 0, 3, 2};
    for (int absorbs = 0; absorbs < 2; absorbs++) {
        clshear_scene *scene = NULL;
        clshear_mesh mesh = {.struct_size = sizeof mesh,
                             .positions = floor_y,
                             .indices = quad,
                             .vertex_count = 4,
                             .triangle_count = 2};
        clshear_material material = material_of(0.0f, 0.0f);
        material.transmission = 1.0f;
        material.solid = 1;
        material.attenuation_distance = absorbs ? 2.0f : 0.0f;
        material.attenuation_colour[0] = 0.5f;
        test_ok(clshear_scene_create(*state, &scene));
        test_ok(clshear_scene_add_material(scene, &material, &mesh.material));
        test_ok(clshear_scene_add_mesh(scene, &mesh));
        mesh.positions = roof_y;
        mesh.indices = facing_up;
        test_ok(clshear_scene_add_mesh(scene, &mesh));
        test_ok(clshear_scene_complete(scene));
        clshear_settings *settings = looking_at_floor(4.0, 0.01, 12);
        test_set(settings, CLSHEAR_ENVIRONMENT, "1,1,1");
        const double truth = absorbs ? 0.04 + 0.96 * 0.96 * 0.5 / (1.0 - 0.04 * 0.5) : 1.0;
        const test_estimate found = mean_of_render(scene, settings);
        print_message("slab: %.4f of %.4f, error %.4f\n", found.mean, truth, found.error);
        assert_near(found.mean, truth, 1e-3 + 5.0 * found.error);
        clshear_scene_free(scene);
    }
}

static void wrong_materials_are_refused(void **state)
{
    clshear_scene *scene = NULL;
    uint32_t number = 0;
    test_ok(clshear_scene_create(*state, &scene));
    clshear_material material = material_of(0.0f, 1.5f);
    test_refused(clshear_scene_add_material(scene, &material, &number), CLSHEAR_BAD_ARGUMENT,
                 "roughness");
    material = material_of(0.0f, 0.5f);
    material.ior = 0.5f;
    test_refused(clshear_scene_add_material(scene, &material, &number), CLSHEAR_BAD_ARGUMENT,
                 "ior");
    const clshear_mesh mesh = {.struct_size = sizeof mesh,
                               .positions = floor_y,
                               .indices = quad,
                               .vertex_count = 4,
                               .triangle_count = 2,
                               .material = 1};
    test_refused(clshear_scene_add_mesh(scene, &mesh), CLSHEAR_BAD_ARGUMENT, "no material");
    clshear_scene_free(scene);
}

/* A roof that shines, where its material has it, is no light whose samples go by power: only rays
 * find it, beside a sun behind the roof as well. By the tree it is one, and the floor is as bright:
 * 5 standard errors, false alarms 1e-6. */
static void rays_find_what_masks_let_shine(void **state)
{
    test_estimate found[2];
    clshear_material roof = material_of(0.0f, 1.0f);
    for (int c = 0; c < 3; c++)
        roof.emission[c] = 1.0f;
    roof.alpha_mode = CLSHEAR_ALPHA_MASK;
    clshear_scene *scene = scene_of(*state, NULL, &roof);
    for (int by_power = 0; by_power < 2; by_power++) {
        clshear_settings *settings = looking_at_floor(1.0, 0.5, 0);
        test_set(settings, CLSHEAR_SUN, "0,1,0,2,2,2,0.5");
        test_set(settings, CLSHEAR_EMITTERS, by_power ? "power" : "tree");
        found[by_power] = mean_of_render(scene, settings);
    }
    print_message("by the tree %.4f, by power %.4f\n", found[0].mean, found[1].mean);
    assert_above(found[0].mean, 0.5);
    assert_near(found[0].mean, found[1].mean, 5.0 * hypot(found[0].error, found[1].error));
    clshear_scene_free(scene);
}

/* A floor under a light; beside it may be a quad, near the floor and all but black, that only
 * both ways to find it together do justice to. */
typedef struct lit_floor {
    float roughness;
    clshear_setting setting;
    const char *light;
    double rays; /* of a sample, but for that from the lens, without the quad */
} lit_floor;

static clshear_film *film_of_floor(clshear_context *context, const lit_floor *lit, int beside)
{
    const clshear_material material =
        material_of(lit->roughness < 0.1f ? 1.0f : 0.0f, lit->roughness);
    clshear_scene *scene = scene_of(context, &material, NULL);
    clshear_settings *settings = looking_at_floor(1.0, 0.5, 0);
    test_set(settings, lit->setting, "%s", lit->light);
    if (beside) test_set(settings, CLSHEAR_QUAD, "-1.5,0.5,-2,0,4,0,0,0,4,1e-12,1e-12,1e-12");
    clshear_film *film = test_render(scene, settings);
    clshear_settings_free(settings);
    clshear_scene_free(scene);
    return film;
}

/* A light that looks small is found by its own samples alone, with the same mean as if the BSDF's
 * looked for it too: 5 standard errors of 240 degrees of freedom, false alarms 1e-6. One that looks
 * large, or that a polished floor mirrors, is looked for. Rays that would end at no light are none:
 * a fifth of them ends at the large ball, nearly all at what is mirrored. */
static void small_lights_need_no_last_ray(void **state)
{
    static const lit_floor cases[] = {{0.6f, CLSHEAR_SUN, "1,2,1,1,1,1,0.5", 1.0},
                                      {0.2f, CLSHEAR_SUN, "1,2,1,1,1,1,0.5", 1.0},
                                      {0.6f, CLSHEAR_SPHERE, "0,20,3,2,1,1,1", 1.0},
                                      {0.6f, CLSHEAR_QUAD, "-1,20,-1,2,0,0,0,0,2,1,1,1", 1.0},
                                      {0.03f, CLSHEAR_SUN, "1,2,0,1,1,1,0.5", 1.9},
                                      {0.6f, CLSHEAR_SPHERE, "4,3,0,2.8,1,1,1", 1.2},
                                      {0.6f, CLSHEAR_ENVIRONMENT, "1,1,1", 2.0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        clshear_film *film = film_of_floor(*state, &cases[i], 0);
        clshear_film *both = film_of_floor(*state, &cases[i], 1);
        const clshear_film_info info = test_film_info(film), more = test_film_info(both);
        const test_estimate found = test_mean(film, "R"), expected = test_mean(both, "R");
        const double rays = (double)info.shadow_rays / (double)info.samples;
        print_message("light %zu: %.4f rays, %.5g; looked for, %.5g, error %.2g\n", i, rays,
                      found.mean, expected.mean, hypot(found.error, expected.error));
        assert_near(rays, cases[i].rays, 0.1); /* some facets are turned away */
        assert_above((double)more.shadow_rays / (double)more.samples, 2.1);
        if (i < 4) assert_near(found.mean, expected.mean, 5.0 * hypot(found.error, expected.error));
        assert_above(found.mean, 10.0 * hypot(found.error, expected.error));
        clshear_film_free(both);
        clshear_film_free(film);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(white_furnace),
        cmocka_unit_test(polished_metal_shows_the_sun),
        cmocka_unit_test(alpha_shows_what_is_behind),
        cmocka_unit_test(no_reflection_is_lambert),
        cmocka_unit_test(maps_say_what_they_should),
        cmocka_unit_test(slab_of_glass),
        cmocka_unit_test(rays_find_what_masks_let_shine),
        cmocka_unit_test(small_lights_need_no_last_ray),
        cmocka_unit_test(wrong_materials_are_refused),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
