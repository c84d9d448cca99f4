/* The oracle: from what is known of a pixel's depth to the shear of its samples. */
#ifndef CS_ORACLE_ORACLE_H
#define CS_ORACLE_ORACLE_H

#include <stddef.h>

#include "shared.h"

/* The signed circle of confusion, in pixels, at the depth of each pixel's centre. Pixels that see
 * nothing (infinite depth) are not sheared. A wrong answer costs variance, never bias. */
void cs_oracle_centre(const cs_camera *camera, const float *depth, size_t count, float *shear_px);

#endif
