/* Cameras of Collada files as Assimp can read them. */
#ifndef CS_HELPER_COLLADA_CAMERA_H
#define CS_HELPER_COLLADA_CAMERA_H

#include <assimp/scene.h>

#include "base/status.h"
#include "import/model.h"
#include "import/text.h"

/* Edits the cameras in the text so that Assimp 5.2 reads them. The text does not become longer.
 * Assimp ignores a yfov without an xfov, and derives a wrong aspect from both: a yfov replaces the
 * xfov, and the aspect is removed. Assimp has no parallel cameras in Collada: their xmag or ymag is
 * written as a negative xfov, which cs_collada_extent recognises. */
clshear_status cs_collada_edit_cameras(cs_bytes *bytes, cs_error *error);

/* Sets the height that a camera shows if it is a parallel one. `scale` is that of its node. */
void cs_collada_extent(const struct aiCamera *source, double scale, cs_model_camera *camera);

#endif
