/* Tangents of vertices, along which normal maps bend the normal. */
#ifndef CS_SCENE_TANGENTS_H
#define CS_SCENE_TANGENTS_H

#include "scene/scene.h"

/* Makes two cs_tangent a vertex, as kernels/scene.h has them: of the triangles around it whose
 * texture is not mirrored, and of those whose is, as Mikkelsen 2008 (Simulation of Wrinkled
 * Surfaces Revisited) does and programs that bake normal maps assume: the mean of the triangles'
 * own, in the plane of the vertex's normal, weighted by their angle there. Unit vectors; zeros
 * where no smooth triangle with a normal map asks for one. No item at all where the scene has no
 * normal map. */
clshear_status cs_tangents_make(const cs_scene *scene, cs_array *tangents, cs_error *error);

#endif
