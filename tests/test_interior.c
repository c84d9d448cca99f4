/* Rooms and what is no room. */
#include "support.h"

#include "render/interior.h"

enum {
    BOXES = 100,    /* inside the room, on its floor */
    BOX_CORNERS = 8 /* of a box, and its faces are 12 triangles */
};

/* Corners and triangles of boxes. */
typedef struct boxes {
    float positions[(BOXES + 1) * BOX_CORNERS * 3];
    uint32_t indices[(BOXES + 1) * 36];
    size_t count;
} boxes;

static void add_box(boxes *all, float x, float y, float z, const float *size)
{
    static const uint32_t faces[36] = {0, 1, 3, 0, 3, 2, 4, 7, 5, 4, 6, 7, 0, 5, 1, 0, 4, 5,
                                       2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
    const size_t first = all->count * BOX_CORNERS;
    for (size_t i = 0; i < BOX_CORNERS; i++) {
        float *corner = all->positions + 3 * (first + i);
        corner[0] = x + (i & 1 ? size[0] : 0.0f);
        corner[1] = y + (i & 2 ? size[1] : 0.0f);
        corner[2] = z + (i & 4 ? size[2] : 0.0f);
    }
    for (size_t i = 0; i < 36; i++)
        all->indices[36 * all->count + i] = (uint32_t)first + faces[i];
    all->count++;
}

static int is_room(clshear_context *context, const boxes *all, cs_view *view)
{
    cs_error error;
    int found = 0;
    const clshear_mesh mesh = {.positions = all->positions,
                               .vertex_count = all->count * BOX_CORNERS,
                               .indices = all->indices,
                               .triangle_count = all->count * 12};
    clshear_scene *scene = test_meshes(context, &mesh, 1);
    assert_int_equal(cs_interior_view(scene, 0, &found, view, &error), CLSHEAR_OK);
    clshear_scene_free(scene);
    return found;
}

/* Ten rows of boxes on the floor. */
static void add_things(boxes *all)
{
    for (int i = 0; i < BOXES; i++) {
        const float size[3] = {0.3f, 0.2f + 0.02f * (float)(i * 7 % 10), 0.3f};
        add_box(all, 0.4f + 0.75f * (float)(i % 10), 0.01f, 0.4f + 0.75f * (float)(i / 10), size);
    }
}

static void full_rooms_are_seen_from_inside(void **state)
{
    static const float room[3] = {8.0f, 2.6f, 8.0f};
    clshear_context *context = test_context();
    boxes all = {.count = 0};
    cs_view view;
    (void)state;
    add_box(&all, 0.0f, 0.0f, 0.0f, room);
    add_things(&all);
    assert_true(is_room(context, &all, &view));
    for (int i = 0; i < 3; i++) {
        assert_above(view.eye[i], 0.0f);
        assert_below(view.eye[i], room[i]);
    }
    assert_above(view.eye[1], 1.3f); /* over the middle */
    assert_near(view.target[1], view.eye[1], 1e-4f);
    clshear_context_free(context);
}

/* The things alone, an empty room, and a solid in a thin case. */
static void others_are_seen_from_outside(void **state)
{
    static const float room[3] = {8.0f, 2.6f, 8.0f}, solid[3] = {7.8f, 2.4f, 7.8f};
    clshear_context *context = test_context();
    boxes all = {.count = 0};
    cs_view view;
    (void)state;
    add_things(&all);
    assert_false(is_room(context, &all, &view));
    all.count = 0;
    add_box(&all, 0.0f, 0.0f, 0.0f, room);
    assert_false(is_room(context, &all, &view));
    add_box(&all, 0.1f, 0.1f, 0.1f, solid);
    assert_false(is_room(context, &all, &view));
    clshear_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(full_rooms_are_seen_from_inside),
        cmocka_unit_test(others_are_seen_from_outside),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
