#include "meshes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "clshear/device/hash.h"

typedef struct builder {
    cs_array positions; /* float[3] each */
    cs_array indices;   /* uint32_t[3] each */
} builder;

static uint32_t add_vertex(builder *mesh, double x, double y, double z)
{
    float *vertex = cs_array_extend(&mesh->positions, 1);
    if (vertex == NULL) abort();
    vertex[0] = (float)x;
    vertex[1] = (float)y;
    vertex[2] = (float)z;
    return (uint32_t)(mesh->positions.count - 1);
}

static void add_triangle(builder *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *triangle = cs_array_extend(&mesh->indices, 1);
    if (triangle == NULL) abort();
    triangle[0] = a;
    triangle[1] = b;
    triangle[2] = c;
}

/* Adds a grid of rows x columns quads. `place` computes the corners. */
static void add_grid(builder *mesh, int rows, int columns, const double *shape,
                     void (*place)(const double *shape, double s, double t, double *point))
{
    uint32_t first = (uint32_t)mesh->positions.count;
    for (int row = 0; row <= rows; row++)
        for (int column = 0; column <= columns; column++) {
            double point[3];
            place(shape, (double)column / columns, (double)row / rows, point);
            add_vertex(mesh, point[0], point[1], point[2]);
        }
    for (int row = 0; row < rows; row++)
        for (int column = 0; column < columns; column++) {
            uint32_t corner = first + (uint32_t)(row * (columns + 1) + column);
            uint32_t below = corner + (uint32_t)columns + 1;
            add_triangle(mesh, corner, corner + 1, below);
            add_triangle(mesh, corner + 1, below + 1, below);
        }
}

/* `shape` is a corner and two edges. */
static void on_quad(const double *shape, double s, double t, double *point)
{
    for (int i = 0; i < 3; i++)
        point[i] = shape[i] + s * shape[3 + i] + t * shape[6 + i];
}

/* `shape` is the centre and the radius. */
static void on_sphere(const double *shape, double s, double t, double *point)
{
    const double pi = 3.14159265358979;
    const double across[3] = {sin(pi * t) * cos(2 * pi * s), cos(pi * t),
                              sin(pi * t) * sin(2 * pi * s)};
    double bump = sin(9 * across[0]) * sin(11 * across[1]) * sin(13 * across[2]);
    for (int i = 0; i < 3; i++)
        point[i] = shape[i] + shape[3] * (1.0 + 0.25 * bump) * across[i];
}

/* A sum of waves; shorter waves have smaller amplitudes. */
static void on_terrain(const double *shape, double s, double t, double *point)
{
    double height = shape[0];
    for (int octave = 0; octave < 7; octave++) {
        double scale = pow(2.0, octave);
        height += 0.06 / scale * sin(7.1 * scale * s + 1.3 * octave + 2.0 * sin(3.0 * scale * t)) *
                  cos(6.3 * scale * t + 0.7 * octave);
    }
    point[0] = s;
    point[1] = height;
    point[2] = t;
}

static void add_quad(builder *mesh, double x, double y, double z, double ax, double ay, double az,
                     double bx, double by, double bz)
{
    const double shape[9] = {x, y, z, ax, ay, az, bx, by, bz};
    add_grid(mesh, 1, 1, shape, on_quad);
}

static void add_box(builder *mesh, double x, double y, double z, double w, double h, double d)
{
    add_quad(mesh, x, y, z + d, w, 0, 0, 0, h, 0);
    add_quad(mesh, x, y, z, w, 0, 0, 0, h, 0);
    add_quad(mesh, x, y, z, 0, 0, d, 0, h, 0);
    add_quad(mesh, x + w, y, z, 0, 0, d, 0, h, 0);
    add_quad(mesh, x, y + h, z, w, 0, 0, 0, 0, d);
}

/* Adds a unit cube without its front. */
static void add_room(builder *mesh)
{
    add_quad(mesh, 0, 0, 0, 1, 0, 0, 0, 0, 1);
    add_quad(mesh, 0, 1, 0, 1, 0, 0, 0, 0, 1);
    add_quad(mesh, 0, 0, 0, 1, 0, 0, 0, 1, 0);
    add_quad(mesh, 0, 0, 0, 0, 0, 1, 0, 1, 0);
    add_quad(mesh, 1, 0, 0, 0, 0, 1, 0, 1, 0);
}

static void make_box(builder *mesh)
{
    add_room(mesh);
    add_box(mesh, 0.2, 0, 0.25, 0.3, 0.6, 0.25);
    add_box(mesh, 0.55, 0, 0.6, 0.3, 0.3, 0.25);
}

static void make_spheres(builder *mesh, size_t triangles)
{
    int rows = (int)sqrt((double)triangles / (64.0 * 4.0));
    if (rows < 3) rows = 3;
    add_room(mesh);
    for (uint32_t i = 0; i < 64; i++) {
        double random[4];
        for (uint32_t k = 0; k < 4; k++)
            random[k] = cs_key(i, k) / 4294967296.0;
        const double shape[4] = {0.1 + 0.8 * random[0], 0.1 + 0.8 * random[1],
                                 0.1 + 0.8 * random[2], 0.05 + 0.05 * random[3]};
        add_grid(mesh, rows, 2 * rows, shape, on_sphere);
    }
}

static void make_terrain(builder *mesh, size_t triangles)
{
    const double height = 0.3;
    add_room(mesh);
    int side = (int)sqrt((double)triangles / 2.0);
    add_grid(mesh, side > 0 ? side : 1, side > 0 ? side : 1, &height, on_terrain);
}

clshear_status test_make_mesh(const char *name, size_t triangles, cs_scene *scene, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    builder mesh = {.positions = {.item_size = 3 * sizeof(float)},
                    .indices = {.item_size = 3 * sizeof(uint32_t)}};
    if (strcmp(name, "box") == 0)
        make_box(&mesh);
    else if (strcmp(name, "spheres") == 0)
        make_spheres(&mesh, triangles);
    else if (strcmp(name, "terrain") == 0)
        make_terrain(&mesh, triangles);
    clshear_mesh made = {.positions = mesh.positions.items,
                         .indices = mesh.indices.items,
                         .vertex_count = mesh.positions.count,
                         .triangle_count = mesh.indices.count};
    cs_material *grey = cs_array_extend(&scene->materials, 1);
    CS_REQUIRE(grey != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    *grey = (cs_material){.diffuse = {0.7f, 0.7f, 0.7f}, .texture = CS_NO_TEXTURE};
    CS_TRY(cs_scene_add_mesh(scene, &made, 0, name, error));
    CS_TRY(cs_scene_finish(scene, name, error));
done:
    cs_array_free(&mesh.positions);
    cs_array_free(&mesh.indices);
    return status;
}
