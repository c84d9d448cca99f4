/* Cameras of Collada files as Assimp can read them. */
#ifndef CS_HELPER_COLLADA_CAMERA_H
#define CS_HELPER_COLLADA_CAMERA_H

#include <assimp/scene.h>

#include "base/status.h"
#include "import/model.h"
#include "import/text.h"

/* Edits the cameras in the text, which becomes shorter. Assimp 5.2 takes an angle that is given
 * downwards alone for none, makes a wrong aspect of two angles, and does not know parallel lines of
 * sight: what is downwards becomes what is across, without an aspect, and the size of parallel
 * cameras a negative angle. */
clshear_status cs_collada_edit_cameras(cs_bytes *bytes, cs_error *error);

/* Sets the height that a camera shows if it is a parallel one. `scale` is that of its node. */
void cs_collada_extent(const struct aiCamera *source, double scale, cs_model_camera *camera);

#endif
