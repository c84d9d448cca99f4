/* Generated meshes for the benchmarks and tests. */
#ifndef CS_TESTS_MESHES_H
#define CS_TESTS_MESHES_H

#include "base/array.h"
#include "scene/scene.h"

/* Fills an initialised scene with a mesh in a room, the unit cube open towards +Z:
 *   "box"      two boxes, 30 triangles in all
 *   "spheres"  a cloud of 64 bumpy spheres, about `triangles` triangles
 *   "terrain"  a rough height field, about `triangles` triangles */
clshear_status test_make_mesh(const char *name, size_t triangles, cs_scene *scene, cs_error *error);

#endif
