/* The readers of scene files: one for each format. Each fills an empty model from the bytes of a
 * file, which it may change, and reports a damaged file in one line: file, place, what is wrong. */
#ifndef CS_IMPORT_READERS_H
#define CS_IMPORT_READERS_H

#include "import/model.h"
#include "import/packed.h"
#include "import/text.h"

/* A reader of the formats that have none of their own here. */
typedef clshear_status (*cs_other_reader)(cs_bytes *bytes, cs_model *model, cs_error *error);

/* What clshear-import loads when a file needs it. NULL: such files are refused. */
typedef struct cs_import_modules {
    cs_other_reader other;
    cs_draco_reader draco;
    cs_meshopt_reader meshopt;
} cs_import_modules;

clshear_status cs_read_obj(cs_bytes *bytes, cs_model *model, cs_error *error);
clshear_status cs_read_ply(cs_bytes *bytes, cs_model *model, cs_error *error);
clshear_status cs_read_stl(cs_bytes *bytes, cs_model *model, cs_error *error);
clshear_status cs_read_off(cs_bytes *bytes, cs_model *model, cs_error *error);
clshear_status cs_read_gltf(cs_bytes *bytes, cs_model *model, cs_error *error);

/* Whether a file is one of these, by its first bytes and its name. */
int cs_is_obj(const cs_bytes *bytes, const char *path);
int cs_is_ply(const cs_bytes *bytes, const char *path);
int cs_is_stl(const cs_bytes *bytes, const char *path);
int cs_is_off(const cs_bytes *bytes, const char *path);
int cs_is_gltf(const cs_bytes *bytes, const char *path);

/* Whether a path ends in ".obj" or the like, in any case. */
int cs_has_suffix(const char *path, const char *suffix);

#endif
