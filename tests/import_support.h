/* Scene files that are read in the test's own process, without a device, and what comes of them. */
#ifndef CS_TESTS_IMPORT_SUPPORT_H
#define CS_TESTS_IMPORT_SUPPORT_H

#include "support.h"

#include "import/import.h"

/* Warnings of the last file that was read, a line each. */
extern char import_warnings[8192];

/* A cs_log's way to them. */
void import_collect(void *user, const char *line);

/* Reads a file; faces without normals are smooth below this angle (-1: by the file's groups). */
clshear_status import_smooth(const char *path, double degrees, cs_scene *scene, cs_error *error);

/* Reads a file, or one of this text. A failure fails the test. The caller frees the scene. */
cs_scene import_load(const char *path);
cs_scene import_text(const char *name, const char *text);

/* Likewise, but by the process that reads files of all formats for programs. */
cs_scene import_apart(const char *path);

/* Expects a refusal in one line that begins with the file's name and contains `words`. */
void import_refused(const char *path, const char *words);

/* Expects that the warnings contain `words`. */
void import_warned(const char *words);

/* What a triangle, or its corner 0 to 2, has. */
const cs_material *import_material(const cs_scene *scene, size_t triangle);
const uint32_t *import_corners(const cs_scene *scene, size_t triangle);
const cs_vertex *import_vertex(const cs_scene *scene, size_t triangle, int corner);
const float *import_position(const cs_scene *scene, size_t triangle, int corner);
const float *import_colour(const cs_scene *scene, size_t triangle, int corner);

/* Area of all triangles, seen along the Z axis. */
double import_area(const cs_scene *scene);

/* Expects three numbers within 1e-4, or texture coordinates of a corner of the first triangle. */
void expect_close(const float *values, float a, float b, float c);
void expect_st(const cs_scene *scene, int corner, float s, float t);

/* Writes a picture of 2 x 2 texels: red, green, blue, white; the first row is the upper one. */
void import_picture(const char *name);

/* Writes a square as glTF and returns its path: `attributes` besides its positions (accessors: 1
 * ushort and 2 float pairs, 4 ubyte colours), its `material`, `more` at the root, and `nodes`. */
const char *import_gltf_square(const char *attributes, const char *material, const char *nodes,
                               const char *more);

#endif
